//! One entity instance.

use crate::grammar::{keyword, skip_list, space};
use crate::record::Record;
use crate::{Args, Param};
use std::fmt;

/// One instance of the table: `#id = KEYWORD(...)` or `#id = (A(...) B(...))`.
#[derive(Clone, Copy)]
pub struct Instance<'a> {
    text: &'a [u8],
    record: &'a Record,
}

impl<'a> Instance<'a> {
    pub(crate) fn new(text: &'a [u8], record: &'a Record) -> Self {
        Instance { text, record }
    }

    /// The number after `#`.
    pub fn id(&self) -> u64 {
        self.record.id
    }

    /// Keyword of a simple instance, as written (upper case in files that follow the standard); for a complex
    /// instance that of its first part.
    pub fn keyword(&self) -> &'a str {
        let body = self.record.body(self.text);
        match usize::from(self.record.keyword_length) {
            0 => self.parts().next().map_or("", |(keyword, _)| keyword),
            length => ascii(&body[..length]),
        }
    }

    /// Whether it is a complex instance.
    pub fn is_complex(&self) -> bool {
        self.record.keyword_length == 0
    }

    /// The parts: one for a simple instance.
    pub fn parts(&self) -> impl Iterator<Item = (&'a str, Args<'a>)> + use<'a> {
        let body = self.record.body(self.text);
        if self.is_complex() {
            return Parts { only: None, rest: body.get(1..).unwrap_or_default(), in_part: false };
        }
        Parts { only: Some((self.keyword(), self.args())), rest: &[], in_part: false }
    }

    /// Arguments of the (first) part with this keyword, in either case.
    pub fn part(&self, keyword: &str) -> Option<Args<'a>> {
        self.parts().find(|(name, _)| name.eq_ignore_ascii_case(keyword)).map(|(_, args)| args)
    }

    /// Arguments of the first part.
    pub fn args(&self) -> Args<'a> {
        match usize::from(self.record.keyword_length) {
            0 => self.parts().next().map_or(Args::new(&[]), |(_, args)| args),
            length => Args::new(after_parenthesis(&self.record.body(self.text)[length..])),
        }
    }

    /// Byte offset of `#` in the unpacked text (of `ENDSCOPE` in the scope structures of edition 1).
    pub fn offset(&self) -> usize {
        self.record.start
    }

    /// The instance as it is written, without its `;`.
    pub fn text(&self) -> &'a [u8] {
        self.record.text(self.text)
    }

    /// The instances it refers to, in order, repeated as often as they are named.
    pub fn references(&self) -> impl Iterator<Item = u64> + use<'a> {
        self.parts().flat_map(|(_, args)| args.references())
    }
}

impl fmt::Debug for Instance<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&String::from_utf8_lossy(self.text()))
    }
}

/// Walks over `KEYWORD(...)`s.
#[derive(Clone)]
struct Parts<'a> {
    /// The part of a simple instance, which need not be looked for.
    only: Option<(&'a str, Args<'a>)>,
    rest: &'a [u8],
    /// `rest` is after the `(` of the part that was given last.
    in_part: bool,
}

impl<'a> Iterator for Parts<'a> {
    type Item = (&'a str, Args<'a>);

    fn next(&mut self) -> Option<Self::Item> {
        if self.only.is_some() {
            return self.only.take();
        }
        if self.in_part {
            self.rest = skip_list(self.rest);
        }
        let (rest, name) = keyword(space(self.rest)).ok()?;
        self.rest = after_parenthesis(rest);
        self.in_part = true;
        Some((ascii(name), Args::new(self.rest)))
    }
}

/// The text after the next opening parenthesis, which is all that may be there.
fn after_parenthesis(text: &[u8]) -> &[u8] {
    space(text).get(1..).unwrap_or_default()
}

/// Text that the grammar lets consist of ASCII only.
pub(crate) fn ascii(text: &[u8]) -> &str {
    std::str::from_utf8(text).unwrap_or_default()
}

impl<'a> Args<'a> {
    /// The instances referred to here and in nested lists, in order.
    pub fn references(self) -> impl Iterator<Item = u64> + use<'a> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            loop {
                match open.last_mut()?.next() {
                    Some(Param::Reference(id)) => return Some(id),
                    Some(Param::List(list) | Param::Typed(_, list)) => open.push(list),
                    Some(_) => {}
                    None => drop(open.pop()),
                }
            }
        })
    }
}
