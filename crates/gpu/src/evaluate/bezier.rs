//! Bézier facets: basis functions per line, then grids tile by tile through workgroup memory, lists point by point.

use glam::Vec4;

use crate::batch::{Batch, Job, Tile};
use crate::device::{Key, Pass};
use crate::{Gpu, Quantities, twin};

/// Vectors in workgroup memory, as in `shaders/bezier_grid.wgsl`.
const CAPACITY: u32 = 768;
/// Points of a tile.
const TILE: u32 = 1024;
/// Turns of all loops of an invocation together: llvmpipe breaks them off beyond 65535 (and says nothing).
pub(super) const LONGEST_LOOP: u32 = 32_768;

/// Points of a workgroup that goes point by point.
pub(super) fn points_of_workgroup(batch: &Batch) -> usize {
    let width = batch.width as u32;
    64 * (LONGEST_LOOP / (width * width)).clamp(1, 4) as usize
}

pub(super) fn passes(gpu: &Gpu, batch: &Batch, quantities: Quantities, out: &wgpu::Buffer) -> Vec<Pass> {
    let width = batch.width as u32;
    let stride = quantities.stride() as u32;
    let lines = gpu.upload("lines", &batch.lines);
    let basis = gpu.reserve("basis", 12 * (batch.lines.len() * batch.width) as u64);
    let basis_key = Key::new("bezier_basis", "main").with("WIDTH", width);
    let mut passes = vec![gpu.pass(&basis_key, &[&lines, &basis], batch.lines.len().div_ceil(64))];
    let jobs = gpu.upload("jobs", &batch.jobs);
    let control = gpu.upload("control points", &batch.control);
    let facets = gpu.upload("facets", &batch.facets);
    let kinds = quantities.kinds() as u32;
    let grids = grid_tiles(batch, CAPACITY / kinds);
    if !grids.is_empty() {
        let key =
            Key::new("bezier_grid", "main").with("WIDTH", width).with("STRIDE", stride).with("KINDS", kinds);
        let tiles = gpu.upload("tiles", &grids);
        let buffers = [&jobs, &tiles, &lines, &basis, &control, &facets, out];
        passes.push(gpu.pass(&key, &buffers, grids.len()));
    }
    let lists = list_tiles(batch);
    if !lists.is_empty() {
        let key = Key::new("tensor_points", "main").with("WIDTH", width).with("STRIDE", stride);
        let tiles = gpu.upload("tiles", &lists);
        let buffers = [&jobs, &tiles, &lines, &basis, &control, &facets, out];
        passes.push(gpu.pass(&key, &buffers, lists.len()));
    }
    passes
}

/// The f32 twin of the passes.
pub(super) fn twin(batch: &Batch, quantities: Quantities) -> Vec<Vec4> {
    let width = batch.width;
    let basis = twin::bezier_basis(&batch.lines, width);
    let product = twin::Product { batch, basis: &basis, is_packed: false, quantities };
    let mut out = vec![Vec4::ZERO; batch.points * quantities.stride()];
    twin::bezier_grid(&product, &grid_tiles(batch, CAPACITY / quantities.kinds() as u32), &mut out);
    twin::tensor_points(&product, &list_tiles(batch), &mut out);
    out
}

/// Tiles of the lists.
fn list_tiles(batch: &Batch) -> Vec<Tile> {
    let mut lists = batch.point_tiles(points_of_workgroup(batch));
    lists.retain(|tile| batch.jobs[tile.job as usize].is_list == 1);
    lists
}

/// Tiles of the grids, none of which needs more than `capacity` control points along v in all its rows.
fn grid_tiles(batch: &Batch, capacity: u32) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for (number, job) in batch.jobs.iter().enumerate().filter(|(_, job)| job.is_list == 0) {
        for (columns, controls) in column_runs(batch, job, capacity) {
            let count = columns.end - columns.start;
            let wanted = controls.end - controls.start;
            let rows = (TILE / count).min(capacity / wanted).clamp(1, job.rows);
            tiles.extend((0..job.rows).step_by(rows as usize).map(|start| Tile {
                job: number as u32,
                start,
                end: (start + rows).min(job.rows),
                unused: 0,
                first_line: columns.start,
                lines: count,
                first_control: controls.start,
                controls: wanted,
            }));
        }
    }
    tiles
}

/// Runs of columns of a grid, with the control points along v that each needs.
fn column_runs(batch: &Batch, job: &Job, capacity: u32) -> Vec<(std::ops::Range<u32>, std::ops::Range<u32>)> {
    let lines = &batch.lines[job.first_column as usize..(job.first_column + job.columns) as usize];
    let mut runs: Vec<(std::ops::Range<u32>, std::ops::Range<u32>)> = Vec::new();
    for (k, line) in (0u32..).zip(lines) {
        let own = line.first..line.first + line.degree + 1;
        if let Some((columns, controls)) = runs.last_mut() {
            let joint = controls.start.min(own.start)..controls.end.max(own.end);
            if joint.end - joint.start <= capacity && columns.end - columns.start < TILE {
                columns.end = k + 1;
                *controls = joint;
                continue;
            }
        }
        runs.push((k..k + 1, own));
    }
    runs
}
