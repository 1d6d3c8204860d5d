//! What is drawn: every part once, ready for the device, and where it stands.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use trimloop_brep::{Diagnostic, EntityRef, FaceId, Model, Part, Rgba, Severity};
use trimloop_geom::{Aabb, Surface};
use trimloop_gpu::{FaceShapes, TrimTable};
use trimloop_mesh::{FaceStatus, MeshOptions, Monitor};
use trimloop_trim::Tolerance;
use trimloop_trim::curves::{Cubic, trim_curves_of_edges};

use crate::border::{EdgeCurve, edges_of};
use crate::skirt::skirts_of;
use crate::surface_face::SurfaceFace;

/// A model made ready to be drawn.
#[derive(Debug, Default)]
pub struct Scene {
    /// Its parts, as the model lists them.
    pub parts: Vec<ScenePart>,
    /// Where they stand, in the order of the tree.
    pub instances: Vec<Instance>,
    /// What cannot be drawn, or only as triangles.
    pub diagnostics: Vec<Diagnostic>,
    /// What stands out.
    pub highlights: Vec<Highlight>,
}

/// A part made ready to be drawn.
#[derive(Debug, Default)]
pub struct ScenePart {
    /// Its name.
    pub name: String,
    /// Its faces, as the part lists them.
    pub faces: Vec<SceneFace>,
    /// Its free curves, as polylines with their colours.
    pub curves: Vec<(Vec<DVec3>, Option<Rgba>)>,
    /// Points of its boundary and of its surfaces, close enough to tell what a picture must hold.
    pub outline: Vec<DVec3>,
    /// The box of those points.
    pub bounds: Aabb,
}

/// A face made ready to be drawn.
#[derive(Debug)]
pub struct SceneFace {
    /// The entity it comes from.
    pub entity: EntityRef,
    /// Its colour.
    pub color: Option<Rgba>,
    /// Whether the file hides it.
    pub is_hidden: bool,
    /// What is drawn.
    pub kind: FaceKind,
    /// The edges that are drawn with it; each edge of the part goes with one face.
    pub(crate) edges: Vec<EdgeCurve>,
    /// A sphere around it: centre and radius.
    pub sphere: (DVec3, f64),
}

/// How a face is drawn.
#[derive(Debug)]
pub enum FaceKind {
    /// Evaluated on the device and trimmed there.
    Surface(Box<SurfaceFace>),
    /// As triangles: what has no NURBS form, or came as triangles.
    Triangles(Triangles),
    /// Not at all: its exact area is nothing.
    Empty,
    /// Not at all, for this reason.
    Lost(String),
}

/// Triangles with normals, relative to an origin.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// What positions are relative to.
    pub origin: DVec3,
    /// Positions.
    pub positions: Vec<DVec3>,
    /// Unit normals.
    pub normals: Vec<DVec3>,
    /// Three indices each.
    pub triangles: Vec<[u32; 3]>,
}

/// What stands out in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Highlight {
    /// Index of the instance.
    pub instance: usize,
    /// Index of the face in its part; none for all of them.
    pub face: Option<usize>,
}

/// A use of a part.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Index of the part.
    pub part: usize,
    /// Index of the node in the model; none for what a section plane cuts open.
    pub node: Option<usize>,
    /// From the part's coordinates to the model's.
    pub transform: DAffine3,
    /// The colour of this use.
    pub color: Option<Rgba>,
    /// Whether it is shown.
    pub is_shown: bool,
    /// It closes what this plane cuts open, which does not cut it (an index of `Look::sections`).
    pub closes: Option<usize>,
}

/// The share of a part's size that its boundaries are sampled to.
const FINENESS: f64 = 1e-4;
/// Trim curves are as exact as this share of a face's domain.
const TRIM_FINENESS: f64 = 1e-7;
const ANGLE_RAD: f64 = 0.3;
/// Cells of a trim table along each direction, at most.
const TRIM_CELLS: u32 = 64;

impl Scene {
    /// Makes `model` ready; `monitor` is told of every face and may stop it.
    ///
    /// # Errors
    /// [`trimloop_mesh::Cancelled`].
    pub fn new(model: &Model, monitor: &dyn Monitor) -> Result<Self, trimloop_mesh::Cancelled> {
        let made: Result<Vec<(ScenePart, Vec<Diagnostic>)>, _> =
            model.parts.par_iter().map(|part| ScenePart::new(part, monitor)).collect();
        let (parts, diagnostics): (Vec<_>, Vec<_>) = made?.into_iter().unzip();
        let mut scene = Self {
            parts,
            instances: Vec::new(),
            diagnostics: diagnostics.into_iter().flatten().collect(),
            highlights: Vec::new(),
        };
        scene.place(model);
        Ok(scene)
    }

