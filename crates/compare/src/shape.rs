//! A side of a comparison: triangles, and the exact surfaces that they stand for where there are any.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;
use trimloop_brep::{BodyKind, FaceGeometry, Model, Part};
use trimloop_geom::{Derivatives, Direction, Interval, Surface};
use trimloop_mesh::{
    Cancelled, FaceMesh, FaceStatus, LinearDeflection, MeshOptions, Monitor, PartMesh, mesh_part,
};

use crate::rim::{Chords, Rim};
use crate::triangles::Triangles;

/// A side of a comparison, millimetres.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// Its triangles, every place a single point.
    pub triangles: Triangles,
    /// What they are grouped by: the faces of a CAD file, each as often as it is placed; the pieces of a mesh.
    pub patches: Vec<Patch>,
    /// For each triangle its patch.
    pub patch_of: Vec<u32>,
    /// For each triangle of a CAD file its corners' parameters; empty for meshes.
    pub uv: Vec<[DVec2; 3]>,
    /// What lies between the triangles and the exact edges.
    pub rims: Vec<Rim>,
    /// Whether this is a CAD file.
    pub exact: bool,
    /// Whether everything in it claims to be solid.
    pub solid: bool,
    /// The largest distance between triangles and the exact surface.
    pub deviation_mm: f64,
}

/// A face or a piece.
#[derive(Clone, Debug, Default)]
pub struct Patch {
    /// `#14`, `D45`, the name of a mesh's piece.
    pub name: String,
    /// The part that it belongs to.
    pub part: String,
    /// `plane`, `nurbs`, …; `facets`.
    pub kind: &'static str,
    /// Why it has no triangles, where it has none.
    pub lost: Option<String>,
    /// The exact surface.
    pub surface: Option<Placed>,
}

/// A surface where an instance puts it.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The surface, in its part's coordinates.
    pub surface: Arc<Surface>,
    /// From there to the model's.
    pub world: DAffine3,
    /// And back.
    pub local: DAffine3,
    /// Whether the surface's normal points outwards.
    pub outwards: bool,
    /// Parameters in u and in v at which derivatives may jump, over the face.
    pub breaks: [Vec<f64>; 2],
    /// Where a whole side of its parameters is a single point: which parameter is constant there (0 for u), and the
    /// point in the model's coordinates.
    pub poles: Vec<(usize, DVec3)>,
}

/// Meshes the parts of a CAD file for a comparison: five times as fine as usual, since triangles stand in for the exact
/// surface where the nearest place is sought.
///
/// # Errors
/// Where `monitor` stops it.
pub fn mesh_for_comparison(model: &Model, monitor: &dyn Monitor) -> Result<Vec<PartMesh>, Cancelled> {
    let options = MeshOptions {
        linear_deflection: LinearDeflection::Relative(2e-4),
        angular_deflection_rad: 10f64.to_radians(),
        ..MeshOptions::default()
    };
    model.parts.par_iter().map(|part| mesh_part(part, &options, monitor)).collect()
}

impl Placed {
    /// Point and first derivatives in the model's coordinates.
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        let d = self.surface.first_derivatives(uv);
        Derivatives {
            point: self.world.transform_point3(d.point),
            du: self.world.transform_vector3(d.du),
            dv: self.world.transform_vector3(d.dv),
            ..d
        }
    }

    /// The point at (u, v) in the model's coordinates.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.world.transform_point3(self.surface.point(uv))
    }

    /// The foot of a point of the model on the whole surface, sought from `hint`.
    pub fn foot(&self, point: DVec3, hint: DVec2) -> (DVec2, DVec3) {
        let foot = self.surface.project(self.local.transform_point3(point), Some(hint));
        (foot.uv, self.world.transform_point3(foot.point))
    }
}

impl Shape {
    /// A mesh, its triangles in millimetres with +Z up.
    pub fn of_mesh(triangles: Triangles) -> Self {
        let mut patches: Vec<Patch> = triangles
            .pieces
            .iter()
            .map(|piece| Patch { name: piece.name.clone(), kind: "facets", ..Patch::default() })
            .collect();
        let mut patch_of = vec![u32::MAX; triangles.triangles.len()];
        for (k, piece) in triangles.pieces.iter().enumerate() {
            patch_of[piece.triangles.clone()].fill(k as u32);
        }
        if patch_of.contains(&u32::MAX) {
            patches.push(Patch { kind: "facets", ..Patch::default() });
            let rest = patches.len() as u32 - 1;
            patch_of.iter_mut().filter(|patch| **patch == u32::MAX).for_each(|patch| *patch = rest);
        }
        Self { triangles, patches, patch_of, ..Self::default() }
    }

    /// A CAD file that has been meshed: every instance, hidden ones left out.
    pub fn of_model(model: &Model, meshes: &[PartMesh]) -> Self {
        let mut out = Self { exact: true, solid: true, ..Self::default() };
        let mut stack: Vec<_> =
            model.roots.iter().rev().map(|&root| (root, DAffine3::IDENTITY, String::new())).collect();
        let mut placed = 0;
        while let Some((index, parent, above)) = stack.pop() {
            let node = &model.nodes[index];
            if node.hidden {
                continue;
            }
            let world = parent * node.transform;
            let own = node
                .instance_name
                .clone()
                .filter(|name| !name.is_empty())
                .unwrap_or_else(|| node.name.clone());
            let path = if above.is_empty() { own } else { format!("{above}/{own}") };
            if let Some(part) = node.part {
                out.add(&model.parts[part], &meshes[part], &world, &path);
                placed += 1;
            }
            stack.extend(node.children.iter().rev().map(|&child| (child, world, path.clone())));
        }
        out.solid &= placed > 0;
        out
    }

