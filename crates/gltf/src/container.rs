//! The files: GLB, or JSON and its buffer apart.

use std::io::{BufWriter, Write};

use trimloop_brep::Model;
use trimloop_mesh::PartMesh;

use crate::document::{Document, Finished};
use crate::shape::Shape;
use crate::tree::visible;
use crate::{GltfError, GltfOptions, Written, WrittenPart};

/// Bytes of a GLB's header, and of a chunk's.
const HEADER: u64 = 12;
const CHUNK_HEADER: u64 = 8;

/// Writes a GLB. `meshes[i]` belongs to `model.parts[i]`.
///
/// Nothing is written when the result would not fit.
pub fn write_glb(
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
    out: &mut dyn Write,
) -> Result<Written, GltfError> {
    let (document, mut written) = compose(model, meshes, options);
    let mut json = document.root.to_vec().map_err(std::io::Error::from)?;
    json.resize(json.len().next_multiple_of(4), b' ');
    written.bytes = write_chunks(&json, &document, out)?;
    Ok(written)
}

/// Writes a `.gltf` (JSON) that refers to `bin_uri`, and the buffer itself to `bin`.
///
/// A model without geometry has no buffer: nothing is written to `bin` then.
pub fn write_gltf(
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
    bin_uri: &str,
    json: &mut dyn Write,
    bin: &mut dyn Write,
) -> Result<Written, GltfError> {
    let (mut document, mut written) = compose(model, meshes, options);
    if let Some(buffer) = document.root.buffers.first_mut() {
        buffer.uri = Some(bin_uri.to_owned());
    }
    let text = document.root.to_vec_pretty().map_err(std::io::Error::from)?;
    json.write_all(&text)?;
    json.flush()?;
    write_pieces(&document, bin)?;
    written.bytes = text.len() as u64 + document.stored_len as u64;
    Ok(written)
}

/// Makes the document, and counts what is in it.
fn compose(model: &Model, meshes: &[PartMesh], options: &GltfOptions) -> (Finished, Written) {
    let mut parts = vec![WrittenPart::default(); model.parts.len()];
    for part in visible(model).0.iter().filter_map(|used| used.node.part) {
        if let Some(part) = parts.get_mut(part) {
            part.instances += 1;
        }
    }
    let shapes = shapes(model, meshes, options, &parts);
    for (part, shape) in parts.iter_mut().zip(&shapes) {
        part.triangles = shape.as_ref().map_or(0, |shape| shape.triangles);
        part.vertices = shape.as_ref().map_or(0, |shape| shape.vertices);
    }
    (Document::new(model, shapes, options).finish(), Written { bytes: 0, parts })
}

/// Per part, what it shows, if it is placed anywhere and shows anything.
fn shapes(
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
    written: &[WrittenPart],
) -> Vec<Option<Shape>> {
    let shape = |i: usize| {
        let mesh = meshes.get(i).filter(|_| written[i].instances > 0)?;
        Some(Shape::new(&model.parts[i], mesh, options)).filter(|shape| !shape.primitives.is_empty())
    };
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        (0..model.parts.len()).into_par_iter().map(shape).collect()
    }
    #[cfg(not(feature = "parallel"))]
    (0..model.parts.len()).map(shape).collect()
}

/// Writes the header and the chunks of a GLB; gives its size.
fn write_chunks(json: &[u8], document: &Finished, out: &mut dyn Write) -> Result<u64, GltfError> {
    let stored_len = document.stored_len as u64;
    let total = glb_len(json.len() as u64, stored_len)?;
    let mut out = BufWriter::new(out);
    out.write_all(b"glTF")?;
    out.write_all(&2u32.to_le_bytes())?;
    out.write_all(&total.to_le_bytes())?;
    // Both chunks are shorter than the total, which fits.
    out.write_all(&(json.len() as u32).to_le_bytes())?;
    out.write_all(b"JSON")?;
    out.write_all(json)?;
    if stored_len > 0 {
        out.write_all(&(stored_len as u32).to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        write_pieces(document, &mut out)?;
    }
    out.flush()?;
    Ok(total.into())
}

/// Bytes of a GLB with chunks of these sizes; it has no second one where that would be empty.
fn glb_len(json_len: u64, bin_len: u64) -> Result<u32, GltfError> {
    let bin_len = if bin_len > 0 { CHUNK_HEADER + bin_len } else { 0 };
    let total = HEADER + CHUNK_HEADER + json_len + bin_len;
    u32::try_from(total).map_err(|_| GltfError::TooLarge(total))
}

fn write_pieces(document: &Finished, out: &mut dyn Write) -> std::io::Result<()> {
    let mut out = BufWriter::new(out);
    for piece in &document.pieces {
        out.write_all(piece)?;
    }
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_glb_has_at_most_4_gib() {
        assert_eq!(glb_len(100, 0).unwrap(), 120);
        assert_eq!(glb_len(100, 8).unwrap(), 136);
        let most = u64::from(u32::MAX) - 128;
        assert_eq!(glb_len(100, most).unwrap(), u32::MAX);
        assert!(matches!(glb_len(100, most + 1), Err(GltfError::TooLarge(0x1_0000_0000))));
    }
}
