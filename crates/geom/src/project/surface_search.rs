//! The nearest point on any surface that can be evaluated: safeguarded Newton steps, and a global search over samples.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::SampleGrid;
use super::curve_search::{has_settled, pushed_against};
use crate::period::wrap;
use crate::{Derivatives, Direction, Interval, Surface};

/// A surface, and where its parameters may go.
pub(super) struct SurfaceSearch<'a> {
    surface: &'a Surface,
    /// Infinite where the surface is closed (evaluation wraps then).
    limits: [Interval; 2],
    /// How far the surface lies off the one whose samples are used.
    margin: f64,
    /// The longest steps.
    reach: DVec2,
    /// A proper foot from the hint is taken at once where it is no farther off than this.
    enough: f64,
}

/// Where a descent ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub uv: DVec2,
    pub distance2: f64,
    /// Whether the way to the target is square to the surface there, or leads out of the domain.
    pub proper: bool,
    /// Whether the target is on the surface for all that matters: within 1e-6 of the surface's extent.
    pub on: bool,
    /// The surface there, where it is known.
    pub value: Option<Derivatives>,
}

impl Foot {
    fn at(uv: DVec2, distance2: f64) -> Self {
        Self { uv, distance2, proper: false, on: false, value: None }
    }
}

const STEPS: usize = 60;

impl<'a> SurfaceSearch<'a> {
    pub fn new(surface: &'a Surface) -> Self {
        let (domain, periods) = (surface.domain(), surface.periods());
        let limits = [0, 1].map(|d| if periods[d].is_some() { Interval::INFINITE } else { domain[d] });
        let reach = domain.map(|d| if d.is_finite() { 0.5 * d.length() } else { f64::INFINITY });
        Self { surface, limits, reach: DVec2::from(reach), margin: 0.0, enough: 0.0 }
    }

    /// A search that uses samples of a surface `margin` away, over the same parameters.
    pub fn with_margin(self, margin: f64) -> Self {
        Self { margin, ..self }
    }

    /// A search that looks no further where the hint leads to within `enough` of the target.
    pub fn content_with(self, enough: f64) -> Self {
        Self { enough, ..self }
    }

