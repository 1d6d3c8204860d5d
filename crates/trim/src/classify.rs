//! Whether a point of the parameter plane belongs to a face, exactly.

use glam::{DVec2, DVec3};
use trimloop_brep::{FaceGeometry, FaceId, Part};
use trimloop_geom::{Curve, Surface};

use crate::polygon::segment_distance;
use crate::{EdgeSamples, TrimDomain};

/// Where a point of the parameter plane lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In the face.
    Inside,
    /// Not in the face.
    Outside,
}

/// Classifies points of one face's parameter plane against its exact edges.
///
/// Far from the boundary the polygons decide; within a chord's reach of it, the exact curve of the nearest edge does, by
/// the side of its tangent on which the point lies.
pub struct Classifier<'a> {
    part: &'a Part,
    surface: &'a Surface,
    domain: &'a TrimDomain,
    segments: Vec<Segment>,
}

/// A chord of the boundary, and the edge it approximates (none for cuts and poles).
struct Segment {
    a: DVec2,
    b: DVec2,
    edge: Option<EdgePiece>,
    /// How far, in parameters, the exact edge can lie from the chord.
    reach: f64,
}

/// A part of an edge, in the direction in which a loop runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePiece {
    /// Index of the edge in its part.
    pub edge: u32,
    /// The parameter of its curve where the part begins.
    pub from: f64,
    /// Where it ends; less than `from` where the loop runs against the curve.
    pub to: f64,
}

impl<'a> Classifier<'a> {
    /// A classifier for `face`, with the domain that was made from `samples`. `None` for faces without a surface.
    pub fn new(part: &'a Part, face: FaceId, samples: &EdgeSamples, domain: &'a TrimDomain) -> Option<Self> {
        let FaceGeometry::Surface(surface) = &part.faces[face as usize].geometry else { return None };
        let mut out = Self { part, surface, domain, segments: Vec::new() };
        let pieces = pieces_by_points(part, face, samples);
        for l in &domain.loops {
            let n = l.vertices.len();
            for i in 0..n {
                let (a, b) = (l.vertices[i], l.vertices[(i + 1) % n]);
                let edge = pieces.get(&(a.point, b.point)).copied();
                let reach = edge.map_or(0.0, |e| out.reach(a.uv, b.uv, e));
                out.segments.push(Segment { a: a.uv, b: b.uv, edge, reach });
            }
        }
        Some(out)
    }

    /// Where (u, v), unrolled as the domain is, lies.
    pub fn classify(&self, uv: DVec2) -> Side {
        let nearest = self
            .segments
            .iter()
            .map(|s| (segment_distance(uv, s.a, s.b), s))
            .filter(|(d, s)| s.edge.is_some() && *d <= s.reach)
            .min_by(|x, y| x.0.total_cmp(&y.0));
        let inside = match nearest.and_then(|(_, s)| self.exact_side(uv, s)) {
            Some(inside) => inside,
            None => self.domain.contains(uv),
        };
        if inside { Side::Inside } else { Side::Outside }
    }

    /// On which side of the segment's exact edge the point lies; the face is to the left.
    fn exact_side(&self, uv: DVec2, segment: &Segment) -> Option<bool> {
        let piece = segment.edge?;
        let curve = &*self.part.edges[piece.edge as usize].curve;
        let d = self.surface.first_derivatives(uv);
        let normal = d.du.cross(d.dv).try_normalize()?;
        let t = foot_between(curve, d.point, piece)?;
        let [at, tangent, _] = curve.derivatives(t);
        let along = if piece.to >= piece.from { tangent } else { -tangent };
        Some(normal.cross(along).dot(d.point - at) >= 0.0)
    }

    /// Twice the distance of the exact edge's middle from the chord's, plus a share of the chord.
    fn reach(&self, a: DVec2, b: DVec2, piece: EdgePiece) -> f64 {
        let middle = (a + b) * 0.5;
        let on_curve = self.part.edges[piece.edge as usize].curve.point((piece.from + piece.to) * 0.5);
        let foot = self.surface.project(on_curve, Some(middle)).uv;
        2.0 * segment_distance(foot, a, b) + 1e-6 * a.distance(b)
    }
}

/// The parameter between the piece's ends whose point is nearest, by halving on the sign of the derivative.
fn foot_between(curve: &Curve, point: DVec3, piece: EdgePiece) -> Option<f64> {
    let slope = |t: f64| {
        let [at, tangent, _] = curve.derivatives(t);
        (at - point).dot(tangent)
    };
    let (mut low, mut high) = (piece.from.min(piece.to), piece.from.max(piece.to));
    if slope(low) > 0.0 || slope(high) < 0.0 {
        return None;
    }
    for _ in 0..60 {
        let middle = (low + high) * 0.5;
        if slope(middle) > 0.0 { high = middle } else { low = middle }
    }
    Some((low + high) * 0.5)
}

/// The edge's piece between each pair of neighbouring samples, both ways; seams keep either.
pub(crate) fn pieces_by_points(
    part: &Part,
    face: FaceId,
    samples: &EdgeSamples,
) -> std::collections::HashMap<(u32, u32), EdgePiece> {
    let mut out = std::collections::HashMap::new();
    for coedge in part.faces[face as usize].loops.iter().flat_map(|l| &l.coedges) {
        let Some(edge) = samples.edges.get(coedge.edge as usize) else { continue };
        for (p, t) in edge.points.windows(2).zip(edge.parameters.windows(2)) {
            out.insert((p[0], p[1]), EdgePiece { edge: coedge.edge, from: t[0], to: t[1] });
            out.insert((p[1], p[0]), EdgePiece { edge: coedge.edge, from: t[1], to: t[0] });
        }
    }
    out
}
