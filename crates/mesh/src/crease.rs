//! Lines inside a surface at which its normal jumps.

use glam::DVec2;
use trimloop_geom::{Direction, Interval, Surface};

/// The isoparametric lines inside a domain at which a surface's normal jumps: knots of full multiplicity, corners of a
/// profile.
#[derive(Clone, Debug, Default)]
pub(crate) struct Creases {
    /// Parameters in u, then in v.
    lines: [Vec<f64>; 2],
    /// Parameters within this of a line are on it, per direction.
    near: [f64; 2],
    /// What is left of the domain beside creases along its border.
    low: DVec2,
    high: DVec2,
}

/// A jump of the normal by less than this is none.
const JUMP_RAD: f64 = 0.02;
/// More breaks than this are not looked at: they are a spline's spans, not corners.
const MAX_BREAKS: usize = 128;

impl Creases {
    /// Finds the creases of `surface` over `low`..`high`.
    pub fn new(surface: &Surface, low: DVec2, high: DVec2) -> Self {
        let (below, above) = (DVec2::NEG_INFINITY, DVec2::INFINITY);
        let near: [f64; 2] = ((high - low) * 1e-8).into();
        let mut out = Self { near, low: below, high: above, ..Self::default() };
        for (k, direction) in [Direction::U, Direction::V].into_iter().enumerate() {
            let (inner, border) = candidates(surface, direction, low, high);
            let jumps = |at: &f64| jumps(surface, k, *at, low, high);
            out.lines[k] = inner.into_iter().filter(jumps).collect();
            for at in border.into_iter().filter(jumps) {
                if at - low[k] < high[k] - at {
                    out.low[k] = at.max(low[k]) + near[k];
                } else {
                    out.high[k] = at.min(high[k]) - near[k];
                }
            }
        }
        out
    }

    /// A point beside a crease that runs along the domain's border (to rounding, on either side of it), on the side of
    /// the domain; any other point as it is.
    pub fn within(&self, uv: DVec2) -> DVec2 {
        uv.max(self.low).min(self.high)
    }

    /// Whether a point lies on a crease.
    pub fn hold(&self, uv: DVec2) -> bool {
        let p: [f64; 2] = uv.into();
        (0..2).any(|k| self.lines[k].iter().any(|&at| (p[k] - at).abs() <= self.near[k]))
    }

    /// A point next to one on a crease, on the side of `towards`; `None` where it lies on none.
    pub fn beside(&self, uv: DVec2, towards: DVec2) -> Option<DVec2> {
        let (mut p, q): ([f64; 2], [f64; 2]) = (uv.into(), towards.into());
        let mut creased = false;
        for k in 0..2 {
            if let Some(&at) = self.lines[k].iter().find(|&&at| (p[k] - at).abs() <= self.near[k]) {
                p[k] = at + 4.0 * self.near[k] * (q[k] - at).signum();
                creased = true;
            }
        }
        creased.then(|| p.into())
    }

    /// Where the segment from `a` to `b` first crosses a crease, as a share of its length, and the point there.
    pub fn crossing(&self, a: DVec2, b: DVec2) -> Option<(f64, DVec2)> {
        let (p, q): ([f64; 2], [f64; 2]) = (a.into(), b.into());
        let share = |k: usize, at: f64| {
            let inside = p[k].min(q[k]) + self.near[k] < at && at < p[k].max(q[k]) - self.near[k];
            inside.then(|| {
                let share = (at - p[k]) / (q[k] - p[k]);
                let mut point = a.lerp(b, share).to_array();
                point[k] = at;
                (share, point.into())
            })
        };
        (0..2).find_map(|k| self.lines[k].iter().find_map(|&at| share(k, at)))
    }
}

