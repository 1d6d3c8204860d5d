//! A file's sections put together.

use std::ops::Range;

use crate::compressed::{self, ends};
use crate::directory::DirectoryEntry;
use crate::global::LAST_OF_UNITS;
use crate::lines::{BACK_WIDTH, Line, PARAMETER_WIDTH, Sheet, lines, look_like_iges};
use crate::value::decode;
use crate::{Delimiters, Entity, Global, ReadError, Section, SyntaxError};

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
        let global = Global::parse(&joined(Section::Global));
        let ranges = ranges(&directory, &sheet, global.delimiters, &mut errors);
        check_terminate(&sheet, &mut errors);
        if global.parameter_count < LAST_OF_UNITS {
            let message = format!(
                "it ends after {} parameters, before it says what the units are; inches are assumed",
                global.parameter_count
            );
            let line = sheet.of(Section::Global).last().map_or(0, |line| line.number);
            errors.push(SyntaxError { line, section: Section::Global, entry: None, message });
        }
        let text = sheet.parameters;
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

/// Where each entity's part of the parameters' text lies, by what the Parameter lines point back to.
fn ranges(
    directory: &[DirectoryEntry],
    sheet: &Sheet,
    delimiters: Delimiters,
    errors: &mut Vec<SyntaxError>,
) -> Vec<Range<usize>> {
    let backs = &sheet.backs;
    let runs = runs(backs);
    let mut records = Records::new(directory, sheet, delimiters);
    let mut ranges = Vec::with_capacity(directory.len());
    for entry in directory {
        let told = told_range(entry, backs.len());
        // What the lines themselves say of the entity that they belong to is worth more than a count.
        let run = runs.get(&entry.number).cloned();
        let range = match (told, run) {
            (Some(told), Some(run)) if run.start == told.start => run,
            (Some(told), None) => records.whole(told),
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
    ranges
}

/// Those of `lines` Parameter lines that the directory names.
fn told_range(entry: &DirectoryEntry, lines: usize) -> Option<Range<usize>> {
    let first = (entry.parameters as usize).checked_sub(1).filter(|first| *first < lines)?;
    let count = (entry.parameter_lines as usize).clamp(1, lines - first);
    Some(first..first + count)
}

/// Finds where records end whose entries count too few lines, and that no lines point back to.
struct Records<'a> {
    sheet: &'a Sheet,
    delimiters: Delimiters,
    /// The lines at which records begin, in order.
    starts: Vec<usize>,
    /// Lines that may still be gone through, lest entries that all begin at the same line cost its length each.
    lines_left: usize,
}

impl<'a> Records<'a> {
    fn new(directory: &[DirectoryEntry], sheet: &'a Sheet, delimiters: Delimiters) -> Self {
        let starts = directory.iter().filter_map(|entry| (entry.parameters as usize).checked_sub(1));
        let mut starts: Vec<usize> = starts.collect();
        starts.sort_unstable();
        Self { sheet, delimiters, starts, lines_left: 4 * sheet.backs.len() }
    }

    /// The lines told, and where they do not end a record those up to where another entity's begin.
    fn whole(&mut self, told: Range<usize>) -> Range<usize> {
        let next = self.starts.partition_point(|&start| start < told.end);
        let end = self.starts.get(next).copied().unwrap_or(usize::MAX).min(self.sheet.backs.len());
        if end <= told.end || self.ends(told.clone()) {
            return told;
        }
        let longer = told.start..end;
        if self.ends(longer.clone()) { longer } else { told }
    }

    fn ends(&mut self, lines: Range<usize>) -> bool {
        let Some(left) = self.lines_left.checked_sub(lines.len()) else { return true };
        self.lines_left = left;
        let columns = lines.start * PARAMETER_WIDTH..lines.end * PARAMETER_WIDTH;
        ends(&self.sheet.parameters[columns], self.delimiters)
    }
}

/// By the directory entry that lines point back to, the first run of such lines.
fn runs(backs: &[[u8; BACK_WIDTH]]) -> std::collections::HashMap<u32, Range<usize>> {
    let mut out = std::collections::HashMap::new();
    let number = |columns: &[u8]| -> Option<u32> { std::str::from_utf8(columns).ok()?.trim().parse().ok() };
    let mut at = 0;
    while at < backs.len() {
        let first = backs[at];
        let entry = number(&first);
        let same = |back: &&[u8; BACK_WIDTH]| **back == first || number(*back) == entry;
        let length = backs[at..].iter().take_while(same).count();
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
        let line = sheet.last().map_or(0, |last| last.1);
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
