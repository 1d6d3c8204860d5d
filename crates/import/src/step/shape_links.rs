//! What stands in a shape: used products, mapped items, attached representations, each with its placement.

use std::rc::Rc;

use glam::DAffine3;
use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::Diagnostics;

use super::component::Placements;
use super::keyword::Kind;
use super::part_builder::is_part_geometry;
use super::product::Products;
use super::representation::Representations;
use super::table::Table;

/// How many mapped representations that hold nothing else may be mapped in each other.
const MAX_MAPPING: usize = 64;

/// What a node shows: a product definition, or a representation that no product owns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Shape {
    /// A product definition.
    Product(usize),
    /// A representation.
    Representation(usize),
}

impl Shape {
    /// The entity.
    pub fn entity(self) -> usize {
        let (Self::Product(index) | Self::Representation(index)) = self;
        index
    }
}

/// A shape at its place in another, or at the root.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    /// What stands there.
    pub shape: Shape,
    /// Whose name it has: differs from `shape` where a product is nothing but a mapped representation.
    pub named: Shape,
    /// Placement in the shape around it.
    pub transform: DAffine3,
    /// The name of this use.
    pub instance_name: Option<String>,
    /// The entity that places it.
    pub entity: usize,
    /// The entities that may carry a colour for this use alone.
    pub styled: Vec<usize>,
}

/// A representation that stands in another without a use of a product.
#[derive(Clone, Copy, Debug)]
struct Attached {
    relationship: usize,
    representation: usize,
    inverse: bool,
}

/// The links of every shape, each read once.
pub(crate) struct ShapeLinks<'t> {
    table: &'t Table<'t>,
    products: &'t Products,
    representations: &'t Representations,
    placements: &'t Placements<'t>,
    attached: FxHashMap<usize, Vec<Attached>>,
    links: FxHashMap<Shape, Rc<[Link]>>,
    /// What was wrong with placements.
    pub diagnostics: Diagnostics,
}

impl<'t> ShapeLinks<'t> {
    /// Nothing read yet.
    pub fn new(
        table: &'t Table<'t>,
        products: &'t Products,
        representations: &'t Representations,
        placements: &'t Placements<'t>,
    ) -> Self {
        let attached = attached(products, representations);
        let (links, diagnostics) = Default::default();
        Self { table, products, representations, placements, attached, links, diagnostics }
    }

    /// Representations that stand in others: mapped or attached ones. What only drawings and camera images map, in
    /// `presentation_view` and the like, stands nowhere.
    pub fn placed_representations(&self) -> FxHashSet<usize> {
        let items = self.representations.indices().iter().flat_map(|&index| self.items(index));
        let maps = items
            .filter(|&&item| self.table.kind(item) == Kind::MappedItem)
            .filter_map(|&item| self.table.attributes(item).after(1).optional_reference());
        let mapped = maps.filter_map(|map| self.table.attributes(map).after(1).optional_reference());
        mapped.chain(self.attached.values().flatten().map(|held| held.representation)).collect()
    }

    /// The link of a root.
    pub fn root(&mut self, shape: Shape) -> Link {
        let mut link = Link {
            shape,
            named: shape,
            transform: DAffine3::IDENTITY,
            instance_name: None,
            entity: shape.entity(),
            styled: Vec::new(),
        };
        self.see_through(&mut link);
        link
    }

    /// The representations of a shape.
    pub fn representations_of(&self, shape: Shape) -> &[usize] {
        match &shape {
            Shape::Product(index) => self
                .products
                .get(*index)
                .map(|product| product.representations.as_slice())
                .unwrap_or_default(),
            Shape::Representation(index) => self.representations.own_index(*index),
        }
    }

    /// Whether a shape has geometry of its own.
    pub fn has_geometry(&self, shape: Shape) -> bool {
        let mut items = self.representations_of(shape).iter().flat_map(|&index| self.items(index));
        items.any(|&item| is_part_geometry(self.table.kind(item)))
    }

    /// What stands in a shape.
    pub fn of(&mut self, shape: Shape) -> Rc<[Link]> {
        if let Some(known) = self.links.get(&shape) {
            return known.clone();
        }
        let representations = self.representations_of(shape).to_vec();
        let (mut links, mut mapped) = (Vec::new(), Vec::new());
        for &representation in &representations {
            self.add_mapped(representation, &mut mapped);
        }
        if let Shape::Product(index) = shape {
            self.add_uses(index, &mut mapped, &mut links);
        }
        links.append(&mut mapped);
        for representation in representations {
            self.add_attached(representation, &mut links);
        }
        links.iter_mut().for_each(|link| self.see_through(link));
        let links: Rc<[Link]> = links.into();
        self.links.insert(shape, links.clone());
        links
    }

