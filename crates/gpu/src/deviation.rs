//! How far values are from f64.

use crate::{Request, Values};

/// The largest differences of a request's values from f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Largest distance of a point over the shape's size.
    pub distance: f64,
    /// Largest angle between normals away from singular points, degrees; NaN where a normal is not finite.
    pub angle_deg: f64,
}

impl Deviation {
    /// Holds `values` against the exact points and normals of `request`. Only where both first derivatives, over the
    /// whole domain, are longer than a hundredth of the shape's size do normals count.
    pub fn of(request: &Request<'_>, values: &Values) -> Self {
        let mut worst = Self::default();
        // A shape can be a single point, far away: then its coordinates' own rounding is what distances are held against.
        let rounding = 1e-9 * request.shape.origin().length();
        let size = request.shape.size().max(rounding).max(f64::MIN_POSITIVE);
        let [u, v] = request.shape.domain();
        for k in 0..values.len() {
            let uv = request.places.uv(k);
            let exact = request.shape.derivatives(uv);
            worst.distance = worst.distance.max(values.point(k).distance(exact.point) / size);
            let is_regular =
                exact.du.length() * u.length() > 1e-2 * size && exact.dv.length() * v.length() > 1e-2 * size;
            match values.normal(k) {
                Some(own) if !own.is_finite() => worst.angle_deg = f64::NAN,
                Some(own) if is_regular && !worst.angle_deg.is_nan() => {
                    let angle = own.angle_between(request.shape.normal(uv)).to_degrees();
                    worst.angle_deg = worst.angle_deg.max(angle);
                }
                _ => {}
            }
        }
        worst
    }
}
