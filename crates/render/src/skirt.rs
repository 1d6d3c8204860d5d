//! What closes the gap between a face's boundary and its edges, where the file leaves one.
//!
//! A face ends where its edges have their feet on the surface; another face that shares an edge ends at other feet. A skirt
//! goes from there to the edge's curve, which both have in common.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use trimloop_brep::Part;
use trimloop_geom::Curve;
use trimloop_trim::curves::{Cubic, EdgePiece, TrimCurve, between, point};

use crate::border::Segment;
use crate::surface_face::SurfaceFace;

/// A cubic of the boundary that is away from its edge.
#[derive(Clone, Debug)]
pub(crate) struct Skirt {
    cubic: Cubic,
    curve: Arc<Curve>,
    piece: EdgePiece,
}

/// Where skirts are sampled to find them.
const SHARES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Gaps are rounding below this share of the face's size, and edges of something else above that one.
const LEAST: f64 = 1e-9;
const MOST: f64 = 0.02;
/// Skirts are halved this often at most.
const DEEPEST: u32 = 12;

/// Triangles of skirts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ribbon {
    /// Points with their parameters: on the surface, then on the edge, pair by pair.
    pub places: Vec<(DVec3, DVec2)>,
    /// Three places per triangle.
    pub triangles: Vec<u32>,
    /// The sides that follow edges.
    pub edges: Vec<Segment>,
}

/// The skirts of a face along the edges that it shares with others, and how wide the widest is, millimetres.
pub(crate) fn skirts_of(
    part: &Part,
    shape: &trimloop_gpu::Shape,
    chains: &[Vec<TrimCurve>],
    is_shared: impl Fn(u32) -> bool,
) -> (Vec<Skirt>, f64) {
    let [least, most] = [LEAST, MOST].map(|share| share * shape.size());
    let mut widest: f64 = 0.0;
    let mut out = Vec::new();
    for TrimCurve { cubic, edge } in chains.iter().flatten() {
        let Some(piece) = edge.filter(|piece| is_shared(piece.edge)) else { continue };
        let Some(edge) = part.edges.get(piece.edge as usize) else { continue };
        let skirt = Skirt { cubic: *cubic, curve: edge.curve.clone(), piece };
        let gap = |share: f64| {
            let on_surface = shape.derivatives(point(cubic, share)).point;
            on_surface.distance(skirt.on_edge(share))
        };
        let gap_mm =
            SHARES.into_iter().map(gap).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
        if gap_mm > least && gap_mm < most {
            widest = widest.max(gap_mm);
            out.push(skirt);
        }
    }
    (out, widest)
}

impl Skirt {
    fn on_edge(&self, share: f64) -> DVec3 {
        self.curve.point(self.piece.from + (self.piece.to - self.piece.from) * share)
    }

    /// Whether it passes through a face's domain.
    pub fn is_near(&self, face: &SurfaceFace) -> bool {
        reaches(face, &self.cubic)
    }
}

fn reaches(face: &SurfaceFace, cubic: &Cubic) -> bool {
    let unit = cubic.map(|p| face.share(p));
    let least = unit.iter().fold(DVec2::INFINITY, |a, b| a.min(*b));
    let most = unit.iter().fold(DVec2::NEG_INFINITY, |a, b| a.max(*b));
    least.cmple(DVec2::splat(1.0 + 1e-9)).all() && most.cmpge(DVec2::splat(-1e-9)).all()
}

/// The skirts of a face, or of the part of one, with chords within `off_mm`.
pub(crate) fn ribbon_of(face: &SurfaceFace, off_mm: f64) -> Ribbon {
    let mut out = Ribbon::default();
    for skirt in face.skirts.iter() {
        let weave = Weave { face, skirt, off_mm };
        let ends = [0.0, 1.0].map(|share| weave.rung(share));
        weave.divide([0.0, 1.0], ends, DEEPEST, &mut out);
    }
    out
}

/// A point on the surface with its parameters, and the edge's point there.
type Rung = (DVec2, DVec3, DVec3);

struct Weave<'a> {
    face: &'a SurfaceFace,
    skirt: &'a Skirt,
    off_mm: f64,
}

impl Weave<'_> {
    fn rung(&self, share: f64) -> Rung {
        let uv = point(&self.skirt.cubic, share);
        (uv, self.face.shape.derivatives(uv).point, self.skirt.on_edge(share))
    }

    fn divide(&self, [from, to]: [f64; 2], [a, b]: [Rung; 2], depth: u32, out: &mut Ribbon) {
        if !reaches(self.face, &between(&self.skirt.cubic, from, to)) {
            return;
        }
        let middle = self.rung(0.5 * (from + to));
        let is_near = |p: DVec3, a: DVec3, b: DVec3| p.distance(0.5 * (a + b)) <= self.off_mm;
        let fits = is_near(middle.1, a.1, b.1) && is_near(middle.2, a.2, b.2);
        if !fits && depth > 0 {
            self.divide([from, 0.5 * (from + to)], [a, middle], depth - 1, out);
            self.divide([0.5 * (from + to), to], [middle, b], depth - 1, out);
            return;
        }
        let all = [(a.1, a.0), (a.2, a.0), (b.1, b.0), (b.2, b.0)];
        if !all.iter().all(|(p, _)| p.is_finite()) {
            return;
        }
        let first = out.places.len() as u32;
        out.places.extend(all);
        out.triangles.extend([0, 1, 2, 2, 1, 3].map(|k| first + k));
        out.edges.push(Segment { a: a.2, b: b.2, uv: [a.0, b.0] });
    }
}
