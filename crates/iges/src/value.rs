//! Parameter values in free format (IGES 5.3 section 2.2.2 and 2.2.3).

use std::borrow::Cow;
use std::ops::Range;

use memchr::memchr2;
use nom::IResult;
use nom::Parser;
use nom::bytes::complete::take_while;
use nom::character::complete::{one_of, u64 as count};

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
    if let Some((value, end)) = usual_number(text) {
        match text.get(end) {
            Some(b) if *b == delimiters.parameter => return (value, After::Parameter, &text[end + 1..]),
            Some(b) if *b == delimiters.record => return (value, After::RecordEnd, &text[end + 1..]),
            _ => {}
        }
    }
    let string = hollerith(text).map(|string| mended(text, string, delimiters));
    let rest = &text[string.as_ref().map_or(0, |string| string.end)..];
    let end = memchr2(delimiters.parameter, delimiters.record, rest).unwrap_or(rest.len());
    let value = string.map_or_else(|| plain(&rest[..end]), |string| Value::Text(&text[string]));
    match rest.get(end) {
        Some(b) if *b == delimiters.parameter => (value, After::Parameter, &rest[end + 1..]),
        Some(_) => (value, After::RecordEnd, &rest[end + 1..]),
        None => (value, After::TextEnd, &[]),
    }
}

/// Where the n bytes after `nH` lie; fewer where the text ends before.
fn hollerith(text: &[u8]) -> Option<Range<usize>> {
    // Few values are strings: those without an H are none.
    let mark = text.iter().position(|b| !b.is_ascii_digit() && *b != b' ')?;
    if !matches!(text[mark], b'H' | b'h') {
        return None;
    }
    let counted: IResult<&[u8], _> = (take_while(blank), count, one_of("Hh")).parse(text);
    let (rest, (_, length, _)) = counted.ok()?;
    let start = text.len() - rest.len();
    Some(start..start + usize::try_from(length).unwrap_or(usize::MAX).min(rest.len()))
}

/// Where a string lies whose count may be wrong, which shows where more than blanks stand between it and the next
/// delimiter: it ends at the last delimiter that it holds with nothing but blanks behind it, or else at the next one.
fn mended(text: &[u8], string: Range<usize>, delimiters: Delimiters) -> Range<usize> {
    let rest = &text[string.end..];
    let end = memchr2(delimiters.parameter, delimiters.record, rest).unwrap_or(rest.len());
    if rest[..end].iter().all(u8::is_ascii_whitespace) {
        return string;
    }
    let is_delimiter = |b: &u8| *b == delimiters.parameter || *b == delimiters.record;
    let held = &text[string.clone()];
    match held.iter().rposition(is_delimiter) {
        Some(at) if held[at + 1..].iter().all(|b| *b == b' ') => string.start..string.start + at,
        Some(_) => string,
        None => string.start..string.end + end,
    }
}

/// A value that is no string.
fn plain(text: &[u8]) -> Value<'_> {
    let text = text.trim_ascii();
    if text.is_empty() {
        return Value::Default;
    }
    number(text).unwrap_or(Value::Malformed(text))
}

/// An integer or a real, its exponent after an E or a D.
fn number(text: &[u8]) -> Option<Value<'_>> {
    let number = std::str::from_utf8(text).ok()?;
    let digits = number.trim_start_matches(['+', '-']);
    // Words that are numbers elsewhere (infinity) are none here.
    if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    if digits.len() < 19 && digits.bytes().all(|b| b.is_ascii_digit()) {
        return number.parse().ok().map(Value::Integer);
    }
    match number.find(['d', 'D']) {
        None => number.parse().ok().map(Value::Real),
        Some(_) => number.replace(['d', 'D'], "e").parse().ok().map(Value::Real),
    }
}

/// A number of no more than 19 digits that needs no rounding but the last one, which is the usual case (Clinger's fast
/// path: an integer below 2^53 times or by a power of ten up to 10^22 is rounded once), and where it ends.
#[inline]
fn usual_number(text: &[u8]) -> Option<(Value<'static>, usize)> {
    const POWERS: [f64; 23] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
        1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    let digit = |at: usize| text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10);
    let mut at = text.iter().position(|b| *b != b' ')?;
    let negative = text[at] == b'-';
    at += usize::from(negative || text[at] == b'+');
    let (first, mut mantissa) = (at, 0u64);
    while let Some(d) = digit(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(d));
        at += 1;
    }
    let mut digits = at - first;
    let is_real = text.get(at) == Some(&b'.');
    let mut exponent = 0i32;
    if is_real {
        at += 1;
        let point = at;
        while let Some(d) = digit(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(d));
            at += 1;
        }
        digits += at - point;
        exponent = -i32::try_from(at - point).ok()?;
    }
    if digits == 0 || digits > 19 || mantissa > 1 << 53 {
        return None;
    }
    if let Some(b'E' | b'e' | b'D' | b'd') = text.get(at) {
        at += 1;
        let falls = text.get(at) == Some(&b'-');
        at += usize::from(falls || text.get(at) == Some(&b'+'));
        let (start, mut value) = (at, 0i32);
        while let Some(d) = digit(at).filter(|_| at < start + 4) {
            value = value * 10 + i32::from(d);
            at += 1;
        }
        if at == start {
            return None;
        }
        exponent += if falls { -value } else { value };
    } else if !is_real {
        let value = i64::try_from(mantissa).ok()?;
        return Some((Value::Integer(if negative { -value } else { value }), at));
    }
    let power = POWERS.get(exponent.unsigned_abs() as usize)?;
    let size = if exponent < 0 { mantissa as f64 / power } else { mantissa as f64 * power };
    Some((Value::Real(if negative { -size } else { size }), at))
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
    fn the_fast_way_reads_what_the_slow_one_does() {
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state >> 33
        };
        for _ in 0..20_000 {
            let whole = random() % 10u64.pow((random() % 10) as u32);
            let part = random() % 10u64.pow((random() % 10) as u32);
            let sign = ["", "-", "+"][(random() % 3) as usize];
            let end = match random() % 4 {
                0 => String::new(),
                1 => format!("E{}", random() as i64 % 30 - 15),
                2 => format!("D+{:02}", random() % 30),
                _ => format!("e-{:03}", random() % 30),
            };
            for text in [
                format!("{sign}{whole}.{part}{end}"),
                format!("{sign}.{part}{end}"),
                format!("{sign}{whole}.{end}"),
            ] {
                let listed = format!("{text},1;");
                assert_eq!(values(&listed).first().cloned(), number(text.as_bytes()), "{text}");
            }
        }
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
    fn a_string_whose_count_is_wrong_goes_to_its_delimiter() {
        let found = values("30HC:\\part.igs,                        26Hx,1;");
        assert_eq!(found[0], Value::Text(b"C:\\part.igs"), "too long a count");
        assert_eq!(
            values("3Hhello,1;")[..2],
            [Value::Text(b"hello"), Value::Integer(1)],
            "too short a count"
        );
        assert_eq!(values("3Ha,b ,1;"), [Value::Text(b"a,b"), Value::Integer(1)], "a right one");
    }

    #[test]
    fn a_string_that_claims_more_than_there_is_ends_with_the_text() {
        assert_eq!(values("99999999999999999999Habc"), [Value::Malformed(b"99999999999999999999Habc")]);
        assert_eq!(values("4000000000Habc"), [Value::Text(b"abc")]);
    }
}
