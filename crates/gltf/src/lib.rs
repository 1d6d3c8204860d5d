//! Triangles to glTF 2.0: the only place with metres, Y-up and f32.

use std::io::Write;

use trimloop_brep::Model;
use trimloop_mesh::PartMesh;

/// Which axis of the output points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// +Y, as glTF asks.
    #[default]
    Y,
    /// +Z, as the file has it.
    Z,
}

/// What goes into the output.
#[derive(Clone, Copy, Debug, Default)]
pub struct GltfOptions {
    /// Up axis.
    pub up: UpAxis,
    /// Write the faces' edges as `LINES`.
    pub edges: bool,
    /// Write `_FEATURE_ID_0` and `extras.face_entities`.
    pub face_ids: bool,
    /// `KHR_mesh_quantization`.
    pub quantize: bool,
    /// `EXT_meshopt_compression`.
    pub meshopt: bool,
}

/// Why nothing could be written.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// Writing failed.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The result does not fit a GLB (4 GiB).
    #[error("the result has {0} bytes; a GLB holds at most 4 GiB")]
    TooLarge(u64),
}

/// Writes a GLB. `meshes[i]` belongs to `model.parts[i]`.
pub fn write_glb(
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
    out: &mut dyn Write,
) -> Result<(), GltfError> {
    let _ = (model, meshes, options, out);
    todo!()
}

/// Writes a `.gltf` (JSON) that refers to `bin_uri`, and the buffer itself to `bin`.
pub fn write_gltf(
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
    bin_uri: &str,
    json: &mut dyn Write,
    bin: &mut dyn Write,
) -> Result<(), GltfError> {
    let _ = (model, meshes, options, bin_uri, json, bin);
    todo!()
}
