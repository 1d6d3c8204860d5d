//! The Directory section (IGES 5.3 section 2.2.4.4): two lines of ten fields for each entity.

use crate::lines::Line;
use crate::value::decode;

/// What the directory says of an entity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DirectoryEntry {
    /// The number of its first line: what pointers name.
    pub number: u32,
    /// The entity's type.
    pub entity_type: i32,
    /// The number of its first line in the Parameter section.
    pub parameters: u32,
    /// How many lines it has there.
    pub parameter_lines: u32,
    /// Its level; less than 0 is a pointer to a list of levels.
    pub level: i32,
    /// Pointer to its transformation; 0 for none.
    pub transformation: u32,
    /// Its colour's number; less than 0 is a pointer to a colour.
    pub color: i32,
    /// Its form.
    pub form: i32,
    /// Its status.
    pub status: Status,
    /// Its label, with the subscript if there is one.
    pub label: String,
    /// Pointer to its structure's definition, less than 0; else its version, or 0.
    pub structure: i32,
    /// The line of the file that it begins in, from 1.
    pub line: usize,
}

/// The four pairs of digits of field 9.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Status {
    /// Whether it is not to be shown.
    pub blanked: bool,
    /// 0 independent, 1 physically dependent, 2 logically dependent, 3 both.
    pub subordinate: u8,
    /// 0 geometry, 1 annotation, 2 definition, 3 other, 4 logical, 5 parametric, 6 construction.
    pub usage: u8,
    /// 0 its attributes hold for what it contains, 1 they do not, 2 as a property says.
    pub hierarchy: u8,
}

impl Status {
    fn of(field: &[u8]) -> Self {
        let digits: Vec<u8> = field.iter().map(|b| if b.is_ascii_digit() { b - b'0' } else { 0 }).collect();
        let pair = |k: usize| 10 * digits[2 * k] + digits[2 * k + 1];
        Self { blanked: pair(0) == 1, subordinate: pair(1), usage: pair(2), hierarchy: pair(3) }
    }
}

impl DirectoryEntry {
    /// The entry of two lines; where a field is no number, its place and 0.
    pub(crate) fn of(first: &Line<'_>, second: &Line<'_>, number: u32) -> (Self, Vec<String>) {
        let mut wrong = Vec::new();
        let mut integer = |line: &Line<'_>, field: usize, name: &str| -> i32 {
            let text = std::str::from_utf8(column(line, field)).unwrap_or("?").trim();
            match text.parse() {
                Ok(value) => value,
                Err(_) if text.is_empty() => 0,
                Err(_) => {
                    wrong.push(format!("the {name} (\"{text}\") is no number"));
                    0
                }
            }
        };
        let mut entry = Self {
            number,
            entity_type: integer(first, 0, "entity type"),
            parameters: integer(first, 1, "parameter data pointer").unsigned_abs(),
            structure: integer(first, 2, "structure"),
            level: integer(first, 4, "level"),
            transformation: integer(first, 6, "transformation pointer").unsigned_abs(),
            status: Status::of(column(first, 8)),
            line: first.number,
            ..Self::default()
        };
        entry.color = integer(second, 2, "colour");
        entry.parameter_lines = integer(second, 3, "parameter line count").max(0).unsigned_abs();
        entry.form = integer(second, 4, "form");
        entry.label = decode(column(second, 7)).trim().to_owned();
        let subscript = integer(second, 8, "subscript");
        if !entry.label.is_empty() && subscript != 0 {
            entry.label += &format!("({subscript})");
        }
        if entry.entity_type == 0 {
            entry.entity_type = integer(second, 0, "entity type");
        }
        (entry, wrong)
    }
}

/// Eight columns.
fn column<'a>(line: &Line<'a>, field: usize) -> &'a [u8] {
    &line.text[8 * field..8 * field + 8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Section;

    fn entry(first: &str, second: &str) -> (DirectoryEntry, Vec<String>) {
        let texts = [first, second].map(|text| format!("{text:<72}").into_bytes());
        let [first, second] =
            [0, 1].map(|k| Line { section: Section::Directory, text: &texts[k], number: 7 });
        DirectoryEntry::of(&first, &second, 3)
    }

    #[test]
    fn fields_are_eight_columns_wide() {
        let (entry, wrong) = entry(
            "     128      12       0       0       5       0      21       001020304",
            "     128       0      -9       3       1                   BLADE      12",
        );
        assert!(wrong.is_empty(), "{wrong:?}");
        assert_eq!((entry.entity_type, entry.parameters, entry.parameter_lines), (128, 12, 3));
        assert_eq!((entry.level, entry.transformation, entry.color, entry.form), (5, 21, -9, 1));
        assert_eq!(entry.label, "BLADE(12)");
        let status = Status { blanked: true, subordinate: 2, usage: 3, hierarchy: 4 };
        assert_eq!(entry.status, status);
    }

    #[test]
    fn a_field_that_is_no_number_is_reported() {
        let (_, wrong) = entry("     116       x", "     116");
        assert_eq!(wrong, ["the parameter data pointer (\"x\") is no number"]);
    }
}
