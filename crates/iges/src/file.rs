//! A file's sections put together.

use std::ops::Range;

use crate::compressed;
use crate::directory::DirectoryEntry;
use crate::global::LAST_OF_UNITS;
use crate::lines::{Line, Sheet, lines, look_like_iges};
use crate::value::decode;
use crate::{Entity, Global, ReadError, Section, SyntaxError};

/// Columns of a Parameter line that hold parameters; the others point back to the directory.
const PARAMETER_WIDTH: usize = 64;

/// An IGES file.
#[derive(Clone, Debug)]
pub struct IgesFile {
    start: String,
    global: Global,
    directory: Vec<DirectoryEntry>,
    /// Per directory entry its part of `text`.
    ranges: Vec<Range<usize>>,
    text: Vec<u8>,
    errors: Vec<SyntaxError>,
}

impl IgesFile {
    /// Reads the bytes of a file. Damage costs no more than what is damaged: see [`Self::errors`].
    pub fn parse(bytes: &[u8]) -> Result<Self, ReadError> {
        let mut sheet = lines(bytes)?;
        let mut errors: Vec<SyntaxError> =
            sheet.strays.iter().take(MAX_STRAYS).map(|&line| stray(line)).collect();
        let is_compressed = sheet.count(Section::Flag) > 0;
        if is_compressed {
            errors.clear();
            sheet = compressed::expanded(bytes, &mut errors)?;
        }
        let joined =
            |section| sheet.of(section).flat_map(|line| line.text.iter().copied()).collect::<Vec<u8>>();
        let start: Vec<String> =
            sheet.of(Section::Start).map(|line| decode(line.text).trim_end().to_owned()).collect();
        let directory = directory(&sheet.of(Section::Directory).collect::<Vec<_>>(), &mut errors);
        let parameters: Vec<Line<'_>> = sheet.of(Section::Parameter).collect();
        let (text, ranges) = assemble(&directory, &parameters, &mut errors);
        check_terminate(&sheet, &mut errors);
        let global = Global::parse(&joined(Section::Global));
        if global.parameter_count < LAST_OF_UNITS {
            let message = format!(
                "it ends after {} parameters, before it says what the units are; inches are assumed",
                global.parameter_count
            );
            let line = sheet.of(Section::Global).last().map_or(0, |line| line.number);
            errors.push(SyntaxError { line, section: Section::Global, entry: None, message });
        }
        Ok(Self { start: start.join("\n"), global, directory, ranges, text, errors })
    }

    /// Whether a file that begins with `head` is IGES, in any of its forms.
    pub fn looks_like(head: &[u8]) -> bool {
        look_like_iges(head)
    }

    /// The Start section: words for people.
    pub fn start(&self) -> &str {
        &self.start
    }

    /// The Global section.
    pub fn global(&self) -> &Global {
        &self.global
    }

    /// What does not follow the specification.
    pub fn errors(&self) -> &[SyntaxError] {
        &self.errors
    }

    /// Number of entities.
    pub fn len(&self) -> usize {
        self.directory.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.directory.is_empty()
    }

    /// The entity whose directory entry begins with line `number` of the Directory section; what pointers name.
    pub fn get(&self, number: u32) -> Option<Entity<'_>> {
        let index = (number.checked_sub(1)? / 2) as usize;
        (number % 2 == 1).then(|| self.nth(index)).flatten()
    }

    /// All entities, in the directory's order.
    pub fn entities(&self) -> impl ExactSizeIterator<Item = Entity<'_>> {
        (0..self.directory.len()).map(|index| self.nth(index).expect("it is in the directory"))
    }

    fn nth(&self, index: usize) -> Option<Entity<'_>> {
        let directory = self.directory.get(index)?;
        let text = &self.text[self.ranges[index].clone()];
        Some(Entity { directory, text, delimiters: self.global.delimiters })
    }
}

/// So many lines without a section are reported one by one.
const MAX_STRAYS: usize = 20;

fn stray(line: usize) -> SyntaxError {
    let message = "the line has no section letter in column 73".to_owned();
    SyntaxError { line, section: Section::Start, entry: None, message }
}

