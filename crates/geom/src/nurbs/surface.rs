//! Tensor product B-spline surfaces.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec2, DVec3, DVec4};

use super::basis::{self, Basis, Knots, Row, by_degree, find_span};
use super::closure::{self, Sides};
use super::control::{self, Control, lift_all, lower};
use super::{NurbsError, knots};
use crate::period::wrap;
use crate::project::SampleGrid;
use crate::{Aabb, Derivatives, Direction, Interval, Singularity};

/// A tensor product B-spline surface of any degree, rational or not; cloning shares the data.
///
/// Along u the domain is `[knots[0][p], knots[0][rows]]`, along v likewise with the columns. A direction whose two
/// sides coincide (within 1e-7 of the control net's size) counts as closed, and evaluation wraps its parameter into
/// the domain; elsewhere it clamps.
#[derive(Clone, Debug)]
pub struct NurbsSurface(Arc<Data>);

#[derive(Debug)]
struct Data {
    degrees: [usize; 2],
    shape: [usize; 2],
    points: Vec<DVec3>,
    weights: Vec<f64>,
    /// `(w x, w y, w z, w)`; empty when polynomial.
    homogeneous: Vec<DVec4>,
    knots: [Vec<f64>; 2],
    /// Of the differences of knots.
    reciprocals: [Vec<f64>; 2],
    domain: [Interval; 2],
    size: f64,
    sides: Sides,
    samples: OnceLock<SampleGrid>,
}

impl NurbsSurface {
    /// A surface with `rows` x `columns` control points, row-major, rows running over u, columns over v:
    /// `points[i * columns + j]`; full knot vectors. `weights` is empty for a polynomial surface; equal weights are
    /// dropped.
    ///
    /// # Errors
    /// The text names what does not fit; see [`crate::NurbsCurve::new`].
    pub fn new(
        degrees: [usize; 2],
        rows: usize,
        columns: usize,
        points: Vec<DVec3>,
        mut weights: Vec<f64>,
        mut knots: [Vec<f64>; 2],
    ) -> Result<Self, NurbsError> {
        if rows.checked_mul(columns) != Some(points.len()) {
            return Err(NurbsError(format!(
                "{} control points do not fill {rows} rows of {columns}",
                points.len()
            )));
        }
        let domain = [
            knots::check(" along u", degrees[0], rows, &mut knots[0])?,
            knots::check(" along v", degrees[1], columns, &mut knots[1])?,
        ];
        control::check(&points, &mut weights)?;
        let homogeneous = if weights.is_empty() { Vec::new() } else { lift_all(&points, &weights) };
        let size = Aabb::from_points(points.iter().copied()).diagonal();
        let shape = [rows, columns];
        let reciprocals = [0, 1].map(|d| basis::reciprocals(&knots[d], degrees[d]));
        let (sides, samples) = (Sides::default(), OnceLock::new());
        let mut surface = Data {
            degrees,
            shape,
            points,
            weights,
            homogeneous,
            knots,
            reciprocals,
            domain,
            size,
            sides,
            samples,
        };
        surface.sides = closure::sides(&surface.view());
        Ok(Self(Arc::new(surface)))
    }

    /// The surface of homogeneous control points `(w x, w y, w z, w)`, row-major.
    ///
    /// # Errors
    /// As [`NurbsSurface::new`].
    pub fn from_homogeneous(
        degrees: [usize; 2],
        rows: usize,
        columns: usize,
        points: &[DVec4],
        knots: [Vec<f64>; 2],
    ) -> Result<Self, NurbsError> {
        let (points, weights) = points.iter().map(|&p| lower(p)).unzip();
        Self::new(degrees, rows, columns, points, weights, knots)
    }

    /// Degrees [u, v].
    pub fn degrees(&self) -> [usize; 2] {
        self.0.degrees
    }

    /// [rows, columns]: control points along u, along v.
    pub fn shape(&self) -> [usize; 2] {
        self.0.shape
    }

    /// Control points, row-major (rows run over u).
    pub fn points(&self) -> &[DVec3] {
        &self.0.points
    }

    /// Weights in the same order, empty when polynomial.
    pub fn weights(&self) -> &[f64] {
        &self.0.weights
    }

    /// Full knot vectors [u, v].
    pub fn knots(&self) -> [&[f64]; 2] {
        [&self.0.knots[0], &self.0.knots[1]]
    }

