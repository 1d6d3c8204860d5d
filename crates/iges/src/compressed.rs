//! The compressed form (IGES 5.3 section 2.3), brought into the fixed one: after the Global section each directory entry is
//! `D`, its number and the fields that differ from the entry before (`@field_value`), followed by its parameter lines.

use crate::lines::{PARAMETER_WIDTH, Section, Sheet, lines, split, without_tabs};
use crate::value::{After, next};
use crate::{Delimiters, Global, ReadError, SyntaxError};

/// The fields of a directory entry, numbered from 1 as in the specification.
type Fields = [Vec<u8>; 21];

/// The sheet that the file would be in fixed form.
pub(crate) fn expanded(bytes: &[u8], errors: &mut Vec<SyntaxError>) -> Result<Sheet, ReadError> {
    let all: Vec<&[u8]> = split(bytes).collect();
    // The data have no section letters, and what stands in column 73 there means nothing.
    let is_entry = |line: &&[u8]| entry_number(line).is_some();
    let first = all.iter().position(is_entry).unwrap_or(all.len());
    let before = lines(&joined(&all[..first]))?;
    let mut out = Sheet::default();
    for line in before.lines().filter(|line| line.section != Section::Flag) {
        out.push(line.section, line.text, line.number);
    }
    let global: Vec<u8> = before.of(Section::Global).flat_map(|line| line.text.iter().copied()).collect();
    let delimiters = Global::parse(&global).delimiters;
    let mut reader = Reader { lines: &all, at: first, delimiters, errors };
    let mut fields = Fields::default();
    let mut entries = 0;
    let mut parameter_lines = 0;
    while let Some(line) = reader.lines.get(reader.at) {
        let start = reader.at;
        let Some(told) = entry_number(line) else {
            if is_terminate(line) {
                out.push(Section::Terminate, &line[..72], start + 1);
                break;
            }
            if !line.iter().all(u8::is_ascii_whitespace) {
                reader.error(start, None, "the line belongs to no entity");
            }
            reader.at += 1;
            continue;
        };
        let number = 2 * entries + 1;
        entries += 1;
        if told != number {
            reader.error(start, Some(number), &format!("entity {number} is numbered {told}"));
        }
        reader.read_fields(&mut fields, number);
        let parameters = reader.parameter_lines(count_of(&fields));
        push_entry(&mut out, &fields, number, parameter_lines + 1, parameters.len(), start + 1);
        for (offset, text) in parameters.iter().enumerate() {
            let row = parameter_row(text, number);
            out.push(Section::Parameter, &row, reader.at - parameters.len() + offset + 1);
        }
        parameter_lines += parameters.len();
    }
    Ok(out)
}

fn joined(lines: &[&[u8]]) -> Vec<u8> {
    lines.join(&b'\n')
}

/// The number of the entity whose record begins with a line: `D` and digits, then a field or the record's end.
fn entry_number(line: &[u8]) -> Option<u32> {
    let rest = line.strip_prefix(b"D").or_else(|| line.strip_prefix(b"d"))?;
    let blanks = rest.iter().take_while(|b| **b == b' ').count();
    let digits = rest[blanks..].iter().take_while(|b| b.is_ascii_digit()).count();
    let after = rest[blanks + digits..].trim_ascii();
    // A line of the Start section may begin the same way.
    let is_record = after.first().is_none_or(|b| !b.is_ascii_alphanumeric()) && !is_lettered(line);
    let number = std::str::from_utf8(&rest[blanks..blanks + digits]).ok()?.parse().ok()?;
    is_record.then_some(number)
}

/// Whether a line is one of the Start or Global section.
fn is_lettered(line: &[u8]) -> bool {
    line.len() > 73
        && matches!(line[72], b'S' | b'G')
        && line[73..].iter().all(|b| b.is_ascii_digit() || *b == b' ')
}

fn is_terminate(line: &[u8]) -> bool {
    line.len() > 72
        && matches!(line[72], b'T' | b't')
        && line[73..].iter().all(|b| b.is_ascii_digit() || b.is_ascii_whitespace())
}

/// How many parameter lines the entry says it has.
fn count_of(fields: &Fields) -> usize {
    std::str::from_utf8(&fields[14]).ok().and_then(|text| text.trim().parse().ok()).unwrap_or(0)
}

struct Reader<'a, 'e> {
    lines: &'a [&'a [u8]],
    at: usize,
    delimiters: Delimiters,
    errors: &'e mut Vec<SyntaxError>,
}

