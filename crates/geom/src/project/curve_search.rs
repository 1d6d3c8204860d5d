//! The nearest point on any curve that can be evaluated: Newton steps, and a global search over samples.

use std::borrow::Cow;

use glam::DVec3;

use crate::Interval;

/// A curve as its evaluation, and where its parameter may go.
pub(crate) struct CurveSearch<E> {
    /// Point, first and second derivative.
    evaluate: E,
    /// Where the parameter may go; infinite where the curve is closed (evaluation wraps then).
    limits: Interval,
    /// The length of the curve's domain.
    length: f64,
}

/// Where a descent ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub t: f64,
    pub distance2: f64,
    /// Whether the point there is square to the curve, or at the end of the limits with the target beyond.
    pub proper: bool,
    /// Whether the target is on the curve for all that matters: within 1e-6 of the curve's extent.
    on: bool,
}

/// A sampled local minimum of the distance.
#[derive(Clone, Copy)]
struct Start {
    distance2: f64,
    t: f64,
    /// Its neighbours' parameters.
    bracket: Interval,
    /// How far from the sample the curve goes before another one is nearer, about.
    radius: f64,
}

const STARTS: usize = 6;
const STEPS: usize = 40;

impl<E: Fn(f64) -> [DVec3; 3]> CurveSearch<E> {
    /// A search over `domain`, and any number of periods beyond it where the curve is `closed`.
    pub fn new(evaluate: E, domain: Interval, closed: bool) -> Self {
        let limits = if closed { Interval::INFINITE } else { domain };
        Self { evaluate, limits, length: domain.length() }
    }

    /// The local solution from the hint when it is proper and no part of the curve, judged by its samples, can be
    /// nearer; else the global one.
    pub fn nearest<'s>(
        &self,
        target: DVec3,
        hint: Option<f64>,
        samples: impl FnOnce() -> Cow<'s, [(f64, DVec3)]>,
    ) -> Foot {
        let nothing = Foot { t: self.limits.clamp(0.0), distance2: f64::INFINITY, proper: false, on: false };
        let hinted = hint.filter(|t| t.is_finite()).map(|hint| self.descend(target, hint));
        let mut best = hinted.filter(|foot| foot.proper).unwrap_or(nothing);
        if best.on {
            return best;
        }
        for start in local_minima(target, &samples()).iter().flatten() {
            if start.distance2.sqrt() - start.radius < best.distance2.sqrt() {
                let foot = self.refine(target, *start);
                if foot.distance2 < best.distance2 * (1.0 - 1e-12) {
                    best = foot;
                }
            }
        }
        best
    }

    /// The best foot near a sample, never worse than the sample itself.
    fn refine(&self, target: DVec3, start: Start) -> Foot {
        let sampled = Foot { t: start.t, distance2: start.distance2, proper: false, on: false };
        let mut foot = self.descend_from_both_sides(target, start);
        if !foot.proper || foot.distance2 > start.distance2 {
            let shrunk = self.shrink(target, start);
            if shrunk.distance2 < foot.distance2 {
                foot = shrunk;
            }
        }
        if foot.distance2 <= start.distance2 { foot } else { sampled }
    }

    /// From a little before the sample and a little after it: at a corner the two lead to different feet.
    fn descend_from_both_sides(&self, target: DVec3, start: Start) -> Foot {
        let [left, right] =
            [start.bracket.start, start.bracket.end].map(|end| start.t + 0.3 * (end - start.t));
        if self.turns_at(start) {
            // Just short of the corner, where the derivatives are still those of the side.
            let beside = |end: f64| start.t + 1e-9 * (end - start.t);
            let Interval { start: first, end: last } = start.bracket;
            let before = self.descend_within(target, left, Interval::new(first, beside(first)));
            let after = self.descend_within(target, right, Interval::new(beside(last), last));
            return if after.distance2 < before.distance2 { after } else { before };
        }
        let before = self.descend(target, left);
        // Farther on, it may have passed a corner.
        if before.proper && before.t > start.t && before.t <= start.bracket.end {
            return before;
        }
        let after = self.descend(target, right);
        if after.distance2 < before.distance2 { after } else { before }
    }

    /// Whether the curve has a corner at a sample.
    fn turns_at(&self, start: Start) -> bool {
        let tangent = |end: f64| (self.evaluate)(start.t + 1e-6 * (end - start.t))[1];
        let (before, after) = (tangent(start.bracket.start), tangent(start.bracket.end));
        before.cross(after).length_squared() > 1e-6 * before.length_squared() * after.length_squared()
    }

    /// [`Self::descend`] between two parameters.
    fn descend_within(&self, target: DVec3, start: f64, range: Interval) -> Foot {
        let limits = Interval::new(self.limits.clamp(range.start), self.limits.clamp(range.end));
        CurveSearch { evaluate: &self.evaluate, limits, length: self.length }.descend(target, start)
    }

    /// Newton steps on the squared distance, Gauss-Newton where that is not convex, each shortened until the distance
    /// does not grow.
    pub fn descend(&self, target: DVec3, start: f64) -> Foot {
        let mut t = self.limits.clamp(start);
        let mut at = (self.evaluate)(t);
        let mut distance2 = (at[0] - target).length_squared();
        let scale = at[0].length() + target.length();
        let mut previous = 0.0;
        for _ in 0..STEPS {
            let residual = at[0] - target;
            let (slope, speed2) = (residual.dot(at[1]), at[1].length_squared());
            let bend = speed2 + residual.dot(at[2]);
            let step = -slope / if bend > 1e-6 * speed2 { bend } else { speed2 };
            let Some((next, value, travel)) = self.shorten(target, t, step, at) else { break };
            t = next;
            at = value;
            distance2 = (at[0] - target).length_squared();
            if has_settled(travel, previous, 1e-13 * scale) {
                break;
            }
            previous = travel;
        }
        let extent = self.length * at[1].length();
        let near = if extent.is_finite() { (1e-6 * extent).max(1e-12 * scale) } else { 1e-12 * scale };
        let on = distance2 <= near * near;
        Foot { t, distance2, proper: self.is_proper(t, at, target, scale), on }
    }

    /// The step, halved until the distance does not grow (beyond rounding), and how far it went in space. `None` where no
    /// step helps.
    fn shorten(&self, target: DVec3, t: f64, step: f64, at: [DVec3; 3]) -> Option<(f64, [DVec3; 3], f64)> {
        let before = at[0].distance_squared(target);
        let scale = at[0].length() + target.length();
        let mut step = step;
        for _ in 0..30 {
            let next = self.limits.clamp(t + step);
            let travel = (next - t).abs() * at[1].length();
            if travel <= 1e-16 * scale || travel.is_nan() {
                return None;
            }
            let value = (self.evaluate)(next);
            if value[0].distance_squared(target) <= before * (1.0 + 1e-14) + 1e-30 * scale * scale {
                return Some((next, value, travel));
            }
            step *= 0.5;
        }
        None
    }

    fn is_proper(&self, t: f64, [point, tangent, _]: [DVec3; 3], target: DVec3, scale: f64) -> bool {
        let residual = point - target;
        let slope = residual.dot(tangent);
        // Descent ends when steps no longer matter to the point: near the curve, that says little of the angle.
        let square = (1e-7 * residual.length()).max(1e-11 * scale) * tangent.length();
        if residual.length() <= 1e-12 * scale || slope.abs() <= square {
            return true;
        }
        pushed_against(self.limits, t, slope)
    }

    /// Golden section between a sample's neighbours, for corners and other places where Newton fails.
    fn shrink(&self, target: DVec3, start: Start) -> Foot {
        let distance2 = |t: f64| (self.evaluate)(t)[0].distance_squared(target);
        let ratio = 0.618_033_988_749_894_9;
        let (mut low, mut high) = (start.bracket.start, start.bracket.end);
        let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let mut values = inner.map(distance2);
        for _ in 0..80 {
            if values[0] < values[1] {
                high = inner[1];
                inner = [high - ratio * (high - low), inner[0]];
                values = [distance2(inner[0]), values[0]];
            } else {
                low = inner[0];
                inner = [inner[1], low + ratio * (high - low)];
                values = [values[1], distance2(inner[1])];
            }
        }
        self.descend(target, inner[usize::from(values[1] < values[0])])
    }
}

