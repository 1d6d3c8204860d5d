//! T-splines (Sederberg, Zheng, Bakenov, Nasri 2003): bicubic, rational, over T-meshes with T-junctions.

mod basis;
mod mesh;
mod text;

use glam::{DVec2, DVec3, DVec4};

pub use mesh::{MeshEdge, MeshVertex, TMesh};
pub use text::TextError;

use crate::nurbs::BezierPatch;
use crate::{Derivatives, Interval, NurbsError, NurbsSurface};

/// Why there is no T-spline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TSplineError {
    /// The lines of a direction make no sense.
    #[error(
        "the knots along {0} must be finite, never decrease, and be eight at least, of which the fourth lies before the fourth from the end"
    )]
    Knots(char),
    /// A vertex stands where none may.
    #[error("vertex {0} stands on lines {1}, {2}, which are none of the mesh's own")]
    Place(usize, usize, usize),
    /// Two vertices stand at one place.
    #[error("two vertices stand on lines {0}, {1}")]
    Twice(usize, usize),
    /// A weight is not positive, or a number is not finite.
    #[error("vertex {0} has a weight that is not positive, or a number that is not finite")]
    Number(usize),
    /// An edge leads from somewhere to nowhere.
    #[error("edge {0} joins no two places of one line")]
    Edge(usize),
    /// It would take too long.
    #[error("{0} x {1} lines with {2} vertices are too many")]
    TooLarge(usize, usize, usize),
    /// Somewhere in the domain no blending function is positive.
    #[error("the blending functions leave a hole at u = {0}, v = {1}")]
    Hole(f64, f64),
}

/// Cells of all lines times vertices.
const MOST_WORK: u128 = 4_000_000_000;

/// A bicubic rational T-spline surface.
///
/// Its point at (u, v) is the sum of `w P B(u) B(v)` over that of `w B(u) B(v)`, each vertex with the cubic B-splines of
/// its own five knots in each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct TSpline {
    points: Vec<TPoint>,
    domain: [Interval; 2],
    mesh: TMesh,
}

/// A control point with the knots of its blending functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TPoint {
    /// Where it is.
    pub position: DVec3,
    /// Its weight, positive.
    pub weight: f64,
    /// Five knots along u, five along v.
    pub knots: [[f64; 5]; 2],
}

impl TSpline {
    /// The surface over a T-mesh: each vertex takes its knots from the lines that rays from it meet (Sederberg et al. 2003,
    /// rule 1).
    ///
    /// # Errors
    /// See [`TSplineError`].
    pub fn new(mesh: TMesh) -> Result<Self, TSplineError> {
        mesh.check()?;
        let [rows, columns] = mesh.knots.each_ref().map(Vec::len);
        if (rows as u128) * (columns as u128) * (mesh.vertices.len() as u128) > MOST_WORK {
            return Err(TSplineError::TooLarge(rows, columns, mesh.vertices.len()));
        }
        let points = mesh.local_knots();
        let domain = mesh.domain();
        let spline = Self { points, domain, mesh };
        spline.check_holes()?;
        Ok(spline)
    }

    /// The mesh.
    pub fn mesh(&self) -> &TMesh {
        &self.mesh
    }

    /// The control points with their knots, in the mesh's order.
    pub fn points(&self) -> &[TPoint] {
        &self.points
    }

    /// The domain [u, v].
    pub fn domain(&self) -> [Interval; 2] {
        self.domain
    }

