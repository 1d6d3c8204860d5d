//! A face's boundary as cubic curves in the parameter plane, as exact as asked for.

use glam::DVec2;
use trimloop_brep::{FaceGeometry, FaceId, Part};
use trimloop_geom::{Curve, Surface};

pub use crate::classify::EdgePiece;
use crate::classify::pieces_by_points;
use crate::{EdgeSamples, TrimDomain};

/// A cubic Bézier curve in the parameter plane.
pub type Cubic = [DVec2; 4];

/// A cubic of a boundary, and the part of an edge whose feet it follows (none for cuts and poles).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrimCurve {
    /// The cubic.
    pub cubic: Cubic,
    /// The part of an edge: at each share of the cubic, the foot of the curve's point at that share.
    pub edge: Option<EdgePiece>,
}

/// Where an edge is away from the surface, its feet need not be met more exactly than by this share of the gap.
const WITHIN_GAP: f64 = 0.1;
/// Pieces are halved this often at most.
const DEEPEST: u32 = 8;

/// The boundary of `face` as closed chains of cubics, within `tolerance` (a share of the domain's extent along u and v)
/// of the feet of its exact edges; where an edge has no foot, or a side is no edge (cuts, poles), the polygon's side.
///
/// The polygons of `domain` fix where curves begin and end, so the chains are as closed as the polygons.
pub fn trim_curves(
    part: &Part,
    face: FaceId,
    samples: &EdgeSamples,
    domain: &TrimDomain,
    tolerance: f64,
) -> Vec<Vec<Cubic>> {
    let chains = trim_curves_of_edges(part, face, samples, domain, tolerance);
    chains.into_iter().map(|chain| chain.into_iter().map(|curve| curve.cubic).collect()).collect()
}

/// As [`trim_curves`], with the edges that the cubics follow.
pub fn trim_curves_of_edges(
    part: &Part,
    face: FaceId,
    samples: &EdgeSamples,
    domain: &TrimDomain,
    tolerance: f64,
) -> Vec<Vec<TrimCurve>> {
    let FaceGeometry::Surface(surface) = &part.faces[face as usize].geometry else { return Vec::new() };
    let pieces = pieces_by_points(part, face, samples);
    let (low, high) = domain.uv_bounds();
    let extent = (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
    let chain = |l: &crate::TrimLoop| {
        let mut out = Vec::with_capacity(l.vertices.len());
        for (k, a) in l.vertices.iter().enumerate() {
            let b = &l.vertices[(k + 1) % l.vertices.len()];
            match pieces.get(&(a.point, b.point)) {
                Some(piece) => {
                    let curve = &*part.edges[piece.edge as usize].curve;
                    let fit = Fit { surface, curve, extent, tolerance };
                    fit.between([a.uv, b.uv], *piece, 0, &mut out);
                }
                None => out.push(TrimCurve { cubic: straight(a.uv, b.uv), edge: None }),
            }
        }
        out
    };
    domain.loops.iter().map(chain).collect()
}

struct Fit<'a> {
    surface: &'a Surface,
    curve: &'a Curve,
    extent: DVec2,
    tolerance: f64,
}

impl Fit<'_> {
    fn between(&self, ends: [DVec2; 2], piece: EdgePiece, depth: u32, out: &mut Vec<TrimCurve>) {
        let [a, b] = ends;
        let at = |share: f64| piece.from + (piece.to - piece.from) * share;
        let foot = |share: f64| {
            let found = self.surface.project(self.curve.point(at(share)), Some(a.lerp(b, share)));
            // A foot far from the chord is another branch of the surface.
            let is_own = self.distance(found.uv, a.lerp(b, share)) <= 0.5 * self.distance(a, b);
            is_own.then_some((found.uv, found.distance))
        };
        let Some(middle) = foot(0.5) else {
            out.push(TrimCurve { cubic: straight(a, b), edge: Some(piece) });
            return;
        };
        let length = piece.to - piece.from;
        let slopes = [(a, piece.from), (b, piece.to)].map(|(uv, t)| self.slope(uv, t).map(|m| m * length));
        let cubic = match slopes {
            [Some(m0), Some(m1)] if self.is_plausible(m0, ends) && self.is_plausible(m1, ends) => {
                [a, a + m0 / 3.0, b - m1 / 3.0, b]
            }
            _ => straight(a, b),
        };
        let is_near = |(uv, gap_mm): (DVec2, f64), share: f64| {
            let on_cubic = point(&cubic, share);
            self.distance(on_cubic, uv) <= self.tolerance
                || self.length_mm(uv, on_cubic - uv) <= WITHIN_GAP * gap_mm
        };
        let fits = is_near(middle, 0.5)
            && [0.25, 0.75].into_iter().all(|share| foot(share).is_none_or(|own| is_near(own, share)));
        if fits || depth == DEEPEST {
            out.push(TrimCurve { cubic, edge: Some(piece) });
            return;
        }
        let middle = middle.0;
        self.between([a, middle], EdgePiece { to: at(0.5), ..piece }, depth + 1, out);
        self.between([middle, b], EdgePiece { from: at(0.5), ..piece }, depth + 1, out);
    }

    fn distance(&self, a: DVec2, b: DVec2) -> f64 {
        ((a - b) / self.extent).length()
    }

    /// How far a step in the parameter plane leads.
    fn length_mm(&self, uv: DVec2, step: DVec2) -> f64 {
        let d = self.surface.first_derivatives(uv);
        (d.du * step.x + d.dv * step.y).length()
    }

    fn is_plausible(&self, slope: DVec2, [a, b]: [DVec2; 2]) -> bool {
        (slope / self.extent).length() <= 8.0 * self.distance(a, b)
    }

    /// How the foot moves with the curve's parameter: its tangent in the basis of the first derivatives.
    fn slope(&self, uv: DVec2, t: f64) -> Option<DVec2> {
        let d = self.surface.first_derivatives(uv);
        let [_, tangent, _] = self.curve.derivatives(t);
        let (e, f, g) = (d.du.length_squared(), d.du.dot(d.dv), d.dv.length_squared());
        let inverse = e * g - f * f;
        let (a, b) = (tangent.dot(d.du), tangent.dot(d.dv));
        let slope = DVec2::new(a * g - b * f, b * e - a * f) / inverse;
        (inverse > 1e-12 * e * g && slope.is_finite()).then_some(slope)
    }
}

