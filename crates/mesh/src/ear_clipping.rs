//! Any closed polygon in space as triangles.

use glam::{DVec2, DVec3};
use trimloop_trim::polygon::signed_area;

/// Beyond this many corners a polygon is cut as a fan: ear clipping takes cubic time.
const MAX_CORNERS: usize = 500;

/// Cuts a closed polygon into `points.len() - 2` triangles that use each of its sides once, in its direction, whatever
/// its shape: by ears where it has them, seen along its mean normal.
pub(crate) fn triangles(points: &[DVec3]) -> Vec<[usize; 3]> {
    let n = points.len();
    if n < 3 {
        return Vec::new();
    }
    if n > MAX_CORNERS {
        return (1..n - 1).map(|i| [0, i, i + 1]).collect();
    }
    let flat = flatten(points);
    let mut ring: Vec<usize> = (0..n).collect();
    let mut out = Vec::with_capacity(n - 2);
    while ring.len() > 3 {
        let ear = best_ear(&flat, &ring);
        let m = ring.len();
        out.push([ring[(ear + m - 1) % m], ring[ear], ring[(ear + 1) % m]]);
        ring.remove(ear);
    }
    out.push([ring[0], ring[1], ring[2]]);
    out
}

/// The mean normal of a closed polygon (Newell); its length is twice the area.
pub(crate) fn newell(points: &[DVec3]) -> DVec3 {
    let Some(&origin) = points.first() else { return DVec3::ZERO };
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| (a - origin).cross(b - origin)).sum()
}

fn flatten(points: &[DVec3]) -> Vec<DVec2> {
    let normal = newell(points).try_normalize().unwrap_or(DVec3::Z);
    let x = normal.any_orthonormal_vector();
    let y = normal.cross(x);
    points.iter().map(|p| DVec2::new(p.dot(x), p.dot(y))).collect()
}

/// The first true ear; else the corner that turns least wrongly.
fn best_ear(flat: &[DVec2], ring: &[usize]) -> usize {
    let m = ring.len();
    let turn = |i: usize| {
        let [a, b, c] = [ring[(i + m - 1) % m], ring[i], ring[(i + 1) % m]].map(|k| flat[k]);
        (b - a).perp_dot(c - b)
    };
    let is_ear = |i: usize| {
        let [a, b, c] = [ring[(i + m - 1) % m], ring[i], ring[(i + 1) % m]];
        turn(i) > 0.0
            && !ring.iter().any(|&k| k != a && k != b && k != c && in_triangle(flat, [a, b, c], flat[k]))
    };
    (0..m)
        .find(|&i| is_ear(i))
        .unwrap_or_else(|| (0..m).max_by(|&i, &j| turn(i).total_cmp(&turn(j))).unwrap_or(0))
}

fn in_triangle(flat: &[DVec2], [a, b, c]: [usize; 3], p: DVec2) -> bool {
    let side = |i: usize, j: usize| signed_area([flat[i], flat[j], p].into_iter());
    side(a, b) > 0.0 && side(b, c) > 0.0 && side(c, a) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec3]) -> f64 {
        triangles(points).iter().map(|t| newell(&t.map(|i| points[i])).z * 0.5).sum()
    }

    #[test]
    fn a_notched_square_keeps_its_area() {
        let p =
            [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5), (0.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        assert!((area(&p) - 2.5).abs() < 1e-12);
        assert_eq!(triangles(&p).len(), 3);
    }

    #[test]
    fn a_polygon_without_area_still_closes() {
        let p = [0.0, 1.0, 2.0, 1.0].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(triangles(&p).len(), 2);
    }
}
