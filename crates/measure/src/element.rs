//! What a minimum of the distance may lie on: the inside of a surface, the inside of a curve, a point.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use trimloop_geom::{Curve, Interval, Surface};

/// A smooth set of points with no more than two parameters, in the world.
#[derive(Clone, Debug)]
pub(crate) enum Element {
    /// A single point.
    Point(DVec3),
    /// A piece of a curve.
    Curve { curve: Arc<Curve>, limits: Interval, map: DAffine3 },
    /// A surface over a box of parameters; whether a point belongs to the face is asked elsewhere.
    Surface { surface: Arc<Surface>, limits: [Interval; 2], map: DAffine3 },
    /// A triangle that stands for nothing but itself: `corner + x side + y side`, x, y and x + y from 0 to 1.
    Triangle { corner: DVec3, sides: [DVec3; 2] },
}

/// A point and its derivatives by the parameters.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Jet {
    pub point: DVec3,
    /// By the first and by the second parameter.
    pub first: [DVec3; 2],
    /// Twice by the first, by both, twice by the second.
    pub second: [DVec3; 3],
}

impl Element {
    /// How many parameters there are.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Point(_) => 0,
            Self::Curve { .. } => 1,
            Self::Surface { .. } | Self::Triangle { .. } => 2,
        }
    }

    /// The point at some parameters.
    pub fn point(&self, at: DVec2) -> DVec3 {
        match self {
            Self::Point(point) => *point,
            Self::Curve { curve, map, .. } => map.transform_point3(curve.point(at.x)),
            Self::Surface { surface, map, .. } => map.transform_point3(surface.point(at)),
            Self::Triangle { corner, sides } => *corner + sides[0] * at.x + sides[1] * at.y,
        }
    }

    /// The point with its derivatives; those by parameters that there are not vanish.
    pub fn jet(&self, at: DVec2) -> Jet {
        match self {
            Self::Point(point) => Jet { point: *point, ..Jet::default() },
            Self::Curve { curve, map, .. } => {
                let [p, d, dd] = curve.derivatives(at.x);
                let [d, dd] = [d, dd].map(|v| map.transform_vector3(v));
                Jet {
                    point: map.transform_point3(p),
                    first: [d, DVec3::ZERO],
                    second: [dd, DVec3::ZERO, DVec3::ZERO],
                }
            }
            Self::Surface { surface, map, .. } => {
                let s = surface.derivatives(at);
                Jet {
                    point: map.transform_point3(s.point),
                    first: [s.du, s.dv].map(|v| map.transform_vector3(v)),
                    second: [s.duu, s.duv, s.dvv].map(|v| map.transform_vector3(v)),
                }
            }
            Self::Triangle { sides, .. } => Jet { point: self.point(at), first: *sides, ..Jet::default() },
        }
    }

    /// Between what each parameter may move.
    pub fn limits(&self) -> [Interval; 2] {
        match self {
            Self::Point(_) => [Interval::new(0.0, 0.0); 2],
            Self::Curve { limits, .. } => [*limits, Interval::new(0.0, 0.0)],
            Self::Surface { limits, .. } => *limits,
            // A little more than the triangle: whether a point is in it is asked in the end.
            Self::Triangle { .. } => [Interval::new(-0.1, 1.1); 2],
        }
    }
}
