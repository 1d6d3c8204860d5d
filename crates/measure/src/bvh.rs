//! A tree of boxes around simplices.

use glam::DVec3;
use trimloop_geom::Aabb;

use crate::simplex::Simplex;

/// Simplices in a binary tree of boxes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    /// In the order in which the nodes refer to them.
    pub simplices: Vec<Simplex>,
    /// The first is the root; none where there are no simplices.
    pub nodes: Vec<Node>,
}

/// A box, and what is in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub bounds: Aabb,
    /// The first simplex.
    pub first: u32,
    /// How many there are.
    pub count: u32,
    /// The two nodes below, or none.
    pub below: Option<[u32; 2]>,
}

const LEAF: usize = 4;

impl Bvh {
    /// Halves the simplices along the longest side of their middles' box, again and again.
    pub fn new(simplices: Vec<Simplex>) -> Self {
        let mut tree = Self { simplices, nodes: Vec::new() };
        let count = tree.simplices.len();
        if count > 0 {
            tree.nodes.push(tree.node(0, count));
            let mut open = vec![0];
            while let Some(index) = open.pop() {
                tree.halve(index, &mut open);
            }
        }
        tree
    }

    fn node(&self, first: usize, count: usize) -> Node {
        let points = self.simplices[first..first + count].iter().flat_map(|s| s.corners);
        Node { bounds: Aabb::from_points(points), first: first as u32, count: count as u32, below: None }
    }

    fn halve(&mut self, index: usize, open: &mut Vec<usize>) {
        let Node { first, count, .. } = self.nodes[index];
        let (first, count) = (first as usize, count as usize);
        if count <= LEAF {
            return;
        }
        let middle = |s: &Simplex| s.corners[0] + s.corners[1] + s.corners[2];
        let own = &mut self.simplices[first..first + count];
        let spread = Aabb::from_points(own.iter().map(middle));
        let size = spread.max - spread.min;
        let axis = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0);
        let half = count / 2;
        own.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]));
        let children = [self.node(first, half), self.node(first + half, count - half)];
        let at = self.nodes.len();
        self.nodes.extend(children);
        self.nodes[index].below = Some([at as u32, at as u32 + 1]);
        open.extend([at, at + 1]);
    }

    /// The box of everything.
    pub fn bounds(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.bounds)
    }
}

/// How far two boxes are apart.
pub(crate) fn gap(a: &Aabb, b: &Aabb) -> f64 {
    (a.min - b.max).max(b.min - a.max).max(DVec3::ZERO).length()
}
