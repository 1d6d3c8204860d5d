//! Exact areas of faces.

use trimloop_brep::{Model, Node};
use trimloop_compare::{Shape, figures};
use trimloop_mesh::{FaceStatus, LinearDeflection, MeshOptions, Silent, mesh_part};

use crate::Item;

/// The triangles that areas are integrated over, coarse ones first: deflection as a share of the face's size, and degrees.
const LEVELS: [(f64, f64); 4] = [(1e-3, 15.0), (2e-4, 10.0), (4e-5, 6.0), (1e-5, 3.0)];

/// Areas of two levels that agree to this share of them are right.
const AGREEMENT: f64 = 1e-7;

/// The area of a face in the world, mm²; `None` where it has no triangles.
///
/// Integrated over the exact surface in its parameters, triangle by triangle, with what lies between chords and exact
/// edges ([`trimloop_compare::figures`]), over finer and finer triangles until two results agree to 1e-7 of the area.
/// Where the boundary runs through a pole they may not; the two that agree best are within some 1e-7 then.
pub(crate) fn face_area(item: &Item) -> Option<f64> {
    let model = Model {
        parts: vec![item.alone()],
        nodes: vec![Node { transform: item.transform, part: Some(0), ..Node::default() }],
        roots: vec![0],
        ..Model::default()
    };
    let mut last = area_at(&model, LEVELS[0])?;
    let (mut best, mut least) = (last, f64::INFINITY);
    for level in &LEVELS[1..] {
        let Some(next) = area_at(&model, *level) else { break };
        let change = (next - last).abs();
        if change < least {
            (best, least) = (next, change);
        }
        if change <= AGREEMENT * next {
            break;
        }
        last = next;
    }
    best.is_finite().then_some(best)
}

fn area_at(model: &Model, (deflection, angle_deg): (f64, f64)) -> Option<f64> {
    let options = MeshOptions {
        linear_deflection: LinearDeflection::Relative(deflection),
        angular_deflection_rad: angle_deg.to_radians(),
        max_triangles: 400_000,
    };
    let mesh = mesh_part(&model.parts[0], &options, &Silent).ok()?;
    if matches!(mesh.faces.first()?.status, FaceStatus::Lost(_)) {
        return None;
    }
    Some(figures(&Shape::of_model(model, &[mesh])).area_mm2)
}
