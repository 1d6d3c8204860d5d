//! The strip between a surface and edges that lie off it.

use glam::DVec3;
use trimloop_geom::Aabb;

/// Strips along the edges that lie off the surface: triangles run from the edges to the surface there, and were they
/// narrow, they would be steep.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fringe {
    pieces: Vec<Piece>,
    /// What so many pieces after one another span, with their widths.
    boxes: Vec<Aabb>,
}

/// Pieces in one box.
const PER_BOX: usize = 32;

#[derive(Clone, Copy, Debug)]
struct Piece {
    from: DVec3,
    to: DVec3,
    width_mm: f64,
}

/// A strip is this many times as wide as its edge is off.
const WIDTH: f64 = 8.0;
/// More pieces are not looked through for every point.
const MAX_PIECES: usize = 4096;

impl Fringe {
    /// Adds the strip along a piece of an edge whose ends are `lifts` off the surface, if that is more than `least_mm`.
    pub fn add(&mut self, ends: [DVec3; 2], lifts: [DVec3; 2], least_mm: f64) {
        let lift = lifts[0].length().max(lifts[1].length());
        if lift > least_mm && self.pieces.len() < MAX_PIECES {
            let piece = Piece { from: ends[0], to: ends[1], width_mm: WIDTH * lift };
            if self.pieces.len().is_multiple_of(PER_BOX) {
                self.boxes.push(Aabb::EMPTY);
            }
            let last = self.boxes.len() - 1;
            self.boxes[last] = self.boxes[last].union(piece.bounds());
            self.pieces.push(piece);
        }
    }

    /// Whether a point lies on a strip.
    pub fn holds(&self, point: DVec3) -> bool {
        let blocks = self.boxes.iter().zip(self.pieces.chunks(PER_BOX));
        let mut near = blocks
            .filter(|(bounds, _)| bounds.min.cmple(point).all() && bounds.max.cmpge(point).all())
            .flat_map(|(_, pieces)| pieces);
        near.any(|piece| piece.distance(point) < piece.width_mm)
    }

    /// Whether there is any strip.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
}

impl Piece {
    fn bounds(&self) -> Aabb {
        let Aabb { min, max } = Aabb::from_points([self.from, self.to]);
        Aabb { min: min - self.width_mm, max: max + self.width_mm }
    }

    fn distance(&self, point: DVec3) -> f64 {
        let along = self.to - self.from;
        let share = (point - self.from).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        (self.from + along * share.clamp(0.0, 1.0)).distance(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_is_as_wide_as_its_edge_is_off() {
        let mut fringe = Fringe::default();
        fringe.add([DVec3::ZERO, DVec3::X], [DVec3::Z * 0.01; 2], 0.001);
        fringe.add([DVec3::ZERO, DVec3::Y], [DVec3::Z * 0.0001; 2], 0.001);
        assert!(fringe.holds(DVec3::new(0.5, 0.07, 0.0)));
        assert!(!fringe.holds(DVec3::new(0.5, 0.09, 0.0)));
        assert!(!fringe.holds(DVec3::new(0.0, 0.9, 0.0)));
    }

    #[test]
    fn points_are_found_in_strips_of_many_pieces() {
        let at = |k: u32| DVec3::new(f64::from(k).cos(), f64::from(k).sin(), 0.01 * f64::from(k)) * 10.0;
        let mut fringe = Fringe::default();
        for k in 0..300 {
            fringe.add([at(k), at(k + 1)], [DVec3::Z * 0.02, DVec3::ZERO], 0.001);
        }
        for k in 0..300 {
            let middle = (at(k) + at(k + 1)) * 0.5;
            assert!(fringe.holds(middle + DVec3::X * 0.05));
            assert!(!fringe.holds(middle * DVec3::new(0.1, 0.1, 1.0)));
        }
    }
}
