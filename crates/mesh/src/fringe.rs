//! The strip between a surface and edges that lie off it.

use glam::DVec3;

/// Strips along the edges that lie off the surface: triangles run from the edges to the surface there, and were they
/// narrow, they would be steep.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fringe {
    pieces: Vec<Piece>,
}

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
            self.pieces.push(Piece { from: ends[0], to: ends[1], width_mm: WIDTH * lift });
        }
    }

    /// Whether a point lies on a strip.
    pub fn holds(&self, point: DVec3) -> bool {
        self.pieces.iter().any(|piece| piece.distance(point) < piece.width_mm)
    }

    /// Whether there is any strip.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
}

impl Piece {
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
}
