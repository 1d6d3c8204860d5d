//! Any bytes as a STEP file, through to a mesh: nothing may panic, hang or take memory out of proportion, and what
//! comes out must be consistent.

#![no_main]

mod tokens;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use trimloop_brep::{Model, Part};
use trimloop_import::import_step;
use trimloop_mesh::{FaceStatus, LinearDeflection, MeshOptions, PartMesh, Silent, mesh_part};
use trimloop_part21::{Exchange, ReadOptions};

/// Coarse: what is sought is the first step off the path, not the last triangle.
const OPTIONS: MeshOptions = MeshOptions {
    linear_deflection: LinearDeflection::Relative(0.05),
    angular_deflection_rad: 1.0,
    max_triangles: 20_000,
};

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions { max_bytes: 1 << 24, ..ReadOptions::default() };
    let Ok(exchange) = Exchange::parse_with(bytes.to_vec(), &options) else { return };
    let Ok(model) = import_step(&exchange) else { return };
    check_tree(&model);
    for part in &model.parts {
        let mesh = mesh_part(part, &OPTIONS, &Silent).expect("nobody cancels");
        check_mesh(part, &mesh);
    }
});

// Every fourth time as the fuzzer likes, otherwise so that the file stays readable.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let changed = if seed % 4 == 0 { None } else { tokens::mutate(data, size, max_size, seed) };
    changed.unwrap_or_else(|| fuzzer_mutate(data, size, max_size))
});

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
