//! Meshes as other programs write them.

mod gltf_file;
mod obj;
mod ply;
mod stl;
mod three_mf;

use std::path::Path;

use crate::convention::{Convention, Up};
use crate::triangles::Triangles;

/// A mesh as its file has it: in the file's own unit and axes.
#[derive(Clone, Debug)]
pub struct MeshFile {
    /// The format: `stl`, `obj`, `ply`, `gltf`, `3mf`.
    pub format: &'static str,
    /// The triangles, every place a single point.
    pub triangles: Triangles,
    /// The unit and the axis that points up, as the format or the file says.
    pub convention: Convention,
    /// Triangles that were left out because a corner of theirs is no place (NaN, infinite).
    pub unusable_triangles: usize,
    /// What is odd about the file, in sentences.
    pub notes: Vec<String>,
}

/// Why a mesh could not be read.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be read at all.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// It is no mesh in a format that is known.
    #[error("it is no mesh that can be read: known are STL, OBJ, PLY, glTF (.glb, .gltf) and 3MF")]
    Unknown,
    /// It is one, but cannot be used.
    #[error("{0}")]
    Unusable(String),
}

impl MeshError {
    fn unusable(message: impl Into<String>) -> Self {
        Self::Unusable(message.into())
    }
}

/// Formats of meshes, told by what the files hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    StlBinary,
    StlText,
    Obj,
    Ply,
    Glb,
    Gltf,
    ThreeMf,
}

/// Reads a mesh, whatever the file's extension says.
///
/// # Errors
///
/// Where the file cannot be read, is no mesh, is damaged, or holds no usable triangle.
pub fn read_mesh(path: &Path) -> Result<MeshFile, MeshError> {
    let bytes = std::fs::read(path)?;
    let format = sniff(&bytes, path).ok_or(MeshError::Unknown)?;
    let mut file = match format {
        Format::StlBinary => stl::read_binary(&bytes)?,
        Format::StlText => stl::read_text(&bytes)?,
        Format::Obj => obj::read(&bytes)?,
        Format::Ply => ply::read(&bytes)?,
        Format::Glb | Format::Gltf => gltf_file::read(&bytes, path)?,
        Format::ThreeMf => three_mf::read(&bytes)?,
    };
    if let Some(extension) = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase)
        && !is_usual(&extension, format)
    {
        file.notes.push(format!("The file is {} inside, not what `.{extension}` says.", file.format));
    }
    if file.triangles.triangles.is_empty() {
        return Err(MeshError::unusable("it holds no triangles"));
    }
    file.unusable_triangles = file.triangles.drop_unusable();
    if file.triangles.triangles.is_empty() {
        return Err(MeshError::unusable("none of its triangles has usable corners (NaN or infinite)"));
    }
    file.triangles = std::mem::take(&mut file.triangles).welded();
    let area: f64 = (0..file.triangles.triangles.len()).map(|t| file.triangles.area_vector(t).length()).sum();
    let size = file.triangles.bounds().diagonal();
    if !(area > 1e-14 * size * size) {
        return Err(MeshError::unusable("its triangles have no area: all of them are points or lines"));
    }
    for piece in &mut file.triangles.pieces {
        // Names are shown on terminals.
        piece.name = piece.name.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect();
    }
    Ok(file)
}

/// Whether a file is a mesh, by its extension; CAD files are told by their content.
pub fn is_mesh_extension(path: &Path) -> bool {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    matches!(extension.as_str(), "stl" | "obj" | "ply" | "glb" | "gltf" | "3mf")
}

fn is_usual(extension: &str, format: Format) -> bool {
    match format {
        Format::StlBinary | Format::StlText => extension == "stl",
        Format::Obj => extension == "obj",
        Format::Ply => extension == "ply",
        Format::Glb => matches!(extension, "glb" | "gltf"),
        Format::Gltf => extension == "gltf",
        Format::ThreeMf => extension == "3mf",
    }
}

fn sniff(bytes: &[u8], path: &Path) -> Option<Format> {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let begins =
        |word: &str| text.len() >= word.len() && text[..word.len()].eq_ignore_ascii_case(word.as_bytes());
    if bytes.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Some(Format::ThreeMf);
    }
    if begins("ply") && text[3..].first().is_some_and(u8::is_ascii_whitespace) {
        return Some(Format::Ply);
    }
    // A binary STL may start with any words at all: its length tells.
    if stl::has_length_of_binary(bytes) {
        return Some(Format::StlBinary);
    }
    if stl::looks_like_text(text) {
        return Some(Format::StlText);
    }
    if begins("{") {
        return Some(Format::Gltf);
    }
    if obj::looks_like(text) {
        return Some(Format::Obj);
    }
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    // What is left may be a binary STL that was cut off; its reader says so.
    let is_text = !bytes[..bytes.len().min(512)].contains(&0);
    match extension.as_str() {
        "stl" if bytes.len() >= 84 && !is_text => Some(Format::StlBinary),
        "obj" if is_text && !text.is_empty() => Some(Format::Obj),
        _ => None,
    }
}

fn millimetres(format: &'static str, triangles: Triangles) -> MeshFile {
    let convention = Convention { unit_mm: 1.0, up: Up::Z, stated: false };
    MeshFile { format, triangles, convention, unusable_triangles: 0, notes: Vec::new() }
}
