//! Items that annotate a shape and are no part of it.

use rustc_hash::FxHashSet;

use super::keyword::Kind;
use super::table::Table;

/// What annotations show: dimensions, notes and the like, drawn beside the shape.
#[derive(Debug, Default)]
pub(crate) struct Annotations {
    items: FxHashSet<usize>,
}

impl Annotations {
    /// The items of every annotation.
    pub fn new(table: &Table<'_>) -> Self {
        let kinds = [
            Kind::TessellatedAnnotationOccurrence,
            Kind::AnnotationOccurrence,
            Kind::AnnotationCurveOccurrence,
            Kind::AnnotationPlane,
        ];
        let occurrences = table.of(&kinds);
        let items = occurrences.filter_map(|index| table.attributes(index).after(2).optional_reference());
        Self { items: items.collect() }
    }

    /// Whether an item annotates.
    pub fn hold(&self, item: usize) -> bool {
        self.items.contains(&item)
    }
}
