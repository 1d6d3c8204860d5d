//! Parameters on closed curves and surfaces.

use std::f64::consts::TAU;

use crate::Interval;

/// How far apart two ends or sides may be, as a share of the whole's size, and still count as one: what is left of a
/// gap after CAD systems have written their coordinates.
pub(crate) const CLOSURE: f64 = 1e-7;

/// The parameter of `domain` that is a whole number of its lengths away from `t`; `t` itself where it lies inside
/// (so the upper end stays the upper end).
pub(crate) fn wrap(t: f64, domain: Interval) -> f64 {
    if domain.contains(t) {
        return t;
    }
    let wrapped = domain.start + (t - domain.start).rem_euclid(domain.length());
    if wrapped.is_finite() { domain.clamp(wrapped) } else { domain.start }
}

/// The angle in [0, 2π) that is equivalent to `angle_rad`.
pub(crate) fn turn(angle_rad: f64) -> f64 {
    let wrapped = angle_rad.rem_euclid(TAU);
    if wrapped < TAU { wrapped } else { 0.0 }
}

/// The equivalent of `t` that lies within half a `period` of `hint`.
pub(crate) fn near(t: f64, hint: f64, period: f64) -> f64 {
    let moved = t + period * ((hint - t) / period).round();
    if moved.is_finite() { moved } else { t }
}

/// The parts of a closed `domain` that `range` covers (a period of it at most), each inside the domain, in the order
/// of `range`; with each comes what to add to its parameters to get back to those of `range`.
pub(crate) fn pieces(range: Interval, domain: Interval) -> Vec<(Interval, f64)> {
    let length = range.length().min(domain.length());
    let start = match wrap(range.start, domain) {
        start if start >= domain.end && length > 0.0 => domain.start,
        start => start,
    };
    split_at_seam(start, start + length, domain, range.start - start)
}

fn split_at_seam(start: f64, end: f64, domain: Interval, shift: f64) -> Vec<(Interval, f64)> {
    let period = domain.length();
    let slack = 1e-12 * period;
    if end <= domain.end + slack {
        return vec![(Interval::new(start, end.min(domain.end)), shift)];
    }
    let tail = Interval::new(domain.start, (end - period).min(domain.end));
    let mut pieces = Vec::with_capacity(2);
    if domain.end - start > slack {
        pieces.push((Interval::new(start, domain.end), shift));
    }
    if tail.length() > slack {
        pieces.push((tail, shift + period));
    }
    pieces
}
