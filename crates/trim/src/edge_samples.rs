//! Every edge of a part as one polyline, shared by all its faces, with its image in each of their parameter planes.

use std::cell::Cell;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use smallvec::SmallVec;
use trimloop_brep::{Edge, FaceGeometry, FaceId, Part};
use trimloop_geom::{Curve, Direction, Interval, Singularity, Surface, SurfacePoint};

use crate::Tolerance;
use crate::chord::{doubtful_quarters, turns_by_more};
use crate::curve_line::{CurveLine, LinePoint, MAX_DEPTH};

/// The shared samples of all edges of a part.
#[derive(Clone, Debug, Default)]
pub struct EdgeSamples {
    /// Shared points; the part's vertices come first, in their order.
    pub points: Vec<DVec3>,
    /// One per edge of the part, in its order.
    pub edges: Vec<SampledEdge>,
}

/// One edge's samples, from its start vertex to its end vertex.
#[derive(Clone, Debug, Default)]
pub struct SampledEdge {
    /// Indices into [`EdgeSamples::points`].
    pub points: Vec<u32>,
    /// Curve parameter of each sample.
    pub parameters: Vec<f64>,
    /// The edge in the parameter plane of each face that uses it; each face once.
    pub sides: Vec<EdgeSide>,
}

/// An edge's samples in one face's parameter plane.
#[derive(Clone, Debug)]
pub struct EdgeSide {
    /// The face.
    pub face: FaceId,
    /// The projection of each sample, up to whole periods.
    pub uv: Vec<DVec2>,
    /// Per sample the index into [`Surface::singularities`] of the singular point that it is, if any.
    pub singular: Vec<Option<u8>>,
    /// The largest distance of a sample from the surface.
    pub off_surface_mm: f64,
}

impl SampledEdge {
    /// The side of `face`.
    pub fn side(&self, face: FaceId) -> Option<&EdgeSide> {
        self.sides.iter().find(|s| s.face == face)
    }
}

/// A face's surface with what edge sampling asks of it again and again.
struct Ground {
    face: FaceId,
    surface: Arc<Surface>,
    pcurve: Option<Arc<Curve>>,
    singularities: Arc<Vec<Singularity>>,
    periods: [Option<f64>; 2],
    curved: bool,
    free_form: bool,
}

impl Ground {
    /// Index of the singular point that `point` is.
    fn singular_point(&self, point: DVec3, snap: f64) -> Option<u8> {
        self.singularities.iter().position(|s| s.point.distance(point) <= snap).map(|index| index as u8)
    }
}

/// Samples all edges of a part within `tolerance`: of the curve itself, and of the turn of the normals of the faces on
/// both sides.
pub fn sample_edges(part: &Part, tolerance: Tolerance) -> EdgeSamples {
    let tolerance = tolerance.clamped();
    let grounds = grounds_of_edges(part);
    let snap = snap_distance(part);
    let sampled: Vec<Polyline> = part
        .edges
        .par_iter()
        .zip(&grounds)
        .map(|(edge, grounds)| {
            let ends = [edge.start, edge.end].map(|v| part.vertices[v as usize].point);
            let Edge { curve, range, same_sense, .. } = edge;
            let closed = edge.start == edge.end;
            let singular = grounds.iter().flat_map(|g| g.singularities.iter()).map(|s| s.point).collect();
            let (range, same_sense) = (*range, *same_sense);
            let line = CurveLine { curve, range, same_sense, ends, closed, singular, snap, tolerance };
            Sampler { line, grounds, asked: Cell::new(0), searches: Cell::new(0) }.run()
        })
        .collect();
    let mut out = EdgeSamples { points: part.vertices.iter().map(|v| v.point).collect(), edges: Vec::new() };
    out.edges =
        part.edges.iter().zip(sampled).map(|(edge, line)| line.share(edge, &mut out.points)).collect();
    out
}

/// A polyline of `curve` over `range` within `tolerance`.
pub fn sample_curve(curve: &Curve, range: Interval, tolerance: Tolerance) -> Vec<DVec3> {
    let ends = [curve.point(range.start), curve.point(range.end)];
    let closed = ends[0].distance(ends[1]) <= 1e-9 * ends[0].abs().max(ends[1].abs()).max_element();
    let tolerance = tolerance.clamped();
    let (same_sense, singular, snap) = (true, Vec::new(), 0.0);
    let line = CurveLine { curve, range, same_sense, ends, closed, singular, snap, tolerance };
    let points = line.points();
    line.thinned(&points).into_iter().map(|k| points[k].point).collect()
}

