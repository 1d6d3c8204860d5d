//! Edges cut where others end on them, so that one long edge can meet several short ones.

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{Coedge, Edge, EdgeId, FaceId, Part, Vertex, VertexId};
use trimloop_geom::{Aabb, Interval};

use crate::parallel::map_each;
use crate::sew::{Nearest, nearest_from, share_at};

/// Cuts the edges among `free` on which ends of others lie within `reach`, millimetres; gives how many cuts were made.
pub(crate) fn split_edges(part: &mut Part, faces: &[FaceId], free: &[EdgeId], reach: f64) -> usize {
    let ends = Ends::new(part, free);
    let mut parts: FxHashMap<EdgeId, Vec<EdgeId>> = FxHashMap::default();
    let mut cuts = 0;
    let points = map_each(free, |&id| cut_points(part, id, &ends, reach));
    for (&id, points) in free.iter().zip(points).filter(|(_, points)| !points.is_empty()) {
        cuts += points.len();
        let pieces = cut(part, id, &points);
        parts.insert(id, pieces);
    }
    if cuts > 0 {
        for &face in faces {
            for bound in &mut part.faces[face as usize].loops {
                if bound.coedges.iter().any(|coedge| parts.contains_key(&coedge.edge)) {
                    bound.coedges = replaced(&bound.coedges, &parts);
                }
            }
        }
    }
    cuts
}

/// The ends of edges, by where they lie.
struct Ends {
    points: Vec<DVec3>,
    low: DVec3,
    cell: f64,
    cells: FxHashMap<[i64; 3], Vec<u32>>,
}

impl Ends {
    fn new(part: &Part, free: &[EdgeId]) -> Self {
        let edges = free.iter().map(|&id| &part.edges[id as usize]);
        let mut vertices: Vec<VertexId> = edges.flat_map(|edge| [edge.start, edge.end]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let points: Vec<DVec3> = vertices.iter().map(|&id| part.vertices[id as usize].point).collect();
        let bounds = Aabb::from_points(points.iter().copied());
        let cell = (bounds.diagonal() / (points.len() as f64).cbrt().max(1.0)).max(1e-9);
        let mut ends = Self { points, low: bounds.min, cell, cells: FxHashMap::default() };
        for index in 0..ends.points.len() {
            let key = ends.key(ends.points[index]);
            ends.cells.entry(key).or_default().push(index as u32);
        }
        ends
    }

    fn key(&self, point: DVec3) -> [i64; 3] {
        ((point - self.low) / self.cell).floor().to_array().map(|x| x as i64)
    }

    /// The points in a box.
    fn within(&self, bounds: Aabb) -> Vec<DVec3> {
        let inside = |p: &DVec3| p.cmpge(bounds.min).all() && p.cmple(bounds.max).all();
        let (low, high) = (self.key(bounds.min), self.key(bounds.max));
        let count = (0..3).map(|k| high[k] as f64 - low[k] as f64 + 1.0).product::<f64>();
        if !(count <= self.cells.len() as f64) {
            return self.points.iter().copied().filter(inside).collect();
        }
        let mut out = Vec::new();
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let found = self.cells.get(&[x, y, z]).into_iter().flatten();
                    out.extend(found.map(|&index| self.points[index as usize]).filter(inside));
                }
            }
        }
        out
    }
}

/// Where on an edge others end: parameters in order, and the points that lie there.
fn cut_points(part: &Part, id: EdgeId, ends: &Ends, reach: f64) -> Vec<(f64, DVec3)> {
    let edge = &part.edges[id as usize];
    let corners = [edge.start, edge.end].map(|vertex| part.vertices[vertex as usize].point);
    let line = Outline::new(edge);
    let mut out: Vec<(f64, DVec3)> = Vec::new();
    for point in ends.within(line.bounds(reach)) {
        if corners.iter().any(|corner| corner.distance(point) <= 2.0 * reach) {
            continue;
        }
        let share = foot_within(edge, &line, point, reach)
            .and_then(|t| share_at(edge, t))
            .filter(|share| (1e-9..1.0 - 1e-9).contains(share));
        out.extend(share.map(|share| (edge.range.at(share), point)));
    }
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    out.dedup_by(|next, before| next.1.distance(before.1) <= 2.0 * reach);
    out
}

/// The parameter at which an edge is within `reach` of a point.
fn foot_within(edge: &Edge, line: &Outline, point: DVec3, reach: f64) -> Option<f64> {
    for share in line.near(point, reach) {
        match nearest_from(edge, point, edge.range.at(share), reach) {
            Nearest::Within(t) => return Some(t),
            Nearest::Beyond => {}
            Nearest::Unsettled => {
                let foot = edge.curve.project(point, None);
                return (foot.distance <= reach).then_some(foot.t);
            }
        }
    }
    None
}