    fn items(&self, representation: usize) -> &'t [usize] {
        self.representations.get(representation).map(|held| held.items.as_slice()).unwrap_or_default()
    }

    /// The product's uses of others. One without a shape of its own is placed by a mapped item, if the assembly
    /// maps the used product's shape; those items are taken from `mapped`.
    fn add_uses(&mut self, index: usize, mapped: &mut Vec<Link>, links: &mut Vec<Link>) {
        let Some(assembly) = self.products.get(index) else { return };
        for usage in &assembly.uses {
            let Some(component) = self.products.get(usage.child) else { continue };
            let by_map = mapped
                .iter()
                .position(|link| usage.relationship.is_none() && link.shape == Shape::Product(usage.child));
            if let Some(place) = by_map {
                let item = mapped.remove(place);
                let styled = vec![usage.index, item.entity];
                let instance_name = usage.name.clone();
                links.push(Link { instance_name, entity: usage.index, styled, ..item });
                continue;
            }
            let (transform, mut reader) = self.placements.of_use(usage, assembly, component);
            self.diagnostics.append(&mut reader.notes);
            let shape = Shape::Product(usage.child);
            links.push(Link {
                shape,
                named: shape,
                transform,
                instance_name: usage.name.clone(),
                entity: usage.index,
                styled: [Some(usage.index), usage.placed_by].into_iter().flatten().collect(),
            });
        }
    }

    fn add_mapped(&mut self, representation: usize, links: &mut Vec<Link>) {
        for &item in
            self.items(representation).iter().filter(|&&item| self.table.kind(item) == Kind::MappedItem)
        {
            let Some((mapped, transform, mut reader)) = self.placements.of_mapped_item(item, representation)
            else {
                continue;
            };
            self.diagnostics.append(&mut reader.notes);
            if self.representations.get(mapped).is_none() {
                continue;
            }
            let shape = self.shape_of(mapped);
            let name = self.table.attributes(item).text().into_owned();
            let instance_name = (!name.trim().is_empty()).then_some(name);
            links.push(Link {
                shape,
                named: shape,
                transform,
                instance_name,
                entity: item,
                styled: vec![item],
            });
        }
    }

    fn add_attached(&mut self, representation: usize, links: &mut Vec<Link>) {
        for held in self.attached.get(&representation).map(Vec::as_slice).unwrap_or_default() {
            let (transform, mut reader) = self.placements.of_attachment(held.relationship, held.inverse);
            self.diagnostics.append(&mut reader.notes);
            let shape = self.shape_of(held.representation);
            let entity = held.relationship;
            links.push(Link {
                shape,
                named: shape,
                transform,
                instance_name: None,
                entity,
                styled: Vec::new(),
            });
        }
    }

    /// The product that a representation is the shape of, else the representation.
    fn shape_of(&self, representation: usize) -> Shape {
        self.products.owner_of(representation).map_or(Shape::Representation(representation), Shape::Product)
    }

    /// Where a shape is nothing but one mapped representation, takes that in its place: a level of its own for it
    /// would be one that nobody modelled.
    fn see_through(&mut self, link: &mut Link) {
        for _ in 0..MAX_MAPPING {
            let Some((owner, item)) = self.only_mapped_item(link.shape) else { return };
            let Some((mapped, map, mut reader)) = self.placements.of_mapped_item(item, owner) else { return };
            if self.representations.get(mapped).is_none() || self.products.owner_of(mapped).is_some() {
                return;
            }
            self.diagnostics.append(&mut reader.notes);
            link.transform *= map;
            link.shape = Shape::Representation(mapped);
            link.styled.push(item);
        }
    }

    /// The mapped item of a shape that holds nothing else, and the representation that lists it.
    fn only_mapped_item(&self, shape: Shape) -> Option<(usize, usize)> {
        if let Shape::Product(index) = shape
            && !self.products.get(index)?.uses.is_empty()
        {
            return None;
        }
        let mut only = None;
        for &representation in self.representations_of(shape) {
            if self.attached.contains_key(&representation) {
                return None;
            }
            for &item in self.items(representation) {
                let kind = self.table.kind(item);
                if is_part_geometry(kind) || (kind == Kind::MappedItem && only.is_some()) {
                    return None;
                }
                if kind == Kind::MappedItem {
                    only = Some((representation, item));
                }
            }
        }
        only
    }
}

/// By representation, what stands in it without being claimed by a use: the second representation of a relationship
/// holds the first, unless only the first belongs to a product.
fn attached(products: &Products, representations: &Representations) -> FxHashMap<usize, Vec<Attached>> {
    let mut attached: FxHashMap<usize, Vec<Attached>> = FxHashMap::default();
    for held in representations.attachments() {
        let (first, second) = (held.first, held.second);
        if representations.get(first).is_none() || representations.get(second).is_none() {
            continue;
        }
        let owners = (products.owner_of(first), products.owner_of(second));
        if owners.0.is_some() && owners.0 == owners.1 {
            continue;
        }
        let inverse = owners.0.is_some() && owners.1.is_none();
        let (holder, representation) = if inverse { (first, second) } else { (second, first) };
        let relationship = held.relationship;
        attached.entry(holder).or_default().push(Attached { relationship, representation, inverse });
    }
    attached
}
