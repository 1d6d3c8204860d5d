//! Units of measure, per representation context.

use rustc_hash::FxHashMap;

use super::attributes::Attributes;
use super::keyword::Kind;
use super::table::Table;

/// What a representation's numbers mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// Millimetres per length unit.
    pub length_mm: f64,
    /// Radians per plane angle unit.
    pub angle_rad: f64,
    /// The accuracy that the context states, millimetres; 0 when it states none.
    pub uncertainty_mm: f64,
}

impl Default for Units {
    /// Millimetres and radians, what files without units mean.
    fn default() -> Self {
        Self { length_mm: 1.0, angle_rad: 1.0, uncertainty_mm: 0.0 }
    }
}

/// A unit of length or plane angle.
#[derive(Clone, Debug, PartialEq)]
enum Unit {
    /// Millimetres per unit, and its name.
    Length(f64, String),
    /// Radians per unit, and its name.
    Angle(f64, String),
}

/// The units of every representation context of a file.
#[derive(Debug, Default)]
pub(crate) struct UnitTable {
    contexts: FxHashMap<usize, Units>,
    fallback: Units,
    /// Names of the length units, in file order, each once.
    pub length_names: Vec<String>,
    /// Names of the plane angle units, in file order, each once.
    pub angle_names: Vec<String>,
    /// Whether some context gives no length unit.
    pub contexts_without_length: Vec<usize>,
}

impl UnitTable {
    /// Reads every context that assigns units.
    pub fn new(table: &Table<'_>) -> Self {
        let mut units = Self::default();
        for context in table.of(&[Kind::GlobalUnitAssignedContext]) {
            let read = units.read_context(table, context);
            if units.contexts.is_empty() {
                units.fallback = read;
            }
            units.contexts.insert(context, read);
        }
        units
    }

    /// The units of a context; those of the file's first context where it assigns none.
    pub fn of_context(&self, context: Option<usize>) -> Units {
        context.and_then(|context| self.contexts.get(&context)).copied().unwrap_or(self.fallback)
    }

    fn read_context(&mut self, table: &Table<'_>, context: usize) -> Units {
        let mut units = Units::default();
        let mut has_length = false;
        let assigned = Attributes::of_part(table, context, "GLOBAL_UNIT_ASSIGNED_CONTEXT");
        for unit in assigned.map(|mut part| last_list(&mut part)).unwrap_or_default() {
            match read_unit(table, unit, 0) {
                Some(Unit::Length(scale, name)) => {
                    units.length_mm = scale;
                    has_length = true;
                    remember(&mut self.length_names, name);
                }
                Some(Unit::Angle(scale, name)) => {
                    units.angle_rad = scale;
                    remember(&mut self.angle_names, name);
                }
                None => {}
            }
        }
        if !has_length {
            self.contexts_without_length.push(context);
        }
        units.uncertainty_mm = read_uncertainty(table, context);
        units
    }
}

/// The last list among the attributes: of a simple instance with inherited attributes, too, the units.
fn last_list(attributes: &mut Attributes<'_>) -> Vec<usize> {
    let mut found = Vec::new();
    for _ in 0..8 {
        let mut ahead = attributes.clone();
        if ahead.param().is_none() {
            break;
        }
        if let Ok(list) = attributes.clone().references("units") {
            found = list;
        }
        *attributes = ahead;
    }
    found
}

fn remember(names: &mut Vec<String>, name: String) {
    if !names.contains(&name) {
        names.push(name);
    }
}

/// The largest stated length uncertainty of a context, millimetres.
fn read_uncertainty(table: &Table<'_>, context: usize) -> f64 {
    let instance = table.instance(context);
    let Some(_) = instance.part("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT") else { return 0.0 };
    let part = Attributes::of_part(table, context, "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT");
    let measures = part.map(|mut part| part.found_references()).unwrap_or_default();
    let in_mm = measures.into_iter().filter_map(|measure| match read_measure(table, measure, 0)? {
        (value, Unit::Length(scale, _)) => Some(value * scale),
        _ => None,
    });
    in_mm.filter(|value| value.is_finite() && *value > 0.0).fold(0.0, f64::max)
}

