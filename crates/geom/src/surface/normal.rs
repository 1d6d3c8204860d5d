//! Unit normals, singular points included.

use glam::{DVec2, DVec3};

use super::{Derivatives, Surface, offset};
use crate::Interval;

impl Surface {
    /// Unit normal `∂S/∂u x ∂S/∂v`; at singular points the limit from the inside of the domain (at a cone's apex from
    /// the side where the radius is positive). `None` where even that vanishes.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        match self {
            Self::Plane { frame } => Some(frame.z),
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Sphere { .. } | Self::Torus { .. } => {
                self.tube_normal(uv)
            }
            Self::Offset { basis, distance } => offset::normal(basis, *distance, uv, self.inside(uv)),
            _ => self.general_normal(uv),
        }
    }

    /// [`Surface::point`] and [`Surface::normal`] in one evaluation, where that is possible.
    pub fn point_and_normal(&self, uv: DVec2) -> (DVec3, Option<DVec3>) {
        if !matches!(self, Self::Nurbs(_)) {
            return (self.point(uv), self.normal(uv));
        }
        let first = self.first_derivatives(uv);
        let normal = self.normal_of_first(&first, uv);
        (first.point, normal)
    }

    /// Square to the meridian, away from the axis where the radius is positive.
    fn tube_normal(&self, uv: DVec2) -> Option<DVec3> {
        let (frame, tube) = self.tube(uv.y)?;
        let (sin, cos) = uv.x.sin_cos();
        let out = frame.x * cos + frame.y * sin;
        let [_, dr, _] = tube.radius;
        let [_, dh, _] = tube.height;
        let flip = if self.is_inverted(uv.y, tube.radius[0]) { -1.0 } else { 1.0 };
        ((out * dh - frame.z * dr) * flip).try_normalize()
    }

    /// Whether the distance from the axis counts as negative at `v`: a cone's far nappe, a lemon. A pole itself goes
    /// with the inside of the domain.
    fn is_inverted(&self, v: f64, radius: f64) -> bool {
        match *self {
            Self::Sphere { radius: size, .. } => radius * size.signum() < -1e-9 * size.abs(),
            Self::Torus { major, minor, v_range: Some(range), .. } if radius.abs() <= 1e-9 * minor.abs() => {
                let middle = range.at(0.5);
                let inside = v + (middle - v).clamp(-1e-3, 1e-3);
                major + minor * inside.cos() < 0.0
            }
            Self::Cone { radius: size, .. } => radius < -1e-12 * size.abs(),
            _ => radius < 0.0,
        }
    }

    /// The cross product of the first derivatives; where one of them all but vanishes, its change towards the inside
    /// in its place; where that does not help, the normal a little further inside.
    fn general_normal(&self, uv: DVec2) -> Option<DVec3> {
        self.normal_of_first(&self.first_derivatives(uv), uv)
    }

    /// The general normal at `uv`, of which `first` are the point and the first derivatives.
    fn normal_of_first(&self, first: &Derivatives, uv: DVec2) -> Option<DVec3> {
        if !self.is_singular(first) {
            return first.du.cross(first.dv).try_normalize();
        }
        self.singular_normal(self.derivatives(uv), uv)
    }

    /// The general normal at `uv`, of which `value` are the point and the derivatives.
    pub(crate) fn normal_of(&self, value: Derivatives, uv: DVec2) -> Option<DVec3> {
        if !self.is_singular(&value) {
            return value.du.cross(value.dv).try_normalize();
        }
        self.singular_normal(value, uv)
    }

    fn singular_normal(&self, value: Derivatives, uv: DVec2) -> Option<DVec3> {
        let inside = self.inside(uv);
        self.limit_normal(value, inside).or_else(|| self.normal_inside(uv, inside))
    }

    /// Whether the first derivatives are too small or too parallel to give a normal.
    pub(super) fn is_singular(&self, s: &Derivatives) -> bool {
        let cross = s.du.cross(s.dv).length();
        let flat = self.vanishing(s);
        flat[0] || flat[1] || cross.is_nan() || cross <= 1e-9 * s.du.length() * s.dv.length()
    }

    /// Whether ∂S/∂u and ∂S/∂v all but vanish.
    fn vanishing(&self, s: &Derivatives) -> [bool; 2] {
        let scale = self.derivative_scale(s.point);
        [s.du.length() <= 1e-6 * scale[0], s.dv.length() <= 1e-6 * scale[1]]
    }

    fn limit_normal(&self, s: Derivatives, inside: DVec2) -> Option<DVec3> {
        let (du, dv) = match self.vanishing(&s) {
            [true, false] => (s.duv * inside.y.signum(), s.dv),
            [false, true] => (s.du, s.duv * inside.x.signum()),
            _ => return None,
        };
        let cross = du.cross(dv);
        if cross.length() > 1e-6 * du.length() * dv.length() { cross.try_normalize() } else { None }
    }

    /// The first normal that can be told on a way from `uv` inwards.
    fn normal_inside(&self, uv: DVec2, inside: DVec2) -> Option<DVec3> {
        [1e-6, 1e-5, 1e-4, 1e-3, 1e-2].into_iter().find_map(|share| {
            let s = self.first_derivatives(uv + inside * share);
            let cross = s.du.cross(s.dv);
            let enough = cross.length() > 1e-7 * s.du.length() * s.dv.length();
            if enough { cross.try_normalize() } else { None }
        })
    }

    /// From `uv` to the middle of the domain; along an infinite direction, one unit.
    fn inside(&self, uv: DVec2) -> DVec2 {
        let domain = self.domain();
        let towards = |interval: Interval, t: f64| {
            if !interval.is_finite() {
                return 1.0;
            }
            let way = interval.at(0.5) - interval.clamp(t);
            // From the middle itself any way will do.
            if way == 0.0 { 0.5 * interval.length() } else { way }
        };
        DVec2::new(towards(domain[0], uv.x), towards(domain[1], uv.y))
    }

    /// What the lengths of ∂S/∂u and ∂S/∂v are to be compared with, to tell whether they vanish.
    fn derivative_scale(&self, point: DVec3) -> [f64; 2] {
        match self {
            Self::Nurbs(nurbs) => nurbs.domain().map(|d| nurbs.size() / d.length()),
            Self::Revolution { origin, .. } => [(point - *origin).length(), 0.0],
            Self::Sphere { radius, .. } => [radius.abs(), 0.0],
            Self::Torus { major, minor, .. } => [major.abs() + minor.abs(), 0.0],
            Self::Cone { frame, .. } => [(point - frame.origin).length(), 0.0],
            _ => [0.0; 2],
        }
    }
}
