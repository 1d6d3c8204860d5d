//! Curves as NURBS.

use glam::DVec4;

use super::{CompositeCurve, CompositeSegment, Curve, Polyline};
use crate::nurbs::arc::Arc2;
use crate::period::pieces;
use crate::{Frame, Interval, NurbsCurve};

impl Curve {
    /// The exact NURBS form over a finite `range` (offsets and curves on surfaces: `None`; also where the range is
    /// empty, or on an open spline outside the domain).
    ///
    /// Lines, parabolas, polylines and splines keep their parametrization. Circles, ellipses and hyperbolas keep it
    /// only at the knots and half-way between them.
    pub fn to_nurbs(&self, range: Interval) -> Option<NurbsCurve> {
        if !(range.is_finite() && range.length() > 0.0) {
            return None;
        }
        match *self {
            Self::Line { .. } => {
                let ends = [range.start, range.end].map(|t| self.point(t));
                NurbsCurve::new(1, ends.to_vec(), vec![], doubled_ends(range)).ok()
            }
            Self::Circle { ref frame, radius } => placed(Arc2::circle(range)?, frame, radius, radius),
            Self::Ellipse { ref frame, major, minor } => placed(Arc2::circle(range)?, frame, major, minor),
            Self::Hyperbola { ref frame, major, minor } => {
                placed(Arc2::hyperbola(range)?, frame, major, minor)
            }
            Self::Parabola { .. } => {
                let [start, d, _] = self.derivatives(range.start);
                let middle = start + d * (0.5 * range.length());
                let knots = [[range.start; 3], [range.end; 3]].concat();
                NurbsCurve::new(2, vec![start, middle, self.point(range.end)], vec![], knots).ok()
            }
            Self::Polyline(ref polyline) => polyline.to_spline()?.restricted(range).ok(),
            Self::Nurbs(ref nurbs) => nurbs.restricted(range).ok(),
            Self::Composite(ref composite) => composite.to_spline(range),
            Self::Offset(_) | Self::OnSurface { .. } => None,
        }
    }
}

fn doubled_ends(range: Interval) -> Vec<f64> {
    vec![range.start, range.start, range.end, range.end]
}

fn placed(arc: Arc2, frame: &Frame, major: f64, minor: f64) -> Option<NurbsCurve> {
    let place =
        |[x, y, w]: [f64; 3]| (frame.origin * w + frame.x * (major * x) + frame.y * (minor * y)).extend(w);
    let points: Vec<DVec4> = arc.points.into_iter().map(place).collect();
    NurbsCurve::from_homogeneous(2, &points, arc.knots).ok()
}

impl Polyline {
    fn to_spline(&self) -> Option<NurbsCurve> {
        let last = self.points.len().checked_sub(1)? as f64;
        let inner = (0..self.points.len()).map(|i| i as f64);
        let knots = std::iter::once(0.0).chain(inner).chain([last]).collect();
        NurbsCurve::new(1, self.points.clone(), vec![], knots).ok()
    }
}

impl CompositeCurve {
    /// The parts of the segments inside `range` at their highest degree, each over its own part of t.
    fn to_spline(&self, range: Interval) -> Option<NurbsCurve> {
        let domain = self.domain();
        let inside = domain.contains(range.start) && domain.contains(range.end);
        let pieces = match self.period() {
            Some(_) if !inside => pieces(range, domain),
            _ => vec![(Interval::new(domain.clamp(range.start), domain.clamp(range.end)), 0.0)],
        };
        let mut parts = Vec::with_capacity(self.segments.len());
        for (piece, shift) in pieces {
            for (index, segment) in self.segments.iter().enumerate() {
                let at = index as f64;
                let part = Interval::new(piece.start.max(at), piece.end.min(at + 1.0));
                if !part.is_empty() {
                    let over = Interval::new(part.start + shift, part.end + shift);
                    parts.push(segment.part(part.start - at, part.end - at)?.reparametrized(over).ok()?);
                }
            }
        }
        NurbsCurve::chained(&parts)
    }
}

impl CompositeSegment {
    /// The spline of the part between two shares of the segment, in its direction.
    fn part(&self, start: f64, end: f64) -> Option<NurbsCurve> {
        let [a, b] = [start, end].map(|s| self.parameter(s));
        let spline = self.curve.to_nurbs(Interval::new(a.min(b), a.max(b)))?;
        Some(if self.reversed { spline.reversed() } else { spline })
    }
}

impl NurbsCurve {
    /// Curves end to end, at the highest of their degrees; each must begin at the parameter at which the one before
    /// ends. Ends that do not meet (within 1e-9) make the
    /// curve jump there. `None` without curves.
    pub fn chained(parts: &[Self]) -> Option<Self> {
        let degree = parts.iter().map(Self::degree).max()?;
        let mut scale = 1.0;
        let raised = parts.iter().map(|part| {
            let part = part.elevated(degree - part.degree());
            let mut points = part.homogeneous();
            // A common factor on a part's weights changes nothing but makes the joint's two points one.
            let factor = points.first().map_or(1.0, |p: &DVec4| scale / p.w);
            points.iter_mut().for_each(|p| *p *= factor);
            scale = points.last().map_or(1.0, |p| p.w);
            (part.knots().to_vec(), points)
        });
        let (knots, points) = crate::nurbs::joined(degree, raised);
        Self::from_homogeneous(degree, &points, knots).ok()
    }
}
