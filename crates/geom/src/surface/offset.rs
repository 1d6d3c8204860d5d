//! Offset surfaces: `basis + distance * unit normal`.

use glam::{DVec2, DVec3};

use super::{Derivatives, Surface};
use crate::Interval;

/// The offset point; the basis' own where it has no normal.
pub(super) fn point(basis: &Surface, distance: f64, uv: DVec2) -> DVec3 {
    basis.point(uv) + basis.normal(uv).unwrap_or(DVec3::ZERO) * distance
}

/// Point and first derivatives; the normal's derivatives come from the basis' second ones.
pub(super) fn first_derivatives(basis: &Surface, distance: f64, uv: DVec2) -> Derivatives {
    let b = basis.derivatives(uv);
    let cross = b.du.cross(b.dv);
    let length = cross.length();
    let Some(normal) = basis.normal(uv) else {
        return Derivatives { point: b.point, du: b.du, dv: b.dv, ..Default::default() };
    };
    let point = b.point + normal * distance;
    if basis.is_singular(&b) {
        return differences(basis, distance, uv, point);
    }
    let turned = |change: DVec3| (change - normal * normal.dot(change)) * (distance / length);
    Derivatives {
        point,
        du: b.du + turned(b.duu.cross(b.dv) + b.du.cross(b.duv)),
        dv: b.dv + turned(b.duv.cross(b.dv) + b.du.cross(b.dvv)),
        ..Default::default()
    }
}

/// First derivatives at a singular point of the basis, where the normal's have no formula.
fn differences(basis: &Surface, distance: f64, uv: DVec2, at: DVec3) -> Derivatives {
    let slope = |d: usize| {
        let (low, high) = around(basis, d, uv[d], 1e-6);
        let [a, b] = [low, high].map(|t| point(basis, distance, with(uv, d, t)));
        let slope = (b - a) / (high - low);
        if slope.is_finite() { slope } else { DVec3::ZERO }
    };
    Derivatives { point: at, du: slope(0), dv: slope(1), ..Default::default() }
}

/// The basis' normal, turned over where the offset has passed a centre of curvature.
pub(super) fn normal(basis: &Surface, distance: f64, uv: DVec2, inside: DVec2) -> Option<DVec3> {
    let normal = basis.normal(uv)?;
    let side = [0.0, 1e-4, 1e-2].into_iter().find_map(|share| {
        let beside = uv + inside * share;
        if basis.is_singular(&basis.first_derivatives(beside)) {
            return None;
        }
        let s = first_derivatives(basis, distance, beside);
        let towards = s.du.cross(s.dv).dot(basis.normal(beside)?);
        (towards.abs() > 1e-9 * s.du.length() * s.dv.length()).then_some(towards)
    });
    Some(if side.is_some_and(|s| s < 0.0) { -normal } else { normal })
}

/// The two parameters a share of the domain below and above `t`, not beyond an open end.
fn around(basis: &Surface, d: usize, t: f64, share: f64) -> (f64, f64) {
    let domain = basis.domain()[d];
    let open = if basis.periods()[d].is_some() { Interval::INFINITE } else { domain };
    let step = share * if domain.is_finite() { domain.length() } else { 1.0 + t.abs() };
    (open.clamp(t - step), open.clamp(t + step))
}

fn with(mut uv: DVec2, d: usize, t: f64) -> DVec2 {
    uv[d] = t;
    uv
}

/// Point, first derivatives, and the second ones as differences of the first (they take the basis' third).
pub(super) fn derivatives(basis: &Surface, distance: f64, uv: DVec2) -> Derivatives {
    let mut at = first_derivatives(basis, distance, uv);
    let ends = [0, 1].map(|d| {
        let (low, high) = around(basis, d, uv[d], 1e-5);
        let values = [low, high].map(|t| (t, first_derivatives(basis, distance, with(uv, d, t))));
        let width = values[1].0 - values[0].0;
        let by = |f: fn(&Derivatives) -> DVec3| {
            let slope = (f(&values[1].1) - f(&values[0].1)) / width;
            if slope.is_finite() { slope } else { DVec3::ZERO }
        };
        [by(|s| s.du), by(|s| s.dv)]
    });
    at.duu = ends[0][0];
    at.duv = (ends[0][1] + ends[1][0]) * 0.5;
    at.dvv = ends[1][1];
    at
}