/// An edge as a few straight lines, to tell at once what is far from it.
struct Outline {
    points: Vec<DVec3>,
    /// How far the edge strays from the lines, about.
    sag: f64,
}

impl Outline {
    const PIECES: usize = 8;

    fn new(edge: &Edge) -> Self {
        let at = |k: usize| edge.curve.point(edge.range.at(k as f64 / (2 * Self::PIECES) as f64));
        let all: Vec<DVec3> = (0..=2 * Self::PIECES).map(at).collect();
        let sags = all.windows(3).step_by(2).map(|p| segment_foot(p[1], p[0], p[2]).1);
        Self { sag: sags.fold(0.0, f64::max), points: all.into_iter().step_by(2).collect() }
    }

    /// What may be within `reach` of the edge is in this box.
    fn bounds(&self, reach: f64) -> Aabb {
        let margin = reach + 4.0 * self.sag;
        let bounds = Aabb::from_points(self.points.iter().copied());
        Aabb { min: bounds.min - margin, max: bounds.max + margin }
    }

    /// About where along the edge, as shares of its range, it may come within `reach` of a point: one per line.
    fn near(&self, point: DVec3, reach: f64) -> impl Iterator<Item = f64> {
        let limit = reach + 4.0 * self.sag;
        self.points.windows(2).enumerate().filter_map(move |(piece, ends)| {
            let (share, distance) = segment_foot(point, ends[0], ends[1]);
            (!(distance > limit)).then_some((piece as f64 + share) / Self::PIECES as f64)
        })
    }
}

/// The point of a segment nearest to `point`, as a share of its length, and how far it is.
fn segment_foot(point: DVec3, a: DVec3, b: DVec3) -> (f64, f64) {
    let along = b - a;
    let share = ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let share = if share.is_nan() { 0.0 } else { share };
    (share, point.distance(a + along * share))
}

/// The pieces of an edge between points, in the direction of its curve; the first keeps the edge's number.
fn cut(part: &mut Part, id: EdgeId, points: &[(f64, DVec3)]) -> Vec<EdgeId> {
    let whole = part.edges[id as usize].clone();
    let (first, last) = if whole.same_sense { (whole.start, whole.end) } else { (whole.end, whole.start) };
    let mut out = Vec::with_capacity(points.len() + 1);
    let mut from = (whole.range.start, first);
    for k in 0..=points.len() {
        let to = match points.get(k) {
            Some(&(t, _)) => {
                let vertex = Vertex { entity: whole.entity, point: whole.curve.point(t) };
                part.vertices.push(vertex);
                (t, (part.vertices.len() - 1) as VertexId)
            }
            None => (whole.range.end, last),
        };
        let (start, end) = if whole.same_sense { (from.1, to.1) } else { (to.1, from.1) };
        let piece = Edge { start, end, range: Interval::new(from.0, to.0), ..whole.clone() };
        if k == 0 {
            part.edges[id as usize] = piece;
            out.push(id);
        } else {
            part.edges.push(piece);
            out.push((part.edges.len() - 1) as EdgeId);
        }
        from = to;
    }
    // From the edge's start to its end.
    if !whole.same_sense {
        out.reverse();
    }
    out
}

fn replaced(coedges: &[Coedge], parts: &FxHashMap<EdgeId, Vec<EdgeId>>) -> Vec<Coedge> {
    let mut out = Vec::with_capacity(coedges.len() + 1);
    for coedge in coedges {
        let Some(pieces) = parts.get(&coedge.edge) else {
            out.push(coedge.clone());
            continue;
        };
        let piece =
            |&edge: &EdgeId| Coedge { edge, reversed: coedge.reversed, pcurve: coedge.pcurve.clone() };
        if coedge.reversed {
            out.extend(pieces.iter().rev().map(piece));
        } else {
            out.extend(pieces.iter().map(piece));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_looked_up_in_boxes_of_any_size() {
        let points: Vec<DVec3> = (0..1000).map(|k| DVec3::new(f64::from(k) * 1e-3, 0.0, 0.0)).collect();
        let mut ends = Ends { points, low: DVec3::ZERO, cell: 1e-9, cells: FxHashMap::default() };
        for index in 0..ends.points.len() {
            let key = ends.key(ends.points[index]);
            ends.cells.entry(key).or_default().push(index as u32);
        }
        let within =
            |half: f64| ends.within(Aabb { min: DVec3::splat(-half), max: DVec3::splat(half) }).len();
        assert_eq!(
            [1e-10, 0.5005, 1e9, 1e12, 1e300, f64::INFINITY].map(within),
            [1, 501, 1000, 1000, 1000, 1000]
        );
    }
}
