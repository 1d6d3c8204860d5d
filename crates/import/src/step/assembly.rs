//! The instance tree: products, their uses, mapped items.

use glam::DAffine3;
use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{Diagnostic, Diagnostics, Node, Severity};

use super::component::Placements;
use super::keyword::Kind;
use super::product::Products;
use super::representation::Representations;
use super::style::Looks;
use super::table::Table;

/// How deep assemblies may be nested.
const MAX_DEPTH: usize = 256;

/// What a part is made from.
#[derive(Clone, Debug)]
pub(crate) struct PartPlan {
    /// The product definition, or the representation where there is no product.
    pub entity: usize,
    pub name: String,
    pub id: String,
    /// The representations whose items it holds.
    pub representations: Vec<usize>,
    /// Single items with no representation around them.
    pub lone_items: Vec<usize>,
}

/// The tree, and what its parts are to be made from.
#[derive(Default)]
pub(crate) struct Tree {
    pub nodes: Vec<Node>,
    pub roots: Vec<usize>,
    pub plans: Vec<PartPlan>,
    pub diagnostics: Diagnostics,
}

/// A node to be made.
struct Pending {
    parent: Option<usize>,
    shape: Shape,
    transform: DAffine3,
    instance_name: Option<String>,
    entity: usize,
    /// The entities that may carry a colour for this use alone.
    styled: Vec<usize>,
}

/// What a node shows: a product definition, or a representation that no product owns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Shape {
    Product(usize),
    Representation(usize),
}

pub(crate) struct TreeBuilder<'t> {
    table: &'t Table<'t>,
    products: &'t Products,
    representations: &'t Representations,
    placements: &'t Placements<'t>,
    looks: &'t Looks,
    tree: Tree,
    shapes: Vec<(Shape, Option<usize>)>,
    part_of: FxHashMap<Shape, Option<usize>>,
    max_nodes: usize,
    reported: FxHashSet<usize>,
}

impl<'t> TreeBuilder<'t> {
    pub fn new(
        table: &'t Table<'t>,
        products: &'t Products,
        representations: &'t Representations,
        placements: &'t Placements<'t>,
        looks: &'t Looks,
    ) -> Self {
        Self {
            table,
            products,
            representations,
            placements,
            looks,
            tree: Tree::default(),
            shapes: Vec::new(),
            part_of: FxHashMap::default(),
            max_nodes: (100_000 + 16 * table.len()).min(5_000_000),
            reported: FxHashSet::default(),
        }
    }

    /// Expands the tree from its roots.
    pub fn build(mut self) -> Tree {
        for shape in self.root_shapes() {
            self.expand(shape);
        }
        self.tree
    }

    /// Products that nothing uses; representations where there are no products with a shape.
    fn root_shapes(&self) -> Vec<Shape> {
        let mapped = self.mapped_representations();
        let has_shape = |&&index: &&usize| {
            let product = self.products.get(index).expect("listed");
            !product.representations.is_empty() || !product.uses.is_empty()
        };
        let is_mapped = |index: usize| {
            let product = self.products.get(index).expect("listed");
            !product.representations.is_empty() && product.representations.iter().all(|r| mapped.contains(r))
        };
        let shaped: Vec<usize> = self.products.indices().iter().filter(has_shape).copied().collect();
        let roots: Vec<_> =
            shaped.iter().copied().filter(|&i| !self.products.is_used(i) && !is_mapped(i)).collect();
        // Where every product is used by another, the assembly contains itself: start anywhere.
        let roots = if roots.is_empty() { shaped.first().copied().into_iter().collect() } else { roots };
        if !roots.is_empty() {
            return roots.into_iter().map(Shape::Product).collect();
        }
        let holds_something = |&index: &usize| {
            let items = self.representations.get(index).map(|held| held.items.as_slice()).unwrap_or_default();
            !mapped.contains(&index) && items.iter().any(|&item| is_shown(self.table.kind(item)))
        };
        self.representations
            .indices()
            .iter()
            .copied()
            .filter(holds_something)
            .map(Shape::Representation)
            .collect()
    }

    fn mapped_representations(&self) -> FxHashSet<usize> {
        let maps = self.table.of(&[Kind::RepresentationMap]);
        maps.filter_map(|map| self.table.attributes(map).after(1).optional_reference()).collect()
    }

    fn expand(&mut self, root: Shape) {
        let entity = match root {
            Shape::Product(index) | Shape::Representation(index) => index,
        };
        let mut stack = vec![Pending {
            parent: None,
            shape: root,
            transform: DAffine3::IDENTITY,
            instance_name: None,
            entity,
            styled: Vec::new(),
        }];
        while let Some(pending) = stack.pop() {
            if !self.may_add(&pending) {
                continue;
            }
            let shape = pending.shape;
            let node = self.add_node(pending);
            let mut children = self.children(shape, node);
            children.reverse();
            stack.append(&mut children);
        }
    }

    /// Whether a node may be made: not inside itself, not too deep, not one too many.
    fn may_add(&mut self, pending: &Pending) -> bool {
        if self.tree.nodes.len() >= self.max_nodes {
            self.refuse(
                usize::MAX,
                pending.entity,
                "assembly-too-large",
                "the assembly has too many instances",
            );
            return false;
        }
        let mut ancestor = pending.parent;
        let mut depth = 0;
        while let Some(node) = ancestor {
            let (shape, parent) = self.shapes[node];
            if shape == pending.shape {
                self.refuse(pending.entity, pending.entity, "assembly-cycle", "the product contains itself");
                return false;
            }
            depth += 1;
            ancestor = parent;
        }
        if depth >= MAX_DEPTH {
            self.refuse(
                pending.entity,
                pending.entity,
                "assembly-too-deep",
                "the assembly is nested too deeply",
            );
        }
        depth < MAX_DEPTH
    }

