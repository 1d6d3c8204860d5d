//! Lengths and angles as people write them: `0.1mm`, `0.1%`, `20deg`.

use glam::DVec3;
use trimloop_brep::Rgba;
use trimloop_mesh::LinearDeflection;
use trimloop_render::{Background, Direction, Lod, Section};

use crate::arguments::MeshUnit;

const LENGTH_UNITS_MM: [(&str, f64); 8] = [
    ("mm", 1.0),
    ("um", 1e-3),
    ("\u{b5}m", 1e-3),
    ("\u{3bc}m", 1e-3),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", 25.4),
    ("", 1.0),
];

const ANGLE_UNITS_RAD: [(&str, f64); 4] = [
    ("deg", std::f64::consts::PI / 180.0),
    ("\u{b0}", std::f64::consts::PI / 180.0),
    ("rad", 1.0),
    ("", std::f64::consts::PI / 180.0),
];

/// `0.1mm`, `50um`, `0.002in` (millimetres where no unit is given), or `0.1%` of a part's diagonal.
pub fn linear_deflection(text: &str) -> Result<LinearDeflection, String> {
    let (number, unit) = split(text)?;
    if unit == "%" {
        return Ok(LinearDeflection::Relative(number / 100.0));
    }
    let scale = find(&LENGTH_UNITS_MM, unit).ok_or("the unit is one of mm, um, cm, m, in, %")?;
    Ok(LinearDeflection::Absolute(number * scale))
}

/// `20deg` or `0.35rad` (degrees where no unit is given), in radians.
pub fn angular_deflection(text: &str) -> Result<f64, String> {
    let (number, unit) = split(text)?;
    let scale = find(&ANGLE_UNITS_RAD, unit).ok_or("the unit is deg or rad")?;
    let angle_rad = number * scale;
    if angle_rad > std::f64::consts::PI {
        return Err("an angle of at most 180deg is wanted".into());
    }
    Ok(angle_rad)
}

/// `1%` or `0.01`, as a share.
pub fn share(text: &str) -> Result<f64, String> {
    match split(text)? {
        (number, "%") => Ok(number / 100.0),
        (number, "") => Ok(number),
        _ => Err("a share is a number or has a %".into()),
    }
}

/// The unit of a mesh by its name, or `auto`.
pub fn mesh_unit(text: &str) -> Result<MeshUnit, String> {
    let text = text.trim();
    if text.eq_ignore_ascii_case("auto") {
        return Ok(MeshUnit(None));
    }
    let unit = find(&LENGTH_UNITS_MM[..7], text).or_else(|| text.eq_ignore_ascii_case("ft").then_some(304.8));
    unit.map(|mm| MeshUnit(Some(mm))).ok_or_else(|| "the unit is one of mm, m, in, cm, ft, um, auto".into())
}

/// `1280x960`, or `256` for a square.
pub fn pixels(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| match text.trim().parse() {
        Ok(n @ 1..=32_768) => Ok(n),
        _ => Err("a side has 1 to 32768 pixels, e.g. 1280x960".to_owned()),
    };
    let (width, height) = text.split_once(['x', 'X']).unwrap_or((text, text));
    Ok([side(width)?, side(height)?])
}

/// `640,480`.
pub fn place(text: &str) -> Result<[u32; 2], String> {
    let column_and_row = text.split_once(',').and_then(|(x, y)| Some([number(x)?, number(y)?]));
    column_and_row.ok_or_else(|| "a place is a column and a row, e.g. 640,480".into())
}

/// `1`, `4`, or a multiple of 4.
pub fn samples(text: &str) -> Result<u32, String> {
    match text.trim().parse() {
        Ok(n) if [1, 4, 8, 16, 32, 64].contains(&n) => Ok(n),
        _ => Err("one of 1, 4, 8, 16, 32, 64".into()),
    }
}

/// `0.5`, in pixels.
pub fn screen_error(text: &str) -> Result<f64, String> {
    let found: Option<f64> = number(text.trim().trim_end_matches("px"));
    found.filter(|px| (0.05..=100.0).contains(px)).ok_or_else(|| "between 0.05 and 100 pixels".into())
}

/// The name of a strategy.
pub fn lod(text: &str) -> Result<Lod, String> {
    Lod::named(text).ok_or_else(|| format!("one of {}", Lod::ALL.map(Lod::name).join(", ")))
}

/// `iso`, `front`, ... or `30,20`.
pub fn view(text: &str) -> Result<Direction, String> {
    let angles = || {
        let (azimuth, elevation) = text.split_once(',')?;
        let (azimuth_deg, elevation_deg): (f64, f64) = (number(azimuth)?, number(elevation)?);
        let is_usable = azimuth_deg.is_finite() && (-90.0..=90.0).contains(&elevation_deg);
        is_usable.then_some(Direction { azimuth_deg, elevation_deg })
    };
    Direction::named(text).or_else(angles).ok_or_else(|| {
        "one of iso, front, back, left, right, top, bottom, or azimuth and elevation (up to 90) as in 30,20".into()
    })
}