/// Within this distance a point counts as a surface's singular point.
fn snap_distance(part: &Part) -> f64 {
    let size = trimloop_geom::Aabb::from_points(part.vertices.iter().map(|v| v.point)).diagonal();
    (size * 1e-7).max(part.uncertainty_mm.min(size * 1e-5)).max(1e-9)
}

fn grounds_of_edges(part: &Part) -> Vec<Vec<Ground>> {
    let mut grounds: Vec<Vec<Ground>> = part.edges.iter().map(|_| Vec::new()).collect();
    for (index, face) in part.faces.iter().enumerate() {
        let FaceGeometry::Surface(surface) = &face.geometry else { continue };
        let singularities = Arc::new(surface.singularities());
        for coedge in face.loops.iter().flat_map(|l| &l.coedges) {
            let Some(list) = grounds.get_mut(coedge.edge as usize) else { continue };
            if list.iter().any(|g| g.face == index as FaceId) {
                continue;
            }
            list.push(Ground {
                face: index as FaceId,
                surface: surface.clone(),
                pcurve: coedge.pcurve.clone(),
                singularities: singularities.clone(),
                periods: surface.periods(),
                curved: !matches!(**surface, Surface::Plane { .. }),
                free_form: matches!(
                    **surface,
                    Surface::Nurbs(_)
                        | Surface::Extrusion { .. }
                        | Surface::Revolution { .. }
                        | Surface::Offset { .. }
                ),
            });
        }
    }
    grounds
}

/// An edge's samples before their points are shared.
#[derive(Default)]
struct Polyline {
    samples: Vec<Sample>,
    sides: Vec<FaceId>,
}

#[derive(Clone, Default)]
struct Sample {
    t: f64,
    point: DVec3,
    /// One per ground; nearly always two.
    sides: SmallVec<[Foot; 2]>,
}

#[derive(Clone, Copy, Default)]
struct Foot {
    uv: DVec2,
    on_surface: DVec3,
    normal: Option<DVec3>,
    singular: Option<u8>,
    distance: f64,
}

impl Polyline {
    fn share(self, edge: &Edge, points: &mut Vec<DVec3>) -> SampledEdge {
        let last = self.samples.len().saturating_sub(1);
        let ids = self.samples.iter().enumerate().map(|(i, s)| match i {
            0 => edge.start,
            i if i == last => edge.end,
            _ => {
                points.push(s.point);
                points.len() as u32 - 1
            }
        });
        SampledEdge {
            points: ids.collect(),
            parameters: self.samples.iter().map(|s| s.t).collect(),
            sides: self.sides.iter().enumerate().map(|(k, &face)| self.side(k, face)).collect(),
        }
    }

    fn side(&self, k: usize, face: FaceId) -> EdgeSide {
        EdgeSide {
            face,
            uv: self.samples.iter().map(|s| s.sides[k].uv).collect(),
            singular: self.samples.iter().map(|s| s.sides[k].singular).collect(),
            off_surface_mm: self.samples.iter().map(|s| s.sides[k].distance).fold(0.0, f64::max),
        }
    }
}

/// A line with the surfaces beside it.
struct Sampler<'a> {
    line: CurveLine<'a>,
    grounds: &'a [Ground],
    /// Samples that the surfaces asked for.
    asked: Cell<u32>,
    /// Feet that were searched for all over a surface.
    searches: Cell<u32>,
}

/// Samples of one edge that its surfaces may ask for, beside those of its curve.
const MAX_ASKED: u32 = 1 << 16;

/// Feet of one edge that are searched for all over its surfaces, where none is found nearby: an edge that is off its
/// surface all along need not be told so again and again.
const MAX_SEARCHES: u32 = 256;

/// What is known of where a sample's foot lies on a surface.
enum Hint {
    /// The foot itself, and the normal there.
    Foot(SurfacePoint, Option<DVec3>),
    /// Parameters near it.
    Near(DVec2),
    /// Nothing.
    None,
}

