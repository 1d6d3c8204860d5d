//! How far a curve or a surface is from a chord, and where it may be farthest.

use std::f64::consts::PI;

use glam::DVec3;

/// A quarter of a chord is worth measuring where it may be off by more than this part of the tolerance.
const DOUBT: f64 = 0.7;

/// The quarters of a chord (as shares of its length) at which a surface may be farther off than in its middle, and
/// farther than `tolerance_mm` allows.
///
/// Between two points of a surface with unit `normals`, the height of the surface above the chord is taken for the
/// quartic that has the normals' slopes at the ends and the measured height `middle_mm` in the middle.
pub fn doubtful_quarters(
    chord: DVec3,
    normals: [DVec3; 2],
    middle_mm: f64,
    tolerance_mm: f64,
) -> impl Iterator<Item = f64> {
    let [first, second] = normals.map(|normal| -chord.dot(normal));
    let bulge = middle_mm - (first - second) / 8.0;
    let enough = (DOUBT * tolerance_mm).max(middle_mm.abs());
    [(0.25, 9.0, -3.0), (0.75, 3.0, -9.0)].into_iter().filter_map(move |(share, a, b)| {
        let height = (a * first + b * second) / 64.0 + bulge * 0.5625;
        (height.abs() > enough).then_some(share)
    })
}

/// How far a curve is from its chord (which starts at `a`), by its points at a quarter, the middle and three quarters.
pub(crate) fn sag(a: DVec3, chord: DVec3, points: [DVec3; 3]) -> f64 {
    let offs = points.map(|point| off_chord(a, chord, point));
    let most = offs.map(DVec3::length).into_iter().fold(0.0, f64::max);
    let top = offs[1].try_normalize().and_then(|up| peak(offs.map(|off| off.dot(up))));
    most.max(top.unwrap_or(0.0))
}

/// From a chord (that starts at `a`) to a point, across the chord.
pub(crate) fn off_chord(a: DVec3, chord: DVec3, point: DVec3) -> DVec3 {
    match chord.try_normalize() {
        Some(along) => (point - a).reject_from_normalized(along),
        None => point - a,
    }
}

/// The top of the parabola through three evenly spaced heights, if it lies between the first and the last.
fn peak([first, middle, last]: [f64; 3]) -> Option<f64> {
    let bend = first - 2.0 * middle + last;
    let lean = last - first;
    (bend < 0.0 && lean.abs() < -2.0 * bend).then(|| middle - lean * lean / (8.0 * bend))
}

/// Whether the angle between two vectors is more than `most`, radians.
pub(crate) fn turns_by_more(a: DVec3, b: DVec3, most: f64) -> bool {
    a.dot(b) < most.min(PI).cos() * (a.length_squared() * b.length_squared()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The quarters to measure for the surface z = height(x) over the chord from x = 0 to 1.
    fn quarters(height: fn(f64) -> f64, slope: fn(f64) -> f64) -> Vec<f64> {
        let normal = |x: f64| DVec3::new(-slope(x), 0.0, 1.0).normalize();
        doubtful_quarters(DVec3::X, [normal(0.0), normal(1.0)], height(0.5), 1e-3).collect()
    }

    #[test]
    fn an_arc_is_farthest_off_in_its_middle() {
        assert!(quarters(|x| 0.01 * x * (1.0 - x), |x| 0.01 * (1.0 - 2.0 * x)).is_empty());
    }

    #[test]
    fn a_wave_is_farther_off_before_and_after() {
        let height = |x: f64| 0.02 * x * (1.0 - x) * (1.0 - 2.0 * x);
        let slope = |x: f64| 0.02 * (1.0 - 6.0 * x + 6.0 * x * x);
        assert_eq!(quarters(height, slope), [0.25, 0.75]);
    }
}
