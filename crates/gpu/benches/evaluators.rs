//! Tables of times and of ratios to an f64 loop that evaluates point by point, all measured in this run:
//!
//! - every backend from 8 x 8 to 2048 x 2048 points on the kind of surface of Krishnamurthy et al. 2009, figure 14 (bicubic,
//!   12 x 12 control points), left on the device and read back;
//! - 16², 64², 256² control points (Tan et al. 2012, figure 14);
//! - levels of detail: a step of a pyramid beside evaluating the level again, with what each level is off; grid sizes of
//!   10,000 shapes.
//!
//! `cargo bench -p trimloop-gpu`; `-- --quick` leaves out the largest grids. A time is the least of many runs. On the
//! device, many evaluations are submitted together and their time divided, as a renderer would meet them; `latency` is one
//! evaluation submitted and waited for.

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3, DVec4, Vec3, Vec4};
use trimloop_geom::{NurbsSurface, Surface};
use trimloop_gpu::{
    Backend, DevicePyramid, Evaluator, Gpu, LodShape, LodView, Places, Pyramid, Quantities, Request, Shape,
    Wavelet, lod_cells,
};

/// How long each figure is measured at least.
const ENOUGH: Duration = Duration::from_millis(300);

fn main() {
    let is_quick = std::env::args().any(|argument| argument == "--quick");
    // Test runners ask benchmarks what they hold.
    if std::env::args().any(|argument| argument == "--list") {
        return;
    }
    let gpu = match Gpu::headless() {
        Ok(gpu) => gpu,
        Err(error) => {
            println!("skipped: {error}");
            return;
        }
    };
    println!("device: {}{}", gpu.name(), if gpu.is_software() { " (software)" } else { "" });
    println!("cores: {}", rayon::current_num_threads());
    let sizes: &[usize] =
        if is_quick { &[8, 64, 256, 1024] } else { &[8, 16, 32, 64, 128, 256, 512, 1024, 2048] };
    grids(&gpu, sizes);
    control_points(&gpu);
    wavelets(&gpu);
    factors(&gpu);
}

/// The least time of a run, seconds.
fn least<T>(mut run: impl FnMut() -> T) -> f64 {
    black_box(run());
    let start = Instant::now();
    let mut least = f64::INFINITY;
    let mut runs = 0;
    while start.elapsed() < ENOUGH || runs < 3 {
        let one = Instant::now();
        black_box(run());
        least = least.min(one.elapsed().as_secs_f64());
        runs += 1;
    }
    least
}

/// The least time of an evaluation among many that are submitted together.
fn on_device(gpu: &Gpu, encode: impl Fn(&mut wgpu::CommandEncoder)) -> f64 {
    let several = |count: usize| {
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        (0..count).for_each(|_| encode(&mut encoder));
        let commands = encoder.finish();
        let start = Instant::now();
        gpu.queue().submit([commands]);
        gpu.wait("benchmark").expect("done");
        start.elapsed().as_secs_f64()
    };
    several(1);
    let count = ((0.02 / several(1)) as usize).clamp(1, 500);
    let start = Instant::now();
    let mut least = f64::INFINITY;
    while start.elapsed() < ENOUGH {
        least = least.min(several(count) / count as f64);
    }
    least
}

/// A wavy rational bicubic sheet of `count` x `count` control points.
fn sheet(count: usize) -> NurbsSurface {
    let spans = count - 3;
    let knots = [vec![0.0; 4], (1..spans).map(|k| k as f64 / spans as f64).collect(), vec![1.0; 4]].concat();
    let point = |k: usize| {
        let (x, y) = ((k / count) as f64, (k % count) as f64);
        DVec3::new(x, y, (0.7 * x).sin() * (0.5 * y).cos())
    };
    let points = (0..count * count).map(point).collect();
    let weights = (0..count * count).map(|k| 1.0 + 0.2 * (k as f64).sin()).collect();
    NurbsSurface::new([3; 2], count, count, points, weights, [knots.clone(), knots]).expect("valid")
}

fn shape_of(surface: &NurbsSurface) -> Shape {
    Shape::surface(&Surface::Nurbs(surface.clone()), surface.domain()).expect("finite")
}

