//! Where a surface is not smooth.

use super::{Direction, Surface};
use crate::Interval;
use crate::curve::in_range;

impl Surface {
    /// Sorted parameters in `range` (ends included) of one direction, between which the surface is smooth. `range` may
    /// extend over the period of a closed direction.
    pub fn breakpoints(&self, direction: Direction, range: Interval) -> Vec<f64> {
        match (self, direction) {
            (Self::Extrusion { profile, .. }, Direction::U) => profile.breakpoints(range),
            (Self::Revolution { profile, .. }, Direction::V) => profile.breakpoints(range),
            (Self::Offset { basis, .. }, _) => basis.breakpoints(direction, range),
            (Self::Nurbs(nurbs), _) => {
                let knots = nurbs.distinct_knots(direction);
                let d = direction as usize;
                in_range(range, nurbs.domain()[d], nurbs.periods()[d].is_some(), |_| knots.clone())
            }
            _ => in_range(range, Interval::INFINITE, false, |_| Vec::new()),
        }
    }
}
