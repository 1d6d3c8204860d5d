//! The grammar of parameters (ISO 10303-21 §6.4, §7 and Annex B), as nom parsers over bytes.
//!
//! Parsers do not recurse: [`parameters`] walks nested lists with a depth count, since files come from strangers.

use crate::fault::Fault;
use crate::scan::{StringEnd, comment_end, string_end};
use nom::branch::alt;
use nom::bytes::complete::{tag, take_while, take_while1};
use nom::character::complete::{digit0, digit1, one_of};
use nom::combinator::{opt, recognize};
use nom::sequence::{delimited, preceded};
use nom::{IResult, Parser};

/// What a parser gives: the text after what it took, and what it made of it.
pub(crate) type Parsed<'a, T> = IResult<&'a [u8], T, Fault<'a>>;

/// Most lists inside one another. Schemas need three or four; a file with more than this is damaged or hostile.
pub(crate) const MAX_NESTING: usize = 64;

/// One parameter, or for a list and a typed parameter only what comes before its contents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Atom<'a> {
    Omitted,
    Derived,
    Integer(&'a [u8]),
    Real(&'a [u8]),
    String(&'a [u8]),
    Enumeration(&'a [u8]),
    Binary(&'a [u8]),
    Reference(u64),
    Other(&'a [u8]),
    /// `(`
    Open,
    /// `KEYWORD(`
    OpenTyped(&'a [u8]),
}

/// Skips white space (with every control character, as the standard asks), comments and print controls.
/// Stays before a comment that is not closed.
#[inline(always)]
pub(crate) fn space(rest: &[u8]) -> &[u8] {
    match rest.first() {
        // Mostly there is none.
        Some(&byte) if byte > b' ' && byte != b'/' && byte != b'\\' => rest,
        _ => skip_space(rest),
    }
}

fn skip_space(mut rest: &[u8]) -> &[u8] {
    loop {
        while let [0..=b' ', tail @ ..] = rest {
            rest = tail;
        }
        match rest {
            [b'/', b'*', ..] => match comment_end(rest, 2) {
                Some(end) => rest = &rest[end..],
                None => return rest,
            },
            [b'\\', b'N' | b'F', b'\\', tail @ ..] => rest = tail,
            _ => return rest,
        }
    }
}

/// A standard or user-defined (`!NAME`) keyword; lower case is tolerated.
#[inline]
pub(crate) fn keyword(input: &[u8]) -> Parsed<'_, &[u8]> {
    match input {
        [b'A'..=b'Z' | b'a'..=b'z' | b'_', ..] => take_while1(is_name).parse(input),
        [b'!', ..] => recognize((tag("!"), take_while1(is_name))).parse(input),
        _ => Fault::at(input, "a keyword is expected"),
    }
}

#[inline]
fn is_name(byte: u8) -> bool {
    IN_NAME[usize::from(byte)]
}

/// Letters, digits and the underscore. Half of a file is keywords and numbers: a look-up is faster than comparisons.
const IN_NAME: [bool; 256] = {
    let mut table = [false; 256];
    let mut byte = 0;
    while byte < 256 {
        table[byte] = (byte as u8).is_ascii_alphanumeric() || byte as u8 == b'_';
        byte += 1;
    }
    table
};

/// One parameter, white space before it skipped.
#[inline(always)]
pub(crate) fn atom(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    atom_here(space(input))
}

/// One parameter. It and what it calls are inlined, for they are most of what checking a file costs.
#[inline(always)]
fn atom_here(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match input {
        [b'#', ..] => reference(input),
        [b'0'..=b'9' | b'+' | b'-', ..] | [b'.', b'0'..=b'9', ..] => number(input),
        [b'\'', ..] => string(input),
        [b'(', rest @ ..] => Ok((rest, Atom::Open)),
        [b'.', ..] => enumeration(input),
        [b'$', rest @ ..] => Ok((rest, Atom::Omitted)),
        [b'*', rest @ ..] => Ok((rest, Atom::Derived)),
        [b'"', ..] => binary(input),
        [b'<', ..] => resource(input),
        [b'@', ..] => named_reference(input),
        [b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'!', ..] => typed(input),
        [b'/', b'*', ..] => Fault::at(input, "a comment is not closed"),
        [] => Fault::at(input, "the record ends within its parameters"),
        _ => Fault::at(input, "a parameter is expected"),
    }
}

#[inline(always)]
fn reference(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match number_sign(input) {
        Ok((rest, id)) => Ok((rest, Atom::Reference(id))),
        Err(error) if input.get(1).is_some_and(u8::is_ascii_digit) => Err(error),
        Err(_) => named_reference(input),
    }
}

/// `#12`: the number of an instance.
#[inline(always)]
fn number_sign(input: &[u8]) -> Parsed<'_, u64> {
    preceded(tag("#"), instance_number).parse(input)
}

/// The digits of an instance's number.
#[inline(always)]
pub(crate) fn instance_number(input: &[u8]) -> Parsed<'_, u64> {
    let (rest, digits) = digit1.parse(input)?;
    let value = |digit: &u8| u64::from(digit - b'0');
    if digits.len() <= 19 {
        return Ok((rest, digits.iter().fold(0, |id, digit| 10 * id + value(digit))));
    }
    let id = digits.iter().try_fold(0u64, |id, digit| id.checked_mul(10)?.checked_add(value(digit)));
    id.map_or_else(|| Fault::at(input, "an instance number does not fit into 64 bits"), |id| Ok((rest, id)))
}

/// `@12`, `@NAME`, `#NAME` of edition 3.
fn named_reference(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match recognize((alt((tag("#"), tag("@"))), take_while1(is_name))).parse(input) {
        Ok((rest, name)) => Ok((rest, Atom::Other(name))),
        Err(error) => fault_over(error, input, "a reference has no name"),
    }
}

/// Integers and reals; tolerated beyond the standard: no digit before or after the point, an exponent without a
/// point, a small `e`, and FORTRAN's `D`.
#[inline(always)]
fn number(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    let (rest, (_, whole)) = (opt(one_of(&b"+-"[..])), digit0).parse(input)?;
    let (rest, fraction) = opt(preceded(tag("."), digit0)).parse(rest)?;
    if whole.is_empty() && fraction.is_none_or(<[u8]>::is_empty) {
        return Fault::at(input, "a number has no digits");
    }
    let (rest, exponent) = opt((one_of(&b"eEdD"[..]), opt(one_of(&b"+-"[..])), digit1)).parse(rest)?;
    let literal = &input[..input.len() - rest.len()];
    let is_integer = fraction.is_none() && exponent.is_none();
    Ok((rest, if is_integer { Atom::Integer(literal) } else { Atom::Real(literal) }))
}

#[inline(always)]
fn string(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match string_end(input, 1) {
        StringEnd::Closed(end) => Ok((&input[end + 1..], Atom::String(&input[1..end]))),
        StringEnd::Open(_) => Fault::at(input, "a string is not closed"),
    }
}

fn enumeration(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match delimited(tag("."), take_while1(is_name), tag(".")).parse(input) {
        Ok((rest, name)) => Ok((rest, Atom::Enumeration(name))),
        Err(error) => fault_over(error, input, "an enumeration is not written as .NAME."),
    }
}

fn binary(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    match delimited(tag("\""), take_while(|byte: u8| byte.is_ascii_hexdigit()), tag("\"")).parse(input) {
        Ok((rest, digits)) => Ok((rest, Atom::Binary(digits))),
        Err(error) => fault_over(error, input, "a binary is not hexadecimal digits between quotation marks"),
    }
}

/// `<uri>`, which only the ANCHOR section has.
fn resource(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    let in_uri = |byte: u8| byte != b'>' && byte > b' ';
    match recognize(delimited(tag("<"), take_while(in_uri), tag(">"))).parse(input) {
        Ok((rest, uri)) => Ok((rest, Atom::Other(uri))),
        Err(error) => fault_over(error, input, "a resource is not written as <uri>"),
    }
}

fn typed(input: &[u8]) -> Parsed<'_, Atom<'_>> {
    let (rest, name) = keyword(input)?;
    match space(rest) {
        [b'(', rest @ ..] => Ok((rest, Atom::OpenTyped(name))),
        _ => Fault::at(input, "a type name has no parameter in parentheses"),
    }
}

/// A combinator's nameless error as a fault with a message.
fn fault_over<'a, T>(_: nom::Err<Fault<'a>>, rest: &'a [u8], message: &'static str) -> Parsed<'a, T> {
    Fault::at(rest, message)
}

/// What may come next in a parameter list.
enum Expected {
    /// A parameter or, the list being empty, its end.
    FirstOrEnd,
    Parameter,
    CommaOrEnd,
}

/// A parameter list from after its `(` up to and with its `)`, only checked.
pub(crate) fn parameters(mut rest: &[u8]) -> Parsed<'_, ()> {
    let mut depth = 1;
    let mut expected = Expected::FirstOrEnd;
    loop {
        rest = space(rest);
        (rest, expected) = match (expected, rest) {
            (Expected::FirstOrEnd | Expected::CommaOrEnd, [b')', tail @ ..]) => {
                depth -= 1;
                if depth == 0 {
                    return Ok((tail, ()));
                }
                (tail, Expected::CommaOrEnd)
            }
            (Expected::CommaOrEnd, [b',', tail @ ..]) => (tail, Expected::Parameter),
            (Expected::CommaOrEnd, _) => return missing_comma(rest),
            _ => match atom_here(rest)? {
                (_, Atom::Open | Atom::OpenTyped(_)) if depth == MAX_NESTING => {
                    return Fault::at(rest, "lists are nested deeper than 64 levels");
                }
                (tail, Atom::Open | Atom::OpenTyped(_)) => {
                    depth += 1;
                    (tail, Expected::FirstOrEnd)
                }
                (tail, _) => (tail, Expected::CommaOrEnd),
            },
        }
    }
}

