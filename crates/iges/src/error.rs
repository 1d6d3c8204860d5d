//! What can be wrong with a file: as a whole ([`ReadError`]) and in places ([`SyntaxError`]).

use crate::Section;

/// Something that does not follow the specification, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line} ({section} section): {message}")]
pub struct SyntaxError {
    /// Line of the file, from 1.
    pub line: usize,
    /// Its section.
    pub section: Section,
    /// The directory entry that it concerns, by the number of its first line, where known.
    pub entry: Option<u32>,
    /// One sentence.
    pub message: String,
}

/// Why nothing at all could be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// No bytes, or nothing but blanks.
    #[error("the file is empty")]
    Empty,
    /// IGES 5.3 section 2.4.
    #[error("this is a binary IGES file, a form that was withdrawn; export it again as ASCII")]
    Binary,
    /// No section letters where they should be.
    #[error("this is not an IGES file: {0}")]
    NotIges(&'static str),
}
