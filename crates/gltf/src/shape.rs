//! A part's primitives: its triangles and lines by colour, ready to be written.

use std::collections::HashMap;

use glam::DAffine3;
use gltf::json::mesh::Mode;
use trimloop_brep::{BodyKind, Part, Rgba};
use trimloop_geom::Aabb;
use trimloop_mesh::{EdgeLine, PartMesh};

use crate::GltfOptions;
use crate::compression;
use crate::grid::{Grid, usable};
use crate::lines::Lines;
use crate::paint::{Paint, Role};
use crate::stream::{Stream, Usage};
use crate::weld::{Triangles, Welder};

/// A part, ready to be written.
pub(crate) struct Shape {
    /// What a node must do to bring stored coordinates to the part's.
    pub(crate) placement: Option<DAffine3>,
    /// Triangles by colour, then free curves by colour, then edges.
    pub(crate) primitives: Vec<Primitive>,
    /// Triangles written.
    pub(crate) triangles: usize,
    /// Vertices written, of triangles only.
    pub(crate) vertices: usize,
}

/// Triangles or lines of one colour.
pub(crate) struct Primitive {
    pub(crate) mode: Mode,
    pub(crate) paint: Paint,
    pub(crate) positions: Stream,
    pub(crate) normals: Option<Stream>,
    pub(crate) features: Option<Stream>,
    pub(crate) indices: Stream,
}

impl Shape {
    /// Collects what `part` shows; hidden faces are left out.
    pub(crate) fn new(part: &Part, mesh: &PartMesh, options: &GltfOptions) -> Self {
        let bounds = bounds(part, mesh);
        let grid = if options.quantize { Grid::steps(bounds) } else { Grid::floats(bounds) };
        let stored: Vec<[f32; 3]> = mesh.positions.iter().map(|&p| grid.store(p)).collect();
        let mut shape =
            Self { placement: grid.placement(), primitives: Vec::new(), triangles: 0, vertices: 0 };
        shape.add_faces(part, mesh, &grid, &stored, options);
        shape.add_curves(part, mesh, &grid);
        if options.edges {
            shape.add_edges(part, mesh, &grid, &stored);
        }
        if options.meshopt {
            shape.primitives.iter_mut().flat_map(Primitive::streams).for_each(compression::compress);
        }
        shape
    }

    fn add_faces(
        &mut self,
        part: &Part,
        mesh: &PartMesh,
        grid: &Grid,
        stored: &[[f32; 3]],
        options: &GltfOptions,
    ) {
        let mut welder = Welder::new(stored, options.face_ids);
        for (paint, faces) in faces_by_paint(part, mesh) {
            for face in faces {
                welder.add(face as u32, &mesh.faces[face]);
            }
            let mut triangles = welder.finish();
            if options.meshopt {
                compression::reorder(&mut triangles);
            }
            if !triangles.indices.is_empty() {
                self.triangles += triangles.indices.len() / 3;
                self.vertices += triangles.points.len();
                self.primitives.push(Primitive::of_triangles(&triangles, paint, grid, options));
            }
        }
    }

    fn add_curves(&mut self, part: &Part, mesh: &PartMesh, grid: &Grid) {
        let colored = mesh.curves.iter().map(|curve| paint(Role::Curves, curve.color.or(part.color)));
        for (paint, curves) in grouped(colored.enumerate()) {
            let mut lines = Lines::default();
            for curve in curves {
                lines.add(mesh.curves[curve].points.iter().map(|&p| grid.store(p)));
            }
            self.primitives.extend(Primitive::of_lines(&lines, paint, grid));
        }
    }

    fn add_edges(&mut self, part: &Part, mesh: &PartMesh, grid: &Grid, stored: &[[f32; 3]]) {
        let shown = shown_edges(part);
        let is_shown = |line: &&EdgeLine| shown.get(line.edge as usize).is_none_or(|&shown| shown);
        let mut lines = Lines::default();
        for edge in mesh.edges.iter().filter(is_shown) {
            lines.add(edge.points.iter().map(|&i| stored[i as usize]));
        }
        self.primitives.extend(Primitive::of_lines(&lines, paint(Role::Edges, None), grid));
    }
}

