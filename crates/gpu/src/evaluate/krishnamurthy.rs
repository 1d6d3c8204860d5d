//! Krishnamurthy, Khardekar, McMains 2009: basis functions by order, then the tensor product, point by point.

use glam::Vec4;

use super::bezier::points_of_workgroup;
use crate::batch::Batch;
use crate::device::Key;
use crate::{Backend, Gpu, Quantities};

pub(super) fn encode(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    batch: &Batch,
    layout: Backend,
    quantities: Quantities,
    out: &wgpu::Buffer,
) {
    let width = batch.width as u32;
    let is_packed = layout == Backend::KrishnamurthyPacked;
    let lines = gpu.upload("lines", &batch.lines);
    let basis = basis(gpu, encoder, batch, layout, &lines);
    let jobs = gpu.upload("jobs", &batch.jobs);
    let control = gpu.upload("control points", &batch.control);
    let facets = gpu.upload("facets", &batch.facets);
    let tiles = batch.point_tiles(points_of_workgroup(batch));
    let key = Key::new("tensor_points", "main")
        .with("WIDTH", width)
        .with("STRIDE", quantities.stride() as u32)
        .with("PACKED", u32::from(is_packed));
    let buffers = [&jobs, &gpu.upload("tiles", &tiles), &lines, &basis, &control, &facets, out];
    gpu.dispatch(encoder, &key, &buffers, tiles.len());
}

/// One pass per order, from the row of order 1 on (section 4).
fn basis(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    batch: &Batch,
    layout: Backend,
    lines: &wgpu::Buffer,
) -> wgpu::Buffer {
    let width = batch.width;
    let lanes = if layout == Backend::KrishnamurthyPacked { 4 } else { 1 };
    let rows = batch.lines.len().div_ceil(lanes);
    let (knots, shader) = match layout {
        Backend::KrishnamurthyPacked => (gpu.upload("knots", &packed_knots(batch)), "krishnamurthy_packed"),
        Backend::KrishnamurthyIndexed => (gpu.upload("knots", &batch.knots), "krishnamurthy_indexed"),
        _ => (gpu.upload("knots", &unpacked_knots(batch)), "krishnamurthy_unpacked"),
    };
    let mut first = vec![0f32; rows * lanes * (width + 2)];
    for (index, line) in batch.lines.iter().enumerate() {
        let place = (index / lanes) * (width + 2) + line.degree as usize;
        first[place * lanes + index % lanes] = 1.0;
    }
    let mut before = gpu.upload("basis of one order", &first);
    let mut after = gpu.upload("basis of the next order", &vec![0f32; first.len()]);
    let basis = gpu.reserve("basis", 12 * (rows * lanes * width) as u64);
    let key = Key::new(shader, "main").with("WIDTH", width as u32);
    for degree in 0..width as u32 {
        let pass = gpu.upload("pass", &[degree, 0, 0, 0]);
        let buffers = [lines, &knots, &pass, &before, &after, &basis];
        gpu.dispatch(encoder, &key, &buffers, (rows * width).div_ceil(64));
        std::mem::swap(&mut before, &mut after);
    }
    basis
}

/// The parameter of each line and the 2 (degree + 1) knots around its span, as wide as the batch's largest order asks.
fn rows_of_knots(batch: &Batch) -> impl Iterator<Item = Vec<f32>> + '_ {
    let stride = 2 * batch.width + 3;
    batch.lines.iter().map(move |line| {
        let own = &batch.knots[line.knots as usize..][..2 * line.degree as usize + 2];
        let mut row = Vec::with_capacity(stride);
        row.push(line.t);
        row.extend(own);
        // What lies beyond is met by functions that vanish.
        row.resize(stride, own.last().copied().unwrap_or(0.0));
        row
    })
}

fn unpacked_knots(batch: &Batch) -> Vec<f32> {
    rows_of_knots(batch).flatten().collect()
}

fn packed_knots(batch: &Batch) -> Vec<Vec4> {
    let rows: Vec<Vec<f32>> = rows_of_knots(batch).collect();
    let stride = 2 * batch.width + 3;
    let mut out = Vec::with_capacity(rows.len().div_ceil(4) * stride);
    for four in rows.chunks(4) {
        let lane = |k: usize, m: usize| four.get(k).map_or(0.0, |row| row[m]);
        out.extend((0..stride).map(|m| Vec4::new(lane(0, m), lane(1, m), lane(2, m), lane(3, m))));
    }
    out
}
