//! Tan, Zhao, Lu 2012: de Boor's algorithm in one pass over the rows and one over the columns, region by region.

use glam::Vec4;

use super::bezier::LONGEST_LOOP;
use crate::batch::{Batch, Tile};
use crate::device::{Key, Pass};
use crate::{Gpu, Quantities, twin};

/// Elements of a workgroup.
fn tile_size(batch: &Batch, kinds: u32) -> u32 {
    let width = batch.width as u32;
    64 * (LONGEST_LOOP / (kinds * width * (width + 3) / 2)).clamp(1, 16)
}

pub(super) fn passes(gpu: &Gpu, batch: &Batch, quantities: Quantities, out: &wgpu::Buffer) -> Vec<Pass> {
    let kinds = quantities.kinds() as u32;
    let key =
        |name| Key::new(name, "main").with("KINDS", kinds).with_literal("MAX_ORDER", batch.width as u32);
    let lines = gpu.upload("lines", &batch.lines);
    let jobs = gpu.upload("jobs", &batch.jobs);
    let knots = gpu.upload("knots", &batch.knots);
    let control = gpu.upload("control points", &batch.control);
    let facets = gpu.upload("facets", &batch.facets);
    let scratch = gpu.reserve("rows", 16 * (batch.scratch * quantities.kinds()) as u64);

    let rows = row_tiles(batch, tile_size(batch, 1));
    let tiles = gpu.upload("tiles", &rows);
    let along_u =
        gpu.pass(&key("tan_rows"), &[&jobs, &tiles, &lines, &knots, &control, &scratch], rows.len());

    let columns = column_tiles(batch, tile_size(batch, kinds));
    let tiles = gpu.upload("tiles", &columns);
    let key = key("tan_columns").with("STRIDE", quantities.stride() as u32);
    let buffers = [&jobs, &tiles, &lines, &knots, &scratch, &facets, out];
    vec![along_u, gpu.pass(&key, &buffers, columns.len())]
}

/// The f32 twin of the passes.
pub(super) fn twin(batch: &Batch, quantities: Quantities) -> Vec<Vec4> {
    let kinds = quantities.kinds();
    let rows = twin::tan_rows(batch, &row_tiles(batch, tile_size(batch, 1)), kinds);
    twin::tan_columns(batch, &column_tiles(batch, tile_size(batch, kinds as u32)), &rows, quantities)
}

/// Elements (lines times control columns) whose lines lie in one span along u.
fn row_tiles(batch: &Batch, tile: u32) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for (number, job) in batch.jobs.iter().enumerate() {
        // In a list every point brings its own knots.
        let whole = 0..job.rows;
        let runs = if job.is_list == 1 { vec![whole] } else { batch.runs(job.first_row, job.rows) };
        for run in runs {
            let (start, end) = (run.start * job.scratch_columns, run.end * job.scratch_columns);
            tiles.extend((start..end).step_by(tile as usize).map(|start| Tile {
                job: number as u32,
                start,
                end: (start + tile).min(end),
                ..Tile::default()
            }));
        }
    }
    tiles
}

/// Points whose columns lie in one span along v.
fn column_tiles(batch: &Batch, tile: u32) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for (number, job) in batch.jobs.iter().enumerate() {
        let is_list = job.is_list == 1;
        let one = 0..1;
        let runs = if is_list { vec![one] } else { batch.runs(job.first_column, job.columns) };
        for run in runs {
            for first_line in run.clone().step_by(tile as usize) {
                let lines = (run.end - first_line).min(tile);
                let rows = (tile / lines).max(1);
                tiles.extend((0..job.rows).step_by(rows as usize).map(|start| Tile {
                    job: number as u32,
                    start,
                    end: (start + rows).min(job.rows),
                    first_line,
                    lines,
                    ..Tile::default()
                }));
            }
        }
    }
    tiles
}
