//! Faces that do not share their edges, though the edges lie on each other.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{
    Body, BodyKind, Diagnostic, Diagnostics, Edge, EdgeId, FaceGeometry, FaceId, Part, Severity, VertexId,
};
use trimloop_geom::{Aabb, Curve, Surface};

use crate::hint::over;
use crate::parallel::map_each;

/// How far apart edges may lie to be one, millimetres. The file's uncertainty is no good guide, it is often the
/// modeller's and not the exporter's.
const WIDEST_MM: f64 = 2e-2;

/// The same, as a share of the size of all that is sewn: in a part of a tenth of a millimetre, as metres that are called
/// millimetres make it, edges 0.02 mm apart are not one.
const WIDEST_SHARE: f64 = 2e-4;

/// The reaches within which edges of a body are joined, the nearest first, millimetres.
pub(crate) fn reaches_mm(part: &Part, body: &Body, widest_mm: f64) -> [f64; 3] {
    let points = edges_of(part, body).map(|id| &part.edges[id as usize]).flat_map(|edge| {
        let ends = [edge.start, edge.end].map(|id| part.vertices[id as usize].point);
        // Rings have their size between their ends.
        let other = if edge.start == edge.end { edge.curve.point(edge.range.at(0.5)) } else { ends[1] };
        [ends[0], other]
    });
    let most = WIDEST_SHARE * Aabb::from_points(points).diagonal();
    let most = if most.is_finite() { most } else { 0.0 };
    [1e-6, 1e-3, widest_mm].map(|reach| reach.min(most))
}

/// Makes faces of a solid share the edges that coincide. Edges that two faces share already stay as they are.
pub(crate) fn sew(part: &mut Part, diagnostics: &mut Diagnostics) {
    for index in 0..part.bodies.len() {
        if part.bodies[index].kind != BodyKind::Solid {
            continue;
        }
        let reaches = reaches_mm(part, &part.bodies[index], WIDEST_MM);
        let sewn = sew_body(part, index, &reaches);
        if sewn > 0 {
            let entity = part.bodies[index].entity;
            let message = format!("{sewn} edges of solid {entity} that lie on others were joined with them.");
            diagnostics.push(Diagnostic::new(Severity::Warning, "edges-sewn", entity, message));
        }
    }
}

/// Makes the faces of one body share the edges that coincide, within each reach in turn, millimetres; gives how many
/// edges went.
pub(crate) fn sew_body(part: &mut Part, index: usize, reaches_mm: &[f64]) -> usize {
    let mut uses = vec![0u32; part.edges.len()];
    let mut sewn = 0;
    for &reach in reaches_mm {
        let free = free_edges(part, &part.bodies[index], &mut uses);
        if free.len() < 2 {
            break;
        }
        sewn += sew_edges(part, index, &free, reach);
    }
    sewn
}

/// The edges that the body's faces use once in all, in order. `uses` is all zero before and after.
pub(crate) fn free_edges(part: &Part, body: &Body, uses: &mut [u32]) -> Vec<EdgeId> {
    let mut used: Vec<EdgeId> = Vec::new();
    for edge in edges_of(part, body) {
        uses[edge as usize] += 1;
        if uses[edge as usize] == 1 {
            used.push(edge);
        }
    }
    let mut free: Vec<EdgeId> = used.iter().copied().filter(|&edge| uses[edge as usize] == 1).collect();
    used.iter().for_each(|&edge| uses[edge as usize] = 0);
    free.sort_unstable();
    free
}

fn edges_of<'p>(part: &'p Part, body: &'p Body) -> impl Iterator<Item = EdgeId> + 'p {
    let faces = body.shells.iter().flat_map(|shell| &shell.faces).map(|used| &part.faces[used.face as usize]);
    faces.flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges).map(|coedge| coedge.edge)
}

