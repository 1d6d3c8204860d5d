//! What lies at a place of the picture, exactly.

use glam::{DVec2, DVec3};
use trimloop_geom::Surface;

use crate::picture::Pick;
use crate::scene::{FaceKind, Scene, Triangles};
use crate::surface_face::SurfaceFace;

/// A place on a face. Millimetres, in the model's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Index of the instance in the scene.
    pub instance: usize,
    /// Index of the face in its part.
    pub face: usize,
    /// Parameters of the surface (zero where the face is made of triangles).
    pub uv: DVec2,
    /// The exact point.
    pub point: DVec3,
    /// Unit normal, turned to the eye.
    pub normal: DVec3,
    /// The radius of a cylinder, a sphere, of a cone there, or a torus' smaller one; none where the instance is not scaled
    /// evenly.
    pub radius_mm: Option<f64>,
}

const STEPS: usize = 20;

impl Place {
    /// The place at which a ray, in the model's coordinates, meets the face near where a picture shows it.
    pub fn new(scene: &Scene, pick: &Pick, (from, way): (DVec3, DVec3)) -> Option<Self> {
        let instance = scene.instances.get(pick.instance)?;
        let face = scene.parts[instance.part].faces.get(pick.face)?;
        let back = instance.transform.inverse();
        let ray = (back.transform_point3(from), back.transform_vector3(way));
        let (uv, point, normal, radius_mm) = match &face.kind {
            FaceKind::Surface(surface) => {
                let start = surface.parameters(pick.share.clamp(DVec2::ZERO, DVec2::ONE));
                let uv = meet(surface, ray, start).unwrap_or(start);
                let radius = surface.surface().and_then(|s| radius(s, uv));
                (uv, surface.shape.derivatives(uv).point, surface.shape.normal(uv), radius)
            }
            FaceKind::Triangles(own) => {
                let (point, normal) = own.meet(ray)?;
                (DVec2::ZERO, point, normal, None)
            }
            FaceKind::Empty | FaceKind::Lost(_) => return None,
        };
        // Lengths grow with the instance, if they all do alike.
        let m = instance.transform.matrix3;
        let scales = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.length());
        let is_even = scales.iter().all(|s| (s - scales[0]).abs() <= 1e-9 * scales[0]);
        let radius_mm = radius_mm.filter(|_| is_even).map(|radius| radius * scales[0]);
        // Normals are at right angles to what lies in the surface, whatever the transform does to lengths.
        let turned = instance.transform.matrix3.inverse().transpose() * normal;
        let normal = turned.normalize_or_zero();
        let normal = if normal.dot(way) > 0.0 { -normal } else { normal };
        let point = instance.transform.transform_point3(point);
        Some(Self { instance: pick.instance, face: pick.face, uv, point, normal, radius_mm })
    }
}

/// Newton's method for the surface's point on the ray; `None` where it leaves the neighbourhood.
fn meet(face: &SurfaceFace, (from, way): (DVec3, DVec3), start: DVec2) -> Option<DVec2> {
    let way = way.normalize();
    let [a, b] = {
        let (a, b) = way.any_orthonormal_pair();
        [a, b]
    };
    let [u, v] = face.shape.domain();
    let extent = DVec2::new(u.length(), v.length());
    let mut uv = start;
    for _ in 0..STEPS {
        let d = face.shape.derivatives(uv);
        let off = d.point - from;
        let residual = DVec2::new(off.dot(a), off.dot(b));
        let (m, n) = (DVec2::new(d.du.dot(a), d.du.dot(b)), DVec2::new(d.dv.dot(a), d.dv.dot(b)));
        let determinant = m.perp_dot(n);
        if determinant.abs() <= 1e-12 * m.length() * n.length() {
            return None;
        }
        let step = DVec2::new(residual.perp_dot(n), m.perp_dot(residual)) / determinant;
        uv = DVec2::new(u.clamp(uv.x - step.x), v.clamp(uv.y - step.y));
        if ((uv - start) / extent).abs().max_element() > 0.1 {
            return None;
        }
        if (step / extent).abs().max_element() < 1e-14 {
            break;
        }
    }
    let off = face.shape.derivatives(uv).point - from;
    let distance = off.reject_from_normalized(way).length();
    (distance <= 1e-7 * (face.shape.size() + off.length())).then_some(uv)
}

fn radius(surface: &Surface, uv: DVec2) -> Option<f64> {
    match surface {
        Surface::Cylinder { radius, .. } | Surface::Sphere { radius, .. } => Some(*radius),
        Surface::Cone { radius, half_angle_rad, .. } => Some((radius + uv.y * half_angle_rad.tan()).abs()),
        Surface::Torus { minor, .. } => Some(*minor),
        _ => None,
    }
}

impl Triangles {
    /// The first point of a ray, and the normal there.
    fn meet(&self, (from, way): (DVec3, DVec3)) -> Option<(DVec3, DVec3)> {
        let from = from - self.origin;
        let hit = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| self.positions[i as usize]);
            let (ab, ac) = (b - a, c - a);
            let p = way.cross(ac);
            let determinant = ab.dot(p);
            let q = from - a;
            let (x, y) = (q.dot(p) / determinant, way.dot(q.cross(ab)) / determinant);
            let slack = 1e-6;
            let is_inside = x >= -slack && y >= -slack && x + y <= 1.0 + slack;
            let along = ac.dot(q.cross(ab)) / determinant;
            let [na, nb, nc] = t.map(|i| self.normals[i as usize]);
            (is_inside && along.is_finite()).then(|| (along, na * (1.0 - x - y) + nb * x + nc * y))
        };
        let hits = self.triangles.iter().filter_map(hit);
        let (along, normal) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((from + way * along + self.origin, normal))
    }
}
