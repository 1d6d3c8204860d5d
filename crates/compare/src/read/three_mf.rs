//! 3MF: objects of triangles in a zip archive, placed by a list of items.

use std::io::Cursor;

use glam::{DAffine3, DMat3, DVec3};
use threemf::model::{Model, Unit};

use super::{MeshError, MeshFile};
use crate::convention::{Convention, Up};
use crate::triangles::{Piece, Triangles};

/// Objects may hold one another this deep.
const MAX_DEPTH: usize = 32;
/// More triangles than this are no model but an attack: components can double from level to level.
const MAX_TRIANGLES: usize = 20_000_000;
/// More uses of objects than this neither.
const MAX_USES: usize = 1_000_000;
/// Nor a model that unpacks to more than this, bytes.
const MAX_UNPACKED: u64 = 1 << 30;

pub(super) fn read(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let damaged =
        |error: &dyn std::fmt::Display| MeshError::unusable(format!("the 3MF file is damaged: {error}"));
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&error))?;
    let mut unpacked = 0u64;
    for index in 0..archive.len() {
        unpacked += archive.by_index_raw(index).map_err(|error| damaged(&error))?.size();
    }
    if unpacked > MAX_UNPACKED {
        return Err(damaged(&format!("it would unpack to {} MB", unpacked >> 20)));
    }
    let models = threemf::read(Cursor::new(bytes))
        .map_err(|error| MeshError::unusable(format!("the 3MF file is damaged: {error}")))?;
    let Some(unit) = models.first().map(|model| unit_mm(&model.unit)) else {
        return Err(MeshError::unusable("the archive holds no 3MF model"));
    };
    let mut triangles = Triangles::default();
    let mut uses = 0;
    for model in &models {
        let own = unit_mm(&model.unit) / unit;
        for item in &model.build.item {
            let map = DAffine3::from_scale(DVec3::splat(own)) * placement(item.transform.as_ref());
            add(model, item.objectid, &map, 0, &mut uses, &mut triangles)?;
        }
    }
    let convention = Convention { unit_mm: unit, up: Up::Z, stated: true };
    Ok(MeshFile { format: "3mf", triangles, convention, unusable_triangles: 0, notes: Vec::new() })
}

fn add(
    model: &Model,
    id: usize,
    map: &DAffine3,
    depth: usize,
    uses: &mut usize,
    out: &mut Triangles,
) -> Result<(), MeshError> {
    let damaged = |message: String| MeshError::unusable(format!("the 3MF file is damaged: {message}"));
    if depth > MAX_DEPTH {
        return Err(damaged(format!("object {id} holds itself")));
    }
    *uses += 1;
    if *uses > MAX_USES {
        return Err(damaged(format!("its objects are used more than {MAX_USES} times")));
    }
    let object = model.resources.object.iter().find(|object| object.id == id);
    let object = object.ok_or_else(|| {
        damaged(format!("there is no object {id} (objects in other files of the archive are not read)"))
    })?;
    if let Some(mesh) = &object.mesh {
        let points: Vec<DVec3> = mesh.vertices.vertex.iter().map(|v| DVec3::new(v.x, v.y, v.z)).collect();
        let corner = |index: usize| u32::try_from(index).ok().filter(|&k| (k as usize) < points.len());
        let triangles: Option<Vec<[u32; 3]>> = mesh
            .triangles
            .triangle
            .iter()
            .map(|t| Some([corner(t.v1)?, corner(t.v2)?, corner(t.v3)?]))
            .collect();
        let triangles =
            triangles.ok_or_else(|| damaged(format!("object {id} has a vertex that there is none of")))?;
        if out.triangles.len() + triangles.len() > MAX_TRIANGLES {
            return Err(damaged(format!("more than {MAX_TRIANGLES} triangles")));
        }
        let name = object.name.clone().unwrap_or_default();
        let pieces = vec![Piece { name, triangles: 0..triangles.len() }];
        out.add(Triangles { points, triangles, pieces }.transformed(map));
    }
    for component in object.components.iter().flat_map(|list| &list.component) {
        let map = *map * placement(component.transform.as_ref());
        add(model, component.objectid, &map, depth + 1, uses, out)?;
    }
    Ok(())
}

/// Rows of a matrix that rows of coordinates are multiplied with.
fn placement(transform: Option<&[f64; 12]>) -> DAffine3 {
    let Some(t) = transform else { return DAffine3::IDENTITY };
    let row = |k: usize| DVec3::new(t[3 * k], t[3 * k + 1], t[3 * k + 2]);
    DAffine3::from_mat3_translation(DMat3::from_cols(row(0), row(1), row(2)), row(3))
}

fn unit_mm(unit: &Unit) -> f64 {
    match unit {
        Unit::Micron => 1e-3,
        Unit::Millimeter => 1.0,
        Unit::Centimeter => 10.0,
        Unit::Inch => 25.4,
        Unit::Foot => 304.8,
        Unit::Meter => 1000.0,
    }
}
