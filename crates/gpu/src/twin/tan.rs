//! Twins of `shaders/tan_rows.wgsl` and `shaders/tan_columns.wgsl`.

use glam::Vec4;

use super::finish::{Jet, finish};
use crate::Quantities;
use crate::batch::{Batch, Tile};

/// Value and two derivatives from degree + 1 control points; `knots` begins with u_{i-k}.
fn de_boor(triangle: &mut [Vec4], knots: &[f32], t: f32) -> [Vec4; 3] {
    let p = triangle.len() - 1;
    let mut sums = [Vec4::ZERO; 3];
    for l in 1..=p {
        if l + 1 == p {
            let left = (triangle[1] - triangle[0]) / (knots[p + 1] - knots[p - 1]);
            let right = (triangle[2] - triangle[1]) / (knots[p + 2] - knots[p]);
            sums[2] = (right - left) * ((p * (p - 1)) as f32 / (knots[p + 1] - knots[p]));
        }
        if l == p {
            sums[1] = (triangle[1] - triangle[0]) * (p as f32 / (knots[p + 1] - knots[p]));
        }
        for j in 0..=p - l {
            let low = knots[j + l];
            let alpha = (t - low) / (knots[j + p + 1] - low);
            triangle[j] = triangle[j] * (1.0 - alpha) + triangle[j + 1] * alpha;
        }
    }
    sums[0] = triangle[0];
    sums
}

/// Every control row in u: `kinds` vectors per element.
pub(crate) fn tan_rows(batch: &Batch, tiles: &[Tile], kinds: usize) -> Vec<Vec4> {
    let mut scratch = vec![Vec4::ZERO; batch.scratch * kinds];
    for tile in tiles {
        let job = batch.jobs[tile.job as usize];
        for k in tile.start..tile.end {
            let (i, c) = (k / job.scratch_columns, k % job.scratch_columns);
            let row = &batch.lines[(job.first_row + i) as usize];
            let is_list = job.is_list == 1;
            let column = if is_list { batch.lines[(job.first_column + i) as usize].first + c } else { c };
            let point = |m: u32| {
                batch.control[(job.control + (row.first + m) * job.control_columns + column) as usize]
            };
            let mut triangle: Vec<Vec4> = (0..=row.degree).map(point).collect();
            let sums = de_boor(&mut triangle, &batch.knots[row.knots as usize..], row.t);
            let goal = (job.scratch + k) as usize * kinds;
            scratch[goal..goal + kinds].copy_from_slice(&sums[..kinds]);
        }
    }
    scratch
}

/// The same in v over what [`tan_rows`] left.
pub(crate) fn tan_columns(
    batch: &Batch,
    tiles: &[Tile],
    scratch: &[Vec4],
    quantities: Quantities,
) -> Vec<Vec4> {
    let (kinds, stride) = (quantities.kinds(), quantities.stride());
    let mut out = vec![Vec4::ZERO; batch.points * stride];
    for tile in tiles {
        let job = batch.jobs[tile.job as usize];
        let is_list = job.is_list == 1;
        for k in 0..(tile.end - tile.start) * tile.lines {
            let i = tile.start + k / tile.lines;
            let j = if is_list { i } else { tile.first_line + k % tile.lines };
            let row = &batch.lines[(job.first_row + i) as usize];
            let column = &batch.lines[(job.first_column + j) as usize];
            let first = if is_list { 0 } else { column.first };
            let base = (job.scratch + i * job.scratch_columns + first) as usize * kinds;
            let along = |kind: usize| {
                let point = |m: usize| scratch[base + m * kinds + kind];
                let mut triangle: Vec<Vec4> = (0..=column.degree as usize).map(point).collect();
                de_boor(&mut triangle, &batch.knots[column.knots as usize..], column.t)
            };
            let mut jet = Jet::default();
            [jet.a, jet.av, jet.avv] = along(0);
            if kinds > 1 {
                [jet.au, jet.auv, _] = along(1);
            }
            if kinds > 2 {
                [jet.auu, ..] = along(2);
            }
            let facet = &batch.facets[(job.facet + row.span * job.facet_columns + column.span) as usize];
            let point = (job.first_point + if is_list { i } else { i * job.columns + j }) as usize;
            finish(&jet, row, column, facet, quantities, &mut out[point * stride..][..stride]);
        }
    }
    out
}
