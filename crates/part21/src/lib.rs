//! ISO 10303-21 exchange files: text to an entity table. Knows no schema.
//!
//! [`Exchange`] holds the text and a table of records; a record's arguments are parsed when they are asked for.

use std::borrow::Cow;

/// A position in the text, both from 1; columns count bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

/// Something that does not follow ISO 10303-21, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {}, column {}: {message}", position.line, position.column)]
pub struct SyntaxError {
    /// Where.
    pub position: Position,
    /// The instance it concerns, where known.
    pub instance: Option<u64>,
    /// One sentence.
    pub message: String,
}

/// Why nothing at all could be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file could not be read.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// Not an exchange file, or nothing usable in it.
    #[error("{0}")]
    NotPart21(String),
    /// The unpacked text is larger than the cap.
    #[error("the unpacked file is larger than the cap of {cap} bytes")]
    TooLarge {
        /// The cap.
        cap: u64,
    },
}

/// What the HEADER section says.
#[derive(Clone, Debug, Default)]
pub struct Header {
    /// FILE_DESCRIPTION description.
    pub description: Vec<String>,
    /// FILE_DESCRIPTION implementation_level.
    pub implementation_level: String,
    /// FILE_NAME name.
    pub name: String,
    /// FILE_NAME time_stamp.
    pub time_stamp: String,
    /// FILE_NAME author.
    pub author: Vec<String>,
    /// FILE_NAME organization.
    pub organization: Vec<String>,
    /// FILE_NAME preprocessor_version.
    pub preprocessor_version: String,
    /// FILE_NAME originating_system.
    pub originating_system: String,
    /// FILE_NAME authorization.
    pub authorization: String,
    /// FILE_SCHEMA.
    pub schemas: Vec<String>,
}

/// A parsed exchange structure.
#[derive(Debug)]
pub struct Exchange {
    _private: (),
}

impl Exchange {
    /// Parses a text that is in memory.
    pub fn parse(text: Vec<u8>) -> Result<Self, ReadError> {
        let _ = text;
        todo!()
    }
    /// The HEADER section.
    pub fn header(&self) -> &Header {
        todo!()
    }
    /// What was damaged, in file order; each damaged record is one error and is missing from the table (or holds
    /// what could be read of it).
    pub fn errors(&self) -> &[SyntaxError] {
        todo!()
    }
    /// Number of instances.
    pub fn len(&self) -> usize {
        todo!()
    }
    /// Whether there is no instance.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The instance at `index` of the table, in file order.
    pub fn at(&self, index: usize) -> Instance<'_> {
        let _ = index;
        todo!()
    }
    /// The instance named `#id`.
    pub fn get(&self, id: u64) -> Option<Instance<'_>> {
        let _ = id;
        todo!()
    }
    /// The table index of the instance named `#id`.
    pub fn index_of(&self, id: u64) -> Option<usize> {
        let _ = id;
        todo!()
    }
    /// All instances in file order.
    pub fn instances(&self) -> impl ExactSizeIterator<Item = Instance<'_>> {
        (0..self.len()).map(|i| self.at(i))
    }
    /// Line and column of a byte offset.
    pub fn position(&self, offset: usize) -> Position {
        let _ = offset;
        todo!()
    }
}

/// One instance of the table: `#id = KEYWORD(...)` or `#id = (A(...) B(...))`.
#[derive(Clone, Copy, Debug)]
pub struct Instance<'a> {
    _private: &'a (),
}

impl<'a> Instance<'a> {
    /// The number after `#`.
    pub fn id(&self) -> u64 {
        todo!()
    }
    /// Keyword of a simple instance, as written (upper case in files that follow the standard); for a complex
    /// instance that of its first part.
    pub fn keyword(&self) -> &'a str {
        todo!()
    }
    /// Whether it is a complex instance.
    pub fn is_complex(&self) -> bool {
        todo!()
    }
    /// The parts: one for a simple instance.
    pub fn parts(&self) -> impl Iterator<Item = (&'a str, Args<'a>)> + use<'a> {
        std::iter::empty()
    }
    /// Arguments of the (first) part with this keyword.
    pub fn part(&self, keyword: &str) -> Option<Args<'a>> {
        let _ = keyword;
        todo!()
    }
    /// Arguments of the first part.
    pub fn args(&self) -> Args<'a> {
        todo!()
    }
    /// Byte offset of `#`.
    pub fn offset(&self) -> usize {
        todo!()
    }
}

/// A run of parameters, parsed as it is iterated. Cheap to copy: iterating a copy starts anew.
///
/// Damaged text ends the run (validation has reported it).
#[derive(Clone, Copy, Debug)]
pub struct Args<'a> {
    _private: &'a (),
}

impl<'a> Iterator for Args<'a> {
    type Item = Param<'a>;
    fn next(&mut self) -> Option<Param<'a>> {
        todo!()
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
    /// A real; also tolerated forms such as `1`, `1.E5`, `.5`, `1.0D3`.
    Real(f64),
    /// A string, still escaped; see [`Text::decode`].
    String(Text<'a>),
    /// `.NAME.` without the dots.
    Enumeration(&'a str),
    /// `"..."` without the quotes: hexadecimal digits.
    Binary(&'a str),
    /// `#12`
    Reference(u64),
    /// `@12`, `#NAME`, `@NAME`: value and constant references of edition 3.
    Other(&'a str),
    /// `( ... )`
    List(Args<'a>),
    /// `KEYWORD( ... )`
    Typed(&'a str, Args<'a>),
}

/// The inside of a string literal, still escaped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Text<'a>(pub &'a [u8]);

impl<'a> Text<'a> {
    /// The string, escapes resolved (`\X\ \X2\ \X4\ \S\ \P.\ ''`), raw bytes taken as UTF-8 where valid, else as
    /// Latin-1.
    pub fn decode(&self) -> Cow<'a, str> {
        todo!()
    }
}
