//! Lines and their sections (IGES 5.3 section 2.2.1): letters in column 73, whatever else is wrong with a line.

use std::fmt;

use crate::ReadError;

/// A section of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Section {
    /// A line of the compressed form, or the flag before it.
    Flag,
    /// A prologue for people.
    Start,
    /// What holds for the whole file.
    Global,
    /// Two lines for each entity.
    Directory,
    /// The entities' parameters.
    Parameter,
    /// How many lines the others have.
    Terminate,
}

impl Section {
    fn of(letter: u8) -> Option<Self> {
        Some(match letter.to_ascii_uppercase() {
            b'C' => Self::Flag,
            b'S' => Self::Start,
            b'G' => Self::Global,
            b'D' => Self::Directory,
            b'P' => Self::Parameter,
            b'T' => Self::Terminate,
            _ => return None,
        })
    }
}

impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Flag => "Flag",
            Self::Start => "Start",
            Self::Global => "Global",
            Self::Directory => "Directory",
            Self::Parameter => "Parameter",
            Self::Terminate => "Terminate",
        })
    }
}

/// Columns before the section letter.
pub(crate) const WIDTH: usize = 72;

/// A line that belongs to a section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Line {
    pub section: Section,
    /// The first 72 columns, padded with blanks where the line is shorter.
    pub text: Vec<u8>,
    /// From 1.
    pub number: usize,
    /// The number after the section letter, where there is one.
    pub sequence: Option<u32>,
}

/// The lines of a file, and the numbers of those that belong to no section.
pub(crate) fn lines(bytes: &[u8]) -> Result<(Vec<Line>, Vec<usize>), ReadError> {
    if bytes.iter().all(|b| b.is_ascii_whitespace() || *b == 0) {
        return Err(ReadError::Empty);
    }
    if looks_binary(bytes) {
        return Err(ReadError::Binary);
    }
    let mut out = Vec::new();
    let mut strays = Vec::new();
    for (index, raw) in split(bytes).enumerate() {
        let number = index + 1;
        if raw.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        match line(raw, number, out.last()) {
            Some(line) => out.push(line),
            None => strays.push(number),
        }
        if out.is_empty() && strays.len() > 50 {
            break;
        }
    }
    if out.iter().any(|line| matches!(line.section, Section::Directory | Section::Flag)) {
        return Ok((out, strays));
    }
    Err(ReadError::NotIges(if out.is_empty() {
        "no line has a section letter in column 73"
    } else {
        "it has no Directory section"
    }))
}

/// A flag line whose first byte is B, followed by the lengths of the binary form.
fn looks_binary(bytes: &[u8]) -> bool {
    bytes.first() == Some(&b'B') && bytes.iter().take(80).any(|b| *b < b' ' && !b.is_ascii_whitespace())
}

/// Lines that end with LF, CR or both; records of 80 bytes where nothing ends a line.
fn split(bytes: &[u8]) -> Box<dyn Iterator<Item = &[u8]> + '_> {
    let ends = memchr::memchr2(b'\n', b'\r', bytes).is_some_and(|at| at < 2000);
    if !ends && bytes.len() > 2 * 80 {
        return Box::new(bytes.chunks(80));
    }
    let mut rest = bytes;
    Box::new(std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let end = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let (line, after) = rest.split_at(end);
        rest = match after {
            [b'\r', b'\n', after @ ..] | [b'\r' | b'\n', after @ ..] => after,
            _ => &[],
        };
        Some(line)
    }))
}

/// A line by its section letter: in column 73, else where blanks or bytes that were lost have moved it.
fn line(raw: &[u8], number: usize, last: Option<&Line>) -> Option<Line> {
    let expanded = expand_tabs(raw);
    let at = letter_column(&expanded, last)?;
    let section = Section::of(*expanded.get(at)?)?;
    let mut text = expanded[..at].to_vec();
    text.resize(WIDTH, b' ');
    let sequence = std::str::from_utf8(expanded.get(at + 1..).unwrap_or_default()).ok();
    let sequence = sequence.and_then(|s| s.split_whitespace().next()).and_then(|s| s.parse().ok());
    Some(Line { section, text, number, sequence })
}

fn expand_tabs(raw: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(raw.len().max(80));
    for &byte in raw {
        if byte == b'\t' {
            out.resize(out.len() / 8 * 8 + 8, b' ');
        } else {
            out.push(byte);
        }
    }
    out
}

fn letter_column(text: &[u8], last: Option<&Line>) -> Option<usize> {
    let is_letter = |at: usize| {
        let section = text.get(at).copied().and_then(Section::of);
        section.is_some_and(|section| last.is_none_or(|last| section >= last.section))
            && text.get(at + 1..).is_some_and(|rest| rest.iter().all(|b| b.is_ascii_digit() || *b == b' '))
    };
    if is_letter(WIDTH) {
        return Some(WIDTH);
    }
    // A letter before a number at the very end, as in lines that are a few columns short or long.
    let digits = text.iter().rev().skip_while(|b| **b == b' ').take_while(|b| b.is_ascii_digit()).count();
    let trailing = text.iter().rev().take_while(|b| **b == b' ').count();
    let blanks = text.len().checked_sub(trailing + digits)?;
    let at = text[..blanks].iter().rposition(|b| *b != b' ')?;
    (digits > 0 && at.abs_diff(WIDTH) <= 8 && is_letter(at)).then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sections(text: &str) -> Vec<(Section, usize)> {
        let (lines, _) = lines(text.as_bytes()).expect("lines");
        lines.iter().map(|line| (line.section, line.number)).collect()
    }

    fn record(text: &str, letter: char, sequence: u32) -> String {
        format!("{text:<72}{letter}{sequence:>7}")
    }

    #[test]
    fn any_line_end_ends_a_line() {
        let parts = [record("a", 'S', 1), record("b", 'G', 1), record("c", 'D', 1)];
        let expected = [(Section::Start, 1), (Section::Global, 2), (Section::Directory, 3)];
        for end in ["\n", "\r", "\r\n"] {
            assert_eq!(sections(&parts.join(end)), expected, "{end:?}");
        }
        assert_eq!(sections(&parts.concat()), expected, "no line ends");
    }

    #[test]
    fn lower_case_letters_tabs_and_a_column_too_many_are_read() {
        let tabbed = format!("x\t{:<64}d      1", "");
        let long =
            format!("{:<73}P      1", "116,0.,0.,0.;                                                   1");
        let text = [record("", 's', 1), record("", 'g', 1), tabbed, long].join("\n");
        let expected =
            [(Section::Start, 1), (Section::Global, 2), (Section::Directory, 3), (Section::Parameter, 4)];
        assert_eq!(sections(&text), expected);
    }

    #[test]
    fn what_is_not_iges_is_refused_by_name() {
        assert_eq!(lines(b" \r\n"), Err(ReadError::Empty));
        assert_eq!(lines(b"B\x00\x00\x01rest"), Err(ReadError::Binary));
        assert!(matches!(lines(b"ISO-10303-21;\nHEADER;\n"), Err(ReadError::NotIges(_))));
    }
}
