//! The sections of a file: what is header, where the records are, what lies around them.

use crate::Args;
use crate::anchor::Entry;
use crate::fault::{Damage, DamageList, Fault};
use crate::grammar::{Parsed, parameters, space};
use crate::header::{Header, string, strings};
use crate::instance::ascii;
use crate::record::{Record, part};
use crate::scan::Scanner;

/// What one walk over the text finds.
pub(crate) struct Layout {
    pub header: Header,
    /// Not yet checked.
    pub records: Vec<Record>,
    pub sections: Vec<SectionStart>,
    pub anchors: Vec<Entry>,
    pub references: Vec<Entry>,
    pub damage: DamageList,
}

/// A DATA section, and the offset from which on records belong to it.
pub(crate) struct SectionStart {
    pub offset: usize,
    pub name: String,
    pub schemas: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Section {
    Outside,
    Header,
    Data,
    Anchor,
    Reference,
}

/// The shortest record, `#1=A()`: shorter ones need no place in the table to be found wrong.
const SHORTEST_RECORD: usize = 6;

/// Walks over the text from the statement at `start`.
pub(crate) fn lay_out(text: &[u8], start: usize, max_errors: usize) -> Layout {
    let layout = Layout {
        header: Header::default(),
        records: Vec::new(),
        sections: Vec::new(),
        anchors: Vec::new(),
        references: Vec::new(),
        damage: DamageList::new(max_errors),
    };
    let scanner = Scanner::new(text, start);
    let mut walk = Walk { text, scanner, section: Section::Outside, layout };
    walk.run();
    walk.layout
}

struct Walk<'a> {
    text: &'a [u8],
    scanner: Scanner<'a>,
    section: Section,
    layout: Layout,
}

impl<'a> Walk<'a> {
    fn run(&mut self) {
        loop {
            self.scanner.skip_space();
            match self.scanner.rest() {
                [] => return self.damage(self.text.len(), "the file ends without END-ISO-10303-21"),
                [b'#', ..] if self.section == Section::Data => self.record(),
                rest => match section_word(rest) {
                    Some(("END-ISO-10303-21", _)) => return self.end(),
                    Some((word, length)) => self.section_start(word, length),
                    None => self.statement(rest),
                },
            }
        }
    }

    fn damage(&mut self, offset: usize, message: &'static str) {
        self.layout.damage.push(Damage { offset, instance: None, message });
    }

    fn end(&mut self) {
        if self.section != Section::Outside {
            self.damage(self.scanner.at, "ENDSEC is missing before END-ISO-10303-21");
        }
    }

    /// A statement that is none of the words between sections.
    fn statement(&mut self, rest: &'a [u8]) {
        match self.section {
            Section::Header if rest[0] != b'#' => self.header_entity(rest),
            Section::Anchor if rest[0] != b'#' => self.anchor(),
            Section::Reference => self.reference(),
            Section::Data => self.record(),
            Section::Outside if rest[0] != b'#' => {
                self.damage(self.scanner.at, "something that belongs to no section");
                self.scanner.statement();
            }
            _ => {
                self.damage(self.scanner.at, "an instance outside a DATA section");
                self.open_data(String::new(), Vec::new());
                self.record();
            }
        }
    }

    fn record(&mut self) {
        let statement = self.scanner.statement();
        let length = statement.end - statement.start;
        if length < SHORTEST_RECORD {
            let message = match &self.text[statement.start..] {
                [b'/', b'*', ..] => "a comment is not closed",
                _ => "an instance (#number = KEYWORD(...)) is expected",
            };
            return self.damage(statement.start, message);
        }
        if u32::try_from(length).is_err() {
            return self.damage(statement.start, "a record is longer than 4 GiB");
        }
        self.layout.records.push(Record::unchecked(statement.start, statement.end));
    }

    fn header_entity(&mut self, rest: &'a [u8]) {
        if let Some(name) = self.parse(rest, part) {
            let args = space(&rest[name.len()..]).get(1..).unwrap_or_default();
            self.layout.header.take(ascii(name), Args::new(args));
        }
    }