    fn add(&mut self, part: &Part, mesh: &PartMesh, world: &DAffine3, path: &str) {
        let first_point = self.triangles.points.len() as u32;
        self.triangles.points.extend(mesh.positions.iter().map(|&p| world.transform_point3(p)));
        let mirrored = world.matrix3.determinant() < 0.0;
        let scale = world.matrix3.determinant().abs().cbrt();
        let in_solids: Vec<bool> = {
            let mut found = vec![false; part.faces.len()];
            let solids = part.bodies.iter().filter(|body| body.kind == BodyKind::Solid);
            solids
                .flat_map(|body| &body.shells)
                .flat_map(|shell| &shell.faces)
                .for_each(|used| found[used.face as usize] = true);
            found
        };
        let chords = Chords::new(part, mesh);
        for (k, (face, face_mesh)) in
            part.faces.iter().zip(&mesh.faces).enumerate().filter(|(_, (f, _))| !f.hidden)
        {
            self.solid &= in_solids[k];
            let patch = self.patches.len() as u32;
            let surface = match &face.geometry {
                FaceGeometry::Surface(surface) => Some(surface.clone()),
                _ => None,
            };
            let lost = match &face_mesh.status {
                FaceStatus::Lost(reason) => Some(reason.clone()),
                _ => None,
            };
            self.deviation_mm = self.deviation_mm.max(face_mesh.max_deviation_mm * scale);
            if let Some(surface) = &surface {
                let first = self.triangles.triangles.len() as u32;
                self.rims.extend(chords.rims(surface, face_mesh, mirrored, first));
            }
            for t in &face_mesh.triangles {
                let mut corners = t.map(|index| face_mesh.vertices[index as usize]);
                if mirrored {
                    corners.swap(1, 2);
                }
                self.triangles.triangles.push(corners.map(|c| c.position + first_point));
                self.uv.push(corners.map(|c| c.uv));
                self.patch_of.push(patch);
            }
            let poles = surface.iter().flat_map(|surface| surface.singularities());
            let poles = poles.map(|s| (s.constant as usize, world.transform_point3(s.point))).collect();
            let breaks = surface.as_ref().map_or_else(Default::default, |surface| breaks(surface, face_mesh));
            let outwards = surface.as_ref().is_none_or(|surface| faces_outwards(surface, face_mesh));
            self.patches.push(Patch {
                name: face.entity.to_string(),
                part: path.to_owned(),
                kind: surface.as_ref().map_or("facets", |surface| surface.kind()),
                lost,
                surface: surface.map(|surface| Placed {
                    surface,
                    world: *world,
                    local: world.inverse(),
                    outwards: outwards != mirrored,
                    breaks,
                    poles,
                }),
            });
        }
    }

    /// The corner of a triangle that is a pole of its surface, and which parameter is constant there: the other one may
    /// be anything, so that the triangle stands for all of the parameters between its other two corners and the pole.
    pub fn pole(&self, triangle: usize) -> Option<(usize, usize)> {
        let surface = self.patch(triangle as u32).surface.as_ref()?;
        if surface.poles.is_empty() {
            return None;
        }
        let corners = self.triangles.corners(triangle);
        let reach = 1e-9 * (1.0 + corners[0].abs().max_element());
        (0..3).find_map(|k| {
            let pole = surface.poles.iter().find(|(_, point)| point.distance(corners[k]) <= reach)?;
            Some((k, pole.0))
        })
    }

    /// The parameters of a place on a triangle, by its weights of the corners.
    pub fn uv_at(&self, triangle: usize, weights: [f64; 3]) -> DVec2 {
        let mut uv = self.uv[triangle];
        if let Some((k, constant)) = self.pole(triangle) {
            // Beside the pole the free parameter is that of the place's image on the opposite side.
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let sum = weights[a] + weights[b];
            let free = 1 - constant;
            let share = if sum > 0.0 { weights[b] / sum } else { 0.5 };
            uv[k][free] = uv[a][free] + (uv[b][free] - uv[a][free]) * share;
        }
        uv[0] * weights[0] + uv[1] * weights[1] + uv[2] * weights[2]
    }

    /// What the patch of a triangle is.
    pub fn patch(&self, triangle: u32) -> &Patch {
        &self.patches[self.patch_of[triangle as usize] as usize]
    }
}

/// Where the derivatives of a surface may jump, over a face.
fn breaks(surface: &Surface, mesh: &FaceMesh) -> [Vec<f64>; 2] {
    if !matches!(surface.kind(), "nurbs" | "extrusion" | "revolution" | "offset") {
        return Default::default();
    }
    let corners = mesh.vertices.iter().map(|vertex| vertex.uv);
    let (low, high) =
        corners.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(a, b), uv| (a.min(uv), b.max(uv)));
    [(0, Direction::U), (1, Direction::V)].map(|(k, direction)| {
        if low[k] < high[k] {
            surface.breakpoints(direction, Interval::new(low[k], high[k]))
        } else {
            Vec::new()
        }
    })
}

/// Whether a surface's own normals agree with those of a face's triangles, most of them.
fn faces_outwards(surface: &Surface, mesh: &FaceMesh) -> bool {
    let mut sum = 0.0;
    let stride = (mesh.vertices.len() / 32).max(1);
    for vertex in mesh.vertices.iter().step_by(stride) {
        sum += surface.normal(vertex.uv).map_or(0.0, |normal| normal.dot(vertex.normal).signum());
    }
    sum >= 0.0
}
