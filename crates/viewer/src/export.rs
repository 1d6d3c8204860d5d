//! Writes what is shown to glTF, as `trimloop convert` does.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;
use trimloop_brep::Model;
use trimloop_gltf::{GltfOptions, UpAxis};
use trimloop_mesh::{LinearDeflection, MeshOptions, Monitor, PartMesh};

use crate::job::{FaceProgress, Job};

/// The converter's options, as the dialog shows them.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub(crate) struct ExportOptions {
    /// The deflection as a share of each part's size, instead of millimetres.
    pub is_relative: bool,
    pub relative_percent: f64,
    pub absolute_mm: f64,
    pub angle_deg: f64,
    pub is_z_up: bool,
    pub edges: bool,
    pub face_ids: bool,
    pub quantize: bool,
    pub meshopt: bool,
    /// Without what is hidden in the window.
    pub is_shown_only: bool,
}

impl Default for ExportOptions {
    fn default() -> Self {
        Self {
            is_relative: true,
            relative_percent: 0.1,
            absolute_mm: 0.1,
            angle_deg: 20.0,
            is_z_up: false,
            edges: false,
            face_ids: false,
            quantize: false,
            meshopt: false,
            is_shown_only: true,
        }
    }
}

/// A file being written.
#[derive(Debug)]
pub(crate) struct Exporting {
    pub path: PathBuf,
    progress: Arc<FaceProgress>,
    pub job: Job<Result<String, String>>,
}

impl Exporting {
    /// Begins to write those nodes of `model` that `is_shown` says, by their indices.
    pub fn start(
        context: &egui::Context,
        model: &Arc<Model>,
        is_shown: Vec<bool>,
        options: ExportOptions,
        path: PathBuf,
    ) -> Self {
        let progress = Arc::new(FaceProgress::default());
        progress.expect(model);
        let (own, to, model) = (progress.clone(), path.clone(), model.clone());
        let job = Job::start(context, move || write(&model, &is_shown, &options, &to, &own));
        Self { path, progress, job }
    }

    pub fn share(&self) -> f32 {
        self.progress.share().unwrap_or(0.0)
    }

    pub fn cancel(&self) {
        self.progress.cancel();
    }

    pub fn is_cancelled(&self) -> bool {
        self.progress.cancelled()
    }
}

/// Nothing half-written stays behind: the file is renamed into its place when it is complete.
fn write(
    model: &Model,
    is_shown: &[bool],
    options: &ExportOptions,
    path: &Path,
    progress: &FaceProgress,
) -> Result<String, String> {
    let mut model = model.clone();
    for (node, is_shown) in model.nodes.iter_mut().zip(is_shown) {
        node.hidden = !is_shown;
    }
    let mut is_used = vec![false; model.parts.len()];
    for part in model.nodes.iter().filter(|node| !node.hidden).filter_map(|node| node.part) {
        is_used[part] = true;
    }
    let linear_deflection = match options.is_relative {
        true => LinearDeflection::Relative(0.01 * options.relative_percent),
        false => LinearDeflection::Absolute(options.absolute_mm),
    };
    let mesh_options = MeshOptions {
        linear_deflection,
        angular_deflection_rad: options.angle_deg.to_radians(),
        ..MeshOptions::default()
    };
    // What is hidden is not worth the work, but has its place in the list.
    for (part, is_used) in model.parts.iter_mut().zip(&is_used) {
        if !is_used {
            part.faces.clear();
            part.bodies.clear();
            part.curves.clear();
            part.points.clear();
        }
    }
    let meshes: Result<Vec<PartMesh>, _> =
        model.parts.par_iter().map(|part| trimloop_mesh::mesh_part(part, &mesh_options, progress)).collect();
    let meshes = meshes.map_err(|error| error.to_string())?;
    let gltf = GltfOptions {
        up: if options.is_z_up { UpAxis::Z } else { UpAxis::Y },
        edges: options.edges,
        face_ids: options.face_ids,
        quantize: options.quantize,
        meshopt: options.meshopt,
    };
    let mut bytes = 0;
    whole_file(path, |out| {
        let written = trimloop_gltf::write_glb(&model, &meshes, &gltf, out);
        bytes = written.map_err(|error| std::io::Error::other(error.to_string()))?.bytes;
        if progress.cancelled() { Err(std::io::Error::other("stopped")) } else { Ok(()) }
    })?;
    let lost = meshes
        .iter()
        .flat_map(|mesh| &mesh.faces)
        .filter(|face| matches!(face.status, trimloop_mesh::FaceStatus::Lost(_)));
    let lost = match lost.count() {
        0 => "no face lost".to_owned(),
        1 => "1 face lost".to_owned(),
        n => format!("{n} faces lost"),
    };
    Ok(format!("wrote {} ({} KiB, {lost})", path.display(), bytes.div_ceil(1024)))
}

/// Writes a file under a temporary name and renames it into its place when it is complete.
pub(crate) fn whole_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), String> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let failed = |error: std::io::Error| format!("cannot write {}: {error}", path.display());
    let mut builder = tempfile::Builder::new();
    builder.suffix(".tmp");
    // As the user's umask gives them to new files, not for the owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let draft = builder.tempfile_in(folder).map_err(failed)?;
    let mut out = BufWriter::new(draft);
    write(&mut out).map_err(failed)?;
    let draft = out.into_inner().map_err(|error| failed(error.into_error()))?;
    draft.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}