/// The textbook's loop: span by bisection, de Boor's triangle along v for each row, then along u, in f64.
fn de_boor(surface: &NurbsSurface, control: &[DVec4], uv: DVec2) -> DVec3 {
    let [rows, columns] = surface.shape();
    let [ku, kv] = surface.knots();
    let (su, sv) = (span(ku, rows, uv.x), span(kv, columns, uv.y));
    let mut across = [DVec4::ZERO; 4];
    for (i, point) in across.iter_mut().enumerate() {
        let row = &control[(su - 3 + i) * columns + sv - 3..];
        *point = triangle([row[0], row[1], row[2], row[3]], kv, sv, uv.y);
    }
    let point = triangle(across, ku, su, uv.x);
    point.truncate() / point.w
}

fn span(knots: &[f64], count: usize, t: f64) -> usize {
    3 + knots[4..count].partition_point(|&k| k <= t)
}

fn triangle(mut points: [DVec4; 4], knots: &[f64], span: usize, t: f64) -> DVec4 {
    for r in 1..=3 {
        for j in (r..=3).rev() {
            let low = knots[span - 3 + j];
            let share = (t - low) / (knots[span + 1 + j - r] - low);
            points[j] = points[j - 1] * (1.0 - share) + points[j] * share;
        }
    }
    points[3]
}

fn point_by_point(surface: &NurbsSurface, places: &Places) -> f64 {
    let control = surface.homogeneous();
    let mut points = vec![DVec3::ZERO; places.len()];
    least(|| {
        for (k, point) in points.iter_mut().enumerate() {
            *point = de_boor(surface, &control, places.uv(k));
        }
        black_box(&mut points);
    })
}

fn line(name: &str, what: &str, points: usize, seconds: f64, reference: f64) {
    println!(
        "{name:24} {what:22} {:>12.4} {:>12.3e} {:>10.2}",
        seconds * 1e3,
        points as f64 / seconds,
        reference / seconds
    );
}

fn header(title: &str) {
    println!("\n{title}");
    println!("{:24} {:22} {:>12} {:>12} {:>10}", "backend", "", "ms", "points/s", "x f64 loop");
}

fn grids(gpu: &Gpu, sizes: &[usize]) {
    let surface = sheet(12);
    let shape = shape_of(&surface);
    for &size in sizes {
        let places = Places::even(&shape, size, size);
        let points = places.len();
        header(&format!("{size} x {size} points, bicubic, 144 control points"));
        let reference = point_by_point(&surface, &places);
        line("f64 point by point", "one thread", points, reference, reference);
        let request = [Request { shape: &shape, places }];
        let cpu = || {
            let mut values = Vec::new();
            least(|| {
                let done = Evaluator::on_cpu().evaluate_into(&request, Quantities::Points, &mut values);
                done.expect("evaluated");
            })
        };
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        line("cpu", "points, one thread", points, one.install(cpu), reference);
        line("cpu", "points, all threads", points, cpu(), reference);
        for backend in Backend::ALL.into_iter().filter(|backend| *backend != Backend::Cpu) {
            let evaluator = Evaluator::on_gpu(gpu, backend);
            for (what, quantities) in [("points", Quantities::Points), ("normals too", Quantities::Normals)] {
                let prepared = evaluator.prepare(&request, quantities).expect("prepared");
                let seconds = on_device(gpu, |encoder| prepared.encode(encoder));
                line(backend.name(), what, points, seconds, reference);
            }
            let prepared = evaluator.prepare(&request, Quantities::Points).expect("prepared");
            let latency = least(|| {
                prepared.run().expect("evaluated");
                gpu.wait("benchmark").expect("done");
            });
            line(backend.name(), "points, latency", points, latency, reference);
            let read_back = least(|| evaluator.evaluate(&request, Quantities::Points).expect("evaluated"));
            line(backend.name(), "points, read back", points, read_back, reference);
        }
    }
}

