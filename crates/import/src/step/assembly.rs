//! The instance tree.

use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{Diagnostic, Diagnostics, Node, Severity};

use super::keyword::Kind;
use super::look::Look;
use super::part_builder::is_part_geometry;
use super::product::Products;
use super::representation::Representations;
use super::shape_links::{Link, Shape, ShapeLinks};
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

/// Expands the shapes of a file to a tree.
pub(crate) struct TreeBuilder<'t> {
    table: &'t Table<'t>,
    products: &'t Products,
    representations: &'t Representations,
    links: ShapeLinks<'t>,
    looks: &'t Looks,
    tree: Tree,
    /// For each node what it shows, under whose name, and its parent.
    shown: Vec<(Shape, Shape, Option<usize>)>,
    part_of: FxHashMap<Shape, Option<usize>>,
    max_nodes: usize,
    refused: FxHashSet<(usize, &'static str)>,
}

impl<'t> TreeBuilder<'t> {
    /// A builder that has done nothing yet.
    pub fn new(
        table: &'t Table<'t>,
        products: &'t Products,
        representations: &'t Representations,
        links: ShapeLinks<'t>,
        looks: &'t Looks,
    ) -> Self {
        Self {
            table,
            products,
            representations,
            links,
            looks,
            tree: Tree::default(),
            shown: Vec::new(),
            part_of: FxHashMap::default(),
            // Exponentially many instances can be asked for in a few lines; five million would fill memory.
            max_nodes: (100_000 + 16 * table.len()).min(5_000_000),
            refused: FxHashSet::default(),
        }
    }

    /// Expands the tree from its roots.
    pub fn build(mut self) -> Tree {
        for shape in self.root_shapes() {
            self.expand(shape);
        }
        self.tree.diagnostics.append(&mut self.links.diagnostics);
        self.tree
    }

    /// Products that nothing uses; representations where there are no products with a shape.
    fn root_shapes(&self) -> Vec<Shape> {
        let placed = self.links.placed_representations();
        let shaped: Vec<usize> =
            self.products.indices().iter().copied().filter(|&i| self.has_shape(i)).collect();
        let is_root = |&index: &usize| {
            let own = self.links.representations_of(Shape::Product(index));
            !self.products.is_used(index) && (own.is_empty() || !own.iter().all(|held| placed.contains(held)))
        };
        let mut roots: Vec<_> = shaped.iter().copied().filter(is_root).collect();
        self.add_cycles(&shaped, &mut roots);
        if roots.is_empty() {
            // Products that are mapped into each other only.
            roots.extend(shaped.first());
        }
        if !roots.is_empty() {
            return roots.into_iter().map(Shape::Product).collect();
        }
        let holds_something = |&index: &usize| {
            let items = self.representations.get(index).map(|held| held.items.as_slice()).unwrap_or_default();
            let is_shown = |kind| is_part_geometry(kind) || kind == Kind::MappedItem;
            !placed.contains(&index) && items.iter().any(|&item| is_shown(self.table.kind(item)))
        };
        self.representations
            .indices()
            .iter()
            .copied()
            .filter(holds_something)
            .map(Shape::Representation)
            .collect()
    }

    /// Adds products that contain themselves and that no root leads to, assemblies first.
    fn add_cycles(&self, shaped: &[usize], roots: &mut Vec<usize>) {
        let mut reached = FxHashSet::default();
        roots.iter().for_each(|&root| self.reach(root, &mut reached));
        let is_assembly = |&&index: &&usize| self.products.get(index).is_some_and(|it| !it.uses.is_empty());
        for &index in shaped.iter().filter(is_assembly) {
            if self.products.is_used(index) && !reached.contains(&index) {
                roots.push(index);
                self.reach(index, &mut reached);
            }
        }
        roots.sort_unstable();
    }

    /// Adds all products that a product leads to.
    fn reach(&self, index: usize, reached: &mut FxHashSet<usize>) {
        let mut open = vec![index];
        while let Some(index) = open.pop() {
            if reached.insert(index) {
                open.extend(
                    self.products.get(index).into_iter().flat_map(|it| &it.uses).map(|usage| usage.child),
                );
            }
        }
    }