/// Joins the pairs among `free`; gives how many edges went.
fn sew_edges(part: &mut Part, body: usize, free: &[EdgeId], reach: f64) -> usize {
    let vertex = coincident_vertices(part, free, reach);
    let root = |id: VertexId| root(&vertex, id);
    let ends = |id: EdgeId| [part.edges[id as usize].start, part.edges[id as usize].end].map(root);
    let mut by_ends: FxHashMap<(VertexId, VertexId), Vec<EdgeId>> = FxHashMap::default();
    for &id in free {
        let [start, end] = ends(id);
        by_ends.entry((start.min(end), start.max(end))).or_default().push(id);
    }
    let groups: Vec<Vec<EdgeId>> = by_ends.into_values().filter(|group| group.len() > 1).collect();
    let faces = FacesOfEdges::new(part, &part.bodies[body]);
    let joined = map_each(&groups, |group| pairs(part, &faces, group, reach));
    let replaced: FxHashMap<EdgeId, (EdgeId, bool)> = joined
        .into_iter()
        .flatten()
        .map(|(gone, kept)| {
            let [edge, other] = [gone, kept].map(|id| &part.edges[id as usize]);
            let ([start, end], [first, _]) = (ends(gone), ends(kept));
            (gone, (kept, if start == end { turns_back(edge, other) } else { first != start }))
        })
        .collect();
    if replaced.is_empty() {
        return 0;
    }
    let image = |part: &Part, pcurve: &Curve, from: EdgeId, to: EdgeId, turned: bool| {
        let [from, to] = [from, to].map(|id| &part.edges[id as usize]);
        over(pcurve, from.range, to.range, turned != (from.same_sense != to.same_sense)).map(Arc::new)
    };
    let faces: Vec<_> =
        part.bodies[body].shells.iter().flat_map(|shell| &shell.faces).map(|f| f.face).collect();
    for face in faces {
        let mut loops = std::mem::take(&mut part.faces[face as usize].loops);
        for coedge in loops.iter_mut().flat_map(|bound| &mut bound.coedges) {
            if let Some(&(edge, turned)) = replaced.get(&coedge.edge) {
                let pcurve = coedge.pcurve.take();
                coedge.pcurve = pcurve.and_then(|pcurve| image(part, &pcurve, coedge.edge, edge, turned));
                coedge.edge = edge;
                coedge.reversed ^= turned;
            }
        }
        part.faces[face as usize].loops = loops;
    }
    let used: Vec<EdgeId> = edges_of(part, &part.bodies[body]).collect();
    for id in used {
        let edge = &mut part.edges[id as usize];
        (edge.start, edge.end) = (root(edge.start), root(edge.end));
    }
    replaced.len()
}

/// The face that uses each edge, one of them where there are more.
struct FacesOfEdges(Vec<FaceId>);

impl FacesOfEdges {
    fn new(part: &Part, body: &Body) -> Self {
        let mut faces = vec![FaceId::MAX; part.edges.len()];
        for used in body.shells.iter().flat_map(|shell| &shell.faces) {
            let coedges = part.faces[used.face as usize].loops.iter().flat_map(|bound| &bound.coedges);
            coedges.for_each(|coedge| faces[coedge.edge as usize] = used.face);
        }
        Self(faces)
    }

    /// Whether two edges can be one. Two of the same face can where the face closes in between: a spline that does not,
    /// or that lies over itself, has two places in its parameter plane for them.
    fn may_join(&self, part: &Part, a: EdgeId, b: EdgeId) -> bool {
        let face = self.0[a as usize];
        if face != self.0[b as usize] || face == FaceId::MAX {
            return true;
        }
        let face = &part.faces[face as usize];
        let FaceGeometry::Surface(surface) = &face.geometry else { return true };
        let is_free = matches!(
            **surface,
            Surface::Nurbs(_)
                | Surface::Extrusion { .. }
                | Surface::Revolution { .. }
                | Surface::Offset { .. }
        );
        let periods = surface.periods();
        if !is_free || periods == [None, None] {
            return !is_free;
        }
        let middle = |id: EdgeId| {
            let coedge =
                face.loops.iter().flat_map(|bound| &bound.coedges).find(|coedge| coedge.edge == id)?;
            let edge = &part.edges[id as usize];
            Some(coedge.pcurve.as_ref()?.point(edge.range.at(0.5)).truncate())
        };
        let (Some(a), Some(b)) = (middle(a), middle(b)) else { return true };
        let domain = surface.domain();
        (0..2).all(|k| {
            let apart = (a - b)[k].abs();
            let near = 1e-2 * domain[k].length();
            apart <= near || periods[k].is_some_and(|period| (apart - period).abs() <= near)
        })
    }
}

/// Among edges between the same vertices those that coincide, each with an earlier one.
fn pairs(part: &Part, faces: &FacesOfEdges, group: &[EdgeId], reach: f64) -> Vec<(EdgeId, EdgeId)> {
    let mut waiting: Vec<EdgeId> = Vec::new();
    let mut out = Vec::new();
    for &id in group {
        let edge = &part.edges[id as usize];
        let joins = |&other: &EdgeId| {
            faces.may_join(part, id, other) && coincide(edge, &part.edges[other as usize], reach)
        };
        match waiting.iter().position(joins) {
            Some(place) => out.push((id, waiting.swap_remove(place))),
            None => waiting.push(id),
        }
    }
    out
}