    /// Control points as `(w x, w y, w z, w)`, row-major, with weight 1 when polynomial.
    pub fn homogeneous(&self) -> Vec<DVec4> {
        lift_all(&self.0.points, &self.0.weights)
    }

    /// The domain [u, v].
    pub fn domain(&self) -> [Interval; 2] {
        self.0.domain
    }

    /// Per direction the domain's length, where its two sides coincide.
    pub fn periods(&self) -> [Option<f64>; 2] {
        [0, 1].map(|d| self.0.sides.closed[d].then(|| self.0.domain[d].length()))
    }

    /// The sides of the domain that are single points.
    pub fn singularities(&self) -> Vec<Singularity> {
        let at = |direction: usize, upper: bool| {
            let interval = self.0.domain[direction];
            if upper { interval.end } else { interval.start }
        };
        let mut found = Vec::new();
        for (d, constant) in [(0, Direction::U), (1, Direction::V)] {
            for upper in [false, true] {
                if let Some(point) = self.0.sides.degenerate[d][usize::from(upper)] {
                    found.push(Singularity { constant, at: at(d, upper), point });
                }
            }
        }
        found
    }

    /// The diagonal of the control net's box.
    pub fn size(&self) -> f64 {
        self.0.size
    }

    /// The distinct knots of one direction's domain, both ends included.
    pub fn distinct_knots(&self, direction: Direction) -> Vec<f64> {
        let d = direction as usize;
        knots::distinct(&self.0.knots[d], self.0.domain[d])
    }

