//! glTF 2.0, binary or as text with its buffers.

use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{DAffine3, DVec3, Mat4};
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::mesh::Mode;
use gltf::{Accessor, Document, Gltf, Node, Semantic};
use percent_encoding::percent_decode_str;
use serde_json::Value;

use super::{MeshError, MeshFile};
use crate::convention::{Convention, Up};
use crate::triangles::{Piece, Triangles};

/// Nodes may hold one another this deep.
const MAX_DEPTH: usize = 512;
/// Extensions that a file may require: what they change is read here, or is no matter of geometry.
const KNOWN: [&str; 6] =
    ["KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp"];

pub(super) fn read(bytes: &[u8], path: &Path) -> Result<MeshFile, MeshError> {
    let (json, blob) = split(bytes)?;
    let document = document(&json)?;
    let buffers = buffers(&document, blob.as_deref(), path)?;
    let mut triangles = Triangles::default();
    let mut seen = vec![false; document.nodes().len()];
    let scene = document.default_scene().or_else(|| document.scenes().next());
    match scene {
        Some(scene) => {
            for node in scene.nodes() {
                add(&node, &DAffine3::IDENTITY, &buffers, &mut seen, 0, &mut triangles)?;
            }
        }
        None => return Err(damaged("it has no scene")),
    }
    let convention = Convention { unit_mm: 1000.0, up: Up::Y, stated: true };
    Ok(MeshFile { format: "gltf", triangles, convention, unusable_triangles: 0, notes: Vec::new() })
}

fn damaged(message: impl std::fmt::Display) -> MeshError {
    MeshError::unusable(format!("the glTF file is damaged: {message}"))
}

/// JSON, and the buffer that comes with it in a `.glb`.
type Split<'b> = (Cow<'b, [u8]>, Option<Cow<'b, [u8]>>);

fn split(bytes: &[u8]) -> Result<Split<'_>, MeshError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((Cow::Borrowed(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)), None));
    }
    let glb = gltf::Glb::from_slice(bytes).map_err(damaged)?;
    Ok((glb.json, glb.bin))
}

/// The document, checked; requirements that are met here are taken out before.
fn document(json: &[u8]) -> Result<Document, MeshError> {
    let mut value: Value = serde_json::from_slice(json).map_err(damaged)?;
    if let Some(Value::Array(required)) = value.get_mut("extensionsRequired") {
        required.retain(|name| {
            !name.as_str().is_some_and(|name| KNOWN.iter().any(|known| name.starts_with(known)))
        });
        if let Some(name) = required.iter().find_map(Value::as_str) {
            return Err(MeshError::unusable(format!(
                "it needs the glTF extension {name}, which is not read here"
            )));
        }
    }
    let bytes = serde_json::to_vec(&value).map_err(damaged)?;
    Ok(Gltf::from_slice(&bytes).map_err(damaged)?.document)
}

/// The bytes of every buffer, at least as many as it says.
fn buffers<'b>(
    document: &Document,
    blob: Option<&'b [u8]>,
    path: &Path,
) -> Result<Vec<Cow<'b, [u8]>>, MeshError> {
    let mut out = Vec::new();
    for buffer in document.buffers() {
        let bytes = match buffer.source() {
            Source::Bin => Cow::Borrowed(blob.ok_or_else(|| damaged("its binary part is missing"))?),
            Source::Uri(uri) => Cow::Owned(fetch(uri, path)?),
        };
        if bytes.len() < buffer.length() {
            return Err(damaged(format!(
                "buffer {} has {} bytes instead of {}",
                buffer.index(),
                bytes.len(),
                buffer.length()
            )));
        }
        out.push(bytes);
    }
    Ok(out)
}

/// A buffer in the text itself, or in a file beside it; not one from anywhere else.
fn fetch(uri: &str, path: &Path) -> Result<Vec<u8>, MeshError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, text) =
            data.split_once(";base64,").ok_or_else(|| damaged("a buffer's data is not base64"))?;
        return STANDARD.decode(text).map_err(damaged);
    }
    let refused =
        || MeshError::unusable(format!("its buffer `{uri}` lies outside the file's folder, and is not read"));
    let name = percent_decode_str(uri).decode_utf8().map_err(damaged)?;
    let relative = PathBuf::from(name.as_ref());
    let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    if uri.contains("://") || !relative.components().all(inside) {
        return Err(refused());
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = folder.join(relative);
    let missing = |error| MeshError::unusable(format!("its buffer `{uri}` cannot be read: {error}"));
    // A link may lead out of the folder as well.
    let (real, real_folder) =
        (std::fs::canonicalize(&file).map_err(missing)?, std::fs::canonicalize(folder).map_err(missing)?);
    if !real.starts_with(&real_folder) {
        return Err(refused());
    }
    std::fs::read(real).map_err(missing)
}