    fn has_shape(&self, index: usize) -> bool {
        let product = self.products.get(index);
        product.is_some_and(|product| !product.representations.is_empty() || !product.uses.is_empty())
    }

    fn expand(&mut self, root: Shape) {
        let mut stack = vec![(None, self.links.root(root))];
        while let Some((parent, link)) = stack.pop() {
            if self.may_add(parent, &link) {
                let shape = link.shape;
                let node = self.add_node(parent, link);
                let below = self.links.of(shape);
                stack.extend(below.iter().rev().map(|link| (Some(node), link.clone())));
            }
        }
    }

    /// Whether a node may be made: not inside itself, not too deep, not one too many.
    fn may_add(&mut self, parent: Option<usize>, link: &Link) -> bool {
        if self.tree.nodes.len() >= self.max_nodes {
            return self.refuse(
                usize::MAX,
                link.entity,
                "assembly-too-large",
                "the assembly has too many instances",
            );
        }
        let mut ancestor = parent;
        let mut depth = 0;
        while let Some(node) = ancestor {
            let (shape, named, above) = self.shown[node];
            if shape == link.shape || named == link.named {
                return self.refuse(
                    link.entity,
                    link.entity,
                    "assembly-cycle",
                    "the product contains itself",
                );
            }
            depth += 1;
            ancestor = above;
        }
        depth < MAX_DEPTH
            || self.refuse(link.entity, link.entity, "assembly-too-deep", "the assembly is nested too deeply")
    }

    /// Reports that something is left out; gives false.
    fn refuse(&mut self, key: usize, entity: usize, code: &'static str, why: &str) -> bool {
        if self.refused.insert((key, code)) {
            let entity = self.table.entity(entity);
            let message = format!("{entity} is left out: {why}.");
            self.tree.diagnostics.push(Diagnostic::new(Severity::Error, code, entity, message));
        }
        false
    }

    fn add_node(&mut self, parent: Option<usize>, link: Link) -> usize {
        let (name, id) = self.names(link.named, parent);
        let part = self.part(&link, &name, &id);
        let look = link.styled.iter().fold(Look::default(), |look, &index| look.over(self.looks.of(index)));
        let index = self.tree.nodes.len();
        self.tree.nodes.push(Node {
            name,
            id,
            instance_name: link.instance_name,
            entity: self.table.entity(link.entity),
            transform: link.transform,
            part,
            children: Vec::new(),
            color: look.surface,
            hidden: look.hidden,
        });
        self.shown.push((link.shape, link.named, parent));
        match parent {
            Some(parent) => self.tree.nodes[parent].children.push(index),
            None => self.tree.roots.push(index),
        }
        index
    }

    /// Name and id of a shape; a representation without a name has those of what it stands in.
    fn names(&self, shape: Shape, parent: Option<usize>) -> (String, String) {
        let product = match shape {
            Shape::Product(index) => self.products.get(index),
            Shape::Representation(_) => None,
        };
        if let Some(product) = product {
            return (product.name.clone(), product.id.clone());
        }
        let name = self.representations.get(shape.entity()).map(|held| held.name.clone()).unwrap_or_default();
        let id = self.table.entity(shape.entity()).to_string();
        match parent {
            _ if !name.trim().is_empty() => (name, id),
            Some(parent) => (self.tree.nodes[parent].name.clone(), self.tree.nodes[parent].id.clone()),
            None => (id.clone(), id),
        }
    }

    /// The part with the shape's own geometry; planned when it is met first.
    fn part(&mut self, link: &Link, name: &str, id: &str) -> Option<usize> {
        if let Some(&part) = self.part_of.get(&link.shape) {
            return part;
        }
        let has_geometry = self.links.has_geometry(link.shape);
        let part = has_geometry.then_some(self.tree.plans.len());
        if has_geometry {
            let (name, id) = (name.to_owned(), id.to_owned());
            let representations = self.links.representations_of(link.shape).to_vec();
            let entity = link.shape.entity();
            self.tree.plans.push(PartPlan { entity, name, id, representations, lone_items: Vec::new() });
        }
        self.part_of.insert(link.shape, part);
        part
    }
}
