//! Circular and hyperbolic arcs as rational quadratic splines (Piegl & Tiller A7.1 and §7.6).

use std::f64::consts::FRAC_PI_2;

use crate::Interval;

/// Arcs with more pieces than this are refused.
const MOST_PIECES: f64 = 4096.0;

/// Homogeneous control points (w x, w y, w) of a unit arc, and its knots.
pub(crate) struct Arc2 {
    pub points: Vec<[f64; 3]>,
    pub knots: Vec<f64>,
}

impl Arc2 {
    /// `(cos t, sin t)` over a range of angles, in pieces of at most 90 degrees. The spline's parameter is the angle at
    /// the joints and the middles of the pieces only.
    pub fn circle(range: Interval) -> Option<Self> {
        Self::new(range, FRAC_PI_2, |t| (t.cos(), t.sin()), f64::cos)
    }

    /// `(cosh t, sinh t)` over a range of parameters, in pieces of at most 1. The spline's parameter is t at the joints
    /// and the middles of the pieces only.
    pub fn hyperbola(range: Interval) -> Option<Self> {
        Self::new(range, 1.0, |t| (t.cosh(), t.sinh()), f64::cosh)
    }

    /// Between the ends of a piece lies the meeting point of their tangents: the point at the middle parameter, with
    /// the weight `cos` (or `cosh`) of half the piece when taken as homogeneous.
    fn new(
        range: Interval,
        longest: f64,
        at: impl Fn(f64) -> (f64, f64),
        weight: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let count = (range.length() / longest - 1e-9).ceil().max(1.0);
        if !(range.is_finite() && range.length() > 0.0 && count <= MOST_PIECES) {
            return None;
        }
        let joint = |i: f64| if i == count { range.end } else { range.at(i / count) };
        let half = 0.5 * range.length() / count;
        let on = |t: f64, w: f64| [at(t).0, at(t).1, w];
        let mut points = vec![on(range.start, 1.0)];
        let mut knots = vec![range.start; 3];
        for i in 0..count as usize {
            let end = joint(i as f64 + 1.0);
            points.push(on(joint(i as f64) + half, weight(half)));
            points.push(on(end, 1.0));
            knots.extend([end; 2]);
        }
        knots.push(range.end);
        Some(Self { points, knots })
    }
}