/// For the ends of free edges, the first vertex that lies at the same place; not for those of an edge that would shrink
/// to nothing. A vertex lies where it says and where the curves of its edges end, which in rough files is not the same.
fn coincident_vertices(part: &Part, free: &[EdgeId], reach: f64) -> FxHashMap<VertexId, VertexId> {
    let mut first: FxHashMap<VertexId, VertexId> = FxHashMap::default();
    let mut grid: FxHashMap<[i64; 3], Vec<(VertexId, DVec3)>> = FxHashMap::default();
    let cell = |point: DVec3| (point / (8.0 * reach)).floor().to_array().map(|x| x as i64);
    for (id, point) in places(part, free, reach) {
        let (low, high) = (cell(point - reach), cell(point + reach));
        let near = (low[0]..=high[0])
            .flat_map(|x| (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z])));
        let mut known = near.filter_map(|cell| grid.get(&cell)).flatten();
        match known.find(|(_, other)| other.distance(point) <= reach) {
            Some(&(other, _)) => {
                let (a, b) = (root(&first, id), root(&first, other));
                if a != b {
                    first.insert(a.max(b), a.min(b));
                }
            }
            None => grid.entry(cell(point)).or_default().push((id, point)),
        }
    }
    let settled: Vec<(VertexId, VertexId)> = first.keys().map(|&id| (id, root(&first, id))).collect();
    first.extend(settled);
    for &id in free {
        let edge = &part.edges[id as usize];
        if edge.start == edge.end || root(&first, edge.start) != root(&first, edge.end) {
            continue;
        }
        let middle = edge.curve.point(edge.range.at(0.5));
        if middle.distance(part.vertices[edge.start as usize].point) <= 2.0 * reach {
            first.remove(&edge.start);
            first.remove(&edge.end);
        }
    }
    first
}

/// Where vertices of edges lie, in their order, and then where curves end beyond `reach` of them.
fn places(part: &Part, edges: &[EdgeId], reach: f64) -> Vec<(VertexId, DVec3)> {
    let mut own: Vec<VertexId> = Vec::with_capacity(2 * edges.len());
    let mut apart: Vec<(VertexId, DVec3)> = Vec::new();
    for &id in edges {
        let edge = &part.edges[id as usize];
        let vertices = if edge.same_sense { [edge.start, edge.end] } else { [edge.end, edge.start] };
        for (vertex, t) in vertices.into_iter().zip([edge.range.start, edge.range.end]) {
            own.push(vertex);
            let end = edge.curve.point(t);
            if end.distance(part.vertices[vertex as usize].point) > reach {
                apart.push((vertex, end));
            }
        }
    }
    own.sort_unstable();
    own.dedup();
    let mut out: Vec<(VertexId, DVec3)> =
        own.into_iter().map(|id| (id, part.vertices[id as usize].point)).collect();
    out.append(&mut apart);
    out
}

/// The vertex that stands for another.
fn root(first: &FxHashMap<VertexId, VertexId>, mut id: VertexId) -> VertexId {
    while let Some(&next) = first.get(&id) {
        id = next;
    }
    id
}

/// Whether two edges between the same vertices run along the same line.
pub(crate) fn coincide(a: &Edge, b: &Edge, reach: f64) -> bool {
    let at = |edge: &Edge, share: f64| edge.curve.point(edge.range.at(share));
    let (a, b, shares) = match [stations(a), stations(b)] {
        [ours, theirs] if ours.len() >= theirs.len() => (a, b, ours),
        [_, theirs] => (b, a, theirs),
    };
    // Mostly they have the same parameters, one way or the other, and nothing need be searched.
    let alike = |turned: bool| {
        shares.iter().all(|&s| at(a, s).distance(at(b, if turned { 1.0 - s } else { s })) <= reach)
    };
    if alike(false) || alike(true) {
        return true;
    }
    // Where they do not, the feet still lie in about the same places.
    let turned = (at(a, 0.0).distance(at(b, 0.0)) > at(a, 0.0).distance(at(b, 1.0))) && a.start != a.end;
    shares.iter().all(|&share| {
        let point = at(a, share);
        let start = b.range.at(if turned { 1.0 - share } else { share });
        if comes_near(b, point, start, reach) {
            return true;
        }
        let foot = b.curve.project(point, None);
        foot.distance <= reach && share_at(b, foot.t).is_some_and(|s| (0.0..=1.0).contains(&s))
    })
}

