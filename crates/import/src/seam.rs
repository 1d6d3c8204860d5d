//! Spline surfaces that close but for the digits that the file was written with.

use glam::DVec3;
use trimloop_geom::Aabb;

/// A gap along a seam is closed where it is no wider than this share of the control net's size: coordinates of six digits
/// leave as much. Without that the two sides of the seam would be one edge in space and two in the parameter plane.
const WIDEST_SHARE: f64 = 1e-5;

/// So many times the gap the surface must lie apart from its seam to close round anything.
const LEAST_AWAY: f64 = 1e3;

/// Makes the last row (or column) of a control net the first one, where they all but coincide and the surface ends in
/// both. `points` and `weights` row by row, `knots` and `degrees` along u and v.
pub(crate) fn close_seams(
    degrees: [usize; 2],
    shape: [usize; 2],
    points: &mut [DVec3],
    weights: &[f64],
    knots: &[Vec<f64>; 2],
) {
    let [rows, columns] = shape;
    if rows.checked_mul(columns) != Some(points.len()) || !weights.is_empty() && weights.len() != points.len()
    {
        return;
    }
    let widest = WIDEST_SHARE * Aabb::from_points(points.iter().copied()).diagonal();
    for direction in 0..2 {
        // Line `k` of the net across this direction, and the place along it.
        let at =
            |k: usize, along: usize| if direction == 0 { k * columns + along } else { along * columns + k };
        let (count, length) = if direction == 0 { (rows, columns) } else { (columns, rows) };
        if count < 3 || !is_clamped(&knots[direction], degrees[direction]) {
            continue;
        }
        let apart =
            |k: usize| (0..length).map(|i| points[at(0, i)].distance(points[at(k, i)])).fold(0.0, f64::max);
        let gap = apart(count - 1);
        let even = |i: usize| {
            let [first, last] = [at(0, i), at(count - 1, i)].map(|i| weights.get(i).copied().unwrap_or(1.0));
            (first - last).abs() <= 1e-9 * first.abs()
        };
        let away = || (1..count - 1).map(apart).fold(0.0, f64::max);
        if gap > 0.0 && gap <= widest && away() >= LEAST_AWAY * gap && (0..length).all(even) {
            (0..length).for_each(|i| points[at(count - 1, i)] = points[at(0, i)]);
        }
    }
}

/// Whether a spline starts and ends in its first and last control points.
fn is_clamped(knots: &[f64], degree: usize) -> bool {
    let same = |ends: &[f64]| ends.first() == ends.last();
    knots.len() > 2 * degree && same(&knots[..=degree]) && same(&knots[knots.len() - 1 - degree..])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square tube of side 10 along y whose last corner misses the first by `gap`.
    fn tube(gap: f64) -> Vec<DVec3> {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0], [gap, 0.0]];
        corners.into_iter().flat_map(|[x, z]| [DVec3::new(x, 0.0, z), DVec3::new(x, 5.0, z)]).collect()
    }

    fn closed(gap: f64) -> bool {
        let knots = [vec![0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0], vec![0.0, 0.0, 1.0, 1.0]];
        let mut points = tube(gap);
        close_seams([1, 1], [5, 2], &mut points, &[], &knots);
        points[8] == points[0] && points[9] == points[1]
    }

    #[test]
    fn seams_close_where_only_digits_keep_them_apart() {
        assert!(closed(0.0) && closed(2e-5));
        assert!(!closed(1e-3));
    }

    #[test]
    fn a_narrow_strip_stays_a_strip() {
        let knots = [vec![0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 1.0]];
        let row = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 100.0, 0.0)];
        let before = [row(0.0), row(2e-4), row(4e-4)].concat();
        let mut points = before.clone();
        close_seams([1, 1], [3, 2], &mut points, &[], &knots);
        assert_eq!(points, before);
    }
}
