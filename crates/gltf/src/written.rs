//! What writing gives back.

/// What has been written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// Bytes, of all files together.
    pub bytes: u64,
    /// One per part of the model.
    pub parts: Vec<WrittenPart>,
}

/// What has been written of one part.
///
/// This can be less than its mesh has: hidden faces are left out, and so are triangles of which corners coincide in
/// the precision of the output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WrittenPart {
    /// Visible nodes that show it.
    pub instances: usize,
    /// Triangles of one instance.
    pub triangles: usize,
    /// Vertices of these triangles: a point with several normals or colours counts as often.
    pub vertices: usize,
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
