//! Colours.

/// An sRGB colour with straight alpha, each channel in 0..=1, as CAD files give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgba {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
    /// Opacity: 1 is opaque.
    pub a: f32,
}

impl Rgba {
    /// An opaque colour.
    pub const fn opaque(r: f32, g: f32, b: f32) -> Self {
        Self { r, g, b, a: 1.0 }
    }
}