    /// The point at (u, v).
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.0.view().evaluate::<0>(self.settle(uv))[0]
    }

    /// Point and first derivatives at (u, v); the second ones are left zero.
    pub fn first_derivatives(&self, uv: DVec2) -> Derivatives {
        named(self.0.view().evaluate::<1>(self.settle(uv)))
    }

    /// Point, first and second derivatives at (u, v).
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        named(self.0.view().evaluate::<2>(self.settle(uv)))
    }

    /// The image under any affine map.
    ///
    /// # Errors
    /// When the map sends a control point beyond what f64 can hold.
    pub fn transformed(&self, map: &DAffine3) -> Result<Self, NurbsError> {
        let points = self.0.points.iter().map(|&p| map.transform_point3(p)).collect();
        let [rows, columns] = self.0.shape;
        Self::new(self.0.degrees, rows, columns, points, self.0.weights.clone(), self.0.knots.clone())
    }

    /// Points on the grid `us` x `vs`, row-major over `us`. The basis is evaluated once per row and once per column.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Vec<DVec3> {
        let data = &*self.0;
        by_degree!(data.degrees, R, P => {
            if data.homogeneous.is_empty() {
                self.contract_grid::<_, R, P>(&data.points, us, vs, |p| p)
            } else {
                self.contract_grid::<_, R, P>(&data.homogeneous, us, vs, |p: DVec4| p.truncate() / p.w)
            }
        })
    }

    fn contract_grid<P: Control, R: Row, const FIXED: usize>(
        &self,
        points: &[P],
        us: &[f64],
        vs: &[f64],
        finish: impl Fn(P) -> DVec3,
    ) -> Vec<DVec3> {
        let data = &*self.0;
        let [pu, pv] = if FIXED > 0 { [FIXED; 2] } else { data.degrees };
        let columns = data.shape[1];
        let knots = [0, 1].map(|d| data.knots(d));
        let basis = |d: usize, t| Basis::<R>::new::<0, FIXED>(&knots[d], self.settle_along(d, t));
        let across: Vec<Basis<R>> = vs.iter().map(|&v| basis(1, v)).collect();
        let mut grid = Vec::with_capacity(us.len() * vs.len());
        let mut line = vec![P::ZERO; columns];
        for &u in us {
            let along = basis(0, u);
            line.fill(P::ZERO);
            for (i, &n) in along.rows[0].as_ref()[..=pu].iter().enumerate() {
                let row = &points[(along.first + i) * columns..][..columns];
                line.iter_mut().zip(row).for_each(|(sum, &p)| *sum += p * n);
            }
            grid.extend(across.iter().map(|b| {
                let mut sum = P::ZERO;
                let line = &line[b.first..=b.first + pv];
                line.iter().zip(b.rows[0].as_ref()).for_each(|(&p, &n)| sum += p * n);
                finish(sum)
            }));
        }
        grid
    }

    /// Point, first and second derivatives on the grid `us` x `vs`, row-major over `us`. The basis is evaluated once
    /// per row and once per column.
    pub fn derivatives_grid(&self, us: &[f64], vs: &[f64]) -> Vec<Derivatives> {
        let data = &*self.0;
        by_degree!(data.degrees, R, P => {
            let knots = [0, 1].map(|d| data.knots(d));
            let basis = |d: usize, t: f64| Basis::<R>::new::<2, P>(&knots[d], self.settle_along(d, t));
            let columns = data.shape[1];
            let across: Vec<Basis<R>> = vs.iter().map(|&v| basis(1, v)).collect();
            let mut grid = Vec::with_capacity(us.len() * vs.len());
            for &u in us {
                let along = basis(0, u);
                if data.homogeneous.is_empty() {
                    grid.extend(across.iter().map(|across| {
                        named(contract::<_, _, 2, P>(&data.points, columns, &along, across, data.degrees))
                    }));
                } else {
                    grid.extend(across.iter().map(|across| {
                        let sums = contract::<_, _, 2, P>(&data.homogeneous, columns, &along, across, data.degrees);
                        named(control::project_surface::<2>(sums))
                    }));
                }
            }
            grid
        })
    }

    /// The parameters that belong to the control point nearest to `point`: the averages of the knots that it rules
    /// (Greville abscissae).
    pub(crate) fn near_control_point(&self, point: DVec3) -> DVec2 {
        let data = &*self.0;
        let distances = data.points.iter().map(|p| p.distance_squared(point));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k);
        let greville = |d: usize, index: usize| {
            let knots = &data.knots[d][index + 1..=index + data.degrees[d]];
            data.domain[d].clamp(knots.iter().sum::<f64>() / knots.len() as f64)
        };
        DVec2::new(greville(0, nearest / data.shape[1]), greville(1, nearest % data.shape[1]))
    }

    /// A box that holds the part over `domain`: of all control points that it depends on, so wider than the hull of the
    /// part cut out, and found at once. On a closed direction, all of it where `domain` leaves the surface's own.
    pub fn net_bounds(&self, domain: [Interval; 2]) -> Aabb {
        let data = &*self.0;
        let lines = [0, 1].map(|d| {
            let (own, degree, count) = (data.domain[d], data.degrees[d], data.shape[d]);
            if data.sides.closed[d] && (domain[d].start < own.start || domain[d].end > own.end) {
                return 0..count;
            }
            let span = |t: f64| find_span(&data.knots[d], degree, count, own.clamp(t));
            span(domain[d].start) - degree..span(domain[d].end) + 1
        });
        let [rows, columns] = lines;
        let row = |i: usize| &data.points[i * data.shape[1]..][columns.clone()];
        Aabb::from_points(rows.flat_map(row).copied())
    }

    /// Bounds of the lengths of Suu, Suv and Svv over `domain`: the longest of their own control points that count there
    /// (Piegl & Tiller eq. 3.8 and 3.24). `None` of rational surfaces, where a first derivative may jump inside of
    /// `domain`, and where that is not inside the surface's own.
    pub fn second_derivative_bounds(&self, domain: [Interval; 2]) -> Option<[f64; 3]> {
        let data = &*self.0;
        let inside =
            |d: usize| data.domain[d].start <= domain[d].start && domain[d].end <= data.domain[d].end;
        if !data.homogeneous.is_empty() || !inside(0) || !inside(1) {
            return None;
        }
        let [along, across] = [0, 1].map(|d| DerivativeKnots::new(data, d, domain[d]));
        let (along, across) = (along?, across?);
        let columns = data.shape[1];
        let at = |i: usize, j: usize| data.points[i * columns + j];
        let mut most = [0.0_f64; 3];
        for i in along.lines.clone() {
            for j in across.lines.clone() {
                if let Some([a, b]) = along.second(i) {
                    let bend = (at(i + 2, j) - at(i + 1, j)) * b - (at(i + 1, j) - at(i, j)) * a;
                    most[0] = most[0].max(bend.length());
                }
                if let Some([a, b]) = across.second(j) {
                    let bend = (at(i, j + 2) - at(i, j + 1)) * b - (at(i, j + 1) - at(i, j)) * a;
                    most[2] = most[2].max(bend.length());
                }
                if let (Some(a), Some(b)) = (along.first(i), across.first(j)) {
                    let twist = at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j);
                    most[1] = most[1].max(twist.length() * a * b);
                }
            }
        }
        most.iter().all(|bound| bound.is_finite()).then_some(most)
    }

    /// Points over the surface from which a global search starts.
    pub(crate) fn samples(&self) -> &SampleGrid {
        self.0.samples.get_or_init(|| SampleGrid::of_nurbs(self))
    }

    #[inline]
    fn settle_along(&self, d: usize, t: f64) -> f64 {
        if self.0.sides.closed[d] { wrap(t, self.0.domain[d]) } else { self.0.domain[d].clamp(t) }
    }

    #[inline]
    fn settle(&self, uv: DVec2) -> DVec2 {
        DVec2::new(self.settle_along(0, uv.x), self.settle_along(1, uv.y))
    }
}