    /// The same without what its parts are made of, so that instances and names are there at once: [`ScenePart::new`] makes
    /// the parts, and [`crate::Renderer::set_part`] puts them in.
    pub fn of_nothing_yet(model: &Model) -> Self {
        let part = |part: &Part| ScenePart { name: name_of(part), ..ScenePart::default() };
        let mut scene = Self { parts: model.parts.iter().map(part).collect(), ..Self::default() };
        scene.place(model);
        scene
    }

    fn place(&mut self, model: &Model) {
        let mut stack: Vec<(usize, DAffine3, Option<Rgba>, bool)> =
            model.roots.iter().rev().map(|&root| (root, DAffine3::IDENTITY, None, true)).collect();
        while let Some((index, parent, color, is_shown)) = stack.pop() {
            let node = &model.nodes[index];
            let transform = parent * node.transform;
            let color = color.or(node.color);
            let is_shown = is_shown && !node.hidden;
            if let Some(part) = node.part {
                self.instances.push(Instance {
                    part,
                    node: Some(index),
                    transform,
                    color,
                    is_shown,
                    closes: None,
                });
            }
            stack.extend(node.children.iter().rev().map(|&child| (child, transform, color, is_shown)));
        }
    }

    /// Points of everything that is shown, in the model's coordinates: what a picture must hold.
    pub fn outline(&self) -> Vec<DVec3> {
        self.outline_of(|_| true)
    }

    /// The same for some of the instances, by their indices.
    pub fn outline_of(&self, is_wanted: impl Fn(usize) -> bool) -> Vec<DVec3> {
        let shown = self.instances.iter().enumerate().filter(|(k, i)| i.is_shown && is_wanted(*k));
        shown
            .map(|(_, i)| i)
            .flat_map(|i| self.parts[i.part].outline.iter().map(|p| i.transform.transform_point3(*p)))
            .collect()
    }

    /// The exact point at a pick's parameters, in the model's coordinates; `None` where the face is no surface.
    pub fn point(&self, pick: &crate::Pick) -> Option<DVec3> {
        let instance = self.instances.get(pick.instance)?;
        let FaceKind::Surface(surface) = &self.parts[instance.part].faces.get(pick.face)?.kind else {
            return None;
        };
        let point = surface.shape.derivatives(surface.parameters(pick.share)).point;
        Some(instance.transform.transform_point3(point))
    }

    /// The box of [`Scene::outline`].
    pub fn bounds(&self) -> Aabb {
        Aabb::from_points(self.outline())
    }

    /// Number of faces, each part once.
    pub fn face_count(&self) -> usize {
        self.parts.iter().map(|part| part.faces.len()).sum()
    }
}

impl ScenePart {
    /// Makes a part ready; also, what of it cannot be drawn, or only as triangles. `monitor` is told of every face and may
    /// stop it.
    ///
    /// # Errors
    /// [`trimloop_mesh::Cancelled`].
    pub fn new(
        part: &Part,
        monitor: &dyn Monitor,
    ) -> Result<(Self, Vec<Diagnostic>), trimloop_mesh::Cancelled> {
        let size = part_size(part);
        let tolerance = Tolerance { linear_mm: (size * FINENESS).max(1e-9), angular_rad: ANGLE_RAD };
        let shapes = FaceShapes::new(part, tolerance);
        let edges = EdgeUse::new(part, &shapes);
        let make = |(index, shape): (usize, _)| {
            if monitor.cancelled() {
                return Err(trimloop_mesh::Cancelled);
            }
            let face = SceneFace::new(part, index as FaceId, shape, &shapes.samples, &edges);
            monitor.face_done();
            Ok(face)
        };
        let shaped: Vec<_> = shapes.faces.into_iter().enumerate().collect();
        let faces: Result<Vec<SceneFace>, _> = shaped.into_par_iter().map(make).collect();
        let mut faces = faces?;
        let diagnostics = take_triangles(part, &mut faces, size, monitor)?;
        let curves = part
            .curves
            .iter()
            .map(|free| (trimloop_trim::sample_curve(&free.curve, free.range, tolerance), free.color));
        let curves: Vec<(Vec<DVec3>, Option<Rgba>)> =
            curves.filter(|(points, _)| points.len() > 1 && points.iter().all(|p| p.is_finite())).collect();
        let shown = faces.iter().filter(|face| !face.is_hidden);
        let mut outline: Vec<DVec3> = shown.flat_map(SceneFace::outline).collect();
        outline.extend(curves.iter().flat_map(|(points, _)| points));
        let bounds = Aabb::from_points(outline.iter().copied());
        Ok((Self { name: name_of(part), faces, curves, outline, bounds }, diagnostics))
    }
}

