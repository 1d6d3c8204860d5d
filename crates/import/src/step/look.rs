//! How things look: colours and visibility by entity.

use trimloop_brep::Rgba;

/// What a style says of an entity, or what it inherits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Look {
    /// Colour of surfaces.
    pub surface: Option<Rgba>,
    /// Colour of curves.
    pub curve: Option<Rgba>,
    /// Whether it is hidden.
    pub hidden: bool,
}

impl Look {
    /// This look where it says something, `below` where it does not.
    pub fn over(self, below: Self) -> Self {
        Self {
            surface: self.surface.or(below.surface),
            curve: self.curve.or(below.curve),
            hidden: self.hidden || below.hidden,
        }
    }
}
