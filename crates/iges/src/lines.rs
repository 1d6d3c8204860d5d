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

/// Columns of a Parameter line that hold parameters; the others point back to the directory.
pub(crate) const PARAMETER_WIDTH: usize = 64;

/// Columns of the pointer back.
pub(crate) const BACK_WIDTH: usize = WIDTH - PARAMETER_WIDTH;

/// A line of a section other than Parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Line<'a> {
    pub section: Section,
    /// The first 72 columns, padded with blanks where the line is shorter.
    pub text: &'a [u8],
    /// From 1.
    pub number: usize,
}

/// The lines of a file, each with 72 columns. Those of the Parameter section, which are nearly all, are kept as they are
/// needed: their parameters as one text, and what they point back to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sheet {
    text: Vec<u8>,
    lines: Vec<(Section, usize)>,
    /// [`PARAMETER_WIDTH`] columns of each Parameter line.
    pub parameters: Vec<u8>,
    /// The other columns of each.
    pub backs: Vec<[u8; BACK_WIDTH]>,
    last: Option<(Section, usize)>,
    /// The numbers of lines that belong to no section.
    pub strays: Vec<usize>,
}

impl Sheet {
    /// Adds a line, of which no more than 72 columns count.
    pub fn push(&mut self, section: Section, text: &[u8], number: usize) {
        let text = &text[..text.len().min(WIDTH)];
        self.last = Some((section, number));
        if section != Section::Parameter {
            append(&mut self.text, text, WIDTH);
            self.lines.push((section, number));
            return;
        }
        let (parameters, back) = text.split_at(text.len().min(PARAMETER_WIDTH));
        append(&mut self.parameters, parameters, PARAMETER_WIDTH);
        let mut padded = [b' '; BACK_WIDTH];
        padded[..back.len()].copy_from_slice(back);
        self.backs.push(padded);
    }

    /// All lines but those of the Parameter section, in order.
    pub fn lines(&self) -> impl ExactSizeIterator<Item = Line<'_>> {
        let texts = self.text.chunks_exact(WIDTH);
        self.lines.iter().zip(texts).map(|(&(section, number), text)| Line { section, text, number })
    }

    /// The lines of a section other than Parameter.
    pub fn of(&self, section: Section) -> impl Iterator<Item = Line<'_>> {
        self.lines().filter(move |line| line.section == section)
    }

    /// How many lines a section has.
    pub fn count(&self, section: Section) -> usize {
        match section {
            Section::Parameter => self.backs.len(),
            _ => self.lines.iter().filter(|line| line.0 == section).count(),
        }
    }

    /// The section and the number of the last line.
    pub fn last(&self) -> Option<(Section, usize)> {
        self.last
    }
}

/// Appends `text`, with blanks to fill `width` columns.
fn append(to: &mut Vec<u8>, text: &[u8], width: usize) {
    to.extend_from_slice(text);
    if text.len() < width {
        to.resize(to.len() + width - text.len(), b' ');
    }
}

/// The lines of a file in fixed form, or of a compressed one as far as its data.
pub(crate) fn lines(bytes: &[u8]) -> Result<Sheet, ReadError> {
    if bytes.iter().all(|b| b.is_ascii_whitespace() || *b == 0) {
        return Err(ReadError::Empty);
    }
    if looks_binary(bytes) {
        return Err(ReadError::Binary);
    }
    let mut out = Sheet::default();
    out.parameters.reserve(bytes.len() / 81 * PARAMETER_WIDTH);
    out.backs.reserve(bytes.len() / 81);
    let mut expanded = Vec::new();
    for (index, raw) in split(bytes).enumerate() {
        let number = index + 1;
        if raw.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let text = without_tabs(raw, &mut expanded);
        let last = out.last.map(|last| last.0);
        match letter_column(text, last).and_then(|at| Some((Section::of(*text.get(at)?)?, at))) {
            Some((section, at)) => out.push(section, &text[..at], number),
            None => out.strays.push(number),
        }
        if out.last.is_none() && out.strays.len() > 50 {
            break;
        }
    }
    let is_data = |line: &(Section, usize)| matches!(line.0, Section::Directory | Section::Flag);
    if out.lines.iter().any(is_data) {
        return Ok(out);
    }
    Err(ReadError::NotIges(if out.last.is_none() {
        "no line has a section letter in column 73"
    } else {
        "it has no Directory section"
    }))
}