impl Primitive {
    fn streams(&mut self) -> impl Iterator<Item = &mut Stream> {
        let attributes = [Some(&mut self.positions), self.normals.as_mut(), self.features.as_mut()];
        attributes.into_iter().flatten().chain([&mut self.indices])
    }

    fn of_triangles(triangles: &Triangles, paint: Paint, grid: &Grid, options: &GltfOptions) -> Self {
        let indices = Stream::indices(Usage::TriangleIndices, &triangles.indices, triangles.points.len());
        Self {
            mode: Mode::Triangles,
            paint,
            positions: Stream::positions(&triangles.points, grid),
            normals: Some(Stream::normals(&triangles.normals, options.quantize)),
            features: options.face_ids.then(|| Stream::features(&triangles.faces)),
            indices,
        }
    }

    fn of_lines(lines: &Lines, paint: Paint, grid: &Grid) -> Option<Self> {
        (!lines.indices.is_empty()).then(|| Self {
            mode: Mode::Lines,
            paint,
            positions: Stream::positions(&lines.points, grid),
            normals: None,
            features: None,
            indices: Stream::indices(Usage::LineIndices, &lines.indices, lines.points.len()),
        })
    }
}

/// The box of everything that is shown, less what is not usable.
fn bounds(part: &Part, mesh: &PartMesh) -> Aabb {
    let faces = part.faces.iter().zip(&mesh.faces).filter(|(face, _)| !face.hidden);
    let corners =
        faces.flat_map(|(_, face)| face.vertices.iter().map(|v| mesh.positions[v.position as usize]));
    let curves = mesh.curves.iter().flat_map(|curve| curve.points.iter().copied());
    Aabb::from_points(corners.chain(curves).filter(|&p| usable(p)))
}

/// The visible faces that have triangles, by paint, in order of first appearance.
fn faces_by_paint(part: &Part, mesh: &PartMesh) -> Vec<(Paint, Vec<usize>)> {
    let roles = roles(part);
    let shown = part.faces.iter().zip(&mesh.faces).enumerate();
    let shown = shown.filter(|(_, (face, mesh))| !face.hidden && !mesh.triangles.is_empty());
    grouped(shown.map(|(i, (face, _))| (i, paint(roles[i], face.color.or(part.color)))))
}

/// Per face, whether its back is ever seen: only a solid's is not.
fn roles(part: &Part) -> Vec<Role> {
    let mut roles = vec![Role::Sheet; part.faces.len()];
    let solids = part.bodies.iter().filter(|body| body.kind == BodyKind::Solid);
    for used in solids.flat_map(|body| &body.shells).flat_map(|shell| &shell.faces) {
        if let Some(role) = roles.get_mut(used.face as usize) {
            *role = Role::Solid;
        }
    }
    roles
}

/// Per edge, whether it bounds a visible face.
fn shown_edges(part: &Part) -> Vec<bool> {
    let mut shown = vec![false; part.edges.len()];
    let loops = part.faces.iter().filter(|face| !face.hidden).flat_map(|face| &face.loops);
    for coedge in loops.flat_map(|bound| &bound.coedges) {
        if let Some(shown) = shown.get_mut(coedge.edge as usize) {
            *shown = true;
        }
    }
    shown
}

fn paint(role: Role, color: Option<Rgba>) -> Paint {
    Paint { role, color: color.map(Into::into) }
}

/// Indices by paint, paints in order of first appearance.
fn grouped(items: impl Iterator<Item = (usize, Paint)>) -> Vec<(Paint, Vec<usize>)> {
    let mut slots = HashMap::new();
    let mut groups: Vec<(Paint, Vec<usize>)> = Vec::new();
    for (item, paint) in items {
        let slot = *slots.entry(paint).or_insert_with(|| {
            groups.push((paint, Vec::new()));
            groups.len() - 1
        });
        groups[slot].1.push(item);
    }
    groups
}
