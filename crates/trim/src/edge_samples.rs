//! Every edge of a part as one polyline, shared by all its faces, with its image in each of their parameter planes.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use smallvec::SmallVec;
use trimloop_brep::{Edge, FaceGeometry, FaceId, Part};
use trimloop_geom::{Curve, Direction, Interval, Singularity, Surface, SurfacePoint};

use crate::Tolerance;
use crate::chord::{doubtful_quarters, off_chord, sag};

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
            Sampler { curve, range: *range, same_sense: *same_sense, ends, closed, grounds, tolerance, snap }
                .run()
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
    let line =
        Sampler { curve, range, same_sense: true, ends, closed, grounds: &[], tolerance, snap: 0.0 }.run();
    line.samples.into_iter().map(|s| s.point).collect()
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

/// A point of the curve, before anything is known of the surfaces beside it.
#[derive(Clone, Copy)]
struct CurvePoint {
    t: f64,
    point: DVec3,
    /// How far the curve is from the chord that ends here.
    sag: f64,
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

struct Sampler<'a> {
    curve: &'a Curve,
    range: Interval,
    /// Whether the polyline runs from the range's start to its end.
    same_sense: bool,
    /// The polyline's ends, in its own direction: exactly the vertices.
    ends: [DVec3; 2],
    closed: bool,
    grounds: &'a [Ground],
    tolerance: Tolerance,
    snap: f64,
}

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

/// So many points of a line at most are replaced by one chord.
const LONGEST_RUN: usize = 64;

/// How often a chord may be halved.
const MAX_DEPTH: u32 = 14;