/// Parameters that are nearer to a limit than this share of what lies between the limits are at the limit: no step leads
/// any further from there, and rounding may well end one before it.
const HAIR: f64 = 1e-13;

/// Whether a parameter is at a limit, and would be nearer to the target beyond it: there the squared distance falls, whose
/// derivative is `slope`.
pub(super) fn pushed_against(limits: Interval, t: f64, slope: f64) -> bool {
    let hair = if limits.is_finite() { HAIR * limits.length() } else { 0.0 };
    (t <= limits.start + hair && slope > 0.0) || (t >= limits.end - hair && slope < 0.0)
}

/// Whether the next step would be no longer than `least`: this one is not, or it has shrunk so much from the one before
/// that the next one, shrinking no less, would not be. The first has none before it: `previous` is 0.
pub(super) fn has_settled(travel: f64, previous: f64, least: f64) -> bool {
    travel <= least || (travel < 0.5 * previous && travel * travel <= least * previous)
}

/// The best few samples that are nearer than both neighbours, best first.
fn local_minima(target: DVec3, samples: &[(f64, DVec3)]) -> [Option<Start>; STARTS] {
    let mut best: [Option<Start>; STARTS] = [None; STARTS];
    let mut previous = f64::INFINITY;
    let mut current = samples.first().map_or(f64::NAN, |(_, p)| p.distance_squared(target));
    for (i, &(t, point)) in samples.iter().enumerate() {
        let next = samples.get(i + 1).map_or(f64::INFINITY, |(_, p)| p.distance_squared(target));
        if current <= previous && current <= next {
            let (left, right) = (samples[i.saturating_sub(1)], samples[(i + 1).min(samples.len() - 1)]);
            let radius = 0.75 * point.distance(left.1).max(point.distance(right.1));
            keep(&mut best, Start { distance2: current, t, bracket: Interval::new(left.0, right.0), radius });
        }
        previous = current;
        current = next;
    }
    best
}

fn keep(best: &mut [Option<Start>; STARTS], mut start: Start) {
    for slot in best {
        match slot {
            Some(kept) if kept.distance2 <= start.distance2 => {}
            Some(kept) => std::mem::swap(kept, &mut start),
            None => {
                *slot = Some(start);
                return;
            }
        }
    }
}
