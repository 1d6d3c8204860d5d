//! A flight around and into a model with each strategy: what a frame takes, and what it evaluates. `choose` is what choosing
//! levels of detail takes, evaluating included.
//!
//! `cargo run --release -p trimloop-render --example fly -- FILE... [--size WxH] [--instances N]`
//!
//! `--instances N` puts N x N copies of the file side by side.

use glam::{DAffine3, DVec3};
use trimloop_gpu::Gpu;
use trimloop_import::ImportOptions;
use trimloop_mesh::Silent;
use trimloop_render::{Camera, Direction, Lod, Look, Projection, Renderer, Scene, Up};

const FRAMES: u32 = 24;

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let (mut files, mut size, mut side) = (Vec::new(), [1280, 1024], 1u32);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().unwrap_or_default();
        match argument.as_str() {
            "--size" => {
                let text = value();
                let (width, height) = text.split_once('x').unwrap_or((&text, &text));
                size = [width.parse()?, height.parse()?];
            }
            "--instances" => side = value().parse()?,
            _ => files.push(argument),
        }
    }
    let gpu = Gpu::headless()?;
    println!("{}; {} x {} pixels, {FRAMES} frames", gpu.name(), size[0], size[1]);
    println!(
        "{:32} {:16} {:>8} {:>9} {:>9} {:>9} {:>9} {:>11} {:>12} {:>9} {:>10}",
        "file",
        "strategy",
        "faces",
        "first ms",
        "mean ms",
        "worst ms",
        "choose ms",
        "points 1st",
        "points/frame",
        "triangles",
        "KiB/face"
    );
    for file in files {
        let mut model = trimloop_import::read(file.as_ref(), &ImportOptions::default())?;
        model.show_hidden();
        for lod in Lod::ALL {
            let mut scene = Scene::new(&model, &Silent)?;
            spread(&mut scene, side);
            let unique = scene.face_count();
            let outline = scene.outline();
            let mut renderer = Renderer::new(&gpu, scene)?;
            let look = Look { lod, ..Look::default() };
            let mut times = Vec::new();
            let (mut first, mut evaluated, mut triangles, mut chosen) = (0, 0, 0, 0.0);
            for frame in 0..FRAMES {
                let share = f64::from(frame) / f64::from(FRAMES);
                let direction =
                    Direction { azimuth_deg: 45.0 + 90.0 * share, elevation_deg: 30.0 - 20.0 * share };
                let view = Projection::Perspective { fov_y_rad: 0.5 };
                let aspect = f64::from(size[0]) / f64::from(size[1]);
                let fitted = Camera::fit(&outline, direction, Up::Z, view, aspect);
                let Some(mut camera) = fitted else { continue };
                // Closer with every frame, to a quarter of the distance.
                let middle = outline.iter().sum::<DVec3>() / outline.len() as f64;
                camera.eye = middle + (camera.eye - middle) * (1.0 - 0.75 * share);
                renderer.picture(&camera, size, &look)?;
                let statistics = renderer.statistics();
                if frame == 0 {
                    // The first one also builds the pipelines.
                    first = statistics.evaluated;
                } else {
                    evaluated += statistics.evaluated;
                    chosen += statistics.evaluate_s * 1e3;
                }
                times.push(statistics.total_s * 1e3);
                triangles = triangles.max(statistics.triangles);
            }
            let later = &times[1..];
            let name: String = file.chars().rev().take(32).collect::<Vec<_>>().into_iter().rev().collect();
            println!(
                "{name:32} {:16} {:>8} {:>9.1} {:>9.1} {:>9.1} {:>9.2} {:>11} {:>12} {:>9} {:>10.1}",
                lod.name(),
                unique * (side * side) as usize,
                times[0],
                later.iter().sum::<f64>() / later.len() as f64,
                later.iter().copied().fold(0.0, f64::max),
                chosen / later.len() as f64,
                first,
                evaluated / (FRAMES as usize - 1),
                triangles,
                renderer.statistics().bytes as f64 / 1024.0 / unique as f64,
            );
        }
    }
    Ok(())
}

/// Copies of everything side by side.
fn spread(scene: &mut Scene, side: u32) {
    let step = 1.2 * scene.bounds().diagonal();
    let own = scene.instances.clone();
    for k in 1..side * side {
        let offset = DVec3::new(f64::from(k % side), f64::from(k / side), 0.0) * step;
        let moved = own.iter().map(|i| {
            let mut copy = i.clone();
            copy.transform = DAffine3::from_translation(offset) * i.transform;
            copy
        });
        scene.instances.extend(moved);
    }
}
