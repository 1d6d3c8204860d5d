//! Outlines to parts, and the tree that places them.

use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{Diagnostics, EntityRef, Model, Node, Part, Severity};

use super::curve::CURVES;
use super::distribute::parts_of_groups;
use super::face::{FaceDraft, FaceReader};
use super::look::color_of;
use super::outline::{Group, Outline, Placement};
use super::primitive::PRIMITIVES;
use super::reader::{Fault, Outcome, Reader};
use super::shape::ShapeBuilder;
use crate::parallel::map_each;

/// How deep subfigures may be nested.
const MAX_DEPTH: usize = 256;
/// The most nodes that a tree may have, for each entity of the file, and in any case.
const NODES_PER_ENTITY: usize = 64;
const NODES_AT_LEAST: usize = 100_000;

/// An outline whose geometry has been built: its groups, and the part of each.
struct Built {
    groups: Vec<Group>,
    parts: Vec<Option<usize>>,
}

/// Makes the parts and the tree of a file.
pub(crate) struct SceneBuilder<'f> {
    reader: Reader<'f>,
    uncertainty_mm: f64,
    model: Model,
    built: FxHashMap<u32, Rc<Built>>,
    refused: FxHashSet<u32>,
    max_nodes: usize,
}

impl<'f> SceneBuilder<'f> {
    /// A builder with nothing in it.
    pub fn new(reader: Reader<'f>, uncertainty_mm: f64, diagnostics: Diagnostics) -> Self {
        Self {
            reader,
            uncertainty_mm,
            model: Model { diagnostics, ..Model::default() },
            built: FxHashMap::default(),
            refused: FxHashSet::default(),
            max_nodes: (NODES_PER_ENTITY * reader.file.len()).max(NODES_AT_LEAST),
        }
    }

    /// The model whose root has this name.
    pub fn finish(mut self, outline: Outline, name: &str) -> Model {
        let mut outline = outline;
        outline.groups[0].name = Some(name.to_owned());
        let built = Rc::new(self.build(outline));
        let root = &built.groups[0];
        let node = self.node(root, built.parts[0], name.to_owned());
        let index = self.model.nodes.len();
        self.model.nodes.push(node);
        self.model.roots.push(index);
        self.fill(index, &built, &[]);
        self.model
    }

    /// Builds the geometry of an outline.
    fn build(&mut self, outline: Outline) -> Built {
        let part = Part { uncertainty_mm: self.uncertainty_mm, ..Part::default() };
        let mut builder = ShapeBuilder::new(self.reader, part);
        let groups = outline.groups;
        let entries = groups.iter().flat_map(|group| &group.geometry).copied();
        let loose: Vec<u32> = entries.filter(|&entry| kind_of(&self.reader, entry) == Kind::Face).collect();
        let faces = FaceReader { reader: self.reader, uncertainty_mm: self.uncertainty_mm };
        let mut read: FxHashMap<u32, Outcome<FaceDraft>> =
            loose.iter().copied().zip(map_each(&loose, |&entry| faces.read(entry))).collect();
        for (k, group) in groups.iter().enumerate() {
            builder.group = k;
            for &entry in &group.geometry {
                let color = color_of(&self.reader, entry).or(group.color);
                match kind_of(&self.reader, entry) {
                    Kind::Face => {
                        if let Some(face) = read.remove(&entry) {
                            builder.add_loose(entry, color, face);
                        }
                    }
                    Kind::BrepFace => builder.add_brep_face(entry, color),
                    Kind::Solid => builder.add_solid(entry, color),
                    Kind::Primitive => builder.add_primitive(entry, color),
                    Kind::Boolean => builder.add_boolean(entry, color),
                    Kind::Curve => builder.add_curve(entry, color),
                    Kind::Points => builder.add_points(entry, color),
                }
            }
        }
        builder.make_bodies();
        self.model.diagnostics.append(&mut builder.diagnostics);
        let parts = parts_of_groups(builder, &groups).into_iter().zip(&groups).map(|(part, group)| {
            let part = part?;
            let (name, id) = names(group);
            let entity = entity_of(group.entry);
            self.model.parts.push(Part { name, id, entity, ..part });
            Some(self.model.parts.len() - 1)
        });
        Built { parts: parts.collect(), groups }
    }

    fn built(&mut self, target: u32) -> Rc<Built> {
        if let Some(built) = self.built.get(&target) {
            return built.clone();
        }
        let outline = Outline::of_definition(&self.reader, target, &mut self.model.diagnostics);
        let built = Rc::new(self.build(outline));
        self.built.insert(target, built.clone());
        built
    }

