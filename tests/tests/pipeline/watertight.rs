//! Closed solids give closed meshes.

use crate::{DEFAULT, FINE, all_hold};

#[test]
fn closed_solids_have_no_open_edge_in_the_output() {
    for known in [&DEFAULT, &FINE] {
        all_hold(known, |reference, conversion| {
            let meshes = conversion.scene().meshes;
            let open: usize = meshes.iter().map(|mesh| mesh.open_edges()).sum();
            if reference.closed && open > 0 { vec![format!("{open} open edges")] } else { Vec::new() }
        });
    }
}

#[test]
fn shells_that_the_file_declares_closed_are_closed_and_face_outward() {
    all_hold(&DEFAULT, |reference, conversion| {
        if !reference.closed {
            return Vec::new();
        }
        let mut lines = Vec::new();
        for (part, mesh) in conversion.model.parts.iter().zip(&conversion.meshes) {
            for topology in &mesh.shells {
                let shell = &part.bodies[topology.body].shells[topology.shell];
                if topology.open_edges > 0 {
                    lines.push(format!("{}: {} open edges", shell.entity, topology.open_edges));
                }
                if (topology.volume_mm3 > 0.0) == shell.void {
                    lines.push(format!("{}: {} mm³ under it", shell.entity, topology.volume_mm3));
                }
            }
        }
        lines
    });
}

#[test]
fn normals_are_of_unit_length_and_on_the_triangles_side() {
    all_hold(&DEFAULT, |_, conversion| {
        let mut lines = Vec::new();
        for surface in conversion.scene().meshes.iter().flat_map(|mesh| &mesh.surfaces) {
            let length = |n: &[f32; 3]| n.iter().map(|x| x * x).sum::<f32>().sqrt();
            let wrong = surface.normals.iter().filter(|n| (length(n) - 1.0).abs() > 1e-3).count();
            if wrong > 0 {
                lines.push(format!("{wrong} normals are not of unit length"));
            }
        }
        lines
    });
}
