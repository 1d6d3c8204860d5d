//! Turning about an axis.

use glam::{DVec2, DVec3};

use super::Derivatives;
use crate::Curve;

/// `offset`, a vector from a point of the axis, turned by `angle_rad` about the unit `axis`.
pub(crate) fn turn_point(offset: DVec3, axis: DVec3, angle_rad: f64) -> DVec3 {
    let along = axis * offset.dot(axis);
    let out = offset - along;
    let (sin, cos) = angle_rad.sin_cos();
    along + out * cos + axis.cross(out) * sin
}

/// Point and derivatives of a surface of revolution.
pub(super) fn derivatives(profile: &Curve, origin: DVec3, axis: DVec3, uv: DVec2) -> Derivatives {
    let [p, d, dd] = profile.derivatives(uv.y);
    let (sin, cos) = uv.x.sin_cos();
    let split = |v: DVec3| {
        let along = axis * v.dot(axis);
        let out = v - along;
        let side = axis.cross(out);
        (along, out * cos + side * sin, side * cos - out * sin)
    };
    let (h, out, around) = split(p - origin);
    let (dh, dout, daround) = split(d);
    let (ddh, ddout, _) = split(dd);
    Derivatives {
        point: origin + h + out,
        du: around,
        dv: dh + dout,
        duu: -out,
        duv: daround,
        dvv: ddh + ddout,
    }
}

/// A profile seen in the half-plane that turns with it: x = distance from the axis, y = height along it.
pub(crate) struct Meridian<'a> {
    pub profile: &'a Curve,
    pub origin: DVec3,
    pub axis: DVec3,
}

impl Meridian<'_> {
    /// Distance from the axis and height of a point.
    pub fn flatten(&self, point: DVec3) -> DVec3 {
        let offset = point - self.origin;
        let height = offset.dot(self.axis);
        DVec3::new((offset - self.axis * height).length(), height, 0.0)
    }

    /// The flattened profile with its derivatives. On the axis itself, those of a profile that leaves it.
    pub fn derivatives(&self, v: f64) -> [DVec3; 3] {
        let [p, d, dd] = self.profile.derivatives(v);
        let split = |w: DVec3| {
            let height = w.dot(self.axis);
            (w - self.axis * height, height)
        };
        let ((out, h), (dout, dh), (ddout, ddh)) = (split(p - self.origin), split(d), split(dd));
        let radius = out.length();
        if radius <= 1e-14 * (p - self.origin).length() {
            return [
                DVec3::new(radius, h, 0.0),
                DVec3::new(dout.length(), dh, 0.0),
                DVec3::new(0.0, ddh, 0.0),
            ];
        }
        let slope = out.dot(dout) / radius;
        let bend = (dout.length_squared() + out.dot(ddout) - slope * slope) / radius;
        [DVec3::new(radius, h, 0.0), DVec3::new(slope, dh, 0.0), DVec3::new(bend, ddh, 0.0)]
    }
}