    fn node(&self, group: &Group, part: Option<usize>, name: String) -> Node {
        Node {
            id: names(group).1,
            name,
            entity: entity_of(group.entry),
            transform: group.transform,
            part,
            hidden: group.hidden,
            ..Node::default()
        }
    }

    /// Puts below a node what its outline holds; `within` are the definitions around it.
    fn fill(&mut self, root: usize, built: &Rc<Built>, within: &[u32]) {
        // (node, outline, definitions around)
        let mut stack = vec![(root, built.clone(), within.to_vec())];
        while let Some((root, built, within)) = stack.pop() {
            let mut nodes = vec![root; built.groups.len()];
            let holds_something = holding(&built);
            for (k, group) in built.groups.iter().enumerate() {
                if k > 0 && holds_something[k] {
                    let parent = nodes[group.parent.unwrap_or(0)];
                    let node = self.node(group, built.parts[k], names(group).0);
                    nodes[k] = self.add(parent, node);
                }
                for placement in &group.placements {
                    if !self.may_place(placement, &within) {
                        continue;
                    }
                    let target = self.built(placement.target);
                    let group = &target.groups[0];
                    let mut node = self.node(group, target.parts[0], names(group).0);
                    node.entity = entity_of(placement.entry);
                    node.instance_name.clone_from(&placement.name);
                    node.transform = placement.transform * group.transform;
                    node.color = placement.color;
                    node.hidden = placement.hidden;
                    let index = self.add(nodes[k], node);
                    let around = [within.as_slice(), &[placement.target]].concat();
                    stack.push((index, target, around));
                }
            }
        }
    }

    fn add(&mut self, parent: usize, node: Node) -> usize {
        let index = self.model.nodes.len();
        self.model.nodes.push(node);
        self.model.nodes[parent].children.push(index);
        index
    }

    /// Whether a placement may be followed: not into itself, not too deep, not one too many.
    fn may_place(&mut self, placement: &Placement, within: &[u32]) -> bool {
        let (code, why) = if self.model.nodes.len() >= self.max_nodes {
            ("assembly-too-large", "the assembly has too many instances")
        } else if within.contains(&placement.target) {
            ("assembly-cycle", "the subfigure contains itself")
        } else if within.len() >= MAX_DEPTH {
            ("assembly-too-deep", "subfigures are nested too deeply")
        } else {
            return true;
        };
        if self.refused.insert(placement.entry) {
            let fault = Fault::new(placement.entry, format!("is left out: {why}"));
            self.model.diagnostics.push(fault.diagnostic(Severity::Error, code));
        }
        false
    }
}

/// Per group, whether it or a group below it has a part or placements.
fn holding(built: &Built) -> Vec<bool> {
    let holds = |k: usize| built.parts[k].is_some() || !built.groups[k].placements.is_empty();
    let mut out: Vec<bool> = (0..built.groups.len()).map(holds).collect();
    // Groups come after those that they stand in.
    for k in (1..out.len()).rev() {
        let parent = built.groups[k].parent.unwrap_or(0);
        out[parent] |= out[k];
    }
    out
}

/// Name and id of a group: a nameless one goes by its entity.
fn names(group: &Group) -> (String, String) {
    let id = entity_of(group.entry).to_string();
    let name = group.name.clone().unwrap_or_else(|| id.clone());
    (name.clone(), if id.is_empty() { name } else { id })
}

fn entity_of(entry: u32) -> EntityRef {
    if entry == 0 { EntityRef::None } else { EntityRef::Iges(entry) }
}

/// What an entity of an outline is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Face,
    /// A face with edges that it may share.
    BrepFace,
    Solid,
    Primitive,
    Boolean,
    Curve,
    Points,
}

fn kind_of(reader: &Reader<'_>, entry: u32) -> Kind {
    let directory = reader.file.get(entry).map(|entity| entity.directory);
    let (kind, form) = directory.map_or((0, 0), |directory| (directory.entity_type, directory.form));
    match kind {
        106 if (1..=3).contains(&form) => Kind::Points,
        116 => Kind::Points,
        180 => Kind::Boolean,
        186 | 514 => Kind::Solid,
        510 => Kind::BrepFace,
        kind if PRIMITIVES.contains(&kind) => Kind::Primitive,
        kind if CURVES.contains(&kind) => Kind::Curve,
        _ => Kind::Face,
    }
}