/// Whether a few Gauss-Newton steps along an edge from `t` come to within `reach` of a point.
fn comes_near(edge: &Edge, point: DVec3, mut t: f64, reach: f64) -> bool {
    for _ in 0..8 {
        let [at, along, _] = edge.curve.derivatives(t);
        if at.distance(point) <= reach {
            return true;
        }
        let next = edge.range.clamp(t - (at - point).dot(along) / along.length_squared());
        let settled = (next - t).abs() * along.length() <= 0.1 * reach;
        if settled || next.is_nan() {
            return false;
        }
        t = next;
    }
    false
}

/// Where Gauss-Newton steps along an edge end.
pub(crate) enum Nearest {
    /// At this parameter, where the edge is within reach.
    Within(f64),
    /// Where the edge comes no nearer, but is beyond reach.
    Beyond,
    /// Nowhere.
    Unsettled,
}

/// Where a few Gauss-Newton steps along an edge from `t` towards a point end.
pub(crate) fn nearest_from(edge: &Edge, point: DVec3, mut t: f64, reach: f64) -> Nearest {
    let mut step = f64::INFINITY;
    for _ in 0..8 {
        let [at, along, _] = edge.curve.derivatives(t);
        let next = edge.range.clamp(t - (at - point).dot(along) / along.length_squared());
        let distance = at.distance(point);
        if distance <= reach && (next - t).abs() >= 0.5 * step {
            return Nearest::Within(t);
        }
        step = (next - t).abs();
        if !step.is_finite() {
            return Nearest::Unsettled;
        }
        if step * along.length() <= 1e-3 * reach {
            return if distance <= reach { Nearest::Within(next) } else { Nearest::Beyond };
        }
        t = next;
    }
    if edge.curve.point(t).distance(point) <= reach { Nearest::Within(t) } else { Nearest::Unsettled }
}

/// Where along an edge others are held against it, as shares of its range: between all of its curve's knots and corners,
/// and at three places at least.
fn stations(edge: &Edge) -> Vec<f64> {
    let breaks = edge.curve.breakpoints(edge.range);
    let spans = breaks.len().saturating_sub(1).max(1);
    let parts = if spans == 1 { 4 } else { 2 };
    let share = |t: f64| (t - edge.range.start) / edge.range.length();
    let inside = |pair: &[f64]| {
        let [from, to] = [pair[0], pair[1]].map(share);
        (0..parts).map(move |k| from + (to - from) * f64::from(k) / f64::from(parts))
    };
    breaks.windows(2).flat_map(inside).skip(1).collect()
}

/// Where along an edge, as a share of its range, its curve's parameter `t` or the same a few turns away lies.
pub(crate) fn share_at(edge: &Edge, mut t: f64) -> Option<f64> {
    if let Some(period) = edge.curve.period() {
        while t < edge.range.start {
            t += period;
        }
        while t - period >= edge.range.start {
            t -= period;
        }
    }
    let share = (t - edge.range.start) / edge.range.length();
    share.is_finite().then_some(share)
}

/// Whether two closed edges run around in opposite directions.
pub(crate) fn turns_back(a: &Edge, b: &Edge) -> bool {
    let t = a.range.at(0.5);
    let along_a = a.curve.derivatives(t)[1];
    let foot = b.curve.project(a.curve.point(t), None);
    let along_b = b.curve.derivatives(foot.t)[1];
    (along_a.dot(along_b) < 0.0) != (a.same_sense != b.same_sense)
}

#[cfg(test)]
mod tests {
    use trimloop_brep::EntityRef;
    use trimloop_geom::{Interval, Polyline};

    use super::*;

    fn edge(points: &[[f64; 3]]) -> Edge {
        let polyline = Polyline { points: points.iter().copied().map(DVec3::from).collect() };
        let range = Interval::new(0.0, (points.len() - 1) as f64);
        let curve = std::sync::Arc::new(Curve::Polyline(polyline));
        Edge { entity: EntityRef::None, start: 0, end: 1, curve, range, same_sense: true }
    }

    /// The two halves of a rim with a long straight side each: the sides coincide, the halves do not.
    #[test]
    fn edges_that_coincide_for_the_most_part_are_two() {
        let side = [[0.0, 0.0, 0.0], [0.0, 0.0, 9.0], [0.0, 0.0, 18.0], [0.0, 0.0, 27.0]];
        let rim = |y: f64| edge(&[&side[..], &[[1.0, y, 27.0], [2.0, 0.0, 27.0]]].concat());
        assert!(coincide(&rim(1.0), &rim(1.0), 1e-6));
        assert!(!coincide(&rim(1.0), &rim(-1.0), 1e-6));
        let turned = edge(&[[2.0, 0.0, 27.0], [1.0, 1.0, 27.0], side[3], side[0]]);
        assert!(coincide(&rim(1.0), &turned, 1e-6), "with other parameters, the other way");
    }
}