    /// The local solution from the hint when it is proper and no part of the surface, judged by its samples, can be
    /// nearer; else the global one.
    pub fn nearest<'s>(
        &self,
        target: DVec3,
        hint: Option<DVec2>,
        samples: impl Fn() -> Cow<'s, SampleGrid>,
    ) -> Foot {
        let nothing = Foot::at(DVec2::ZERO, f64::INFINITY);
        let hinted = hint.map(|hint| self.descend(target, hint)).filter(|foot| foot.proper);
        let best = hinted.unwrap_or(nothing);
        if best.on || best.distance2 <= self.enough * self.enough {
            return best;
        }
        let found = self.improve(target, best, &samples());
        // A hint's foot that is still the best has come from beside a pole as well as from anywhere else.
        if hinted.is_some_and(|h| h.distance2 == found.distance2) {
            found
        } else {
            self.around_pole(target, found)
        }
    }

    /// The best of a foot and of the descents from the sampled minima that may lead nearer.
    fn improve(&self, target: DVec3, mut best: Foot, samples: &SampleGrid) -> Foot {
        for start in samples.local_minima(target, best.distance2.sqrt(), self.margin).iter().flatten() {
            let known = best.proper && samples.is_beside(start, self.inside(best.uv));
            if known || start.distance - start.radius - self.margin >= best.distance2.sqrt() {
                continue;
            }
            let sampled = self.surface.point(start.uv).distance_squared(target);
            if sampled < best.distance2 {
                best = Foot::at(start.uv, sampled);
            }
            for from in samples.approaches(start.uv) {
                // On a creased surface the foot may lie on a crease, which each side then has as its border.
                let limits = samples.smooth_cell(from, self.limits).unwrap_or(self.limits);
                // Short steps, so as not to leap out of the basin.
                let local = Self { limits, reach: samples.spacing(start.uv), ..*self };
                let foot = local.descend(target, from);
                if foot.distance2 < best.distance2 * (1.0 - 1e-12)
                    || (foot.proper && foot.distance2 <= best.distance2)
                {
                    best = foot;
                }
            }
        }
        best
    }

    /// Parameters of a closed direction brought into the domain.
    fn inside(&self, uv: DVec2) -> DVec2 {
        let domain = self.surface.domain();
        let along = |d: usize| if self.limits[d] == domain[d] { uv[d] } else { wrap(uv[d], domain[d]) };
        DVec2::new(along(0), along(1))
    }

    /// From a pole, and anywhere near it, the right direction must be tried: beside a degenerate side the distance has
    /// next to no gradient along it.
    fn around_pole(&self, target: DVec3, best: Foot) -> Foot {
        let domain = self.surface.domain();
        let mut result = best;
        for pole in self.surface.singularities() {
            let (d, other) = if pole.constant == Direction::U { (0, 1) } else { (1, 0) };
            let away = self.inside(best.uv)[d] - pole.at;
            if away.abs() > 0.1 * domain[d].length() || !domain[other].is_finite() {
                continue;
            }
            let least = 1e-3 * domain[d].length();
            let inwards = if pole.at > domain[d].at(0.5) { away.min(-least) } else { away.max(least) };
            let beside = |share: f64| {
                let mut uv = DVec2::splat(pole.at + inwards);
                uv[other] = domain[other].at(share);
                uv
            };
            let starts = (0..16).map(|i| beside((f64::from(i) + 0.5) / 16.0));
            let distance2 = |uv: &DVec2| self.surface.point(*uv).distance_squared(target);
            if let Some(start) = starts.min_by(|a, b| distance2(a).total_cmp(&distance2(b))) {
                let foot = self.descend(target, start);
                if foot.distance2 < result.distance2 {
                    result = foot;
                }
            }
        }
        result
    }

    /// Newton steps on the squared distance (Gauss-Newton where it is not convex), each shortened until the distance
    /// does not grow; parameters at a limit stay there while the target lies beyond.
    pub fn descend(&self, target: DVec3, start: DVec2) -> Foot {
        let mut uv = self.clamp(start);
        let mut at = self.surface.derivatives(uv);
        let scale = at.point.length() + target.length();
        let mut previous = 0.0;
        for _ in 0..STEPS {
            if at.point.distance_squared(target) <= square(1e-14 * scale) {
                break;
            }
            let gradient = Gradient::new(&at, target, uv, &self.limits);
            if gradient.free == [false, false] {
                break;
            }
            let moved = self
                .shorten(target, uv, &at, gradient.newton())
                .or_else(|| self.shorten(target, uv, &at, gradient.downhill()));
            let Some((next, value, travel)) = moved else { break };
            uv = next;
            at = value;
            if has_settled(travel, previous, 1e-13 * scale) {
                break;
            }
            previous = travel;
        }
        let gradient = Gradient::new(&at, target, uv, &self.limits);
        let residual = at.point.distance(target);
        let extent = (2.0 * self.reach.x * at.du.length()).hypot(2.0 * self.reach.y * at.dv.length());
        let on = residual <= 1e-12 * scale || (extent.is_finite() && residual <= 1e-6 * extent);
        let proper = gradient.vanishes(residual, scale);
        Foot { uv, distance2: residual * residual, proper, on, value: Some(at) }
    }

    /// The step, halved until the distance does not grow (beyond rounding), and how far it went in space. `None` where no
    /// step helps.
    fn shorten(
        &self,
        target: DVec3,
        uv: DVec2,
        at: &Derivatives,
        step: DVec2,
    ) -> Option<(DVec2, Derivatives, f64)> {
        let before = at.point.distance_squared(target);
        let scale = at.point.length() + target.length();
        let mut step = step.clamp(-self.reach, self.reach);
        for _ in 0..24 {
            let next = self.clamp(uv + step);
            let change = next - uv;
            let travel = change.x.abs() * at.du.length() + change.y.abs() * at.dv.length();
            if travel <= 1e-16 * scale || travel.is_nan() {
                return None;
            }
            let value = self.surface.derivatives(next);
            if value.point.distance_squared(target) <= before * (1.0 + 1e-14) + 1e-31 * scale * scale {
                return Some((next, value, travel));
            }
            step *= 0.5;
        }
        None
    }

    fn clamp(&self, uv: DVec2) -> DVec2 {
        DVec2::new(self.limits[0].clamp(uv.x), self.limits[1].clamp(uv.y))
    }
}

/// Gradient and second-order data of half the squared distance at one (u, v).
struct Gradient {
    slope: DVec2,
    /// Su·Su, Su·Sv, Sv·Sv.
    metric: [f64; 3],
    /// The same with the curvature terms of the residual.
    hessian: [f64; 3],
    /// Whether the parameter may move: not at a limit that it is pushed against.
    free: [bool; 2],
}