fn control_points(gpu: &Gpu) {
    for count in [16, 64, 256] {
        let surface = sheet(count);
        let shape = shape_of(&surface);
        let request = [Request { shape: &shape, places: Places::even(&shape, 512, 512) }];
        let points = 512 * 512;
        header(&format!("512 x 512 points, bicubic, {count} x {count} control points"));
        let reference = point_by_point(&surface, &request[0].places);
        line("f64 point by point", "one thread", points, reference, reference);
        for backend in Backend::ALL.into_iter().filter(|backend| *backend != Backend::Cpu) {
            let prepared =
                Evaluator::on_gpu(gpu, backend).prepare(&request, Quantities::Points).expect("prepared");
            let seconds = on_device(gpu, |encoder| prepared.encode(encoder));
            line(backend.name(), "points", points, seconds, reference);
        }
    }
}

/// A step down beside evaluating the coarser level again, and how far from the surface's points each leaves it.
fn wavelets(gpu: &Gpu) {
    let surface = sheet(12);
    let shape = shape_of(&surface);
    let evaluator = Evaluator::on_gpu(gpu, Backend::Bezier);
    println!("\nLevels of detail: off = largest distance from evaluating the level again, over the size");
    println!(
        "{:10} {:>12} {:>14} {:>20} {:>12}",
        "wavelet", "level", "step down, ms", "evaluate again, ms", "off"
    );
    for (wavelet, finest) in [(Wavelet::Haar, 1024), (Wavelet::Lifting, 1025)] {
        let values = |size: usize| {
            let request = [Request { shape: &shape, places: Places::even(&shape, size, size) }];
            let values = evaluator.evaluate(&request, Quantities::Points).expect("evaluated");
            let point = |k: usize| (values[0].point(k) - shape.origin()).as_vec3().extend(1.0);
            (0..size * size).map(point).collect::<Vec<Vec4>>()
        };
        let mut host = Pyramid::new(wavelet, finest, finest, values(finest)).expect("full");
        while host.can_go_down() && host.size()[0] > 16 {
            let down = least_of(7, || {
                let mut pyramid = DevicePyramid::new(gpu, &host).expect("small");
                gpu.wait("benchmark").expect("done");
                let start = Instant::now();
                pyramid.step(true).expect("down");
                gpu.wait("benchmark").expect("done");
                start.elapsed().as_secs_f64()
            });
            host.step(true);
            let size = host.size()[0];
            let request = [Request { shape: &shape, places: Places::even(&shape, size, size) }];
            let prepared = evaluator.prepare(&request, Quantities::Points).expect("prepared");
            let again = least(|| {
                prepared.run().expect("evaluated");
                gpu.wait("benchmark").expect("done");
            });
            let exact = values(size);
            let off = host.points().iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            println!(
                "{:10} {:>12} {:>14.4} {:>20.4} {:>12.1e}",
                wavelet.name(),
                format!("{size} x {size}"),
                down * 1e3,
                again * 1e3,
                f64::from(off) / shape.size()
            );
        }
    }
}

fn least_of(runs: usize, run: impl FnMut() -> f64) -> f64 {
    std::iter::repeat_with(run).take(runs).fold(f64::INFINITY, f64::min)
}

fn factors(gpu: &Gpu) {
    let shape = LodShape::new(&shape_of(&sheet(12)), DVec3::ZERO).expect("NURBS");
    let shapes: Vec<LodShape> = (0..10_000)
        .map(|k| LodShape { center: Vec3::new((k % 100) as f32, (k / 100) as f32, 0.0) * 20.0, ..shape })
        .collect();
    let view = LodView {
        eye: Vec3::new(1000.0, 1000.0, 500.0),
        pixel: 1e-3,
        chord_px: 0.25,
        cell_px: 64.0,
        fewest: 1.0,
        most: 256.0,
        is_parallel: 0,
        unused: [0; 3],
    };
    let device = least(|| lod_cells(gpu, &shapes, &view).expect("chosen"));
    let twin = least(|| shapes.iter().map(|shape| shape.cells(&view)).collect::<Vec<_>>());
    println!(
        "\nGrid sizes of 10,000 shapes: {:.3} ms (sent and read back), twin {:.3} ms",
        device * 1e3,
        twin * 1e3
    );
}
