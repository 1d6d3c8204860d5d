//! Surfaces in space.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use crate::{Aabb, Curve, Frame, Interval, NurbsSurface};

/// A surface in space, parametrized as ISO 10303-42 §4.5 does (angles in radians).
#[derive(Clone, Debug)]
pub enum Surface {
    /// `origin + u x + v y`.
    Plane { frame: Frame },
    /// `origin + radius (cos u x + sin u y) + v z`.
    Cylinder { frame: Frame, radius: f64 },
    /// `origin + (radius + v tan half_angle) (cos u x + sin u y) + v z`.
    Cone { frame: Frame, radius: f64, half_angle_rad: f64 },
    /// `origin + radius cos v (cos u x + sin u y) + radius sin v z`.
    Sphere { frame: Frame, radius: f64 },
    /// `origin + (major + minor cos v) (cos u x + sin u y) + minor sin v z`. Where `major < minor` (degenerate
    /// torus) `v_range` holds the part of v that is used: apple or lemon.
    Torus { frame: Frame, major: f64, minor: f64, v_range: Option<Interval> },
    /// `profile(u) + v direction`; `direction` need not be a unit vector.
    Extrusion { profile: Arc<Curve>, direction: DVec3 },
    /// `profile(v)` turned by the angle `u` about the unit `axis` through `origin`.
    Revolution { profile: Arc<Curve>, origin: DVec3, axis: DVec3 },
    /// Tensor product B-spline of any degree, rational or not.
    Nurbs(NurbsSurface),
    /// `basis(u, v) + distance * unit normal`.
    Offset { basis: Arc<Surface>, distance: f64 },
}

/// A point of a surface and its derivatives there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Derivatives {
    /// S
    pub point: DVec3,
    /// ∂S/∂u
    pub du: DVec3,
    /// ∂S/∂v
    pub dv: DVec3,
    /// ∂²S/∂u²
    pub duu: DVec3,
    /// ∂²S/∂u∂v
    pub duv: DVec3,
    /// ∂²S/∂v²
    pub dvv: DVec3,
}

/// The foot of a projection onto a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Parameters.
    pub uv: DVec2,
    /// The point of the surface at `uv`.
    pub point: DVec3,
    /// Its distance from the point that was projected.
    pub distance: f64,
}

/// One of the two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The first parameter.
    U,
    /// The second parameter.
    V,
}

/// An isoparametric line that is a single point: a sphere's pole, a cone's apex, a degenerate spline side.
#[derive(Clone, Copy, Debug)]
pub struct Singularity {
    /// The parameter that is constant along the line.
    pub constant: Direction,
    /// Its value.
    pub at: f64,
    /// The point in space.
    pub point: DVec3,
}

impl Surface {
    /// The point at (u, v). Closed surfaces take any parameter and wrap it; others extrapolate or clamp.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        let _ = uv;
        todo!()
    }

    /// Point and first derivatives (the second are left zero); the fast path.
    pub fn first_derivatives(&self, uv: DVec2) -> Derivatives {
        let _ = uv;
        todo!()
    }

    /// Point, first and second derivatives.
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        let _ = uv;
        todo!()
    }

    /// Unit normal `∂S/∂u x ∂S/∂v`; at singular points the limit from the inside of the domain. `None` where even
    /// that vanishes.
    pub fn normal(&self, uv: DVec2) -> Option<DVec3> {
        let _ = uv;
        todo!()
    }

    /// The natural domain [u, v]: infinite for planes, cylinders' v, ...; one period for closed directions.
    pub fn domain(&self) -> [Interval; 2] {
        todo!()
    }

    /// Per direction [u, v] the period, where the surface closes on itself smoothly or not: 2π for angles, the
    /// domain's length for splines and swept curves whose two sides coincide.
    pub fn periods(&self) -> [Option<f64>; 2] {
        todo!()
    }

    /// The isoparametric lines that are single points, inside or on the border of the domain.
    pub fn singularities(&self) -> Vec<Singularity> {
        todo!()
    }

    /// The parameters of the point of the surface nearest to `point`: closed form for elementary surfaces; for the
    /// rest Newton from `hint`, checked, with a global search where it fails or where no hint is given. `uv` lies in
    /// `domain()`; on a closed direction within half a period of the hint when one is given (so it may leave the domain).
    pub fn project(&self, point: DVec3, hint: Option<DVec2>) -> SurfacePoint {
        let _ = (point, hint);
        todo!()
    }

    /// Points on the grid `us` x `vs`, row-major: index `i * vs.len() + j` is the point at (`us[i]`, `vs[j]`).
    /// Basis values are shared along rows and columns.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Vec<DVec3> {
        let _ = (us, vs);
        todo!()
    }

    /// Sorted parameters in `range` (ends included) of one direction, between which the surface is smooth.
    pub fn breakpoints(&self, direction: Direction, range: Interval) -> Vec<f64> {
        let _ = (direction, range);
        todo!()
    }

    /// A box that holds the surface over a finite `domain`.
    pub fn bounds(&self, domain: [Interval; 2]) -> Aabb {
        let _ = domain;
        todo!()
    }

    /// The exact NURBS form over a finite `domain` (offsets: `None`).
    pub fn to_nurbs(&self, domain: [Interval; 2]) -> Option<NurbsSurface> {
        let _ = domain;
        todo!()
    }

    /// The surface's image under a similarity (rotation, uniform scale, mirror); the parametrization keeps its shape.
    /// Returns also whether the normal's side has flipped relative to the mapped normal (mirrors of elementary surfaces).
    pub fn transformed(&self, map: &DAffine3) -> (Self, bool) {
        let _ = map;
        todo!()
    }

    /// `plane`, `cylinder`, `cone`, `sphere`, `torus`, `extrusion`, `revolution`, `nurbs`, `offset`.
    pub fn kind(&self) -> &'static str {
        todo!()
    }
}