impl ScenePart {
    /// A part of triangles alone, each list of them with its colour.
    pub fn of_triangles(name: &str, lists: Vec<(Triangles, Rgba)>) -> Self {
        let faces: Vec<SceneFace> = lists.into_iter().map(|(own, color)| SceneFace::of(own, color)).collect();
        let outline: Vec<DVec3> = faces.iter().flat_map(SceneFace::outline).collect();
        let bounds = Aabb::from_points(outline.iter().copied());
        Self { name: name.to_owned(), faces, curves: Vec::new(), outline, bounds }
    }
}

fn name_of(part: &Part) -> String {
    if part.name.is_empty() { part.id.clone() } else { part.name.clone() }
}

impl SceneFace {
    fn new(
        part: &Part,
        index: FaceId,
        shape: Result<trimloop_gpu::FaceShape, trimloop_trim::TrimError>,
        samples: &trimloop_trim::EdgeSamples,
        edges: &EdgeUse,
    ) -> Self {
        let face = &part.faces[index as usize];
        let mut out = Self {
            entity: face.entity,
            color: face.color.or(part.color),
            is_hidden: face.hidden,
            kind: FaceKind::Lost(String::new()),
            edges: edges_of(part, index, &edges.owners),
            sphere: (DVec3::ZERO, 0.0),
        };
        let Ok(found) = shape else { return out };
        if !found.shape.is_nurbs() {
            return out;
        }
        found.shape.make_ready();
        let curves = trim_curves_of_edges(part, index, samples, &found.domain, TRIM_FINENESS);
        let skirts = skirts_of(part, &found.shape, &curves, |edge| edges.is_shared(edge));
        let chains: Vec<Vec<Cubic>> =
            curves.into_iter().map(|chain| chain.into_iter().map(|curve| curve.cubic).collect()).collect();
        let [u, v] = found.shape.domain();
        let (low, high) = (glam::DVec2::new(u.start, v.start), glam::DVec2::new(u.end, v.end));
        let Ok(table) = TrimTable::within(&chains, TRIM_CELLS, low, high) else { return out };
        let Some(surface) = SurfaceFace::new(found, chains, table) else { return out };
        out.sphere = surface.sphere();
        out.kind = FaceKind::Surface(Box::new(surface.with_skirts(skirts)));
        out
    }

    fn of(own: Triangles, color: Rgba) -> Self {
        let bounds = Aabb::from_points(own.positions.iter().map(|p| *p + own.origin));
        let sphere = (bounds.center(), 0.5 * bounds.diagonal());
        let kind = FaceKind::Triangles(own);
        Self {
            entity: EntityRef::None,
            color: Some(color),
            is_hidden: false,
            kind,
            edges: Vec::new(),
            sphere,
        }
    }

    /// The kind of its surface, as `Surface::kind` names it; `triangles` where it has none.
    pub fn surface_kind(&self) -> &'static str {
        match &self.kind {
            FaceKind::Surface(surface) => surface.surface().map_or("nurbs", Surface::kind),
            _ => "triangles",
        }
    }

    pub(crate) fn outline(&self) -> Vec<DVec3> {
        match &self.kind {
            FaceKind::Surface(surface) => surface.outline(),
            FaceKind::Triangles(own) => own.positions.iter().map(|p| *p + own.origin).collect(),
            FaceKind::Empty | FaceKind::Lost(_) => Vec::new(),
        }
    }
}

/// Who uses the edges of a part.
struct EdgeUse {
    /// For each edge the face that draws it: seams, which one face uses twice, are none's.
    owners: Vec<Option<FaceId>>,
    /// Whether several faces end at it.
    is_shared: Vec<bool>,
}

