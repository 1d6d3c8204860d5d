//! Wavefront OBJ: points and polygons.

use std::path::Path;

use glam::DVec3;

use super::{MeshError, MeshFile, millimetres};
use crate::triangles::{Piece, Triangles};

/// Whether the first lines are such as OBJ files start with.
pub(super) fn looks_like(text: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&text[..text.len().min(1 << 16)]);
    let mut known = 0;
    for line in start.lines().take(200) {
        let word = line.split_ascii_whitespace().next().unwrap_or_default();
        match word {
            "v" | "f" => known += 1,
            "" | "vn" | "vt" | "vp" | "o" | "g" | "s" | "usemtl" | "mtllib" | "l" | "p" => {}
            _ if word.starts_with('#') => {}
            // The last line may be cut off.
            _ => break,
        }
    }
    known > 0
}

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, no_materials)
        .map_err(|error| MeshError::unusable(format!("the OBJ file is damaged: {error}")))?;
    let mut all = Triangles::default();
    for model in models {
        let points: Vec<DVec3> = model.mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect();
        let triangles: Vec<[u32; 3]> =
            model.mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        if triangles.iter().flatten().any(|&index| index as usize >= points.len()) {
            return Err(MeshError::unusable(
                "the OBJ file is damaged: a face has a vertex that there is none of",
            ));
        }
        let pieces = vec![Piece { name: model.name, triangles: 0..triangles.len() }];
        all.add(Triangles { points, triangles, pieces });
    }
    Ok(millimetres("obj", all))
}
