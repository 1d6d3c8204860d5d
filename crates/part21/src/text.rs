//! Strings and their escapes (ISO 10303-21 §6.4.3).

use encoding_rs::{Encoding, ISO_8859_2, ISO_8859_3, ISO_8859_4, ISO_8859_5, ISO_8859_6, ISO_8859_7};
use encoding_rs::{ISO_8859_8, WINDOWS_1252, WINDOWS_1254};
use std::borrow::Cow;
use std::fmt;

/// The inside of a string literal, still escaped.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Text<'a>(pub &'a [u8]);

impl<'a> Text<'a> {
    /// The string, escapes resolved (`\X\ \X2\ \X4\ \S\ \P.\ '' \\`), raw bytes taken as UTF-8 where valid, else as
    /// Latin-1.
    ///
    /// Line ends are left out: writers wrap long strings. What looks like an escape and is none, as in a Windows path
    /// that was not escaped, stays as it is; half a surrogate pair becomes U+FFFD.
    pub fn decode(&self) -> Cow<'a, str> {
        let plain = memchr::memchr3(b'\\', b'\'', b'\n', self.0).is_none() && !self.0.contains(&b'\r');
        match std::str::from_utf8(self.0) {
            Ok(text) if plain => Cow::Borrowed(text),
            _ => Cow::Owned(Decoder { rest: self.0, page: b'A', decoded: String::new() }.run()),
        }
    }
}

impl fmt::Debug for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.decode(), f)
    }
}

struct Decoder<'a> {
    rest: &'a [u8],
    /// `A` to `I`: ISO 8859-1 to -9, set by `\P.\`.
    page: u8,
    decoded: String,
}

impl Decoder<'_> {
    fn run(mut self) -> String {
        self.decoded.reserve(self.rest.len());
        while let Some(&first) = self.rest.first() {
            match first {
                b'\\' => self.escape(),
                b'\'' => {
                    self.decoded.push('\'');
                    self.rest = self.rest.strip_prefix(b"''").unwrap_or(&self.rest[1..]);
                }
                b'\r' | b'\n' => self.rest = &self.rest[1..],
                _ => self.raw(),
            }
        }
        self.decoded
    }

    /// A run of bytes without escapes.
    fn raw(&mut self) {
        let special = |byte: &u8| matches!(byte, b'\\' | b'\'' | b'\r' | b'\n');
        let length = self.rest.iter().position(special).unwrap_or(self.rest.len());
        let (run, rest) = self.rest.split_at(length);
        match std::str::from_utf8(run) {
            Ok(text) => self.decoded.push_str(text),
            Err(_) => self.decoded.extend(run.iter().map(|&byte| char::from(byte))),
        }
        self.rest = rest;
    }

    fn escape(&mut self) {
        match self.rest {
            [b'\\', b'\\', rest @ ..] => {
                self.decoded.push('\\');
                self.rest = rest;
            }
            [b'\\', b'S', b'\\', rest @ ..] if !rest.is_empty() => self.upper_half(rest),
            [b'\\', b'P', page @ b'A'..=b'I', b'\\', rest @ ..] => {
                self.page = *page;
                self.rest = rest;
            }
            [b'\\', b'X', b'\\', rest @ ..] => self.one_byte(rest),
            [b'\\', b'X', b'2', b'\\', rest @ ..] => self.utf16(rest),
            [b'\\', b'X', b'4', b'\\', rest @ ..] => self.utf32(rest),
            _ => self.literally(1),
        }
    }

    /// `\S\c`: the character 80 (hexadecimal) after `c` in the page of ISO 8859.
    fn upper_half(&mut self, rest: &[u8]) {
        let (after, character) = match rest {
            [b'\'', b'\'', after @ ..] => (after, b'\''),
            [b'\\', b'\\', after @ ..] => (after, b'\\'),
            [character @ b' '..=b'~', after @ ..] => (after, *character),
            _ => return self.literally(3),
        };
        let skipped = self.rest.len() - after.len();
        let byte = [character | 0x80];
        let (character, _) = encoding(self.page).decode_without_bom_handling(&byte);
        self.decoded.push_str(&character);
        self.rest = &self.rest[skipped..];
    }

    /// `\X\hh`: a character of ISO 8859-1.
    fn one_byte(&mut self, rest: &[u8]) {
        match hexadecimal(rest, 2).and_then(char::from_u32) {
            Some(character) => {
                self.decoded.push(character);
                self.rest = &self.rest[5..];
            }
            None => self.literally(3),
        }
    }

    /// `\X2\hhhh...\X0\`: UTF-16, since writers put surrogates there too.
    fn utf16(&mut self, rest: &[u8]) {
        let units: Vec<u16> =
            rest.chunks(4).map_while(|digits| hexadecimal(digits, 4)).map(|unit| unit as u16).collect();
        let characters = char::decode_utf16(units.iter().copied());
        self.decoded.extend(characters.map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER)));
        self.after_run(4 + 4 * units.len());
    }

    /// `\X4\hhhhhhhh...\X0\`: UTF-32.
    fn utf32(&mut self, rest: &[u8]) {
        let mut length = 4;
        for point in rest.chunks(8).map_while(|digits| hexadecimal(digits, 8)) {
            self.decoded.push(char::from_u32(point).unwrap_or(char::REPLACEMENT_CHARACTER));
            length += 8;
        }
        self.after_run(length);
    }

    /// After `length` bytes of `\X2\` or `\X4\` with its digits: `\X0\`, tolerated if missing.
    fn after_run(&mut self, length: usize) {
        if length == 4 && !self.rest[4..].starts_with(b"\\X0\\") {
            return self.literally(4);
        }
        let rest = &self.rest[length..];
        self.rest = rest.strip_prefix(b"\\X0\\").unwrap_or(rest);
    }

    fn literally(&mut self, length: usize) {
        let (taken, rest) = self.rest.split_at(length);
        self.decoded.extend(taken.iter().map(|&byte| char::from(byte)));
        self.rest = rest;
    }
}

/// The value of the first `count` bytes, if they are all there and hexadecimal digits.
fn hexadecimal(digits: &[u8], count: usize) -> Option<u32> {
    let digits = digits.get(..count)?;
    digits.iter().try_fold(0, |value, &digit| Some(value << 4 | char::from(digit).to_digit(16)?))
}

/// ISO 8859-1 to -9 as the web knows them: its names for -1 and -9 are two Windows pages, the same from A0 up.
fn encoding(page: u8) -> &'static Encoding {
    match page {
        b'B' => ISO_8859_2,
        b'C' => ISO_8859_3,
        b'D' => ISO_8859_4,
        b'E' => ISO_8859_5,
        b'F' => ISO_8859_6,
        b'G' => ISO_8859_7,
        b'H' => ISO_8859_8,
        b'I' => WINDOWS_1254,
        _ => WINDOWS_1252,
    }
}
