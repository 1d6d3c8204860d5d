//! An entity: its directory entry, and its parameters when they are asked for.

use crate::value::{After, Value, next};
use crate::{Delimiters, DirectoryEntry};

/// An entity of a file.
#[derive(Clone, Copy, Debug)]
pub struct Entity<'a> {
    /// What the directory says.
    pub directory: &'a DirectoryEntry,
    pub(crate) text: &'a [u8],
    pub(crate) delimiters: Delimiters,
}

impl<'a> Entity<'a> {
    /// How long the text of its parameters is.
    pub fn bytes(&self) -> usize {
        self.text.len()
    }

    /// All its parameters; the first is its type once more.
    pub fn values(&self) -> Values<'a> {
        Values { rest: Some(self.text), delimiters: self.delimiters }
    }
}

/// The parameters of an entity, one after the other.
#[derive(Clone, Debug)]
pub struct Values<'a> {
    rest: Option<&'a [u8]>,
    delimiters: Delimiters,
}

impl<'a> Iterator for Values<'a> {
    type Item = Value<'a>;

    fn next(&mut self) -> Option<Value<'a>> {
        let (value, after, rest) = next(self.rest?, self.delimiters);
        self.rest = (after == After::Parameter).then_some(rest);
        if after == After::TextEnd && value == Value::Default {
            return None;
        }
        Some(value)
    }
}
