//! B-spline curves.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec3, DVec4};

use super::basis::{self, Basis, Knots, Row, by_degree, find_span};
use super::control::{self, Control, lift_all, lower};
use super::{NurbsError, knots};
use crate::period::{CLOSURE, wrap};
use crate::{Aabb, Interval};

/// A B-spline curve, rational or not; cloning shares the data.
///
/// The domain is `[knots[degree], knots[points.len()]]`. Where the two ends meet (within 1e-7 of the control
/// polygon's size) the curve counts as closed, and evaluation wraps parameters into the domain; elsewhere it clamps
/// them.
///
/// ```
/// use trimloop_geom::{DVec3, NurbsCurve};
/// let points = vec![DVec3::ZERO, DVec3::new(1.0, 2.0, 0.0), DVec3::new(2.0, 0.0, 0.0)];
/// let curve = NurbsCurve::new(2, points, vec![], vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0])?;
/// assert_eq!(curve.point(0.5), DVec3::new(1.0, 1.0, 0.0));
/// # Ok::<(), trimloop_geom::NurbsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct NurbsCurve(Arc<Data>);

#[derive(Debug)]
struct Data {
    degree: usize,
    points: Vec<DVec3>,
    weights: Vec<f64>,
    /// `(w x, w y, w z, w)`; empty when polynomial.
    homogeneous: Vec<DVec4>,
    knots: Vec<f64>,
    /// Of the differences of knots.
    reciprocals: Vec<f64>,
    domain: Interval,
    size: f64,
    closed: bool,
    samples: OnceLock<Vec<(f64, DVec3)>>,
}

impl NurbsCurve {
    /// A curve of `degree` with full knot vector (`points.len() + degree + 1` values, not decreasing; neither clamped
    /// ends nor any multiplicity are required).
    /// `weights` is empty for a polynomial curve; equal weights are dropped.
    ///
    /// # Errors
    /// The text names what does not fit: counts, numbers that are not finite, weights that are not positive, a degree
    /// outside 1..=127, decreasing knots, an empty domain.
    pub fn new(
        degree: usize,
        points: Vec<DVec3>,
        mut weights: Vec<f64>,
        mut knots: Vec<f64>,
    ) -> Result<Self, NurbsError> {
        let domain = knots::check("", degree, points.len(), &mut knots)?;
        control::check(&points, &mut weights)?;
        let homogeneous = if weights.is_empty() { Vec::new() } else { lift_all(&points, &weights) };
        let size = Aabb::from_points(points.iter().copied()).diagonal();
        let reciprocals = basis::reciprocals(&knots, degree);
        let (closed, samples) = (false, OnceLock::new());
        let mut data =
            Data { degree, points, weights, homogeneous, knots, reciprocals, domain, size, closed, samples };
        let ends = [domain.start, domain.end].map(|t| data.evaluate::<0>(t)[0]);
        data.closed = ends[0].distance(ends[1]) <= CLOSURE * size;
        Ok(Self(Arc::new(data)))
    }

    /// The curve of homogeneous control points `(w x, w y, w z, w)`.
    ///
    /// # Errors
    /// As [`NurbsCurve::new`].
    pub fn from_homogeneous(degree: usize, points: &[DVec4], knots: Vec<f64>) -> Result<Self, NurbsError> {
        let (points, weights) = points.iter().map(|&p| lower(p)).unzip();
        Self::new(degree, points, weights, knots)
    }

    /// Degree.
    pub fn degree(&self) -> usize {
        self.0.degree
    }

    /// Control points.
    pub fn points(&self) -> &[DVec3] {
        &self.0.points
    }

    /// Weights, empty when polynomial.
    pub fn weights(&self) -> &[f64] {
        &self.0.weights
    }

    /// Full knot vector.
    pub fn knots(&self) -> &[f64] {
        &self.0.knots
    }

    /// Control points as `(w x, w y, w z, w)`, with weight 1 when polynomial.
    pub fn homogeneous(&self) -> Vec<DVec4> {
        lift_all(&self.0.points, &self.0.weights)
    }

    /// The interval between the knots `degree` and `points.len()`.
    pub fn domain(&self) -> Interval {
        self.0.domain
    }

    /// The domain's length where the two ends meet.
    pub fn period(&self) -> Option<f64> {
        self.0.closed.then(|| self.0.domain.length())
    }

    /// The diagonal of the control polygon's box.
    pub fn size(&self) -> f64 {
        self.0.size
    }

    /// The point at `t`.
    pub fn point(&self, t: f64) -> DVec3 {
        self.0.evaluate::<0>(self.settle(t))[0]
    }

    /// Point, first and second derivative at `t`.
    pub fn derivatives(&self, t: f64) -> [DVec3; 3] {
        self.0.evaluate::<2>(self.settle(t))
    }

