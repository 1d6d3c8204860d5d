//! The exchange structure: the text and the table of its records.

use crate::anchor::{Anchor, Entry, ExternalReference};
use crate::check::check_all;
use crate::fault::{Damage, DamageList};
use crate::ids::IdTable;
use crate::layout::{SectionStart, lay_out};
use crate::looks_like::looks_like;
use crate::position::LineIndex;
use crate::record::Record;
use crate::source::Source;
use crate::{Header, Instance, Position, ReadError, ReadOptions, SyntaxError};
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;

/// A parsed exchange structure.
#[derive(Debug)]
pub struct Exchange {
    text: Source,
    header: Header,
    records: Vec<Record>,
    ids: IdTable,
    sections: Vec<DataSection>,
    anchors: Vec<Entry>,
    references: Vec<Entry>,
    errors: Vec<SyntaxError>,
    lines: OnceLock<LineIndex>,
}

/// A DATA section.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSection {
    /// Its name; empty where the file gives none, as with only one section.
    pub name: String,
    /// The schemas it follows; empty where only the header names them.
    pub schemas: Vec<String>,
    /// Table indices of its instances.
    pub instances: Range<usize>,
}

impl Exchange {
    /// Opens a file, a gzip or zip container included.
    ///
    /// With the feature `mmap` the file is mapped and must not be cut short while the result lives.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, ReadError> {
        Self::from_source(crate::open::open(path, options)?, options)
    }

    /// Parses a text that is in memory; a gzip or zip container is unpacked.
    pub fn parse(text: Vec<u8>) -> Result<Self, ReadError> {
        Self::parse_with(text, &ReadOptions::default())
    }

    /// As [`Self::parse`], with other limits.
    pub fn parse_with(text: Vec<u8>, options: &ReadOptions) -> Result<Self, ReadError> {
        Self::from_source(Source::Memory(text), options)
    }

    fn from_source(source: Source, options: &ReadOptions) -> Result<Self, ReadError> {
        if source.len() as u64 > options.max_bytes {
            return Err(ReadError::TooLarge { cap: options.max_bytes });
        }
        let text = decoded(unpacked(source, options)?);
        let start = text_start(&text)?;
        let mut layout = lay_out(&text, start, options.max_errors);
        check_all(&text, &mut layout.records, &mut layout.damage);
        if layout.records.len() >= u32::MAX as usize {
            return Err(ReadError::NotPart21("the file has more than 4,294,967,294 instances".into()));
        }
        let ids = index(&mut layout.records, &mut layout.damage);
        layout.records.shrink_to_fit();
        if layout.records.is_empty() && !text[start..].starts_with(MAGIC) {
            return Err(ReadError::NotPart21(
                "this is not a STEP file (ISO 10303-21): it has no instance".into(),
            ));
        }
        let mut exchange = Exchange {
            sections: sections(layout.sections, &layout.records),
            text,
            header: layout.header,
            records: layout.records,
            ids,
            anchors: layout.anchors,
            references: layout.references,
            errors: Vec::new(),
            lines: OnceLock::new(),
        };
        exchange.errors = exchange.errors_of(layout.damage);
        Ok(exchange)
    }

    fn errors_of(&self, damage: DamageList) -> Vec<SyntaxError> {
        let (kept, left_out) = damage.into_sorted();
        let error = |damage: Damage| SyntaxError {
            position: self.position(damage.offset),
            instance: damage.instance,
            message: damage.message.into(),
        };
        let mut errors: Vec<SyntaxError> = kept.into_iter().map(error).collect();
        if left_out > 0 {
            let position = errors.last().map_or(Position { line: 1, column: 1 }, |last| last.position);
            errors.push(SyntaxError {
                position,
                instance: None,
                message: format!("and {left_out} more errors"),
            });
        }
        errors
    }

    /// The HEADER section.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// What was damaged, in file order; each damaged record is one error and is missing from the table, unless only
    /// its `;` is missing or something is left over before it.
    pub fn errors(&self) -> &[SyntaxError] {
        &self.errors
    }

    /// The DATA sections in file order.
    pub fn sections(&self) -> &[DataSection] {
        &self.sections
    }

    /// The ANCHOR section (edition 3).
    pub fn anchors(&self) -> impl Iterator<Item = Anchor<'_>> {
        self.anchors.iter().filter_map(|entry| entry.as_anchor(&self.text))
    }

    /// The REFERENCE section (edition 3).
    pub fn references(&self) -> impl ExactSizeIterator<Item = ExternalReference<'_>> {
        self.references.iter().map(|entry| entry.as_reference(&self.text))
    }

    /// Number of instances.
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there is no instance.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The instance at `index` of the table, in file order.
    ///
    /// # Panics
    ///
    /// If `index` is not less than [`Self::len`].
    pub fn at(&self, index: usize) -> Instance<'_> {
        Instance::new(&self.text, &self.records[index])
    }

    /// The instance named `#id`.
    pub fn get(&self, id: u64) -> Option<Instance<'_>> {
        self.index_of(id).map(|index| self.at(index))
    }

    /// The table index of the instance named `#id`.
    pub fn index_of(&self, id: u64) -> Option<usize> {
        self.ids.index_of(&self.records, id)
    }

    /// All instances in file order.
    pub fn instances(&self) -> impl ExactSizeIterator<Item = Instance<'_>> {
        (0..self.len()).map(|i| self.at(i))
    }

    /// Line and column of a byte offset. The first call counts the lines of the whole text, later ones at most those
    /// of 4 KiB.
    pub fn position(&self, offset: usize) -> Position {
        self.lines.get_or_init(|| LineIndex::new(&self.text)).position(&self.text, offset)
    }

    /// The whole text: unpacked, and as UTF-8 if it was UTF-16. Offsets count its bytes.
    pub fn text(&self) -> &[u8] {
        &self.text
    }
}

