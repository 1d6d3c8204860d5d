//! Representations: which items belong together, under which units, and which representations are joined.

use std::collections::VecDeque;

use rustc_hash::{FxHashMap, FxHashSet};

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
    listed: FxHashSet<(usize, usize)>,
    joined: FxHashMap<usize, Vec<usize>>,
    attachments: Vec<Attachment>,
    claimed: FxHashSet<usize>,
    of_pair: FxHashMap<(usize, usize), VecDeque<usize>>,
}

/// A `representation_relationship_with_transformation`: the first representation stands in the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Attachment {
    /// The relationship.
    pub relationship: usize,
    /// `rep_1`.
    pub first: usize,
    /// `rep_2`.
    pub second: usize,
}

impl Representations {
    /// Reads every representation and the relationships that join two as the same shape.
    pub fn new(table: &Table<'_>) -> Self {
        let in_order: Vec<_> =
            (0..table.len()).filter(|&index| is_shape_representation(table.kind(index))).collect();
        let by_index: FxHashMap<usize, Representation> =
            in_order.iter().map(|&index| (index, read(table, index))).collect();
        let items =
            by_index.iter().flat_map(|(&index, held)| held.items.iter().map(move |&item| (index, item)));
        let listed = items.filter(|&(_, item)| is_placement(table.kind(item))).collect();
        let mut joined: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for index in table.of(&[Kind::ShapeRepresentationRelationship, Kind::RepresentationRelationship]) {
            let mut attributes = table.attributes(index).after(2);
            let ends = (attributes.optional_reference(), attributes.optional_reference());
            if let (Some(first), Some(second)) = ends {
                joined.entry(first).or_default().push(second);
                joined.entry(second).or_default().push(first);
            }
        }
        Self {
            by_index,
            in_order,
            listed,
            joined,
            attachments: attachments(table),
            claimed: FxHashSet::default(),
            of_pair: FxHashMap::default(),
        }
    }

    /// The representation, if the entity is one that may hold a shape.
    pub fn get(&self, index: usize) -> Option<&Representation> {
        self.by_index.get(&index)
    }

    /// A slice of just this representation.
    pub fn own_index(&self, index: usize) -> &[usize] {
        self.in_order.binary_search(&index).map_or(&[], |place| &self.in_order[place..=place])
    }

    /// Whether a representation lists a placement among its items.
    pub fn lists(&self, representation: usize, item: usize) -> bool {
        self.listed.contains(&(representation, item))
    }

    /// All of them, in file order.
    pub fn indices(&self) -> &[usize] {
        &self.in_order
    }

    /// The units of a representation's numbers.
    pub fn units(&self, index: usize, units: &UnitTable) -> Units {
        units.of_context(self.get(index).and_then(|representation| representation.context))
    }

    /// The placing relationships that no use of a product has claimed, in file order.
    pub fn attachments(&self) -> impl Iterator<Item = &Attachment> {
        self.attachments.iter().filter(|held| !self.claimed.contains(&held.relationship))
    }

    /// Claims a placing relationship for a use of a product.
    pub fn claim(&mut self, relationship: usize) {
        self.claimed.insert(relationship);
    }

    /// Sorts the relationships that are left by what they join; to be called once all direct claims are made.
    pub fn sort_attachments(&mut self) {
        for held in &self.attachments {
            if !self.claimed.contains(&held.relationship) {
                self.of_pair.entry((held.first, held.second)).or_default().push_back(held.relationship);
            }
        }
    }

    /// Claims the first placing relationship between representations of an assembly and of its component.
    pub fn claim_between(&mut self, assembly: &[usize], component: &[usize]) -> Option<usize> {
        const MOST: usize = 16;
        for &a in assembly.iter().take(MOST) {
            for &b in component.iter().take(MOST) {
                for pair in [(b, a), (a, b)] {
                    let held = self.of_pair.get_mut(&pair).and_then(|held| held.pop_front());
                    if held.is_some() {
                        self.claimed.extend(held);
                        return held;
                    }
                }
            }
        }
        None
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

fn attachments(table: &Table<'_>) -> Vec<Attachment> {
    let relationships = table.of(&[Kind::RepresentationRelationshipWithTransformation]);
    let attachments = relationships.filter_map(|relationship| {
        let mut attributes = table.attributes(relationship).after(2);
        let (first, second) = (attributes.optional_reference()?, attributes.optional_reference()?);
        Some(Attachment { relationship, first, second })
    });
    attachments.collect()
}

fn read(table: &Table<'_>, index: usize) -> Representation {
    let mut attributes = table.attributes(index);
    Representation {
        name: attributes.text().into_owned(),
        items: attributes.found_references(),
        context: attributes.optional_reference(),
    }
}

fn is_placement(kind: Kind) -> bool {
    matches!(kind, Kind::Axis2Placement3d | Kind::Axis2Placement2d | Kind::Axis1Placement)
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
