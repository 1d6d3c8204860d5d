//! A side of a comparison: a CAD file or a mesh, told by what the file holds.

use std::path::Path;

use anyhow::Context;
use serde::Serialize;
use trimloop_brep::{Diagnostic, Model, Severity};
use trimloop_compare::{
    Choice, MeshError, MeshFile, Shape, choose, is_mesh_extension, mesh_for_comparison, read_mesh,
};
use trimloop_geom::Aabb;
use trimloop_import::ImportOptions;
use trimloop_mesh::Monitor;

use crate::arguments::{MeshUnit, MeshUp};

/// A file that has been read.
pub enum Loaded {
    /// A CAD file, meshed.
    Cad(Box<Cad>),
    /// A mesh, in its own unit and axes.
    Mesh(MeshFile),
}

/// A CAD file, meshed.
pub struct Cad {
    shape: Shape,
    format: String,
    notes: Vec<String>,
}

/// What the report says of a file.
#[derive(Clone, Debug, Serialize)]
pub struct FileReport {
    /// The file, as it was named.
    pub path: String,
    /// `step AP214`, `iges`, `stl`, …
    pub format: String,
    /// Unit and axes of a mesh, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convention: Option<String>,
    /// Millimetres per unit of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit_mm: Option<f64>,
    /// Triangles of a mesh that were left out: their corners are no places.
    pub unusable_triangles: usize,
    /// What is odd about it.
    pub notes: Vec<String>,
}

impl FileReport {
    /// Unit and axes, where they were guessed against what is usual for the format.
    pub fn guess(&self) -> Option<&str> {
        let text = self.convention.as_deref()?;
        text.contains("(guessed").then(|| text.split(" (").next().unwrap_or(text))
    }
}

/// Reads a file.
pub fn load(path: &Path, hidden: bool, monitor: &dyn Monitor) -> anyhow::Result<Loaded> {
    if is_mesh_extension(path) {
        return match read_mesh(path) {
            Ok(file) => Ok(Loaded::Mesh(file)),
            Err(MeshError::Unknown) => match load_cad(path, hidden, monitor) {
                Ok(mut cad) => {
                    cad.notes.push(format!("The file is {} inside, whatever its name says.", cad.format));
                    Ok(Loaded::Cad(Box::new(cad)))
                }
                Err(_) => Err(MeshError::Unknown.into()),
            },
            Err(error) => Err(error.into()),
        };
    }
    match load_cad(path, hidden, monitor) {
        Ok(cad) => Ok(Loaded::Cad(Box::new(cad))),
        Err(error) => match read_mesh(path) {
            Ok(mut file) if file.notes.is_empty() => {
                file.notes.push(format!("The file is {} inside, whatever its name says.", file.format));
                Ok(Loaded::Mesh(file))
            }
            Ok(file) => Ok(Loaded::Mesh(file)),
            Err(_) => Err(error),
        },
    }
}

fn load_cad(path: &Path, hidden: bool, monitor: &dyn Monitor) -> anyhow::Result<Cad> {
    let mut model: Model = trimloop_import::read(path, &ImportOptions::default())?;
    if hidden {
        model.show_hidden();
    }
    let meshes = mesh_for_comparison(&model, monitor)?;
    let shape = Shape::of_model(&model, &meshes);
    if shape.triangles.triangles.is_empty() {
        anyhow::bail!("nothing in it has an area that could be compared");
    }
    let serious = |diagnostic: &&Diagnostic| diagnostic.severity == Severity::Error;
    let notes =
        model.diagnostics.iter().filter(serious).map(|d| format!("{}: {}", d.entity, d.message)).collect();
    let source = &model.source;
    Ok(Cad { shape, format: format!("{} {}", source.format, source.schema), notes })
}

impl Loaded {
    /// The box, where its unit and axes are known.
    fn bounds(&self) -> Option<Aabb> {
        match self {
            Self::Cad(cad) => Some(cad.shape.triangles.bounds()),
            Self::Mesh(_) => None,
        }
    }

    /// As the formats have it, without any other shape to fit.
    fn usual_bounds(&self) -> Aabb {
        match self {
            Self::Cad(cad) => cad.shape.triangles.bounds(),
            Self::Mesh(file) => file.triangles.bounds().transformed(&file.convention.to_mm()),
        }
    }

    fn settle(self, path: &Path, other: Option<Aabb>, unit: MeshUnit, up: MeshUp) -> (Shape, FileReport) {
        let path = path.display().to_string();
        match self {
            Self::Cad(cad) => {
                let Cad { shape, format, notes } = *cad;
                let report = FileReport {
                    path,
                    format,
                    convention: None,
                    unit_mm: None,
                    unusable_triangles: 0,
                    notes,
                };
                (shape, report)
            }
            Self::Mesh(file) => {
                let Choice { convention, reason } =
                    choose(file.convention, file.triangles.bounds(), other, unit.0, up.axis());
                let report = FileReport {
                    path,
                    format: file.format.to_owned(),
                    convention: Some(format!("{convention} ({reason})")),
                    unit_mm: Some(convention.unit_mm),
                    unusable_triangles: file.unusable_triangles,
                    notes: file.notes,
                };
                (Shape::of_mesh(file.triangles.transformed(&convention.to_mm())), report)
            }
        }
    }
}

/// Reads both sides, and finds out about the units and axes of meshes.
pub fn load_both(
    paths: [&Path; 2],
    units: [MeshUnit; 2],
    ups: [MeshUp; 2],
    hidden: bool,
    monitor: &dyn Monitor,
) -> anyhow::Result<[(Shape, FileReport); 2]> {
    let open = |path: &Path| load(path, hidden, monitor).with_context(|| path.display().to_string());
    let (a, b) = (open(paths[0])?, open(paths[1])?);
    // A CAD file knows its unit; of two meshes the first is taken at its word.
    let a_fits = b.bounds();
    let b_fits = a.bounds().unwrap_or_else(|| a.usual_bounds());
    let a = a.settle(paths[0], a_fits, units[0], ups[0]);
    let fits = if a_fits.is_some() { b_fits } else { a.0.triangles.bounds() };
    let b = b.settle(paths[1], Some(fits), units[1], ups[1]);
    Ok([a, b])
}

/// A pair of values where one may stand for both.
pub fn pair<T: Copy>(values: &[T], what: &str) -> anyhow::Result<[T; 2]> {
    match values {
        [both] => Ok([*both; 2]),
        [a, b] => Ok([*a, *b]),
        _ => anyhow::bail!("{what} takes one value, or two with a comma between them"),
    }
}
