//! Loose faces sewn into bodies.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{
    Body, BodyKind, Coedge, Diagnostic, Edge, EdgeId, EntityRef, Face, FaceGeometry, FaceId, Part, Severity,
    Shell, ShellFace,
};
use trimloop_geom::{Curve, Interval, Surface};

use super::face::lies_on;
use super::look::levels_of;
use super::shape::ShapeBuilder;
use crate::sew::{coincide, free_edges, reaches_mm, sew_body, turns_back};
use crate::split::split_edges;

/// The least and the most that edges may lie apart to be one, millimetres, whatever the file states.
const LEAST_REACH_MM: f64 = 2e-2;
const MOST_REACH_MM: f64 = 0.1;

impl ShapeBuilder<'_> {
    /// Sews the faces that came one by one, and makes a body of each set that hangs together.
    pub fn make_bodies(&mut self) {
        let loose = std::mem::take(&mut self.loose);
        if loose.is_empty() {
            return;
        }
        sew(&mut self.part, &loose);
        let told = std::mem::take(&mut self.told);
        sew_told(&mut self.part, &loose, &told);
        let mut uses = vec![0u32; self.part.edges.len()];
        let all_open = free_edges(&self.part, &body(loose.clone()), &mut uses);
        let samples = SampledEdges::new(&self.part, &all_open);
        for faces in components(&self.part, &loose) {
            let mut made = body(faces);
            let open = free_edges(&self.part, &made, &mut uses);
            let faces = made.shells[0].faces.clone();
            let is_closed = |it: &ShellFace| is_closed(&self.part.faces[it.face as usize]);
            if open.is_empty() && faces.iter().all(is_closed) {
                made.kind = BodyKind::Solid;
                made.shells[0].closed = true;
            } else if faces.len() > 1 && !open.is_empty() {
                let entity = self.part.faces[faces[0].face as usize].entity;
                self.diagnostics.push(open_edges(&samples, &open, faces.len(), entity));
            }
            let mut layers: Vec<String> = faces
                .iter()
                .flat_map(|it| match self.part.faces[it.face as usize].entity {
                    EntityRef::Iges(entry) => levels_of(&self.reader, entry),
                    _ => Vec::new(),
                })
                .collect();
            layers.sort_unstable();
            layers.dedup();
            made.layers = layers;
            self.part.bodies.push(made);
        }
    }
}

/// Whether a face has edges, or needs none: a whole ball or torus.
fn is_closed(face: &Face) -> bool {
    let FaceGeometry::Surface(surface) = &face.geometry else { return false };
    let closes = matches!(**surface, Surface::Sphere { .. }) || surface.periods().iter().all(Option::is_some);
    closes || !face.loops.is_empty()
}

/// Makes the faces share the edges that coincide, whole or in part.
fn sew(part: &mut Part, faces: &[FaceId]) {
    part.bodies.push(body(faces.to_vec()));
    let index = part.bodies.len() - 1;
    let widest = part.uncertainty_mm.clamp(LEAST_REACH_MM, MOST_REACH_MM);
    let reaches = reaches_mm(part, &part.bodies[index], widest);
    sew_body(part, index, &reaches);
    let mut uses = vec![0u32; part.edges.len()];
    let free = free_edges(part, &part.bodies[index], &mut uses);
    if free.len() > 1 && split_edges(part, faces, &free, reaches[2]) > 0 {
        sew_body(part, index, &reaches);
    }
    part.bodies.pop();
}

/// Makes faces share rings that lie apart, but are the same by what the file gives for one of them in the model:
/// OpenCASCADE turns whole ellipses in their planes where it writes them, and has them right in the parameters of the
/// surfaces that have any.
fn sew_told(part: &mut Part, faces: &[FaceId], told: &[(EdgeId, Arc<(Curve, Interval)>)]) {
    if told.is_empty() {
        return;
    }
    let mut uses = vec![0u32; part.edges.len()];
    let free = free_edges(part, &body(faces.to_vec()), &mut uses);
    let is_ring = |id: &EdgeId| part.edges[*id as usize].start == part.edges[*id as usize].end;
    let rings: FxHashMap<EdgeId, (DVec3, f64)> =
        free.into_iter().filter(is_ring).map(|id| (id, middle_of(&part.edges[id as usize]))).collect();
    let mut replaced: FxHashMap<EdgeId, (EdgeId, bool)> = FxHashMap::default();
    for (id, told) in told.iter().filter(|(id, _)| rings.contains_key(id)) {
        let edge = &part.edges[*id as usize];
        let elsewhere = Edge { curve: Arc::new(told.0.clone()), range: told.1, ..edge.clone() };
        let (middle, radius) = middle_of(&elsewhere);
        let is_it = |&(&other, at): &(&EdgeId, &(DVec3, f64))| {
            other != *id
                && at.0.distance(middle) <= 0.1 * radius
                && !replaced.contains_key(&other)
                && coincide(&part.edges[other as usize], &elsewhere, LEAST_REACH_MM)
        };
        if let Some((&other, _)) = rings.iter().filter(is_it).min_by_key(|(id, _)| **id) {
            let turned = turns_back(&part.edges[other as usize], &elsewhere) != turns_back(&elsewhere, edge);
            replaced.insert(other, (*id, turned));
        }
    }
    for &face in faces {
        let Face { geometry, loops, .. } = &mut part.faces[face as usize];
        for coedge in loops.iter_mut().flat_map(|bound| &mut bound.coedges) {
            if let Some(&(edge, turned)) = replaced.get(&coedge.edge)
                && let Edge { curve, range, .. } = &part.edges[edge as usize]
                && let FaceGeometry::Surface(surface) = geometry
                && lies_on(curve, *range, None, surface, LEAST_REACH_MM)
            {
                *coedge = Coedge { edge, reversed: coedge.reversed != turned, pcurve: None };
            }
        }
    }
}

