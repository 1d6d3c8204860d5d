//! How levels of detail are chosen.

use trimloop_gpu::Backend;

/// How levels of detail are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lod {
    /// Grids by bounds of the second derivatives and an error on the screen; exact trims in every fragment.
    #[default]
    Adaptive,
    /// Krishnamurthy, Khardekar, McMains 2009: even grids, continuous in both directions, by size, distance and bend; trim
    /// textures in place of exact trims.
    Grid,
}

impl Lod {
    /// All of them, the default first.
    pub const ALL: [Self; 2] = [Self::Adaptive, Self::Grid];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Adaptive => "adaptive",
            Self::Grid => "grid",
        }
    }

    /// What evaluates.
    pub(crate) const fn backend(self) -> Backend {
        match self {
            Self::Adaptive => Backend::Bezier,
            Self::Grid => Backend::KrishnamurthyPacked,
        }
    }

    /// The strategy with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|lod| lod.name() == name)
    }
}
