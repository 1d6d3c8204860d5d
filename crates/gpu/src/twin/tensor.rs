//! Twin of `shaders/tensor_points.wgsl`.

use glam::Vec4;

use super::finish::{Jet, finish};
use crate::Quantities;
use crate::batch::{Batch, Tile};

/// What products of control points with basis functions read.
#[derive(Clone, Copy)]
pub(crate) struct Product<'a> {
    pub batch: &'a Batch,
    /// As many values per line and order of derivative as the batch is wide.
    pub basis: &'a [f32],
    /// Whether four lines share a vector.
    pub is_packed: bool,
    pub quantities: Quantities,
}

impl Product<'_> {
    /// Twin of `basis_index` in `shaders/shared/basis.wgsl`.
    pub fn basis(&self, line: usize, derivative: usize, k: usize) -> f32 {
        let width = self.batch.width;
        self.basis[if self.is_packed {
            (((line / 4) * 3 + derivative) * width + k) * 4 + line % 4
        } else {
            (line * 3 + derivative) * width + k
        }]
    }
}

/// Point by point, the sum over the control points at the span.
pub(crate) fn tensor_points(product: &Product<'_>, tiles: &[Tile], out: &mut [Vec4]) {
    let Product { batch, quantities, .. } = *product;
    let stride = quantities.stride();
    for tile in tiles {
        let job = batch.jobs[tile.job as usize];
        for k in tile.start..tile.end {
            let (i, j) = if job.is_list == 1 { (k, k) } else { (k / job.columns, k % job.columns) };
            let [row_line, column_line] = [job.first_row + i, job.first_column + j].map(|n| n as usize);
            let (row, column) = (&batch.lines[row_line], &batch.lines[column_line]);
            let mut jet = Jet::default();
            for m in 0..=row.degree {
                let first = job.control + (row.first + m) * job.control_columns + column.first;
                let mut sums = [Vec4::ZERO; 3];
                for c in 0..=column.degree {
                    let p = batch.control[(first + c) as usize];
                    for (d, sum) in sums.iter_mut().enumerate() {
                        *sum += p * product.basis(column_line, d, c as usize);
                    }
                }
                let [a, av, avv] = sums;
                let [n, dn, ddn] = [0, 1, 2].map(|d| product.basis(row_line, d, m as usize));
                jet.a += a * n;
                jet.av += av * n;
                jet.au += a * dn;
                jet.auv += av * dn;
                jet.avv += avv * n;
                jet.auu += a * ddn;
            }
            let facet = &batch.facets[(job.facet + row.span * job.facet_columns + column.span) as usize];
            let point = (job.first_point + k) as usize;
            finish(&jet, row, column, facet, quantities, &mut out[point * stride..][..stride]);
        }
    }
}
