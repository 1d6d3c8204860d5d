//! B-spline basis functions.

/// Storage for the basis values of one parameter: on the stack for usual degrees, on the heap beyond.
pub(crate) trait Row: Clone + AsRef<[f64]> + AsMut<[f64]> {
    /// At least `len` zeros.
    fn zeros(len: usize) -> Self;
}

impl<const N: usize> Row for [f64; N] {
    #[inline]
    fn zeros(_: usize) -> Self {
        [0.0; N]
    }
}

impl Row for Vec<f64> {
    fn zeros(len: usize) -> Self {
        vec![0.0; len]
    }
}

/// Runs `$body` with `$row` standing for the storage that fits the higher of two degrees, and `$fixed` for their value
/// where both are the same small number, which lets the compiler unroll every loop; else for 0.
macro_rules! by_degree {
    ($degrees:expr, $row:ident, $fixed:ident => $body:expr) => {{
        macro_rules! arm {
            ($storage:ty, $value:expr) => {{
                type $row = $storage;
                const $fixed: usize = $value;
                $body
            }};
        }
        let [one, other]: [usize; 2] = $degrees;
        match (one.max(other), one == other) {
            (1, true) => arm!([f64; 2], 1),
            (2, true) => arm!([f64; 3], 2),
            (3, true) => arm!([f64; 4], 3),
            (0..=3, _) => arm!([f64; 4], 0),
            (0..=5, _) => arm!([f64; 6], 0),
            (0..=9, _) => arm!([f64; 10], 0),
            (10..=31, _) => arm!([f64; 32], 0),
            _ => arm!(Vec<f64>, 0),
        }
    }};
}
pub(crate) use by_degree;

/// The index i of the non-empty knot span `knots[i] <= t < knots[i + 1]`, `degree <= i < count`; the last non-empty
/// span at the domain's end (Piegl & Tiller A2.1, by binary search).
#[inline]
pub fn find_span(knots: &[f64], degree: usize, count: usize, t: f64) -> usize {
    let mut span = degree + knots[degree + 1..count].partition_point(|&k| k <= t);
    while span > degree && knots[span] >= knots[span + 1] {
        span -= 1;
    }
    span
}

/// The `degree + 1` basis functions that do not vanish at `t` in the domain of `count` control points, and the number of
/// the first one (Piegl & Tiller A2.2).
pub fn basis_functions(knots: &[f64], degree: usize, count: usize, t: f64) -> (usize, Vec<f64>) {
    let basis = Basis::<Vec<f64>>::new::<0, 0>(knots, degree, count, t);
    let [values, ..] = basis.rows;
    (basis.first, values)
}

/// The `degree + 1` basis functions that do not vanish at one parameter, and their first two derivatives.
pub(crate) struct Basis<R> {
    /// Index of the first control point they belong to.
    pub first: usize,
    /// Values, first derivatives, second derivatives; `degree + 1` of each.
    pub rows: [R; 3],
}

impl<R: Row> Basis<R> {
    /// Values and derivatives up to `ORDER` (at most 2) at `t`, which lies in the domain. `FIXED` is the degree where
    /// the caller knows it when compiling, else 0.
    ///
    /// The functions of degree p come from those of degree p - 1 (Piegl & Tiller A2.2), the derivatives from the
    /// functions of one and two degrees less (eq. 2.7).
    #[inline]
    pub fn new<const ORDER: usize, const FIXED: usize>(
        knots: &[f64],
        degree: usize,
        count: usize,
        t: f64,
    ) -> Self {
        // Directions of different degrees are unrolled one by one.
        match if FIXED > 0 { FIXED } else { degree } {
            1 => Self::unrolled::<ORDER, 1>(knots, degree, count, t),
            2 => Self::unrolled::<ORDER, 2>(knots, degree, count, t),
            3 => Self::unrolled::<ORDER, 3>(knots, degree, count, t),
            4 => Self::unrolled::<ORDER, 4>(knots, degree, count, t),
            5 => Self::unrolled::<ORDER, 5>(knots, degree, count, t),
            6 => Self::unrolled::<ORDER, 6>(knots, degree, count, t),
            7 => Self::unrolled::<ORDER, 7>(knots, degree, count, t),
            _ => Self::unrolled::<ORDER, 0>(knots, degree, count, t),
        }
    }

