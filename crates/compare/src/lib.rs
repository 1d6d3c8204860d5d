//! How far two shapes are apart: distances from point to surface both ways, area, volume, moments, topology, and a
//! verdict. A CAD file counts as its exact surfaces, a mesh as its triangles.
//!
//! [`read_mesh`] reads what other programs export, [`choose`] finds out about its unit and axes, [`Shape`] is a side,
//! [`compare()`] measures, [`judge`] decides.

mod baseline;
mod bvh;
mod comparison;
mod convention;
mod distance;
pub mod html;
mod integrals;
mod picture;
mod read;
mod regression;
mod rim;
mod shape;
mod suite;
mod topology;
mod triangles;
mod verdict;

pub use baseline::{Baseline, Blessed, Outcome as BaselineOutcome};
pub use bvh::{Bvh, Hit};
pub use comparison::{
    CompareOptions, Comparison, FaceDistances, PartDistances, Side, Stopped, compare, places_of,
};
pub use convention::{Choice, Convention, Up, choose};
pub use distance::{Distances, Sample, Target};
pub use html::{Detail, Picture, pictures};
pub use integrals::{Figures, figures};
pub use picture::{Spot, View, heat, heat_map, shaded};
pub use read::{MeshError, MeshFile, is_mesh_extension, read_mesh};
pub use regression::{Ran, Status, junit, page, status_of};
pub use rim::Rim;
pub use shape::{Patch, Placed, Shape, mesh_for_comparison};
pub use suite::{Case, Known, Quantities, Suite, SuiteError};
pub use topology::{Topology, topology};
pub use triangles::{Piece, Triangles};
pub use verdict::{Gate, Gates, Judgement, Reach, Verdict, judge};
