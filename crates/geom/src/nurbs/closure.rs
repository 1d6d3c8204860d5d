//! Which sides of a B-spline surface coincide, and which are single points.

use glam::{DVec2, DVec3};

use super::curve::sample_parameters;
use super::knots;
use super::surface::View;
use crate::period::CLOSURE;

/// What the four sides of a surface are like.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides {
    /// Per direction, whether its lower and upper side coincide.
    pub closed: [bool; 2],
    /// Per direction the point that the lower and the upper side is, if it is one.
    pub degenerate: [[Option<DVec3>; 2]; 2],
}

/// How many points of a side are looked at.
const MOST_SAMPLES: usize = 4096;

/// Compares the sides at as many parameters per knot span as fix a curve of their degree. A side that is a point to
/// within 1e-6 of the size is one: its direction means nothing any more.
pub(super) fn sides(surface: &View) -> Sides {
    let mut sides = Sides::default();
    let (closed, degenerate) = (CLOSURE * surface.size, 1e-6 * surface.size);
    for d in 0..2 {
        let along = 1 - d;
        let degree = surface.degrees[along];
        let per_span = if surface.is_rational() { 2 * degree } else { degree };
        let spans = knots::distinct(surface.knots[along], surface.domain[along]);
        let parameters = sample_parameters(&spans, per_span.min(16), MOST_SAMPLES);
        let side = |upper: bool, t: f64| {
            let at = if upper { surface.domain[d].end } else { surface.domain[d].start };
            let uv = if d == 0 { DVec2::new(at, t) } else { DVec2::new(t, at) };
            surface.evaluate::<0>(uv)[0]
        };
        sides.closed[d] = parameters.iter().all(|&t| side(false, t).distance(side(true, t)) <= closed);
        sides.degenerate[d] = [false, true].map(|upper| {
            let point = side(upper, surface.domain[along].start);
            parameters.iter().all(|&t| side(upper, t).distance(point) <= degenerate).then_some(point)
        });
    }
    sides
}
