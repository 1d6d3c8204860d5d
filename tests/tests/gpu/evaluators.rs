//! Every face of every fixture, evaluated by each backend, against f64.

use trimloop_gpu::{Backend, Deviation, Evaluator, FaceShape, FaceShapes, Places, Quantities, Request};
use trimloop_import::ImportOptions;
use trimloop_tests::fixture;
use trimloop_trim::Tolerance;

use crate::gpu;

/// Points of a face, along u and along v.
const GRID: usize = 17;

fn all_faces() -> Vec<(String, FaceShape)> {
    let tolerance = Tolerance { linear_mm: 0.01, angular_rad: 0.2 };
    let mut out = Vec::new();
    for fixture in fixture::all() {
        let Ok(model) = trimloop_import::read(&fixture.path, &ImportOptions::default()) else { continue };
        for part in &model.parts {
            let faces = FaceShapes::new(part, tolerance).faces.into_iter().filter_map(Result::ok);
            out.extend(faces.map(|face| (format!("{} face {}", fixture.name, face.face), face)));
        }
    }
    out
}

#[test]
fn every_face_of_every_fixture() {
    let faces = all_faces();
    assert!(faces.len() > 3000, "{} faces", faces.len());
    let requests: Vec<Request<'_>> = faces
        .iter()
        .map(|(_, face)| Request { shape: &face.shape, places: Places::even(&face.shape, GRID, GRID) })
        .collect();
    println!("{} faces, {GRID} x {GRID} points each", faces.len());
    for backend in Backend::ALL {
        let evaluator = match (backend, gpu()) {
            (Backend::Cpu, _) => Evaluator::on_cpu(),
            (_, Some(gpu)) => Evaluator::on_gpu(gpu, backend),
            (_, None) => continue,
        };
        let all = evaluator.evaluate(&requests, Quantities::Normals).expect("evaluated");
        let mut worst = [0.0f64; 2];
        for ((request, values), (name, _)) in requests.iter().zip(&all).zip(&faces) {
            let Deviation { distance, angle_deg: angle } = Deviation::of(request, values);
            // The published ones are given the single precision of their parameters.
            let allowed = if matches!(backend, Backend::Cpu | Backend::Bezier) { 1e-6 } else { 5e-6 };
            assert!(distance <= allowed, "{} {name}: {distance}", backend.name());
            assert!(angle <= 0.05, "{} {name}: {angle} degrees", backend.name());
            worst = [worst[0].max(distance), worst[1].max(angle)];
        }
        println!("{:24} distance / size {:.2e}, angle {:.5} degrees", backend.name(), worst[0], worst[1]);
    }
}
