//! T-meshes: vertices on lines of two directions, joined by edges that may end inside.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::{TPoint, TSplineError};
use crate::Interval;

/// A T-mesh for bicubic surfaces.
///
/// Lines of each direction are numbered from 0 and have a knot each. As with a cubic NURBS, vertices stand on lines 2 to
/// n - 3 of n, the two lines outside of them on each side only end blending functions, and the domain reaches from line 3
/// to line n - 4.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TMesh {
    /// Knots of the lines of constant u and of constant v, never decreasing.
    pub knots: [Vec<f64>; 2],
    /// Each place at most once.
    pub vertices: Vec<MeshVertex>,
    /// Edges; where there are none, neighbours on a line are joined.
    pub edges: Vec<MeshEdge>,
}

/// A vertex of a T-mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshVertex {
    /// Its line of constant u, its line of constant v.
    pub lines: [usize; 2],
    /// Its control point.
    pub position: DVec3,
    /// Its weight, positive.
    pub weight: f64,
}

/// An edge of a T-mesh: two places on one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshEdge {
    /// Lines of one end.
    pub from: [usize; 2],
    /// Lines of the other.
    pub to: [usize; 2],
}

impl TMesh {
    pub(super) fn check(&self) -> Result<(), TSplineError> {
        for (d, name) in ['u', 'v'].into_iter().enumerate() {
            let knots = &self.knots[d];
            let is_good = knots.len() >= 8
                && knots.iter().all(|t| t.is_finite())
                && knots.windows(2).all(|pair| pair[0] <= pair[1])
                && knots[3] < knots[knots.len() - 4];
            if !is_good {
                return Err(TSplineError::Knots(name));
            }
        }
        let mut seen = BTreeSet::new();
        for (number, vertex) in self.vertices.iter().enumerate() {
            let [i, j] = vertex.lines;
            if !(0..2).all(|d| self.is_own(d, vertex.lines[d])) {
                return Err(TSplineError::Place(number, i, j));
            }
            if !seen.insert([i, j]) {
                return Err(TSplineError::Twice(i, j));
            }
            if !(vertex.weight > 0.0 && vertex.weight.is_finite() && vertex.position.is_finite()) {
                return Err(TSplineError::Number(number));
            }
        }
        for (number, edge) in self.edges.iter().enumerate() {
            let is_on_line = (edge.from[0] == edge.to[0]) != (edge.from[1] == edge.to[1]);
            let is_own = [edge.from, edge.to].iter().all(|at| (0..2).all(|d| self.is_own(d, at[d])));
            if !(is_on_line && is_own) {
                return Err(TSplineError::Edge(number));
            }
        }
        Ok(())
    }

    fn is_own(&self, d: usize, line: usize) -> bool {
        (2..self.knots[d].len() - 2).contains(&line)
    }

    pub(super) fn domain(&self) -> [Interval; 2] {
        self.knots.each_ref().map(|knots| Interval::new(knots[3], knots[knots.len() - 4]))
    }

    /// The edges, implied ones too.
    fn all_edges(&self) -> Vec<MeshEdge> {
        if !self.edges.is_empty() {
            return self.edges.clone();
        }
        let mut out = Vec::new();
        for d in 0..2 {
            let mut lines: BTreeMap<usize, Vec<[usize; 2]>> = BTreeMap::new();
            for vertex in &self.vertices {
                lines.entry(vertex.lines[d]).or_default().push(vertex.lines);
            }
            for mut line in lines.into_values() {
                line.sort_unstable();
                out.extend(line.windows(2).map(|pair| MeshEdge { from: pair[0], to: pair[1] }));
            }
        }
        out
    }

    /// The knots of each vertex: along each direction those of the two nearest lines on both sides that a ray meets.
    pub(super) fn local_knots(&self) -> Vec<TPoint> {
        let edges = self.all_edges();
        // For each line of direction d, the stretches along the other direction that are drawn.
        let drawn = [0, 1].map(|d| {
            let mut stretches: Vec<Vec<[usize; 2]>> = vec![Vec::new(); self.knots[d].len()];
            for edge in edges.iter().filter(|edge| edge.from[d] == edge.to[d]) {
                let (a, b) = (edge.from[1 - d], edge.to[1 - d]);
                stretches[edge.from[d]].push([a.min(b), a.max(b)]);
            }
            for vertex in &self.vertices {
                stretches[vertex.lines[d]].push([vertex.lines[1 - d]; 2]);
            }
            stretches
        });
        let local = |vertex: &MeshVertex, d: usize| {
            let (own, across) = (vertex.lines[d], vertex.lines[1 - d]);
            let meets = |line: &usize| {
                !self.is_own(d, *line) || drawn[d][*line].iter().any(|[a, b]| (a..=b).contains(&&across))
            };
            let before: Vec<usize> = (0..own).rev().filter(meets).take(2).collect();
            let after: Vec<usize> = (own + 1..self.knots[d].len()).filter(meets).take(2).collect();
            [before[1], before[0], own, after[0], after[1]].map(|line| self.knots[d][line])
        };
        let point = |vertex: &MeshVertex| TPoint {
            position: vertex.position,
            weight: vertex.weight,
            knots: [local(vertex, 0), local(vertex, 1)],
        };
        self.vertices.iter().map(point).collect()
    }
}
