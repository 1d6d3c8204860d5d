//! What a file that is no exchange file may be instead.

/// A name for the format that these bytes begin, for an error message.
pub(crate) fn looks_like(text: &[u8]) -> Option<&'static str> {
    let trimmed = text.trim_ascii_start();
    let begins =
        |magic: &[u8]| trimmed.len() >= magic.len() && trimmed[..magic.len()].eq_ignore_ascii_case(magic);
    let contains = |word: &[u8]| memchr::memmem::find(&text[..text.len().min(4096)], word).is_some();
    Some(match text {
        _ if begins(b"%PDF") => "a PDF document",
        _ if begins(b"<?xml") || begins(b"<iso_10303") => {
            if contains(b"10303") {
                "STEP-XML (ISO 10303-28), not the clear text of ISO 10303-21"
            } else {
                "XML"
            }
        }
        _ if begins(b"<!DOCTYPE html") || begins(b"<html") => "an HTML page, perhaps a failed download",
        _ if begins(b"version https://git-lfs") => "a Git LFS pointer: the file itself has not been fetched",
        _ if begins(b"solid") && contains(b"facet") => "an STL mesh",
        _ if begins(b"glTF") => "a binary glTF model",
        _ if begins(b"ply\n") || begins(b"ply\r") => "a PLY mesh",
        _ if begins(b"DBRep_DrawableShape") || begins(b"CASCADE Topology") => "an OpenCASCADE B-rep",
        _ if begins(b"**ABCDEF") => "a Parasolid model",
        _ if begins(b"\x89HDF") => "HDF5, perhaps STEP's binary form (ISO 10303-26)",
        _ if begins(b"\xd0\xcf\x11\xe0") => "an OLE compound file, as native CAD formats are",
        _ if begins(b"\x1f\x8b") => "gzip",
        _ if begins(b"PK\x03\x04") || begins(b"PK\x05\x06") => "a zip container",
        _ if begins(b"BZh") => "bzip2: unpack it first",
        _ if begins(b"\xfd7zXZ") => "xz: unpack it first",
        _ if begins(b"7z\xbc\xaf\x27\x1c") => "7-Zip: unpack it first",
        _ if begins(b"Rar!") => "RAR: unpack it first",
        _ if begins(b"\x28\xb5\x2f\xfd") => "Zstandard: unpack it first",
        _ if is_iges(text) => "IGES",
        _ if is_binary_stl(text) => "a binary STL mesh",
        _ => return None,
    })
}

/// Column 73 of the first card holds the section letter S (or C, compressed), then its number.
fn is_iges(text: &[u8]) -> bool {
    let Some(card) = text.get(72..80) else { return false };
    matches!(card[0], b'S' | b'C') && matches!(card[1..].trim_ascii(), b"1" | b"0000001")
}

/// 80 bytes of anything, the number of triangles, 50 bytes for each.
fn is_binary_stl(text: &[u8]) -> bool {
    let Some(&[a, b, c, d]) = text.get(80..84) else { return false };
    let count = u64::from(u32::from_le_bytes([a, b, c, d]));
    count > 0 && text.len() as u64 == 84 + 50 * count
}
