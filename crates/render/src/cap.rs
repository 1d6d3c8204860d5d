//! What a section plane cuts open: the inside of solids, as plane faces.

use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;
use trimloop_brep::{BodyKind, EntityRef, Model, Part, Rgba};
use trimloop_geom::{Aabb, Frame, Interval, Surface};
use trimloop_gpu::{FaceShape, Shape, TrimTable};
use trimloop_mesh::{Cancelled, LinearDeflection, MeshOptions, Monitor, PartMesh};
use trimloop_trim::TrimDomain;
use trimloop_trim::curves::Cubic;

use crate::border::EdgeCurve;
use crate::look::{MOST_SECTIONS, Section};
use crate::scene::{FaceKind, Instance, Scene, SceneFace, ScenePart};
use crate::surface_face::SurfaceFace;

/// Share of a part's size that the outlines of caps may be off.
const DEFLECTION: f64 = 1e-4;
/// Share of the scene's size that the plane is moved by, so that faces that lie in it are cut away.
const ASIDE: f64 = 1e-5;
const CELLS: u32 = 256;
/// What caps are tinted with, and how much.
const TINT: ([f32; 3], f32) = ([0.86, 0.36, 0.26], 0.45);

/// Cuts the solids of a model open, as often as asked: its meshes are made once.
#[derive(Debug)]
pub struct Cutter {
    /// By part; none where nobody asked for it.
    meshes: Vec<Option<PartMesh>>,
}

impl Cutter {
    /// Meshes those parts of `model` that `is_wanted` says, by their indices.
    ///
    /// # Errors
    /// Where `monitor` stops it.
    pub fn new(
        model: &Model,
        is_wanted: impl Fn(usize) -> bool + Sync,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let options = MeshOptions {
            linear_deflection: LinearDeflection::Relative(DEFLECTION),
            ..MeshOptions::default()
        };
        let meshes: Result<Vec<Option<PartMesh>>, Cancelled> = (0..model.parts.len())
            .into_par_iter()
            .map(|k| match is_wanted(k) {
                true => trimloop_mesh::mesh_part(&model.parts[k], &options, monitor).map(Some),
                false => Ok(None),
            })
            .collect();
        Ok(Self { meshes: meshes? })
    }

    /// A part with one plane face for each solid that `section` cuts open; `None` where that is none. `instances` are those
    /// that are cut.
    pub fn caps(&self, model: &Model, instances: &[&Instance], section: &Section) -> Option<ScenePart> {
        let faces: Vec<SceneFace> = instances
            .into_par_iter()
            .filter_map(|i| Some((i, model.parts.get(i.part)?, self.meshes.get(i.part)?.as_ref()?)))
            .flat_map_iter(|(i, part, mesh)| caps_of(part, mesh, i, section))
            .collect();
        if faces.is_empty() {
            return None;
        }
        let outline: Vec<DVec3> = faces.iter().flat_map(SceneFace::outline).collect();
        let bounds = Aabb::from_points(outline.iter().copied());
        Some(ScenePart { name: "section".to_owned(), faces, curves: Vec::new(), outline, bounds })
    }
}

impl Section {
    /// The plane moved by next to nothing in a scene of `size` millimetres, so that faces that lie in it are cut away.
    pub fn aside(self, size: f64) -> Self {
        Self { offset_mm: self.offset_mm - ASIDE * size, ..self }
    }
}

impl Scene {
    /// Closes the solids that `sections` cut open: adds for each a part with one plane face for each of them, and its
    /// instance. What comes back are the planes that are to cut, moved by next to nothing, so that faces in them are cut away
    /// too.
    ///
    /// # Errors
    /// Where `monitor` stops it.
    pub fn cap(
        &mut self,
        model: &Model,
        sections: &[Section],
        monitor: &dyn Monitor,
    ) -> Result<[Option<Section>; MOST_SECTIONS], Cancelled> {
        let mut out = [None; MOST_SECTIONS];
        if sections.is_empty() {
            return Ok(out);
        }
        let size = self.bounds().diagonal();
        let shown: Vec<Instance> = self.instances.iter().filter(|i| i.is_shown).cloned().collect();
        let shown: Vec<&Instance> = shown.iter().collect();
        let cutter = Cutter::new(model, |part| shown.iter().any(|i| i.part == part), monitor)?;
        for (k, (to, section)) in out.iter_mut().zip(sections).enumerate() {
            let section = section.aside(size);
            if let Some(part) = cutter.caps(model, &shown, &section) {
                self.instances.push(Instance::of_caps(self.parts.len(), k));
                self.parts.push(part);
            }
            *to = Some(section);
        }
        Ok(out)
    }
}

