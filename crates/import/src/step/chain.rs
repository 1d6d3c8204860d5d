//! Loops whose edges do not meet end to end: vertices that stand for one point are merged, edges reordered.

use glam::DVec3;
use trimloop_brep::{Coedge, Diagnostic, Diagnostics, EntityRef, Loop, Severity, VertexId};

use super::fault::Outcome;
use super::seeds::{EdgeSeed, Seeds};

/// How far apart two vertices may always lie to be merged, millimetres.
const MERGE_MM: f64 = 1e-4;

/// How far apart they may lie at most, however inaccurate the file says it is.
const MERGE_AT_MOST_MM: f64 = 0.1;

/// How far apart they may lie as a share of the shorter edge: the loop says that they are one point.
const MERGE_SHARE: f64 = 0.01;

/// Mends every loop whose edges do not meet, as far as that can be done by merging vertices or by putting the
/// edges into another order or direction. `points` are the vertices' points.
pub(crate) fn mend_loops(seeds: &mut Seeds, points: &[Outcome<DVec3>]) {
    let mut merged = Merged { parent: Vec::new(), count: 0 };
    let mut diagnostics = Vec::new();
    for face in &mut seeds.faces {
        for bound in &mut face.loops {
            if first_gap(&bound.coedges, &seeds.edges, &merged).is_some() {
                mend(bound, &seeds.edges, points, &mut merged, &mut diagnostics);
            }
        }
    }
    if merged.count > 0 {
        for edge in &mut seeds.edges {
            (edge.start, edge.end) = (merged.root(edge.start), merged.root(edge.end));
        }
        let message = format!("{} vertices that stand for the same points were merged.", merged.count);
        diagnostics.push(Diagnostic::new(Severity::Info, "vertices-merged", EntityRef::None, message));
    }
    seeds.diagnostics.append(&mut diagnostics);
}

/// The first coedge that does not start where the one before it ends.
fn first_gap(coedges: &[Coedge], edges: &[EdgeSeed], merged: &Merged) -> Option<usize> {
    let mut before = ends(coedges.last()?, edges)[1];
    for (i, coedge) in coedges.iter().enumerate() {
        let [start, end] = ends(coedge, edges);
        if start != before && merged.root(start) != merged.root(before) {
            return Some(i);
        }
        before = end;
    }
    None
}

/// Where a coedge starts and ends.
fn ends(coedge: &Coedge, edges: &[EdgeSeed]) -> [VertexId; 2] {
    let edge = &edges[coedge.edge as usize];
    if coedge.reversed { [edge.end, edge.start] } else { [edge.start, edge.end] }
}

fn mend(
    bound: &mut Loop,
    edges: &[EdgeSeed],
    points: &[Outcome<DVec3>],
    merged: &mut Merged,
    diagnostics: &mut Diagnostics,
) {
    let entity = bound.entity;
    let widest = merge_joints(&bound.coedges, edges, points, merged);
    if widest > MERGE_MM {
        let message = format!("Gaps of up to {widest:.4} mm between the edges of loop {entity} were closed.");
        diagnostics.push(Diagnostic::new(Severity::Warning, "loop-gap-closed", entity, message));
    }
    if first_gap(&bound.coedges, edges, merged).is_none() {
        return;
    }
    if let Some(chained) = chained(&bound.coedges, edges, merged) {
        bound.coedges = chained;
        let message =
            format!("The edges of loop {entity} were out of order or turned; they were put in order.");
        diagnostics.push(Diagnostic::new(Severity::Warning, "loop-reordered", entity, message));
    } else {
        let message = format!("The edges of loop {entity} do not meet.");
        diagnostics.push(Diagnostic::new(Severity::Warning, "loop-gap", entity, message));
    }
}

