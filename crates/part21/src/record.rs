//! One record of the table: where it is in the text, and the check that it can be read.

use crate::fault::{Damage, DamageList, Fault};
use crate::grammar::{Parsed, instance_number, keyword, parameters, space};
use crate::scan::{begins_record, next_record_line};

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
const FAR: u16 = u16::MAX;

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
        head(text).map_or(&[], |(body, _)| body)
    }
}

/// `#12 =`; gives the number, and leaves the text from the keyword on. `# 12=` and `#12 =` are tolerated.
fn head(text: &[u8]) -> Parsed<'_, u64> {
    let Some(number) = text.strip_prefix(b"#") else {
        return Fault::at(text, "an instance (#number = ...) is expected");
    };
    let number = space(number);
    if !number.first().is_some_and(u8::is_ascii_digit) {
        return Fault::at(text, "an instance has no number");
    }
    let (rest, id) = instance_number(number)?;
    match space(rest) {
        [b'=', body @ ..] => Ok((space(body), id)),
        rest => Fault::at(rest, "an equals sign is expected after the instance's number"),
    }
}

/// `KEYWORD(...)`, and the length of the keyword; or `(A(...) B(...))`, and 0.
fn body(text: &[u8]) -> Parsed<'_, usize> {
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

/// Checks the record in place. Further records, found in its text because a `;` is missing, go to `extra`.
pub(crate) fn check(file: &[u8], record: &mut Record, extra: &mut Vec<Record>, damage: &mut DamageList) {
    let end = record.end();
    let mut resume = check_one(file, record, damage);
    while let Some(start) = resume {
        let mut another = Record::unchecked(start, end);
        resume = check_one(file, &mut another, damage);
        if another.is_usable() {
            extra.push(another);
        }
    }
}

/// Checks one record; damage is reported once, and a record that cannot be read gets the length 0. Gives the offset
/// of the next instance within the record's text, if there is one: then a `;` is missing.
fn check_one(file: &[u8], record: &mut Record, damage: &mut DamageList) -> Option<usize> {
    let text = record.text(file);
    let (instance, fault) = match read(text, record) {
        Ok([]) => return None,
        Ok(rest) => (Some(record.id), Fault { rest, message: "a semicolon is expected here" }),
        Err((instance, fault)) => (instance, fault),
    };
    let offset = record.start + text.len() - fault.rest.len();
    damage.push(Damage { offset, instance, message: fault.message });
    let next =
        if begins_record(fault.rest) { Some(text.len() - fault.rest.len()) } else { next_record_line(text) };
    next.map(|at| record.start + at)
}

/// Fills in the record, its end included; gives the text left over, or the damage and the instance it concerns.
fn read<'a>(text: &'a [u8], record: &mut Record) -> Result<&'a [u8], (Option<u64>, Fault<'a>)> {
    record.length = 0;
    let (body_text, id) = head(text).map_err(|error| (None, fault_of(error)))?;
    let (after, keyword_length) = body(body_text).map_err(|error| (Some(id), fault_of(error)))?;
    let Ok(keyword_length) = u16::try_from(keyword_length) else {
        return Err((
            Some(id),
            Fault { rest: body_text, message: "a keyword is longer than 65535 characters" },
        ));
    };
    record.id = id;
    record.keyword_length = keyword_length;
    record.body_at = u16::try_from(text.len() - body_text.len()).unwrap_or(FAR);
    record.length = (text.len() - after.len()) as u32;
    Ok(space(after))
}

/// The fault in nom's wrapping.
pub(crate) fn fault_of<'a>(error: nom::Err<Fault<'a>>) -> Fault<'a> {
    match error {
        nom::Err::Error(fault) | nom::Err::Failure(fault) => fault,
        nom::Err::Incomplete(_) => Fault { rest: &[], message: "the record ends early" },
    }
}
