//! Proves pictures: for each file and view, how far every pixel is from the exact surface, and whether anything is open.
//!
//! `cargo run --release -p trimloop-render --example prove -- FILE... [--zoom N] [--lod NAME] [--verbose]`

use trimloop_gpu::Gpu;
use trimloop_import::ImportOptions;
use trimloop_mesh::Silent;
use trimloop_render::{Camera, CpuRenderer, Direction, Lod, Look, Projection, Renderer, Scene, Up, prove};

const SIZE: [u32; 2] = [1280, 1024];

fn main() -> anyhow::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let mut lod = Lod::Adaptive;
    let (mut files, mut zoom, mut is_verbose) = (Vec::new(), 1.0, false);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--lod" => {
                let name = arguments.next().unwrap_or_default();
                lod = Lod::named(&name).ok_or_else(|| anyhow::anyhow!("no strategy is called `{name}`"))?;
            }
            "--verbose" => is_verbose = true,
            "--zoom" => zoom = arguments.next().unwrap_or_default().parse()?,
            _ => files.push(argument),
        }
    }
    let gpu = Gpu::headless()?;
    let mut failed = 0;
    println!(
        "{:44} {:>5} {:>8} {:>9} {:>6} {:>7} {:>6} {:>6} {:>8}",
        "file", "view", "covered", "farthest", "off", "bridged", "cracks", "spills", "unproved"
    );
    for file in files {
        let mut model = trimloop_import::read(file.as_ref(), &ImportOptions::default())?;
        model.show_hidden();
        let scene = Scene::new(&model, &Silent)?;
        let outline = scene.outline();
        // Close by, triangles tell nothing.
        let reference = match zoom > 4.0 {
            true => None,
            false => {
                let copy = Scene::new(&model, &Silent)?;
                Some(CpuRenderer::with_deflection(&model, copy, 1e-4, &Silent)?)
            }
        };
        let mut renderer = Renderer::new(&gpu, scene)?;
        let views = [
            ("iso", Direction::ISO),
            ("front", Direction { azimuth_deg: 10.0, elevation_deg: 5.0 }),
            ("top", Direction { azimuth_deg: 200.0, elevation_deg: -60.0 }),
        ];
        for (name, direction) in views {
            let projection = Projection::Perspective { fov_y_rad: 0.5 };
            let Some(mut camera) = Camera::fit(&outline, direction, Up::Z, projection, 1.25) else {
                continue;
            };
            if let (true, Projection::Perspective { fov_y_rad }) = (zoom != 1.0, projection) {
                camera.projection =
                    Projection::Perspective { fov_y_rad: 2.0 * ((0.5 * fov_y_rad).tan() / zoom).atan() };
            }
            let proof =
                prove(&mut renderer, reference.as_ref(), &camera, SIZE, &Look { lod, ..Look::default() })?;
            failed += usize::from(!proof.holds());
            if is_verbose {
                println!("{}", renderer.statistics());
            }
            let short: String = file.chars().rev().take(44).collect::<Vec<_>>().into_iter().rev().collect();
            println!(
                "{short:44} {name:>5} {:>8} {:>9.3} {:>6} {:>7} {:>6} {:>6} {:>8}{}",
                proof.covered,
                proof.farthest_px,
                proof.off,
                proof.bridged,
                proof.cracks,
                proof.spills,
                proof.unproved,
                if proof.holds() { "" } else { "  fails" }
            );
        }
    }
    println!("{failed} fail");
    Ok(())
}
