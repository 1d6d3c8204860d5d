//! Control points in three coordinates or homogeneous ones, and the rational rules that bring them back.

use std::ops::{AddAssign, Mul};

use glam::{DVec3, DVec4};

use super::NurbsError;

/// A point that basis functions combine: `DVec3`, or homogeneous `(w x, w y, w z, w)` as `DVec4`.
pub(crate) trait Control: Copy + AddAssign + Mul<f64, Output = Self> {
    const ZERO: Self;
}

impl Control for DVec3 {
    const ZERO: Self = Self::ZERO;
}

impl Control for DVec4 {
    const ZERO: Self = Self::ZERO;
}

/// `(w x, w y, w z, w)`.
pub(crate) fn lift(point: DVec3, weight: f64) -> DVec4 {
    (point * weight).extend(weight)
}

/// The point and weight of a homogeneous point.
pub(crate) fn lower(point: DVec4) -> (DVec3, f64) {
    (point.truncate() / point.w, point.w)
}

/// All points homogeneous; weight 1 where `weights` is empty.
pub(crate) fn lift_all(points: &[DVec3], weights: &[f64]) -> Vec<DVec4> {
    if weights.is_empty() {
        points.iter().map(|p| p.extend(1.0)).collect()
    } else {
        points.iter().zip(weights).map(|(&p, &w)| lift(p, w)).collect()
    }
}

/// Checks points and weights; drops weights that are all the same (the spline is polynomial then).
pub(super) fn check(points: &[DVec3], weights: &mut Vec<f64>) -> Result<(), NurbsError> {
    if let Some(index) = points.iter().position(|p| !p.is_finite()) {
        return Err(NurbsError(format!("control point {index} is {}", points[index])));
    }
    if !weights.is_empty() && weights.len() != points.len() {
        return Err(NurbsError(format!("{} weights for {} control points", weights.len(), points.len())));
    }
    if let Some(index) = weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
        return Err(NurbsError(format!("weight {index} is {}, not a positive number", weights[index])));
    }
    if weights.iter().all(|w| *w == weights[0]) {
        weights.clear();
    }
    Ok(())
}

/// Point, first and second derivative of a curve from the homogeneous ones (Piegl & Tiller A4.2).
#[inline]
pub(super) fn project_curve([a, da, dda]: [DVec4; 3]) -> [DVec3; 3] {
    let inverse = 1.0 / a.w;
    let point = a.truncate() * inverse;
    let first = (da.truncate() - point * da.w) * inverse;
    let second = (dda.truncate() - first * (2.0 * da.w) - point * dda.w) * inverse;
    [point, first, second]
}

/// S, Su, Sv, Suu, Suv, Svv of a surface from the homogeneous ones (Piegl & Tiller A4.4).
#[inline]
pub(super) fn project_surface<const ORDER: usize>(a: [DVec4; 6]) -> [DVec3; 6] {
    let inverse = 1.0 / a[0].w;
    let s = a[0].truncate() * inverse;
    if ORDER == 0 {
        return [s, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO];
    }
    let su = (a[1].truncate() - s * a[1].w) * inverse;
    let sv = (a[2].truncate() - s * a[2].w) * inverse;
    if ORDER == 1 {
        return [s, su, sv, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO];
    }
    let suu = (a[3].truncate() - su * (2.0 * a[1].w) - s * a[3].w) * inverse;
    let suv = (a[4].truncate() - sv * a[1].w - su * a[2].w - s * a[4].w) * inverse;
    let svv = (a[5].truncate() - sv * (2.0 * a[2].w) - s * a[5].w) * inverse;
    [s, su, sv, suu, suv, svv]
}
