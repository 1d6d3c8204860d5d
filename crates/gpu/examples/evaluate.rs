//! Evaluates all faces of STEP or IGES files with every backend: points per second and the largest difference to f64; how
//! far levels of detail are off; and the trim masks of all faces as a contact sheet.
//!
//! ```sh
//! cargo run --release -p trimloop-gpu --example evaluate -- fixtures/cadquery/bracket.step --masks masks.png
//! ```

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, ensure};
use glam::{DVec2, Vec4};
use tiny_skia::{Color, Pixmap, PremultipliedColorU8};
use trimloop_brep::Model;
use trimloop_gpu::{
    Backend, CHANNELS, Deviation, Evaluator, FaceShape, FaceShapes, Gpu, Places, Pyramid, Quantities,
    Request, Shape, TrimFans, TrimTable, TrimTexture, Values, Wavelet, trim_textures,
};
use trimloop_import::ImportOptions;
use trimloop_trim::Tolerance;
use trimloop_trim::curves::trim_curves;

const USAGE: &str = "usage: evaluate FILE... [--grid N] [--masks OUT.png] [--texels N]

  --grid N      N x N points per face (64)
  --masks FILE  writes the trim masks of all faces
  --texels N    N x N texels per mask (64)";

struct Options {
    grid: usize,
    texels: u32,
    masks: Option<PathBuf>,
    paths: Vec<PathBuf>,
}

/// A part and its faces.
struct Part<'a> {
    part: &'a trimloop_brep::Part,
    shapes: FaceShapes,
}

fn main() -> anyhow::Result<()> {
    let options = options()?;
    let gpu = Gpu::headless()?;
    println!("device: {}{}", gpu.name(), if gpu.is_software() { " (software)" } else { "" });
    let models = options.paths.iter().map(|path| read(path)).collect::<anyhow::Result<Vec<Model>>>()?;
    let tolerance = Tolerance { linear_mm: 0.01, angular_rad: 0.2 };
    let parts: Vec<Part<'_>> = models
        .iter()
        .flat_map(|model| &model.parts)
        .map(|part| Part { part, shapes: FaceShapes::new(part, tolerance) })
        .collect();
    for (part, face, error) in parts.iter().flat_map(|part| {
        let all = part.shapes.faces.iter().enumerate();
        all.filter_map(move |(k, face)| Some((part, k, face.as_ref().err()?)))
    }) {
        eprintln!("face {face} of {}: {error}", part.part.name);
    }
    let faces: Vec<&FaceShape> =
        parts.iter().flat_map(|part| &part.shapes.faces).filter_map(|face| face.as_ref().ok()).collect();
    ensure!(!faces.is_empty(), "there is no face");
    let exact = faces.iter().filter(|face| face.shape.is_nurbs()).count();
    let grid = options.grid;
    println!("{} faces, {exact} of them NURBS, {grid} x {grid} points each\n", faces.len());
    println!("{:24} {:>14} {:>20} {:>16}", "backend", "points/s", "distance / size", "angle, degrees");
    for backend in Backend::ALL {
        run(&Evaluator::on_gpu(&gpu, backend), &faces, grid)?;
    }
    levels(&faces);
    if let Some(path) = &options.masks {
        masks(&gpu, &parts, options.texels, path)?;
    }
    Ok(())
}

fn options() -> anyhow::Result<Options> {
    let mut options = Options { grid: 64, texels: 64, masks: None, paths: Vec::new() };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().with_context(|| format!("{argument} needs a value\n{USAGE}"));
        match argument.as_str() {
            "--grid" => options.grid = value()?.parse().context("--grid needs a number")?,
            "--texels" => options.texels = value()?.parse().context("--texels needs a number")?,
            "--masks" => options.masks = Some(value()?.into()),
            _ if argument.starts_with('-') => anyhow::bail!("what is {argument}?\n{USAGE}"),
            _ => options.paths.push(argument.into()),
        }
    }
    ensure!(!options.paths.is_empty() && options.grid > 0 && options.texels > 0, "{USAGE}");
    Ok(options)
}

fn read(path: &Path) -> anyhow::Result<Model> {
    let name = || format!("reading {}", path.display());
    trimloop_import::read(path, &ImportOptions::default()).with_context(name)
}

