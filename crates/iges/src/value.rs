//! Parameter values in free format (IGES 5.3 section 2.2.2 and 2.2.3).

use std::borrow::Cow;

use nom::IResult;
use nom::Parser;
use nom::branch::alt;
use nom::bytes::complete::{take, take_while, take_while1};
use nom::character::complete::{one_of, u64 as count};
use nom::combinator::{all_consuming, opt, recognize};

use crate::Delimiters;

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// Nothing between two delimiters: the default that the entity's own description gives.
    Default,
    /// An integer, a pointer or a logical value.
    Integer(i64),
    /// A real; finite or not, as it was written.
    Real(f64),
    /// A Hollerith string.
    Text(&'a [u8]),
    /// None of these.
    Malformed(&'a [u8]),
}

impl<'a> Value<'a> {
    /// The number, also of an integer.
    pub fn real(&self) -> Option<f64> {
        match *self {
            Self::Integer(value) => Some(value as f64),
            Self::Real(value) => Some(value),
            _ => None,
        }
    }

    /// The integer; also a real that is one, as some writers have it.
    pub fn integer(&self) -> Option<i64> {
        match *self {
            Self::Integer(value) => Some(value),
            Self::Real(value) if value.fract() == 0.0 && value.abs() < 1e15 => Some(value as i64),
            _ => None,
        }
    }

    /// The string, as UTF-8 or else as Latin-1.
    pub fn text(&self) -> Option<Cow<'a, str>> {
        match *self {
            Self::Text(bytes) => Some(decode(bytes)),
            _ => None,
        }
    }
}

/// Bytes as UTF-8 or else as Latin-1.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    }
}

/// What comes after a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    Parameter,
    RecordEnd,
    TextEnd,
}

/// The next parameter, what ends it, and the text after that.
pub(crate) fn next(text: &[u8], delimiters: Delimiters) -> (Value<'_>, After, &[u8]) {
    let (value, rest) = match hollerith(text) {
        Ok((rest, string)) => (Some(Value::Text(string)), rest),
        Err(_) => (None, text),
    };
    let is_end = |b: &u8| *b == delimiters.parameter || *b == delimiters.record;
    let end = rest.iter().position(is_end).unwrap_or(rest.len());
    let value = value.unwrap_or_else(|| plain(&rest[..end]));
    match rest.get(end) {
        Some(b) if *b == delimiters.parameter => (value, After::Parameter, &rest[end + 1..]),
        Some(_) => (value, After::RecordEnd, &rest[end + 1..]),
        None => (value, After::TextEnd, &[]),
    }
}

/// `nH` and n bytes; fewer where the text ends before.
fn hollerith(text: &[u8]) -> IResult<&[u8], &[u8]> {
    let (rest, (_, length, _)) = (take_while(blank), count, one_of("Hh")).parse(text)?;
    let length = usize::try_from(length).unwrap_or(usize::MAX).min(rest.len());
    take(length).parse(rest)
}

/// A value that is no string.
fn plain(text: &[u8]) -> Value<'_> {
    let text = text.trim_ascii();
    if text.is_empty() {
        return Value::Default;
    }
    if let Ok(number) = std::str::from_utf8(text) {
        if let Ok(value) = number.parse() {
            return Value::Integer(value);
        }
        if all_consuming(real).parse(text).is_ok()
            && let Ok(value) = number.replace(['d', 'D'], "e").parse()
        {
            return Value::Real(value);
        }
    }
    Value::Malformed(text)
}

fn real(text: &[u8]) -> IResult<&[u8], &[u8]> {
    let digits = || take_while1(|b: u8| b.is_ascii_digit());
    let fraction = || (one_of("."), take_while(|b: u8| b.is_ascii_digit()));
    let mantissa = alt((recognize((digits(), opt(fraction()))), recognize((one_of("."), digits()))));
    let exponent = (one_of("eEdD"), opt(one_of("+-")), digits());
    recognize((opt(one_of("+-")), mantissa, opt(exponent))).parse(text)
}

fn blank(byte: u8) -> bool {
    byte == b' '
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<Value<'_>> {
        let mut rest = text.as_bytes();
        let mut out = Vec::new();
        loop {
            let (value, after, then) = next(rest, Delimiters::default());
            out.push(value);
            if after != After::Parameter {
                return out;
            }
            rest = then;
        }
    }

    #[test]
    fn every_kind_of_number() {
        let found = values("1,-7,+3, 1.5 ,.5,1.,-1.25E-2,2.5D1,1d+2,3E4;");
        let reals = found.iter().map(|v| v.real().unwrap()).collect::<Vec<_>>();
        assert_eq!(reals, [1.0, -7.0, 3.0, 1.5, 0.5, 1.0, -0.0125, 25.0, 100.0, 30000.0]);
        assert_eq!(found[1], Value::Integer(-7));
    }

    #[test]
    fn strings_may_hold_delimiters_and_defaults_are_empty() {
        let found = values("3Ha,;,,  5Hfive!,0H;");
        assert_eq!(found, [Value::Text(b"a,;"), Value::Default, Value::Text(b"five!"), Value::Text(b"")]);
    }

    #[test]
    fn nonsense_is_malformed_and_goes_no_further_than_its_delimiter() {
        let found = values("NaN,1.2.3,e5,--1,4;");
        assert!(found[..4].iter().all(|v| matches!(v, Value::Malformed(_))), "{found:?}");
        assert_eq!(found[4], Value::Integer(4));
    }

    #[test]
    fn a_string_that_claims_more_than_there_is_ends_with_the_text() {
        assert_eq!(values("99999999999999999999Habc"), [Value::Malformed(b"99999999999999999999Habc")]);
        assert_eq!(values("4000000000Habc"), [Value::Text(b"abc")]);
    }
}
