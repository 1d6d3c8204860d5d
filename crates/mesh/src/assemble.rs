//! The faces of a part brought together.

use glam::DVec3;
use rayon::prelude::*;
use trimloop_brep::{Diagnostic, FaceGeometry, Part, Severity};
use trimloop_trim::EdgeSamples;

use crate::draft::FaceDraft;
use crate::orientation::Orientation;
use crate::{EdgeLine, FaceMesh, PartMesh, topology};

/// One mesh of all `drafts`, each turned as its shell needs it.
pub(crate) fn assemble(part: &Part, samples: EdgeSamples, mut drafts: Vec<FaceDraft>) -> PartMesh {
    let mut mesh = PartMesh { positions: samples.points, ..PartMesh::default() };
    mesh.positions.extend_from_slice(&part.facet_points);
    let orientation = Orientation::new(part, &drafts, &mesh.positions);
    let mut first_own = Vec::with_capacity(drafts.len());
    for draft in &mut drafts {
        first_own.push(mesh.positions.len() as u32);
        mesh.positions.append(&mut draft.own_points);
        mesh.diagnostics.append(&mut draft.diagnostics);
    }
    let to_finish = drafts.par_iter_mut().zip(first_own).zip(&orientation.turned);
    mesh.faces = to_finish
        .with_min_len(LEAST_SHARE)
        .map(|((draft, first_own), &turned)| finish(draft, first_own, turned, &mesh.positions))
        .collect();
    mesh.edges = (0..)
        .zip(&samples.edges)
        .filter(|(_, e)| !e.sides.is_empty() && e.points.len() > 1)
        .map(|(edge, e)| EdgeLine { edge, points: e.points.clone() })
        .collect();
    mesh.shells = topology::of_shells(part, &mesh, &drafts, &orientation.turned);
    report_turned(part, &orientation, &mut mesh);
    mesh
}

/// The fewest faces that another thread is worth waking for.
const LEAST_SHARE: usize = 16;

/// The mesh of a face whose own points begin at `first_own` among the part's positions; its draft keeps its boundary.
fn finish(draft: &mut FaceDraft, first_own: u32, turned: bool, positions: &[DVec3]) -> FaceMesh {
    let (mut vertices, mut triangles) =
        (std::mem::take(&mut draft.vertices), std::mem::take(&mut draft.triangles));
    for vertex in &mut vertices {
        if let Some(own) = vertex.position.checked_sub(draft.own_base) {
            vertex.position = first_own + own;
        }
    }
    if turned {
        vertices.iter_mut().for_each(|vertex| vertex.normal = -vertex.normal);
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let corner = |i: u32| positions[vertices[i as usize].position as usize];
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length() * 0.5
    };
    FaceMesh {
        status: draft.status.clone(),
        area_mm2: triangles.iter().map(area).sum(),
        vertices,
        triangles,
        max_deviation_mm: draft.max_deviation_mm,
    }
}

fn report_turned(part: &Part, orientation: &Orientation, mesh: &mut PartMesh) {
    for &face in &orientation.corrected {
        let face = &part.faces[face as usize];
        if matches!(face.geometry, FaceGeometry::Surface(_)) {
            let text = "the face looks the other way than its shell; turned";
            mesh.diagnostics.push(
                Diagnostic::new(Severity::Warning, "face-orientation", face.entity, text)
                    .on_face(face.entity),
            );
        }
    }
}
