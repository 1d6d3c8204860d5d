//! The ANCHOR and REFERENCE sections of edition 3.

use crate::grammar::{Atom, atom, parameters, space};
use crate::instance::ascii;
use crate::{Args, Param};
use std::ops::Range;

/// `<name> = item;`: a name under which other files know something in this one.
#[derive(Clone, Copy, Debug)]
pub struct Anchor<'a> {
    /// The URI fragment, without `<` and `>`.
    pub name: &'a str,
    /// What it names, most often a [`Param::Reference`].
    pub item: Param<'a>,
}

/// `#12 = <uri>;`: something in another file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExternalReference<'a> {
    /// `#12`, `@12` and the like.
    pub name: &'a str,
    /// Where it is, without `<` and `>`.
    pub uri: &'a str,
}

/// A name and what it is for, as offsets in the file.
#[derive(Debug)]
pub(crate) struct Entry {
    name: Range<usize>,
    value: Range<usize>,
}

impl Entry {
    /// A statement of the ANCHOR section, checked. Tags after the item (`{name: value}`) are ignored.
    pub fn anchor(file: &[u8], start: usize, end: usize) -> Result<Self, &'static str> {
        let expected = "an anchor (<name> = item) is expected";
        let (name, value) = sides(&file[start..end]).ok_or(expected)?;
        if !name.starts_with(b"<") {
            return Err(expected);
        }
        let (rest, item) = atom(value).map_err(|_| expected)?;
        let rest = match item {
            Atom::Open | Atom::OpenTyped(_) => parameters(rest).map_err(|_| expected)?.0,
            _ => rest,
        };
        match space(rest) {
            [] | [b'{', ..] => Ok(Entry::new(start, end, name, value)),
            _ => Err(expected),
        }
    }

    /// A statement of the REFERENCE section, checked.
    pub fn reference(file: &[u8], start: usize, end: usize) -> Result<Self, &'static str> {
        let expected = "a reference (#number = <uri>) is expected";
        let (name, value) = sides(&file[start..end]).ok_or(expected)?;
        match (name, atom(value)) {
            ([b'#' | b'@', ..], Ok((rest, Atom::Other([b'<', ..])))) if space(rest).is_empty() => {
                Ok(Entry::new(start, end, name, value))
            }
            _ => Err(expected),
        }
    }

    /// `name` lies at the start of the statement, `value` at its end.
    fn new(start: usize, end: usize, name: &[u8], value: &[u8]) -> Self {
        Entry { name: start..start + name.len(), value: end - value.len()..end }
    }

    pub fn as_anchor<'a>(&self, file: &'a [u8]) -> Option<Anchor<'a>> {
        let name = ascii(&file[self.name.clone()]).trim_matches(['<', '>']);
        let item = Args::new(&file[self.value.clone()]).next()?;
        Some(Anchor { name, item })
    }

    pub fn as_reference<'a>(&self, file: &'a [u8]) -> ExternalReference<'a> {
        let uri = ascii(file[self.value.clone()].trim_ascii()).trim_matches(['<', '>']);
        ExternalReference { name: ascii(&file[self.name.clone()]), uri }
    }
}

/// What is left and right of the equals sign; none of the two begins with white space, the left does not end with it.
fn sides(statement: &[u8]) -> Option<(&[u8], &[u8])> {
    let (rest, left) = match atom(statement).ok()? {
        (rest, Atom::Other(_) | Atom::Reference(_)) => (rest, &statement[..statement.len() - rest.len()]),
        _ => return None,
    };
    let value = space(rest).strip_prefix(b"=")?;
    Some((left, space(value)))
}
