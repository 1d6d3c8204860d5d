//! Exact curves and surfaces in f64: evaluate, differentiate, project, bound, convert to NURBS.
//!
//! Lengths are millimetres and angles radians by convention of the workspace; nothing here depends on it.
//! No I/O, no topology. Nothing panics or loops for long on numbers that make no sense (NaN, infinities, zero radii):
//! the results then make no sense either.
//!
//! ```
//! use trimloop_geom::{DVec2, DVec3, Frame, Surface};
//!
//! let cylinder = Surface::Cylinder { frame: Frame::WORLD, radius: 2.0 };
//! let foot = cylinder.project(DVec3::new(3.0, 0.0, 1.0), None);
//! assert_eq!(foot.uv, DVec2::new(0.0, 1.0));
//! assert_eq!(foot.distance, 1.0);
//! assert_eq!(cylinder.normal(foot.uv), Some(DVec3::X));
//! ```

mod aabb;
mod curve;
mod frame;
mod interval;
pub mod nurbs;
mod period;
mod project;
mod surface;
pub mod tspline;

pub use aabb::Aabb;
pub use curve::{CompositeCurve, CompositeSegment, Curve, CurvePoint, OffsetCurve, Polyline};
pub use frame::Frame;
pub use glam::{DAffine3, DMat3, DVec2, DVec3, DVec4};
pub use interval::Interval;
pub use nurbs::{NurbsCurve, NurbsError, NurbsSurface};
pub use surface::{Derivatives, Direction, Singularity, Surface, SurfacePoint};
pub use tspline::TSpline;
