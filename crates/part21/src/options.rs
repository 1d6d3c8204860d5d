//! How much a file may cost.

/// Limits for reading; [`Default`] suits files from strangers.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadOptions {
    /// Most bytes the unpacked text may have. Default: 4 GiB.
    pub max_bytes: u64,
    /// Most syntax errors that are kept; one more entry tells how many there were beyond. Default: 10,000.
    pub max_errors: usize,
}

impl Default for ReadOptions {
    fn default() -> Self {
        ReadOptions { max_bytes: 1 << 32, max_errors: 10_000 }
    }
}
