//! Curves in space.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use crate::{Aabb, Frame, Interval, NurbsCurve, Surface};

/// A curve in space, parametrized as ISO 10303-42 §4.4 does (angles in radians).
///
/// A curve in a parameter plane (pcurve) is a `Curve` with x = u, y = v, z = 0.
#[derive(Clone, Debug)]
pub enum Curve {
    /// `origin + t * direction`; `direction` need not be a unit vector.
    Line { origin: DVec3, direction: DVec3 },
    /// `frame.origin + radius * (cos t * x + sin t * y)`.
    Circle { frame: Frame, radius: f64 },
    /// `frame.origin + major * cos t * x + minor * sin t * y`.
    Ellipse { frame: Frame, major: f64, minor: f64 },
    /// `frame.origin + focal * (t² * x + 2 t * y)`.
    Parabola { frame: Frame, focal: f64 },
    /// `frame.origin + major * cosh t * x + minor * sinh t * y`.
    Hyperbola { frame: Frame, major: f64, minor: f64 },
    /// Straight segments; segment i runs over t in [i, i+1].
    Polyline(Polyline),
    /// B-spline of any degree, rational or not.
    Nurbs(NurbsCurve),
    /// `offset_curve_3d`.
    Offset(Box<OffsetCurve>),
    /// Segments end to end; segment i runs over t in [i, i+1].
    Composite(CompositeCurve),
    /// The image of a pcurve on a surface.
    OnSurface { surface: Arc<Surface>, pcurve: Arc<Curve> },
}

/// Straight segments through `points` (at least two).
#[derive(Clone, Debug)]
pub struct Polyline {
    /// The corners, in order.
    pub points: Vec<DVec3>,
}

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

/// `composite_curve`: segments end to end.
#[derive(Clone, Debug)]
pub struct CompositeCurve {
    /// At least one.
    pub segments: Vec<CompositeSegment>,
}

/// One segment: `curve` over `range`, run backwards where `reversed`.
#[derive(Clone, Debug)]
pub struct CompositeSegment {
    /// The basis curve.
    pub curve: Curve,
    /// The part that is used; finite.
    pub range: Interval,
    /// Whether the segment runs from `range.end` to `range.start`.
    pub reversed: bool,
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
        let _ = t;
        todo!()
    }

    /// Point, first and second derivative at `t`.
    pub fn derivatives(&self, t: f64) -> [DVec3; 3] {
        let _ = t;
        todo!()
    }

    /// Where the curve is defined; infinite for lines, parabolas and hyperbolas, one period for closed conics.
    pub fn domain(&self) -> Interval {
        todo!()
    }

    /// The period, where the curve closes on itself: 2π for circles and ellipses, the domain's length for closed
    /// splines, polylines and composites (their evaluation then wraps any `t` into the domain).
    pub fn period(&self) -> Option<f64> {
        todo!()
    }

    /// The nearest point of the curve; globally, or, with a `hint`, the local solution from there when that is
    /// as good as can be expected (falls back to the global search when Newton fails). The parameter lies in
    /// `domain()`.
    pub fn project(&self, point: DVec3, hint: Option<f64>) -> CurvePoint {
        let _ = (point, hint);
        todo!()
    }

    /// Sorted parameters inside `range` (ends included) between which the curve is smooth: knots, corners.
    /// For one-piece curves only the two ends. `range` may extend over the period of a closed curve.
    pub fn breakpoints(&self, range: Interval) -> Vec<f64> {
        let _ = range;
        todo!()
    }

    /// A box that holds the curve over a finite `range`.
    pub fn bounds(&self, range: Interval) -> Aabb {
        let _ = range;
        todo!()
    }

    /// The exact NURBS form over a finite `range` (offsets and curves on surfaces: `None`).
    pub fn to_nurbs(&self, range: Interval) -> Option<NurbsCurve> {
        let _ = range;
        todo!()
    }

    /// The curve's image; any affine map for splines, lines and polylines; similarity (rotation, uniform scale,
    /// mirror) for the rest.
    pub fn transformed(&self, map: &DAffine3) -> Self {
        let _ = map;
        todo!()
    }

    /// `line`, `circle`, `ellipse`, `parabola`, `hyperbola`, `polyline`, `nurbs`, `offset`, `composite`, `on-surface`.
    pub fn kind(&self) -> &'static str {
        todo!()
    }
}
