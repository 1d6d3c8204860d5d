//! Triangles per second from exact models: flat, elementary, free-form and many small parts.

#![allow(missing_docs, reason = "criterion's macros make public functions without documentation")]

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use trimloop_import::ImportOptions;
use trimloop_mesh::{LinearDeflection, MeshOptions, PartMesh, Silent, mesh_part};
use trimloop_tests::fixture;

/// What is meshed, and at what share of its size.
const MODELS: [(&str, f64); 5] = [
    ("cadquery/plate_perforated", 1e-4),
    ("cadquery/torus", 1e-5),
    ("cadquery/sphere_with_pinholes", 1e-5),
    ("cadquery/bspline_degree_3", 1e-5),
    ("cadquery/bspline_degree_9", 1e-5),
];

fn tessellate(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("tessellate");
    group.sample_size(10);
    let fixtures = fixture::all();
    for (name, share) in MODELS {
        let Some(fixture) = fixtures.iter().find(|fixture| fixture.name == name) else { continue };
        let model = trimloop_import::read(&fixture.path, &ImportOptions::default()).expect("a fixture");
        let options = MeshOptions {
            linear_deflection: LinearDeflection::Relative(share),
            angular_deflection_rad: 20f64.to_radians(),
            ..MeshOptions::default()
        };
        let mesh = || -> Vec<PartMesh> {
            let parts = model.parts.iter();
            parts.map(|part| mesh_part(part, &options, &Silent).expect("nobody cancels")).collect()
        };
        let triangles: usize = mesh().iter().flat_map(|it| &it.faces).map(|it| it.triangles.len()).sum();
        group.throughput(Throughput::Elements(triangles as u64));
        group.bench_function(BenchmarkId::new(name, triangles), |bencher| {
            bencher.iter(|| black_box(mesh()));
        });
    }
    group.finish();
}

criterion_group!(benches, tessellate);
criterion_main!(benches);