    #[inline]
    fn unrolled<const ORDER: usize, const FIXED: usize>(
        knots: &[f64],
        degree: usize,
        count: usize,
        t: f64,
    ) -> Self {
        let degree = if FIXED > 0 { FIXED } else { degree };
        let span = find_span(knots, degree, count, t);
        let local = &knots[span + 1 - degree..span + 1 + degree];
        let mut rows = [R::zeros(degree + 1), R::zeros(degree + 1), R::zeros(degree + 1)];
        rows[0].as_mut()[0] = 1.0;
        for j in 1..=degree {
            if ORDER >= 2 && j + 1 == degree {
                rows[2] = rows[0].clone();
            }
            if ORDER >= 1 && j == degree {
                rows[1] = rows[0].clone();
            }
            raise(local, degree, j, t, rows[0].as_mut());
        }
        if ORDER >= 1 {
            differentiate(local, degree, degree, rows[1].as_mut());
        }
        if ORDER >= 2 && degree >= 2 {
            differentiate(local, degree, degree - 1, rows[2].as_mut());
            differentiate(local, degree, degree, rows[2].as_mut());
        }
        Self { first: span - degree, rows }
    }
}

/// From the functions of degree `to - 1` to those of degree `to`. `local` holds the knots `span + 1 - degree ..=
/// span + degree`; each difference below spans the non-empty one, so none is zero.
#[inline]
fn raise(local: &[f64], degree: usize, to: usize, t: f64, values: &mut [f64]) {
    let mut saved = 0.0;
    for r in 0..to {
        let right = local[degree + r];
        let left = local[degree + r - to];
        let share = values[r] / (right - left);
        values[r] = saved + (right - t) * share;
        saved = (t - left) * share;
    }
    values[to] = saved;
}

/// From the functions of degree `to - 1` (or some derivative of them) to the derivatives of those of degree `to`.
#[inline]
fn differentiate(local: &[f64], degree: usize, to: usize, values: &mut [f64]) {
    let mut previous = 0.0;
    for i in 0..to {
        let slope = values[i] * to as f64 / (local[degree + i] - local[degree + i - to]);
        values[i] = previous - slope;
        previous = slope;
    }
    values[to] = previous;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Piegl & Tiller, example 2.3: U = {0,0,0,1,2,3,4,4,5,5,5}, p = 2, u = 5/2.
    #[test]
    fn published_basis_values() {
        let knots = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.0, 5.0];
        assert_eq!(find_span(&knots, 2, 8, 2.5), 4);
        let basis = Basis::<[f64; 4]>::new::<2, 0>(&knots, 2, 8, 2.5);
        assert_eq!(basis.first, 2);
        assert_eq!(basis.rows[0][..3], [1.0 / 8.0, 6.0 / 8.0, 1.0 / 8.0]);
        assert_eq!(basis.rows[1][..3], [-0.5, 0.0, 0.5]);
        assert_eq!(basis.rows[2][..3], [1.0, -2.0, 1.0]);
    }

    #[test]
    fn basis_is_a_partition_of_unity_at_every_degree() {
        for degree in 1..40 {
            let mut knots = vec![0.0; degree + 1];
            knots.extend([0.1, 0.5, 0.5, 0.7]);
            knots.extend(vec![1.0; degree + 1]);
            let count = knots.len() - degree - 1;
            for step in 0..=20 {
                let basis = Basis::<Vec<f64>>::new::<2, 0>(&knots, degree, count, step as f64 / 20.0);
                let sums = basis.rows.each_ref().map(|row| row.iter().sum::<f64>());
                let size = basis.rows.each_ref().map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
                assert!((sums[0] - 1.0).abs() < 1e-12, "degree {degree}: {sums:?}");
                assert!(sums[1].abs() <= 1e-11 * size[1] && sums[2].abs() <= 1e-11 * size[2]);
            }
        }
    }

    #[test]
    fn span_search_skips_empty_spans_at_both_ends() {
        let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        assert_eq!(find_span(&knots, 2, 5, 0.0), 3);
        assert_eq!(find_span(&knots, 2, 5, 1.0), 3);
        assert_eq!(find_span(&knots, 2, 5, f64::NAN), 2);
    }
}
