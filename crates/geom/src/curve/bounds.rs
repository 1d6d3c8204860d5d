//! Boxes around curves.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Curve;
use crate::period::pieces;
use crate::{Aabb, Interval, NurbsCurve};

impl Curve {
    /// A box that holds the curve over a finite `range`: exact for lines, conics and polylines, the hull of the control
    /// points of the part for splines, grown by the distance for offsets.
    pub fn bounds(&self, range: Interval) -> Aabb {
        let mut bounds = Aabb::from_points([self.point(range.start), self.point(range.end)]);
        match self {
            Self::Line { .. } => {}
            Self::Circle { .. } | Self::Ellipse { .. } | Self::Parabola { .. } | Self::Hyperbola { .. } => {
                for t in self.extremes(range) {
                    bounds = bounds.with(self.point(t));
                }
            }
            Self::Polyline(_) => {
                bounds = Aabb::from_points(self.breakpoints(range).into_iter().map(|t| self.point(t)));
            }
            Self::Nurbs(nurbs) => bounds = bounds.union(hull(nurbs, range)),
            Self::Offset(offset) => {
                let grown = DVec3::splat(offset.distance.abs());
                let basis = offset.basis.bounds(range);
                bounds = Aabb { min: basis.min - grown, max: basis.max + grown };
            }
            Self::Composite(composite) => {
                let (domain, mut parts) = (composite.domain(), vec![(range, 0.0)]);
                if !(domain.contains(range.start) && domain.contains(range.end))
                    && composite.period().is_some()
                {
                    parts = pieces(range, domain);
                }
                for (part, _) in parts {
                    bounds = bounds.union(composite.bounds_inside(part));
                }
            }
            Self::OnSurface { surface, pcurve } => {
                let uv = pcurve.bounds(range);
                let domain = [Interval::new(uv.min.x, uv.max.x), Interval::new(uv.min.y, uv.max.y)];
                bounds = bounds.union(surface.bounds(domain));
            }
        }
        bounds
    }

    /// The parameters inside `range` at which a conic's tangent is square to a world axis.
    fn extremes(&self, range: Interval) -> Vec<f64> {
        let mut found = Vec::with_capacity(12);
        for axis in 0..3 {
            match *self {
                Self::Circle { ref frame, .. } => {
                    found.extend(angles(frame.y[axis].atan2(frame.x[axis]), range));
                }
                Self::Ellipse { ref frame, major, minor } => {
                    found.extend(angles((minor * frame.y[axis]).atan2(major * frame.x[axis]), range));
                }
                Self::Parabola { ref frame, .. } => found.push(-frame.y[axis] / frame.x[axis]),
                Self::Hyperbola { ref frame, major, minor } => {
                    found.push((-(minor * frame.y[axis]) / (major * frame.x[axis])).atanh());
                }
                _ => {}
            }
        }
        found.retain(|t| range.contains(*t));
        found
    }
}

/// The angle and its opposite, by whole turns, inside `range`.
pub(crate) fn angles(angle_rad: f64, range: Interval) -> impl Iterator<Item = f64> {
    [angle_rad, angle_rad + PI].into_iter().filter_map(move |a| {
        let t = a + TAU * ((range.start - a) / TAU).ceil();
        range.contains(t).then_some(t)
    })
}

impl super::CompositeCurve {
    fn bounds_inside(&self, range: Interval) -> Aabb {
        let first = (range.start.max(0.0) as usize).min(self.segments.len());
        let mut bounds = Aabb::EMPTY;
        for (index, segment) in self.segments.iter().enumerate().skip(first) {
            let at = index as f64;
            if at > range.end {
                break;
            }
            let ends = [range.start - at, range.end - at].map(|s| segment.parameter(s.clamp(0.0, 1.0)));
            let part = Interval::new(ends[0].min(ends[1]), ends[0].max(ends[1]));
            bounds = bounds.union(segment.curve.bounds(part));
        }
        bounds
    }
}

/// The control points of the part over `range`; of the whole curve where there is no such part.
fn hull(nurbs: &NurbsCurve, range: Interval) -> Aabb {
    match nurbs.restricted(range) {
        Ok(part) => Aabb::from_points(part.points().iter().copied()),
        Err(_) if range.length() > 0.0 => Aabb::from_points(nurbs.points().iter().copied()),
        Err(_) => Aabb::EMPTY,
    }
}
