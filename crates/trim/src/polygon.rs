//! Closed polygons in the parameter plane.

use glam::DVec2;

/// Twice the signed area is the sum of the cross products: positive when counter-clockwise.
pub fn signed_area(points: impl ExactSizeIterator<Item = DVec2> + Clone) -> f64 {
    let Some(origin) = points.clone().next() else { return 0.0 };
    let next = points.clone().cycle().skip(1);
    points.zip(next).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum::<f64>() * 0.5
}

/// Whether a ray from `p` towards +u crosses the polygon an odd number of times.
pub fn contains(points: impl ExactSizeIterator<Item = DVec2> + Clone, p: DVec2) -> bool {
    let next = points.clone().cycle().skip(1);
    points.zip(next).filter(|&(a, b)| crosses_right_of(a, b, p)).count() % 2 == 1
}

fn crosses_right_of(a: DVec2, b: DVec2, p: DVec2) -> bool {
    (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
}

/// Whether the open segments `a`-`b` and `c`-`d` cross or overlap; touching end points do not count.
pub fn segments_cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    if a.x.max(b.x) < c.x.min(d.x)
        || c.x.max(d.x) < a.x.min(b.x)
        || a.y.max(b.y) < c.y.min(d.y)
        || c.y.max(d.y) < a.y.min(b.y)
    {
        return false;
    }
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let (ca, cb) = (side(c, d, a), side(c, d, b));
    let (ac, ad) = (side(a, b, c), side(a, b, d));
    if a == c || a == d || b == c || b == d {
        return false;
    }
    (ca > 0.0) != (cb > 0.0) && (ac > 0.0) != (ad > 0.0) || ac == 0.0 || ad == 0.0
}

/// Distance of `p` from the segment `a`-`b`.
pub fn segment_distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    if t.is_nan() { p.distance(a) } else { p.distance(a + ab * t) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [DVec2; 4] =
        [DVec2::new(0.0, 0.0), DVec2::new(2.0, 0.0), DVec2::new(2.0, 2.0), DVec2::new(0.0, 2.0)];

    #[test]
    fn area_is_positive_counter_clockwise() {
        assert_eq!(signed_area(SQUARE.into_iter()), 4.0);
        assert_eq!(signed_area(SQUARE.into_iter().rev()), -4.0);
    }

    #[test]
    fn contains_the_middle_and_not_what_is_outside() {
        assert!(contains(SQUARE.into_iter(), DVec2::new(1.0, 1.0)));
        assert!(!contains(SQUARE.into_iter(), DVec2::new(3.0, 1.0)));
        assert!(!contains(SQUARE.into_iter(), DVec2::new(-1.0, 1.0)));
    }

    #[test]
    fn diagonals_cross_and_sides_do_not() {
        assert!(segments_cross(SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]));
        assert!(!segments_cross(SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[3]));
        assert!(!segments_cross(SQUARE[0], SQUARE[1], SQUARE[1], SQUARE[2]));
    }

    #[test]
    fn distance_to_a_segment_is_to_its_nearest_point() {
        assert_eq!(segment_distance(DVec2::new(1.0, 1.0), SQUARE[0], SQUARE[1]), 1.0);
        assert_eq!(segment_distance(DVec2::new(5.0, 4.0), SQUARE[0], SQUARE[1]), 5.0);
    }
}
