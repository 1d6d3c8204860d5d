//! The nearest point of a curve or surface.
//!
//! Conics and elementary surfaces have closed forms or one bracketed root; swept surfaces come down to their profile;
//! splines and offsets take Newton steps, from a hint or from the best of a cached grid of samples.

mod conic;
mod curve;
mod curve_search;
mod elementary;
mod samples;
mod surface;
mod surface_search;
mod swept;

pub(crate) use samples::SampleGrid;
pub(crate) use swept::axis_touches;