const MAGIC: &[u8] = b"ISO-10303-21";

/// How far into the file the magic may be, after what some mail and PDM systems put before it.
const MAGIC_WITHIN: usize = 1 << 16;

fn unpacked(source: Source, options: &ReadOptions) -> Result<Source, ReadError> {
    #[cfg(feature = "compression")]
    if let Some(text) = crate::container::unpack(&source, options)? {
        return Ok(Source::Memory(text));
    }
    let _ = options;
    Ok(source)
}

fn decoded(source: Source) -> Source {
    match crate::utf16::to_utf8(&source) {
        Some(text) => Source::Memory(text),
        None => source,
    }
}

/// Where the first statement starts, if these bytes can be an exchange file at all.
fn text_start(text: &[u8]) -> Result<usize, ReadError> {
    let head = &text[..text.len().min(MAGIC_WITHIN)];
    if text.is_empty() {
        return Err(ReadError::NotPart21("the file is empty".into()));
    }
    if text.iter().all(|&byte| byte <= b' ') {
        return Err(ReadError::NotPart21("the file is empty but for blanks or zeros".into()));
    }
    if let Some(start) = memchr::memmem::find(head, MAGIC) {
        return Ok(start);
    }
    let without_mark = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let start = crate::grammar::space(without_mark);
    if start.starts_with(b"#") || crate::layout::section_word(start).is_some() {
        return Ok(text.len() - start.len());
    }
    let what = looks_like(text).map_or(String::new(), |what| format!("; it looks like {what}"));
    Err(ReadError::NotPart21(format!("this is not a STEP file (ISO 10303-21){what}")))
}

/// The table of numbers. Of records with the same number the first stays, the others are reported and removed.
fn index(records: &mut Vec<Record>, damage: &mut DamageList) -> IdTable {
    let repeated = match IdTable::new(records) {
        Ok(table) => return table,
        Err(repeated) => repeated,
    };
    for index in repeated {
        let record = &mut records[index as usize];
        let message = "an instance with this number was already there: only the first one counts";
        damage.push(Damage { offset: record.start, instance: Some(record.id), message });
        record.length = 0;
    }
    records.retain(Record::is_usable);
    // Nothing is repeated now.
    IdTable::new(records).unwrap_or(IdTable::Sorted(Vec::new()))
}

fn sections(starts: Vec<SectionStart>, records: &[Record]) -> Vec<DataSection> {
    let first = |start: &SectionStart| records.partition_point(|record| record.start < start.offset);
    let firsts: Vec<usize> = starts.iter().map(first).chain([records.len()]).collect();
    let ranges = firsts.windows(2).map(|pair| pair[0]..pair[1]);
    starts
        .into_iter()
        .zip(ranges)
        .map(|(start, instances)| DataSection { name: start.name, schemas: start.schemas, instances })
        .collect()
}
