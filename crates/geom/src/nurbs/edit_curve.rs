//! What can be done to a B-spline curve without changing its shape.

use glam::DVec4;

use super::blossom::{Spline, clamped_knots, elevated_knots, merged_knots, spans};
use super::{BezierCurve, NurbsCurve, NurbsError};
use crate::Interval;
use crate::period::pieces;

impl NurbsCurve {
    /// The same curve with the knots `new` inserted (Piegl & Tiller A5.4). Values outside the open domain are ignored,
    /// and none gets more than `degree` knots.
    pub fn refined(&self, new: &[f64]) -> Self {
        let knots = merged_knots(self.knots(), self.degree(), self.domain(), new);
        let points = self.homogeneous();
        let points = self.spline(&points).over(&knots);
        self.rebuilt(self.degree(), &points, knots)
    }

    /// The same curve with the knot `t` inserted `times` times (Piegl & Tiller A5.1), up to multiplicity `degree`.
    pub fn with_knot(&self, t: f64, times: usize) -> Self {
        self.refined(&vec![t; times.min(self.degree())])
    }

    /// The same curve with a degree higher by `times` (Piegl & Tiller A5.9) and clamped ends; not beyond
    /// [`super::MAX_DEGREE`].
    pub fn elevated(&self, times: usize) -> Self {
        let mut knots = clamped_knots(self.knots(), self.degree(), self.domain());
        let mut points = self.spline(&self.homogeneous()).over(&knots);
        let mut degree = self.degree();
        for _ in 0..times.min(super::MAX_DEGREE - degree) {
            let raised = elevated_knots(&knots);
            points = Spline { degree, knots: &knots, points: &points }.elevated_over(&raised);
            knots = raised;
            degree += 1;
        }
        self.rebuilt(degree, &points, knots)
    }

    /// The Bézier pieces, one per non-empty knot span, in order (Piegl & Tiller A5.6).
    pub fn bezier_pieces(&self) -> Vec<BezierCurve> {
        let points = self.homogeneous();
        let spline = self.spline(&points);
        let pieces = spans(self.knots(), self.domain()).into_iter();
        pieces.map(|range| BezierCurve { range, points: spline.bezier(range) }).collect()
    }

    /// The part over `range` with the same parametrization and clamped ends. On a closed curve the range may leave
    /// the domain (by one period at most); on an open one only what lies inside counts.
    ///
    /// # Errors
    /// When nothing is left.
    pub fn restricted(&self, range: Interval) -> Result<Self, NurbsError> {
        let domain = self.domain();
        let points = self.homogeneous();
        let spline = self.spline(&points);
        let parts = match self.period() {
            Some(_) if range.start < domain.start || range.end > domain.end => pieces(range, domain),
            _ => vec![(Interval::new(domain.clamp(range.start), domain.clamp(range.end)), 0.0)],
        };
        let parts = parts.into_iter().map(|(part, shift)| {
            let knots = clamped_knots(self.knots(), self.degree(), part);
            let points = spline.over(&knots);
            (knots.into_iter().map(|k| k + shift).collect(), points)
        });
        let (knots, points) = joined(self.degree(), parts);
        Self::from_homogeneous(self.degree(), &points, knots)
    }

    /// The parts before and after `t`; `None` where `t` is not inside the domain.
    pub fn split(&self, t: f64) -> Option<[Self; 2]> {
        let domain = self.domain();
        let before = self.restricted(Interval::new(domain.start, t)).ok()?;
        let after = self.restricted(Interval::new(t, domain.end)).ok()?;
        (domain.start < t && t < domain.end).then_some([before, after])
    }

    /// The same points in the opposite direction over the same domain: `reversed(t) = self(start + end - t)`.
    pub fn reversed(&self) -> Self {
        let mut points = self.homogeneous();
        points.reverse();
        self.rebuilt(self.degree(), &points, reversed_knots(self.knots(), self.domain()))
    }

    /// The same points over another domain, parameters mapped linearly.
    ///
    /// # Errors
    /// When `domain` is empty or not finite.
    pub fn reparametrized(&self, domain: Interval) -> Result<Self, NurbsError> {
        let own = self.domain();
        let moved = self.knots().iter().map(|k| domain.at((k - own.start) / own.length())).collect();
        Self::new(self.degree(), self.points().to_vec(), self.weights().to_vec(), moved)
    }

    fn spline<'a>(&'a self, points: &'a [DVec4]) -> Spline<'a> {
        Spline { degree: self.degree(), knots: self.knots(), points }
    }

    /// What has been computed, or this curve itself if rounding has spoilt it.
    fn rebuilt(&self, degree: usize, points: &[DVec4], knots: Vec<f64>) -> Self {
        Self::from_homogeneous(degree, points, knots).unwrap_or_else(|_| self.clone())
    }
}

/// Mirrored about the domain's middle.
pub(super) fn reversed_knots(knots: &[f64], domain: Interval) -> Vec<f64> {
    knots.iter().rev().map(|k| domain.start + (domain.end - k)).collect()
}

/// Clamped splines of one degree end to end; a joint's two control points become one where they agree.
pub(crate) fn joined(
    degree: usize,
    parts: impl IntoIterator<Item = (Vec<f64>, Vec<DVec4>)>,
) -> (Vec<f64>, Vec<DVec4>) {
    let mut parts = parts.into_iter();
    let Some((mut knots, mut points)) = parts.next() else { return Default::default() };
    for (next_knots, next_points) in parts {
        let (Some(&last), Some(&first)) = (points.last(), next_points.first()) else { continue };
        let same = (last - first).abs().max_element() <= 1e-9 * last.abs().max_element();
        knots.truncate(knots.len() - usize::from(same));
        knots.extend(&next_knots[degree + 1..]);
        points.extend(&next_points[usize::from(same)..]);
    }
    (knots, points)
}
