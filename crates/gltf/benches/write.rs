//! Triangles per second from meshes to bytes: one torus of half a million vertices, in four faces.

#![allow(missing_docs, reason = "criterion's macros make public functions without documentation")]

use std::f64::consts::TAU;
use std::hint::black_box;
use std::io::sink;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec2, DVec3};
use trimloop_brep::{EntityRef, Face, FaceGeometry, Facets, Model, Node, Part};
use trimloop_gltf::{GltfOptions, write_glb};
use trimloop_mesh::{FaceMesh, FaceStatus, FaceVertex, PartMesh};

/// Vertices round the torus's axis and round its tube.
const ROUND: [u32; 2] = [1000, 500];

const FACES: u32 = 4;

/// Position and normal of a grid point.
fn point(i: u32, j: u32) -> (DVec3, DVec3) {
    let (sin_u, cos_u) = (TAU * f64::from(i) / f64::from(ROUND[0])).sin_cos();
    let (sin_v, cos_v) = (TAU * f64::from(j) / f64::from(ROUND[1])).sin_cos();
    let normal = DVec3::new(cos_v * cos_u, cos_v * sin_u, sin_v);
    (DVec3::new(cos_u, sin_u, 0.0) * 50.0 + normal * 20.0, normal)
}

fn face_mesh(face: u32) -> FaceMesh {
    let [round, tube] = ROUND;
    let (first, rows) = (face * round / FACES, round / FACES);
    let vertex = |row: u32, j: u32| {
        let i = (first + row) % round;
        FaceVertex { position: i * tube + j, normal: point(i, j).1, uv: DVec2::ZERO }
    };
    let square = |row: u32, j: u32| {
        let at = |row: u32, j: u32| row * tube + j % tube;
        [[at(row, j), at(row + 1, j), at(row + 1, j + 1)], [at(row, j), at(row + 1, j + 1), at(row, j + 1)]]
    };
    FaceMesh {
        status: FaceStatus::Exact,
        vertices: (0..=rows).flat_map(|row| (0..tube).map(move |j| vertex(row, j))).collect(),
        triangles: (0..rows).flat_map(|row| (0..tube).flat_map(move |j| square(row, j))).collect(),
        area_mm2: 0.0,
        max_deviation_mm: 0.0,
    }
}

fn torus() -> (Model, PartMesh) {
    let face = Face {
        entity: EntityRef::Step(1),
        name: String::new(),
        geometry: FaceGeometry::Facets(Facets::default()),
        same_sense: true,
        loops: Vec::new(),
        color: None,
        hidden: false,
    };
    let node = Node { name: "torus".to_owned(), part: Some(0), ..Node::default() };
    let part = Part { faces: vec![face; FACES as usize], ..Part::default() };
    let model = Model { parts: vec![part], nodes: vec![node], roots: vec![0], ..Model::default() };
    let positions = (0..ROUND[0]).flat_map(|i| (0..ROUND[1]).map(move |j| point(i, j).0)).collect();
    (model, PartMesh { positions, faces: (0..FACES).map(face_mesh).collect(), ..PartMesh::default() })
}

fn write(criterion: &mut Criterion) {
    let (model, mesh) = torus();
    let meshes = [mesh];
    let mut group = criterion.benchmark_group("write_glb");
    group.sample_size(10).throughput(Throughput::Elements(meshes[0].triangle_count() as u64));
    for (name, quantize, meshopt) in
        [("plain", false, false), ("quantized", true, false), ("quantized and compressed", true, true)]
    {
        let options = GltfOptions { quantize, meshopt, ..GltfOptions::default() };
        group.bench_function(name, |b| {
            b.iter(|| write_glb(black_box(&model), &meshes, &options, &mut sink()))
        });
    }
    group.finish();
}

criterion_group!(benches, write);
criterion_main!(benches);