impl EdgeUse {
    fn new(part: &Part, shapes: &FaceShapes) -> Self {
        let mut users: Vec<Vec<FaceId>> = vec![Vec::new(); part.edges.len()];
        for (index, face) in part.faces.iter().enumerate().filter(|(_, face)| !face.hidden) {
            for coedge in face.loops.iter().flat_map(|l| &l.coedges) {
                if let Some(users) = users.get_mut(coedge.edge as usize) {
                    users.push(index as FaceId);
                }
            }
        }
        let owner = |users: &Vec<FaceId>| match users.as_slice() {
            [a, b] if a == b => None,
            users => {
                let is_drawn = |face: &&FaceId| shapes.faces[**face as usize].is_ok();
                users.iter().find(is_drawn).or(users.first()).copied()
            }
        };
        let owners = users.iter().map(owner).collect();
        let is_shared = users.iter().map(|users| users.iter().any(|face| *face != users[0])).collect();
        Self { owners, is_shared }
    }

    /// Whether several faces end at an edge.
    fn is_shared(&self, edge: u32) -> bool {
        self.is_shared.get(edge as usize) == Some(&true)
    }
}

/// The diagonal of the box of the part's vertices, of its facets, and of where its surfaces say that it lies.
fn part_size(part: &Part) -> f64 {
    let points = part.vertices.iter().map(|v| v.point).chain(part.facet_points.iter().copied());
    let own = Aabb::from_points(points.filter(|p| p.is_finite()));
    if own.diagonal() > 0.0 {
        return own.diagonal();
    }
    // Whole spheres and tori have no vertices.
    let surfaces = part.faces.iter().filter_map(|face| match &face.geometry {
        trimloop_brep::FaceGeometry::Surface(surface) => Some(surface.bounds(surface.domain())),
        _ => None,
    });
    let all = surfaces.fold(Aabb::EMPTY, Aabb::union).diagonal();
    if all.is_finite() && all > 0.0 { all } else { 1.0 }
}

/// The faces that are no NURBS become triangles; says which, and which are lost.
fn take_triangles(
    part: &Part,
    faces: &mut [SceneFace],
    size: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<Diagnostic>, trimloop_mesh::Cancelled> {
    let open: Vec<usize> = (0..faces.len()).filter(|&k| matches!(faces[k].kind, FaceKind::Lost(_))).collect();
    if open.is_empty() {
        return Ok(Vec::new());
    }
    let of_faces = Part {
        faces: open.iter().map(|&k| part.faces[k].clone()).collect(),
        bodies: Vec::new(),
        curves: Vec::new(),
        points: Vec::new(),
        ..part.clone()
    };
    let options = MeshOptions {
        linear_deflection: trimloop_mesh::LinearDeflection::Absolute(size * 2.0 * FINENESS),
        ..MeshOptions::default()
    };
    let quiet = Quiet(monitor);
    let mesh = trimloop_mesh::mesh_part(&of_faces, &options, &quiet)?;
    let mut diagnostics = Vec::new();
    for (&k, own) in open.iter().zip(&mesh.faces) {
        let face = &mut faces[k];
        let place = |v: &trimloop_mesh::FaceVertex| mesh.positions[v.position as usize];
        let bounds = Aabb::from_points(own.vertices.iter().map(place));
        face.kind = match &own.status {
            FaceStatus::Empty => FaceKind::Empty,
            FaceStatus::Lost(reason) => FaceKind::Lost(reason.clone()),
            FaceStatus::Exact | FaceStatus::Approximated(_) => {
                let origin = bounds.center();
                face.sphere = (origin, 0.5 * bounds.diagonal());
                FaceKind::Triangles(Triangles {
                    origin,
                    positions: own.vertices.iter().map(|v| place(v) - origin).collect(),
                    normals: own.vertices.iter().map(|v| v.normal).collect(),
                    triangles: own.triangles.clone(),
                })
            }
        };
        let entity = face.entity;
        let told = match (&face.kind, &own.status) {
            (FaceKind::Lost(reason), _) => {
                Some((Severity::Error, "face-lost", format!("the face cannot be drawn: {reason}")))
            }
            (_, FaceStatus::Approximated(reason)) => {
                Some((Severity::Warning, "face-as-triangles", format!("drawn as triangles: {reason}")))
            }
            _ => None,
        };
        let told = told.map(|(severity, code, text)| Diagnostic::new(severity, code, entity, text));
        diagnostics.extend(told.map(|d| d.on_face(entity)));
    }
    Ok(diagnostics)
}

/// A monitor that stops but does not count.
struct Quiet<'a>(&'a dyn Monitor);

impl Monitor for Quiet<'_> {
    fn face_done(&self) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
