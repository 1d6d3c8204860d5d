//! Straight segments through points.

use glam::DVec3;

use super::CurvePoint;
use crate::Interval;
use crate::period::{CLOSURE, wrap};

/// Straight segments through `points` (at least two; with fewer, evaluation gives the one point or the origin).
#[derive(Clone, Debug)]
pub struct Polyline {
    /// The corners, in order.
    pub points: Vec<DVec3>,
}

impl Polyline {
    /// `[0, points.len() - 1]`: segment i runs over [i, i + 1].
    pub fn domain(&self) -> Interval {
        Interval::new(0.0, self.points.len().saturating_sub(1).max(1) as f64)
    }

    /// The domain's length where the last point is the first (within 1e-7 of the polyline's extent).
    pub fn period(&self) -> Option<f64> {
        let (first, last) = (self.points.first()?, self.points.last()?);
        let stride = (self.points.len() / 64).max(1);
        let extent = self.points.iter().step_by(stride).map(|p| p.distance(*first)).fold(0.0, f64::max);
        (self.points.len() > 2 && first.distance(*last) <= CLOSURE * extent).then(|| self.domain().length())
    }

    /// Point, first and second derivative at `t`; at a corner those of the segment that begins there.
    pub(super) fn derivatives(&self, t: f64) -> [DVec3; 3] {
        let domain = self.domain();
        let Some((&first, _)) = self.points.split_first() else { return [DVec3::ZERO; 3] };
        if self.points.len() < 2 {
            return [first, DVec3::ZERO, DVec3::ZERO];
        }
        let t = if domain.contains(t) || self.period().is_none() { domain.clamp(t) } else { wrap(t, domain) };
        let index = (t as usize).min(self.points.len() - 2);
        let (a, b) = (self.points[index], self.points[index + 1]);
        let share = t - index as f64;
        let point = if share < 1.0 { a + (b - a) * share } else { b };
        [point, b - a, DVec3::ZERO]
    }

    /// The nearest point whose parameter lies in `range` (inside the domain).
    pub(crate) fn project_within(&self, point: DVec3, range: Interval) -> CurvePoint {
        let mut best = CurvePoint { t: range.start, point: DVec3::ZERO, distance: f64::INFINITY };
        let segments = self.points.len().saturating_sub(1);
        let first = (range.start.max(0.0) as usize).min(segments);
        for index in first..segments {
            let at = index as f64;
            if at > range.end {
                break;
            }
            let (a, ab) = (self.points[index], self.points[index + 1] - self.points[index]);
            let share = ((point - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
            let share = if share.is_nan() { 0.0 } else { share };
            let t = range.clamp(at + share);
            let foot = self.derivatives(t)[0];
            let distance = foot.distance(point);
            if distance < best.distance {
                best = CurvePoint { t, point: foot, distance };
            }
        }
        if best.distance.is_infinite() {
            best.point = self.derivatives(best.t)[0];
            best.distance = best.point.distance(point);
        }
        best
    }
}
