//! Where a curve is not smooth.

use super::{CompositeCurve, Curve};
use crate::Interval;
use crate::period::pieces;

impl Curve {
    /// Sorted parameters inside `range` (ends included) between which the curve is smooth: knots, corners.
    /// For one-piece curves only the two ends. `range` may extend over the period of a closed curve.
    pub fn breakpoints(&self, range: Interval) -> Vec<f64> {
        match self {
            Self::Offset(offset) => offset.basis.breakpoints(range),
            Self::OnSurface { pcurve, .. } => pcurve.breakpoints(range),
            Self::Polyline(polyline) => {
                let corners = |inner: Interval| whole_numbers(inner, polyline.points.len());
                in_range(range, self.domain(), self.period().is_some(), corners)
            }
            Self::Nurbs(nurbs) => {
                let knots = nurbs.distinct_knots();
                in_range(range, self.domain(), self.period().is_some(), |_| knots.clone())
            }
            Self::Composite(composite) => {
                let inner = composite.inner_breakpoints();
                in_range(range, self.domain(), self.period().is_some(), |_| inner.clone())
            }
            _ => finish(vec![range.start, range.end], range),
        }
    }
}

impl CompositeCurve {
    /// The joints and the segments' own breakpoints, over the whole domain.
    fn inner_breakpoints(&self) -> Vec<f64> {
        let mut found = Vec::new();
        for (index, segment) in self.segments.iter().enumerate() {
            found.push(index as f64);
            let inner = segment.curve.breakpoints(segment.range);
            found.extend(inner.iter().map(|&t| index as f64 + segment.share(t)));
        }
        found.push(self.segments.len() as f64);
        found
    }
}

fn whole_numbers(inner: Interval, count: usize) -> Vec<f64> {
    let first = inner.start.max(0.0).ceil() as usize;
    let last = (inner.end.max(0.0) as usize).min(count.saturating_sub(1));
    (first..=last).map(|i| i as f64).collect()
}

/// The breakpoints of `range`, given those of any part of the domain; over several periods of a closed curve at most
/// a thousand are gone through.
pub(crate) fn in_range(
    range: Interval,
    domain: Interval,
    closed: bool,
    inner: impl Fn(Interval) -> Vec<f64>,
) -> Vec<f64> {
    let mut found = vec![range.start, range.end];
    if !closed {
        found.extend(inner(range));
        return finish(found, range);
    }
    let period = domain.length();
    let mut start = range.start;
    for _ in 0..1000 {
        let part = Interval::new(start, range.end.min(start + period));
        for (piece, shift) in pieces(part, domain) {
            found.extend(inner(piece).into_iter().filter(|&t| piece.contains(t)).map(|t| t + shift));
        }
        start = part.end;
        if start >= range.end || start.is_nan() {
            break;
        }
    }
    finish(found, range)
}

/// Sorted, inside the range, none nearer to another than rounding.
fn finish(mut found: Vec<f64>, range: Interval) -> Vec<f64> {
    found.retain(|t| range.contains(*t));
    found.sort_by(f64::total_cmp);
    let slack = if range.is_finite() { 1e-12 * range.length() } else { 0.0 };
    found.dedup_by(|next, kept| *next - *kept <= slack);
    match found.last_mut() {
        Some(last) if *last == range.end || range.end - *last <= slack => *last = range.end,
        _ => found.push(range.end),
    }
    if found.len() == 1 && range.start < range.end {
        found.insert(0, range.start);
    }
    found
}
