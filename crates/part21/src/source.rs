//! Where the text of a file lies.

use std::fmt;
use std::ops::Deref;
use std::path::Path;

use crate::{ReadError, ReadOptions, open};

/// The bytes of a file as they lie there, mapped where possible (feature `mmap`), else in memory.
#[derive(Debug)]
pub struct FileBytes(Source);

impl FileBytes {
    /// Those of a file no longer than [`ReadOptions::max_bytes`]. A mapped file must not be cut short while they live.
    ///
    /// # Errors
    /// When the file cannot be read, or is longer.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, ReadError> {
        open::open(path, options).map(Self)
    }
}

impl Deref for FileBytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0
    }
}

/// The bytes of a text, in memory or mapped.
pub(crate) enum Source {
    Memory(Vec<u8>),
    #[cfg(feature = "mmap")]
    Mapped(memmap2::Mmap),
}

impl Deref for Source {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Source::Memory(text) => text,
            #[cfg(feature = "mmap")]
            Source::Mapped(map) => map,
        }
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.len())
    }
}
