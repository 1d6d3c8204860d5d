//! What was built together, as parts of their own: one for each group that has geometry.

use rustc_hash::FxHashMap;
use trimloop_brep::{Body, EdgeId, FaceId, Part, VertexId};

use super::outline::Group;
use super::shape::ShapeBuilder;

/// Per group the part that it has, if any. A body whose faces stand in several groups goes to the one around them.
pub(crate) fn parts_of_groups(builder: ShapeBuilder<'_>, groups: &[Group]) -> Vec<Option<Part>> {
    let ShapeBuilder { part, face_groups, body_groups, curve_groups, point_groups, .. } = builder;
    let around = |body: &Body| {
        let faces = body.shells.iter().flat_map(|shell| &shell.faces);
        let groups_of_faces = faces.map(|used| face_groups[used.face as usize]);
        groups_of_faces.reduce(|a, b| common_group(groups, a, b)).unwrap_or(0)
    };
    // Those that loose faces were sewn into come last and have no group of their own.
    let body_groups: Vec<usize> = part
        .bodies
        .iter()
        .enumerate()
        .map(|(k, body)| body_groups.get(k).copied().unwrap_or_else(|| around(body)))
        .collect();
    let mut face_groups = face_groups;
    for (body, &group) in part.bodies.iter().zip(&body_groups) {
        for used in body.shells.iter().flat_map(|shell| &shell.faces) {
            face_groups[used.face as usize] = group;
        }
    }
    let all = face_groups.iter().chain(&body_groups).chain(&curve_groups).chain(&point_groups);
    let mut held = vec![false; groups.len()];
    all.for_each(|&group| held[group] = true);
    let mut out: Vec<Option<Part>> = groups.iter().map(|_| None).collect();
    if held.iter().filter(|held| **held).count() == 1 {
        let only = held.iter().position(|held| *held).unwrap_or(0);
        out[only] = Some(part);
        return out;
    }
    let mut picks: Vec<Picker> = held.iter().map(|_| Picker::default()).collect();
    for (face, &group) in face_groups.iter().enumerate() {
        picks[group].face(&part, face as FaceId);
    }
    for (body, &group) in part.bodies.iter().zip(&body_groups) {
        picks[group].body(body);
    }
    for (curve, &group) in part.curves.iter().zip(&curve_groups) {
        picks[group].part.curves.push(curve.clone());
    }
    for (point, &group) in part.points.iter().zip(&point_groups) {
        picks[group].part.points.push(*point);
    }
    for (group, pick) in picks.into_iter().enumerate().filter(|(group, _)| held[*group]) {
        out[group] = Some(Part { uncertainty_mm: part.uncertainty_mm, ..pick.part });
    }
    out
}

/// The innermost group that two groups stand in.
fn common_group(groups: &[Group], mut a: usize, mut b: usize) -> usize {
    // Groups come after those that they stand in.
    while a != b {
        let later = if a > b { &mut a } else { &mut b };
        *later = groups[*later].parent.unwrap_or(0);
    }
    a
}

/// Copies a share of a part.
#[derive(Default)]
struct Picker {
    part: Part,
    faces: FxHashMap<FaceId, FaceId>,
    edges: FxHashMap<EdgeId, EdgeId>,
    vertices: FxHashMap<VertexId, VertexId>,
}

impl Picker {
    fn face(&mut self, from: &Part, id: FaceId) {
        let mut face = from.faces[id as usize].clone();
        for bound in &mut face.loops {
            for coedge in &mut bound.coedges {
                coedge.edge = self.edge(from, coedge.edge);
            }
            bound.vertex = bound.vertex.map(|vertex| self.vertex(from, vertex));
        }
        self.faces.insert(id, self.part.faces.len() as FaceId);
        self.part.faces.push(face);
    }

    fn edge(&mut self, from: &Part, id: EdgeId) -> EdgeId {
        if let Some(&known) = self.edges.get(&id) {
            return known;
        }
        let mut edge = from.edges[id as usize].clone();
        edge.start = self.vertex(from, edge.start);
        edge.end = self.vertex(from, edge.end);
        self.part.edges.push(edge);
        let new = (self.part.edges.len() - 1) as EdgeId;
        self.edges.insert(id, new);
        new
    }

    fn vertex(&mut self, from: &Part, id: VertexId) -> VertexId {
        *self.vertices.entry(id).or_insert_with(|| {
            self.part.vertices.push(from.vertices[id as usize]);
            (self.part.vertices.len() - 1) as VertexId
        })
    }

    fn body(&mut self, body: &Body) {
        let mut body = body.clone();
        for used in body.shells.iter_mut().flat_map(|shell| &mut shell.faces) {
            used.face = self.faces[&used.face];
        }
        self.part.bodies.push(body);
    }
}