fn run(evaluator: &Evaluator, faces: &[&FaceShape], grid: usize) -> anyhow::Result<()> {
    let request = |shape| Request { shape, places: Places::even(shape, grid, grid) };
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

/// How far each level of a pyramid is from evaluating it again, over the faces' sizes.
fn levels(faces: &[&FaceShape]) {
    println!("\nlevels of detail: largest distance from evaluating again, over the size");
    for (wavelet, finest) in [(Wavelet::Haar, 64), (Wavelet::Lifting, 65)] {
        let mut worst: Vec<(usize, f64)> = Vec::new();
        for face in faces {
            let shape = &face.shape;
            let Ok(mut pyramid) = Pyramid::new(wavelet, finest, finest, points(shape, finest)) else {
                continue;
            };
            for level in 0.. {
                if !pyramid.can_go_down() || pyramid.size()[0] <= 4 {
                    break;
                }
                pyramid.step(true);
                let size = pyramid.size()[0];
                let exact = points(shape, size);
                let off =
                    pyramid.points().iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                if worst.len() == level {
                    worst.push((size, 0.0));
                }
                worst[level].1 = worst[level].1.max(f64::from(off) / shape.size());
            }
        }
        let levels: Vec<String> = worst.iter().map(|(size, off)| format!("{size}: {off:.1e}")).collect();
        println!("{:24} {}", wavelet.name(), levels.join("   "));
    }
}

/// A grid of points, relative to the shape's origin.
fn points(shape: &Shape, size: usize) -> Vec<Vec4> {
    let places = Places::even(shape, size, size);
    let local = |k: usize| (shape.derivatives(places.uv(k)).point - shape.origin()).as_vec3().extend(1.0);
    (0..places.len()).map(local).collect()
}

/// Draws the faces' trim masks, four to a texture, and writes them side by side.
fn masks(gpu: &Gpu, parts: &[Part<'_>], texels: u32, path: &Path) -> anyhow::Result<()> {
    let faces: Vec<(&Part<'_>, &FaceShape)> = parts
        .iter()
        .flat_map(|part| part.shapes.faces.iter().filter_map(move |face| Some((part, face.as_ref().ok()?))))
        .collect();
    let mut textures: Vec<TrimTexture> = Vec::with_capacity(faces.len());
    for four in faces.chunks(CHANNELS) {
        let fans: Vec<TrimFans> = four.iter().map(|(_, face)| fans(face)).collect();
        textures.extend(trim_textures(gpu, &fans, texels, texels)?);
    }
    let mut wrong = 0;
    let mut classified = 0;
    for ((part, face), texture) in faces.iter().zip(&textures) {
        let chains = trim_curves(part.part, face.face, &part.shapes.samples, &face.domain, 1e-6);
        let Ok(table) = TrimTable::new(&chains, 64) else { continue };
        let (low, high) = face.domain.uv_bounds();
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(texels);
        let places = (0..texels * texels).map(|k| DVec2::new(share(k % texels), share(k / texels)));
        let centres: Vec<DVec2> = places.map(|at| low + (high - low) * at).collect();
        let inside = table.classify(gpu, &centres)?;
        wrong +=
            inside.iter().zip(&texture.texels).filter(|(inside, texel)| **inside != (**texel == 255)).count();
        classified += inside.len();
    }
    write_sheet(&textures, texels, path)?;
    println!(
        "\ntrim masks of {texels} x {texels} texels: {}; {:.3} % of the texels differ from the exact classification",
        path.display(),
        100.0 * wrong as f64 / classified.max(1) as f64
    );
    Ok(())
}

fn fans(face: &FaceShape) -> TrimFans {
    let (low, high) = face.domain.uv_bounds();
    TrimFans::new(&face.domain, low, high)
}

fn write_sheet(textures: &[TrimTexture], texels: u32, path: &Path) -> anyhow::Result<()> {
    let across = (textures.len() as f64).sqrt().ceil() as u32;
    let down = (textures.len() as u32).div_ceil(across);
    let cell = texels + 4;
    let mut sheet = Pixmap::new(across * cell, down * cell).context("the sheet is too large")?;
    sheet.fill(Color::from_rgba8(90, 90, 100, 255));
    let width = sheet.width();
    let opaque =
        |v: u8| PremultipliedColorU8::from_rgba(v, v, v, 255).unwrap_or(PremultipliedColorU8::TRANSPARENT);
    let pixels = sheet.pixels_mut();
    for (number, texture) in (0u32..).zip(textures) {
        let corner = [(number % across) * cell + 2, (number / across) * cell + 2];
        for (k, texel) in (0u32..).zip(&texture.texels) {
            // v upwards.
            let (x, y) = (corner[0] + k % texels, corner[1] + texels - 1 - k / texels);
            pixels[(y * width + x) as usize] = opaque(if *texel == 255 { 245 } else { 25 });
        }
    }
    std::fs::write(path, sheet.encode_png()?).with_context(|| format!("writing {}", path.display()))
}
