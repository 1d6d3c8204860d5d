//! Telling formats apart by content.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use trimloop_geom::TSpline;
use trimloop_iges::IgesFile;

/// A CAD file format, by what the file begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// ISO 10303-21, plain or in a gzip or zip container; also whatever is nothing else.
    Step,
    /// IGES 5.1 to 5.3, fixed or compressed (also binary, for its reader to refuse).
    Iges,
    /// A T-spline in this project's own text format ([`trimloop_geom::tspline`]).
    TSpline,
}

impl Format {
    /// The format of a file: by its first bytes, and where they are neither's, by its name.
    pub fn of_file(path: &Path) -> std::io::Result<Self> {
        let mut head = Vec::new();
        File::open(path)?.take(4096).read_to_end(&mut head)?;
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let is_named = matches!(extension.as_str(), "igs" | "iges");
        // A file that is called IGES and is none is for the IGES reader to refuse.
        Ok(if is_named && !is_step(&head) { Self::Iges } else { Self::of_bytes(&head) })
    }

    /// The format of a text by its first bytes.
    pub fn of_bytes(head: &[u8]) -> Self {
        if TSpline::looks_like(head) {
            Self::TSpline
        } else if !is_step(head) && IgesFile::looks_like(head) {
            Self::Iges
        } else {
            Self::Step
        }
    }
}

/// Whether the bytes begin an exchange file or a container of one.
fn is_step(head: &[u8]) -> bool {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    text.starts_with(b"ISO-10303") || head.starts_with(b"PK\x03\x04") || head.starts_with(&[0x1f, 0x8b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exchange_files_are_step() {
        assert_eq!(Format::of_bytes(b"ISO-10303-21;\nHEADER;"), Format::Step);
    }

    #[test]
    fn first_card_with_start_mark_is_iges() {
        let card = format!("{:<72}S      1\n", "a part");
        assert_eq!(Format::of_bytes(card.as_bytes()), Format::Iges);
    }

    #[test]
    fn compressed_and_binary_iges_are_iges() {
        let flag = format!("{:<72}C      1\n", "");
        assert_eq!(Format::of_bytes(flag.as_bytes()), Format::Iges);
        assert_eq!(Format::of_bytes(b"B\x00\x00\x00\x55rest"), Format::Iges);
    }

    #[test]
    fn nothing_is_step_so_that_its_reader_says_what_is_wrong() {
        assert_eq!(Format::of_bytes(b""), Format::Step);
    }
}
