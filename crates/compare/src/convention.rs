//! The unit and the axes of a file, and how to find them where it does not say.

use std::fmt;

use glam::{DAffine3, DMat3, DVec3};
use serde::Serialize;
use trimloop_geom::Aabb;

/// The axis that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// +Y, as glTF has it.
    Y,
    /// +Z, as CAD has it.
    Z,
}

/// How a file's numbers become millimetres with +Z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convention {
    /// Millimetres per unit.
    pub unit_mm: f64,
    /// The axis that points up.
    pub up: Up,
    /// Whether the format or the file says so, rather than habit.
    pub stated: bool,
}

/// A convention, and why it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What was chosen.
    pub convention: Convention,
    /// Why, in a sentence.
    pub reason: String,
}

/// Units that are tried, millimetres.
const UNITS_MM: [f64; 6] = [1.0, 1000.0, 25.4, 10.0, 304.8, 1e-3];
/// Corners of boxes that are no farther apart than this share of the diagonal fit.
const FITS: f64 = 0.02;

impl Convention {
    /// From the file's own coordinates to millimetres with +Z up.
    pub fn to_mm(&self) -> DAffine3 {
        let turn = match self.up {
            Up::Z => DMat3::IDENTITY,
            Up::Y => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        };
        DAffine3::from_mat3(turn * self.unit_mm)
    }
}

impl fmt::Display for Convention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let up = match self.up {
            Up::Y => "+Y",
            Up::Z => "+Z",
        };
        write!(f, "{}, {up} up", unit_name(self.unit_mm))
    }
}

fn unit_name(unit_mm: f64) -> String {
    let known = [(1.0, "mm"), (1000.0, "m"), (25.4, "in"), (10.0, "cm"), (304.8, "ft"), (1e-3, "um")];
    known
        .iter()
        .find(|(mm, _)| *mm == unit_mm)
        .map_or_else(|| format!("{unit_mm} mm"), |(_, name)| (*name).to_owned())
}

/// Chooses unit and axes: what is asked for, else what the file says, unless its box fits that of the `other` shape
/// (millimetres, +Z up) in another way only.
pub fn choose(
    file: Convention,
    bounds: Aabb,
    other: Option<Aabb>,
    unit_mm: Option<f64>,
    up: Option<Up>,
) -> Choice {
    let usual = Convention { unit_mm: unit_mm.unwrap_or(file.unit_mm), up: up.unwrap_or(file.up), ..file };
    let because = |convention: Convention, reason: &str| Choice { convention, reason: reason.to_owned() };
    if unit_mm.is_some() && up.is_some() {
        return because(usual, "as asked for");
    }
    let habit = if file.stated { "as its format says" } else { "as is usual for its format" };
    let Some(other) = other.filter(|b| !b.is_empty() && b.diagonal() > 0.0).filter(|_| !bounds.is_empty())
    else {
        return because(usual, habit);
    };
    let apart = |convention: &Convention| {
        let own = bounds.transformed(&convention.to_mm());
        own.min.distance(other.min).max(own.max.distance(other.max)) / other.diagonal()
    };
    if apart(&usual) <= FITS {
        return because(usual, &format!("{habit}, and the boxes agree"));
    }
    let units: Vec<f64> = unit_mm.map_or_else(|| UNITS_MM.to_vec(), |unit| vec![unit]);
    let other_up = if usual.up == Up::Y { Up::Z } else { Up::Y };
    let ups = if up.is_some() { vec![usual.up] } else { vec![usual.up, other_up] };
    // The usual axis first: the box of a ball or a cube fits any way up.
    let candidates =
        ups.iter().flat_map(|&up| units.iter().map(move |&unit_mm| Convention { unit_mm, up, ..usual }));
    if let Some(fitting) = candidates.into_iter().find(|convention| apart(convention) <= FITS) {
        return because(fitting, "guessed: the boxes agree so, and not as its format has it");
    }
    // The shapes differ. A unit that is wrong shows all the same: in the size.
    let ratio = |convention: &Convention| {
        let own = bounds.transformed(&convention.to_mm()).diagonal();
        (own / other.diagonal()).ln().abs()
    };
    let same_up = units.iter().map(|&unit_mm| Convention { unit_mm, ..usual });
    let by_size = same_up.min_by(|a, b| ratio(a).total_cmp(&ratio(b))).unwrap_or(usual);
    if ratio(&usual) > 1.5 && ratio(&by_size) < 0.2 {
        return because(by_size, "guessed from the size, though the boxes do not agree");
    }
    because(usual, &format!("{habit}; the boxes do not agree"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(size: DVec3) -> Aabb {
        Aabb { min: DVec3::new(1.0, 2.0, 3.0), max: DVec3::new(1.0, 2.0, 3.0) + size }
    }

    const HABIT: Convention = Convention { unit_mm: 1.0, up: Up::Z, stated: false };

    #[test]
    fn habit_is_kept_where_it_fits() {
        let cad = block(DVec3::new(10.0, 20.0, 30.0));
        let choice = choose(HABIT, cad, Some(cad), None, None);
        assert_eq!(choice.convention, HABIT);
    }

    #[test]
    fn another_unit_and_other_axes_are_found() {
        let cad = block(DVec3::new(10.0, 20.0, 30.0));
        for unit_mm in UNITS_MM {
            for up in [Up::Y, Up::Z] {
                let truth = Convention { unit_mm, up, stated: false };
                let file = cad.transformed(&truth.to_mm().inverse());
                let choice = choose(HABIT, file, Some(cad), None, None);
                assert_eq!((choice.convention.unit_mm, choice.convention.up), (unit_mm, up));
                assert_eq!(choice.reason.starts_with("guessed"), truth != HABIT, "{}", choice.reason);
            }
        }
    }

    #[test]
    fn a_cube_stays_the_usual_way_up() {
        let cube = Aabb { min: DVec3::splat(-5.0), max: DVec3::splat(5.0) };
        let gltf = Convention { unit_mm: 1000.0, up: Up::Y, stated: true };
        assert_eq!(
            choose(gltf, cube, Some(cube), None, None).convention,
            Convention { unit_mm: 1.0, ..gltf }
        );
    }

    #[test]
    fn what_is_asked_for_is_not_guessed() {
        let cad = block(DVec3::new(10.0, 20.0, 30.0));
        let choice = choose(HABIT, cad, Some(cad), Some(25.4), Some(Up::Z));
        assert_eq!(choice.convention.unit_mm, 25.4);
    }
}