impl Gradient {
    fn new(s: &Derivatives, target: DVec3, uv: DVec2, limits: &[Interval; 2]) -> Self {
        let residual = s.point - target;
        let slope = DVec2::new(residual.dot(s.du), residual.dot(s.dv));
        let metric = [s.du.length_squared(), s.du.dot(s.dv), s.dv.length_squared()];
        let bend = [residual.dot(s.duu), residual.dot(s.duv), residual.dot(s.dvv)];
        let hessian = [0, 1, 2].map(|i| metric[i] + bend[i]);
        let pushed = |d: usize| pushed_against(limits[d], uv[d], slope[d]);
        Self { slope, metric, hessian, free: [!pushed(0), !pushed(1)] }
    }

    /// The Newton step, or the Gauss-Newton step where the Hessian is not safely positive.
    fn newton(&self) -> DVec2 {
        match self.free {
            [true, true] => {
                if self.is_convex() {
                    solve(self.hessian, self.slope)
                } else {
                    self.gauss_newton()
                }
            }
            [true, false] => DVec2::new(self.along(0), 0.0),
            [false, true] => DVec2::new(0.0, self.along(1)),
            [false, false] => DVec2::ZERO,
        }
    }

    /// Whether the Hessian is safely positive.
    fn is_convex(&self) -> bool {
        let [a, b, c] = self.hessian;
        a * c > 0.0
            && a > 1e-6 * self.metric[0]
            && c > 1e-6 * self.metric[2]
            && a * c - b * b > 1e-9 * self.metric[0] * self.metric[2]
    }

    fn gauss_newton(&self) -> DVec2 {
        let [a, b, c] = self.metric;
        // Nearly parallel or vanishing tangents: damped towards the gradient's own direction.
        let damping = if a * c - b * b > 1e-10 * a * c { 0.0 } else { 1e-4 };
        let (a, c) = (a * (1.0 + damping), c * (1.0 + damping));
        if a * c - b * b > 0.0 { solve([a, b, c], self.slope) } else { self.downhill() }
    }

    /// Each free parameter by itself, half as far as if it were alone.
    fn downhill(&self) -> DVec2 {
        let one =
            |d: usize| if self.free[d] { 0.5 * quotient(-self.slope[d], self.metric[2 * d]) } else { 0.0 };
        DVec2::new(one(0), one(1))
    }

    fn along(&self, d: usize) -> f64 {
        let (hessian, metric) = (self.hessian[2 * d], self.metric[2 * d]);
        quotient(-self.slope[d], if hessian > 1e-6 * metric { hessian } else { metric })
    }

    /// Whether the residual is square to the surface along the free parameters.
    fn vanishes(&self, residual: f64, scale: f64) -> bool {
        // Descent ends when steps no longer matter to the point: near the surface, that says little of the angle.
        let square = (1e-7 * residual).max(1e-11 * scale);
        let flat = |d: usize| !self.free[d] || self.slope[d].abs() <= square * self.metric[2 * d].sqrt();
        residual <= 1e-12 * scale || (flat(0) && flat(1))
    }
}

/// The step that brings `slope` to zero, for the symmetric matrix [a b; b c].
fn solve([a, b, c]: [f64; 3], slope: DVec2) -> DVec2 {
    let determinant = a * c - b * b;
    DVec2::new(b * slope.y - c * slope.x, b * slope.x - a * slope.y) / determinant
}

fn square(x: f64) -> f64 {
    x * x
}

fn quotient(a: f64, b: f64) -> f64 {
    let q = a / b;
    if q.is_finite() { q } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NurbsSurface;

    #[test]
    fn a_foot_at_the_end_of_a_domain_is_proper_where_rounding_ends_it_a_hair_before() {
        // As exporters write them: the end is zero but for a rounding error.
        let end = 6.95e-15;
        let points =
            [[0.0, 0.0], [0.0, 5.0], [3.0, 0.0], [3.0, 5.0]].map(|[x, y]| DVec3::new(1e3 + x, y, 0.0));
        let knots = [vec![-1.02, -1.02, end, end], vec![0.0, 0.0, 1.0, 1.0]];
        let sheet = NurbsSurface::new([1, 1], 2, 2, points.to_vec(), Vec::new(), knots).expect("a sheet");
        let surface = Surface::Nurbs(sheet);
        let search = SurfaceSearch::new(&surface);
        for start in [[-8e-16, 0.4], [4.1e-15, 0.4], [0.0, 0.37], [end, 0.4], [-0.5, 0.2]] {
            let foot = search.descend(DVec3::new(1003.001, 2.0, 0.0), start.into());
            assert!(foot.proper, "from {start:?}: {foot:?}");
            assert!((foot.distance2 - 1e-6).abs() < 1e-12 && (foot.uv.y - 0.4).abs() < 1e-12, "{foot:?}");
        }
    }
}