/// Whether the first line is one of a file in any of the three forms.
pub(crate) fn look_like_iges(head: &[u8]) -> bool {
    if looks_binary(head) {
        return true;
    }
    let first = split(head).find(|line| !line.iter().all(u8::is_ascii_whitespace));
    let Some(first) = first.filter(|line| line.len() >= WIDTH - 8) else { return false };
    let mut expanded = Vec::new();
    let text = without_tabs(first, &mut expanded);
    let section = letter_column(text, None).and_then(|at| Section::of(*text.get(at)?));
    matches!(section, Some(Section::Start | Section::Flag | Section::Global))
}

/// A flag section: B, the length of what follows, and the lengths of numbers, as IGES 5.3 section 2.4 has them.
fn looks_binary(bytes: &[u8]) -> bool {
    bytes.first() == Some(&b'B') && bytes.iter().take(80).any(|b| *b < b' ' && !b.is_ascii_whitespace())
}

/// Lines that end with LF, CR or both; records of 80 bytes where nothing ends a line.
pub(crate) fn split(bytes: &[u8]) -> Box<dyn Iterator<Item = &[u8]> + '_> {
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

/// The line with blanks for tabs.
pub(crate) fn without_tabs<'a>(raw: &'a [u8], expanded: &'a mut Vec<u8>) -> &'a [u8] {
    if memchr::memchr(b'\t', raw).is_none() {
        return raw;
    }
    expanded.clear();
    for &byte in raw {
        if byte == b'\t' {
            expanded.resize(expanded.len() / 8 * 8 + 8, b' ');
        } else {
            expanded.push(byte);
        }
    }
    expanded
}

/// Where a line's section letter stands: in column 73, else where blanks or bytes that were lost have moved it.
fn letter_column(text: &[u8], last: Option<Section>) -> Option<usize> {
    let is_letter = |at: usize, end: usize| {
        let section = text.get(at).copied().and_then(Section::of);
        let end = end.min(text.len());
        section.is_some_and(|section| last.is_none_or(|last| section >= last))
            && text.get(at + 1..end).is_some_and(|rest| rest.iter().all(|b| b.is_ascii_digit() || *b == b' '))
    };
    // What stands after column 80 is nobody's.
    if is_letter(WIDTH, WIDTH + 8) {
        return Some(WIDTH);
    }
    // A letter before a number at the very end, as in lines that are a few columns short or long.
    let digits = text.iter().rev().skip_while(|b| **b == b' ').take_while(|b| b.is_ascii_digit()).count();
    let trailing = text.iter().rev().take_while(|b| **b == b' ').count();
    let blanks = text.len().checked_sub(trailing + digits)?;
    let at = text[..blanks].iter().rposition(|b| *b != b' ')?;
    (digits > 0 && at.abs_diff(WIDTH) <= 8 && is_letter(at, usize::MAX)).then_some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sections(text: &str) -> Vec<(Section, usize)> {
        lines(text.as_bytes()).expect("lines").lines().map(|line| (line.section, line.number)).collect()
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
        let expected = [(Section::Start, 1), (Section::Global, 2), (Section::Directory, 3)];
        assert_eq!(sections(&text), expected);
        let sheet = lines(text.as_bytes()).expect("lines");
        assert_eq!(sheet.last(), Some((Section::Parameter, 4)));
        assert_eq!(sheet.parameters, format!("{:<64}", "116,0.,0.,0.;").as_bytes());
        assert_eq!(sheet.backs, [*b"1       "]);
    }

    #[test]
    fn what_stands_after_column_80_is_nobodys() {
        let line = record("116,0.,0.,0.;", 'P', 1) + "  written by a card reader 7";
        let text = [record("", 'S', 1), record("", 'D', 1), line].join("\n");
        let sheet = lines(text.as_bytes()).expect("lines");
        assert_eq!(sheet.last(), Some((Section::Parameter, 3)));
    }

    #[test]
    fn what_is_not_iges_is_refused_by_name() {
        assert_eq!(lines(b" \r\n").err(), Some(ReadError::Empty));
        assert_eq!(lines(b"B\x00\x00\x01rest").err(), Some(ReadError::Binary));
        assert!(matches!(lines(b"ISO-10303-21;\nHEADER;\n"), Err(ReadError::NotIges(_))));
    }
}
