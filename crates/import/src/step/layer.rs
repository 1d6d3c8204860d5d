//! Layers.

use rustc_hash::FxHashMap;

use super::keyword::Kind;
use super::style::styled_item_target;
use super::table::Table;

/// The layers that entities are assigned to.
#[derive(Debug, Default)]
pub(crate) struct Layers {
    by_entity: FxHashMap<usize, Vec<String>>,
}

impl Layers {
    /// Reads every `presentation_layer_assignment`.
    pub fn new(table: &Table<'_>) -> Self {
        let mut layers = Self::default();
        for index in table.of(&[Kind::PresentationLayerAssignment]) {
            let mut attributes = table.attributes(index);
            let name = attributes.text().into_owned();
            attributes.skip(1);
            for item in attributes.found_references() {
                let held = layers.by_entity.entry(styled_item_target(table, item)).or_default();
                if !held.contains(&name) {
                    held.push(name.clone());
                }
            }
        }
        layers
    }

    /// The layers of an entity, by name.
    pub fn of(&self, index: usize) -> &[String] {
        self.by_entity.get(&index).map(Vec::as_slice).unwrap_or_default()
    }
}
