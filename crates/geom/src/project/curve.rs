//! The nearest point of a curve.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::DVec3;

use super::conic;
use super::curve_search::CurveSearch;
use crate::period::{turn, wrap};
use crate::{CompositeCurve, Curve, CurvePoint, Frame, Interval};

impl Curve {
    /// The nearest point of the curve; globally, or, with a `hint`, the local solution from there when that is
    /// as good as can be expected (falls back to the global search when Newton fails or a coarse sample of the curve is
    /// nearer). The parameter lies in `domain()`.
    ///
    /// Closed forms for lines and conics, which need no hint; it matters there only where every point is equally
    /// near (the axis of a circle).
    pub fn project(&self, point: DVec3, hint: Option<f64>) -> CurvePoint {
        match self {
            Self::Polyline(polyline) => polyline.project_within(point, polyline.domain()),
            Self::Composite(composite) => composite.project(point, hint),
            _ => match self.closed_form(point, hint) {
                Some(t) => self.foot(t, point),
                None => self.search(point, hint),
            },
        }
    }

    /// The nearest point among those with parameters in `range`, which may extend past the domain of a closed curve.
    pub fn project_within(&self, point: DVec3, range: Interval, hint: Option<f64>) -> CurvePoint {
        if let Some(t) = self.closed_form(point, hint) {
            let t = match self.period() {
                Some(period) => t + period * ((range.start - t) / period).ceil(),
                None => t,
            };
            let t = if matches!(self, Self::Line { .. }) { range.clamp(t) } else { t };
            if range.contains(t) {
                return self.foot(t, point);
            }
        }
        let search = CurveSearch::new(|t| self.derivatives(t), range, false);
        self.foot(search.nearest(point, hint, || Cow::Owned(self.samples_within(range))).t, point)
    }

    /// Samples with parameters in `range`, both its ends included.
    fn samples_within(&self, range: Interval) -> Vec<(f64, DVec3)> {
        let domain = self.domain();
        match self {
            Self::Nurbs(nurbs) if domain.contains(range.start) && domain.contains(range.end) => {
                let inner = nurbs.samples().iter().filter(|(t, _)| range.start < *t && *t < range.end);
                let [first, last] = [range.start, range.end].map(|t| (t, self.point(t)));
                std::iter::once(first).chain(inner.copied()).chain([last]).collect()
            }
            _ => self.fresh_samples(range, 16),
        }
    }

    fn foot(&self, t: f64, target: DVec3) -> CurvePoint {
        let point = self.point(t);
        CurvePoint { t, point, distance: point.distance(target) }
    }

    /// The parameter where there is a formula for it.
    fn closed_form(&self, point: DVec3, hint: Option<f64>) -> Option<f64> {
        match *self {
            Self::Line { origin, direction } => {
                let t = (point - origin).dot(direction) / direction.length_squared();
                Some(if t.is_finite() { t } else { 0.0 })
            }
            Self::Circle { ref frame, radius } => {
                let (x, y) = plane(frame, point);
                if x == 0.0 && y == 0.0 {
                    return Some(hint.filter(|h| h.is_finite()).map_or(0.0, turn));
                }
                Some(turn(if radius < 0.0 { (-y).atan2(-x) } else { y.atan2(x) }))
            }
            Self::Ellipse { ref frame, major, minor } => {
                let (x, y) = plane(frame, point);
                Some(turn(conic::ellipse(major, minor, x, y)))
            }
            Self::Parabola { ref frame, focal } => {
                let (x, y) = plane(frame, point);
                Some(conic::parabola(focal, x, y))
            }
            Self::Hyperbola { ref frame, major, minor } => {
                let (x, y) = plane(frame, point);
                Some(conic::hyperbola(major, minor, x, y))
            }
            _ => None,
        }
    }

    fn search(&self, point: DVec3, hint: Option<f64>) -> CurvePoint {
        let domain = self.domain();
        let closed = self.period().is_some();
        let search = CurveSearch::new(|t| self.derivatives(t), domain, closed);
        let t = search.nearest(point, hint, || self.samples(point)).t;
        self.foot(if closed { wrap(t, domain) } else { t }, point)
    }

    /// Points along the curve from which a search for the point nearest to `target` starts.
    pub(crate) fn samples(&self, target: DVec3) -> Cow<'_, [(f64, DVec3)]> {
        match self {
            Self::Nurbs(nurbs) => Cow::Borrowed(nurbs.samples()),
            _ => Cow::Owned(self.fresh_samples(self.reach(target), 16)),
        }
    }

    fn fresh_samples(&self, range: Interval, per_piece: usize) -> Vec<(f64, DVec3)> {
        let breakpoints = self.breakpoints(range);
        let per_piece = per_piece.min((1 << 16) / breakpoints.len().max(1)).max(1);
        let mut samples = Vec::with_capacity(breakpoints.len() * per_piece + 1);
        for pair in breakpoints.windows(2) {
            let piece = Interval::new(pair[0], pair[1]);
            samples.extend((0..per_piece).map(|i| piece.at(i as f64 / per_piece as f64)));
        }
        samples.extend(breakpoints.last());
        samples.into_iter().map(|t| (t, self.point(t))).collect()
    }

    /// A finite part of the domain that holds the foot of `target`.
    fn reach(&self, target: DVec3) -> Interval {
        let domain = self.domain();
        if domain.is_finite() {
            return domain;
        }
        let far = |origin: DVec3, size: f64| 2.0 * target.distance(origin) / size.abs();
        let reach = match self {
            Self::Line { origin, direction } => far(*origin, direction.length()) + 1.0,
            Self::Parabola { frame, focal } => far(frame.origin, *focal).sqrt() + 1.0,
            Self::Hyperbola { frame, major, .. } => (far(frame.origin, *major) + 1.0).asinh() + 1.0,
            Self::Offset(offset) => return offset.basis.reach(target),
            _ => TAU,
        };
        let reach = if reach.is_finite() { reach } else { 1.0 };
        Interval::new(domain.start.max(-reach), domain.end.min(reach))
    }
}

impl CompositeCurve {
    fn project(&self, point: DVec3, hint: Option<f64>) -> CurvePoint {
        let mut best = CurvePoint { t: 0.0, point: DVec3::ZERO, distance: f64::INFINITY };
        for (index, segment) in self.segments.iter().enumerate() {
            let share = hint.map(|h| h - index as f64).filter(|s| (0.0..=1.0).contains(s));
            let inner = share.map(|s| segment.parameter(s));
            let foot = segment.curve.project_within(point, segment.range, inner);
            if foot.distance < best.distance {
                best = CurvePoint { t: index as f64 + segment.share(foot.t), ..foot };
            }
            if best.distance <= 1e-14 * point.length() {
                break;
            }
        }
        best
    }
}

fn plane(frame: &Frame, point: DVec3) -> (f64, f64) {
    let offset = point - frame.origin;
    (offset.dot(frame.x), offset.dot(frame.y))
}