fn directory(lines: &[Line<'_>], errors: &mut Vec<SyntaxError>) -> Vec<DirectoryEntry> {
    let mut out = Vec::with_capacity(lines.len() / 2);
    for pair in lines.chunks(2) {
        let number = 2 * out.len() as u32 + 1;
        let error = |message: String, line: usize| SyntaxError {
            line,
            section: Section::Directory,
            entry: Some(number),
            message,
        };
        let [first, second] = pair else {
            errors.push(error("the entry's second line is missing".to_owned(), pair[0].number));
            continue;
        };
        let (entry, wrong) = DirectoryEntry::of(first, second, number);
        errors.extend(wrong.into_iter().map(|message| error(message, first.number)));
        out.push(entry);
    }
    out
}

/// The parameters' text without the pointers back, and where each entity's part of it lies.
fn assemble(
    directory: &[DirectoryEntry],
    lines: &[Line<'_>],
    errors: &mut Vec<SyntaxError>,
) -> (Vec<u8>, Vec<Range<usize>>) {
    let text = lines.iter().flat_map(|line| line.text[..PARAMETER_WIDTH].iter().copied()).collect();
    let runs = runs(lines);
    let mut ranges = Vec::with_capacity(directory.len());
    for entry in directory {
        let told = told_range(entry, lines);
        // What the lines themselves say of the entity that they belong to is worth more than a count.
        let run = runs.get(&entry.number).cloned();
        let range = match (told, run) {
            (Some(told), Some(run)) if run.start == told.start => run,
            (Some(told), None) => told,
            (_, Some(run)) => run,
            (None, None) => {
                let message = format!("entity D{} has no parameter data", entry.number);
                let section = Section::Directory;
                errors.push(SyntaxError { line: entry.line, section, entry: Some(entry.number), message });
                0..0
            }
        };
        ranges.push(range.start * PARAMETER_WIDTH..range.end * PARAMETER_WIDTH);
    }
    (text, ranges)
}

/// The lines that the directory names.
fn told_range(entry: &DirectoryEntry, lines: &[Line<'_>]) -> Option<Range<usize>> {
    let first = (entry.parameters as usize).checked_sub(1).filter(|first| *first < lines.len())?;
    let count = (entry.parameter_lines as usize).clamp(1, lines.len() - first);
    Some(first..first + count)
}

/// By the directory entry that lines point back to, the first run of such lines.
fn runs(lines: &[Line<'_>]) -> std::collections::HashMap<u32, Range<usize>> {
    let mut out = std::collections::HashMap::new();
    let back = |line: &Line<'_>| -> Option<u32> {
        std::str::from_utf8(&line.text[PARAMETER_WIDTH..]).ok()?.trim().parse().ok()
    };
    let mut at = 0;
    while at < lines.len() {
        let entry = back(&lines[at]);
        let length = lines[at..].iter().take_while(|line| back(line) == entry).count();
        if let Some(entry) = entry {
            out.entry(entry).or_insert(at..at + length);
        }
        at += length;
    }
    out
}

/// Whether the last line's counts are those of the sections.
fn check_terminate(sheet: &Sheet, errors: &mut Vec<SyntaxError>) {
    let Some(end) = sheet.of(Section::Terminate).next() else {
        let message = "the file ends without a Terminate section; it may be cut off".to_owned();
        let line = sheet.last_number();
        errors.push(SyntaxError { line, section: Section::Terminate, entry: None, message });
        return;
    };
    for (field, section) in
        [(0, Section::Start), (1, Section::Global), (2, Section::Directory), (3, Section::Parameter)]
    {
        let told = decode(&end.text[8 * field + 1..8 * field + 8]).trim().parse::<usize>();
        let found = sheet.count(section);
        if let Ok(told) = told
            && told != found
        {
            let message = format!("it counts {told} lines of the {section} section, which has {found}");
            errors.push(SyntaxError { line: end.number, section: Section::Terminate, entry: None, message });
        }
    }
}
