//! The faces of a part brought together.

use trimloop_brep::{Diagnostic, FaceGeometry, Part, Severity};
use trimloop_trim::EdgeSamples;

use crate::draft::FaceDraft;
use crate::orientation::Orientation;
use crate::{EdgeLine, FaceMesh, FaceVertex, PartMesh, topology};

/// One mesh of all `drafts`, each turned as its shell needs it.
pub(crate) fn assemble(part: &Part, samples: EdgeSamples, drafts: Vec<FaceDraft>) -> PartMesh {
    let mut mesh = PartMesh { positions: samples.points, ..PartMesh::default() };
    mesh.positions.extend_from_slice(&part.facet_points);
    let orientation = Orientation::new(part, &drafts, &mesh.positions);
    for (k, draft) in drafts.iter().enumerate() {
        let face = finish(draft, orientation.turned[k], &mut mesh);
        mesh.faces.push(face);
        mesh.diagnostics.extend(draft.diagnostics.iter().cloned());
    }
    mesh.edges = (0..)
        .zip(&samples.edges)
        .filter(|(_, e)| !e.sides.is_empty() && e.points.len() > 1)
        .map(|(edge, e)| EdgeLine { edge, points: e.points.clone() })
        .collect();
    mesh.shells = topology::of_shells(part, &mesh, &drafts, &orientation.turned);
    report_turned(part, &orientation, &mut mesh);
    mesh
}

fn finish(draft: &FaceDraft, turned: bool, mesh: &mut PartMesh) -> FaceMesh {
    let shift = mesh.positions.len() as u32 - draft.own_base;
    let position = |p: u32| if p >= draft.own_base { p + shift } else { p };
    let vertices: Vec<FaceVertex> = draft
        .vertices
        .iter()
        .map(|v| {
            let normal = if turned { -v.normal } else { v.normal };
            FaceVertex { position: position(v.point), normal, uv: v.uv }
        })
        .collect();
    mesh.positions.extend_from_slice(&draft.own_points);
    let turn = |&[a, b, c]: &[u32; 3]| if turned { [a, c, b] } else { [a, b, c] };
    let triangles: Vec<[u32; 3]> = draft.triangles.iter().map(turn).collect();
    let corner = |i: u32| mesh.positions[vertices[i as usize].position as usize];
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length() * 0.5
    };
    let area_mm2 = triangles.iter().map(area).sum();
    FaceMesh {
        status: draft.status.clone(),
        vertices,
        triangles,
        area_mm2,
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