/// Up to this share of their own length, points are the same.
const EXACT: f64 = 1e-14;

impl Sampler<'_> {
    fn run(&self) -> Polyline {
        let line = self.line.points();
        let kept = self.line.thinned(&line);
        let mut samples: Vec<Sample> = Vec::with_capacity(kept.len() * 2);
        let mut passed = 0;
        for at in kept {
            let near = samples.last().cloned();
            let next = self.sample(&line[at], near.as_ref(), None);
            if let Some(near) = near {
                self.keep_to_surfaces(&near, &next, &line[passed + 1..at], 0, &mut samples);
            }
            samples.push(next);
            passed = at;
        }
        Polyline { samples, sides: self.grounds.iter().map(|g| g.face).collect() }
    }

    fn sample(&self, at: &LinePoint, near: Option<&Sample>, other: Option<&Sample>) -> Sample {
        let &LinePoint { t, point, .. } = at;
        let sides = self.grounds.iter().enumerate().map(|(k, g)| {
            let hint = self.hint(g, k, t, point, near, other);
            self.foot(g, point, hint)
        });
        Sample { t, point, sides: sides.collect() }
    }

    /// Where to look for the foot of a sample; the foot itself, where that is known.
    fn hint(
        &self,
        ground: &Ground,
        k: usize,
        t: f64,
        point: DVec3,
        near: Option<&Sample>,
        other: Option<&Sample>,
    ) -> Hint {
        if !matches!(*ground.surface, Surface::Plane { .. })
            && let Some(pcurve) = &ground.pcurve
        {
            let uv = pcurve.point(t).truncate();
            let (on_surface, normal) = ground.surface.point_and_normal(uv);
            let distance = on_surface.distance(point);
            if distance <= EXACT * (point.length() + on_surface.length()) {
                return Hint::Foot(SurfacePoint { uv, point: on_surface, distance }, normal);
            }
            let first = near.is_none() && other.is_none();
            if uv.is_finite() && (first || distance < self.line.tolerance.linear_mm) {
                return Hint::Near(uv);
            }
        }
        let regular = |s: &Sample| s.sides[k].singular.is_none().then_some(s.sides[k].uv);
        match (near.and_then(regular), other.and_then(regular)) {
            (Some(a), Some(b)) => Hint::Near((a + self.nearest_image(ground, b, a)) * 0.5),
            (Some(a), None) | (None, Some(a)) => Hint::Near(a),
            (None, None) => Hint::None,
        }
    }

    /// `uv` moved by whole periods to be near `to`.
    fn nearest_image(&self, ground: &Ground, uv: DVec2, to: DVec2) -> DVec2 {
        let shift =
            |period: Option<f64>, from: f64, to: f64| period.map_or(0.0, |p| ((to - from) / p).round() * p);
        uv + DVec2::new(shift(ground.periods[0], uv.x, to.x), shift(ground.periods[1], uv.y, to.y))
    }

    fn foot(&self, ground: &Ground, point: DVec3, hint: Hint) -> Foot {
        let singular = ground.singular_point(point, self.line.snap);
        let (foot, normal) = match hint {
            Hint::Foot(foot, normal) => (foot, normal),
            Hint::Near(uv) => self.project(ground, point, Some(uv)),
            Hint::None => self.project(ground, point, None),
        };
        let wanted = ground.curved && singular.is_none();
        let normal = if wanted { normal.or_else(|| ground.surface.normal(foot.uv)) } else { None };
        Foot { uv: foot.uv, on_surface: foot.point, normal, singular, distance: foot.distance }
    }

    /// The foot from `hint`, and the normal there; searched anew where that is too far away to be the right one.
    fn project(&self, ground: &Ground, point: DVec3, hint: Option<DVec2>) -> (SurfacePoint, Option<DVec3>) {
        let enough = self.line.tolerance.linear_mm * 0.1;
        let found = ground.surface.project_with_normal(point, hint, enough);
        if hint.is_none() || found.0.distance <= enough || self.searches.get() >= MAX_SEARCHES {
            return found;
        }
        self.searches.set(self.searches.get() + 1);
        let other = ground.surface.project_with_normal(point, None, 0.0);
        if other.0.distance < found.0.distance * 0.5 { other } else { found }
    }

    /// Adds the samples strictly between `a` and `b` that the surfaces beside the edge ask for, first of those that the
    /// line has `between` them, then of others.
    fn keep_to_surfaces(
        &self,
        a: &Sample,
        b: &Sample,
        between: &[LinePoint],
        depth: u32,
        out: &mut Vec<Sample>,
    ) {
        if depth >= MAX_DEPTH
            || !(a.t - b.t).abs().is_normal()
            || a.point.distance(b.point) <= self.line.tolerance.shortest_chord_mm()
        {
            return;
        }
        let is_astray = self.searches.get() >= MAX_SEARCHES && self.is_off(a) && self.is_off(b);
        if is_astray || self.asked.get() >= MAX_ASKED {
            return;
        }
        let mut sides = a.sides.iter().zip(&b.sides).zip(self.grounds);
        let is_long = depth == 0 || !between.is_empty();
        if !sides.any(|((fa, fb), g)| self.turns(g, fa, fb) || self.sinks(g, [fa, fb], is_long)) {
            return;
        }
        let (before, rest) = between.split_at(between.len() / 2);
        let (middle, after) = match rest.split_first() {
            Some((&middle, after)) => (middle, after),
            None => {
                let t = (a.t + b.t) * 0.5;
                (LinePoint { t, point: self.line.curve.point(t), sag: 0.0 }, rest)
            }
        };
        let middle = self.sample(&middle, Some(a), Some(b));
        self.asked.set(self.asked.get() + 1);
        self.keep_to_surfaces(a, &middle, before, depth + 1, out);
        out.push(middle.clone());
        self.keep_to_surfaces(&middle, b, after, depth + 1, out);
    }

    /// Whether a sample lies off one of the surfaces.
    fn is_off(&self, sample: &Sample) -> bool {
        sample.sides.iter().any(|foot| foot.distance > self.line.tolerance.linear_mm)
    }

    /// Whether a chord sinks into a free-form surface (or rises from it) between its ends, which the curve need not do
    /// where it is only near the surface. Beside a chord that `is_long`, as the curve alone has it, the surface may also
    /// turn there and back.
    fn sinks(&self, ground: &Ground, [fa, fb]: [&Foot; 2], is_long: bool) -> bool {
        if !ground.free_form || fa.singular.is_some() || fb.singular.is_some() {
            return false;
        }
        let (from, to) = (fa.uv, self.nearest_image(ground, fb.uv, fa.uv));
        let chord = fb.on_surface - fa.on_surface;
        let above = |share: f64| {
            let d = ground.surface.first_derivatives(from.lerp(to, share));
            let normal = d.du.cross(d.dv).try_normalize().unwrap_or_default();
            (normal.dot(d.point - (fa.on_surface + chord * share)), normal)
        };
        let (middle, normal) = above(0.5);
        let normals = [fa, fb].map(|foot| foot.normal.unwrap_or_default());
        let most = self.line.tolerance.angular_rad * 1.001;
        middle.abs() > self.line.tolerance.linear_mm
            || is_long && normals.iter().any(|&end| end != DVec3::ZERO && turns_by_more(end, normal, most))
            || doubtful_quarters(chord, normals, middle, self.line.tolerance.linear_mm)
                .any(|share| above(share).0.abs() > self.line.tolerance.linear_mm)
    }

    /// Whether the surface turns by more than `most` only at one of two feet, where it has a crease.
    fn turns_at_its_end(&self, ground: &Ground, a: &Foot, b: &Foot, most: f64) -> bool {
        let to = self.nearest_image(ground, b.uv, a.uv);
        let [na, nb] = [1e-4, 1.0 - 1e-4].map(|share| ground.surface.normal(a.uv.lerp(to, share)));
        matches!((na, nb), (Some(na), Some(nb)) if !turns_by_more(na, nb, most))
    }

    /// Whether the surface turns, or its parameters run, too far between two feet.
    fn turns(&self, ground: &Ground, a: &Foot, b: &Foot) -> bool {
        let most = self.line.tolerance.angular_rad * 1.001;
        if let (Some(na), Some(nb)) = (a.normal, b.normal)
            && turns_by_more(na, nb, most)
            && !(ground.free_form && self.turns_at_its_end(ground, a, b, most))
        {
            return true;
        }
        if a.singular.is_some() || b.singular.is_some() {
            return false;
        }
        let step = self.nearest_image(ground, b.uv, a.uv) - a.uv;
        let far = |direction: Direction| {
            let (period, d) = match direction {
                Direction::U => (ground.periods[0], step.x),
                Direction::V => (ground.periods[1], step.y),
            };
            period.is_some_and(|p| d.abs() > p * 0.26)
        };
        far(Direction::U) || far(Direction::V)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;
    use trimloop_brep::{Coedge, EntityRef, Face, Loop, Vertex};
    use trimloop_geom::NurbsCurve;

    const SPANS: usize = 48;

    /// A sheet that lies flat at both ends of its straight border and leans over by `lean` radians in between; the border
    /// is a spline of so many spans.
    fn leaning_sheet(lean: f64, spans: usize) -> Part {
        let knots = |spans: usize| -> Vec<f64> {
            std::iter::once(0).chain(0..=spans).chain([spans]).map(|k| k as f64).collect()
        };
        let along = |spans: usize, height: fn(f64) -> f64, slope: f64, y: f64| {
            let point = |k: usize| {
                let x = k as f64 / spans as f64;
                DVec3::new(100.0 * x, y, slope * height(x))
            };
            (0..=spans).map(point).collect::<Vec<DVec3>>()
        };
        let border = along(spans, |_| 0.0, 0.0, 0.0);
        let border = NurbsCurve::new(1, border, Vec::new(), knots(spans)).expect("a line");
        let rows: Vec<DVec3> = along(SPANS, |_| 0.0, 0.0, 0.0)
            .into_iter()
            .zip(along(SPANS, |x| (PI * x).sin(), 20.0 * lean.tan(), 20.0))
            .flat_map(|(a, b)| [a, b])
            .collect();
        let sheet = trimloop_geom::NurbsSurface::new(
            [1, 1],
            SPANS + 1,
            2,
            rows,
            Vec::new(),
            [knots(SPANS), vec![0.0, 0.0, 1.0, 1.0]],
        );
        let entity = EntityRef::None;
        let vertex = |x: f64| Vertex { entity, point: DVec3::new(x, 0.0, 0.0) };
        let edge = Edge {
            entity,
            start: 0,
            end: 1,
            curve: Arc::new(Curve::Nurbs(border)),
            range: Interval::new(0.0, spans as f64),
            same_sense: true,
        };
        let coedges = vec![Coedge { edge: 0, reversed: false, pcurve: None }];
        let face = Face {
            entity,
            name: String::new(),
            geometry: FaceGeometry::Surface(Arc::new(Surface::Nurbs(sheet.expect("a sheet")))),
            same_sense: true,
            loops: vec![Loop { entity, coedges, ..Loop::default() }],
            color: None,
            hidden: false,
        };
        Part {
            faces: vec![face],
            edges: vec![edge],
            vertices: vec![vertex(0.0), vertex(100.0)],
            ..Part::default()
        }
    }

    #[test]
    fn straight_edges_have_samples_where_their_surface_leans_over() {
        let tolerance = Tolerance { linear_mm: 0.1, angular_rad: 0.2 };
        for spans in [SPANS, 1] {
            let count = |lean| sample_edges(&leaning_sheet(lean, spans), tolerance).edges[0].points.len();
            assert_eq!(count(0.0), 2);
            // Up and down again, by no more than the angle from one sample to the next.
            assert!((8..20).contains(&count(0.8)), "{}", count(0.8));
        }
    }

    #[test]
    fn samples_lie_on_their_surface() {
        let tolerance = Tolerance { linear_mm: 0.1, angular_rad: 0.2 };
        let part = leaning_sheet(0.8, SPANS);
        let samples = sample_edges(&part, tolerance);
        let FaceGeometry::Surface(surface) = &part.faces[0].geometry else { panic!("a surface") };
        let side = samples.edges[0].side(0).expect("the sheet's side");
        assert!(side.off_surface_mm < 1e-9);
        for (&point, &uv) in samples.edges[0].points.iter().zip(&side.uv) {
            assert!(surface.point(uv).distance(samples.points[point as usize]) < 1e-9);
        }
    }
}
