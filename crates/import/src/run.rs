//! Curves that are to follow one another.

use glam::DVec3;

/// Per curve of a chain, given by start, middle and end, whether it is run backwards to begin where the one before ends.
pub(crate) fn turned(curves: &[[DVec3; 3]]) -> Vec<bool> {
    let mut out = vec![false; curves.len()];
    if curves.len() < 2 {
        return out;
    }
    // What closes on itself has no end that is nearer but by rounding: it runs as it is written.
    let slack =
        |[start, middle, _]: &[DVec3; 3]| 1e-9 + 1e-7 * start.length() + 1e-6 * middle.distance(*start);
    let nearest = |from: DVec3, [start, _, end]: &[DVec3; 3]| from.distance(*start).min(from.distance(*end));
    let first = &curves[0];
    // Where both of the first one's ends touch the second, it runs as it is written.
    let touching = slack(first).max(1e-3 * first[0].distance(first[2]));
    out[0] = nearest(first[2], &curves[1]) > nearest(first[0], &curves[1]) + touching;
    let mut at = first[if out[0] { 0 } else { 2 }];
    for (curve, turned) in curves.iter().zip(&mut out).skip(1) {
        let [start, _, end] = *curve;
        *turned = at.distance(end) < at.distance(start) - slack(curve);
        at = if *turned { start } else { end };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: [f64; 3], to: [f64; 3]) -> [DVec3; 3] {
        let [from, to] = [from, to].map(DVec3::from);
        [from, from.midpoint(to), to]
    }

    #[test]
    fn what_ends_where_it_should_begin_is_turned() {
        let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(turned(&[line(a, b), line(b, c), line(c, a)]), [false; 3]);
        assert_eq!(turned(&[line(b, a), line(b, c), line(a, c)]), [true, false, true]);
    }

    /// Two curves of a lens, whose ends are a few digits apart.
    #[test]
    fn the_first_of_two_runs_as_it_is_written() {
        let [a, b] = [[0.0, 0.0, 0.0], [6.0, 0.0, 0.0]];
        let [late, early] = [[6.0, 5e-6, 0.0], [0.0, 1e-7, 0.0]];
        assert_eq!(turned(&[line(a, b), line(late, early)]), [false; 2]);
        assert_eq!(turned(&[line(a, b), line(early, late)]), [false, true]);
    }

    /// A circle's end is nearer to the seam than its start is, by rounding.
    #[test]
    fn what_closes_on_itself_runs_as_it_is_written() {
        let top = [5.0, 0.0, 9.0];
        let ring = |[x, y, z]: [f64; 3], gap: f64| [[x, y, z], [-x, y, z], [x, y + gap, z]].map(DVec3::from);
        let seam = line([5.0, 0.0, 0.0], top);
        assert_eq!(
            turned(&[ring([5.0, 0.0, 0.0], 1e-9), seam, ring([5.0, 6.5e-9, 9.0], -6.5e-9)]),
            [false; 3]
        );
    }
}
