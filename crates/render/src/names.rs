//! Instances by the names of their nodes.

use trimloop_brep::Model;

use crate::Scene;

/// Names as people give them, with `*` for anything; upper and lower case are the same.
#[derive(Clone, Debug, Default)]
pub struct Names(Vec<String>);

impl Names {
    /// For some patterns.
    pub fn new(patterns: &[String]) -> Self {
        Self(patterns.iter().map(|p| p.to_lowercase()).collect())
    }

    /// Whether one of the patterns is this name.
    pub fn hold(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        self.0.iter().any(|pattern| matches(pattern.as_bytes(), name.as_bytes()))
    }

    /// For each instance of the scene whether its node, one above it, or its part has one of the names.
    pub fn instances(&self, model: &Model, scene: &Scene) -> Vec<bool> {
        let mut named = vec![false; model.nodes.len()];
        let mut stack: Vec<(usize, bool)> = model.roots.iter().map(|&root| (root, false)).collect();
        while let Some((index, above)) = stack.pop() {
            let node = &model.nodes[index];
            let own = [Some(&node.name), Some(&node.id), node.instance_name.as_ref()];
            named[index] = above || own.into_iter().flatten().any(|name| self.hold(name));
            stack.extend(node.children.iter().map(|&child| (child, named[index])));
        }
        let of = |i: &crate::Instance| {
            i.node.is_some_and(|node| named[node]) || self.hold(&scene.parts[i.part].name)
        };
        scene.instances.iter().map(of).collect()
    }
}

/// Whether a pattern with `*` is a name; in time proportional to the product of their lengths at most.
fn matches(pattern: &[u8], name: &[u8]) -> bool {
    let (mut p, mut n) = (0, 0);
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        if pattern.get(p) == Some(&b'*') {
            star = Some((p, n));
            p += 1;
        } else if pattern.get(p) == Some(&name[n]) {
            (p, n) = (p + 1, n + 1);
        } else if let Some((at, taken)) = star {
            (p, n) = (at + 1, taken + 1);
            star = Some((at, taken + 1));
        } else {
            return false;
        }
    }
    pattern[p..].iter().all(|c| *c == b'*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_anything() {
        let names = Names::new(&["Cover*".into(), "*bolt*m3".into(), "exact".into()]);
        assert!(names.hold("cover") && names.hold("COVER plate") && names.hold("a bolt of M3"));
        assert!(names.hold("Exact") && !names.hold("inexact") && !names.hold("bolt M4"));
    }
}
