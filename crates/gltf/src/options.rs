//! What the caller asks of the output.

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
