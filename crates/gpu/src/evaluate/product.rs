//! A grid of points as two products: the control net by the basis along u, the result by the basis along v.

use glam::DVec3;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;
use trimloop_geom::nurbs::basis_functions;

use crate::shape::Net;

/// Points that one turn makes: the widest vector of any machine.
const LANES: usize = 8;
/// Points of a task.
const TASK: usize = 16_384;

/// What all rows of a grid share.
pub(crate) struct Product<'a> {
    net: &'a Net,
    origin: DVec3,
    /// Coordinates x, y, z and weights of the control points, each row-major.
    planes: [Vec<f64>; 4],
    runs: Vec<Run>,
    columns: usize,
}

/// Neighbouring columns in one knot span.
struct Run {
    /// First control point along v.
    first: usize,
    len: usize,
    /// `len` rounded up to whole lanes.
    padded: usize,
    /// Values of the k-th basis function from `k * padded` on.
    weights: Vec<f64>,
}

impl<'a> Product<'a> {
    /// For the columns `vs`.
    pub fn new(net: &'a Net, origin: DVec3, vs: &[f64]) -> Self {
        let planes = [0, 1, 2, 3].map(|c| net.points.iter().map(|p| p[c]).collect());
        let basis: Vec<(usize, Vec<f64>)> = vs.iter().map(|&v| basis(net, 1, v)).collect();
        let runs = basis.chunk_by(|a, b| a.0 == b.0).map(Run::new).collect();
        Self { net, origin, planes, runs, columns: vs.len() }
    }

    /// The points of the rows `us`, row-major, in `out`, whose room is used again.
    pub fn rows(&self, us: &[f64], out: &mut Vec<DVec3>) {
        out.resize(us.len() * self.columns, DVec3::ZERO);
        if self.columns == 0 {
            return;
        }
        let rows = (TASK / self.columns).max(1);
        let arch = pulp::Arch::new();
        let blocks = out.par_chunks_mut(rows * self.columns).zip(us.par_chunks(rows));
        blocks.for_each(|(out, us)| arch.dispatch(Block { product: self, us, out }));
    }
}

/// Some rows of a grid.
struct Block<'a, 'b> {
    product: &'a Product<'a>,
    us: &'b [f64],
    out: &'b mut [DVec3],
}

impl WithSimd for Block<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match self.product.net.degrees[1] + 1 {
            2 => self.rows::<S, 2>(simd),
            3 => self.rows::<S, 3>(simd),
            4 => self.rows::<S, 4>(simd),
            6 => self.rows::<S, 6>(simd),
            _ => self.rows::<S, 0>(simd),
        }
    }
}

impl Block<'_, '_> {
    /// `ORDER` is the order along v where it is known when compiling, else 0.
    #[inline(always)]
    fn rows<S: Simd, const ORDER: usize>(self, simd: S) {
        let Self { product, us, out } = self;
        let count = product.net.shape[1];
        let mut line = [0; 4].map(|_: i32| vec![0.0; count]);
        for (&u, out) in us.iter().zip(out.chunks_exact_mut(product.columns)) {
            let (first, weights) = basis(product.net, 0, u);
            for (line, plane) in line.iter_mut().zip(&product.planes) {
                line.fill(0.0);
                for (i, &n) in weights.iter().enumerate() {
                    let row = &plane[(first + i) * count..][..count];
                    line.iter_mut().zip(row).for_each(|(sum, &p)| *sum += p * n);
                }
            }
            let mut out = out;
            for run in &product.runs {
                let (own, rest) = out.split_at_mut(run.len);
                product.run::<S, ORDER>(simd, &line, run, own);
                out = rest;
            }
        }
    }
}

impl Product<'_> {
    #[inline(always)]
    fn run<S: Simd, const ORDER: usize>(&self, simd: S, line: &[Vec<f64>; 4], run: &Run, out: &mut [DVec3]) {
        let order = if ORDER > 0 { ORDER } else { self.net.degrees[1] + 1 };
        let control = line.each_ref().map(|plane| &plane[run.first..run.first + order]);
        let origin = self.origin.to_array().map(|c| simd.splat_f64s(c));
        let vectors = LANES / S::F64_LANES;
        let (weights, _) = S::as_simd_f64s(&run.weights);
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let mut points = [[0.0; LANES]; 3];
            let [xs, ys, zs] = points.each_mut().map(|points| S::as_mut_simd_f64s(points).0);
            for vector in 0..vectors {
                let mut sums = [simd.splat_f64s(0.0); 4];
                for k in 0..order {
                    let weights = weights[(k * run.padded / LANES + block) * vectors + vector];
                    for (sum, control) in sums.iter_mut().zip(&control) {
                        *sum = simd.mul_add_e_f64s(simd.splat_f64s(control[k]), weights, *sum);
                    }
                }
                let inverse = simd.div_f64s(simd.splat_f64s(1.0), sums[3]);
                let place = |c: usize| simd.mul_add_e_f64s(sums[c], inverse, origin[c]);
                (xs[vector], ys[vector], zs[vector]) = (place(0), place(1), place(2));
            }
            let [x, y, z] = points;
            match <&mut [DVec3; LANES]>::try_from(&mut *out) {
                Ok(out) => *out = std::array::from_fn(|lane| DVec3::new(x[lane], y[lane], z[lane])),
                Err(_) => (0..out.len()).for_each(|lane| out[lane] = DVec3::new(x[lane], y[lane], z[lane])),
            }
        }
    }
}

impl Run {
    fn new(lines: &[(usize, Vec<f64>)]) -> Self {
        let (len, order) = (lines.len(), lines[0].1.len());
        let padded = len.next_multiple_of(LANES);
        let mut weights = vec![0.0; order * padded];
        for (j, (_, values)) in lines.iter().enumerate() {
            for (k, &value) in values.iter().enumerate() {
                weights[k * padded + j] = value;
            }
        }
        Self { first: lines[0].0, len, padded, weights }
    }
}

fn basis(net: &Net, d: usize, t: f64) -> (usize, Vec<f64>) {
    basis_functions(&net.knots[d], net.degrees[d], net.shape[d], t)
}
