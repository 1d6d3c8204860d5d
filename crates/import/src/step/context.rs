//! What holds for all items of one representation.

use super::units::Units;

/// What holds for all items of one representation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    /// What its numbers mean.
    pub units: Units,
}
