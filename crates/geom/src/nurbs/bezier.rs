//! Bézier pieces.

use glam::{DVec3, DVec4};

use super::control::lower;
use crate::Interval;

/// A polynomial or rational Bézier curve: one knot span of a spline.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierCurve {
    /// The parameters of the spline that it covers.
    pub range: Interval,
    /// `degree + 1` control points `(w x, w y, w z, w)`.
    pub points: Vec<DVec4>,
}

/// A polynomial or rational Bézier patch: one knot span by one knot span of a spline surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPatch {
    /// Degrees [u, v].
    pub degrees: [usize; 2],
    /// The parameters [u, v] of the spline that it covers.
    pub domain: [Interval; 2],
    /// `(degrees[0] + 1) x (degrees[1] + 1)` control points `(w x, w y, w z, w)`, row-major, rows running over u.
    pub points: Vec<DVec4>,
}

/// The Bézier patches of a spline surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierGrid {
    /// Patches along u.
    pub rows: usize,
    /// Patches along v.
    pub columns: usize,
    /// `rows * columns` patches, row-major, rows running over u.
    pub patches: Vec<BezierPatch>,
}

impl BezierCurve {
    /// The point at share `s` of the piece (0 = start, 1 = end), by de Casteljau's corner cutting.
    pub fn point(&self, s: f64) -> DVec3 {
        lower(de_casteljau(self.points.clone(), s)).0
    }
}

impl BezierPatch {
    /// The point at shares `s` along u and `t` along v.
    pub fn point(&self, s: f64, t: f64) -> DVec3 {
        let rows = self.points.chunks(self.degrees[1] + 1).map(|row| de_casteljau(row.to_vec(), t));
        lower(de_casteljau(rows.collect(), s)).0
    }
}

fn de_casteljau(mut points: Vec<DVec4>, s: f64) -> DVec4 {
    for level in (1..points.len()).rev() {
        for i in 0..level {
            points[i] = points[i] * (1.0 - s) + points[i + 1] * s;
        }
    }
    points.first().copied().unwrap_or(DVec4::ZERO)
}