/// Merges the vertices at joints that are one point within the accuracy of the file, or so near compared with the
/// edges that they must be meant to be one. Gives the widest gap that was closed.
fn merge_joints(
    coedges: &[Coedge],
    edges: &[EdgeSeed],
    points: &[Outcome<DVec3>],
    merged: &mut Merged,
) -> f64 {
    let Some(mut previous) = coedges.last() else { return 0.0 };
    let chord = |coedge: &Coedge| {
        let [start, end] = ends(coedge, edges).map(|vertex| points[vertex as usize].as_ref().ok());
        start.zip(end).map_or(0.0, |(start, end)| start.distance(*end))
    };
    let mut widest: f64 = 0.0;
    for coedge in coedges {
        let (from, to) = (ends(previous, edges)[1], ends(coedge, edges)[0]);
        match (&points[from as usize], &points[to as usize]) {
            // A vertex that is lost is where the loop goes on.
            (Ok(_), Err(_)) => merged.merge_into(to, from),
            (Err(_), Ok(_)) => merged.merge_into(from, to),
            _ => {}
        }
        let shorter = chord(previous).min(chord(coedge));
        let uncertainty_mm =
            edges[coedge.edge as usize].units.uncertainty_mm.min(MERGE_SHARE.sqrt() * shorter);
        let reach = uncertainty_mm.max(MERGE_SHARE * shorter).clamp(MERGE_MM, MERGE_AT_MOST_MM);
        if let (Ok(a), Ok(b)) = (&points[from as usize], &points[to as usize])
            && from != to
            && a.distance(*b) <= reach
        {
            merged.merge(from, to);
            widest = widest.max(a.distance(*b));
        }
        previous = coedge;
    }
    widest
}

/// The same edges in an order and in directions in which each starts where the one before ends, if there is one
/// that begins with the first.
fn chained(coedges: &[Coedge], edges: &[EdgeSeed], merged: &Merged) -> Option<Vec<Coedge>> {
    const MOST: usize = 2000;
    if coedges.len() > MOST {
        return None;
    }
    let root_ends = |coedge: &Coedge| ends(coedge, edges).map(|vertex| merged.root(vertex));
    let mut rest: Vec<&Coedge> = coedges.iter().skip(1).collect();
    let mut chain = vec![coedges.first()?.clone()];
    let [first, mut at] = root_ends(&chain[0]);
    while !rest.is_empty() {
        // As written, if that fits; else turned.
        let next = rest.iter().position(|coedge| root_ends(coedge)[0] == at);
        let next = next.or_else(|| rest.iter().position(|coedge| root_ends(coedge)[1] == at))?;
        let mut coedge = rest.remove(next).clone();
        let [start, end] = root_ends(&coedge);
        coedge.reversed ^= start != at;
        at = if start == at { end } else { start };
        chain.push(coedge);
    }
    (at == first).then_some(chain)
}

/// Which vertices stand for the same point.
struct Merged {
    parent: Vec<VertexId>,
    count: usize,
}

impl Merged {
    fn root(&self, vertex: VertexId) -> VertexId {
        let mut root = vertex;
        while let Some(&parent) = self.parent.get(root as usize) {
            if parent == root {
                break;
            }
            root = parent;
        }
        root
    }

    /// The one that was read first stands for both.
    fn merge(&mut self, a: VertexId, b: VertexId) {
        let (a, b) = (self.root(a), self.root(b));
        self.merge_into(a.max(b), a.min(b));
    }

    /// `target` stands for `lost` too, if nothing else does already.
    fn merge_into(&mut self, lost: VertexId, target: VertexId) {
        let target = self.root(target);
        if self.root(lost) != lost || lost == target {
            return;
        }
        let needed = lost as usize + 1;
        self.parent.extend(self.parent.len() as VertexId..needed.max(self.parent.len()) as VertexId);
        self.parent[lost as usize] = target;
        self.count += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_vertex_stands_for_all() {
        let mut merged = Merged { parent: Vec::new(), count: 0 };
        merged.merge(5, 3);
        merged.merge(5, 9);
        assert_eq!([3, 5, 9, 4, 12].map(|vertex| merged.root(vertex)), [3, 3, 3, 4, 12]);
        assert_eq!(merged.count, 2);
    }
}