    /// No second derivative in the knot span around `t` is longer than this (the longest of its own control points that
    /// count there, Piegl & Tiller eq. 3.8). `None` of rational curves, and outside of the domain.
    pub fn second_derivative_bound(&self, t: f64) -> Option<f64> {
        let Data { degree, points, homogeneous, knots, domain, .. } = &*self.0;
        if !homogeneous.is_empty() || !(domain.start..domain.end).contains(&t) {
            return None;
        }
        let p = *degree;
        let first = find_span(knots, p, points.len(), t) - p;
        let slope = |i: usize| (points[i + 1] - points[i]) * (p as f64 / (knots[i + p + 1] - knots[i + 1]));
        let mut before = slope(first);
        let mut most = 0.0_f64;
        for i in first + 1..first + p {
            let next = slope(i);
            most = most.max((next - before).length() * (p as f64 - 1.0) / (knots[i + p] - knots[i + 1]));
            before = next;
        }
        most.is_finite().then_some(most)
    }

    /// The distinct knots of the domain, both ends included.
    pub fn distinct_knots(&self) -> Vec<f64> {
        knots::distinct(&self.0.knots, self.0.domain)
    }

    /// The image under any affine map.
    ///
    /// # Errors
    /// When the map sends a control point beyond what f64 can hold.
    pub fn transformed(&self, map: &DAffine3) -> Result<Self, NurbsError> {
        let points = self.0.points.iter().map(|&p| map.transform_point3(p)).collect();
        Self::new(self.0.degree, points, self.0.weights.clone(), self.0.knots.clone())
    }

    /// `t` inside the domain: wrapped when the curve is closed, else clamped.
    fn settle(&self, t: f64) -> f64 {
        if self.0.closed { wrap(t, self.0.domain) } else { self.0.domain.clamp(t) }
    }

    /// Points along the curve from which a global search starts, several per knot span, in order.
    pub(crate) fn samples(&self) -> &[(f64, DVec3)] {
        self.0.samples.get_or_init(|| {
            let per_span = (3 * self.0.degree).clamp(6, 96);
            let parameters = sample_parameters(&self.distinct_knots(), per_span, 1 << 14);
            parameters.into_iter().map(|t| (t, self.point(t))).collect()
        })
    }
}

/// `per_span` equal steps between successive knots, fewer where that makes more than `cap` in all.
pub(crate) fn sample_parameters(knots: &[f64], per_span: usize, cap: usize) -> Vec<f64> {
    let spans = knots.len() - 1;
    let per_span = per_span.min(cap / spans.max(1)).max(1);
    let mut parameters = Vec::with_capacity(spans * per_span + 1);
    for pair in knots.windows(2) {
        let span = Interval::new(pair[0], pair[1]);
        parameters.extend((0..per_span).map(|i| span.at(i as f64 / per_span as f64)));
    }
    parameters.extend(knots.last());
    let stride = parameters.len().div_ceil(cap);
    if stride > 1 {
        let last = parameters.last().copied();
        parameters = parameters.into_iter().step_by(stride).collect();
        parameters.extend(last);
        parameters.dedup();
    }
    parameters
}

impl Data {
    fn evaluate<const ORDER: usize>(&self, t: f64) -> [DVec3; 3] {
        by_degree!([self.degree, self.degree], R, P => {
            let knots = Knots::with(&self.knots, self.degree, self.points.len(), &self.reciprocals);
            let basis = Basis::<R>::new::<ORDER, P>(&knots, t);
            if self.homogeneous.is_empty() {
                combine::<_, _, ORDER, P>(&basis, self.degree, &self.points)
            } else {
                control::project_curve(combine::<_, _, ORDER, P>(&basis, self.degree, &self.homogeneous))
            }
        })
    }
}

#[inline]
fn combine<P: Control, R: Row, const ORDER: usize, const FIXED: usize>(
    basis: &Basis<R>,
    degree: usize,
    points: &[P],
) -> [P; 3] {
    let degree = if FIXED > 0 { FIXED } else { degree };
    let points = &points[basis.first..=basis.first + degree];
    let mut sums = [P::ZERO; 3];
    for (sum, row) in sums.iter_mut().zip(&basis.rows).take(ORDER + 1) {
        for (&p, &n) in points.iter().zip(row.as_ref()) {
            *sum += p * n;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_keep_below_their_bound_and_reach_it() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let points = [[0, 0], [1, 3], [2, -1], [4, 2], [5, 5], [6, 0], [9, 1]];
        let points = points.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 0.5)).to_vec();
        let curve = NurbsCurve::new(3, points, Vec::new(), knots).expect("a curve");
        for span in [[0.0, 0.3], [0.3, 1.0], [1.0, 2.0]] {
            let within = |k: usize| span[0] + (span[1] - span[0]) * k as f64 / 1000.0;
            let lengths = (1..1000).map(|k| curve.derivatives(within(k))[2].length());
            let most = lengths.fold(0.0, f64::max);
            let bound = curve.second_derivative_bound(within(500)).expect("polynomial");
            // A cubic's second derivative runs straight from one control point to the next.
            assert!(most <= bound && most > bound * 0.99, "{span:?}: {most} against {bound}");
        }
        assert_eq!(curve.second_derivative_bound(-1.0), None);
    }
}
