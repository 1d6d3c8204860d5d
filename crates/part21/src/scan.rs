//! Statement boundaries: one pass over the bytes that knows strings and comments and nothing else.

use memchr::{memchr_iter, memchr2_iter, memchr3};

/// Where a string ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StringEnd {
    /// Offset of the closing quote.
    Closed(usize),
    /// There is none before the next instance (whose line starts here) or the end of the text.
    Open(usize),
}

/// The end of the string whose first character (after the quote) is at `from`.
///
/// A string may run over lines, as writers that wrap at 72 columns do; but a line that begins an instance shows that
/// a quote is missing before it.
#[inline]
pub(crate) fn string_end(text: &[u8], from: usize) -> StringEnd {
    match text.get(from..) {
        // Most strings are empty.
        Some([b'\'', next, ..]) if *next != b'\'' => StringEnd::Closed(from),
        _ => long_string_end(text, from),
    }
}

fn long_string_end(text: &[u8], mut from: usize) -> StringEnd {
    while let Some(found) = text.get(from..).and_then(|rest| memchr3(b'\'', b'\n', b'\r', rest)) {
        let at = from + found;
        if text[at] != b'\'' {
            if begins_record(&text[at + 1..]) {
                return StringEnd::Open(at + 1);
            }
            from = at + 1;
        } else {
            match quote_length(text, at) {
                0 => return StringEnd::Closed(at),
                length => from = at + length,
            }
        }
    }
    StringEnd::Open(text.len())
}

/// How many bytes at the quote `at` inside a string belong to the string: 0 when it closes the string, 2 for `''`.
///
/// `\S\'` is the section sign (ISO 8859-1 A7), written with the apostrophe single (the standard) or doubled; but a
/// Windows path may end in `\S\` too, so what follows decides.
fn quote_length(text: &[u8], at: usize) -> usize {
    let after = |n: usize| text.get(at + n).copied().unwrap_or(b')');
    let closes = |byte: u8| matches!(byte, b',' | b')' | b';' | 0..=b' ');
    if text[..at].ends_with(b"\\S\\") {
        return match (after(1), after(2)) {
            (b'\'', next) if closes(next) => 1,
            (b'\'', _) => 2,
            (b' ', _) => 1,
            (next, _) if closes(next) => 0,
            _ => 1,
        };
    }
    if after(1) == b'\'' { 2 } else { 0 }
}

/// Whether a line begins an instance (`#12 =`) or ends its section.
pub(crate) fn begins_record(line: &[u8]) -> bool {
    // The few blanks and digits that real files have there, so that looking costs no more than a constant.
    let line = skip(line, 32, |byte| byte == b' ' || byte == b'\t');
    let Some(number) = line.strip_prefix(b"#") else {
        return line.starts_with(b"ENDSEC;") || line.starts_with(b"END-ISO-10303-21;");
    };
    let after = skip(number, 20, |byte| byte.is_ascii_digit());
    after.len() < number.len() && skip(after, 32, |byte| byte == b' ').first() == Some(&b'=')
}

fn skip(text: &[u8], most: usize, skipped: impl Fn(u8) -> bool) -> &[u8] {
    let count = text.iter().take(most).take_while(|&&byte| skipped(byte)).count();
    &text[count..]
}

/// The end (after `*/`) of the comment whose text starts at `from`.
pub(crate) fn comment_end(text: &[u8], from: usize) -> Option<usize> {
    let rest = text.get(from..)?;
    memchr_iter(b'/', rest).find(|&at| at > 0 && rest[at - 1] == b'*').map(|at| from + at + 1)
}

/// Why a statement does not end with `;`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cut {
    /// The string that starts at this offset is not closed.
    String(usize),
    /// The comment that starts at this offset is not closed.
    Comment(usize),
    /// The text ends.
    End,
}

/// A stretch of text up to its `;`, or up to where reading can go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Statement {
    pub start: usize,
    /// Offset of the `;`, or where the statement is cut.
    pub end: usize,
    pub cut: Option<Cut>,
}

/// Walks over a text statement by statement.
#[derive(Debug)]
pub(crate) struct Scanner<'a> {
    text: &'a [u8],
    /// The next byte to look at.
    pub at: usize,
    /// No comment is closed any more: known after one search to the end, which must not be repeated.
    comments_exhausted: bool,
}

