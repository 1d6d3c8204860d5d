//! Lengths and angles as people write them: `0.1mm`, `0.1%`, `20deg`.

use trimloop_mesh::LinearDeflection;

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
