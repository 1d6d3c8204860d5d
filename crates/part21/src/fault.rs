//! Damage found while parsing, before line and column are known.

use nom::error::{ErrorKind, ParseError};

/// Why the grammar does not match, and the text from there on. Kept to three words: nom makes one for every
/// alternative it tries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fault<'a> {
    pub rest: &'a [u8],
    pub message: &'static str,
}

impl<'a> Fault<'a> {
    /// The fault as nom wants to have it returned.
    pub fn at<T>(rest: &'a [u8], message: &'static str) -> Result<T, nom::Err<Self>> {
        Err(nom::Err::Error(Fault { rest, message }))
    }

    /// The fault out of nom's wrapping.
    pub fn of(error: nom::Err<Self>) -> Self {
        match error {
            nom::Err::Error(fault) | nom::Err::Failure(fault) => fault,
            nom::Err::Incomplete(_) => Fault { rest: &[], message: "the record ends early" },
        }
    }
}

impl<'a> ParseError<&'a [u8]> for Fault<'a> {
    fn from_error_kind(rest: &'a [u8], _: ErrorKind) -> Self {
        Fault { rest, message: "unexpected text" }
    }

    fn append(_: &'a [u8], _: ErrorKind, other: Self) -> Self {
        other
    }
}

/// A fault with its byte offset in the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Damage {
    pub offset: usize,
    pub instance: Option<u64>,
    pub message: &'static str,
}

/// Damage in the order it was found, up to a limit; beyond it is only counted.
#[derive(Debug)]
pub(crate) struct DamageList {
    kept: Vec<Damage>,
    limit: usize,
    left_out: usize,
}

impl DamageList {
    pub fn new(limit: usize) -> Self {
        DamageList { kept: Vec::new(), limit, left_out: 0 }
    }

    pub fn push(&mut self, damage: Damage) {
        if self.kept.len() < self.limit {
            self.kept.push(damage);
        } else {
            self.left_out += 1;
        }
    }

    pub fn limit(&self) -> usize {
        self.limit
    }

    pub fn append(&mut self, other: DamageList) {
        self.left_out += other.left_out;
        other.kept.into_iter().for_each(|damage| self.push(damage));
    }

    /// In file order, and how many there are beyond those.
    pub fn into_sorted(mut self) -> (Vec<Damage>, usize) {
        self.kept.sort_by_key(|damage| damage.offset);
        (self.kept, self.left_out)
    }
}
