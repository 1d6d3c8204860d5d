//! Mutations that leave a STEP file readable: single values change, the grammar stays.
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
const OTHERS: [&str; 6] = ["$", "*", ".T.", ".F.", "()", "''"];

/// Changes one value of the text in `data[..size]`; gives the new size, or nothing where there is none to change.
pub fn mutate(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> Option<usize> {
    let mut dice = Dice(u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let text = &data[..size];
    let tokens = tokens(text);
    let old = tokens.get(dice.below(tokens.len())?)?.clone();
    let new = replacement(text, &tokens, &old, &mut dice)?;
    let new_size = size - old.len() + new.len();
    if new_size > max_size.min(data.len()) {
        return None;
    }
    data.copy_within(old.end..size, old.start + new.len());
    data[old.start..old.start + new.len()].copy_from_slice(&new);
    Some(new_size)
}

fn replacement(text: &[u8], tokens: &[Range<usize>], old: &Range<usize>, dice: &mut Dice) -> Option<Vec<u8>> {
    let is_reference = text[old.start] == b'#';
    match dice.below(4)? {
        0 => Some(OTHERS[dice.below(OTHERS.len())?].into()),
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
fn tokens(text: &[u8]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while at + 1 < text.len() {
        at += 1;
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