impl<'a> Scanner<'a> {
    pub fn new(text: &'a [u8], at: usize) -> Self {
        Scanner { text, at, comments_exhausted: false }
    }

    /// The text from here on.
    pub fn rest(&self) -> &'a [u8] {
        &self.text[self.at.min(self.text.len())..]
    }

    /// Whether a comment was found that is not closed: then no later one is closed either.
    pub fn comments_exhausted(&self) -> bool {
        self.comments_exhausted
    }

    /// Skips white space and comments; an open comment is not skipped.
    pub fn skip_space(&mut self) {
        while let Some(&byte) = self.text.get(self.at) {
            match byte {
                0..=b' ' => self.at += 1,
                b'/' if self.text.get(self.at + 1) == Some(&b'*') => match self.comment_end(self.at) {
                    Some(end) => self.at = end,
                    None => return,
                },
                _ => return,
            }
        }
    }

    fn comment_end(&mut self, open: usize) -> Option<usize> {
        if self.comments_exhausted {
            return None;
        }
        let end = comment_end(self.text, open + 2);
        self.comments_exhausted = end.is_none();
        end
    }

    /// The statement from here to its `;`, which is consumed.
    pub fn statement(&mut self) -> Statement {
        let start = self.at;
        let mut at = start;
        while let Some(found) = memchr3(b';', b'\'', b'/', &self.text[at..]) {
            at += found;
            match self.text[at] {
                b';' => {
                    self.at = at + 1;
                    return Statement { start, end: at, cut: None };
                }
                b'\'' => match string_end(self.text, at + 1) {
                    StringEnd::Closed(end) => at = end + 1,
                    StringEnd::Open(end) => return self.cut(start, end, Cut::String(at)),
                },
                _ if self.text.get(at + 1) == Some(&b'*') => match self.comment_end(at) {
                    Some(end) => at = end,
                    None => {
                        let end = any_record_line(self.text, at).unwrap_or(self.text.len());
                        return self.cut(start, end, Cut::Comment(at));
                    }
                },
                _ => at += 1,
            }
        }
        self.cut(start, self.text.len(), Cut::End)
    }

    fn cut(&mut self, start: usize, end: usize, cut: Cut) -> Statement {
        self.at = end;
        Statement { start, end, cut: Some(cut) }
    }

    /// As [`Self::statement`], for sections where `<...>` encloses a URI, in which `;` and `'` are allowed.
    pub fn statement_with_uris(&mut self) -> Statement {
        let start = self.at;
        let mut at = start;
        while at < self.text.len() {
            match self.text[at] {
                b'<' => {
                    let end = memchr3(b'>', b'\n', b'\r', &self.text[at..]);
                    at += end.map_or(self.text.len() - at, |length| length + 1);
                }
                b';' => {
                    self.at = at + 1;
                    return Statement { start, end: at, cut: None };
                }
                b'\'' => match string_end(self.text, at + 1) {
                    StringEnd::Closed(end) => at = end + 1,
                    StringEnd::Open(end) => return self.cut(start, end, Cut::String(at)),
                },
                _ => at += 1,
            }
        }
        self.cut(start, self.text.len(), Cut::End)
    }
}

/// The first character of the next line, outside strings and comments, that begins a record, in a text that begins
/// outside both. Never 0.
pub(crate) fn next_record_line(text: &[u8]) -> Option<usize> {
    let mut at = 0;
    loop {
        at += text.get(at..)?.iter().position(|byte| matches!(byte, b'\n' | b'\r' | b'\'' | b'/'))?;
        at = match text[at] {
            b'\'' => match string_end(text, at + 1) {
                StringEnd::Closed(end) => end + 1,
                StringEnd::Open(_) => return None,
            },
            b'/' if text.get(at + 1) == Some(&b'*') => comment_end(text, at + 2)?,
            b'/' => at + 1,
            _ if begins_record(&text[at + 1..]) => {
                let blanks = text[at + 1..].iter().take_while(|&&byte| byte <= b' ').count();
                return Some(at + 1 + blanks);
            }
            _ => at + 1,
        }
    }
}

/// The start of the first line after `from` that begins a record, whatever it stands in.
fn any_record_line(text: &[u8], from: usize) -> Option<usize> {
    memchr2_iter(b'\n', b'\r', text.get(from..)?)
        .map(|at| from + at + 1)
        .find(|&at| begins_record(&text[at..]))
}