    /// What `parser` makes of `rest`; goes on after it or, if it is damaged, after the next semicolon.
    fn parse<T>(&mut self, rest: &'a [u8], parser: impl Fn(&'a [u8]) -> Parsed<'a, T>) -> Option<T> {
        let end = self.text.len();
        if self.scanner.comments_exhausted() {
            // The grammar would look for the end of a comment through the whole file, and again and again.
            let from = end - rest.len();
            self.scanner.at = from;
            let statement = self.scanner.statement();
            return self
                .parsed(parser(&self.text[from..statement.end]), statement.end)
                .map(|(_, value)| value);
        }
        let parsed = self.parsed(parser(rest), end);
        match parsed {
            Some((after, value)) => {
                self.scanner.at = end - after.len();
                self.semicolon();
                Some(value)
            }
            None => {
                self.scanner.statement();
                None
            }
        }
    }

    /// Reports what is damaged in a text that ends at the offset `end`.
    fn parsed<T>(&mut self, parsed: Parsed<'a, T>, end: usize) -> Option<(&'a [u8], T)> {
        match parsed {
            Ok(parsed) => Some(parsed),
            Err(error) => {
                let fault = Fault::of(error);
                self.damage(end - fault.rest.len(), fault.message);
                None
            }
        }
    }

    fn anchor(&mut self) {
        let statement = self.scanner.statement_with_uris();
        match Entry::anchor(self.text, statement.start, statement.end) {
            Ok(entry) => self.layout.anchors.push(entry),
            Err(message) => self.damage(statement.start, message),
        }
    }

    fn reference(&mut self) {
        let statement = self.scanner.statement_with_uris();
        match Entry::reference(self.text, statement.start, statement.end) {
            Ok(entry) => self.layout.references.push(entry),
            Err(message) => self.damage(statement.start, message),
        }
    }

    /// The semicolon that ends what was read.
    fn semicolon(&mut self) {
        self.scanner.skip_space();
        if self.scanner.rest().first() == Some(&b';') {
            self.scanner.at += 1;
        } else {
            self.damage(self.scanner.at, "a semicolon is expected here");
        }
    }

    fn section_start(&mut self, word: &str, length: usize) {
        if self.section != Section::Outside && word != "ENDSEC" {
            self.damage(self.scanner.at, "ENDSEC is missing before this");
        }
        self.scanner.at += length;
        match word {
            "HEADER" => self.section = Section::Header,
            "ANCHOR" => self.section = Section::Anchor,
            "REFERENCE" => self.section = Section::Reference,
            "DATA" => return self.data_start(),
            "SIGNATURE" => return self.skip_signature(),
            _ => self.section = Section::Outside,
        }
        self.semicolon();
    }

    /// `DATA;` or `DATA('name',('schema'));`
    fn data_start(&mut self) {
        self.scanner.skip_space();
        let Some(list) = self.scanner.rest().strip_prefix(b"(") else {
            self.open_data(String::new(), Vec::new());
            return self.semicolon();
        };
        let mut args = match self.parse(list, parameters) {
            Some(()) => Args::new(list),
            None => Args::new(&[]),
        };
        self.open_data(string(args.next()), strings(args.next()));
    }

    fn open_data(&mut self, name: String, schemas: Vec<String>) {
        self.section = Section::Data;
        self.layout.sections.push(SectionStart { offset: self.scanner.at, name, schemas });
    }

    /// A signature is base64, which the grammar of the other sections does not fit.
    fn skip_signature(&mut self) {
        let rest = self.scanner.rest();
        self.scanner.at += memchr::memmem::find(rest, b"ENDSEC").unwrap_or(rest.len());
        self.section = Section::Outside;
    }
}

/// A word that begins or ends a section or the file, in upper case, and how long it is.
pub(crate) fn section_word(rest: &[u8]) -> Option<(&'static str, usize)> {
    const WORDS: [&str; 8] =
        ["ENDSEC", "DATA", "HEADER", "ANCHOR", "REFERENCE", "SIGNATURE", "ISO-10303-21", "END-ISO-10303-21"];
    let in_word = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
    let length = rest.iter().take(20).take_while(|&byte| in_word(byte)).count();
    let word = WORDS.iter().find(|word| rest[..length].eq_ignore_ascii_case(word.as_bytes()))?;
    Some((word, length))
}
