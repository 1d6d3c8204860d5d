//! Tolerance-bound, watertight triangles for a part.
//!
//! Every edge is sampled once, by the tolerance of all its faces; faces are filled afterwards and never move an edge's
//! points, so that neighbours share their vertices.

mod monitor;
mod options;
mod part_mesh;

pub use monitor::{Cancelled, Monitor, Silent};
pub use options::{LinearDeflection, MeshOptions};
pub use part_mesh::{CurveLine, EdgeLine, FaceMesh, FaceStatus, FaceVertex, PartMesh, ShellTopology};

use trimloop_brep::Part;

/// Meshes one part.
pub fn mesh_part(part: &Part, options: &MeshOptions, monitor: &dyn Monitor) -> Result<PartMesh, Cancelled> {
    let _ = (part, options, monitor);
    todo!()
}
