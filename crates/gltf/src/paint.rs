//! Colours as glTF materials.

use gltf::json::material::{AlphaMode, Material, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::validation::Checked;
use trimloop_brep::Rgba;

/// How rough what has a colour looks: between plastic and brushed metal.
const ROUGHNESS: f32 = 0.5;

/// The colour of the faces' edges: they must stand out from any face.
const EDGE_COLOR: Rgba = Rgba::opaque(0.1, 0.1, 0.1);

/// What a primitive shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Role {
    /// Faces of a solid: their backs are never seen.
    Solid,
    /// Faces of a sheet, seen from both sides.
    Sheet,
    /// Free curves.
    Curves,
    /// The edges of faces.
    Edges,
}

/// A colour that can be a key: each channel's bits, after clamping to 0..=1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct ColorKey([u32; 4]);

impl ColorKey {
    fn channels(self) -> [f32; 4] {
        self.0.map(f32::from_bits)
    }
}

impl From<Rgba> for ColorKey {
    fn from(color: Rgba) -> Self {
        // NaN becomes 0, and adding zero turns -0.0 into 0.0.
        Self(
            [color.r, color.g, color.b, color.a]
                .map(|c| (if c.is_nan() { 0.0 } else { c.clamp(0.0, 1.0) } + 0.0).to_bits()),
        )
    }
}

/// How a primitive is painted, by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Paint {
    /// What it shows.
    pub(crate) role: Role,
    /// Its own colour.
    pub(crate) color: Option<ColorKey>,
}

/// What a node's use of a mesh does to its colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) enum Tint {
    /// Nothing.
    #[default]
    None,
    /// Stands over all colours.
    Over(ColorKey),
    /// Colours what has none of its own.
    Under(ColorKey),
}

/// A material of the output; equal ones are written once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Finish {
    color: Option<ColorKey>,
    double_sided: bool,
}

impl Paint {
    /// The material of this paint under a tint. Even what has no colour gets one: glTF's default is all metal.
    pub(crate) fn finish(&self, tint: Tint) -> Finish {
        let color = match (self.role, tint) {
            (Role::Edges, _) => Some(EDGE_COLOR.into()),
            (_, Tint::Over(color)) => Some(color),
            (_, Tint::Under(color)) => self.color.or(Some(color)),
            (_, Tint::None) => self.color,
        };
        Finish { color, double_sided: self.role == Role::Sheet }
    }
}

impl Finish {
    /// The glTF material, named after its sRGB colour.
    pub(crate) fn material(&self) -> Material {
        let color = self.color.map(ColorKey::channels);
        let [r, g, b, a] = color.unwrap_or([1.0; 4]);
        let base_color_factor = PbrBaseColorFactor([linear(r), linear(g), linear(b), a]);
        Material {
            name: color.map(hex),
            alpha_mode: Checked::Valid(if a < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque }),
            double_sided: self.double_sided,
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor,
                metallic_factor: StrengthFactor(0.0),
                roughness_factor: StrengthFactor(ROUGHNESS),
                ..PbrMetallicRoughness::default()
            },
            ..Material::default()
        }
    }
}

/// sRGB to linear (IEC 61966-2-1).
fn linear(c: f32) -> f32 {
    let c = f64::from(c);
    (if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }) as f32
}

/// `#rrggbb`, with `aa` where it is not opaque.
fn hex(color: [f32; 4]) -> String {
    let [r, g, b, a] = color.map(|c| (c * 255.0).round() as u8);
    if color[3] < 1.0 { format!("#{r:02x}{g:02x}{b:02x}{a:02x}") } else { format!("#{r:02x}{g:02x}{b:02x}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paint(role: Role, color: Option<Rgba>) -> Paint {
        Paint { role, color: color.map(ColorKey::from) }
    }

    #[test]
    fn srgb_becomes_linear_by_the_standard() {
        for (srgb, want) in [(0.0, 0.0), (0.04045, 0.003_130_8), (0.5, 0.214_041_14), (1.0, 1.0)] {
            assert!((linear(srgb) - want).abs() < 1e-7, "{srgb}");
        }
    }

    #[test]
    fn a_material_is_a_dielectric_of_its_colour() {
        let glass = Rgba { r: 1.0, g: 0.5, b: 0.0, a: 0.25 };
        let material = paint(Role::Solid, Some(glass)).finish(Tint::None).material();
        assert_eq!(material.alpha_mode, Checked::Valid(AlphaMode::Blend));
        assert_eq!(material.pbr_metallic_roughness.metallic_factor.0, 0.0);
        assert_eq!(material.pbr_metallic_roughness.base_color_factor.0, [1.0, linear(0.5), 0.0, 0.25]);
        assert_eq!(material.name.as_deref(), Some("#ff800040"));
        assert!(!material.double_sided);
    }

    #[test]
    fn what_has_no_colour_is_no_metal_either() {
        let plain = paint(Role::Solid, None).finish(Tint::None).material();
        assert_eq!(plain.pbr_metallic_roughness.metallic_factor.0, 0.0);
        assert!(paint(Role::Sheet, None).finish(Tint::None).material().double_sided);
    }

    #[test]
    fn a_use_may_paint_over_or_under() {
        let red = Rgba::opaque(1.0, 0.0, 0.0);
        let blue = Rgba::opaque(0.0, 0.0, 1.0);
        let finish = |own, tint| paint(Role::Solid, own).finish(tint);
        assert_eq!(finish(Some(red), Tint::Over(blue.into())), finish(Some(blue), Tint::None));
        assert_eq!(finish(Some(red), Tint::Under(blue.into())), finish(Some(red), Tint::None));
        assert_eq!(finish(None, Tint::Under(blue.into())), finish(Some(blue), Tint::None));
        let edges = paint(Role::Edges, None);
        assert_eq!(edges.finish(Tint::Over(blue.into())), edges.finish(Tint::None));
    }

    #[test]
    fn channels_outside_their_range_are_clamped() {
        let odd = Rgba { r: -1.0, g: 7.0, b: f32::NAN, a: -0.0 };
        assert_eq!(ColorKey::from(odd).channels(), [0.0, 1.0, 0.0, 0.0]);
    }
}
