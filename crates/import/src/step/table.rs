//! The entity table with every record's kind.

use rustc_hash::FxHashMap;
use trimloop_brep::EntityRef;
use trimloop_part21::{Exchange, Instance};

use super::attributes::Attributes;
use super::keyword::{KEYWORDS, Kind};

/// The entity table of a file, each record classified once; entities go by their index in it.
pub(crate) struct Table<'a> {
    exchange: &'a Exchange,
    kinds: Vec<Kind>,
    counts: Vec<(String, usize)>,
}

impl<'a> Table<'a> {
    /// Classifies every record.
    pub fn new(exchange: &'a Exchange) -> Self {
        let mut census = Census::new();
        let kinds = exchange.instances().map(|instance| census.admit(&instance)).collect();
        Self { exchange, kinds, counts: census.counts() }
    }

    /// Number of entities.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// Entity counts by type name, most frequent first.
    pub fn counts(&self) -> &[(String, usize)] {
        &self.counts
    }

    /// The file behind it.
    pub fn exchange(&self) -> &'a Exchange {
        self.exchange
    }

    /// What the entity is.
    pub fn kind(&self, index: usize) -> Kind {
        self.kinds[index]
    }

    /// The indices of all entities of some kinds, in file order.
    pub fn of<'s>(&'s self, wanted: &'s [Kind]) -> impl Iterator<Item = usize> + 's {
        self.kinds.iter().enumerate().filter(move |(_, kind)| wanted.contains(kind)).map(|(index, _)| index)
    }

    /// The number after `#`.
    pub fn id(&self, index: usize) -> u64 {
        self.exchange.at(index).id()
    }

    /// The entity's name in diagnostics.
    pub fn entity(&self, index: usize) -> EntityRef {
        EntityRef::Step(self.id(index))
    }

    /// The record.
    pub fn instance(&self, index: usize) -> Instance<'a> {
        self.exchange.at(index)
    }

    /// The index of `#id`.
    pub fn find(&self, id: u64) -> Option<usize> {
        self.exchange.index_of(id)
    }

    /// The entity's attributes, inherited ones first, from the first one on.
    pub fn attributes(&self, index: usize) -> Attributes<'_> {
        Attributes::new(self, index)
    }
}

/// Keywords met so far, with their kind and count.
struct Census<'a> {
    known: FxHashMap<&'a str, (Kind, usize)>,
    complex: FxHashMap<String, usize>,
}

impl<'a> Census<'a> {
    fn new() -> Self {
        Self {
            known: KEYWORDS.iter().map(|&(keyword, kind)| (keyword, (kind, 0))).collect(),
            complex: FxHashMap::default(),
        }
    }

    fn admit(&mut self, instance: &Instance<'a>) -> Kind {
        if instance.is_complex() {
            self.admit_complex(instance)
        } else {
            let entry = self.look_up(instance.keyword());
            entry.1 += 1;
            entry.0
        }
    }

    fn look_up(&mut self, keyword: &'a str) -> &mut (Kind, usize) {
        if !self.known.contains_key(keyword) {
            let kind =
                self.known.get(keyword.to_ascii_uppercase().as_str()).map_or(Kind::Other, |known| known.0);
            self.known.insert(keyword, (kind, 0));
        }
        self.known.get_mut(keyword).expect("inserted above")
    }

    fn admit_complex(&mut self, instance: &Instance<'a>) -> Kind {
        let kind = instance
            .parts()
            .map(|(keyword, _)| self.look_up(keyword).0)
            .filter(|&kind| kind != Kind::Other)
            .min_by_key(|&kind| kind as u8)
            .unwrap_or(Kind::Other);
        let name = if kind == Kind::Other { instance.keyword() } else { kind.keyword() };
        *self.complex.entry(name.to_owned()).or_default() += 1;
        kind
    }

    fn counts(self) -> Vec<(String, usize)> {
        let mut counts = self.complex;
        for (keyword, (_, count)) in self.known {
            if count > 0 {
                *counts.entry(keyword.to_ascii_uppercase()).or_default() += count;
            }
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        counts
    }
}