/// The knots of one direction, by which differences of control points become those of derivatives.
struct DerivativeKnots<'a> {
    knots: &'a [f64],
    degree: usize,
    /// The control points that count.
    lines: std::ops::Range<usize>,
}

impl<'a> DerivativeKnots<'a> {
    /// `None` where a first derivative may jump inside of `range`.
    fn new(data: &'a Data, d: usize, range: Interval) -> Option<Self> {
        let (knots, degree, count) = (&data.knots[d][..], data.degrees[d], data.shape[d]);
        let jumps = |run: &[f64]| run.len() >= degree && range.start < run[0] && run[0] < range.end;
        if knots.chunk_by(|a, b| a == b).any(jumps) {
            return None;
        }
        // A range that ends at a knot does not reach into the span behind it.
        let first = find_span(knots, degree, count, range.start) - degree;
        let last = knots[..=count].partition_point(|&k| k < range.end).clamp(degree + 1, count);
        Some(Self { knots, degree, lines: first..last })
    }

    /// What the difference from the control point `i` to the next one is multiplied by.
    fn first(&self, i: usize) -> Option<f64> {
        let length = (i + 1 < self.lines.end).then(|| self.knots[i + self.degree + 1] - self.knots[i + 1])?;
        (length > 0.0).then(|| self.degree as f64 / length)
    }

    /// Likewise that difference and the next one, for a control point of the second derivative.
    fn second(&self, i: usize) -> Option<[f64; 2]> {
        let (a, b) = (self.first(i)?, self.first(i + 1)?);
        let length = self.knots[i + self.degree + 1] - self.knots[i + 2];
        let share = (self.degree as f64 - 1.0) / length;
        (length > 0.0).then_some([a * share, b * share])
    }
}

fn named([point, du, dv, duu, duv, dvv]: [DVec3; 6]) -> Derivatives {
    Derivatives { point, du, dv, duu, duv, dvv }
}

impl Data {
    fn knots(&self, d: usize) -> Knots<'_> {
        Knots::with(&self.knots[d], self.degrees[d], self.shape[d], &self.reciprocals[d])
    }

    fn view(&self) -> View<'_> {
        View {
            degrees: self.degrees,
            shape: self.shape,
            points: &self.points,
            homogeneous: &self.homogeneous,
            knots: [&self.knots[0], &self.knots[1]],
            reciprocals: [&self.reciprocals[0], &self.reciprocals[1]],
            domain: self.domain,
            size: self.size,
        }
    }
}

/// What evaluation reads.
pub(super) struct View<'a> {
    pub degrees: [usize; 2],
    shape: [usize; 2],
    points: &'a [DVec3],
    homogeneous: &'a [DVec4],
    pub knots: [&'a [f64]; 2],
    reciprocals: [&'a [f64]; 2],
    pub domain: [Interval; 2],
    pub size: f64,
}

impl View<'_> {
    pub fn is_rational(&self) -> bool {
        !self.homogeneous.is_empty()
    }

    /// S, Su, Sv, Suu, Suv, Svv up to `ORDER` at parameters inside the domain (Piegl & Tiller A3.6, A4.4).
    #[inline]
    pub fn evaluate<const ORDER: usize>(&self, uv: DVec2) -> [DVec3; 6] {
        by_degree!(self.degrees, R, P => {
            let [along, across] = [0, 1].map(|d| {
                Knots::with(self.knots[d], self.degrees[d], self.shape[d], self.reciprocals[d])
            });
            let bu = Basis::<R>::new::<ORDER, P>(&along, uv.x);
            let bv = Basis::<R>::new::<ORDER, P>(&across, uv.y);
            if self.homogeneous.is_empty() {
                contract::<_, _, ORDER, P>(self.points, self.shape[1], &bu, &bv, self.degrees)
            } else {
                let sums = contract::<_, _, ORDER, P>(self.homogeneous, self.shape[1], &bu, &bv, self.degrees);
                control::project_surface::<ORDER>(sums)
            }
        })
    }
}

