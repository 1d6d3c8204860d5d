//! The Global section (IGES 5.3 section 2.2.4.3): what holds for the whole file.

use crate::Delimiters;
use crate::value::{After, Value, next};

/// What holds for the whole file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Global {
    /// What stands between parameters and after them.
    pub delimiters: Delimiters,
    /// The sending system's name for the product.
    pub product: String,
    /// The name the file was given.
    pub file_name: String,
    /// The system that the model comes from.
    pub system: String,
    /// The program that wrote the file.
    pub preprocessor: String,
    /// The receiving system's name for the product.
    pub receiver: String,
    /// Model space units per real unit; 1 where the file does not say.
    pub scale: f64,
    /// The number of the unit of length: 1 inches, 2 millimetres, 3 as the name says, ...
    pub unit_flag: i64,
    /// The name of the unit of length.
    pub unit_name: String,
    /// How fine the model is, in units of length: points nearer than this are the same.
    pub resolution: f64,
    /// The largest coordinate; 0 where the file does not say.
    pub max_coordinate: f64,
    /// Who made the model.
    pub author: String,
    /// Where.
    pub organization: String,
    /// The number of the specification's version: 8 is 5.0, 9 is 5.1, 10 is 5.2, 11 is 5.3.
    pub version: i64,
    /// When the file was written, as it says.
    pub date: String,
    /// How many parameters the section has.
    pub parameter_count: usize,
}

/// The place of the last parameter that says how large things are: the name of the unit.
pub(crate) const LAST_OF_UNITS: usize = 15;

impl Global {
    /// The section whose lines' texts, one after the other, are `text`.
    pub(crate) fn parse(text: &[u8]) -> Self {
        let (delimiters, at) = Delimiters::of_global(text);
        let mut rest = &text[at..];
        let mut values = vec![Value::Default, Value::Default];
        for _ in 2..26 {
            let (value, after, then) = next(rest, delimiters);
            values.push(value);
            if after != After::Parameter {
                break;
            }
            rest = then;
        }
        let parameter_count = values.len();
        values.resize(26, Value::Default);
        let text = |k: usize| values[k - 1].text().map(|text| text.trim().to_owned()).unwrap_or_default();
        let real = |k: usize| values[k - 1].real().filter(|value| value.is_finite());
        let positive = |k: usize| real(k).filter(|value| *value > 0.0);
        Self {
            delimiters,
            product: text(3),
            file_name: text(4),
            system: text(5),
            preprocessor: text(6),
            receiver: text(12),
            scale: positive(13).unwrap_or(1.0),
            unit_flag: values[13].integer().unwrap_or(1),
            unit_name: text(15),
            date: text(18),
            resolution: positive(19).unwrap_or(0.0),
            max_coordinate: positive(20).unwrap_or(0.0),
            author: text(21),
            organization: text(22),
            version: values[22].integer().unwrap_or(3),
            parameter_count,
        }
    }

    /// How many millimetres a unit of length is; `None` where neither flag nor name says.
    pub fn unit_mm(&self) -> Option<f64> {
        let by_flag = match self.unit_flag {
            1 => Some("IN"),
            2 => Some("MM"),
            4 => Some("FT"),
            5 => Some("MI"),
            6 => Some("M"),
            7 => Some("KM"),
            8 => Some("MIL"),
            9 => Some("UM"),
            10 => Some("CM"),
            11 => Some("UIN"),
            _ => None,
        };
        by_flag.and_then(millimetres).or_else(|| millimetres(&self.unit_name.to_ascii_uppercase()))
    }
}

fn millimetres(name: &str) -> Option<f64> {
    Some(match name {
        "IN" | "INCH" => 25.4,
        "MM" => 1.0,
        "FT" => 304.8,
        "MI" => 1_609_344.0,
        "M" => 1000.0,
        "KM" => 1e6,
        "MIL" => 0.0254,
        "UM" => 1e-3,
        "CM" => 10.0,
        "UIN" => 25.4e-6,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_where_the_specification_has_them() {
        let text = "1H,,1H;,4Hpart,8Hpart.igs,3HCAD,3Hpre,32,38,6,308,15,5Hthere,2.,3,2HCM,1,0.01,\
                    15H20240102.030405,1.E-4,1000.,2Hme,4Hhere,11,0,;";
        let global = Global::parse(text.as_bytes());
        assert_eq!((global.product.as_str(), global.file_name.as_str()), ("part", "part.igs"));
        assert_eq!((global.system.as_str(), global.receiver.as_str()), ("CAD", "there"));
        assert_eq!((global.scale, global.unit_mm(), global.resolution), (2.0, Some(10.0), 1e-4));
        assert_eq!((global.author.as_str(), global.version), ("me", 11));
    }

    #[test]
    fn what_is_left_out_has_its_default() {
        let global = Global::parse(b",,;");
        assert_eq!((global.scale, global.unit_mm(), global.version), (1.0, Some(25.4), 3));
    }
}
