//! Surfaces in space.

mod bounds;
mod breakpoints;
mod evaluate;
mod exact;
mod grid;
mod normal;
mod offset;
mod revolve;
mod singularities;
mod transform;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::{Curve, Frame, Interval, NurbsSurface};

pub(crate) use revolve::Meridian;

/// A surface in space, parametrized as ISO 10303-42 §4.5 does (angles in radians).
///
/// ```
/// use trimloop_geom::{DVec2, DVec3, Frame, Surface};
/// let sphere = Surface::Sphere { frame: Frame::WORLD, radius: 2.0 };
/// assert_eq!(sphere.point(DVec2::ZERO), DVec3::new(2.0, 0.0, 0.0));
/// assert_eq!(sphere.normal(DVec2::ZERO), Some(DVec3::X));
/// assert_eq!(sphere.project(DVec3::new(0.0, 0.0, 5.0), None).distance, 3.0);
/// ```
#[derive(Clone, Debug)]
pub enum Surface {
    /// `origin + u x + v y`.
    Plane {
        /// Origin and axes.
        frame: Frame,
    },
    /// `origin + radius (cos u x + sin u y) + v z`.
    Cylinder {
        /// Origin and axes; z is the axis.
        frame: Frame,
        /// Radius.
        radius: f64,
    },
    /// `origin + (radius + v tan half_angle) (cos u x + sin u y) + v z`. Both nappes: the radius may become
    /// negative.
    Cone {
        /// Origin and axes; z is the axis.
        frame: Frame,
        /// Radius at v = 0.
        radius: f64,
        /// Angle between axis and generator; negative where the cone narrows towards +z.
        half_angle_rad: f64,
    },
    /// `origin + radius cos v (cos u x + sin u y) + radius sin v z`.
    Sphere {
        /// Centre and axes; z points to the pole at v = π/2.
        frame: Frame,
        /// Radius.
        radius: f64,
    },
    /// `origin + (major + minor cos v) (cos u x + sin u y) + minor sin v z`.
    Torus {
        /// Centre and axes; z is the axis.
        frame: Frame,
        /// Radius of the circle of centres.
        major: f64,
        /// Radius of the tube.
        minor: f64,
        /// Where `major < minor` (degenerate torus): the part of v that is used, apple or lemon.
        v_range: Option<Interval>,
    },
    /// `profile(u) + v direction`; `direction` need not be a unit vector.
    Extrusion {
        /// The curve that is swept.
        profile: Arc<Curve>,
        /// What a unit of v adds.
        direction: DVec3,
    },
    /// `profile(v)` turned by the angle `u` about the unit `axis` through `origin`.
    Revolution {
        /// The curve that is turned.
        profile: Arc<Curve>,
        /// A point of the axis.
        origin: DVec3,
        /// Unit vector along the axis.
        axis: DVec3,
    },
    /// Tensor product B-spline of any degree, rational or not.
    Nurbs(NurbsSurface),
    /// `basis(u, v) + distance * unit normal`.
    Offset {
        /// The surface that is offset.
        basis: Arc<Surface>,
        /// Signed distance along the basis' normal.
        distance: f64,
    },
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
    /// The natural domain [u, v]: infinite for planes, cylinders' v, ...; one period for closed directions.
    pub fn domain(&self) -> [Interval; 2] {
        let turn = Interval::new(0.0, TAU);
        match self {
            Self::Plane { .. } => [Interval::INFINITE; 2],
            Self::Cylinder { .. } | Self::Cone { .. } => [turn, Interval::INFINITE],
            Self::Sphere { .. } => [turn, Interval::new(-FRAC_PI_2, FRAC_PI_2)],
            Self::Torus { v_range, .. } => [turn, v_range.unwrap_or(turn)],
            Self::Extrusion { profile, .. } => [profile.domain(), Interval::INFINITE],
            Self::Revolution { profile, .. } => [turn, profile.domain()],
            Self::Nurbs(nurbs) => nurbs.domain(),
            Self::Offset { basis, .. } => basis.domain(),
        }
    }

    /// Per direction [u, v] the period, where the surface closes on itself smoothly or not: 2π for angles, the
    /// domain's length for splines and swept curves whose two sides coincide.
    pub fn periods(&self) -> [Option<f64>; 2] {
        match self {
            Self::Plane { .. } => [None, None],
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Sphere { .. } => [Some(TAU), None],
            Self::Torus { v_range, .. } => [Some(TAU), v_range.is_none().then_some(TAU)],
            Self::Extrusion { profile, .. } => [profile.period(), None],
            Self::Revolution { profile, .. } => [Some(TAU), profile.period()],
            Self::Nurbs(nurbs) => nurbs.periods(),
            Self::Offset { basis, .. } => basis.periods(),
        }
    }

    /// `plane`, `cylinder`, `cone`, `sphere`, `torus`, `extrusion`, `revolution`, `nurbs`, `offset`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Plane { .. } => "plane",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Sphere { .. } => "sphere",
            Self::Torus { .. } => "torus",
            Self::Extrusion { .. } => "extrusion",
            Self::Revolution { .. } => "revolution",
            Self::Nurbs(_) => "nurbs",
            Self::Offset { .. } => "offset",
        }
    }
}
