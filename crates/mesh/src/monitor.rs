//! Progress and cancellation.

/// Watches a long run from outside; called from many threads.
pub trait Monitor: Sync {
    /// A face has been finished.
    fn face_done(&self) {}
    /// Whether to stop as soon as possible.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Monitor for Silent {}

/// The run was stopped by its [`Monitor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;
