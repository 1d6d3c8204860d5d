//! Files that an editor or a tool stored as UTF-16.

use encoding_rs::{Encoding, UTF_16BE, UTF_16LE};

/// The text as UTF-8, or nothing if it is not UTF-16.
pub(crate) fn to_utf8(bytes: &[u8]) -> Option<Vec<u8>> {
    let encoding: &'static Encoding = match bytes {
        [0xff, 0xfe, ..] => UTF_16LE,
        [0xfe, 0xff, ..] => UTF_16BE,
        // Without a byte order mark, the `ISO-10303-21` that every file begins with.
        [b'I', 0, b'S', 0, ..] => UTF_16LE,
        [0, b'I', 0, b'S', ..] => UTF_16BE,
        _ => return None,
    };
    Some(encoding.decode_with_bom_removal(bytes).0.into_owned().into_bytes())
}
