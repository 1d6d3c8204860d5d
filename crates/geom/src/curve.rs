//! Curves in space.

mod bounds;
mod breakpoints;
mod composite;
pub(crate) mod conic;
mod exact;
mod offset;
mod polyline;
mod transform;

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

pub(crate) use bounds::angles;
pub(crate) use breakpoints::in_range;
pub use composite::{CompositeCurve, CompositeSegment};
pub use offset::OffsetCurve;
pub use polyline::Polyline;
pub(crate) use transform::{flat_frame, scale_of};

use crate::{Frame, Interval, NurbsCurve, Surface};

/// A curve in space, parametrized as ISO 10303-42 §4.4 does (angles in radians).
///
/// A curve in a parameter plane (pcurve) is a `Curve` with x = u, y = v, z = 0.
///
/// ```
/// use std::f64::consts::FRAC_PI_2;
/// use trimloop_geom::{Curve, DVec3, Frame};
/// let circle = Curve::Circle { frame: Frame::WORLD, radius: 2.0 };
/// assert!(circle.point(FRAC_PI_2).distance(DVec3::new(0.0, 2.0, 0.0)) < 1e-15);
/// assert_eq!(circle.project(DVec3::new(5.0, 0.0, 4.0), None).distance, 5.0);
/// ```
#[derive(Clone, Debug)]
pub enum Curve {
    /// `origin + t * direction`; `direction` need not be a unit vector.
    Line {
        /// The point at t = 0.
        origin: DVec3,
        /// What a unit of t adds.
        direction: DVec3,
    },
    /// `frame.origin + radius * (cos t * x + sin t * y)`.
    Circle {
        /// Centre and plane.
        frame: Frame,
        /// Radius.
        radius: f64,
    },
    /// `frame.origin + major * cos t * x + minor * sin t * y`.
    Ellipse {
        /// Centre and plane.
        frame: Frame,
        /// Semi-axis along x, not necessarily the longer one.
        major: f64,
        /// Semi-axis along y.
        minor: f64,
    },
    /// `frame.origin + focal * (t² * x + 2 t * y)`.
    Parabola {
        /// Vertex and plane; it opens along x.
        frame: Frame,
        /// Distance from the vertex to the focus.
        focal: f64,
    },
    /// `frame.origin + major * cosh t * x + minor * sinh t * y`.
    Hyperbola {
        /// Centre and plane; the branch lies on the side of +x.
        frame: Frame,
        /// Semi-axis along x.
        major: f64,
        /// Semi-axis along y.
        minor: f64,
    },
    /// Straight segments; segment i runs over t in [i, i+1].
    Polyline(Polyline),
    /// B-spline of any degree, rational or not.
    Nurbs(NurbsCurve),
    /// `offset_curve_3d`.
    Offset(Box<OffsetCurve>),
    /// Segments end to end; segment i runs over t in [i, i+1].
    Composite(CompositeCurve),
    /// The image of a pcurve on a surface.
    OnSurface {
        /// The surface.
        surface: Arc<Surface>,
        /// The curve in its parameters, x = u and y = v.
        pcurve: Arc<Curve>,
    },
}

/// The foot of a projection onto a curve.
#[derive(Clone, Copy, Debug)]
pub struct CurvePoint {
    /// Parameter.
    pub t: f64,
    /// The point of the curve at `t`.
    pub point: DVec3,
    /// Its distance from the point that was projected.
    pub distance: f64,
}

impl Curve {
    /// The point at `t`.
    pub fn point(&self, t: f64) -> DVec3 {
        match self {
            Self::Line { origin, direction } => *origin + *direction * t,
            Self::Polyline(polyline) => polyline.derivatives(t)[0],
            Self::Nurbs(nurbs) => nurbs.point(t),
            Self::Offset(offset) => offset.point(t),
            Self::Composite(composite) => composite.point(t),
            Self::OnSurface { surface, pcurve } => surface.point(pcurve.point(t).truncate()),
            _ => conic::derivatives(self, t)[0],
        }
    }

    /// Point, first and second derivative at `t`. At a corner those of the piece that begins there.
    pub fn derivatives(&self, t: f64) -> [DVec3; 3] {
        match self {
            Self::Line { origin, direction } => [*origin + *direction * t, *direction, DVec3::ZERO],
            Self::Polyline(polyline) => polyline.derivatives(t),
            Self::Nurbs(nurbs) => nurbs.derivatives(t),
            Self::Offset(offset) => offset.derivatives(t),
            Self::Composite(composite) => composite.derivatives(t),
            Self::OnSurface { surface, pcurve } => derivatives_on_surface(surface, pcurve, t),
            _ => conic::derivatives(self, t),
        }
    }

    /// Where the curve is defined; infinite for lines, parabolas and hyperbolas, one period for closed conics.
    pub fn domain(&self) -> Interval {
        match self {
            Self::Line { .. } | Self::Parabola { .. } | Self::Hyperbola { .. } => Interval::INFINITE,
            Self::Circle { .. } | Self::Ellipse { .. } => Interval::new(0.0, TAU),
            Self::Polyline(polyline) => polyline.domain(),
            Self::Nurbs(nurbs) => nurbs.domain(),
            Self::Offset(offset) => offset.basis.domain(),
            Self::Composite(composite) => composite.domain(),
            Self::OnSurface { pcurve, .. } => pcurve.domain(),
        }
    }

    /// The period, where the curve closes on itself: 2π for circles and ellipses, the domain's length for closed
    /// splines, polylines and composites (their evaluation then wraps any `t` into the domain).
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::Line { .. } | Self::Parabola { .. } | Self::Hyperbola { .. } => None,
            Self::Circle { .. } | Self::Ellipse { .. } => Some(TAU),
            Self::Polyline(polyline) => polyline.period(),
            Self::Nurbs(nurbs) => nurbs.period(),
            Self::Offset(offset) => offset.basis.period(),
            Self::Composite(composite) => composite.period(),
            Self::OnSurface { pcurve, .. } => pcurve.period(),
        }
    }

    /// `line`, `circle`, `ellipse`, `parabola`, `hyperbola`, `polyline`, `nurbs`, `offset`, `composite`, `on-surface`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Line { .. } => "line",
            Self::Circle { .. } => "circle",
            Self::Ellipse { .. } => "ellipse",
            Self::Parabola { .. } => "parabola",
            Self::Hyperbola { .. } => "hyperbola",
            Self::Polyline(_) => "polyline",
            Self::Nurbs(_) => "nurbs",
            Self::Offset(_) => "offset",
            Self::Composite(_) => "composite",
            Self::OnSurface { .. } => "on-surface",
        }
    }
}

/// Point, first and second derivative of a pcurve's image, by the chain rule.
fn derivatives_on_surface(surface: &Surface, pcurve: &Curve, t: f64) -> [DVec3; 3] {
    let [uv, d, dd] = pcurve.derivatives(t);
    let s = surface.derivatives(uv.truncate());
    let bend = s.duu * (d.x * d.x) + s.duv * (2.0 * d.x * d.y) + s.dvv * (d.y * d.y);
    [s.point, s.du * d.x + s.dv * d.y, bend + s.du * dd.x + s.dv * dd.y]
}
