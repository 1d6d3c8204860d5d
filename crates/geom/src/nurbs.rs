//! B-spline curves and surfaces, rational or not.

use glam::DVec3;

/// Why a B-spline cannot be built.
#[derive(Clone, Debug, PartialEq)]
pub struct NurbsError(pub String);

impl std::fmt::Display for NurbsError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for NurbsError {}

/// A B-spline curve.
#[derive(Clone, Debug)]
pub struct NurbsCurve {
    _private: (),
}

/// A tensor product B-spline surface.
#[derive(Clone, Debug)]
pub struct NurbsSurface {
    _private: (),
}

impl NurbsCurve {
    /// A curve of `degree` with full knot vector (`points.len() + degree + 1` values, not decreasing).
    /// `weights` is empty for a polynomial curve. Errors name what does not fit.
    pub fn new(
        degree: usize,
        points: Vec<DVec3>,
        weights: Vec<f64>,
        knots: Vec<f64>,
    ) -> Result<Self, NurbsError> {
        let _ = (degree, points, weights, knots);
        todo!()
    }
    /// Degree.
    pub fn degree(&self) -> usize {
        todo!()
    }
    /// Control points.
    pub fn points(&self) -> &[DVec3] {
        todo!()
    }
    /// Weights, empty when polynomial.
    pub fn weights(&self) -> &[f64] {
        todo!()
    }
    /// Full knot vector.
    pub fn knots(&self) -> &[f64] {
        todo!()
    }
}

impl NurbsSurface {
    /// A surface with `rows` x `columns` control points, row-major, rows running over u, columns over v:
    /// `points[i * columns + j]`; full knot vectors. `weights` is empty for a polynomial surface.
    pub fn new(
        degrees: [usize; 2],
        rows: usize,
        columns: usize,
        points: Vec<DVec3>,
        weights: Vec<f64>,
        knots: [Vec<f64>; 2],
    ) -> Result<Self, NurbsError> {
        let _ = (degrees, rows, columns, points, weights, knots);
        todo!()
    }
    /// Degrees [u, v].
    pub fn degrees(&self) -> [usize; 2] {
        todo!()
    }
    /// [rows, columns]: control points along u, along v.
    pub fn shape(&self) -> [usize; 2] {
        todo!()
    }
    /// Control points, row-major (rows run over u).
    pub fn points(&self) -> &[DVec3] {
        todo!()
    }
    /// Weights in the same order, empty when polynomial.
    pub fn weights(&self) -> &[f64] {
        todo!()
    }
    /// Full knot vectors [u, v].
    pub fn knots(&self) -> [&[f64]; 2] {
        todo!()
    }
}