/// About the middle of a ring, and how far from there it runs.
fn middle_of(ring: &Edge) -> (DVec3, f64) {
    let points = [0.0, 0.25, 0.5, 0.75].map(|share| ring.curve.point(ring.range.at(share)));
    let middle = points.iter().sum::<DVec3>() / 4.0;
    (middle, points.iter().map(|point| point.distance(middle)).fold(0.0, f64::max))
}

fn body(faces: Vec<FaceId>) -> Body {
    let faces = faces.into_iter().map(|face| ShellFace { face, reversed: false }).collect();
    let shell = Shell { entity: EntityRef::None, closed: false, void: false, faces };
    let (name, layers) = (String::new(), Vec::new());
    Body { name, entity: EntityRef::None, kind: BodyKind::Sheet, shells: vec![shell], layers }
}

/// The sets of faces that share edges, in the file's order.
fn components(part: &Part, faces: &[FaceId]) -> Vec<Vec<FaceId>> {
    let mut group: Vec<usize> = (0..faces.len()).collect();
    fn root(group: &mut [usize], mut at: usize) -> usize {
        while group[at] != at {
            group[at] = group[group[at]];
            at = group[at];
        }
        at
    }
    let mut first_with: FxHashMap<EdgeId, usize> = FxHashMap::default();
    for (k, &face) in faces.iter().enumerate() {
        for coedge in part.faces[face as usize].loops.iter().flat_map(|bound| &bound.coedges) {
            let other = *first_with.entry(coedge.edge).or_insert(k);
            let (a, b) = (root(&mut group, k), root(&mut group, other));
            group[a.max(b)] = a.min(b);
        }
    }
    let mut sets: BTreeMap<usize, Vec<FaceId>> = BTreeMap::new();
    for (k, &face) in faces.iter().enumerate() {
        sets.entry(root(&mut group, k)).or_default().push(face);
    }
    sets.into_values().collect()
}

/// What is to be said of faces that hang together and do not close.
fn open_edges(samples: &SampledEdges, open: &[EdgeId], faces: usize, entity: EntityRef) -> Diagnostic {
    let mut message = format!(
        "{} edges of the {faces} faces that hang together with {entity} have no neighbour",
        open.len()
    );
    match samples.nearest_gap_mm(open) {
        Some(gap) => {
            message += &format!("; the one that is nearest to another lies up to {gap:.3} mm off it.")
        }
        None => message.push('.'),
    }
    Diagnostic::new(Severity::Warning, "open-edges", entity, message)
}

/// Start, middle and end of open edges.
struct SampledEdges(FxHashMap<EdgeId, [DVec3; 3]>);

/// More pairs of open edges than this are not held against each other.
const MAX_COMPARED: usize = 4_000_000;

impl SampledEdges {
    fn new(part: &Part, open: &[EdgeId]) -> Self {
        let samples = |edge: &Edge| [0.0, 0.5, 1.0].map(|share| edge.curve.point(edge.range.at(share)));
        Self(open.iter().map(|&id| (id, samples(&part.edges[id as usize]))).collect())
    }

    /// How far that of the edges that comes nearest to being another one lies off it.
    fn nearest_gap_mm(&self, open: &[EdgeId]) -> Option<f64> {
        if open.len().saturating_mul(self.0.len()) > MAX_COMPARED {
            return None;
        }
        let apart = |a: &[DVec3; 3], b: &[DVec3; 3]| {
            let along = a[0].distance(b[0]).max(a[2].distance(b[2]));
            let against = a[0].distance(b[2]).max(a[2].distance(b[0]));
            along.min(against).max(a[1].distance(b[1]))
        };
        let gaps = open.iter().filter_map(|id| Some((id, self.0.get(id)?))).flat_map(|(id, a)| {
            self.0.iter().filter(move |(other, _)| *other != id).map(move |(_, b)| apart(a, b))
        });
        gaps.min_by(f64::total_cmp).filter(|gap| gap.is_finite())
    }
}
