//! One cubic B-spline over five knots of its own.

use crate::Interval;

/// Value, first and second derivative at `t` (Cox, de Boor; Piegl & Tiller 2.5, 2.9); at `end`, the limits from below.
pub(super) fn derivatives(knots: &[f64; 5], t: f64, end: f64) -> [f64; 3] {
    // Half-open spans, the last one of the domain closed.
    let is_in = |k: usize| {
        let (low, high) = (knots[k], knots[k + 1]);
        if t >= end { low < t && t <= high } else { low <= t && t < high }
    };
    let mut table = [[0.0; 4]; 4];
    for (k, value) in table[0].iter_mut().enumerate() {
        *value = if is_in(k) { 1.0 } else { 0.0 };
    }
    let share = |x: f64, y: f64| if y > 0.0 { x / y } else { 0.0 };
    for p in 1..4 {
        for k in 0..4 - p {
            let rise = share(t - knots[k], knots[k + p] - knots[k]) * table[p - 1][k];
            let fall = share(knots[k + p + 1] - t, knots[k + p + 1] - knots[k + 1]) * table[p - 1][k + 1];
            table[p][k] = rise + fall;
        }
    }
    // The derivative of degree p at k from two values of degree p - 1.
    let slope = |p: usize, k: usize, low: f64, high: f64| {
        p as f64 * (share(low, knots[k + p] - knots[k]) - share(high, knots[k + p + 1] - knots[k + 1]))
    };
    let first = slope(3, 0, table[2][0], table[2][1]);
    let quadratic = [0, 1].map(|k| slope(2, k, table[1][k], table[1][k + 1]));
    [table[3][0], first, slope(3, 0, quadratic[0], quadratic[1])]
}

/// Its Bernstein coefficients on an interval without knots inside: polar values (Ramshaw), by de Boor's triangle, which is
/// knot insertion until both ends are threefold. `None` where it is zero all over.
pub(super) fn bernstein(knots: &[f64; 5], on: Interval) -> Option<[f64; 4]> {
    let middle = on.at(0.5);
    let span = (0..4).find(|&k| knots[k] <= middle && middle < knots[k + 1])?;
    // Three more knots on each side, so that all functions of the span exist; only ours has a coefficient.
    let (first, last) = (knots[0], knots[4]);
    let step = last - first;
    let padded = [
        first - 3.0 * step,
        first - 2.0 * step,
        first - step,
        knots[0],
        knots[1],
        knots[2],
        knots[3],
        knots[4],
        last + step,
        last + 2.0 * step,
        last + 3.0 * step,
    ];
    let span = span + 3;
    let polar = |arguments: [f64; 3]| {
        // The coefficients of the functions span - 3 .. span; ours is number 3.
        let mut d: [f64; 4] = std::array::from_fn(|k| if span - 3 + k == 3 { 1.0 } else { 0.0 });
        for (r, t) in arguments.into_iter().enumerate() {
            for k in (r + 1..4).rev() {
                let (low, high) = (padded[span - 3 + k], padded[span + k - r]);
                let share = (t - low) / (high - low);
                d[k] = d[k - 1] * (1.0 - share) + d[k] * share;
            }
        }
        d[3]
    };
    let (a, b) = (on.start, on.end);
    Some([polar([a, a, a]), polar([a, a, b]), polar([a, b, b]), polar([b, b, b])])
}
