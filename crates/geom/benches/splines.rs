#![allow(missing_docs, reason = "criterion_group makes a public function")]
//! Points per second on B-spline surfaces and curves of degree 1 to 9, and projections per second onto a bicubic one.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use trimloop_geom::{Curve, DVec2, DVec3, NurbsCurve, NurbsSurface, Surface};

fn knots(degree: usize, spans: usize) -> Vec<f64> {
    let inner = (1..spans).map(|i| i as f64 / spans as f64);
    [vec![0.0; degree + 1], inner.collect(), vec![1.0; degree + 1]].concat()
}

/// A wavy sheet of 12 x 12 spans.
fn sheet(degree: usize, rational: bool) -> Surface {
    let count = degree + 12;
    let point = |i: usize, j: usize| {
        let (x, y) = (i as f64, j as f64);
        DVec3::new(x, y, (0.7 * x).sin() * (0.5 * y).cos())
    };
    let points = (0..count * count).map(|k| point(k / count, k % count)).collect();
    let weights =
        if rational { (0..count * count).map(|k| 1.0 + 0.2 * (k as f64).sin()).collect() } else { vec![] };
    let knots = [knots(degree, 12), knots(degree, 12)];
    Surface::Nurbs(NurbsSurface::new([degree; 2], count, count, points, weights, knots).expect("valid"))
}

fn spline(degree: usize) -> Curve {
    let count = degree + 12;
    let points = (0..count).map(|i| DVec3::new(i as f64, (i as f64).sin(), (i as f64).cos())).collect();
    Curve::Nurbs(NurbsCurve::new(degree, points, vec![], knots(degree, 12)).expect("valid"))
}

/// Parameters all over the unit square, without order.
fn scattered() -> Vec<DVec2> {
    (0..1000).map(|i| DVec2::new(f64::from(i) * 0.618_034, f64::from(i) * 0.754_878).fract()).collect()
}

fn single_points(c: &mut Criterion) {
    let uvs = scattered();
    for (name, rational) in [("surface/single", false), ("surface/single-rational", true)] {
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(uvs.len() as u64));
        for degree in 1..=9 {
            let surface = sheet(degree, rational);
            group.bench_function(BenchmarkId::new("point", degree), |b| {
                b.iter(|| uvs.iter().map(|&uv| surface.point(uv)).sum::<DVec3>());
            });
            group.bench_function(BenchmarkId::new("first-derivatives", degree), |b| {
                b.iter(|| uvs.iter().map(|&uv| surface.first_derivatives(uv).du).sum::<DVec3>());
            });
            group.bench_function(BenchmarkId::new("second-derivatives", degree), |b| {
                b.iter(|| uvs.iter().map(|&uv| surface.derivatives(uv).duv).sum::<DVec3>());
            });
        }
    }
}

fn grids(c: &mut Criterion) {
    let steps: Vec<f64> = (0..64).map(|i| f64::from(i) / 63.0).collect();
    let mut group = c.benchmark_group("surface/grid");
    group.throughput(Throughput::Elements(64 * 64));
    for degree in 1..=9 {
        let surface = sheet(degree, false);
        group.bench_function(BenchmarkId::new("point", degree), |b| b.iter(|| surface.grid(&steps, &steps)));
    }
}

fn curve_points(c: &mut Criterion) {
    let uvs = scattered();
    let mut group = c.benchmark_group("curve/single");
    group.throughput(Throughput::Elements(uvs.len() as u64));
    for degree in 1..=9 {
        let curve = spline(degree);
        group.bench_function(BenchmarkId::new("point", degree), |b| {
            b.iter(|| uvs.iter().map(|uv| curve.point(uv.x)).sum::<DVec3>());
        });
    }
}

fn projections(c: &mut Criterion) {
    let (surface, curve) = (sheet(3, false), spline(3));
    let uvs: Vec<DVec2> = scattered().into_iter().take(100).collect();
    let on: Vec<DVec3> = uvs.iter().map(|&uv| surface.point(uv)).collect();
    let off: Vec<DVec3> = on.iter().map(|&p| p + DVec3::Z * 0.3).collect();
    let near = DVec2::new(0.01, -0.01);
    let mut group = c.benchmark_group("project");
    group.throughput(Throughput::Elements(uvs.len() as u64));
    for (name, points) in [("on", &on), ("off", &off)] {
        group.bench_function(BenchmarkId::new("surface-with-hint", name), |b| {
            b.iter(|| {
                points.iter().zip(&uvs).for_each(|(&p, &uv)| {
                    black_box(surface.project(p, Some(uv + near)));
                })
            });
        });
        group.bench_function(BenchmarkId::new("surface-without-hint", name), |b| {
            b.iter(|| {
                points.iter().for_each(|&p| {
                    black_box(surface.project(p, None));
                })
            });
        });
        group.bench_function(BenchmarkId::new("curve-with-hint", name), |b| {
            b.iter(|| {
                points.iter().zip(&uvs).for_each(|(&p, uv)| {
                    black_box(curve.project(p, Some(uv.x)));
                })
            });
        });
        group.bench_function(BenchmarkId::new("curve-without-hint", name), |b| {
            b.iter(|| {
                points.iter().for_each(|&p| {
                    black_box(curve.project(p, None));
                })
            });
        });
    }
}

criterion_group!(benches, single_points, grids, curve_points, projections);
criterion_main!(benches);
