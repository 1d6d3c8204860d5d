//! `EXT_meshopt_compression`: buffer views in meshoptimizer's code.
//!
//! The extension asks for version 0 of the vertex code and version 1 of the index codes (its appendix A).

use meshoptimizer_rs::codec::{
    IndexEncoding, VertexEncoding, encode_index_buffer, encode_index_sequence, encode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Limits, Workspace, optimize_vertex_cache, optimize_vertex_fetch_remap};
use serde_json::{Value, json};

use crate::stream::{Stream, Usage};
use crate::weld::Triangles;

/// About what the extension's object costs in the JSON of a view, bytes.
const VIEW_COST: usize = 160;

/// The extension's name.
pub(crate) const NAME: &str = "EXT_meshopt_compression";

/// Puts triangles and vertices into the order that the codes like best: neighbours after one another.
///
/// Where that fails (memory), the order stays as it is.
pub(crate) fn reorder(triangles: &mut Triangles) {
    if let Ok(reordered) = reordered(triangles) {
        *triangles = reordered;
    }
}

/// Compresses a stream, if that makes the file smaller.
pub(crate) fn compress(stream: &mut Stream) {
    if let Ok(packed) = packed(stream)
        && packed.len() + VIEW_COST < stream.bytes.len()
    {
        stream.bytes = packed;
        stream.compressed = true;
    }
}

/// The extension object of a compressed stream's view; its bytes lie at `byte_offset` of the first buffer.
pub(crate) fn view_extension(stream: &Stream, byte_offset: usize) -> Value {
    let mode = match stream.usage {
        Usage::Vertices => "ATTRIBUTES",
        Usage::TriangleIndices => "TRIANGLES",
        Usage::LineIndices => "INDICES",
    };
    json!({
        "buffer": 0,
        "byteOffset": byte_offset,
        "byteLength": stream.bytes.len(),
        "byteStride": stream.stride,
        "count": stream.count,
        "mode": mode,
    })
}

/// The extension object of the buffer that stands for the data before compression, and is not there.
pub(crate) fn fallback_extension() -> Value {
    json!({ "fallback": true })
}

fn workspace() -> Workspace {
    // The data are ours, and in memory already.
    Workspace::new(Limits { max_bytes: usize::MAX, max_work: u64::MAX })
}

fn reordered(triangles: &Triangles) -> Result<Triangles, Error> {
    let vertices = triangles.points.len();
    let indices = optimize_vertex_cache(&triangles.indices, vertices, &mut workspace())?;
    let order = optimize_vertex_fetch_remap(&indices, vertices, &mut workspace())?.remap;
    Ok(Triangles {
        points: moved(&triangles.points, &order),
        normals: moved(&triangles.normals, &order),
        faces: moved(&triangles.faces, &order),
        indices: indices.into_iter().map(|i| order[i as usize]).collect(),
    })
}

/// `values` with the `i`-th one at place `order[i]`.
fn moved<T: Copy + Default>(values: &[T], order: &[u32]) -> Vec<T> {
    let mut moved = vec![T::default(); values.len()];
    for (&value, &place) in values.iter().zip(order) {
        moved[place as usize] = value;
    }
    moved
}

fn packed(stream: &Stream) -> Result<Vec<u8>, Error> {
    let workspace = &mut workspace();
    match stream.usage {
        Usage::Vertices => {
            let version = VertexEncoding::new(0, 0)?;
            encode_vertex_buffer(&stream.bytes, stream.count, stream.stride, version, workspace)
        }
        Usage::TriangleIndices => {
            encode_index_buffer(&stream.whole_numbers(), IndexEncoding::new(1)?, workspace)
        }
        Usage::LineIndices => {
            encode_index_sequence(&stream.whole_numbers(), IndexEncoding::new(1)?, workspace)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of squares, its triangles in a scattered order.
    fn strip(squares: u32) -> Triangles {
        let points: Vec<[f32; 3]> =
            (0..2 * (squares + 1)).map(|i| [(i / 2) as f32, (i % 2) as f32, 0.0]).collect();
        let indices = (0..squares)
            .map(|i| i * 7 % squares * 2)
            .flat_map(|i| [i, i + 2, i + 1, i + 1, i + 2, i + 3])
            .collect();
        let normals = vec![[0.0, 0.0, 1.0]; points.len()];
        let faces = (0..points.len() as u32).collect();
        Triangles { points, normals, faces, indices }
    }

    /// The corners of all triangles, each starting at its smallest, sorted.
    fn corners(triangles: &Triangles) -> Vec<[[u32; 3]; 3]> {
        let corner = |&i: &u32| triangles.points[i as usize].map(f32::to_bits);
        let mut all: Vec<[[u32; 3]; 3]> = triangles
            .indices
            .chunks(3)
            .map(|t| {
                let mut t = [corner(&t[0]), corner(&t[1]), corner(&t[2])];
                let smallest = (0..3).min_by_key(|&i| t[i]).unwrap();
                t.rotate_left(smallest);
                t
            })
            .collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn reordering_keeps_every_triangle_and_its_sense() {
        let before = strip(101);
        let mut after = before.clone();
        reorder(&mut after);
        assert_ne!(before, after);
        assert_eq!(corners(&before), corners(&after));
        for (point, face) in after.points.iter().zip(&after.faces) {
            assert_eq!(point, &before.points[*face as usize], "attributes move together");
        }
    }

    #[test]
    fn what_does_not_shrink_enough_stays_as_it_is() {
        let chain: Vec<u32> = (0..50).flat_map(|i| [i, i + 1]).collect();
        let mut tiny = Stream::indices(Usage::LineIndices, &chain, 51);
        let before = tiny.clone();
        compress(&mut tiny);
        assert!(!tiny.compressed);
        assert_eq!(tiny.bytes, before.bytes);
    }

    #[test]
    fn streams_carry_the_versions_that_the_extension_asks_for() {
        let triangles = strip(100);
        let vertices = triangles.points.len();
        let header = |mut stream: Stream| {
            compress(&mut stream);
            assert!(stream.compressed);
            stream.bytes[0]
        };
        assert_eq!(header(Stream::normals(&triangles.normals, false)), 0xa0);
        assert_eq!(header(Stream::indices(Usage::TriangleIndices, &triangles.indices, vertices)), 0xe1);
        assert_eq!(header(Stream::indices(Usage::LineIndices, &triangles.indices, vertices)), 0xd1);
    }
}
