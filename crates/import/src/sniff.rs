//! Telling formats apart by content.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A CAD file format, by what the file begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// ISO 10303-21, plain or in a gzip or zip container; also whatever is nothing else.
    Step,
    /// IGES 5.3 with fixed 80-column cards.
    Iges,
}

impl Format {
    /// The format of a file by its first bytes.
    pub fn of_file(path: &Path) -> std::io::Result<Self> {
        let mut head = Vec::new();
        File::open(path)?.take(4096).read_to_end(&mut head)?;
        Ok(Self::of_bytes(&head))
    }

    /// The format of a text by its first bytes.
    pub fn of_bytes(head: &[u8]) -> Self {
        if is_iges(head) { Self::Iges } else { Self::Step }
    }
}

/// Column 73 of the first card holds the letter of the start section, the columns after it the number 1.
fn is_iges(head: &[u8]) -> bool {
    let Some(mark) = head.get(72..80) else { return false };
    mark[0] == b'S' && mark[1..].trim_ascii().iter().all(u8::is_ascii_digit) && mark[7] == b'1'
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
    fn nothing_is_step_so_that_its_reader_says_what_is_wrong() {
        assert_eq!(Format::of_bytes(b""), Format::Step);
    }
}
