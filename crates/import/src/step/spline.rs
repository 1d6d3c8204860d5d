//! B-spline curves and surfaces in every form that ISO 10303-42 has.

use glam::DVec3;
use trimloop_brep::Severity;
use trimloop_geom::{NurbsCurve, NurbsSurface};
use trimloop_part21::Param;

use super::attributes::Attributes;
use super::fault::Outcome;
use super::reader::Reader;
use crate::seam::close_seams;

/// The highest degree that is read; no system writes more, and evaluation takes time with its square.
const MAX_DEGREE: usize = 60;

/// How the knots of a B-spline come about when the file does not list them.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Spacing {
    /// `uniform_curve`: evenly spaced, the ends not repeated.
    Uniform,
    /// `quasi_uniform_curve`: evenly spaced, the ends clamped.
    QuasiUniform,
    /// `bezier_curve`: each segment a Bézier piece.
    Bezier,
}

impl<'t> Reader<'t> {
    /// Any subtype of `b_spline_curve` (ISO 10303-42 §4.4.36 and following).
    pub fn spline_curve(&mut self, index: usize) -> Outcome<NurbsCurve> {
        let complex = self.table.instance(index).is_complex();
        let mut base = self.part(index, "B_SPLINE_CURVE")?.after(usize::from(!complex));
        let degree = self.degree(index, &mut base)?;
        let points = base.list("control points")?;
        let points = points.map(|param| self.control_point(&base, param)).collect::<Outcome<Vec<_>>>()?;
        base.skip(3);
        let mut knots_part = self.knots_part(index, "B_SPLINE_CURVE_WITH_KNOTS", base);
        let knots = match &mut knots_part {
            Some(part) => {
                let (multiplicities, values) = (part.counts("multiplicities")?, part.reals("knots")?);
                self.full_knots(index, &multiplicities, &values, degree, points.len())?
            }
            None => spaced_knots(self.spacing(index), degree, points.len()),
        };
        let mut weights = match self.rational_part(index, "RATIONAL_B_SPLINE_CURVE") {
            Some(mut part) => part.reals("weights")?,
            None => Vec::new(),
        };
        self.repair_weights(index, &mut weights, points.len())?;
        NurbsCurve::new(degree, points, weights, knots).map_err(|error| self.fault(index, &error.0))
    }

    /// Any subtype of `b_spline_surface` (ISO 10303-42 §4.5.43 and following).
    pub fn spline_surface(&mut self, index: usize) -> Outcome<NurbsSurface> {
        let complex = self.table.instance(index).is_complex();
        let mut base = self.part(index, "B_SPLINE_SURFACE")?.after(usize::from(!complex));
        let degrees = [self.degree(index, &mut base)?, self.degree(index, &mut base)?];
        let (rows, columns, mut points) = self.control_net(&mut base)?;
        base.skip(4);
        let mut knots_part = self.knots_part(index, "B_SPLINE_SURFACE_WITH_KNOTS", base);
        let knots = match &mut knots_part {
            Some(part) => {
                let multiplicities = [part.counts("u multiplicities")?, part.counts("v multiplicities")?];
                let values = [part.reals("u knots")?, part.reals("v knots")?];
                [
                    self.full_knots(index, &multiplicities[0], &values[0], degrees[0], rows)?,
                    self.full_knots(index, &multiplicities[1], &values[1], degrees[1], columns)?,
                ]
            }
            None => {
                let spacing = self.spacing(index);
                [spaced_knots(spacing, degrees[0], rows), spaced_knots(spacing, degrees[1], columns)]
            }
        };
        let mut weights = match self.rational_part(index, "RATIONAL_B_SPLINE_SURFACE") {
            Some(part) => self.weight_net(part)?,
            None => Vec::new(),
        };
        self.repair_weights(index, &mut weights, points.len())?;
        close_seams(degrees, [rows, columns], &mut points, &weights, &knots);
        NurbsSurface::new(degrees, rows, columns, points, weights, knots)
            .map_err(|error| self.fault(index, &error.0))
    }

