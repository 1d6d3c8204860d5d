//! Twins of `shaders/bezier_basis.wgsl` and `shaders/bezier_grid.wgsl`.

use glam::Vec4;

use super::finish::{Jet, finish};
use super::tensor::Product;
use crate::batch::{Line, Tile};

/// Bernstein polynomials and two derivatives: `width` values for each line and order of derivative.
pub(crate) fn bezier_basis(lines: &[Line], width: usize) -> Vec<f32> {
    let mut basis = vec![0.0; lines.len() * 3 * width];
    for (line, own) in lines.iter().zip(basis.chunks_mut(3 * width)) {
        let n = line.degree as usize;
        let top = |is_so: bool| if is_so { line.top } else { 1.0 };
        let first = line.power * top(n > 1);
        let [values, slopes, bends] = [0, 1, 2].map(|order| order * width);
        bernstein(&mut own[values..], n, line, first * top(n > 0));
        if n > 0 {
            bernstein(&mut own[slopes..], n - 1, line, first);
            differentiate(&mut own[slopes..], n);
        }
        if n > 1 {
            bernstein(&mut own[bends..], n - 2, line, line.power);
            differentiate(&mut own[bends..], n - 1);
            differentiate(&mut own[bends..], n);
        }
    }
    basis
}

fn bernstein(basis: &mut [f32], degree: usize, line: &Line, power: f32) {
    let mut value = power;
    for i in 0..=degree {
        basis[if line.knots == 1 { degree - i } else { i }] = value;
        value *= line.t * (degree - i) as f32 / (i + 1) as f32;
    }
}

fn differentiate(basis: &mut [f32], degree: usize) {
    let mut before = 0.0;
    for value in &mut basis[..degree] {
        let own = *value;
        *value = degree as f32 * (before - own);
        before = own;
    }
    basis[degree] = degree as f32 * before;
}

/// Grids tile by tile: the control points are reduced along u once per row, then every point sums along v.
pub(crate) fn bezier_grid(product: &Product<'_>, tiles: &[Tile], out: &mut [Vec4]) {
    let Product { batch, quantities, .. } = *product;
    let (kinds, stride) = (quantities.kinds(), quantities.stride());
    for tile in tiles {
        let job = batch.jobs[tile.job as usize];
        let (controls, count) = (tile.controls as usize, tile.lines as usize);
        for i in tile.start..tile.end {
            let row_line = (job.first_row + i) as usize;
            let row = &batch.lines[row_line];
            let mut reduced = vec![[Vec4::ZERO; 3]; controls];
            for (c, sums) in reduced.iter_mut().enumerate() {
                let first = job.control + row.first * job.control_columns + tile.first_control + c as u32;
                for k in 0..=row.degree {
                    let p = batch.control[(first + k * job.control_columns) as usize];
                    for (kind, sum) in sums.iter_mut().take(kinds).enumerate() {
                        *sum += p * product.basis(row_line, kind, k as usize);
                    }
                }
            }
            for j in tile.first_line..tile.first_line + count as u32 {
                let column_line = (job.first_column + j) as usize;
                let column = &batch.lines[column_line];
                let mut jet = Jet::default();
                for k in 0..=column.degree {
                    let [p, pu, puu] = reduced[(column.first - tile.first_control + k) as usize];
                    let [n, dn, ddn] = [0, 1, 2].map(|d| product.basis(column_line, d, k as usize));
                    jet.a += p * n;
                    jet.av += p * dn;
                    jet.au += pu * n;
                    jet.auv += pu * dn;
                    jet.avv += p * ddn;
                    jet.auu += puu * n;
                }
                let facet = &batch.facets[(job.facet + row.span * job.facet_columns + column.span) as usize];
                let point = (job.first_point + i * job.columns + j) as usize;
                finish(&jet, row, column, facet, quantities, &mut out[point * stride..][..stride]);
            }
        }
    }
}
