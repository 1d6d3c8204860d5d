//! What a picture looks like.

use glam::DVec3;
use trimloop_brep::Rgba;

use crate::{Lod, Up};

/// Planes that a picture can be cut by.
pub const MOST_SECTIONS: usize = 3;

/// What a picture looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// What is behind the model.
    pub background: Background,
    /// The faces' edges.
    pub edges: EdgeStyle,
    /// Samples of a pixel: 1, 4, or a multiple of 4.
    pub samples: u32,
    /// Pixels that what is drawn may be away from the exact model.
    pub screen_error_px: f64,
    /// The colour of faces without one.
    pub color: Rgba,
    /// What is cut away: all that lies beyond any of these planes.
    pub sections: [Option<Section>; MOST_SECTIONS],
    /// Where the light comes from.
    pub up: Up,
    /// How levels of detail are chosen.
    pub lod: Lod,
    /// What faces are coloured by.
    pub paint: Paint,
    /// What the opacity of faces is multiplied with.
    pub opacity: f32,
    /// Whether faces are drawn; edges alone otherwise.
    pub has_faces: bool,
    /// How wide edges are drawn, pixels.
    pub edge_width_px: f32,
}

/// What faces are coloured by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Paint {
    /// Their own colours.
    #[default]
    Own,
    /// A colour per part.
    Parts,
    /// A colour per kind of surface; [`Paint::of_kind`] tells which.
    Kinds,
    /// The larger of the two principal curvatures, from blue (plane) over green to red.
    Curvature {
        /// The radius of curvature that is red, as are smaller ones; millimetres.
        tightest_mm: f64,
    },
}

impl Paint {
    /// The colour of a kind of surface, as `Surface::kind` names it.
    pub fn of_kind(kind: &str) -> Rgba {
        let [r, g, b] = match kind {
            "plane" => [0.62, 0.68, 0.76],
            "cylinder" => [0.30, 0.62, 0.90],
            "cone" => [0.36, 0.76, 0.48],
            "sphere" => [0.95, 0.73, 0.25],
            "torus" => [0.91, 0.49, 0.24],
            "extrusion" => [0.33, 0.73, 0.74],
            "revolution" => [0.62, 0.49, 0.86],
            "offset" => [0.62, 0.54, 0.42],
            "triangles" => [0.45, 0.45, 0.45],
            _ => [0.86, 0.40, 0.62],
        };
        Rgba::opaque(r, g, b)
    }

    /// The colour of a part, by its index: neighbours differ in hue by the golden angle.
    pub fn of_part(index: usize) -> Rgba {
        let hue = (index as f32 * 0.381_966 + 0.58).fract() * 6.0;
        let channel = |shift: f32| {
            let k = (hue + shift).rem_euclid(6.0);
            0.86 - 0.48 * k.min(4.0 - k).clamp(0.0, 1.0)
        };
        Rgba::opaque(channel(5.0), channel(3.0), channel(1.0))
    }
}

/// What is behind the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// From the upper to the lower border.
    Gradient(Rgba, Rgba),
    /// One colour; transparent with an opacity of 0.
    Plain(Rgba),
}

/// How edges are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EdgeStyle {
    /// Not at all.
    None,
    /// Those that are seen.
    #[default]
    Visible,
    /// Those behind faces too, paler.
    Hidden,
}

/// Everything on the side that `normal` points to is cut away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Unit normal, in the model's coordinates.
    pub normal: DVec3,
    /// Where the plane cuts the normal, millimetres from the origin.
    pub offset_mm: f64,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            background: Background::Gradient(Rgba::opaque(0.93, 0.95, 0.97), Rgba::opaque(0.72, 0.76, 0.81)),
            edges: EdgeStyle::Visible,
            samples: 4,
            screen_error_px: 0.5,
            color: Rgba::opaque(0.73, 0.75, 0.78),
            sections: [None; MOST_SECTIONS],
            up: Up::Z,
            lod: Lod::Adaptive,
            paint: Paint::Own,
            opacity: 1.0,
            has_faces: true,
            edge_width_px: 1.4,
        }
    }
}

/// An sRGB colour as light.
pub(crate) fn linear(color: Rgba) -> [f32; 4] {
    let decode = |c: f32| if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    [decode(color.r), decode(color.g), decode(color.b), color.a]
}

/// Light as a byte of an sRGB colour.
pub(crate) fn encode(c: f32) -> u8 {
    let c = c.clamp(0.0, 1.0);
    let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (c * 255.0 + 0.5) as u8
}
