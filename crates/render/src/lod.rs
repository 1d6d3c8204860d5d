//! How levels of detail are chosen.

/// How levels of detail are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lod {
    /// Grids by bounds of the second derivatives and an error on the screen; exact trims in every fragment.
    #[default]
    Adaptive,
}

impl Lod {
    /// All of them, the default first.
    pub const ALL: [Self; 1] = [Self::Adaptive];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Adaptive => "adaptive",
        }
    }

    /// The strategy with a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|lod| lod.name() == name)
    }
}
