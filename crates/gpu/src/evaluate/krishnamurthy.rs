//! Krishnamurthy, Khardekar, McMains 2009: basis functions by order, then the tensor product, point by point.

use glam::Vec4;

use super::bezier::points_of_workgroup;
use crate::batch::Batch;
use crate::device::{Key, Pass};
use crate::{Backend, Gpu, Quantities, twin};

pub(super) fn passes(
    gpu: &Gpu,
    batch: &Batch,
    layout: Backend,
    quantities: Quantities,
    out: &wgpu::Buffer,
) -> Vec<Pass> {
    let width = batch.width as u32;
    let is_packed = layout == Backend::KrishnamurthyPacked;
    let lines = gpu.upload("lines", &batch.lines);
    let (mut passes, basis) = basis(gpu, batch, layout, &lines);
    let jobs = gpu.upload("jobs", &batch.jobs);
    let control = gpu.upload("control points", &batch.control);
    let facets = gpu.upload("facets", &batch.facets);
    let tiles = batch.point_tiles(points_of_workgroup(batch));
    let key = Key::new("tensor_points", "main")
        .with("WIDTH", width)
        .with("STRIDE", quantities.stride() as u32)
        .with("PACKED", u32::from(is_packed));
    let buffers = [&jobs, &gpu.upload("tiles", &tiles), &lines, &basis, &control, &facets, out];
    passes.push(gpu.pass(&key, &buffers, tiles.len()));
    passes
}

/// The f32 twin of the passes.
pub(super) fn twin(batch: &Batch, layout: Backend, quantities: Quantities) -> Vec<Vec4> {
    let lanes = lanes(layout);
    let first = first_order(batch, lanes);
    let basis = match layout {
        Backend::KrishnamurthyPacked => twin::krishnamurthy_packed(batch, &packed_knots(batch), first),
        Backend::KrishnamurthyIndexed => twin::krishnamurthy_indexed(batch, &batch.knots, first),
        _ => twin::krishnamurthy_unpacked(batch, &unpacked_knots(batch), first),
    };
    let product = twin::Product { batch, basis: &basis, is_packed: lanes == 4, quantities };
    let mut out = vec![Vec4::ZERO; batch.points * quantities.stride()];
    twin::tensor_points(&product, &batch.point_tiles(points_of_workgroup(batch)), &mut out);
    out
}

/// Lines that share a row.
fn lanes(layout: Backend) -> usize {
    if layout == Backend::KrishnamurthyPacked { 4 } else { 1 }
}

/// The functions of order 1: a one in each span's place.
fn first_order(batch: &Batch, lanes: usize) -> Vec<f32> {
    let rows = batch.lines.len().div_ceil(lanes);
    let mut first = vec![0f32; rows * lanes * (batch.width + 2)];
    for (index, line) in batch.lines.iter().enumerate() {
        let place = (index / lanes) * (batch.width + 2) + line.degree as usize;
        first[place * lanes + index % lanes] = 1.0;
    }
    first
}

/// One pass per order, from the row of order 1 on (section 4).
fn basis(gpu: &Gpu, batch: &Batch, layout: Backend, lines: &wgpu::Buffer) -> (Vec<Pass>, wgpu::Buffer) {
    let width = batch.width;
    let lanes = lanes(layout);
    let rows = batch.lines.len().div_ceil(lanes);
    let (knots, shader) = match layout {
        Backend::KrishnamurthyPacked => (gpu.upload("knots", &packed_knots(batch)), "krishnamurthy_packed"),
        Backend::KrishnamurthyIndexed => (gpu.upload("knots", &batch.knots), "krishnamurthy_indexed"),
        _ => (gpu.upload("knots", &unpacked_knots(batch)), "krishnamurthy_unpacked"),
    };
    let first = first_order(batch, lanes);
    // The first row is only read, so that the passes can run again.
    let orders = [
        gpu.upload("basis of order 1", &first),
        gpu.reserve("basis of one order", size_of_val(&first[..]) as u64),
        gpu.reserve("basis of the next order", size_of_val(&first[..]) as u64),
    ];
    let basis = gpu.reserve("basis", 12 * (rows * lanes * width) as u64);
    let key = Key::new(shader, "main").with("WIDTH", width as u32);
    let pass = |degree: usize| {
        let number = gpu.upload("pass", &[degree as u32, 0, 0, 0]);
        let before = if degree == 0 { &orders[0] } else { &orders[1 + (degree + 1) % 2] };
        let buffers = [lines, &knots, &number, before, &orders[1 + degree % 2], &basis];
        gpu.pass(&key, &buffers, (rows * width).div_ceil(64))
    };
    ((0..width).map(pass).collect(), basis)
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