fn add(
    node: &Node<'_>,
    parent: &DAffine3,
    buffers: &[Cow<'_, [u8]>],
    seen: &mut [bool],
    depth: usize,
    out: &mut Triangles,
) -> Result<(), MeshError> {
    // Nodes are trees: one that comes twice could hold itself, or double from level to level.
    if std::mem::replace(&mut seen[node.index()], true) {
        return Err(damaged(format!("node {} has two parents, or holds itself", node.index())));
    }
    if depth > MAX_DEPTH {
        return Err(damaged(format!("its nodes stand more than {MAX_DEPTH} deep in one another")));
    }
    let own = Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
    let map = *parent * DAffine3::from_mat4(own);
    for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
        let corners: fn(usize) -> Vec<[usize; 3]> = match primitive.mode() {
            Mode::Triangles => |count| (0..count / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
            Mode::TriangleStrip => |count| {
                (2..count).map(|k| if k % 2 == 0 { [k - 2, k - 1, k] } else { [k - 1, k - 2, k] }).collect()
            },
            Mode::TriangleFan => |count| (2..count).map(|k| [0, k - 1, k]).collect(),
            _ => continue,
        };
        let Some(positions) = primitive.get(&Semantic::Positions) else { continue };
        let points: Vec<DVec3> =
            numbers(&positions, buffers, Dimensions::Vec3)?.chunks_exact(3).map(DVec3::from_slice).collect();
        let order: Vec<u32> = match primitive.indices() {
            Some(indices) => {
                numbers(&indices, buffers, Dimensions::Scalar)?.iter().map(|&x| x as u32).collect()
            }
            None => (0..points.len() as u32).collect(),
        };
        if order.iter().any(|&index| index as usize >= points.len()) {
            return Err(damaged("a triangle has a vertex that there is none of"));
        }
        let triangles: Vec<[u32; 3]> =
            corners(order.len()).into_iter().map(|t| t.map(|k| order[k])).collect();
        let name = node.name().or_else(|| node.mesh().and_then(|mesh| mesh.name())).unwrap_or_default();
        let pieces = vec![Piece { name: name.to_owned(), triangles: 0..triangles.len() }];
        out.add(Triangles { points, triangles, pieces }.transformed(&map));
    }
    node.children().try_for_each(|child| add(&child, &map, buffers, seen, depth + 1, out))
}

/// The numbers of an accessor, one after the other.
fn numbers(
    accessor: &Accessor<'_>,
    buffers: &[Cow<'_, [u8]>],
    dimensions: Dimensions,
) -> Result<Vec<f64>, MeshError> {
    if accessor.sparse().is_some() {
        return Err(MeshError::unusable("it has sparse accessors, which are not read here"));
    }
    if accessor.dimensions() != dimensions {
        return Err(damaged(format!("accessor {} has the wrong shape", accessor.index())));
    }
    let view = accessor.view().ok_or_else(|| damaged("an accessor has no buffer"))?;
    let buffer = &buffers[view.buffer().index()];
    let (each, item) = (accessor.data_type().size(), accessor.size());
    let stride = view.stride().unwrap_or(item);
    let start = view.offset().saturating_add(accessor.offset());
    let length = accessor.count().saturating_sub(1).saturating_mul(stride).saturating_add(item);
    let end = start.saturating_add(length);
    if accessor.count() > 0 && (end > buffer.len() || end > view.offset().saturating_add(view.length())) {
        return Err(damaged(format!("accessor {} reaches beyond its buffer", accessor.index())));
    }
    let components = item / each;
    let mut out = Vec::with_capacity(accessor.count() * components);
    for k in 0..accessor.count() {
        for c in 0..components {
            let bytes = &buffer[start + k * stride + c * each..][..each];
            out.push(number(bytes, accessor.data_type(), accessor.normalized()));
        }
    }
    Ok(out)
}

fn number(bytes: &[u8], kind: DataType, normalized: bool) -> f64 {
    let (value, most): (f64, f64) = match (kind, bytes) {
        (DataType::I8, &[a, ..]) => (f64::from(a as i8), 127.0),
        (DataType::U8, &[a, ..]) => (f64::from(a), 255.0),
        (DataType::I16, &[a, b, ..]) => (f64::from(i16::from_le_bytes([a, b])), 32767.0),
        (DataType::U16, &[a, b, ..]) => (f64::from(u16::from_le_bytes([a, b])), 65535.0),
        (DataType::U32, &[a, b, c, d, ..]) => (f64::from(u32::from_le_bytes([a, b, c, d])), 4294967295.0),
        (DataType::F32, &[a, b, c, d, ..]) => (f64::from(f32::from_le_bytes([a, b, c, d])), 1.0),
        _ => (f64::NAN, 1.0),
    };
    if normalized && kind != DataType::F32 { (value / most).max(-1.0) } else { value }
}