impl<'a> Reader<'a, '_> {
    fn error(&mut self, index: usize, entry: Option<u32>, message: &str) {
        let (line, section) = (index + 1, Section::Directory);
        self.errors.push(SyntaxError { line, section, entry, message: message.to_owned() });
    }

    /// Reads the record that begins with the line at hand, onto the fields of the one before.
    fn read_fields(&mut self, fields: &mut Fields, number: u32) {
        let mut text = Vec::new();
        let first = self.at;
        while let Some(line) = self.lines.get(self.at) {
            if self.at > first && line.first() != Some(&b'@') {
                break;
            }
            let mut expanded = Vec::new();
            text.extend_from_slice(without_tabs(line, &mut expanded).trim_ascii_end());
            self.at += 1;
            if text.ends_with(&[self.delimiters.record]) || text.ends_with(b";") {
                text.pop();
                break;
            }
        }
        for item in items(&text) {
            let wrong = match item {
                Some((field, value)) if (1..=20).contains(&field) => {
                    fields[field] = value.trim_ascii().to_vec();
                    continue;
                }
                Some((field, _)) => format!("entity {number} has no field {field}"),
                None => format!("entity {number} has a field without a number"),
            };
            self.error(first, Some(number), &wrong);
        }
    }

    /// The entity's parameter lines: as many as it says, else to the end of its record.
    fn parameter_lines(&mut self, told: usize) -> Vec<&'a [u8]> {
        let rest = &self.lines[self.at.min(self.lines.len())..];
        let fits = |count: usize| {
            rest.get(count).is_none_or(|line| entry_number(line).is_some() || is_terminate(line))
        };
        let count = if told <= rest.len() && fits(told) { told } else { self.record_length(rest) };
        self.at += count;
        rest[..count].to_vec()
    }

    /// The number of lines to the end of a record.
    fn record_length(&self, lines: &[&[u8]]) -> usize {
        let end = lines.iter().position(|line| is_terminate(line)).unwrap_or(lines.len());
        let mut text = Vec::new();
        for (count, line) in lines[..end].iter().enumerate() {
            text.extend_from_slice(&padded(line));
            // Strings may hold delimiters, so the record is read from its start.
            if ends(&text, self.delimiters) {
                return count + 1;
            }
            if count > MAX_SCANNED {
                break;
            }
        }
        lines[..end].iter().take_while(|line| entry_number(line).is_none()).count()
    }
}

/// A record whose count of lines is wrong is looked through for so many lines.
const MAX_SCANNED: usize = 500;

/// Whether a record ends in a text.
pub(crate) fn ends(text: &[u8], delimiters: Delimiters) -> bool {
    let mut rest = text;
    loop {
        let (_, after, then) = next(rest, delimiters);
        match after {
            After::Parameter => rest = then,
            After::RecordEnd => return true,
            After::TextEnd => return false,
        }
    }
}

/// The fields of a record; nothing where one has no number.
fn items(text: &[u8]) -> Vec<Option<(usize, &[u8])>> {
    let starts: Vec<usize> = (0..text.len()).filter(|&at| text[at] == b'@').collect();
    let field = |at: usize| {
        let digits = text[at + 1..].iter().take_while(|b| b.is_ascii_digit()).count();
        let number = std::str::from_utf8(&text[at + 1..at + 1 + digits]).ok()?.parse::<usize>().ok()?;
        (text.get(at + 1 + digits) == Some(&b'_')).then_some((number, at + 2 + digits))
    };
    // A label may hold the sign too: only with a number and a bar it begins a field.
    let fields: Vec<(usize, usize, usize)> =
        starts.iter().filter_map(|&at| field(at).map(|(number, value)| (at, number, value))).collect();
    if fields.is_empty() {
        return starts.first().map(|_| None).into_iter().collect();
    }
    let ends = fields.iter().skip(1).map(|field| field.0).chain([text.len()]);
    fields.iter().zip(ends).map(|(&(_, number, value), end)| Some((number, &text[value..end]))).collect()
}

fn padded(line: &[u8]) -> [u8; PARAMETER_WIDTH] {
    let mut out = [b' '; PARAMETER_WIDTH];
    let length = line.len().min(PARAMETER_WIDTH);
    out[..length].copy_from_slice(&line[..length]);
    out
}

/// A parameter line with the pointer back to its entity.
fn parameter_row(text: &[u8], number: u32) -> Vec<u8> {
    let mut row = padded(text).to_vec();
    row.extend_from_slice(format!("{number:>8}").as_bytes());
    row
}

/// The two lines of a directory entry.
fn push_entry(
    out: &mut Sheet,
    fields: &Fields,
    number: u32,
    first_parameter: usize,
    parameter_count: usize,
    line: usize,
) {
    let of = |k: usize| match k {
        2 => first_parameter.to_string().into_bytes(),
        11 => fields[1].clone(),
        14 => parameter_count.to_string().into_bytes(),
        10 | 20 => number.to_string().into_bytes(),
        _ => fields[k].clone(),
    };
    for half in [1..10, 11..20] {
        let row: Vec<u8> =
            half.flat_map(|k| right_aligned(&of(k), if k == 9 { b'0' } else { b' ' })).collect();
        out.push(Section::Directory, &row, line);
    }
}

fn right_aligned(value: &[u8], fill: u8) -> [u8; 8] {
    let mut out = [fill; 8];
    let value = &value[..value.len().min(8)];
    out[8 - value.len()..].copy_from_slice(value);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_begin_with_a_number_and_a_bar() {
        let found = items(b"D1@1_116@18_A@B@16_");
        assert_eq!(found, [Some((1, &b"116"[..])), Some((18, b"A@B")), Some((16, b""))]);
        assert_eq!(items(b"D3"), []);
    }

    #[test]
    fn a_record_is_known_by_its_number() {
        assert_eq!(entry_number(b"D17@1_116"), Some(17));
        assert_eq!(entry_number(b"D3;"), Some(3));
        assert_eq!(entry_number(b"D"), None);
        assert_eq!(entry_number(b"Drawing 4"), None);
        assert_eq!(entry_number(format!("{:<72}S      1", "D3 is a point").as_bytes()), None);
    }
}
