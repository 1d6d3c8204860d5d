//! From a path to bytes: mapped where possible, else read up to a cap.

use crate::source::Source;
use crate::{ReadError, ReadOptions};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes of the file, still packed if it is a container. The cap holds for them too.
pub(crate) fn open(path: &Path, options: &ReadOptions) -> Result<Source, ReadError> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_file() && metadata.len() > options.max_bytes {
        return Err(ReadError::TooLarge { cap: options.max_bytes });
    }
    #[cfg(feature = "mmap")]
    if metadata.is_file() && metadata.len() > 0 {
        // What cannot be mapped (some network and virtual file systems) can still be read.
        if let Ok(map) = map(&file) {
            return Ok(Source::Mapped(map));
        }
    }
    Ok(Source::Memory(read_capped(file, options.max_bytes)?))
}

/// Reads to the end, or to the cap and fails; no size that is declared anywhere is trusted.
pub(crate) fn read_capped(reader: impl Read, cap: u64) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    append_capped(&mut bytes, reader, cap)?;
    Ok(bytes)
}

/// As [`read_capped`], but what was read before an error is there.
pub(crate) fn append_capped(bytes: &mut Vec<u8>, reader: impl Read, cap: u64) -> Result<(), ReadError> {
    reader.take(cap.saturating_add(1)).read_to_end(bytes)?;
    if bytes.len() as u64 > cap {
        return Err(ReadError::TooLarge { cap });
    }
    Ok(())
}

#[cfg(feature = "mmap")]
#[expect(
    unsafe_code,
    reason = "a file map is only sound while nobody cuts the file short; a copy of a CAD file of \
                                gigabytes would double the memory that reading takes"
)]
fn map(file: &File) -> std::io::Result<memmap2::Mmap> {
    // SAFETY: the map is private to `Source`, only read, and read as bytes: every content is valid. Another process
    // that changes the file meanwhile may make us see other bytes, which every parser here takes as input like any
    // other (lengths are checked where they are used); one that truncates it ends this process with SIGBUS.
    unsafe { memmap2::Mmap::map(file) }
}
