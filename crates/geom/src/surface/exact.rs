//! Surfaces as NURBS.

use super::Surface;
use crate::{Curve, Frame, Interval, NurbsCurve, NurbsSurface};

impl Surface {
    /// The exact NURBS form over a finite `domain` (offsets, and sweeps of curves that have none: `None`; also where
    /// the domain is empty).
    ///
    /// Planes, extrusions of lines and splines, and spline surfaces keep their parametrization. Where a parameter is an
    /// angle, they keep it only at the knots and half-way between them.
    pub fn to_nurbs(&self, domain: [Interval; 2]) -> Option<NurbsSurface> {
        let [u, v] = domain;
        if !domain.iter().all(|d| d.is_finite() && d.length() > 0.0) {
            return None;
        }
        match self {
            Self::Plane { frame } => {
                let line = Curve::Line { origin: frame.origin, direction: frame.x };
                NurbsSurface::extruded(&line.to_nurbs(u)?, frame.y, v).ok()
            }
            Self::Extrusion { profile, direction } => {
                NurbsSurface::extruded(&profile.to_nurbs(u)?, *direction, v).ok()
            }
            Self::Revolution { profile, origin, axis } => {
                NurbsSurface::revolved(&profile.to_nurbs(v)?, *origin, *axis, u).ok()
            }
            Self::Nurbs(nurbs) => nurbs.restricted(domain).ok(),
            Self::Offset { .. } => None,
            _ => {
                let (frame, meridian) = self.meridian(v)?;
                NurbsSurface::revolved(&meridian, frame.origin, frame.z, u).ok()
            }
        }
    }

    /// The isoparametric curve u = 0 of cylinder, cone, sphere and torus.
    fn meridian(&self, v: Interval) -> Option<(&Frame, NurbsCurve)> {
        let round = |frame: &Frame, major: f64, minor: f64| {
            let origin = frame.origin + frame.x * major;
            let frame = Frame { origin, x: frame.x, y: frame.z, z: -frame.y };
            Curve::Circle { frame, radius: minor }
        };
        let (frame, curve) = match *self {
            Self::Cylinder { ref frame, radius } => {
                (frame, Curve::Line { origin: frame.origin + frame.x * radius, direction: frame.z })
            }
            Self::Cone { ref frame, radius, half_angle_rad } => {
                let direction = frame.z + frame.x * half_angle_rad.tan();
                (frame, Curve::Line { origin: frame.origin + frame.x * radius, direction })
            }
            Self::Sphere { ref frame, radius } => (frame, round(frame, 0.0, radius)),
            Self::Torus { ref frame, major, minor, .. } => (frame, round(frame, major, minor)),
            _ => return None,
        };
        Some((frame, curve.to_nurbs(v)?))
    }
}