fn straight(a: DVec2, b: DVec2) -> Cubic {
    [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b]
}

/// The point at share `t` of a cubic.
pub fn point([a, b, c, d]: &Cubic, t: f64) -> DVec2 {
    let s = 1.0 - t;
    *a * (s * s * s) + *b * (3.0 * s * s * t) + *c * (3.0 * s * t * t) + *d * (t * t * t)
}

/// The pieces of a cubic between its extremes along u and v: each runs one way along both.
pub fn monotone(cubic: &Cubic) -> Vec<Cubic> {
    let [a, b, c, d] = *cubic;
    let (p, q, r) = (b - a, c - b, d - c);
    let mut cuts = vec![0.0];
    for k in 0..2 {
        cuts.extend(roots(p[k] - 2.0 * q[k] + r[k], 2.0 * (q[k] - p[k]), p[k]));
    }
    cuts.push(1.0);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    if let [.., last] = cuts.as_mut_slice() {
        *last = 1.0;
    }
    let mut out: Vec<Cubic> = cuts.windows(2).map(|pair| between(cubic, pair[0], pair[1])).collect();
    // The joints are the same numbers on both sides, and inner control points stay inside the ends' box.
    let count = out.len();
    for k in 0..count {
        if k + 1 < count {
            out[k][3] = out[k + 1][0];
        }
        let [a, _, _, d] = out[k];
        let (low, high) = (a.min(d), a.max(d));
        out[k][1] = out[k][1].clamp(low, high);
        out[k][2] = out[k][2].clamp(low, high);
    }
    out
}

/// The roots of a t² + b t + c strictly between 0 and 1.
fn roots(a: f64, b: f64, c: f64) -> impl Iterator<Item = f64> {
    let discriminant = b * b - 4.0 * a * c;
    let q = -0.5 * (b + discriminant.max(0.0).sqrt().copysign(b));
    let found = if discriminant < 0.0 { [f64::NAN; 2] } else { [q / a, c / q] };
    found.into_iter().filter(|t| *t > 1e-9 && *t < 1.0 - 1e-9)
}

/// The part of a cubic from share `from` to share `to`.
pub fn between(cubic: &Cubic, from: f64, to: f64) -> Cubic {
    if from == 0.0 && to == 1.0 {
        return *cubic;
    }
    // The blossom at the ends (Ramshaw).
    let [a, b, c, d] = *cubic;
    let blossom = |x: f64, y: f64, z: f64| {
        let (p, q, r) = (a.lerp(b, x), b.lerp(c, x), c.lerp(d, x));
        p.lerp(q, y).lerp(q.lerp(r, y), z)
    };
    [
        if from == 0.0 { a } else { blossom(from, from, from) },
        blossom(from, from, to),
        blossom(from, to, to),
        if to == 1.0 { d } else { blossom(to, to, to) },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_run_one_way_and_lie_on_the_curve() {
        let cubic = [DVec2::new(0.0, 0.0), DVec2::new(2.0, 3.0), DVec2::new(-1.0, 2.0), DVec2::new(1.0, 1.0)];
        let pieces = monotone(&cubic);
        assert!(pieces.len() > 2);
        assert_eq!((pieces[0][0], pieces[pieces.len() - 1][3]), (cubic[0], cubic[3]));
        for piece in &pieces {
            let steps: Vec<DVec2> = (0..=50).map(|k| point(piece, f64::from(k) / 50.0)).collect();
            for d in 0..2 {
                let way = (piece[3][d] - piece[0][d]).signum();
                assert!(steps.windows(2).all(|s| (s[1][d] - s[0][d]) * way >= -1e-12));
            }
        }
        let near = |p: DVec2| {
            (0..=2000).map(|k| point(&cubic, f64::from(k) / 2000.0).distance(p)).fold(1.0, f64::min)
        };
        assert!(pieces.iter().all(|piece| near(point(piece, 0.37)) < 2e-3));
    }
}
