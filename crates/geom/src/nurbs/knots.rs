//! Knot vectors: what is accepted, and what is read from them.

use super::NurbsError;
use crate::Interval;

/// The highest degree that is accepted; evaluation costs its square.
pub const MAX_DEGREE: usize = 127;

/// Checks a knot vector for `count` control points along `name` and returns its domain.
///
/// Knots that decrease by no more than 1e-9 of the whole are rounding and made level.
pub(super) fn check(
    name: &str,
    degree: usize,
    count: usize,
    knots: &mut [f64],
) -> Result<Interval, NurbsError> {
    if degree == 0 || degree > MAX_DEGREE {
        return Err(NurbsError(format!("degree {degree}{name} is not in 1..={MAX_DEGREE}")));
    }
    if count <= degree {
        return Err(NurbsError(format!(
            "{count} control points{name} are too few for degree {degree}, which needs {}",
            degree + 1
        )));
    }
    if knots.len() != count + degree + 1 {
        return Err(NurbsError(format!(
            "{} knots{name} do not fit {count} control points of degree {degree}, which need {}",
            knots.len(),
            count + degree + 1
        )));
    }
    if let Some(index) = knots.iter().position(|k| !k.is_finite()) {
        return Err(NurbsError(format!("knot {index}{name} is {}", knots[index])));
    }
    level(name, knots)?;
    let domain = Interval::new(knots[degree], knots[count]);
    let length = domain.length();
    let noise = f64::EPSILON * domain.start.abs().max(domain.end.abs());
    if !(length > noise && length >= f64::MIN_POSITIVE && length.is_finite()) {
        return Err(NurbsError(format!(
            "the domain{name} from knot {} to {} has no usable length",
            domain.start, domain.end
        )));
    }
    Ok(domain)
}

fn level(name: &str, knots: &mut [f64]) -> Result<(), NurbsError> {
    let (low, high) =
        knots.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &k| (l.min(k), h.max(k)));
    let slack = 1e-9 * (high - low);
    for i in 1..knots.len() {
        if knots[i] < knots[i - 1] {
            if knots[i - 1] - knots[i] > slack {
                return Err(NurbsError(format!(
                    "knots{name} decrease from {} to {} at index {i}",
                    knots[i - 1],
                    knots[i]
                )));
            }
            knots[i] = knots[i - 1];
        }
    }
    Ok(())
}

/// The distinct knots inside the domain, both ends included.
pub(crate) fn distinct(knots: &[f64], domain: Interval) -> Vec<f64> {
    let mut values: Vec<f64> =
        knots.iter().copied().filter(|k| domain.start < *k && *k < domain.end).collect();
    values.insert(0, domain.start);
    values.push(domain.end);
    values.dedup();
    values
}
