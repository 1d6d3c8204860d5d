//! How far triangles are from the exact surfaces, and their normals from the exact ones: measured by projecting
//! samples onto the surfaces, with none of the mesher's own bounds.
//!
//! Which of a face's two sides is the outer one is taken from its first triangle: files are wrong about it, and that
//! closed shells face outward shows in their volume.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use trimloop_brep::{FaceGeometry, Model, Part};
use trimloop_geom::{Surface, SurfacePoint};
use trimloop_mesh::{FaceMesh, FaceStatus, FaceVertex, PartMesh};

/// The worst that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Faces that were looked at.
    pub faces: usize,
    /// Samples that were taken.
    pub samples: usize,
    /// The largest distance from the exact surface, as a share of the deflection that was asked for.
    pub distance_share: f64,
    /// The largest angle between a vertex's normal and the exact one there.
    pub vertex_normal_rad: f64,
    /// The largest angle between a triangle's interpolated normals and the exact ones.
    pub shading_normal_rad: f64,
    /// The largest angle between a triangle and the exact normals over it.
    pub triangle_normal_rad: f64,
}

impl Deviation {
    /// The worst of both.
    pub fn max(self, other: Self) -> Self {
        Self {
            faces: self.faces + other.faces,
            samples: self.samples + other.samples,
            distance_share: self.distance_share.max(other.distance_share),
            vertex_normal_rad: self.vertex_normal_rad.max(other.vertex_normal_rad),
            shading_normal_rad: self.shading_normal_rad.max(other.shading_normal_rad),
            triangle_normal_rad: self.triangle_normal_rad.max(other.triangle_normal_rad),
        }
    }
}

/// The deviation of every face that claims to be exact, by the kind of its surface.
///
/// `density` is the number of steps along a triangle's sides: 1 looks at the corners, 4 at 15 points.
pub fn by_surface(model: &Model, meshes: &[PartMesh], density: usize) -> BTreeMap<&'static str, Deviation> {
    let mut table = BTreeMap::<_, Deviation>::new();
    for (part, mesh) in model.parts.iter().zip(meshes) {
        for (kind, deviation) in of_part(part, mesh, density) {
            let worst = table.entry(kind).or_default();
            *worst = worst.max(deviation);
        }
    }
    table
}

fn of_part(part: &Part, mesh: &PartMesh, density: usize) -> Vec<(&'static str, Deviation)> {
    let faces: Vec<_> = part.faces.iter().zip(&mesh.faces).collect();
    faces
        .into_par_iter()
        .filter(|(_, face_mesh)| face_mesh.status == FaceStatus::Exact)
        .filter_map(|(face, face_mesh)| {
            let FaceGeometry::Surface(surface) = &face.geometry else { return None };
            Some((surface.kind(), of_face(surface, face_mesh, mesh, density)))
        })
        .collect()
}

fn of_face(surface: &Surface, face_mesh: &FaceMesh, mesh: &PartMesh, density: usize) -> Deviation {
    let corners = |triangle: &[u32; 3]| triangle.map(|i| face_mesh.vertices[i as usize]);
    let Some(first) = face_mesh.triangles.first().map(corners) else {
        return Deviation { faces: 1, ..Deviation::default() };
    };
    let exact = Exact::new(surface, first, mesh);
    let of = |triangle| of_triangle(&exact, corners(triangle), mesh, density);
    let all = face_mesh.triangles.par_iter().map(of).reduce(Deviation::default, Deviation::max);
    Deviation { faces: 1, ..all }
}

fn of_triangle(exact: &Exact<'_>, corners: [FaceVertex; 3], mesh: &PartMesh, density: usize) -> Deviation {
    let mut worst = Deviation::default();
    let points = corners.map(|v| mesh.positions[v.position as usize]);
    let facing = facing(points);
    let centre = corners.iter().map(|v| v.uv).sum::<DVec2>() / 3.0;
    for weights in samples(density) {
        let blend = |v: [DVec3; 3]| v[0] * weights.x + v[1] * weights.y + v[2] * weights.z;
        let uv = corners[0].uv * weights.x + corners[1].uv * weights.y + corners[2].uv * weights.z;
        let foot = exact.foot(blend(points), uv);
        worst.samples += 1;
        worst.distance_share = worst.distance_share.max(foot.distance / mesh.linear_deflection_mm);
        // On a crease there are two normals: that of the triangle's own side is meant.
        let Some(normal) = exact.normal(foot.uv.lerp(centre, 1e-4)) else { continue };
        let shading = blend(corners.map(|v| v.normal)).angle_between(normal);
        let at_corner = weights.max_element() > 1.0 - 1e-9;
        let angle = if at_corner { &mut worst.vertex_normal_rad } else { &mut worst.shading_normal_rad };
        *angle = angle.max(shading);
        if let Some(facing) = facing {
            worst.triangle_normal_rad = worst.triangle_normal_rad.max(facing.angle_between(normal));
        }
    }
    worst
}

/// The unit normal of a triangle; a sliver has none to speak of.
fn facing(points: [DVec3; 3]) -> Option<DVec3> {
    let across = (points[1] - points[0]).cross(points[2] - points[0]);
    let longest = (0..3).map(|i| points[i].distance(points[(i + 1) % 3])).fold(0.0, f64::max);
    (across.length() > 1e-4 * longest * longest).then(|| across.normalize())
}

/// The exact side of a face.
struct Exact<'a> {
    surface: &'a Surface,
    side: f64,
    near_mm: f64,
}

impl<'a> Exact<'a> {
    fn new(surface: &'a Surface, first: [FaceVertex; 3], mesh: &PartMesh) -> Self {
        let agrees = |v: &FaceVertex| surface.normal(v.uv).map_or(0.0, |normal| normal.dot(v.normal));
        let side = first.iter().map(agrees).sum::<f64>().signum();
        Self { surface, side, near_mm: 0.1 * mesh.linear_deflection_mm }
    }

    /// The nearest point of the surface: `uv` itself where it is that (at a pole, which has many), then from `uv`, and
    /// from nowhere in particular where that is not near.
    fn foot(&self, point: DVec3, uv: DVec2) -> SurfacePoint {
        let claimed = self.surface.point(uv);
        if claimed.distance(point) <= 1e-3 * self.near_mm {
            return SurfacePoint { uv, point: claimed, distance: claimed.distance(point) };
        }
        let near = self.surface.project(point, Some(uv));
        if near.distance <= self.near_mm {
            return near;
        }
        let anywhere = self.surface.project(point, None);
        if anywhere.distance < near.distance { anywhere } else { near }
    }

    fn normal(&self, uv: DVec2) -> Option<DVec3> {
        Some(self.surface.normal(uv)? * self.side)
    }
}

/// Barycentric coordinates of a triangular grid.
fn samples(density: usize) -> impl Iterator<Item = DVec3> {
    let step = move |i: usize| i as f64 / density as f64;
    (0..=density).flat_map(move |i| {
        (0..=density - i).map(move |j| DVec3::new(step(i), step(j), step(density - i - j)))
    })
}