#[inline]
fn contract<P: Control, R: Row, const ORDER: usize, const FIXED: usize>(
    points: &[P],
    columns: usize,
    bu: &Basis<R>,
    bv: &Basis<R>,
    degrees: [usize; 2],
) -> [P; 6] {
    let [pu, pv] = if FIXED > 0 { [FIXED; 2] } else { degrees };
    let [u0, u1, u2] = bu.rows.each_ref().map(|r| &r.as_ref()[..=pu]);
    let [v0, v1, v2] = bv.rows.each_ref().map(|r| &r.as_ref()[..=pv]);
    let mut s = [P::ZERO; 6];
    for i in 0..=pu {
        let row = &points[(bu.first + i) * columns + bv.first..][..=pv];
        let [mut a0, mut a1, mut a2] = [P::ZERO; 3];
        for (j, &p) in row.iter().enumerate() {
            a0 += p * v0[j];
            if ORDER >= 1 {
                a1 += p * v1[j];
            }
            if ORDER >= 2 {
                a2 += p * v2[j];
            }
        }
        s[0] += a0 * u0[i];
        if ORDER >= 1 {
            s[1] += a0 * u1[i];
            s[2] += a1 * u0[i];
        }
        if ORDER >= 2 {
            s[3] += a0 * u2[i];
            s[4] += a1 * u1[i];
            s[5] += a2 * u0[i];
        }
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_keep_below_their_bounds() {
        let knots =
            [vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 0.0, 1.0, 1.5, 3.0, 3.0, 3.0]];
        let height = |i: usize, j: usize| ((3 * i + 5 * j) % 7) as f64 * 0.3;
        let points = (0..25).map(|k| DVec3::new((k / 5) as f64, (k % 5) as f64 * 0.8, height(k / 5, k % 5)));
        let surface =
            NurbsSurface::new([3, 2], 5, 5, points.collect(), Vec::new(), knots).expect("a surface");
        for domain in [[0.0, 1.0, 0.0, 3.0], [0.0, 0.4, 1.0, 1.5], [0.5, 0.9, 0.2, 1.2]] {
            let domain = [Interval::new(domain[0], domain[1]), Interval::new(domain[2], domain[3])];
            let bounds = surface.second_derivative_bounds(domain).expect("polynomial");
            let mut most = [0.0_f64; 3];
            for k in 0..=4000 {
                // Golden steps, and a hair inside: on a knot the derivatives are those behind it.
                let share = |step: f64| (k as f64 * step).fract() * 0.999_998 + 1e-6;
                let uv = DVec2::new(
                    domain[0].at(share(0.618_033_988_7)),
                    domain[1].at(k as f64 / 4000.0 * 0.999_998 + 1e-6),
                );
                let at = surface.derivatives(uv);
                let lengths = [at.duu, at.duv, at.dvv].map(DVec3::length);
                most = [0, 1, 2].map(|d| most[d].max(lengths[d]));
            }
            for d in 0..3 {
                assert!(most[d] <= bounds[d] * (1.0 + 1e-9), "{d}: {most:?} against {bounds:?}");
                assert!(bounds[d] < 4.0 * most[d], "{d}: {most:?} against {bounds:?}");
            }
        }
        let beyond = [Interval::new(-0.1, 0.5), Interval::new(0.0, 1.0)];
        assert_eq!(surface.second_derivative_bounds(beyond), None);
    }

    #[test]
    fn there_is_no_bound_across_a_crease() {
        let knots = [vec![0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 1.0]];
        let points = (0..6).map(|k| DVec3::new((k / 2) as f64, (k % 2) as f64, f64::from(k / 2 == 1)));
        let roof = NurbsSurface::new([1, 1], 3, 2, points.collect(), Vec::new(), knots).expect("a roof");
        let domain = |start: f64, end: f64| [Interval::new(start, end), Interval::new(0.0, 1.0)];
        assert_eq!(roof.second_derivative_bounds(domain(0.0, 2.0)), None);
        assert_eq!(roof.second_derivative_bounds(domain(0.0, 1.0)), Some([0.0; 3]));
    }
}
