//! Every face of every fixture, evaluated by each backend, against f64.

use trimloop_gpu::{Backend, Evaluator, FaceShape, FaceShapes, Places, Quantities, Request, Values};
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

/// Largest distance from the exact point over the face's size; largest angle in degrees between normals away from
/// singular points.
fn differences(request: &Request<'_>, values: &Values) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    let size = request.shape.size();
    let [u, v] = request.shape.domain();
    for k in 0..values.len() {
        let uv = request.places.uv(k);
        let exact = request.shape.derivatives(uv);
        worst[0] = worst[0].max(values.point(k).distance(exact.point) / size);
        let own = values.normal(k).expect("asked for");
        assert!(own.is_finite());
        let is_regular =
            exact.du.length() * u.length() > 1e-2 * size && exact.dv.length() * v.length() > 1e-2 * size;
        if is_regular {
            worst[1] = worst[1].max(own.angle_between(request.shape.normal(uv)).to_degrees());
        }
    }
    worst
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
            let [distance, angle] = differences(request, values);
            // The published ones are given the single precision of their parameters.
            let allowed = if matches!(backend, Backend::Cpu | Backend::Bezier) { 1e-6 } else { 5e-6 };
            assert!(distance <= allowed, "{} {name}: {distance}", backend.name());
            assert!(angle <= 0.05, "{} {name}: {angle} degrees", backend.name());
            worst = [worst[0].max(distance), worst[1].max(angle)];
        }
        println!("{:24} distance / size {:.2e}, angle {:.5} degrees", backend.name(), worst[0], worst[1]);
    }
}
