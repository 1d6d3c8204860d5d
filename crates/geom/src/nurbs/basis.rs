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
    let basis = Basis::<Vec<f64>>::new::<0, 0>(&Knots::of(knots, degree, count), t);
    let [values, ..] = basis.rows;
    (basis.first, values)
}

/// A knot vector as basis functions are made from it.
#[derive(Clone, Copy)]
pub(crate) struct Knots<'a> {
    values: &'a [f64],
    degree: usize,
    /// The number of control points.
    count: usize,
    /// Of `reciprocals`; empty where there are none.
    reciprocals: &'a [f64],
}

/// Up to this degree, dividing once for every knot pays.
const MOST_TABULATED: usize = 9;

/// Per knot i the numbers 1 / (knots[i + j] - knots[i]) for j in 1..=degree, by which basis functions are multiplied
/// where they would be divided by the differences: that takes most of the time otherwise. Those of empty spans are
/// never used. None at all for high degrees.
pub(super) fn reciprocals(knots: &[f64], degree: usize) -> Vec<f64> {
    if degree > MOST_TABULATED {
        return Vec::new();
    }
    let mut out = Vec::with_capacity(knots.len() * degree);
    for i in 0..knots.len() {
        out.extend((1..=degree).map(|j| knots.get(i + j).map_or(0.0, |knot| 1.0 / (knot - knots[i]))));
    }
    out
}

impl<'a> Knots<'a> {
    /// Without reciprocals.
    pub fn of(values: &'a [f64], degree: usize, count: usize) -> Self {
        Self { values, degree, count, reciprocals: &[] }
    }

    /// With the `reciprocals` of the same knots.
    pub fn with(values: &'a [f64], degree: usize, count: usize, reciprocals: &'a [f64]) -> Self {
        Self { values, degree, count, reciprocals }
    }
}

/// The knots around one span, from `span + 1 - degree` to `span + degree`. Each difference spans the non-empty one, so
/// none is zero.
struct Local<'a> {
    values: &'a [f64],
    degree: usize,
    /// From the first of the knots on.
    reciprocals: &'a [f64],
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
    pub fn new<const ORDER: usize, const FIXED: usize>(knots: &Knots<'_>, t: f64) -> Self {
        if knots.reciprocals.is_empty() {
            return Self::unrolled::<ORDER, 0>(knots, t);
        }
        // Directions of different degrees are unrolled one by one.
        match if FIXED > 0 { FIXED } else { knots.degree } {
            1 => Self::unrolled::<ORDER, 1>(knots, t),
            2 => Self::unrolled::<ORDER, 2>(knots, t),
            3 => Self::unrolled::<ORDER, 3>(knots, t),
            4 => Self::unrolled::<ORDER, 4>(knots, t),
            5 => Self::unrolled::<ORDER, 5>(knots, t),
            6 => Self::unrolled::<ORDER, 6>(knots, t),
            7 => Self::unrolled::<ORDER, 7>(knots, t),
            8 => Self::unrolled::<ORDER, 8>(knots, t),
            9 => Self::unrolled::<ORDER, 9>(knots, t),
            _ => Self::unrolled::<ORDER, 0>(knots, t),
        }
    }

    /// `FIXED` is the degree where the reciprocals are known, else 0.
    #[inline]
    fn unrolled<const ORDER: usize, const FIXED: usize>(knots: &Knots<'_>, t: f64) -> Self {
        let degree = if FIXED > 0 { FIXED } else { knots.degree };
        let span = find_span(knots.values, degree, knots.count, t);
        let local = Local {
            values: &knots.values[span + 1 - degree..span + 1 + degree],
            degree,
            reciprocals: if FIXED > 0 {
                &knots.reciprocals[(span + 1 - degree) * degree..(span + 1) * degree]
            } else {
                &[]
            },
        };
        let mut rows = [R::zeros(degree + 1), R::zeros(degree + 1), R::zeros(degree + 1)];
        rows[0].as_mut()[0] = 1.0;
        for j in 1..=degree {
            if ORDER >= 2 && j + 1 == degree {
                rows[2] = rows[0].clone();
            }
            if ORDER >= 1 && j == degree {
                rows[1] = rows[0].clone();
            }
            local.raise::<FIXED>(j, t, rows[0].as_mut());
        }
        if ORDER >= 1 {
            local.differentiate::<FIXED>(degree, rows[1].as_mut());
        }
        if ORDER >= 2 && degree >= 2 {
            local.differentiate::<FIXED>(degree - 1, rows[2].as_mut());
            local.differentiate::<FIXED>(degree, rows[2].as_mut());
        }
        Self { first: span - degree, rows }
    }
}

impl Local<'_> {
    /// One over the difference of the knots `to` apart of which the upper one is the `r`-th after the span's start.
    #[inline(always)]
    fn reciprocal<const FIXED: usize>(&self, to: usize, r: usize) -> f64 {
        if FIXED > 0 {
            self.reciprocals[(FIXED + r - to) * FIXED + to - 1]
        } else {
            1.0 / (self.values[self.degree + r] - self.values[self.degree + r - to])
        }
    }

    /// From the functions of degree `to - 1` to those of degree `to`.
    #[inline(always)]
    fn raise<const FIXED: usize>(&self, to: usize, t: f64, values: &mut [f64]) {
        let degree = if FIXED > 0 { FIXED } else { self.degree };
        let mut saved = 0.0;
        for (r, value) in values[..to].iter_mut().enumerate() {
            let right = self.values[degree + r];
            let left = self.values[degree + r - to];
            let share = *value * self.reciprocal::<FIXED>(to, r);
            *value = saved + (right - t) * share;
            saved = (t - left) * share;
        }
        values[to] = saved;
    }

    /// From the functions of degree `to - 1` (or some derivative of them) to the derivatives of those of degree `to`.
    #[inline(always)]
    fn differentiate<const FIXED: usize>(&self, to: usize, values: &mut [f64]) {
        let mut previous = 0.0;
        for (i, value) in values[..to].iter_mut().enumerate() {
            let slope = *value * to as f64 * self.reciprocal::<FIXED>(to, i);
            *value = previous - slope;
            previous = slope;
        }
        values[to] = previous;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Piegl & Tiller, example 2.3: U = {0,0,0,1,2,3,4,4,5,5,5}, p = 2, u = 5/2.
    #[test]
    fn published_basis_values() {
        let knots = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 5.0, 5.0, 5.0];
        assert_eq!(find_span(&knots, 2, 8, 2.5), 4);
        let basis = Basis::<[f64; 4]>::new::<2, 0>(&Knots::of(&knots, 2, 8), 2.5);
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
                let basis =
                    Basis::<Vec<f64>>::new::<2, 0>(&Knots::of(&knots, degree, count), step as f64 / 20.0);
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
