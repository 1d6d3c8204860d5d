//! Small models, made by hand.

use glam::{DAffine3, DVec2, DVec3};
use std::sync::Arc;

use trimloop_brep::{
    Body, BodyKind, Coedge, Edge, EntityRef, Face, FaceGeometry, Facets, Loop, Model, Node, Part, Rgba,
    Shell, ShellFace, Vertex,
};
use trimloop_geom::{Curve, Interval};
use trimloop_mesh::{EdgeLine, FaceMesh, FaceStatus, FaceVertex, PartMesh};

pub const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);
pub const BLUE: Rgba = Rgba::opaque(0.0, 0.0, 1.0);
pub const GLASS: Rgba = Rgba { r: 0.5, g: 0.5, b: 0.5, a: 0.25 };

/// The corner of a cube that bit 0 (x), 1 (y) and 2 (z) of `i` name.
fn corner(i: u32, size: f64) -> DVec3 {
    DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)) * size
}

/// The corners of a cube's faces, counter-clockwise from outside: -x +x -y +y -z +z.
const FACES: [[u32; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// A cube from `origin`, `size` wide, named `name`: six faces, of which entity `#10` comes first.
pub fn cube(name: &str, origin: DVec3, size: f64) -> (Part, PartMesh) {
    let positions: Vec<DVec3> = (0..8).map(|i| origin + corner(i, size)).collect();
    let (edges, loops) = edges_and_loops(&positions);
    let lines = edges.iter().enumerate();
    let mesh = PartMesh {
        faces: FACES.iter().map(|corners| face_mesh(&positions, corners)).collect(),
        edges: lines.map(|(i, e)| EdgeLine { edge: i as u32, points: vec![e.start, e.end] }).collect(),
        positions: positions.clone(),
        ..PartMesh::default()
    };
    let vertices = positions.iter().map(|&point| Vertex { entity: EntityRef::None, point }).collect();
    let part = Part {
        name: name.to_owned(),
        id: format!("{name}-id"),
        bodies: vec![body(BodyKind::Solid)],
        faces: loops.into_iter().enumerate().map(|(i, bound)| face(i, bound)).collect(),
        edges,
        vertices,
        ..Part::default()
    };
    (part, mesh)
}

pub fn body(kind: BodyKind) -> Body {
    let faces = (0..6).map(|face| ShellFace { face, reversed: false }).collect();
    let shell = Shell { entity: EntityRef::None, closed: kind == BodyKind::Solid, void: false, faces };
    Body { name: String::new(), entity: EntityRef::None, kind, shells: vec![shell], layers: Vec::new() }
}

fn face(i: usize, bound: Loop) -> Face {
    Face {
        entity: EntityRef::Step(10 + i as u64),
        name: String::new(),
        geometry: FaceGeometry::Facets(Facets::default()),
        same_sense: true,
        loops: vec![bound],
        color: None,
        hidden: false,
    }
}

/// The twelve edges of a cube, and the loops of its faces.
fn edges_and_loops(positions: &[DVec3]) -> (Vec<Edge>, Vec<Loop>) {
    let mut edges: Vec<Edge> = Vec::new();
    let mut loops = Vec::new();
    for corners in FACES {
        let mut bound = Loop::default();
        for i in 0..4 {
            let (from, to) = (corners[i], corners[(i + 1) % 4]);
            let known = edges.iter().position(|e| (e.start, e.end) == (to, from));
            let edge = known.unwrap_or_else(|| {
                edges.push(straight(positions, from, to));
                edges.len() - 1
            });
            bound.coedges.push(Coedge { edge: edge as u32, reversed: known.is_some(), pcurve: None });
        }
        loops.push(bound);
    }
    (edges, loops)
}

fn straight(positions: &[DVec3], start: u32, end: u32) -> Edge {
    let (from, to) = (positions[start as usize], positions[end as usize]);
    Edge {
        entity: EntityRef::None,
        start,
        end,
        curve: Arc::new(Curve::Line { origin: from, direction: to - from }),
        range: Interval { start: 0.0, end: 1.0 },
        same_sense: true,
    }
}

fn face_mesh(positions: &[DVec3], corners: &[u32; 4]) -> FaceMesh {
    let [a, b, c] = [0, 1, 2].map(|i| positions[corners[i] as usize]);
    let normal = (b - a).cross(c - a).normalize();
    FaceMesh {
        status: FaceStatus::Exact,
        vertices: corners.map(|position| FaceVertex { position, normal, uv: DVec2::ZERO }).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        area_mm2: a.distance_squared(b),
        max_deviation_mm: 0.0,
    }
}

/// A use of `part`, named after it.
pub fn node(name: &str, part: Option<usize>, transform: DAffine3, children: &[usize]) -> Node {
    Node {
        name: name.to_owned(),
        id: format!("{name}-id"),
        instance_name: None,
        entity: EntityRef::None,
        transform,
        part,
        children: children.to_vec(),
        color: None,
        hidden: false,
    }
}

/// A model of one part, placed as it is.
pub fn single((part, mesh): (Part, PartMesh)) -> (Model, Vec<PartMesh>) {
    let nodes = vec![node(&part.name, Some(0), DAffine3::IDENTITY, &[])];
    (Model { parts: vec![part], nodes, roots: vec![0], ..Model::default() }, vec![mesh])
}

/// A machine of a frame and two bolts, the second of which is its mirror image:
/// node 0 machine, 1 frame, 2 and 3 bolts.
pub fn machine() -> (Model, Vec<PartMesh>) {
    let (frame, frame_mesh) = cube("frame", DVec3::ZERO, 100.0);
    let (bolt, bolt_mesh) = cube("bolt", DVec3::ZERO, 5.0);
    let mirror = DAffine3::from_translation(DVec3::new(0.0, 50.0, 0.0))
        * DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let turned =
        DAffine3::from_rotation_translation(glam::DQuat::from_rotation_z(0.5), DVec3::new(0.0, 0.0, 100.0));
    let mut nodes = vec![
        node("machine", None, DAffine3::IDENTITY, &[1, 2, 3]),
        node("frame", Some(0), DAffine3::IDENTITY, &[]),
        node("bolt", Some(1), turned, &[]),
        node("bolt", Some(1), mirror, &[]),
    ];
    nodes[2].instance_name = Some("bolt \"left\"".to_owned());
    let model = Model { parts: vec![frame, bolt], nodes, roots: vec![0], ..Model::default() };
    (model, vec![frame_mesh, bolt_mesh])
}
