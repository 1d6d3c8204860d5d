//! Boundaries in the order of their curves in the parameter plane. In the model, where a surface closes on itself, the
//! sides of its seam are one line and their corners one point: a chain that goes on from there may go on along any of
//! several curves, and writers do.

use glam::DVec2;
use trimloop_geom::Surface;

use super::curve::Piece;

/// Ends of curves in the parameter plane are the same within this part of all ends' extent.
const REACH: f64 = 1e-5;

/// Boundaries of more pieces are left as they are.
const MOST_PIECES: usize = 10_000;

/// The loops that pieces form by their images on a surface that closes on itself: per loop its pieces in order, and
/// whether each is run backwards. `None` where they follow one another as they stand, or do not close.
pub(crate) fn loops_in_plane(pieces: &[Piece], surface: &Surface) -> Option<Vec<Vec<(usize, bool)>>> {
    if surface.periods() == [None, None] || pieces.len() > MOST_PIECES {
        return None;
    }
    let ends = pieces.iter().map(image_ends).collect::<Option<Vec<[DVec2; 2]>>>()?;
    let all = || ends.iter().flatten().copied();
    let reach = REACH * (all().reduce(DVec2::max)? - all().reduce(DVec2::min)?);
    let meet = |a: DVec2, b: DVec2| (a - b).abs().cmple(reach).all();
    let mut is_left = vec![true; pieces.len()];
    let mut loops = Vec::new();
    while let Some(first) = is_left.iter().position(|left| *left) {
        is_left[first] = false;
        // The ones that follow in the file are asked first.
        let next = |is_left: &[bool], after: usize, end: usize, at: DVec2| {
            let following = (after + 1..pieces.len()).chain(0..after);
            following.into_iter().find(|&k| is_left[k] && meet(ends[k][end], at))
        };
        // It runs towards the next one, where one of its ends does.
        let follows = |end: usize| {
            let second = (first + 1..pieces.len()).find(|&k| is_left[k]);
            second.is_some_and(|k| ends[k].iter().any(|&at| meet(at, ends[first][end])))
        };
        let turned = !follows(1) && follows(0);
        let mut order = vec![(first, turned)];
        let (start, mut at) = (ends[first][usize::from(turned)], ends[first][usize::from(!turned)]);
        while !meet(at, start) {
            let last = order[order.len() - 1].0;
            let forwards = next(&is_left, last, 0, at).map(|k| (k, false));
            let (piece, turned) = forwards.or_else(|| next(&is_left, last, 1, at).map(|k| (k, true)))?;
            is_left[piece] = false;
            at = ends[piece][usize::from(!turned)];
            order.push((piece, turned));
        }
        loops.push(order);
    }
    let as_it_stands = loops.len() == 1 && loops[0].iter().map(|(piece, _)| *piece).eq(0..pieces.len());
    (!as_it_stands).then_some(loops)
}

/// Where a piece begins and ends in the parameter plane.
fn image_ends(piece: &Piece) -> Option<[DVec2; 2]> {
    let image = piece.image.as_ref()?;
    Some([piece.range.start, piece.range.end].map(|t| image.point(t).truncate()))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};
    use std::sync::Arc;

    use glam::DVec3;
    use trimloop_geom::{Curve, Frame, Interval};

    use super::*;

    /// A piece of which nothing but its image, from one place to another, is of interest.
    fn piece([from, to]: [[f64; 2]; 2]) -> Piece {
        let [from, to] = [from, to].map(|[u, v]| DVec3::new(u, v, 0.0));
        let line = Curve::Line { origin: from, direction: to - from };
        Piece { image: Some(Arc::new(line.clone())), ..Piece::new(line, Interval::new(0.0, 1.0)) }
    }

    fn order(ends: &[[[f64; 2]; 2]]) -> Option<Vec<Vec<(usize, bool)>>> {
        let torus = Surface::Torus { frame: Frame::WORLD, major: 5.0, minor: 2.0, v_range: None };
        loops_in_plane(&ends.iter().copied().map(piece).collect::<Vec<_>>(), &torus)
    }

    /// The sides of a torus, less a bay in the lower and the upper one, as OpenCASCADE lists them: each begins where
    /// the one before ends in space.
    #[test]
    fn a_torus_is_cut_open_along_its_seams() {
        let (right, left) = ([[TAU, 0.0], [TAU, TAU]], [[0.0, TAU], [0.0, 0.0]]);
        let lower = [[[0.0, 0.0], [2.0, 0.0]], [[2.0, 0.0], [3.0, 0.0]], [[3.0, 0.0], [TAU, 0.0]]];
        let upper = [[[TAU, TAU], [3.0, TAU]], [[3.0, TAU], [2.0, TAU]], [[2.0, TAU], [0.0, TAU]]];
        let listed = [right, lower[0], lower[1], lower[2], left, upper[0], upper[1], upper[2]];
        let expected = [0, 5, 6, 7, 4, 1, 2, 3].map(|k| (k, false));
        assert_eq!(order(&listed), Some(vec![expected.to_vec()]));
    }

    #[test]
    fn what_follows_as_it_stands_is_left_alone() {
        let square = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]];
        let sides: Vec<[[f64; 2]; 2]> = (0..4).map(|k| [square[k], square[(k + 1) % 4]]).collect();
        assert_eq!(order(&sides), None);
        assert_eq!(order(&sides[..3]), None, "open");
        let mut first_backwards = sides.clone();
        first_backwards[0].reverse();
        assert_eq!(order(&first_backwards), None);
    }

    #[test]
    fn two_loops_listed_as_one_are_two() {
        let ring = |v: f64| [[[0.0, v], [PI, v]], [[PI, v], [PI, v + 1.0]], [[PI, v + 1.0], [0.0, v]]];
        let both = [ring(1.0), ring(4.0)].concat();
        let expected = [0..3, 3..6].map(|range| range.map(|k| (k, false)).collect::<Vec<_>>());
        assert_eq!(order(&both), Some(expected.to_vec()));
    }
}
