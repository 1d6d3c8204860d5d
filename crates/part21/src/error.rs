//! What can be wrong with a file: as a whole ([`ReadError`]) and in places ([`SyntaxError`]).

use crate::Position;

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
