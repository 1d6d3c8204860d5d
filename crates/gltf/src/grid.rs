//! How a mesh's millimetres become the numbers that the file stores.

use glam::{DAffine3, DVec3};
use trimloop_geom::Aabb;

/// Coordinates beyond this cannot be anything real, and would overflow what f32 readers compute from them.
const FARTHEST_MM: f64 = 1e30;

/// How many times farther than its size a mesh may lie from its origin before it gets an origin of its own: beyond it,
/// f32 loses more than four of its 24 bits to the distance.
const FAR_IN_SIZES: f64 = 16.0;

/// The largest stored number of a quantized coordinate.
const STEPS: f64 = u16::MAX as f64;

/// The lattice that a mesh's coordinates are stored on: a point is `origin + step * stored`.
///
/// One per mesh, so that points that are equal stay equal in every primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    origin: DVec3,
    step: f64,
    quantized: bool,
}

impl Grid {
    /// Coordinates as f32, relative to an origin that is the part's own unless `bounds` lie far from it.
    pub(crate) fn floats(bounds: Aabb) -> Self {
        let center = if bounds.is_empty() { DVec3::ZERO } else { bounds.center() };
        let far = center.abs().max_element() > FAR_IN_SIZES * bounds.diagonal();
        // An origin that f32 holds exactly costs the node's translation nothing.
        let origin = if far { center.as_vec3().as_dvec3() } else { DVec3::ZERO };
        Self { origin, step: 1.0, quantized: false }
    }

    /// Coordinates as whole steps 0..=65535 from the lower corner of `bounds`, of one size along all axes.
    pub(crate) fn steps(bounds: Aabb) -> Self {
        let extent = (bounds.max - bounds.min).max_element();
        let step = if extent > 0.0 { extent / STEPS } else { 1.0 };
        let origin = if bounds.is_empty() { DVec3::ZERO } else { bounds.min };
        Self { origin, step, quantized: true }
    }

    /// Whether coordinates are whole steps.
    pub(crate) const fn is_quantized(&self) -> bool {
        self.quantized
    }

    /// What brings stored coordinates back to the part's, where that is anything at all.
    pub(crate) fn placement(&self) -> Option<DAffine3> {
        let identity = self.origin == DVec3::ZERO && self.step == 1.0;
        (!identity)
            .then(|| DAffine3::from_translation(self.origin) * DAffine3::from_scale(DVec3::splat(self.step)))
    }

    /// The stored coordinates of a point; NaN where it is not usable.
    pub(crate) fn store(&self, point: DVec3) -> [f32; 3] {
        if !usable(point) {
            return [f32::NAN; 3];
        }
        let local = (point - self.origin) / self.step;
        // Adding zero turns -0.0 into 0.0, which some readers tell apart.
        let stored =
            if self.quantized { local.round().clamp(DVec3::ZERO, DVec3::splat(STEPS)) } else { local };
        stored.as_vec3().to_array().map(|c| c + 0.0)
    }
}

/// Whether a point is finite and of a size that can be drawn.
pub(crate) fn usable(point: DVec3) -> bool {
    // NaN compares false.
    point.abs().max_element() < FARTHEST_MM && !point.is_nan()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(center: DVec3, half: f64) -> Aabb {
        Aabb { min: center - half, max: center + half }
    }

    #[test]
    fn a_part_around_its_origin_keeps_its_coordinates() {
        let grid = Grid::floats(cube(DVec3::new(30.0, 0.0, -20.0), 10.0));
        assert_eq!(grid.placement(), None);
        assert_eq!(grid.store(DVec3::new(0.1, -0.0, 3.0)), [0.1, 0.0, 3.0]);
        assert_eq!(grid.store(DVec3::new(0.0, -0.0, 0.0))[1].to_bits(), 0);
    }

    #[test]
    fn a_part_far_from_its_origin_keeps_its_detail() {
        let center = DVec3::new(1e7, -2e7, 0.0);
        let grid = Grid::floats(cube(center, 1.0));
        let back = grid.placement().expect("needs an origin of its own");
        for detail in [0.5, 0.25 + 1e-6, -1.0] {
            let point = center + DVec3::splat(detail);
            let stored = glam::Vec3::from_array(grid.store(point)).as_dvec3();
            assert!(back.transform_point3(stored).distance(point) < 2e-7, "{detail}");
        }
    }

    #[test]
    fn steps_are_within_half_a_step_and_span_the_box() {
        let bounds = Aabb { min: DVec3::new(-3.0, 5.0, 100.0), max: DVec3::new(7.0, 5.5, 101.0) };
        let grid = Grid::steps(bounds);
        let back = grid.placement().expect("steps need scaling");
        assert_eq!(grid.store(bounds.min), [0.0; 3]);
        assert_eq!(grid.store(bounds.max)[0], 65535.0);
        for i in 0..100 {
            let point = bounds.min + (bounds.max - bounds.min) * (f64::from(i) * 0.0173).fract();
            let stored = glam::Vec3::from_array(grid.store(point)).as_dvec3();
            assert!(stored.fract() == DVec3::ZERO);
            let off = (back.transform_point3(stored) - point).abs().max_element();
            assert!(off <= 0.5 * 10.0 / 65535.0 * 1.000_001, "{off}");
        }
    }

    #[test]
    fn what_is_not_a_point_is_marked() {
        let grid = Grid::floats(cube(DVec3::ZERO, 1.0));
        for bad in [f64::NAN, f64::INFINITY, 1e308] {
            assert!(grid.store(DVec3::new(0.0, bad, 0.0)).iter().all(|c| c.is_nan()));
            assert!(grid.store(DVec3::new(bad, 0.0, 0.0)).iter().all(|c| c.is_nan()));
        }
    }

    #[test]
    fn a_single_point_has_a_grid() {
        let grid = Grid::steps(cube(DVec3::ONE, 0.0));
        assert_eq!(grid.store(DVec3::ONE), [0.0; 3]);
        assert_eq!(Grid::steps(Aabb::EMPTY).store(DVec3::ZERO), [0.0; 3]);
    }
}
