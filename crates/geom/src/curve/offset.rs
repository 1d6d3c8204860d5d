//! Offset curves.

use glam::DVec3;

use super::Curve;
use crate::Interval;

/// `offset_curve_3d`: `basis(t) + distance * unit(basis'(t) x ref_direction)` (ISO 10303-42 §4.4.31).
#[derive(Clone, Debug)]
pub struct OffsetCurve {
    /// The curve that is offset.
    pub basis: Curve,
    /// Signed distance.
    pub distance: f64,
    /// The direction that with the tangent fixes the offset's.
    pub ref_direction: DVec3,
}

impl OffsetCurve {
    pub(super) fn point(&self, t: f64) -> DVec3 {
        self.first(t)[0]
    }

    /// Point and first derivative; where the basis stands still or runs along `ref_direction`, the basis' own.
    fn first(&self, t: f64) -> [DVec3; 2] {
        let [p, d, dd] = self.basis.derivatives(t);
        let side = d.cross(self.ref_direction);
        let length = side.length();
        let Some(unit) = side.try_normalize() else { return [p, d] };
        let turn = dd.cross(self.ref_direction) / length;
        [p + unit * self.distance, d + (turn - unit * unit.dot(turn)) * self.distance]
    }

    /// Point, first derivative, and the second one as a difference of the first (it takes the basis' third).
    pub(super) fn derivatives(&self, t: f64) -> [DVec3; 3] {
        let [p, d] = self.first(t);
        let domain = self.basis.domain();
        let step = 1e-5 * if domain.is_finite() { domain.length() } else { 1.0 + t.abs() };
        let open = if self.basis.period().is_some() { Interval::INFINITE } else { domain };
        let (low, high) = (open.clamp(t - step), open.clamp(t + step));
        let second = (self.first(high)[1] - self.first(low)[1]) / (high - low);
        [p, d, if second.is_finite() { second } else { DVec3::ZERO }]
    }
}