fn missing_comma<'a, T>(rest: &'a [u8]) -> Parsed<'a, T> {
    match rest {
        [b'/', b'*', ..] => Fault::at(rest, "a comment is not closed"),
        [] => Fault::at(rest, "the record ends within its parameters"),
        _ => Fault::at(rest, "a comma or a closing parenthesis is expected"),
    }
}

/// The text after the `)` that closes the list whose contents start at `rest`; only strings and comments are looked
/// at, so this is for text that [`parameters`] has checked.
pub(crate) fn skip_list(mut rest: &[u8]) -> &[u8] {
    let mut depth = 1;
    while let Some(at) = rest.iter().position(|&byte| matches!(byte, b'(' | b')' | b'\'' | b'/')) {
        let end = match rest[at] {
            b'\'' => match string_end(rest, at + 1) {
                StringEnd::Closed(end) => Some(end + 1),
                StringEnd::Open(_) => None,
            },
            b'/' if rest.get(at + 1) == Some(&b'*') => comment_end(rest, at + 2),
            b'(' => {
                depth += 1;
                Some(at + 1)
            }
            b')' => {
                depth -= 1;
                if depth == 0 {
                    return &rest[at + 1..];
                }
                Some(at + 1)
            }
            _ => Some(at + 1),
        };
        match end {
            Some(end) => rest = &rest[end..],
            None => return &[],
        }
    }
    &[]
}
