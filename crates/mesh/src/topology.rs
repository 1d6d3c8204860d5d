//! What a shell's triangles are like, seen from their edges.

use rustc_hash::FxHashMap;
use trimloop_brep::Part;

use crate::draft::FaceDraft;
use crate::{PartMesh, ShellTopology};

/// The topology of every shell of `part`; `turned` tells which drafts were turned over in `mesh`.
pub(crate) fn of_shells(
    part: &Part,
    mesh: &PartMesh,
    drafts: &[FaceDraft],
    turned: &[bool],
) -> Vec<ShellTopology> {
    let mut out = Vec::new();
    for (body, b) in part.bodies.iter().enumerate() {
        for (shell, s) in b.shells.iter().enumerate() {
            let faces: Vec<usize> = s.faces.iter().map(|f| f.face as usize).collect();
            let volumes = || faces.iter().map(|&f| volume(mesh, f)).sum();
            let ((open_edges, non_manifold_edges), volume_mm3) =
                rayon::join(|| count_edges(&faces, drafts, turned), volumes);
            out.push(ShellTopology { body, shell, open_edges, non_manifold_edges, volume_mm3 });
        }
    }
    out
}

fn count_edges(faces: &[usize], drafts: &[FaceDraft], turned: &[bool]) -> (usize, usize) {
    let mut uses: FxHashMap<(u32, u32), (i32, u32)> = FxHashMap::default();
    for &face in faces {
        for &[a, b] in &drafts[face].boundary {
            let entry = uses.entry((a.min(b), a.max(b))).or_default();
            entry.0 += if (a < b) != turned[face] { 1 } else { -1 };
            entry.1 += 1;
        }
    }
    let open = uses.values().map(|u| u.0.unsigned_abs() as usize).sum();
    let crowded = uses.values().filter(|u| u.1 > 2).count();
    (open, crowded)
}

fn volume(mesh: &PartMesh, face: usize) -> f64 {
    let face = &mesh.faces[face];
    // Far from the origin, products of coordinates would swallow the volume.
    let origin = mesh.positions.first().copied().unwrap_or_default();
    let corner = |i: u32| mesh.positions[face.vertices[i as usize].position as usize] - origin;
    face.triangles.iter().map(|t| t.map(corner)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}