    fn refuse(&mut self, key: usize, entity: usize, code: &'static str, why: &str) {
        if self.reported.insert(key) {
            let entity = self.table.entity(entity);
            let message = format!("{entity} is left out: {why}.");
            self.tree.diagnostics.push(Diagnostic::new(Severity::Error, code, entity, message));
        }
    }

    fn add_node(&mut self, pending: Pending) -> usize {
        let (name, id) = self.names(pending.shape);
        let part = self.part(pending.shape);
        let look =
            pending.styled.iter().map(|&index| self.looks.of(index)).find(|look| *look != Default::default());
        let look = look.unwrap_or_default();
        let index = self.tree.nodes.len();
        self.tree.nodes.push(Node {
            name,
            id,
            instance_name: pending.instance_name,
            entity: self.table.entity(pending.entity),
            transform: pending.transform,
            part,
            children: Vec::new(),
            color: look.surface,
            hidden: look.hidden,
        });
        self.shapes.push((pending.shape, pending.parent));
        match pending.parent {
            Some(parent) => self.tree.nodes[parent].children.push(index),
            None => self.tree.roots.push(index),
        }
        index
    }

    fn names(&self, shape: Shape) -> (String, String) {
        match shape {
            Shape::Product(index) => {
                let product = self.products.get(index).expect("only product definitions are expanded");
                (product.name.clone(), product.id.clone())
            }
            Shape::Representation(index) => {
                let name = self.representations.get(index).map(|held| held.name.clone()).unwrap_or_default();
                let id = self.table.entity(index).to_string();
                (if name.trim().is_empty() { id.clone() } else { name }, id)
            }
        }
    }

    fn own_representations(&self, shape: Shape) -> Vec<usize> {
        match shape {
            Shape::Product(index) => {
                self.products.get(index).map(|product| product.representations.clone()).unwrap_or_default()
            }
            Shape::Representation(index) => vec![index],
        }
    }

    /// The part with the shape's own geometry; planned when it is met first.
    fn part(&mut self, shape: Shape) -> Option<usize> {
        if let Some(&part) = self.part_of.get(&shape) {
            return part;
        }
        let representations = self.own_representations(shape);
        let items = representations.iter().filter_map(|&index| self.representations.get(index));
        let has_geometry = items.flat_map(|held| &held.items).any(|&item| is_geometry(self.table.kind(item)));
        let part = has_geometry.then_some(self.tree.plans.len());
        if has_geometry {
            let (name, id) = self.names(shape);
            let (Shape::Product(entity) | Shape::Representation(entity)) = shape;
            self.tree.plans.push(PartPlan { entity, name, id, representations, lone_items: Vec::new() });
        }
        self.part_of.insert(shape, part);
        part
    }

    fn children(&mut self, shape: Shape, parent: usize) -> Vec<Pending> {
        let mut children = Vec::new();
        if let Shape::Product(index) = shape {
            let assembly = self.products.get(index).expect("only product definitions are expanded");
            for usage in &assembly.uses {
                let Some(component) = self.products.get(usage.child) else { continue };
                let (transform, mut reader) = self.placements.of_use(usage, assembly, component);
                if self.reported.insert(usage.index) {
                    self.tree.diagnostics.append(&mut reader.notes);
                }
                children.push(Pending {
                    parent: Some(parent),
                    shape: Shape::Product(usage.child),
                    transform,
                    instance_name: usage.name.clone(),
                    entity: usage.index,
                    styled: [Some(usage.index), usage.placed_by].into_iter().flatten().collect(),
                });
            }
        }
        for representation in self.own_representations(shape) {
            self.mapped_children(representation, parent, &mut children);
        }
        children
    }

    fn mapped_children(&mut self, representation: usize, parent: usize, children: &mut Vec<Pending>) {
        let Some(held) = self.representations.get(representation) else { return };
        for &item in held.items.iter().filter(|&&item| self.table.kind(item) == Kind::MappedItem) {
            let Some((mapped, transform, mut reader)) = self.placements.of_mapped_item(item, representation)
            else {
                continue;
            };
            if self.reported.insert(item) {
                self.tree.diagnostics.append(&mut reader.notes);
            }
            if self.representations.get(mapped).is_none() {
                continue;
            }
            let shape = self.products.owner_of(mapped).map_or(Shape::Representation(mapped), Shape::Product);
            let name = self.table.attributes(item).text().into_owned();
            children.push(Pending {
                parent: Some(parent),
                shape,
                transform,
                instance_name: (!name.is_empty()).then_some(name),
                entity: item,
                styled: vec![item],
            });
        }
    }
}

/// Whether an item of a representation is geometry of the representation's own.
fn is_geometry(kind: Kind) -> bool {
    super::part_builder::is_part_geometry(kind)
}

/// Whether an item shows something, itself or through a map.
fn is_shown(kind: Kind) -> bool {
    is_geometry(kind) || kind == Kind::MappedItem
}