    fn part(&self, index: usize, keyword: &str) -> Outcome<Attributes<'t>> {
        Attributes::of_part(self.table, index, keyword)
            .ok_or_else(|| self.fault(index, &format!("has no {keyword} part")))
    }

    /// The attributes from the multiplicities on: a part of a complex instance, or what follows in a simple one.
    fn knots_part(&self, index: usize, keyword: &str, base: Attributes<'t>) -> Option<Attributes<'t>> {
        let instance = self.table.instance(index);
        if instance.is_complex() {
            Attributes::of_part(self.table, index, keyword)
        } else {
            instance.keyword().eq_ignore_ascii_case(keyword).then_some(base)
        }
    }

    /// The weights' part, which only a complex instance can have.
    fn rational_part(&self, index: usize, keyword: &str) -> Option<Attributes<'t>> {
        let instance = self.table.instance(index);
        if instance.is_complex() { Attributes::of_part(self.table, index, keyword) } else { None }
    }

    fn degree(&self, index: usize, attributes: &mut Attributes<'_>) -> Outcome<usize> {
        let degree = attributes.count("degree")?;
        if (1..=MAX_DEGREE).contains(&degree) {
            Ok(degree)
        } else {
            Err(self.fault(index, &format!("degree {degree} is not between 1 and {MAX_DEGREE}")))
        }
    }

    fn control_point(&self, owner: &Attributes<'_>, param: Param<'_>) -> Outcome<DVec3> {
        let Param::Reference(id) = param else {
            return Err(owner.fault("a control point is not a reference"));
        };
        let index = self.table.find(id);
        self.point(index.ok_or_else(|| owner.fault(format!("control point #{id} is missing from the file")))?)
    }

    /// Control points by rows (u) and columns (v), row-major.
    fn control_net(&self, base: &mut Attributes<'_>) -> Outcome<(usize, usize, Vec<DVec3>)> {
        let (mut rows, mut columns, mut points) = (0, 0, Vec::new());
        for row in base.list("control points")? {
            let Param::List(row) = row else {
                return Err(base.fault("a row of control points is not a list"));
            };
            let before = points.len();
            for param in row {
                points.push(self.control_point(base, param)?);
            }
            if rows == 0 {
                columns = points.len();
            } else if points.len() - before != columns {
                return Err(base.fault("the rows of control points differ in length"));
            }
            rows += 1;
        }
        Ok((rows, columns, points))
    }

    fn weight_net(&self, mut part: Attributes<'_>) -> Outcome<Vec<f64>> {
        let mut weights = Vec::new();
        for row in part.list("weights")? {
            match row {
                Param::List(row) => {
                    for param in row {
                        weights.push(part.number(Some(param), "a weight")?);
                    }
                }
                other => weights.push(part.number(Some(other), "a weight")?),
            }
        }
        Ok(weights)
    }

    fn spacing(&self, index: usize) -> Spacing {
        let instance = self.table.instance(index);
        let mut spacing = Spacing::QuasiUniform;
        for (keyword, _) in instance.parts() {
            match keyword {
                "UNIFORM_CURVE" | "UNIFORM_SURFACE" => spacing = Spacing::Uniform,
                "BEZIER_CURVE" | "BEZIER_SURFACE" => spacing = Spacing::Bezier,
                _ => {}
            }
        }
        spacing
    }

    /// Each knot as often as its multiplicity says. Sums that miss `points + degree + 1` are repaired at the
    /// ends, where exporters differ.
    fn full_knots(
        &mut self,
        index: usize,
        multiplicities: &[usize],
        values: &[f64],
        degree: usize,
        points: usize,
    ) -> Outcome<Vec<f64>> {
        if multiplicities.len() != values.len() || values.len() < 2 {
            return Err(self.fault(index, "knots and multiplicities differ in number"));
        }
        if values.windows(2).any(|pair| pair[0] > pair[1]) {
            return Err(self.fault(index, "the knots are not in order"));
        }
        let mut repaired = multiplicities.to_vec();
        let wanted = points + degree + 1;
        if !repair_multiplicities(&mut repaired, degree, wanted) {
            return Err(self.fault(index, "the knot multiplicities do not fit degree and control points"));
        }
        if repaired != multiplicities {
            let message = format!(
                "The knot multiplicities of #{} do not fit its degree; they were corrected at the ends.",
                self.table.id(index)
            );
            self.note(Severity::Warning, "knot-multiplicities", index, message);
        }
        let knots = repaired.iter().zip(values);
        Ok(knots.flat_map(|(&count, &value)| std::iter::repeat_n(value, count)).collect())
    }

    /// Drops weights that are all equal; turns all-negative ones positive and lifts zeros.
    fn repair_weights(&mut self, index: usize, weights: &mut Vec<f64>, points: usize) -> Outcome<()> {
        if weights.is_empty() {
            return Ok(());
        }
        if weights.len() != points {
            return Err(self.fault(index, "weights and control points differ in number"));
        }
        if weights.iter().all(|&weight| weight < 0.0) {
            weights.iter_mut().for_each(|weight| *weight = -*weight);
        }
        let largest = weights.iter().copied().fold(0.0, f64::max);
        if largest <= 0.0 || weights.iter().any(|&weight| weight < 0.0) {
            return Err(self.fault(index, "its weights are not positive"));
        }
        if weights.contains(&0.0) {
            let message = format!("#{} has weights of zero; they were made tiny.", self.table.id(index));
            self.note(Severity::Warning, "zero-weight", index, message);
            weights.iter_mut().for_each(|weight| *weight = weight.max(1e-9 * largest));
        }
        if weights.iter().all(|&weight| weight == largest) {
            weights.clear();
        }
        Ok(())
    }
}

