//! Cubic curves that approximate a trim loop ever better (Guthe, Balázs, Klein 2005).

use glam::DVec2;
use trimloop_trim::curves::{Cubic, point};

/// A binary tree of cubic curves over a closed chain of them. The root, node 0, is the coarsest: one curve for the whole
/// loop; leaves are the chain's own curves.
#[derive(Clone, Debug, Default)]
pub struct CurveTree {
    nodes: Vec<CurveNode>,
}

/// A node of a [`CurveTree`].
#[derive(Clone, Copy, Debug)]
pub struct CurveNode {
    /// The curve, in shares of the surface's domain.
    pub curve: Cubic,
    /// The largest distance from what it approximates, millimetres; 0 of a leaf.
    pub error_mm: f64,
    link: Link,
}

#[derive(Clone, Copy, Debug)]
enum Link {
    /// The number of a curve of the chain.
    Leaf(u32),
    /// The first of two children.
    Inner(u32),
}

/// Places at which an approximation is held against each curve of the chain, and against all of them.
const EACH: usize = 4;
const MOST: usize = 64;

impl CurveNode {
    /// The first of its two children; `None` for a leaf.
    pub fn first_child(&self) -> Option<usize> {
        match self.link {
            Link::Leaf(_) => None,
            Link::Inner(first) => Some(first as usize),
        }
    }

    /// Of a leaf, the number of the chain's curve that it is.
    pub fn original(&self) -> Option<usize> {
        match self.link {
            Link::Leaf(original) => Some(original as usize),
            Link::Inner(_) => None,
        }
    }
}

impl CurveTree {
    /// The tree of a chain, whose curves follow each other, in shares of a domain that is `lengths` millimetres long along u
    /// and along v.
    pub fn new(chain: &[Cubic], lengths: DVec2) -> Self {
        if chain.is_empty() {
            return Self::default();
        }
        let mut starts = vec![0.0];
        for cubic in chain {
            let length = cubic.windows(2).map(|pair| ((pair[1] - pair[0]) * lengths).length()).sum::<f64>();
            starts.push(starts[starts.len() - 1] + length.max(f64::MIN_POSITIVE));
        }
        let source = Chain { chain, starts, lengths };
        let mut nodes = Vec::with_capacity(2 * chain.len() - 1);
        nodes.push(source.node(0, chain.len()));
        // Nodes in the order in which they were added, with the curves that each stands for.
        let mut ranges = vec![(0, chain.len())];
        let mut next = 0;
        while next < nodes.len() {
            let (from, to) = ranges[next];
            if to - from > 1 {
                let middle = source.middle(from, to);
                nodes[next].link = Link::Inner(nodes.len() as u32);
                for half in [(from, middle), (middle, to)] {
                    nodes.push(source.node(half.0, half.1));
                    ranges.push(half);
                }
            }
            next += 1;
        }
        Self { nodes }
    }

    /// The nodes, the root first.
    pub fn nodes(&self) -> &[CurveNode] {
        &self.nodes
    }

    /// The coarsest curves that are within `off_mm`, in the order of the chain.
    pub fn cut(&self, off_mm: f64) -> Vec<Cubic> {
        let mut out = Vec::new();
        if !self.nodes.is_empty() {
            self.descend(0, off_mm, &mut out);
        }
        out
    }

    fn descend(&self, index: usize, off_mm: f64, out: &mut Vec<Cubic>) {
        let node = &self.nodes[index];
        match node.first_child() {
            Some(first) if !(node.error_mm <= off_mm) => {
                self.descend(first, off_mm, out);
                self.descend(first + 1, off_mm, out);
            }
            _ => out.push(node.curve),
        }
    }
}

struct Chain<'a> {
    chain: &'a [Cubic],
    /// Lengths up to each curve's start, and of all.
    starts: Vec<f64>,
    lengths: DVec2,
}

impl Chain<'_> {
    /// The curve to split at: the one that starts nearest to the middle.
    fn middle(&self, from: usize, to: usize) -> usize {
        let half = 0.5 * (self.starts[from] + self.starts[to]);
        let off = |k: &usize| (self.starts[*k] - half).abs();
        (from + 1..to).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(from + 1)
    }

    /// The cubic from the first curve's start to the last one's end, with their directions there.
    fn node(&self, from: usize, to: usize) -> CurveNode {
        let (first, last) = (&self.chain[from], &self.chain[to - 1]);
        if to - from == 1 {
            return CurveNode { curve: *first, error_mm: 0.0, link: Link::Leaf(from as u32) };
        }
        let length = self.starts[to] - self.starts[from];
        let share = |k: usize| length / (self.starts[k + 1] - self.starts[k]);
        let curve = [
            first[0],
            first[0] + (first[1] - first[0]) * share(from),
            last[3] + (last[2] - last[3]) * share(to - 1),
            last[3],
        ];
        let stride = ((to - from) * EACH).div_ceil(MOST);
        let places = (0..(to - from) * EACH).step_by(stride).map(|n| (from + n / EACH, (n % EACH) as f64));
        let off = |(k, n): (usize, f64)| {
            let t = (n + 0.5) / EACH as f64;
            let at = self.starts[k] + (self.starts[k + 1] - self.starts[k]) * t - self.starts[from];
            ((point(&self.chain[k], t) - point(&curve, at / length)) * self.lengths).length()
        };
        let ends = (from + 1..to).step_by(stride).map(|k| (k, -0.5));
        let error_mm =
            places.chain(ends).map(off).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
        CurveNode { curve, error_mm, link: Link::Inner(0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of radius 0.4 around the middle, in `n` cubics.
    fn circle(n: usize) -> Vec<Cubic> {
        let angle = std::f64::consts::TAU / n as f64;
        let handle = 4.0 / 3.0 * (angle / 4.0).tan();
        let place = |k: usize| DVec2::from_angle(angle * (k % n) as f64);
        let arc = |k: usize| {
            let (a, b) = (place(k), place(k + 1));
            [a, a + a.perp() * handle, b - b.perp() * handle, b].map(|p| DVec2::splat(0.5) + 0.4 * p)
        };
        (0..n).map(arc).collect()
    }

    #[test]
    fn a_cut_is_closed_and_as_near_as_asked() {
        let chain = circle(64);
        let tree = CurveTree::new(&chain, DVec2::new(10.0, 10.0));
        assert_eq!(tree.nodes().len(), 127);
        let mut before = usize::MAX;
        for off_mm in [1e-9, 1e-4, 1e-2, 1.0] {
            let cut = tree.cut(off_mm);
            for (k, curve) in cut.iter().enumerate() {
                assert_eq!(curve[3], cut[(k + 1) % cut.len()][0]);
                for t in [0.0, 0.3, 0.5, 0.9] {
                    let off = (point(curve, t).distance(DVec2::splat(0.5)) - 0.4).abs() * 10.0;
                    assert!(off <= off_mm + 1e-6, "{off} > {off_mm}");
                }
            }
            assert!(cut.len() <= before);
            before = cut.len();
        }
        assert_eq!((tree.cut(0.0).len(), tree.cut(100.0).len()), (64, 1));
        let mut leaves: Vec<usize> = tree.nodes().iter().filter_map(CurveNode::original).collect();
        leaves.sort_unstable();
        assert_eq!(leaves, (0..64).collect::<Vec<_>>());
        assert!(tree.cut(1e-2).len() <= 8);
    }

    #[test]
    fn nothing_has_no_tree() {
        assert!(CurveTree::new(&[], DVec2::ONE).cut(1.0).is_empty());
        assert_eq!(CurveTree::new(&circle(1)[..1], DVec2::ONE).nodes().len(), 1);
    }
}
