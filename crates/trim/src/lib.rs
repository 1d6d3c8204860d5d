//! Trim loops in the parameter plane.
//!
//! [`sample_edges`] turns every edge of a part into one polyline that all its faces share; [`TrimDomain::new`] brings a
//! face's loops into its surface's (u, v), unrolled over seams, with the sides that poles and seams add, as plain closed
//! polygons whose inside is the face.

mod band;
mod chord;
mod classify;
mod curve_line;
pub mod curves;
mod cut;
mod domain;
mod edge_samples;
mod mask;
mod nesting;
pub mod polygon;
mod tolerance;
mod unroll;

pub use chord::doubtful_quarters;
pub use classify::{Classifier, Side};
pub use domain::{TrimDomain, TrimError, TrimLoop, TrimVertex};
pub use edge_samples::{EdgeSamples, EdgeSide, SampledEdge, sample_curve, sample_edges};
pub use mask::{MaskError, TrimMask};
pub use tolerance::Tolerance;
