//! From a surface's own parameter to that of its NURBS form.

use trimloop_geom::Interval;

/// How the parameter of one direction becomes that of the NURBS form, span by span. Both agree at the ends of spans.
#[derive(Clone, Debug, Default)]
pub(crate) struct ParameterMap {
    spans: Vec<(Interval, Kind)>,
}

/// What happens inside a span.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Nothing.
    Linear,
    /// The parameter is an angle, and the span covers twice this many radians: an arc as a rational quadratic.
    Circular(f64),
    /// Likewise with the hyperbola's parameter.
    Hyperbolic(f64),
}

/// A parameter and its first two derivatives with respect to the caller's.
pub(crate) type Mapped = [f64; 3];

impl ParameterMap {
    /// The map between the `knots` (distinct, increasing) under which a quarter of each span lies at `quarter(k)`.
    pub fn fitted(knots: &[f64], mut quarter: impl FnMut(Interval) -> f64) -> Self {
        let spans = knots.windows(2).map(|pair| {
            let span = Interval::new(pair[0], pair[1]);
            let share = (quarter(span) - span.start) / span.length();
            (span, Kind::through(share))
        });
        Self { spans: spans.collect() }
    }

    /// The parameter for `u`; the one itself where nothing was fitted.
    pub fn at(&self, u: f64) -> Mapped {
        let above = self.spans.partition_point(|(span, _)| span.start <= u);
        match self.spans.get(above.saturating_sub(1)) {
            None => [u, 1.0, 0.0],
            Some((span, kind)) => {
                let length = span.length();
                let [share, slope, bend] = kind.at(((u - span.start) / length).clamp(0.0, 1.0));
                [span.start + share * length, slope, bend / length]
            }
        }
    }
}

impl Kind {
    /// The kind that maps a quarter to `share`. With s(x) for sin or sinh, a rational quadratic's parameter at the angle
    /// 2 x theta is s(x theta) / (s(x theta) + s((1 - x) theta)), and s(3a) = (3 ∓ 4 s(a)²) s(a).
    fn through(share: f64) -> Self {
        if !((share - 0.25).abs() > 1e-12) {
            return Self::Linear;
        }
        let square = 0.25 * (3.0 - (1.0 - share) / share);
        if square > 0.0 {
            Self::Circular(4.0 * square.sqrt().min(1.0).asin())
        } else {
            Self::Hyperbolic(4.0 * (-square).sqrt().asinh())
        }
    }

    /// Share of the span and its derivatives at the share `x` of the parameter.
    fn at(self, x: f64) -> Mapped {
        let y = 1.0 - x;
        let ([a, da], [b, db], whole) = match self {
            Self::Linear => return [x, 1.0, 0.0],
            Self::Circular(t) => {
                ([(x * t).sin(), t * (x * t).cos()], [(y * t).sin(), -t * (y * t).cos()], t * t.sin())
            }
            Self::Hyperbolic(t) => {
                ([(x * t).sinh(), t * (x * t).cosh()], [(y * t).sinh(), -t * (y * t).cosh()], t * t.sinh())
            }
        };
        let sum = a + b;
        let slope = whole / (sum * sum);
        [a / sum, slope, -2.0 * slope * (da + db) / sum]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_and_hyperbolas_are_found_again_from_a_quarter() {
        for kind in [Kind::Circular(0.7), Kind::Circular(1.5), Kind::Hyperbolic(0.9), Kind::Linear] {
            let quarter = kind.at(0.25)[0];
            let again = Kind::through(quarter);
            for x in [0.0, 0.1, 0.5, 0.8, 1.0] {
                let (was, is) = (kind.at(x), again.at(x));
                assert!((0..3).all(|k| (was[k] - is[k]).abs() < 1e-9), "{kind:?} {again:?} {was:?} {is:?}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_differences() {
        let map = ParameterMap { spans: vec![(Interval::new(1.0, 3.0), Kind::Circular(1.2))] };
        let h = 1e-4;
        for u in [1.3, 2.0, 2.9] {
            let [low, own, high] = [u - h, u, u + h].map(|u| map.at(u));
            assert!(((high[0] - low[0]) / (2.0 * h) - own[1]).abs() < 1e-7);
            assert!(((high[1] - low[1]) / (2.0 * h) - own[2]).abs() < 1e-7);
        }
    }
}