/// `x=10mm`, `-z=0.5in`, `y=-3`.
pub fn section(text: &str) -> Result<Section, String> {
    let wrong = || "a plane is an axis and a length, e.g. x=10mm, -z=0.5in".to_owned();
    let (axis, length) = text.split_once('=').ok_or_else(wrong)?;
    let (sign, axis) = match axis.trim().strip_prefix('-') {
        Some(axis) => (-1.0, axis),
        None => (1.0, axis.trim().trim_start_matches('+')),
    };
    let normal = match axis {
        "x" | "X" => DVec3::X,
        "y" | "Y" => DVec3::Y,
        "z" | "Z" => DVec3::Z,
        _ => return Err(wrong()),
    };
    let length = length.trim();
    let at = length.find(|c: char| c.is_alphabetic() && c != 'e' && c != 'E').unwrap_or(length.len());
    let (value, unit) = length.split_at(at);
    let value: f64 = number(value).filter(|v: &f64| v.is_finite()).ok_or_else(wrong)?;
    let scale = find(&LENGTH_UNITS_MM, unit.trim()).ok_or("the unit is one of mm, um, cm, m, in")?;
    Ok(Section { normal: normal * sign, offset_mm: value * scale * sign })
}

/// `white`, `#202530`, `#ffffff,#c0c8d0`.
pub fn background(text: &str) -> Result<Background, String> {
    match text.split_once(',') {
        Some((top, bottom)) => Ok(Background::Gradient(color(top)?, color(bottom)?)),
        None => Ok(Background::Plain(color(text)?)),
    }
}

fn color(text: &str) -> Result<Rgba, String> {
    let text = text.trim();
    let named = match text.to_ascii_lowercase().as_str() {
        "white" => Some(0xff_ff_ff),
        "black" => Some(0),
        "gray" | "grey" => Some(0x80_80_80),
        "red" => Some(0xff_00_00),
        "green" => Some(0x00_80_00),
        "blue" => Some(0x00_00_ff),
        _ => None,
    };
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let value = named.or_else(|| digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()));
    let value = value.ok_or("a colour is white, black, gray, red, green, blue or #rrggbb")?;
    let channel = |shift: u32| ((value >> shift) & 255) as f32 / 255.0;
    Ok(Rgba::opaque(channel(16), channel(8), channel(0)))
}

fn number<T: std::str::FromStr>(text: &str) -> Option<T> {
    text.trim().parse().ok()
}

fn find(units: &[(&str, f64)], name: &str) -> Option<f64> {
    units.iter().find(|(unit, _)| unit.eq_ignore_ascii_case(name)).map(|(_, scale)| *scale)
}

/// A positive number, and the unit after it.
fn split(text: &str) -> Result<(f64, &str), String> {
    let text = text.trim();
    let unit_start = text
        .char_indices()
        .rev()
        .take_while(|(_, c)| c.is_alphabetic() || *c == '%' || *c == '\u{b0}')
        .last()
        .map_or(text.len(), |(at, _)| at);
    let (number, unit) = text.split_at(unit_start);
    let number = number.trim().parse::<f64>().map_err(|_| "a number with a unit is wanted".to_string())?;
    if number.is_finite() && number > 0.0 {
        Ok((number, unit))
    } else {
        Err("a number above 0 is wanted".into())
    }
}

#[cfg(test)]
mod tests {
    use super::{angular_deflection, linear_deflection};
    use trimloop_mesh::LinearDeflection::{Absolute, Relative};

    #[test]
    fn every_length_unit() {
        let cases = [
            ("0.5", Absolute(0.5)),
            ("0.5mm", Absolute(0.5)),
            ("0.5 mm", Absolute(0.5)),
            ("250um", Absolute(0.25)),
            ("250\u{b5}m", Absolute(0.25)),
            ("2cm", Absolute(20.0)),
            ("1e-3m", Absolute(1.0)),
            ("2IN", Absolute(50.8)),
            ("25%", Relative(0.25)),
        ];
        for (text, expected) in cases {
            assert_eq!(linear_deflection(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn every_angle_unit() {
        let right_angle = std::f64::consts::FRAC_PI_2;
        for (text, expected) in
            [("90", right_angle), ("90deg", right_angle), ("90\u{b0}", right_angle), ("0.5rad", 0.5)]
        {
            assert_eq!(angular_deflection(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_cannot_be_a_tolerance() {
        for text in ["", "mm", "0", "-1mm", "nan", "inf", "1e999mm", "1ft", "1 2mm", "5deg"] {
            assert!(linear_deflection(text).is_err(), "{text}");
        }
        for text in ["", "0", "-5", "200deg", "4rad", "5mm", "5%"] {
            assert!(angular_deflection(text).is_err(), "{text}");
        }
    }
}
