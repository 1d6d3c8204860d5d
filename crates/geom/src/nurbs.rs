//! B-spline curves and surfaces, rational or not: evaluation, knot insertion, degree elevation, Bézier pieces.
//!
//! Names and algorithms follow Piegl & Tiller, *The NURBS Book*, 2nd edition (cited as A*n.m*).

pub(crate) mod arc;
pub(crate) mod basis;
mod bezier;
mod blossom;
mod closure;
pub(crate) mod control;
mod curve;
mod edit_curve;
mod edit_surface;
pub(crate) mod knots;
mod surface;
mod sweep;

pub use basis::{basis_functions, find_span};
pub use bezier::{BezierCurve, BezierGrid, BezierPatch};
pub use curve::NurbsCurve;
pub(crate) use curve::sample_parameters;
pub(crate) use edit_curve::joined;
pub use knots::MAX_DEGREE;
pub use surface::NurbsSurface;

/// Why a B-spline cannot be built.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsError(pub String);

impl std::fmt::Display for NurbsError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NurbsError {}
