//! What can go wrong.

use trimloop_gpu::GpuError;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The device refuses.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A picture of no pixels, or of more than can be.
    #[error("a picture of {0} x {1} pixels cannot be drawn: each side has 1 to {MOST_PIXELS} pixels")]
    Size(u32, u32),
    /// Somebody stopped it.
    #[error(transparent)]
    Cancelled(#[from] trimloop_mesh::Cancelled),
    /// The file cannot be encoded.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// Pixels along a side.
pub(crate) const MOST_PIXELS: u32 = 32_768;
