//! What must hold of every model and its meshes, whatever the file was.

use trimloop_brep::{Model, Part};
use trimloop_mesh::{FaceStatus, LinearDeflection, MeshOptions, PartMesh, Silent, mesh_part};

/// Coarse: what is sought is the first step off the path, not the last triangle.
const OPTIONS: MeshOptions = MeshOptions {
    linear_deflection: LinearDeflection::Relative(0.05),
    angular_deflection_rad: 1.0,
    max_triangles: 20_000,
};

/// Meshes every part of a model and looks at what comes out.
pub fn check(model: &Model) {
    check_tree(model);
    for part in &model.parts {
        let mesh = mesh_part(part, &OPTIONS, &Silent).expect("nobody cancels");
        check_mesh(part, &mesh);
    }
}

fn check_tree(model: &Model) {
    let mut seen = vec![false; model.nodes.len()];
    let mut stack = model.roots.clone();
    while let Some(index) = stack.pop() {
        assert!(!std::mem::replace(&mut seen[index], true), "a node has two parents");
        let node = &model.nodes[index];
        assert!(node.part.is_none_or(|part| part < model.parts.len()));
        stack.extend(&node.children);
    }
}

fn check_mesh(part: &Part, mesh: &PartMesh) {
    assert_eq!(mesh.faces.len(), part.faces.len());
    assert!(mesh.positions.iter().all(|position| position.is_finite()));
    for face in &mesh.faces {
        let has_triangles = !face.triangles.is_empty();
        match face.status {
            FaceStatus::Exact | FaceStatus::Approximated(_) => assert!(has_triangles),
            FaceStatus::Empty | FaceStatus::Lost(_) => assert!(!has_triangles),
        }
        assert!(face.triangles.iter().flatten().all(|&vertex| (vertex as usize) < face.vertices.len()));
        assert!(face.vertices.iter().all(|vertex| (vertex.position as usize) < mesh.positions.len()));
        assert!(face.vertices.iter().all(|vertex| vertex.normal.is_finite()));
    }
}