    /// The point at (u, v), held within the domain.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.derivatives(uv).point
    }

    /// The point and its derivatives, by the definition.
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        let [u, v] = self.domain;
        let (u_at, v_at) = (u.clamp(uv.x), v.clamp(uv.y));
        let mut sums = [[DVec4::ZERO; 3]; 3];
        for p in &self.points {
            if !p.reaches(0, u_at) || !p.reaches(1, v_at) {
                continue;
            }
            let bu = basis::derivatives(&p.knots[0], u_at, u.end);
            let bv = basis::derivatives(&p.knots[1], v_at, v.end);
            let lifted = (p.position * p.weight).extend(p.weight);
            for (i, bu) in bu.iter().enumerate() {
                for (j, bv) in bv.iter().enumerate().take(3 - i) {
                    sums[i][j] += lifted * (bu * bv);
                }
            }
        }
        // Piegl & Tiller A4.4.
        let w = sums[0][0].w;
        let a = |i: usize, j: usize| sums[i][j].truncate();
        let point = a(0, 0) / w;
        let du = (a(1, 0) - point * sums[1][0].w) / w;
        let dv = (a(0, 1) - point * sums[0][1].w) / w;
        let duu = (a(2, 0) - du * (2.0 * sums[1][0].w) - point * sums[2][0].w) / w;
        let dvv = (a(0, 2) - dv * (2.0 * sums[0][1].w) - point * sums[0][2].w) / w;
        let duv = (a(1, 1) - dv * sums[1][0].w - du * sums[0][1].w - point * sums[1][1].w) / w;
        Derivatives { point, du, dv, duu, duv, dvv }
    }

    /// The surface as bicubic rational Bézier patches, as few as its blending functions allow: the domain is cut along
    /// every knot line only as far as a function that has it reaches (Guthe, Balázs, Klein 2005: `convertToBezier`).
    pub fn convert_to_bezier(&self) -> Vec<BezierPatch> {
        let mut out = Vec::new();
        let mut open = vec![self.domain];
        while let Some(element) = open.pop() {
            match self.knot_inside(&element) {
                None => out.push(self.patch(element)),
                Some((d, at)) => {
                    let [mut low, mut high] = [element; 2];
                    low[d] = Interval::new(element[d].start, at);
                    high[d] = Interval::new(at, element[d].end);
                    open.extend([high, low]);
                }
            }
        }
        out
    }

    /// The same surface as one NURBS, with lines at every knot from border to border.
    ///
    /// # Errors
    /// Where numbers overflow.
    pub fn to_nurbs(&self) -> Result<NurbsSurface, NurbsError> {
        let lines = [0, 1].map(|d| self.distinct_knots(d));
        let counts = lines.each_ref().map(|lines| 3 * (lines.len() - 1) + 1);
        let mut net = vec![DVec4::ZERO; counts[0] * counts[1]];
        for (i, u) in lines[0].windows(2).enumerate() {
            for (j, v) in lines[1].windows(2).enumerate() {
                let patch = self.patch([Interval::new(u[0], u[1]), Interval::new(v[0], v[1])]);
                for (k, point) in patch.points.into_iter().enumerate() {
                    net[(3 * i + k / 4) * counts[1] + 3 * j + k % 4] = point;
                }
            }
        }
        let knots = lines.map(|lines| {
            let inner = lines[1..lines.len() - 1].iter().flat_map(|&t| [t; 3]);
            let (first, last) = (lines[0], lines[lines.len() - 1]);
            [first; 4].into_iter().chain(inner).chain([last; 4]).collect()
        });
        NurbsSurface::from_homogeneous([3, 3], counts[0], counts[1], &net, knots)
    }

    fn distinct_knots(&self, d: usize) -> Vec<f64> {
        let domain = self.domain[d];
        let mut all: Vec<f64> = self.points.iter().flat_map(|p| p.knots[d]).collect();
        all.retain(|t| *t > domain.start && *t < domain.end);
        all.extend([domain.start, domain.end]);
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// A knot inside of an element, of a function that reaches into it.
    fn knot_inside(&self, element: &[Interval; 2]) -> Option<(usize, f64)> {
        let reaching = self
            .points
            .iter()
            .filter(|p| (0..2).all(|d| p.knots[d][0] < element[d].end && p.knots[d][4] > element[d].start));
        let mut knots = reaching.flat_map(|p| {
            (0..2).flat_map(move |d| {
                p.knots[d]
                    .into_iter()
                    .filter(move |t| *t > element[d].start && *t < element[d].end)
                    .map(move |t| (d, t))
            })
        });
        knots.next()
    }

    /// The patch over an element without knots inside: outer products of the functions' Bernstein coefficients.
    fn patch(&self, element: [Interval; 2]) -> BezierPatch {
        let mut points = vec![DVec4::ZERO; 16];
        for p in &self.points {
            let (Some(bu), Some(bv)) =
                (basis::bernstein(&p.knots[0], element[0]), basis::bernstein(&p.knots[1], element[1]))
            else {
                continue;
            };
            let lifted = (p.position * p.weight).extend(p.weight);
            for (k, sum) in points.iter_mut().enumerate() {
                *sum += lifted * (bu[k / 4] * bv[k % 4]);
            }
        }
        BezierPatch { degrees: [3, 3], domain: element, points }
    }

    /// Everywhere some function must be positive: it is where each patch's middle and corners are.
    fn check_holes(&self) -> Result<(), TSplineError> {
        let lines = [0, 1].map(|d| self.distinct_knots(d));
        for u in lines[0].windows(2) {
            for v in lines[1].windows(2) {
                let middle = DVec2::new(0.5 * (u[0] + u[1]), 0.5 * (v[0] + v[1]));
                let weight: f64 = self
                    .points
                    .iter()
                    .filter(|p| p.reaches(0, middle.x) && p.reaches(1, middle.y))
                    .map(|p| {
                        let [bu, ..] = basis::derivatives(&p.knots[0], middle.x, self.domain[0].end);
                        let [bv, ..] = basis::derivatives(&p.knots[1], middle.y, self.domain[1].end);
                        p.weight * bu * bv
                    })
                    .sum();
                if !(weight > 1e-12) {
                    return Err(TSplineError::Hole(middle.x, middle.y));
                }
            }
        }
        Ok(())
    }
}

impl TPoint {
    fn reaches(&self, d: usize, t: f64) -> bool {
        self.knots[d][0] <= t && t <= self.knots[d][4]
    }
}

#[cfg(test)]
mod tests;