/// Where creases may run: inside the domain, and along its border.
fn candidates(surface: &Surface, direction: Direction, low: DVec2, high: DVec2) -> (Vec<f64>, Vec<f64>) {
    let k = usize::from(direction == Direction::V);
    let range = Interval::new(low.to_array()[k], high.to_array()[k]);
    let breaks = match surface {
        Surface::Nurbs(nurbs) => {
            let knots = full_knots(nurbs.knots()[k], nurbs.degrees()[k]);
            let turns = match nurbs.periods()[k] {
                Some(period) => vec![-period, 0.0, period],
                None => vec![0.0],
            };
            turns.iter().flat_map(|turn| knots.iter().map(move |knot| knot + turn)).collect()
        }
        Surface::Extrusion { .. } | Surface::Revolution { .. } | Surface::Offset { .. } => {
            surface.breakpoints(direction, range)
        }
        _ => Vec::new(),
    };
    let margin = range.length() * 1e-9;
    // Beyond the end of an open surface there is nothing that the normal could jump to.
    let (whole, is_open) = (surface.domain()[k], surface.periods()[k].is_none());
    let is_end = |at: f64| is_open && (at <= whole.start || at >= whole.end);
    let near =
        breaks.into_iter().filter(|&at| at > range.start - margin && at < range.end + margin && !is_end(at));
    let (inner, border): (Vec<f64>, Vec<f64>) =
        near.partition(|&at| at > range.start + margin && at < range.end - margin);
    (if inner.len() > MAX_BREAKS { Vec::new() } else { inner }, border)
}

/// Distinct knots whose multiplicity is at least the degree.
fn full_knots(knots: &[f64], degree: usize) -> Vec<f64> {
    let same = |a: &f64, b: &f64| (a - b).abs() <= 1e-12 * a.abs().max(b.abs()).max(1e-12);
    knots.chunk_by(same).filter(|run| run.len() >= degree).map(|run| run[0]).collect()
}

/// Whether the normal jumps across the line somewhere.
fn jumps(surface: &Surface, k: usize, at: f64, low: DVec2, high: DVec2) -> bool {
    let extent = (high - low).to_array()[k];
    [0.1, 0.3, 0.5, 0.7, 0.9].into_iter().any(|share| {
        let side = |sign: f64| {
            let mut p = low.lerp(high, share).to_array();
            p[k] = at + sign * extent * 1e-6;
            surface.normal(p.into())
        };
        matches!((side(-1.0), side(1.0)), (Some(a), Some(b)) if a.angle_between(b) > JUMP_RAD)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use trimloop_geom::{Curve, DVec3, NurbsCurve};

    #[test]
    fn a_bent_profile_creases_its_extrusion_at_the_corner() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
        let profile =
            NurbsCurve::new(1, points, Vec::new(), vec![0.0, 0.0, 1.0, 2.0, 2.0]).expect("a bent line");
        let surface = Surface::Extrusion { profile: Arc::new(Curve::Nurbs(profile)), direction: DVec3::Z };
        let creases = Creases::new(&surface, DVec2::ZERO, DVec2::new(2.0, 1.0));
        assert!(creases.hold(DVec2::new(1.0, 0.3)));
        assert!(!creases.hold(DVec2::new(0.5, 0.3)));
        let beside = creases.beside(DVec2::new(1.0, 0.3), DVec2::new(1.5, 0.9)).expect("on the crease");
        assert!(beside.x > 1.0 && beside.x < 1.001 && beside.y == 0.3);
        assert_eq!(creases.beside(DVec2::new(0.5, 0.3), DVec2::ONE), None);
        assert_eq!(creases.crossing(DVec2::new(0.5, 0.0), DVec2::new(2.0, 0.0)), Some((1.0 / 3.0, DVec2::X)));
    }

    #[test]
    fn a_border_along_a_crease_is_on_the_side_of_the_domain() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)];
        let profile =
            NurbsCurve::new(1, points, Vec::new(), vec![0.0, 0.0, 1.0, 2.0, 2.0]).expect("a bent line");
        let surface = Surface::Extrusion { profile: Arc::new(Curve::Nurbs(profile)), direction: DVec3::Z };
        // The domain starts a rounding error before the corner.
        let border = DVec2::new(1.0 - 1e-13, 0.5);
        let creases = Creases::new(&surface, DVec2::new(border.x, 0.0), DVec2::new(2.0, 1.0));
        assert!(!creases.hold(border));
        let normal = |uv| surface.normal(uv).expect("regular");
        assert!(normal(creases.within(border)).distance(normal(DVec2::new(1.5, 0.5))) < 1e-12);
        let creases = Creases::new(&surface, DVec2::ZERO, DVec2::new(1.0 + 1e-13, 1.0));
        let border = DVec2::new(1.0 + 1e-13, 0.5);
        assert!(normal(creases.within(border)).distance(normal(DVec2::new(0.5, 0.5))) < 1e-12);
        assert_eq!(creases.within(DVec2::new(0.3, 0.3)), DVec2::new(0.3, 0.3));
    }
}
