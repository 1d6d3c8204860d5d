//! Where the text of a file lies.

use std::fmt;
use std::ops::Deref;

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
