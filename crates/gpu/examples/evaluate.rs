//! Evaluates all faces of a STEP or IGES file with every backend: points per second and the largest difference to f64.
//!
//! ```sh
//! cargo run --release -p trimloop-gpu --example evaluate -- fixtures/cadquery/plate_with_hole.step
//! ```
//!
//! `--grid N` makes it N x N points per face instead of 64 x 64.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context;
use trimloop_gpu::{
    Backend, Deviation, Evaluator, FaceShape, FaceShapes, Gpu, Places, Quantities, Request, Values,
};
use trimloop_import::ImportOptions;
use trimloop_trim::Tolerance;

fn main() -> anyhow::Result<()> {
    let mut grid = 64;
    let mut paths: Vec<PathBuf> = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--grid" {
            grid = arguments
                .next()
                .context("--grid needs a number")?
                .parse()
                .context("--grid needs a number")?;
        } else {
            paths.push(argument.into());
        }
    }
    anyhow::ensure!(!paths.is_empty(), "usage: evaluate FILE.step ...");
    let gpu = Gpu::headless()?;
    println!("device: {}{}", gpu.name(), if gpu.is_software() { " (software)" } else { "" });
    let mut faces = Vec::new();
    for path in &paths {
        let model = trimloop_import::read(path, &ImportOptions::default())
            .with_context(|| format!("reading {}", path.display()))?;
        for part in &model.parts {
            let tolerance = Tolerance { linear_mm: 0.01, angular_rad: 0.2 };
            let all = FaceShapes::new(part, tolerance).faces.into_iter();
            let lost = |face: usize, error| eprintln!("{}: face {face}: {error}", path.display());
            faces.extend(all.enumerate().filter_map(|(k, face)| face.map_err(|e| lost(k, e)).ok()));
        }
    }
    let exact = faces.iter().filter(|face| face.shape.is_nurbs()).count();
    println!("{} faces, {exact} of them NURBS, {grid} x {grid} points each\n", faces.len());
    println!("{:24} {:>14} {:>20} {:>16}", "backend", "points/s", "distance / size", "angle, degrees");
    for backend in Backend::ALL {
        run(&Evaluator::on_gpu(&gpu, backend), &faces, grid)?;
    }
    Ok(())
}

fn run(evaluator: &Evaluator, faces: &[FaceShape], grid: usize) -> anyhow::Result<()> {
    let request = |face| {
        let shape: &trimloop_gpu::Shape = face;
        Request { shape, places: Places::even(shape, grid, grid) }
    };
    let requests: Vec<Request<'_>> = faces.iter().map(|face| request(&face.shape)).collect();
    // The first run of a pipeline compiles it.
    evaluator.evaluate(&requests, Quantities::Normals)?;
    let start = Instant::now();
    let all = evaluator.evaluate(&requests, Quantities::Normals)?;
    let seconds = start.elapsed().as_secs_f64();
    let points: usize = all.iter().map(Values::len).sum();
    let all = requests.iter().zip(&all).map(|(request, values)| Deviation::of(request, values));
    let worst = all.fold(Deviation::default(), |a, b| Deviation {
        distance: a.distance.max(b.distance),
        angle_deg: a.angle_deg.max(b.angle_deg),
    });
    let rate = points as f64 / seconds;
    println!(
        "{:24} {rate:>14.3e} {:>20.2e} {:>16.5}",
        evaluator.backend().name(),
        worst.distance,
        worst.angle_deg
    );
    Ok(())
}
