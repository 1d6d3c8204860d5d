//! Exchange files inside gzip and zip containers, known by their first bytes.

use crate::open::{append_capped, read_capped};
use crate::{ReadError, ReadOptions};
use std::io::{Cursor, Read, Seek};

/// Containers inside containers that are opened: `.stp.gz` inside a zip is seen in the wild, more is a trap.
const MAX_LAYERS: usize = 2;

/// The text inside the container, or nothing if these bytes are no container.
pub(crate) fn unpack(bytes: &[u8], options: &ReadOptions) -> Result<Option<Vec<u8>>, ReadError> {
    let mut unpacked: Option<Vec<u8>> = None;
    for _ in 0..MAX_LAYERS {
        let layer = unpacked.as_deref().unwrap_or(bytes);
        let inside = match layer {
            [0x1f, 0x8b, ..] => gunzip(layer, options.max_bytes)?,
            [b'P', b'K', 3, 4, ..] | [b'P', b'K', 5, 6, ..] => unzip(layer, options.max_bytes)?,
            _ => break,
        };
        unpacked = Some(inside);
    }
    Ok(unpacked)
}

/// The error for a container that is broken, as opposed to too large.
fn damaged(kind: &str, error: ReadError) -> ReadError {
    match error {
        ReadError::Io(error) => ReadError::NotPart21(format!("the {kind} container is damaged: {error}")),
        other => other,
    }
}

fn gunzip(bytes: &[u8], cap: u64) -> Result<Vec<u8>, ReadError> {
    let mut text = Vec::new();
    match append_capped(&mut text, flate2::bufread::MultiGzDecoder::new(bytes), cap) {
        // Padding after the last member looks like damage, but then the text is all there.
        Err(ReadError::Io(_)) if memchr::memmem::rfind(&text, b"END-ISO-10303-21").is_some() => Ok(text),
        Err(error) => Err(damaged("gzip", error)),
        Ok(()) => Ok(text),
    }
}

fn unzip(bytes: &[u8], cap: u64) -> Result<Vec<u8>, ReadError> {
    let not_readable = |error| ReadError::NotPart21(format!("the zip container cannot be read: {error}"));
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(not_readable)?;
    let Some(index) = choose_entry(&mut archive) else {
        return Err(ReadError::NotPart21("the zip container has no file in it".into()));
    };
    let entry = archive.by_index(index).map_err(not_readable)?;
    read_capped(entry, cap).map_err(|error| damaged("zip", error))
}

/// The first entry that is named as STEP files are, else the largest by what the archive says of it.
fn choose_entry<R: Read + Seek>(archive: &mut zip::ZipArchive<R>) -> Option<usize> {
    let mut largest = None;
    for index in 0..archive.len() {
        let Ok(entry) = archive.by_index_raw(index) else { continue };
        if !entry.is_file() {
            continue;
        }
        let name = entry.name().to_ascii_lowercase();
        if [".stp", ".step", ".p21", ".stp.gz", ".step.gz"].iter().any(|ending| name.ends_with(ending)) {
            return Some(index);
        }
        if largest.is_none_or(|(size, _)| entry.size() > size) {
            largest = Some((entry.size(), index));
        }
    }
    largest.map(|(_, index)| index)
}
