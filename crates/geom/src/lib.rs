//! Exact curves and surfaces in f64: evaluate, differentiate, project, bound, convert to NURBS.
//!
//! Lengths are millimetres and angles radians by convention of the workspace; nothing here depends on it.
//! No I/O, no topology.

mod aabb;
mod curve;
mod frame;
mod interval;
pub mod nurbs;
mod surface;

pub use aabb::Aabb;
pub use curve::{CompositeCurve, CompositeSegment, Curve, CurvePoint, OffsetCurve, Polyline};
pub use frame::Frame;
pub use glam::{DAffine3, DMat3, DVec2, DVec3, DVec4};
pub use interval::Interval;
pub use nurbs::{NurbsCurve, NurbsError, NurbsSurface};
pub use surface::{Derivatives, Direction, Singularity, Surface, SurfacePoint};