/// Makes the multiplicities add up to `wanted` by changing the first and the last; false where that cannot be.
fn repair_multiplicities(multiplicities: &mut [usize], degree: usize, wanted: usize) -> bool {
    let last = multiplicities.len() - 1;
    let sum = multiplicities.iter().fold(0usize, |sum, &count| sum.saturating_add(count));
    if multiplicities.contains(&0) {
        return false;
    }
    if sum == wanted {
        return true;
    }
    let inner: usize = sum.saturating_sub(multiplicities[0].saturating_add(multiplicities[last]));
    if inner < wanted && wanted - inner == 2 * (degree + 1) {
        multiplicities[0] = degree + 1;
        multiplicities[last] = degree + 1;
        return true;
    }
    false
}

/// The full knot vector of the forms that list no knots.
fn spaced_knots(spacing: Spacing, degree: usize, points: usize) -> Vec<f64> {
    let total = points + degree + 1;
    match spacing {
        Spacing::Uniform => (0..total).map(|i| i as f64 - degree as f64).collect(),
        Spacing::QuasiUniform => {
            let spans = points.saturating_sub(degree);
            (0..total).map(|i| i.saturating_sub(degree).min(spans) as f64).collect()
        }
        Spacing::Bezier => {
            let segments = points.saturating_sub(1) / degree;
            (0..total).map(|i| (i.saturating_sub(1) / degree).min(segments) as f64).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quasi_uniform_knots_are_clamped() {
        assert_eq!(spaced_knots(Spacing::QuasiUniform, 2, 4), [0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]);
    }

    #[test]
    fn uniform_knots_start_at_minus_degree() {
        assert_eq!(spaced_knots(Spacing::Uniform, 2, 4), [-2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0]);
    }

    #[test]
    fn bezier_knots_repeat_degree_times_between_segments() {
        assert_eq!(
            spaced_knots(Spacing::Bezier, 3, 7),
            [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0]
        );
    }

    #[test]
    fn ends_with_one_multiplicity_too_few_are_clamped() {
        let mut multiplicities = [3, 1, 3];
        assert!(repair_multiplicities(&mut multiplicities, 3, 9));
        assert_eq!(multiplicities, [4, 1, 4]);
    }

    #[test]
    fn hopeless_multiplicities_are_refused() {
        assert!(!repair_multiplicities(&mut [usize::MAX, 1, usize::MAX], 3, 9));
        assert!(!repair_multiplicities(&mut [4, 0, 4], 3, 8));
    }
}
