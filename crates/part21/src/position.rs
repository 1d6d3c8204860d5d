//! Byte offset to line and column.

use memchr::{memchr_iter, memchr2_iter, memrchr2};

/// A position in the text, both from 1; columns count bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

/// Bytes between two entries of a [`LineIndex`]: what one look-up may have to count through.
const BLOCK: usize = 1 << 12;

/// For the start of every block of the text: the number of line ends before it, and where the line that it is in
/// starts. A look-up then counts through less than a block, however long the file or its lines.
#[derive(Debug)]
pub(crate) struct LineIndex(Vec<(usize, usize)>);

impl LineIndex {
    pub fn new(text: &[u8]) -> Self {
        let mut entries = Vec::with_capacity(text.len() / BLOCK + 1);
        let (mut lines, mut line_start) = (0, 0);
        for block_start in (0..=text.len()).step_by(BLOCK) {
            entries.push((lines, line_start));
            let block_end = text.len().min(block_start + BLOCK);
            lines += line_ends(text, block_start, block_end);
            line_start = last_line_start(text, block_start, block_end).unwrap_or(line_start);
        }
        LineIndex(entries)
    }

    /// Offsets beyond the text count as its end.
    pub fn position(&self, text: &[u8], offset: usize) -> Position {
        let offset = offset.min(text.len());
        let block_start = offset / BLOCK * BLOCK;
        let (lines, line_start) = self.0[offset / BLOCK];
        let line_start = last_line_start(text, block_start, offset).unwrap_or(line_start);
        Position { line: lines + line_ends(text, block_start, offset) + 1, column: offset - line_start + 1 }
    }
}

/// Whether a line ends after the byte at `at`: LF, or CR that no LF follows.
fn is_line_end(text: &[u8], at: usize) -> bool {
    text[at] == b'\n' || (text[at] == b'\r' && text.get(at + 1) != Some(&b'\n'))
}

fn line_ends(text: &[u8], from: usize, to: usize) -> usize {
    let part = &text[from..to];
    if memchr::memchr(b'\r', part).is_none() {
        return memchr_iter(b'\n', part).count();
    }
    memchr2_iter(b'\n', b'\r', part).filter(|at| is_line_end(text, from + at)).count()
}

fn last_line_start(text: &[u8], from: usize, mut to: usize) -> Option<usize> {
    while let Some(at) = memrchr2(b'\n', b'\r', &text[from..to]) {
        if is_line_end(text, from + at) {
            return Some(from + at + 1);
        }
        to = from + at;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn position(text: &[u8], offset: usize) -> (usize, usize) {
        let position = LineIndex::new(text).position(text, offset);
        (position.line, position.column)
    }

    #[test]
    fn every_line_ending_counts_once() {
        for text in [&b"ab\ncd\nef"[..], b"ab\rcd\ref"] {
            assert_eq!(position(text, 0), (1, 1));
            assert_eq!(position(text, 2), (1, 3));
            assert_eq!(position(text, 3), (2, 1));
            assert_eq!(position(text, 7), (3, 2));
        }
        assert_eq!(position(b"ab\r\ncd\r\nef", 9), (3, 2));
        assert_eq!(position(b"ab\r\ncd", 3), (1, 4));
    }

    #[test]
    fn positions_agree_with_counting_across_blocks() {
        let text: Vec<u8> =
            (0..3 * BLOCK).map(|i| [b'x', b'y', b'\r', b'\n', b'z'][i * i % 4 + i % 2]).collect();
        let index = LineIndex::new(&text);
        for offset in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK + 77, text.len()] {
            let starts: Vec<usize> = (0..offset).filter(|&at| is_line_end(&text, at)).collect();
            let column = offset - starts.last().map_or(0, |at| at + 1) + 1;
            assert_eq!(index.position(&text, offset), Position { line: starts.len() + 1, column });
        }
    }

    #[test]
    fn an_offset_beyond_the_end_is_the_end() {
        assert_eq!(position(b"ab\n", 99), (2, 1));
        assert_eq!(position(b"", 0), (1, 1));
    }
}
