//! Parameters, parsed when they are asked for.

use crate::Text;
use crate::grammar::{Atom, atom, skip_list, space};
use crate::instance::ascii;
use std::fmt;

/// A run of parameters, parsed as it is iterated. Cheap to copy: iterating a copy starts anew.
///
/// Damaged text ends the run (validation has reported it).
#[derive(Clone, Copy)]
pub struct Args<'a> {
    /// The next parameter or the comma before it, and everything after it up to the end of the record: the run ends
    /// at the first `)` that it did not open.
    rest: &'a [u8],
    /// `rest` starts with the contents of the list that was given last. It is skipped only if more is asked for.
    in_list: bool,
}

impl<'a> Args<'a> {
    /// Starts after an opening parenthesis.
    pub(crate) fn new(rest: &'a [u8]) -> Self {
        Args { rest, in_list: false }
    }

    fn next_atom(&mut self) -> Option<Atom<'a>> {
        if self.in_list {
            self.rest = skip_list(self.rest);
            self.in_list = false;
        }
        let mut rest = space(self.rest);
        if let [b',', tail @ ..] = rest {
            rest = tail;
        }
        match atom(rest) {
            Ok((after, atom)) => {
                self.rest = after;
                self.in_list = matches!(atom, Atom::Open | Atom::OpenTyped(_));
                Some(atom)
            }
            Err(_) => {
                self.rest = &[];
                None
            }
        }
    }
}

impl<'a> Iterator for Args<'a> {
    type Item = Param<'a>;

    fn next(&mut self) -> Option<Param<'a>> {
        let atom = self.next_atom()?;
        Some(match atom {
            Atom::Omitted => Param::Omitted,
            Atom::Derived => Param::Derived,
            Atom::Integer(literal) => Param::Integer(integer(literal)),
            Atom::Real(literal) => Param::Real(real(literal)),
            Atom::String(inside) => Param::String(Text(inside)),
            Atom::Enumeration(name) => Param::Enumeration(ascii(name)),
            Atom::Binary(digits) => Param::Binary(ascii(digits)),
            Atom::Reference(id) => Param::Reference(id),
            Atom::Other(name) => Param::Other(ascii(name)),
            Atom::Open => Param::List(Args::new(self.rest)),
            Atom::OpenTyped(name) => Param::Typed(ascii(name), Args::new(self.rest)),
        })
    }

    fn nth(&mut self, n: usize) -> Option<Param<'a>> {
        for _ in 0..n {
            self.next_atom()?;
        }
        self.next()
    }

    fn count(mut self) -> usize {
        std::iter::from_fn(|| self.next_atom()).count()
    }
}

impl std::iter::FusedIterator for Args<'_> {}

impl fmt::Debug for Args<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(*self).finish()
    }
}

/// One parameter.
#[derive(Clone, Copy, Debug)]
pub enum Param<'a> {
    /// `$`
    Omitted,
    /// `*`
    Derived,
    /// An integer (saturated to the range of i64).
    Integer(i64),
    /// A real; also tolerated forms such as `1E5`, `.5`, `1.0D3`. Never a NaN, but infinite where the literal is too
    /// large for an f64.
    Real(f64),
    /// A string, still escaped; see [`Text::decode`].
    String(Text<'a>),
    /// `.NAME.` without the dots.
    Enumeration(&'a str),
    /// `"..."` without the quotes: hexadecimal digits.
    Binary(&'a str),
    /// `#12`
    Reference(u64),
    /// `@12`, `#NAME`, `@NAME`: value and constant references of edition 3, and `<uri>` in an anchor.
    Other(&'a str),
    /// `( ... )`
    List(Args<'a>),
    /// `KEYWORD( ... )`
    Typed(&'a str, Args<'a>),
}

fn integer(literal: &[u8]) -> i64 {
    let (negative, digits) = match literal {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    let add = |value: i64, digit: &u8| {
        let digit = i64::from(digit - b'0');
        let tenfold = value.checked_mul(10)?;
        if negative { tenfold.checked_sub(digit) } else { tenfold.checked_add(digit) }
    };
    digits.iter().try_fold(0, add).unwrap_or(if negative { i64::MIN } else { i64::MAX })
}

fn real(literal: &[u8]) -> f64 {
    let literal = ascii(literal);
    literal.parse().unwrap_or_else(|_| {
        // FORTRAN's exponent, the one form of the grammar that Rust does not know.
        literal.replace(['d', 'D'], "e").parse().unwrap_or_default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_saturate() {
        assert_eq!(integer(b"-9223372036854775808"), i64::MIN);
        assert_eq!(integer(b"-9223372036854775809"), i64::MIN);
        assert_eq!(integer(b"+9223372036854775807"), i64::MAX);
        assert_eq!(integer(b"99999999999999999999999"), i64::MAX);
        assert_eq!(integer(b"007"), 7);
    }

    #[test]
    fn reals_are_correctly_rounded_in_every_form_that_is_accepted() {
        assert_eq!(real(b"0.1"), 0.1);
        assert_eq!(real(b"1."), 1.0);
        assert_eq!(real(b".5"), 0.5);
        assert_eq!(real(b"+1.E-07"), 1e-7);
        assert_eq!(real(b"-1.5D3"), -1500.0);
        assert_eq!(real(b"1e5"), 1e5);
        assert_eq!(real(b"179769313486231570000.E+288"), f64::MAX);
        assert_eq!(real(b"1.E400"), f64::INFINITY);
    }
}
