//! A grid of points as two products: the control net by the basis along u, the result by the basis along v.

use glam::DVec3;
use rayon::prelude::*;
use trimloop_geom::nurbs::basis_functions;

use crate::shape::Net;

/// Points that one loop makes at a time.
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

    /// The points of the rows `us`, row-major.
    pub fn rows(&self, us: &[f64]) -> Vec<DVec3> {
        let mut out = vec![DVec3::ZERO; us.len() * self.columns];
        if self.columns == 0 {
            return out;
        }
        let rows = (TASK / self.columns).max(1);
        let blocks = out.par_chunks_mut(rows * self.columns).zip(us.par_chunks(rows));
        blocks.for_each(|(out, us)| {
            let arch = pulp::Arch::new();
            arch.dispatch(|| self.block(us, out));
        });
        out
    }

    #[inline(always)]
    fn block(&self, us: &[f64], out: &mut [DVec3]) {
        match self.net.degrees[1] + 1 {
            2 => self.block_of::<2>(us, out),
            3 => self.block_of::<3>(us, out),
            4 => self.block_of::<4>(us, out),
            6 => self.block_of::<6>(us, out),
            _ => self.block_of::<0>(us, out),
        }
    }

    /// `ORDER` is the order along v where it is known when compiling, else 0.
    #[inline(always)]
    fn block_of<const ORDER: usize>(&self, us: &[f64], out: &mut [DVec3]) {
        let count = self.net.shape[1];
        let mut line = [0; 4].map(|_: i32| vec![0.0; count]);
        for (&u, out) in us.iter().zip(out.chunks_exact_mut(self.columns)) {
            let (first, weights) = basis(self.net, 0, u);
            for (line, plane) in line.iter_mut().zip(&self.planes) {
                line.fill(0.0);
                for (i, &n) in weights.iter().enumerate() {
                    let row = &plane[(first + i) * count..][..count];
                    line.iter_mut().zip(row).for_each(|(sum, &p)| *sum += p * n);
                }
            }
            let mut out = out;
            for run in &self.runs {
                let (own, rest) = out.split_at_mut(run.len);
                self.run::<ORDER>(&line, run, own);
                out = rest;
            }
        }
    }

    #[inline(always)]
    fn run<const ORDER: usize>(&self, line: &[Vec<f64>; 4], run: &Run, out: &mut [DVec3]) {
        let order = if ORDER > 0 { ORDER } else { self.net.degrees[1] + 1 };
        let [x, y, z, w] = line.each_ref().map(|plane| &plane[run.first..run.first + order]);
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let mut sums = [[0.0; LANES]; 4];
            for k in 0..order {
                let weights = &run.weights[k * run.padded + block * LANES..][..LANES];
                for lane in 0..LANES {
                    sums[0][lane] += x[k] * weights[lane];
                    sums[1][lane] += y[k] * weights[lane];
                    sums[2][lane] += z[k] * weights[lane];
                    sums[3][lane] += w[k] * weights[lane];
                }
            }
            let mut points = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let inverse = 1.0 / sums[3][lane];
                points[0][lane] = sums[0][lane] * inverse + self.origin.x;
                points[1][lane] = sums[1][lane] * inverse + self.origin.y;
                points[2][lane] = sums[2][lane] * inverse + self.origin.z;
            }
            for (lane, out) in out.iter_mut().enumerate() {
                *out = DVec3::new(points[0][lane], points[1][lane], points[2][lane]);
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
