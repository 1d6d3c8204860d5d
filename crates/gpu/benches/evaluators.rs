#![allow(missing_docs, reason = "criterion_group makes a public function")]
//! Every backend from 8 x 8 to 2048 x 2048 points on the surface of Krishnamurthy et al. 2009, figure 14 (bicubic,
//! 12 x 12 control points), and on 16², 64², 256² control points (Tan et al. 2012, figure 14). Beside them f64 loops
//! that evaluate point by point.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use trimloop_geom::{DVec2, DVec3, DVec4, NurbsSurface, Surface};
use trimloop_gpu::{Backend, Evaluator, Gpu, Places, Quantities, Request, Shape};

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

fn backends(c: &mut Criterion) {
    let gpu = Gpu::headless().expect("a device");
    println!("device: {}", gpu.name());
    let surface = sheet(12);
    let domain = surface.domain();
    let shape = Shape::surface(&Surface::Nurbs(surface.clone()), domain).expect("finite");
    let control = surface.homogeneous();
    for size in [8, 16, 64, 256, 1024, 2048] {
        let places = Places::even(&shape, size, size);
        let mut group = c.benchmark_group(format!("bicubic-144/{size}x{size}"));
        group.throughput(Throughput::Elements((size * size) as u64)).sample_size(10);
        group.bench_function("f64-per-point", |b| {
            b.iter(|| {
                let points = (0..places.len()).map(|k| de_boor(&surface, &control, places.uv(k)));
                black_box(points.collect::<Vec<DVec3>>())
            });
        });
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let request = || [Request { shape: &shape, places: places.clone() }];
        let cpu = Evaluator::on_cpu();
        group.bench_function("cpu/one-thread", |b| {
            let request = request();
            one.install(|| b.iter(|| cpu.evaluate(&request, Quantities::Points).expect("evaluated")));
        });
        group.bench_function("cpu/all-threads", |b| {
            let request = request();
            b.iter(|| cpu.evaluate(&request, Quantities::Points).expect("evaluated"));
        });
        for backend in &Backend::ALL[1..] {
            let evaluator = Evaluator::on_gpu(&gpu, *backend);
            for (name, quantities) in [("points", Quantities::Points), ("normals", Quantities::Normals)] {
                let request = request();
                group.bench_function(BenchmarkId::new(backend.name(), name), |b| {
                    b.iter(|| {
                        let values = evaluator.evaluate_on_device(&request, quantities).expect("evaluated");
                        gpu.wait("benchmark").expect("done");
                        values
                    });
                });
            }
            let request = request();
            group.bench_function(BenchmarkId::new(backend.name(), "points-read-back"), |b| {
                b.iter(|| evaluator.evaluate(&request, Quantities::Points).expect("evaluated"));
            });
        }
    }
}

fn control_points(c: &mut Criterion) {
    let gpu = Gpu::headless().expect("a device");
    for count in [16, 64, 256] {
        let surface = sheet(count);
        let domain = surface.domain();
        let shape = Shape::surface(&Surface::Nurbs(surface), domain).expect("finite");
        let request = [Request { shape: &shape, places: Places::even(&shape, 512, 512) }];
        let mut group = c.benchmark_group(format!("control-points/{count}x{count}"));
        group.throughput(Throughput::Elements(512 * 512)).sample_size(10);
        for backend in &Backend::ALL[1..] {
            let evaluator = Evaluator::on_gpu(&gpu, *backend);
            group.bench_function(backend.name(), |b| {
                b.iter(|| {
                    let values =
                        evaluator.evaluate_on_device(&request, Quantities::Points).expect("evaluated");
                    gpu.wait("benchmark").expect("done");
                    values
                });
            });
        }
    }
}

criterion_group!(benches, backends, control_points);
criterion_main!(benches);