/// Value and unit of a measure_with_unit.
fn read_measure(table: &Table<'_>, index: usize, depth: usize) -> Option<(f64, Unit)> {
    let mut attributes = Attributes::of_part(table, index, "MEASURE_WITH_UNIT")?;
    let value = attributes.real("value").ok()?;
    let unit = attributes.reference("unit").ok()?;
    Some((value, read_unit(table, unit, depth + 1)?))
}

fn read_unit(table: &Table<'_>, index: usize, depth: usize) -> Option<Unit> {
    if depth > 8 {
        return None;
    }
    match table.kind(index) {
        Kind::SiUnit => read_si_unit(table, index),
        Kind::ConversionBasedUnit => read_conversion(table, index, depth),
        _ => None,
    }
}

/// `si_unit`: prefix and name (ISO 10303-41).
fn read_si_unit(table: &Table<'_>, index: usize) -> Option<Unit> {
    let mut attributes = Attributes::of_part(table, index, "SI_UNIT")?;
    if !table.instance(index).is_complex() {
        attributes.skip(1);
    }
    let prefix = attributes.enumeration();
    let factor = si_factor(prefix)?;
    let prefix = prefix.unwrap_or_default().to_ascii_lowercase();
    match attributes.enumeration()? {
        "METRE" => Some(Unit::Length(factor * 1000.0, format!("{prefix}metre"))),
        "RADIAN" => Some(Unit::Angle(factor, format!("{prefix}radian"))),
        _ => None,
    }
}

fn si_factor(prefix: Option<&str>) -> Option<f64> {
    let exponent = match prefix {
        None => 0,
        Some("EXA") => 18,
        Some("PETA") => 15,
        Some("TERA") => 12,
        Some("GIGA") => 9,
        Some("MEGA") => 6,
        Some("KILO") => 3,
        Some("HECTO") => 2,
        Some("DECA") => 1,
        Some("DECI") => -1,
        Some("CENTI") => -2,
        Some("MILLI") => -3,
        Some("MICRO") => -6,
        Some("NANO") => -9,
        Some("PICO") => -12,
        Some("FEMTO") => -15,
        Some("ATTO") => -18,
        Some(_) => return None,
    };
    Some(10f64.powi(exponent))
}

/// `conversion_based_unit`: a name and a factor in another unit; the name alone where the factor is unusable.
fn read_conversion(table: &Table<'_>, index: usize, depth: usize) -> Option<Unit> {
    let mut attributes = Attributes::of_part(table, index, "CONVERSION_BASED_UNIT")?;
    if !table.instance(index).is_complex() {
        attributes.skip(1);
    }
    let name = attributes.text().to_ascii_lowercase();
    let factor = attributes.optional_reference().and_then(|measure| read_measure(table, measure, depth));
    match factor {
        Some((value, Unit::Length(scale, _))) if value > 0.0 => Some(Unit::Length(value * scale, name)),
        Some((value, Unit::Angle(scale, _))) if value > 0.0 => Some(Unit::Angle(value * scale, name)),
        _ => unit_by_name(name),
    }
}

fn unit_by_name(name: String) -> Option<Unit> {
    match name.as_str() {
        "inch" | "inches" | "in" => Some(Unit::Length(25.4, name)),
        "foot" | "feet" | "ft" => Some(Unit::Length(304.8, name)),
        "yard" => Some(Unit::Length(914.4, name)),
        "mile" => Some(Unit::Length(1_609_344.0, name)),
        "millimetre" | "millimeter" | "mm" => Some(Unit::Length(1.0, name)),
        "degree" | "degrees" | "deg" => Some(Unit::Angle(1f64.to_radians(), name)),
        _ => None,
    }
}
