//! A face's boundary and a part's edges as straight segments, as fine as a view needs.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use trimloop_brep::{FaceId, Part};
use trimloop_geom::{Curve, Interval};
use trimloop_trim::curves::{Cubic, point};
use trimloop_trim::{Tolerance, sample_curve};

use crate::surface_face::SurfaceFace;

/// A chord of a face's boundary or of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub a: DVec3,
    pub b: DVec3,
    /// Parameters on the face.
    pub uv: [DVec2; 2],
}

/// A piece of a curve that is drawn.
#[derive(Clone, Debug)]
pub(crate) struct EdgeCurve {
    curve: Arc<Curve>,
    range: Interval,
}

/// Cubics are halved this often at most.
const DEEPEST: u32 = 12;
const WIDEST_TURN_RAD: f64 = 0.8;

impl EdgeCurve {
    /// A straight one.
    pub fn line(a: DVec3, b: DVec3) -> Self {
        let curve = Arc::new(Curve::Line { origin: a, direction: b - a });
        Self { curve, range: Interval::new(0.0, 1.0) }
    }

    /// Points on it, whose chords are within `off_mm`.
    pub fn sample(&self, off_mm: f64) -> Vec<DVec3> {
        let tolerance = Tolerance { linear_mm: off_mm, angular_rad: WIDEST_TURN_RAD };
        let mut points = sample_curve(&self.curve, self.range, tolerance);
        points.retain(|p| p.is_finite());
        points
    }
}

/// The edges that `face` owns.
pub(crate) fn edges_of(part: &Part, face: FaceId, owners: &[Option<FaceId>]) -> Vec<EdgeCurve> {
    let mut edges: Vec<u32> =
        part.faces[face as usize].loops.iter().flat_map(|l| &l.coedges).map(|c| c.edge).collect();
    edges.retain(|&edge| owners.get(edge as usize).is_some_and(|owner| *owner == Some(face)));
    edges.sort_unstable();
    edges.dedup();
    let curve = |edge: u32| {
        let edge = &part.edges[edge as usize];
        let is_usable = edge.range.is_finite() && edge.range.length() > 0.0;
        is_usable.then(|| EdgeCurve { curve: edge.curve.clone(), range: edge.range })
    };
    edges.into_iter().filter_map(curve).collect()
}

/// The boundary of a face: chords within `off_mm`, and so short that halfway along them lies what has half the
/// parameters.
pub(crate) fn border_of(face: &SurfaceFace, off_mm: f64) -> Vec<Segment> {
    let seams = face.seams();
    segments_of(face, face.border().chain(&seams), off_mm)
}

/// Curves in the parameter plane likewise.
pub(crate) fn segments_of<'a>(
    face: &SurfaceFace,
    cubics: impl Iterator<Item = &'a Cubic>,
    off_mm: f64,
) -> Vec<Segment> {
    let mut out = Vec::new();
    let at = |uv: DVec2| face.shape.derivatives(uv).point;
    for cubic in cubics {
        let ends = [(cubic[0], at(cubic[0])), (cubic[3], at(cubic[3]))];
        divide(face, cubic, [0.0, 1.0], ends, off_mm, DEEPEST, &mut out);
    }
    out.retain(|s| s.a != s.b && s.a.is_finite() && s.b.is_finite());
    out
}

fn divide(
    face: &SurfaceFace,
    cubic: &Cubic,
    [from, to]: [f64; 2],
    [a, b]: [(DVec2, DVec3); 2],
    off_mm: f64,
    depth: u32,
    out: &mut Vec<Segment>,
) {
    let middle = 0.5 * (from + to);
    let uv = point(cubic, middle);
    let on_curve = face.shape.derivatives(uv).point;
    let is_near = |share: f64, p: DVec3| p.distance(a.1.lerp(b.1, share)) <= off_mm;
    let fits = || {
        is_near(0.5, on_curve)
            && [0.25, 0.5, 0.75]
                .into_iter()
                .all(|s| is_near(s, face.shape.derivatives(a.0.lerp(b.0, s)).point))
    };
    if depth == 0 || fits() {
        out.push(Segment { a: a.1, b: b.1, uv: [a.0, b.0] });
        return;
    }
    let c = (uv, on_curve);
    divide(face, cubic, [from, middle], [a, c], off_mm, depth - 1, out);
    divide(face, cubic, [middle, to], [c, b], off_mm, depth - 1, out);
}
