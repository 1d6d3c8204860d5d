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

    /// What the entity's type is called; for a complex instance the most meaningful of its parts.
    pub fn type_name(&self, index: usize) -> &'a str {
        let instance = self.exchange.at(index);
        match self.kinds[index] {
            kind if instance.is_complex() && kind != Kind::Other => kind.keyword(),
            _ => instance.keyword(),
        }
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
    place_of: FxHashMap<&'a str, usize>,
    met: Vec<(&'a str, Kind, usize)>,
    complex: FxHashMap<&'a str, usize>,
}

impl<'a> Census<'a> {
    fn new() -> Self {
        Self {
            place_of: KEYWORDS.iter().enumerate().map(|(place, &(keyword, _))| (keyword, place)).collect(),
            met: KEYWORDS.iter().map(|&(keyword, kind)| (keyword, kind, 0)).collect(),
            complex: FxHashMap::default(),
        }
    }

    fn admit(&mut self, instance: &Instance<'a>) -> Kind {
        if instance.is_complex() {
            return self.admit_complex(instance);
        }
        let place = self.place(instance.keyword());
        let met = &mut self.met[place];
        met.2 += 1;
        met.1
    }

    /// The place of a keyword in `met`; keywords in lower case have the kind of those in upper case.
    fn place(&mut self, keyword: &'a str) -> usize {
        if let Some(&place) = self.place_of.get(keyword) {
            return place;
        }
        let upper = self.place_of.get(keyword.to_ascii_uppercase().as_str());
        let kind = upper.map_or(Kind::Other, |&place| self.met[place].1);
        self.met.push((keyword, kind, 0));
        self.place_of.insert(keyword, self.met.len() - 1);
        self.met.len() - 1
    }

    fn admit_complex(&mut self, instance: &Instance<'a>) -> Kind {
        let mut kind = Kind::Other;
        for (keyword, _) in instance.parts() {
            let place = self.place(keyword);
            let found = self.met[place].1;
            if found != Kind::Other && (kind == Kind::Other || (found as u8) < kind as u8) {
                kind = found;
            }
        }
        let name = if kind == Kind::Other { instance.keyword() } else { kind.keyword() };
        *self.complex.entry(name).or_default() += 1;
        kind
    }

    fn counts(self) -> Vec<(String, usize)> {
        let mut counts: FxHashMap<String, usize> = FxHashMap::default();
        let simple = self.met.into_iter().map(|(keyword, _, count)| (keyword, count));
        for (keyword, count) in simple.chain(self.complex).filter(|&(_, count)| count > 0) {
            *counts.entry(keyword.to_ascii_uppercase()).or_default() += count;
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
        counts
    }
}
