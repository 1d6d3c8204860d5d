//! Representations: which items belong together, under which units, and which representations are joined.

use rustc_hash::FxHashMap;

use super::keyword::Kind;
use super::table::Table;
use super::units::{UnitTable, Units};

/// A representation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Representation {
    /// Its own name, often empty.
    pub name: String,
    /// Those of its items that exist.
    pub items: Vec<usize>,
    /// The context that gives its units.
    pub context: Option<usize>,
}

/// All representations that may hold the shape of something.
pub(crate) struct Representations {
    by_index: FxHashMap<usize, Representation>,
    in_order: Vec<usize>,
    joined: FxHashMap<usize, Vec<usize>>,
}

impl Representations {
    /// Reads every representation and the relationships that join two as the same shape.
    pub fn new(table: &Table<'_>) -> Self {
        let in_order: Vec<_> =
            (0..table.len()).filter(|&index| is_shape_representation(table.kind(index))).collect();
        let by_index = in_order.iter().map(|&index| (index, read(table, index))).collect();
        let mut joined: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for index in table.of(&[Kind::ShapeRepresentationRelationship, Kind::RepresentationRelationship]) {
            let mut attributes = table.attributes(index).after(2);
            let ends = (attributes.optional_reference(), attributes.optional_reference());
            if let (Some(first), Some(second)) = ends {
                joined.entry(first).or_default().push(second);
                joined.entry(second).or_default().push(first);
            }
        }
        Self { by_index, in_order, joined }
    }

    /// The representation, if the entity is one that may hold a shape.
    pub fn get(&self, index: usize) -> Option<&Representation> {
        self.by_index.get(&index)
    }

    /// All of them, in file order.
    pub fn indices(&self) -> &[usize] {
        &self.in_order
    }

    /// The units of a representation's numbers.
    pub fn units(&self, index: usize, units: &UnitTable) -> Units {
        units.of_context(self.get(index).and_then(|representation| representation.context))
    }

    /// `first` and whatever is joined with it, without entering those that `foreign` names.
    pub fn joined_with(&self, first: usize, foreign: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut found = vec![first];
        let mut next = 0;
        while next < found.len() {
            for &other in self.joined.get(&found[next]).map(Vec::as_slice).unwrap_or_default() {
                if self.get(other).is_some() && !foreign(other) && !found.contains(&other) {
                    found.push(other);
                }
            }
            next += 1;
        }
        found
    }
}

fn read(table: &Table<'_>, index: usize) -> Representation {
    let mut attributes = table.attributes(index);
    Representation {
        name: attributes.text().into_owned(),
        items: attributes.found_references(),
        context: attributes.optional_reference(),
    }
}

/// Whether a representation may hold the shape of a product. Drawings, presentations and construction geometry
/// do not.
fn is_shape_representation(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::TessellatedShapeRepresentationWithAccuracyParameters
            | Kind::TessellatedShapeRepresentation
            | Kind::AdvancedBrepShapeRepresentation
            | Kind::FacetedBrepShapeRepresentation
            | Kind::ElementaryBrepShapeRepresentation
            | Kind::ManifoldSurfaceShapeRepresentation
            | Kind::NonManifoldSurfaceShapeRepresentation
            | Kind::GeometricallyBoundedSurfaceShapeRepresentation
            | Kind::GeometricallyBoundedWireframeShapeRepresentation
            | Kind::EdgeBasedWireframeShapeRepresentation
            | Kind::ShellBasedWireframeShapeRepresentation
            | Kind::CsgShapeRepresentation
            | Kind::ShapeRepresentationWithParameters
            | Kind::ShapeRepresentation
            | Kind::Representation
    )
}