impl Sampler<'_> {
    fn run(&self) -> Polyline {
        let line = self.line();
        let kept = self.thinned(&line);
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

    /// The curve by itself: points whose chords keep the tolerance.
    fn line(&self) -> Vec<CurvePoint> {
        let starts = self.start_parameters();
        let mut line: Vec<CurvePoint> = Vec::with_capacity(starts.len() * 2);
        let last = starts.len() - 1;
        for (i, &t) in starts.iter().enumerate() {
            let point = match i {
                0 => self.ends[0],
                i if i == last => self.ends[1],
                _ => self.curve.point(t),
            };
            let mut next = CurvePoint { t, point, sag: 0.0 };
            if let Some(&near) = line.last() {
                next.sag = match self.sag_bound(&near, &next) {
                    Some(sag) => sag,
                    None => self.halve(near, next, &mut line),
                };
            }
            line.push(next);
        }
        line
    }

    /// More than the curve can be from its chord, where it is a polynomial between the chord's ends and that is enough to
    /// know that it keeps well within the tolerance.
    fn sag_bound(&self, a: &CurvePoint, b: &CurvePoint) -> Option<f64> {
        let Curve::Nurbs(nurbs) = self.curve else { return None };
        let step = (b.t - a.t).abs();
        let bend = nurbs.second_derivative_bound((a.t + b.t) * 0.5)? * step * step;
        let sag = bend / 8.0;
        // The curve's velocity is the chord's on average, and changes by no more than `bend` (both over the step).
        let slowest = a.point.distance(b.point) - bend;
        let keeps = sag <= self.tolerance.linear_mm * 0.5 && bend <= slowest * self.tolerance.angular_rad * 0.5;
        keeps.then_some(sag)
    }

    /// Adds the points strictly between `a` and `b`, the middle one at least where a curve may swing to both sides.
    fn halve(&self, a: CurvePoint, b: CurvePoint, out: &mut Vec<CurvePoint>) -> f64 {
        if self.closed || !self.is_general() {
            return self.fill(a, b, None, 0, out);
        }
        let t = (a.t + b.t) * 0.5;
        let mut middle = CurvePoint { t, point: self.curve.point(t), sag: 0.0 };
        middle.sag = self.fill(a, middle, None, 0, out);
        out.push(middle);
        self.fill(middle, b, None, 0, out)
    }

    /// Whether the curve may bend one way and the other.
    fn is_general(&self) -> bool {
        !matches!(
            self.curve,
            Curve::Line { .. } | Curve::Circle { .. } | Curve::Ellipse { .. } | Curve::Polyline(_)
        )
    }

    /// Parameters that every polyline of this edge has, from the edge's start to its end.
    fn start_parameters(&self) -> Vec<f64> {
        let range = self.range;
        let mut out = Vec::new();
        let breaks = self.curve.breakpoints(range);
        for pair in breaks.windows(2) {
            let count = self.start_count(Interval::new(pair[0], pair[1]));
            let piece = Interval::new(pair[0], pair[1]);
            out.extend((0..count).map(|i| piece.at(i as f64 / count as f64)));
        }
        out.push(range.end);
        if out.len() == 1 {
            out.insert(0, range.start);
        }
        self.add_singular_points(&mut out);
        if !self.same_sense {
            out.reverse();
        }
        out
    }

    /// Equal steps that a smooth piece starts with; more follow where they are needed.
    fn start_count(&self, piece: Interval) -> usize {
        let turns = |radius: f64| {
            (piece.length() / self.tolerance.arc_step_rad(radius) - 1e-9).ceil().max(1.0) as usize
        };
        match self.curve {
            Curve::Line { .. } | Curve::Polyline(_) => 1,
            Curve::Circle { radius, .. } => turns(*radius),
            Curve::Ellipse { major, minor, .. } => turns(major.max(*minor)).max(4),
            Curve::Nurbs(nurbs) if nurbs.degree() == 1 => 1,
            _ if self.closed => 4,
            _ => 1,
        }
    }

    /// A polyline must not jump over a pole: it is where the parameters of the surface turn over.
    fn add_singular_points(&self, parameters: &mut Vec<f64>) {
        let Self { curve, range, .. } = self;
        for singularity in self.grounds.iter().flat_map(|g| g.singularities.iter()) {
            let foot = curve.project(singularity.point, None);
            if foot.distance > self.snap {
                continue;
            }
            let t = match curve.period() {
                Some(period) => foot.t + ((range.start - foot.t) / period).ceil() * period,
                None => foot.t,
            };
            let margin = range.length() * 1e-6;
            if t > range.start + margin && t < range.end - margin {
                let at = parameters.partition_point(|&p| p < t);
                let gap = parameters.get(at).copied().unwrap_or(range.end) - parameters[at.saturating_sub(1)];
                let near = |p: Option<&f64>| p.is_some_and(|p| (p - t).abs() < gap * 1e-3);
                if near(parameters.get(at)) && at + 1 < parameters.len() {
                    parameters[at] = t;
                } else if near(parameters.get(at.wrapping_sub(1))) && at > 1 {
                    parameters[at - 1] = t;
                } else {
                    parameters.insert(at, t);
                }
            }
        }
    }

    /// What remains of a line when points are dropped that a curve of many short spans has for its knots' sake alone.
    fn thinned(&self, line: &[CurvePoint]) -> Vec<usize> {
        if line.len() < 3
            || matches!(self.curve, Curve::Line { .. } | Curve::Circle { .. } | Curve::Ellipse { .. })
        {
            return (0..line.len()).collect();
        }
        let mut kept = vec![0];
        let mut at = 0;
        let last = line.len() - 1;
        let most = (last / if self.closed { 4 } else { 1 }).min(LONGEST_RUN);
        while at < last {
            let spans = |run: usize| at + run <= last && self.spans(&line[at..=at + run]);
            at += longest(most, spans);
            kept.push(at);
        }
        kept
    }

    /// Whether one chord may stand for all of `run`, with what lies between its points.
    fn spans(&self, run: &[CurvePoint]) -> bool {
        let (Some(a), Some(b)) = (run.first(), run.last()) else { return false };
        let Some(along) = (b.point - a.point).try_normalize() else { return false };
        let inner = &run[1..run.len() - 1];
        let off = |p: &CurvePoint| (p.point - a.point).reject_from_normalized(along).length();
        let near = |pair: &[CurvePoint]| {
            let off = off(&pair[0]).max(off(&pair[1]));
            off <= self.tolerance.linear_mm * 0.5 && off + pair[1].sag <= self.tolerance.linear_mm
        };
        let straight = |pair: &[CurvePoint]| {
            !turns_by_more(pair[1].point - pair[0].point, along, self.tolerance.angular_rad * 0.45)
        };
        !inner.iter().any(|p| self.is_singular(p.point))
            && run.windows(2).all(near)
            && run.windows(2).all(straight)
    }

    /// Whether a point is a singular one of a surface.
    fn is_singular(&self, point: DVec3) -> bool {
        self.grounds.iter().any(|g| g.singular_point(point, self.snap).is_some())
    }

    fn sample(&self, at: &CurvePoint, near: Option<&Sample>, other: Option<&Sample>) -> Sample {
        let &CurvePoint { t, point, .. } = at;
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
            if uv.is_finite() && (first || distance < self.tolerance.linear_mm) {
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
        let singular = ground.singular_point(point, self.snap);
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
        let enough = self.tolerance.linear_mm * 0.1;
        let found = ground.surface.project_with_normal(point, hint, enough);
        if hint.is_none() || found.0.distance <= enough {
            return found;
        }
        let other = ground.surface.project_with_normal(point, None, 0.0);
        if other.0.distance < found.0.distance * 0.5 { other } else { found }
    }

    /// Adds the points strictly between `a` and `b`. Gives how far the curve is from the chord that ends at `b`.
    /// `middle` is the curve's point halfway, where that is known.
    fn fill(
        &self,
        a: CurvePoint,
        b: CurvePoint,
        middle: Option<DVec3>,
        depth: u32,
        out: &mut Vec<CurvePoint>,
    ) -> f64 {
        if depth >= MAX_DEPTH || !(a.t - b.t).abs().is_normal() {
            return 0.0;
        }
        let t = (a.t + b.t) * 0.5;
        let point = middle.unwrap_or_else(|| self.curve.point(t));
        let mut quarters = None;
        if let Some(sag) = self.accepted(&a, &b, point, &mut quarters) {
            return sag;
        }
        let mut middle = CurvePoint { t, point, sag: 0.0 };
        middle.sag = self.fill(a, middle, quarters.map(|q| q[0]), depth + 1, out);
        out.push(middle);
        self.fill(middle, b, quarters.map(|q| q[1]), depth + 1, out)
    }

    /// How far the curve is from its chord; `None` where that is too much, or the curve turns too far. Gives the curve's
    /// points at the `quarters` where it has asked for them.
    fn accepted(
        &self,
        a: &CurvePoint,
        b: &CurvePoint,
        middle: DVec3,
        quarters: &mut Option<[DVec3; 2]>,
    ) -> Option<f64> {
        let chord = b.point - a.point;
        let length = (middle - a.point).length() + (b.point - middle).length();
        if length <= self.tolerance.shortest_chord_mm() {
            return Some(length);
        }
        // The chords of the two halves turn by half as much as the tangents at the ends do.
        let most = 0.5 * self.tolerance.angular_rad * 1.001;
        if !matches!(self.curve, Curve::Line { .. })
            && turns_by_more(middle - a.point, b.point - middle, most)
        {
            return None;
        }
        let sag = match self.curve {
            Curve::Line { .. } => 0.0,
            _ if self.is_general() => {
                let at = |share: f64| self.curve.point(a.t + (b.t - a.t) * share);
                let [first, last] = *quarters.insert([at(0.25), at(0.75)]);
                sag(a.point, chord, [first, middle, last])
            }
            _ => off_chord(a.point, chord, middle).length(),
        };
        (sag <= self.tolerance.linear_mm).then_some(sag)
    }

    /// Adds the samples strictly between `a` and `b` that the surfaces beside the edge ask for, first of those that the
    /// line has `between` them, then of others.
    fn keep_to_surfaces(
        &self,
        a: &Sample,
        b: &Sample,
        between: &[CurvePoint],
        depth: u32,
        out: &mut Vec<Sample>,
    ) {
        if depth >= MAX_DEPTH
            || !(a.t - b.t).abs().is_normal()
            || a.point.distance(b.point) <= self.tolerance.shortest_chord_mm()
        {
            return;
        }
        let mut sides = a.sides.iter().zip(&b.sides).zip(self.grounds);
        let passes = !between.is_empty();
        if !sides.any(|((fa, fb), g)| self.turns(g, fa, fb) || self.sinks(g, [fa, fb], passes)) {
            return;
        }
        let (before, rest) = between.split_at(between.len() / 2);
        let (middle, after) = match rest.split_first() {
            Some((&middle, after)) => (middle, after),
            None => {
                let t = (a.t + b.t) * 0.5;
                (CurvePoint { t, point: self.curve.point(t), sag: 0.0 }, rest)
            }
        };
        let middle = self.sample(&middle, Some(a), Some(b));
        self.keep_to_surfaces(a, &middle, before, depth + 1, out);
        out.push(middle.clone());
        self.keep_to_surfaces(&middle, b, after, depth + 1, out);
    }

    /// Whether a chord sinks into a free-form surface (or rises from it) between its ends, which the curve need not do
    /// where it is only near the surface. A chord that `passes` points of the line may also turn there and back.
    fn sinks(&self, ground: &Ground, [fa, fb]: [&Foot; 2], passes: bool) -> bool {
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
        let most = self.tolerance.angular_rad * 1.001;
        middle.abs() > self.tolerance.linear_mm
            || passes && normals.iter().any(|&end| end != DVec3::ZERO && turns_by_more(end, normal, most))
            || doubtful_quarters(chord, normals, middle, self.tolerance.linear_mm)
                .any(|share| above(share).0.abs() > self.tolerance.linear_mm)
    }

    /// Whether the surface turns by more than `most` only at one of two feet, where it has a crease.
    fn turns_at_its_end(&self, ground: &Ground, a: &Foot, b: &Foot, most: f64) -> bool {
        let to = self.nearest_image(ground, b.uv, a.uv);
        let [na, nb] = [1e-4, 1.0 - 1e-4].map(|share| ground.surface.normal(a.uv.lerp(to, share)));
        matches!((na, nb), (Some(na), Some(nb)) if !turns_by_more(na, nb, most))
    }

    /// Whether the surface turns, or its parameters run, too far between two feet.
    fn turns(&self, ground: &Ground, a: &Foot, b: &Foot) -> bool {
        let most = self.tolerance.angular_rad * 1.001;
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

/// The largest number that `holds`, up to `most`, by doubling and halving: of larger ones than one that does not hold, none
/// does. One holds always.
fn longest(most: usize, holds: impl Fn(usize) -> bool) -> usize {
    let mut good = 1;
    while good * 2 <= most && holds(good * 2) {
        good *= 2;
    }
    let mut step = good / 2;
    if good * 2 > most {
        step = (most - good).next_power_of_two();
    }
    while step > 0 {
        if good + step <= most && holds(good + step) {
            good += step;
        }
        step /= 2;
    }
    good
}

/// Whether the angle between two vectors is more than `most`, radians.
fn turns_by_more(a: DVec3, b: DVec3, most: f64) -> bool {
    a.dot(b) < most.min(PI).cos() * (a.length_squared() * b.length_squared()).sqrt()
}
