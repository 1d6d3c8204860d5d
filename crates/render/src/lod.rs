//! How levels of detail are chosen.

use trimloop_gpu::{Backend, Wavelet};

/// How levels of detail are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lod {
    /// Grids by bounds of the second derivatives and an error on the screen; exact trims in every fragment.
    #[default]
    Adaptive,
    /// Krishnamurthy, Khardekar, McMains 2009: even grids, continuous in both directions, by size, distance and bend; trim
    /// textures in place of exact trims.
    Grid,
    /// Tan, Zhao, Lu 2012: one fine grid per face, coarser ones from it without evaluating again, by interpolating lifting,
    /// which leaves points where they are; exact trims.
    Wavelet,
    /// The same by Haar wavelets, as published: averages leave the surface and its borders.
    WaveletHaar,
    /// Guthe, Balázs, Klein 2005: per face a tree of rational bicubic patches, and of cubic curves per trim loop, of which
    /// each view takes the coarsest that are near enough; trim textures, and fat borders between patches.
    BezierHierarchy,
}

impl Lod {
    /// All of them, the default first.
    pub const ALL: [Self; 5] =
        [Self::Adaptive, Self::Grid, Self::Wavelet, Self::WaveletHaar, Self::BezierHierarchy];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Adaptive => "adaptive",
            Self::Grid => "grid",
            Self::Wavelet => "wavelet",
            Self::WaveletHaar => "wavelet-haar",
            Self::BezierHierarchy => "bezier-hierarchy",
        }
    }

    /// What evaluates.
    pub(crate) const fn backend(self) -> Backend {
        match self {
            // Of a hierarchy, the faces that have none.
            Self::Adaptive | Self::BezierHierarchy => Backend::Bezier,
            Self::Grid => Backend::KrishnamurthyPacked,
            Self::Wavelet | Self::WaveletHaar => Backend::Tan,
        }
    }

    /// The wavelet that makes coarser levels, if one does.
    pub(crate) const fn wavelet(self) -> Option<Wavelet> {
        match self {
            Self::Adaptive | Self::Grid | Self::BezierHierarchy => None,
            Self::Wavelet => Some(Wavelet::Lifting),
            Self::WaveletHaar => Some(Wavelet::Haar),
        }
    }

    /// Whether trim textures trim, not the exact curves.
    pub(crate) const fn has_masks(self) -> bool {
        matches!(self, Self::Grid | Self::BezierHierarchy)
    }

    /// The strategy with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|lod| lod.name() == name)
    }
}
