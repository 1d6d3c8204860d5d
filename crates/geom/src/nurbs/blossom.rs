//! Polar forms: the control points of a spline over any other knots.
//!
//! A spline's piece of degree p has a unique symmetric p-affine function, its blossom, that agrees with it on the
//! diagonal. The control point i over knots t is the blossom at t[i + 1], ..., t[i + p] (Ramshaw 1989). Knot insertion,
//! clamping, restriction, degree elevation and Bézier extraction are all read off it.

use glam::DVec4;

use super::basis::find_span;
use super::knots::distinct;
use crate::Interval;

/// A spline's degree, knots and homogeneous control points.
#[derive(Clone, Debug)]
pub(super) struct Spline<'a> {
    pub degree: usize,
    pub knots: &'a [f64],
    pub points: &'a [DVec4],
}

impl Spline<'_> {
    /// The blossom of the piece over the non-empty `span`, by de Boor's triangle with one argument per level.
    fn blossom(&self, span: usize, arguments: impl Iterator<Item = f64>, triangle: &mut Vec<DVec4>) -> DVec4 {
        let p = self.degree;
        triangle.clear();
        triangle.extend_from_slice(&self.points[span - p..=span]);
        for (r, t) in arguments.enumerate().map(|(r, t)| (r + 1, t)) {
            for j in (r..=p).rev() {
                let i = span - p + j;
                let share = (t - self.knots[i]) / (self.knots[i + p + 1 - r] - self.knots[i]);
                triangle[j] = triangle[j - 1] * (1.0 - share) + triangle[j] * share;
            }
        }
        triangle[p]
    }

    fn span(&self, t: f64) -> usize {
        find_span(self.knots, self.degree, self.points.len(), t)
    }

    /// The control points over `knots`, which hold this spline's own (between their ends) and possibly more. Those whose
    /// knots have not changed stay as they are.
    pub fn over(&self, knots: &[f64]) -> Vec<DVec4> {
        let p = self.degree;
        let mut triangle = Vec::with_capacity(p + 1);
        let mut point = |i: usize| {
            let (span, arguments) = (self.span(knots[i]), &knots[i + 1..=i + p]);
            let kept = (span - p..=span).find(|&j| self.knots[j + 1..=j + p] == *arguments);
            kept.map_or_else(
                || self.blossom(span, arguments.iter().copied(), &mut triangle),
                |j| self.points[j],
            )
        };
        (0..knots.len() - p - 1).map(&mut point).collect()
    }

    /// The control points of one degree more over `knots`, which hold each of this (clamped) spline's once more: the
    /// mean of the blossom with each argument left out.
    pub fn elevated_over(&self, knots: &[f64]) -> Vec<DVec4> {
        let q = self.degree + 1;
        let mut triangle = Vec::with_capacity(q);
        let mut point = |i: usize| {
            let (span, arguments) = (self.span(knots[i]), &knots[i + 1..=i + q]);
            let mut sum = DVec4::ZERO;
            for skipped in 0..q {
                let rest = arguments.iter().enumerate().filter(|(k, _)| *k != skipped).map(|(_, &t)| t);
                sum += self.blossom(span, rest, &mut triangle);
            }
            sum / q as f64
        };
        (0..knots.len() - q - 1).map(&mut point).collect()
    }

    /// The Bézier points of the piece over the knot span that holds `range`, which need not be all of it.
    pub fn bezier(&self, range: Interval) -> Vec<DVec4> {
        let p = self.degree;
        let span = self.span(range.at(0.5));
        let mut triangle = Vec::with_capacity(p + 1);
        let ends = |k: usize| (0..p).map(move |i| if i < p - k { range.start } else { range.end });
        (0..=p).map(|k| self.blossom(span, ends(k), &mut triangle)).collect()
    }
}

/// The knots over `range` with clamped ends and, between them, this vector's own (each at most `degree + 1` times).
pub(super) fn clamped_knots(knots: &[f64], degree: usize, range: Interval) -> Vec<f64> {
    let mut clamped = vec![range.start; degree + 1];
    for &k in knots.iter().filter(|k| range.start < **k && **k < range.end) {
        let repeated = clamped.len() > degree + 1 && clamped[clamped.len() - degree - 1] == k;
        if !repeated {
            clamped.push(k);
        }
    }
    clamped.extend(std::iter::repeat_n(range.end, degree + 1));
    clamped
}

/// The knots with `new` merged in; values outside the open domain and beyond multiplicity `degree` are left out.
pub(super) fn merged_knots(knots: &[f64], degree: usize, domain: Interval, new: &[f64]) -> Vec<f64> {
    let mut merged = knots.to_vec();
    for &t in new.iter().filter(|t| domain.start < **t && **t < domain.end) {
        let at = merged.partition_point(|&k| k <= t);
        let multiplicity = merged[..at].iter().rev().take_while(|&&k| k == t).count();
        if multiplicity < degree {
            merged.insert(at, t);
        }
    }
    merged
}

/// The (clamped) knots with every distinct one repeated once more.
pub(super) fn elevated_knots(knots: &[f64]) -> Vec<f64> {
    let mut elevated = Vec::with_capacity(knots.len() * 2);
    for (i, &k) in knots.iter().enumerate() {
        if i == 0 || knots[i - 1] != k {
            elevated.push(k);
        }
        elevated.push(k);
    }
    elevated
}

/// The non-empty knot spans of the domain.
pub(super) fn spans(knots: &[f64], domain: Interval) -> Vec<Interval> {
    distinct(knots, domain).windows(2).map(|pair| Interval::new(pair[0], pair[1])).collect()
}
