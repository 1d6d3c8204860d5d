//! One record of the table: where it is in the text, and how it is written.

use crate::fault::Fault;
use crate::grammar::{Parsed, instance_number, keyword, parameters, space};

/// An instance in the text. Kept at 24 bytes, since records themselves are often no longer than 40.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Record {
    pub id: u64,
    /// Offset of its `#`.
    pub start: usize,
    /// Bytes up to its `;`. 0: nothing usable.
    pub length: u32,
    /// From `start` to its keyword or, if it is complex, its `(`. [`FAR`]: more than fits.
    pub body_at: u16,
    /// 0 for a complex instance.
    pub keyword_length: u16,
}

/// [`Record::body_at`] of a record with so long a comment before its keyword that it has to be looked for again.
pub(crate) const FAR: u16 = u16::MAX;

impl Record {
    /// A stretch of text that has yet to be checked.
    pub fn unchecked(start: usize, end: usize) -> Self {
        let length = u32::try_from(end - start).unwrap_or(0);
        Record { id: 0, start, length, body_at: 0, keyword_length: 0 }
    }

    /// Whether there is anything in it: not so if it was found damaged.
    pub fn is_usable(&self) -> bool {
        self.length != 0
    }

    pub fn end(&self) -> usize {
        self.start + self.length as usize
    }

    pub fn text<'a>(&self, file: &'a [u8]) -> &'a [u8] {
        &file[self.start..self.end()]
    }

    /// The text from its keyword (or `(`) on.
    pub fn body<'a>(&self, file: &'a [u8]) -> &'a [u8] {
        let text = self.text(file);
        if self.body_at != FAR {
            return &text[usize::from(self.body_at)..];
        }
        prefix(text).map_or(&[], |(body, _)| body)
    }
}

/// What stands before a keyword.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Prefix {
    /// `#12 =`
    Number(u64),
    /// `ENDSCOPE /#13,#14/`, see [`crate::scope`].
    ScopeEnd,
}

/// Leaves the text from the keyword on. `# 12=` and `#12 =` are tolerated.
#[inline]
pub(crate) fn prefix(text: &[u8]) -> Parsed<'_, Prefix> {
    let Some(number) = text.strip_prefix(b"#") else {
        return match text.strip_prefix(b"ENDSCOPE") {
            Some(exported) => scope_end(exported),
            None => Fault::at(text, "an instance (#number = KEYWORD(...)) is expected"),
        };
    };
    let number = space(number);
    if !number.first().is_some_and(u8::is_ascii_digit) {
        return Fault::at(text, "an instance has no number");
    }
    let (rest, id) = instance_number(number)?;
    match space(rest) {
        [b'=', body @ ..] => Ok((space(body), Prefix::Number(id))),
        rest => Fault::at(rest, "an equals sign is expected after the instance's number"),
    }
}

/// The exported numbers, which say nothing about the instance itself.
fn scope_end(text: &[u8]) -> Parsed<'_, Prefix> {
    let exported = space(text);
    let Some(list) = exported.strip_prefix(b"/") else { return Ok((exported, Prefix::ScopeEnd)) };
    match list.iter().position(|byte| !matches!(byte, b'#' | b',' | b'0'..=b'9' | 0..=b' ')) {
        Some(end) if list[end] == b'/' => Ok((space(&list[end + 1..]), Prefix::ScopeEnd)),
        _ => Fault::at(exported, "a scope does not end with /#number, .../"),
    }
}

/// `KEYWORD(...)`, and the length of the keyword; or `(A(...) B(...))`, and 0.
pub(crate) fn body(text: &[u8]) -> Parsed<'_, usize> {
    let Some(parts) = text.strip_prefix(b"(") else {
        let (rest, name) = part(text)?;
        return Ok((rest, name.len()));
    };
    let (mut rest, _) = part(space(parts))?;
    loop {
        match space(rest) {
            [b')', tail @ ..] => return Ok((tail, 0)),
            [] => return Fault::at(&[], "a complex instance is not closed"),
            other => (rest, _) = part(other)?,
        }
    }
}

/// `KEYWORD(...)`, checked; gives the keyword.
pub(crate) fn part(text: &[u8]) -> Parsed<'_, &[u8]> {
    let (rest, name) = keyword(text)?;
    match space(rest) {
        [b'(', list @ ..] => {
            let (rest, ()) = parameters(list)?;
            Ok((rest, name))
        }
        other => Fault::at(other, "an opening parenthesis is expected after a keyword"),
    }
}
