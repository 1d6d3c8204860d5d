//! What a document takes over from an older state of the same file.

use std::collections::{HashMap, HashSet};

use trimloop_brep::{EntityRef, Part};
use trimloop_measure::Feature;

use super::{Document, Picked};

/// Names from the root on, and which of several of a name.
type Path = [(String, usize)];

fn entity_of(part: &Part, feature: Feature) -> Option<EntityRef> {
    match feature {
        Feature::Face(face) => Some(part.faces.get(face as usize)?.entity),
        Feature::Edge(edge) => Some(part.edges.get(edge as usize)?.entity),
        Feature::Vertex(vertex) => Some(part.vertices.get(vertex as usize)?.entity),
    }
}

impl Document {
    /// Takes over from an older state of the same file what was hidden, how far it was taken apart and what was selected,
    /// as far as that can be found again: by names from the root, and by entities.
    pub fn take_over(&mut self, before: &Self) {
        let (old, new) = (before.paths(), self.paths());
        let hidden: HashSet<&Path> =
            old.iter().filter(|(_, node)| !before.is_shown(*node)).map(|(path, _)| path.as_slice()).collect();
        let now: Vec<usize> =
            new.iter().filter(|(path, _)| hidden.contains(path.as_slice())).map(|(_, node)| *node).collect();
        for node in now {
            if self.model.nodes[node].part.is_some() {
                self.show(node, false);
            }
        }
        self.explode(before.explosion());
        let places: HashMap<&Path, usize> = new.iter().map(|(path, node)| (path.as_slice(), *node)).collect();
        for picked in &before.selection {
            let Some(node) = before.node_of(picked.instance) else { continue };
            let path = old.iter().find(|(_, own)| *own == node).map(|(path, _)| path.as_slice());
            let Some(now) = path.and_then(|path| places.get(path)) else { continue };
            let Some(instance) = self.instances_below(*now).next() else { continue };
            let feature = match picked.feature {
                None => None,
                Some(feature) => {
                    let Some(entity) = before.part_of(picked.instance).and_then(|p| entity_of(p, feature))
                    else {
                        continue;
                    };
                    let Some((part, feature)) = self.entities.get(&entity) else { continue };
                    if *part != self.renderer.scene().instances[instance].part {
                        continue;
                    }
                    Some(*feature)
                }
            };
            self.select(Some(Picked { instance, feature, place: None }), true);
        }
    }

    /// By node: names from the root on, and which of several of a name.
    pub(super) fn paths(&self) -> Vec<(Vec<(String, usize)>, usize)> {
        let mut out = Vec::new();
        let mut stack: Vec<(Vec<(String, usize)>, usize)> = self.named(&self.model.roots, &[]);
        while let Some((path, node)) = stack.pop() {
            stack.extend(self.named(&self.model.nodes[node].children, &path));
            out.push((path, node));
        }
        out
    }

    pub(super) fn named(
        &self,
        nodes: &[usize],
        above: &[(String, usize)],
    ) -> Vec<(Vec<(String, usize)>, usize)> {
        let mut counts: HashMap<&str, usize> = HashMap::new();
        nodes
            .iter()
            .map(|&node| {
                let own = &self.model.nodes[node];
                let name = own.instance_name.as_deref().unwrap_or(own.name.as_str());
                let count = counts.entry(name).or_default();
                *count += 1;
                let mut path = above.to_vec();
                path.push((name.to_owned(), *count));
                (path, node)
            })
            .collect()
    }
}
