//! What CAD file entities mean: STEP (AP203, AP214, AP242) to the exact model.

use std::path::Path;

use trimloop_brep::Model;

/// What the caller wants of an import.
#[derive(Clone, Debug)]
pub struct ImportOptions {
    /// The most bytes a packed file may unpack to.
    pub max_unpacked_bytes: u64,
}

impl Default for ImportOptions {
    /// 4 GiB.
    fn default() -> Self {
        Self { max_unpacked_bytes: 4 << 30 }
    }
}

/// Why nothing could be imported.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file could not be read as an exchange file.
    #[error(transparent)]
    Part21(#[from] trimloop_part21::ReadError),
    /// Nothing in it is geometry that can be shown.
    #[error("{0}")]
    Nothing(String),
}

/// Reads a CAD file, whatever its format (by content, not by name).
pub fn read(path: &Path, options: &ImportOptions) -> Result<Model, ImportError> {
    let _ = (path, options);
    todo!()
}

/// The exact model of a parsed STEP file.
pub fn import_step(exchange: &trimloop_part21::Exchange) -> Result<Model, ImportError> {
    let _ = exchange;
    todo!()
}
