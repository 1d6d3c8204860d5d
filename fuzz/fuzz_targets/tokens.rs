//! Mutations that leave a file readable: single values change, the grammar stays.
//!
//! Bytes changed at random mostly make records that the reader throws away; what is behind it then sees little.

use std::ops::Range;

/// Values that files should not have, and now and then do.
const NUMBERS: [&str; 16] = [
    "0.",
    "-0.",
    "1.",
    "-1.",
    "1E-7",
    "-1E-12",
    "1E308",
    "-1E308",
    "1E-308",
    "6.28318530717959",
    "3.14159265358979",
    "0.5",
    "180.",
    "1E9",
    "2",
    "0",
];

/// How a format writes its values.
pub struct Format {
    /// What may stand in a value's place and is no number.
    others: &'static [&'static str],
    /// Columns of a line that may change; the others say where things are.
    columns: usize,
}

/// ISO 10303-21.
#[allow(dead_code, reason = "each target uses one of the formats")]
pub const STEP: Format = Format { others: &["$", "*", ".T.", ".F.", "()", "''"], columns: usize::MAX };
/// IGES: columns 65 to 80 of a line hold the section and the pointer back.
#[allow(dead_code, reason = "each target uses one of the formats")]
pub const IGES: Format = Format { others: &["", "0", "1", "-1", "3", "2Hab", "9999999"], columns: 64 };

/// Changes one value of the text in `data[..size]`; gives the new size, or nothing where there is none to change.
pub fn mutate(data: &mut [u8], size: usize, max_size: usize, seed: u32, format: &Format) -> Option<usize> {
    let mut dice = Dice(u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let text = &data[..size];
    let tokens = tokens(text, format.columns);
    let old = tokens.get(dice.below(tokens.len())?)?.clone();
    let new = replacement(text, &tokens, &old, &mut dice, format)?;
    if format.columns < usize::MAX {
        return in_place(data, size, &old, &new);
    }
    let new_size = size - old.len() + new.len();
    if new_size > max_size.min(data.len()) {
        return None;
    }
    data.copy_within(old.end..size, old.start + new.len());
    data[old.start..old.start + new.len()].copy_from_slice(&new);
    Some(new_size)
}

/// Puts a value into the columns of another, and blanks behind it: no column moves.
fn in_place(data: &mut [u8], size: usize, old: &Range<usize>, new: &[u8]) -> Option<usize> {
    let room = &mut data[old.clone()];
    if new.len() > room.len() {
        return None;
    }
    room[..new.len()].copy_from_slice(new);
    room[new.len()..].fill(b' ');
    Some(size)
}

fn replacement(
    text: &[u8],
    tokens: &[Range<usize>],
    old: &Range<usize>,
    dice: &mut Dice,
    format: &Format,
) -> Option<Vec<u8>> {
    let is_reference = text[old.start] == b'#';
    match dice.below(4)? {
        0 => Some(format.others[dice.below(format.others.len())?].into()),
        1 if !is_reference => Some(NUMBERS[dice.below(NUMBERS.len())?].into()),
        // A value of the same kind from elsewhere in the file.
        _ => {
            let alike = |t: &&Range<usize>| (text[t.start] == b'#') == is_reference;
            let count = tokens.iter().filter(alike).count();
            Some(text[tokens.iter().filter(alike).nth(dice.below(count)?)?.clone()].into())
        }
    }
}

/// Numbers and references after a bracket or a comma.
fn tokens(text: &[u8], columns: usize) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    let mut line = 0;
    while at + 1 < text.len() {
        at += 1;
        if text[at - 1] == b'\n' {
            line = at;
        }
        if at - line >= columns {
            continue;
        }
        let is_value = text[at] == b'#' || text[at] == b'-' || text[at].is_ascii_digit();
        if !is_value || !matches!(text[at - 1], b'(' | b',' | b' ' | b'\n') {
            continue;
        }
        let length =
            text[at..].iter().take_while(|b| b"#-+.".contains(b) || b.is_ascii_alphanumeric()).count();
        found.push(at..at + length);
        at += length;
    }
    found
}

/// Numbers that look random (xorshift, Marsaglia 2003).
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> Option<usize> {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11).checked_rem(count as u64).map(|n| n as usize)
    }
}
