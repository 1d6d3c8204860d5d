//! Points and derivatives.

use glam::{DVec2, DVec3};

use super::{Derivatives, Surface, offset, revolve};
use crate::Frame;

impl Surface {
    /// The point at (u, v). Closed surfaces take any parameter and wrap it; open splines clamp it, everything else
    /// extrapolates.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        match self {
            Self::Plane { frame } => frame.origin + frame.x * uv.x + frame.y * uv.y,
            Self::Extrusion { profile, direction } => profile.point(uv.x) + *direction * uv.y,
            Self::Revolution { profile, origin, axis } => {
                revolve::turn_point(profile.point(uv.y) - *origin, *axis, uv.x) + *origin
            }
            Self::Nurbs(nurbs) => nurbs.point(uv),
            Self::Offset { basis, distance } => offset::point(basis, *distance, uv),
            _ => match self.tube(uv.y) {
                Some((frame, tube)) => {
                    let (sin, cos) = uv.x.sin_cos();
                    frame.origin + (frame.x * cos + frame.y * sin) * tube.radius[0] + frame.z * tube.height[0]
                }
                None => DVec3::ZERO,
            },
        }
    }

    /// Point and first derivatives (the second are left zero); the fast path.
    pub fn first_derivatives(&self, uv: DVec2) -> Derivatives {
        match self {
            Self::Nurbs(nurbs) => nurbs.first_derivatives(uv),
            Self::Offset { basis, distance } => offset::first_derivatives(basis, *distance, uv),
            _ => Derivatives { duu: DVec3::ZERO, duv: DVec3::ZERO, dvv: DVec3::ZERO, ..self.derivatives(uv) },
        }
    }

    /// Point, first and second derivatives (an offset's second ones by differences of its first).
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        match self {
            Self::Plane { frame } => {
                Derivatives { point: self.point(uv), du: frame.x, dv: frame.y, ..Default::default() }
            }
            Self::Extrusion { profile, direction } => {
                let [p, d, dd] = profile.derivatives(uv.x);
                let point = p + *direction * uv.y;
                Derivatives { point, du: d, dv: *direction, duu: dd, ..Default::default() }
            }
            Self::Revolution { profile, origin, axis } => revolve::derivatives(profile, *origin, *axis, uv),
            Self::Nurbs(nurbs) => nurbs.derivatives(uv),
            Self::Offset { basis, distance } => offset::derivatives(basis, *distance, uv),
            _ => self
                .tube(uv.y)
                .map_or_else(Derivatives::default, |(frame, tube)| tube.derivatives(frame, uv.x)),
        }
    }

    /// The meridian of cylinder, cone, sphere and torus at `v`.
    pub(super) fn tube(&self, v: f64) -> Option<(&Frame, Tube)> {
        match *self {
            Self::Cylinder { ref frame, radius } => {
                Some((frame, Tube { radius: [radius, 0.0, 0.0], height: [v, 1.0, 0.0] }))
            }
            Self::Cone { ref frame, radius, half_angle_rad } => {
                let tan = half_angle_rad.tan();
                Some((frame, Tube { radius: [radius + v * tan, tan, 0.0], height: [v, 1.0, 0.0] }))
            }
            Self::Sphere { ref frame, radius } => Some((frame, Tube::round(0.0, radius, v))),
            Self::Torus { ref frame, major, minor, .. } => Some((frame, Tube::round(major, minor, v))),
            _ => None,
        }
    }
}

/// Distance from the axis and height along it at one v, each with its first and second derivative by v.
pub(super) struct Tube {
    pub radius: [f64; 3],
    pub height: [f64; 3],
}

impl Tube {
    fn round(major: f64, minor: f64, v: f64) -> Self {
        let (sin, cos) = v.sin_cos();
        let (x, y) = (minor * cos, minor * sin);
        Self { radius: [major + x, -y, -x], height: [y, x, -y] }
    }

    fn derivatives(&self, frame: &Frame, u: f64) -> Derivatives {
        let (sin, cos) = u.sin_cos();
        let out = frame.x * cos + frame.y * sin;
        let around = frame.y * cos - frame.x * sin;
        let [r, dr, ddr] = self.radius;
        let [h, dh, ddh] = self.height;
        Derivatives {
            point: frame.origin + out * r + frame.z * h,
            du: around * r,
            dv: out * dr + frame.z * dh,
            duu: out * -r,
            duv: around * dr,
            dvv: out * ddr + frame.z * ddh,
        }
    }
}