impl Instance {
    /// The one of the part that closes what a section plane cuts open.
    pub(crate) fn of_caps(part: usize, section: usize) -> Self {
        Self {
            part,
            node: None,
            transform: DAffine3::IDENTITY,
            color: None,
            is_shown: true,
            closes: Some(section),
        }
    }
}

/// The caps of an instance's solids.
fn caps_of(part: &Part, mesh: &PartMesh, instance: &Instance, section: &Section) -> Vec<SceneFace> {
    let solids = part.bodies.iter().filter(|body| body.kind == BodyKind::Solid);
    let cap = |body: &trimloop_brep::Body| {
        let faces = || body.shells.iter().flat_map(|shell| &shell.faces).map(|f| f.face as usize);
        let segments: Vec<[DVec3; 2]> = faces()
            .flat_map(|face| cut(mesh, face, &instance.transform, section))
            .filter(|[a, b]| a != b)
            .collect();
        let color = faces().find_map(|face| part.faces[face].color).or(part.color);
        cap_of(&segments, section, instance.color.or(color), body.entity)
    };
    solids.filter_map(cap).collect()
}

/// Where the plane meets the triangles of a face, in the model's coordinates.
fn cut(mesh: &PartMesh, face: usize, transform: &DAffine3, section: &Section) -> Vec<[DVec3; 2]> {
    let own = &mesh.faces[face];
    let off = |position: u32| {
        let point = transform.transform_point3(mesh.positions[position as usize]);
        (point, section.normal.dot(point) - section.offset_mm)
    };
    // The same numbers whichever triangle asks.
    let crossing = |a: u32, b: u32| {
        let (a, b) = (off(a.min(b)), off(a.max(b)));
        a.0.lerp(b.0, a.1 / (a.1 - b.1))
    };
    let mut out = Vec::new();
    for t in &own.triangles {
        let corners = t.map(|k| own.vertices[k as usize].position);
        let is_beyond = corners.map(|p| off(p).1 > 0.0);
        let ends: Vec<DVec3> = (0..3)
            .filter(|&k| is_beyond[k] != is_beyond[(k + 1) % 3])
            .map(|k| crossing(corners[k], corners[(k + 1) % 3]))
            .collect();
        if let [a, b] = ends[..] {
            out.push([a, b]);
        }
    }
    out
}

/// The plane face inside of `segments`, by the even-odd rule.
fn cap_of(
    segments: &[[DVec3; 2]],
    section: &Section,
    color: Option<Rgba>,
    entity: EntityRef,
) -> Option<SceneFace> {
    let bounds = Aabb::from_points(segments.iter().flatten().copied());
    let size = bounds.diagonal();
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    let x = section.normal.any_orthonormal_vector();
    let y = section.normal.cross(x);
    let origin = bounds.center();
    let frame = Frame { origin, x, y, z: section.normal };
    let flat = |p: &DVec3| DVec2::new((*p - origin).dot(x), (*p - origin).dot(y));
    let sides: Vec<[DVec2; 2]> = segments.iter().map(|s| [flat(&s[0]), flat(&s[1])]).collect();
    let chain: Vec<Cubic> =
        sides.iter().map(|[a, b]| [*a, a.lerp(*b, 1.0 / 3.0), a.lerp(*b, 2.0 / 3.0), *b]).collect();
    let corners = || sides.iter().flatten();
    let low = corners().fold(DVec2::INFINITY, |low, p| low.min(*p));
    let high = corners().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
    let surface = Surface::Plane { frame };
    let shape = Shape::surface(&surface, [Interval::new(low.x, high.x), Interval::new(low.y, high.y)])?;
    let chains = vec![chain];
    let table = TrimTable::within(&chains, CELLS, low, high).ok()?;
    let face = SurfaceFace::new(FaceShape { face: 0, shape, domain: TrimDomain::default() }, chains, table)?;
    let sphere = face.sphere();
    let tinted = color.map_or([0.73, 0.75, 0.78], |c| [c.r, c.g, c.b]);
    let [r, g, b] = std::array::from_fn(|k| tinted[k] + (TINT.0[k] - tinted[k]) * TINT.1);
    Some(SceneFace {
        entity,
        color: Some(Rgba::opaque(r, g, b)),
        is_hidden: false,
        kind: FaceKind::Surface(Box::new(face)),
        edges: segments.iter().map(|[a, b]| EdgeCurve::line(*a, *b)).collect(),
        sphere,
    })
}
