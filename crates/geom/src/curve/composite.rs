//! Curves end to end.

use glam::DVec3;

use super::Curve;
use crate::Interval;
use crate::period::{CLOSURE, wrap};

/// `composite_curve`: segments end to end.
#[derive(Clone, Debug)]
pub struct CompositeCurve {
    /// At least one.
    pub segments: Vec<CompositeSegment>,
}

/// One segment: `curve` over `range`, run backwards where `reversed`.
#[derive(Clone, Debug)]
pub struct CompositeSegment {
    /// The basis curve.
    pub curve: Curve,
    /// The part that is used; finite.
    pub range: Interval,
    /// Whether the segment runs from `range.end` to `range.start`.
    pub reversed: bool,
}

impl CompositeSegment {
    /// The basis curve's parameter at share `s` of the segment (0 = where it begins).
    pub fn parameter(&self, s: f64) -> f64 {
        self.range.at(if self.reversed { 1.0 - s } else { s })
    }

    /// The share of the segment at the basis curve's parameter `t`.
    pub fn share(&self, t: f64) -> f64 {
        let s = (t - self.range.start) / self.range.length();
        let s = if s.is_finite() { s.clamp(0.0, 1.0) } else { 0.0 };
        if self.reversed { 1.0 - s } else { s }
    }

    /// How fast the basis curve's parameter runs.
    fn speed(&self) -> f64 {
        if self.reversed { -self.range.length() } else { self.range.length() }
    }
}

impl CompositeCurve {
    /// `[0, segments.len()]`.
    pub fn domain(&self) -> Interval {
        Interval::new(0.0, self.segments.len().max(1) as f64)
    }

    /// The domain's length where the end meets the start (within 1e-7 of the extent of the joints).
    pub fn period(&self) -> Option<f64> {
        let (first, last) = (self.segments.first()?, self.segments.last()?);
        let start = first.curve.point(first.parameter(0.0));
        let end = last.curve.point(last.parameter(1.0));
        let stride = (self.segments.len() / 16).max(1);
        let middles = self.segments.iter().step_by(stride).map(|s| s.curve.point(s.parameter(0.5)));
        let extent = middles.map(|p| p.distance(start)).fold(0.0, f64::max);
        (start.distance(end) <= CLOSURE * extent).then(|| self.domain().length())
    }

    /// The segment at `t`, and the share of it.
    fn locate(&self, t: f64) -> Option<(&CompositeSegment, f64)> {
        let domain = self.domain();
        let t = if domain.contains(t) || self.period().is_none() { domain.clamp(t) } else { wrap(t, domain) };
        let index = (t as usize).min(self.segments.len().checked_sub(1)?);
        Some((&self.segments[index], t - index as f64))
    }

    pub(super) fn point(&self, t: f64) -> DVec3 {
        self.locate(t).map_or(DVec3::ZERO, |(segment, s)| segment.curve.point(segment.parameter(s)))
    }

    pub(super) fn derivatives(&self, t: f64) -> [DVec3; 3] {
        let Some((segment, s)) = self.locate(t) else { return [DVec3::ZERO; 3] };
        let [p, d, dd] = segment.curve.derivatives(segment.parameter(s));
        let speed = segment.speed();
        [p, d * speed, dd * (speed * speed)]
    }
}
