//! Arrays of numbers as the bytes and the description that glTF wants.

use gltf::json::accessor::{ComponentType, Type};
use gltf::json::buffer::Target;

use crate::grid::Grid;

/// The largest vertex count whose indices fit 16 bits; 65535 itself is reserved (primitive restart).
const MOST_SHORT: usize = 65535;

/// What an accessor's data are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Usage {
    /// A vertex attribute.
    Vertices,
    /// The indices of triangles.
    TriangleIndices,
    /// The indices of lines.
    LineIndices,
}

/// The numbers of one accessor, and how they are laid out.
#[derive(Clone, Debug)]
pub(crate) struct Stream {
    pub(crate) usage: Usage,
    pub(crate) component: ComponentType,
    pub(crate) kind: Type,
    /// Whether integers stand for -1..=1.
    pub(crate) normalized: bool,
    /// Elements.
    pub(crate) count: usize,
    /// Bytes from one element to the next.
    pub(crate) stride: usize,
    /// Smallest and largest value of each component; positions only.
    pub(crate) range: Option<[[f32; 3]; 2]>,
    /// Little-endian, `count * stride` of them unless compressed.
    pub(crate) bytes: Vec<u8>,
    /// Whether `bytes` are in the code of `EXT_meshopt_compression`.
    pub(crate) compressed: bool,
}

impl Stream {
    /// Vertex positions on a grid.
    pub(crate) fn positions(points: &[[f32; 3]], grid: &Grid) -> Self {
        let mut stream = if grid.is_quantized() {
            Self::shorts(ComponentType::U16, points, |c| (c as u16).to_le_bytes())
        } else {
            Self::floats(points)
        };
        stream.range = range(points);
        stream
    }

    /// Vertex normals.
    pub(crate) fn normals(normals: &[[f32; 3]], quantize: bool) -> Self {
        if !quantize {
            return Self::floats(normals);
        }
        let mut stream =
            Self::shorts(ComponentType::I16, normals, |c| ((c * 32767.0).round() as i16).to_le_bytes());
        stream.normalized = true;
        stream
    }

    /// Feature ids. Attributes know no 32-bit integers; f32 is exact up to 16 million.
    pub(crate) fn features(ids: &[u32]) -> Self {
        let mut bytes = Vec::with_capacity(4 * ids.len());
        for &id in ids {
            bytes.extend_from_slice(&(id as f32).to_le_bytes());
        }
        Self::vertices(ComponentType::F32, Type::Scalar, ids.len(), 4, bytes)
    }

    /// Indices of `vertices` vertices, as short as they can be.
    pub(crate) fn indices(usage: Usage, indices: &[u32], vertices: usize) -> Self {
        let short = vertices <= MOST_SHORT;
        let stride = if short { 2 } else { 4 };
        let mut bytes = Vec::with_capacity(stride * indices.len());
        for &i in indices {
            bytes.extend_from_slice(&i.to_le_bytes()[..stride]);
        }
        let component = if short { ComponentType::U16 } else { ComponentType::U32 };
        Self { usage, ..Self::vertices(component, Type::Scalar, indices.len(), stride, bytes) }
    }

    /// What a GPU's buffer of it is.
    pub(crate) const fn target(&self) -> Target {
        match self.usage {
            Usage::Vertices => Target::ArrayBuffer,
            Usage::TriangleIndices | Usage::LineIndices => Target::ElementArrayBuffer,
        }
    }

    /// Bytes of the data before compression.
    pub(crate) const fn plain_len(&self) -> usize {
        self.count * self.stride
    }

    /// The indices that it holds.
    pub(crate) fn whole_numbers(&self) -> Vec<u32> {
        let whole = |bytes: &[u8]| bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte));
        self.bytes.chunks_exact(self.stride).map(whole).collect()
    }

    /// Whether elements are padded, so that the stride must be said.
    pub(crate) fn is_padded(&self) -> bool {
        self.component.size() * self.kind.multiplicity() != self.stride
    }

    fn floats(values: &[[f32; 3]]) -> Self {
        let mut bytes = Vec::with_capacity(12 * values.len());
        for &c in values.iter().flatten() {
            bytes.extend_from_slice(&c.to_le_bytes());
        }
        Self::vertices(ComponentType::F32, Type::Vec3, values.len(), 12, bytes)
    }

    /// Three 16-bit numbers, padded to a multiple of four bytes as attributes must be.
    fn shorts(component: ComponentType, values: &[[f32; 3]], short: impl Fn(f32) -> [u8; 2]) -> Self {
        let mut bytes = Vec::with_capacity(8 * values.len());
        for value in values {
            let [[a, b], [c, d], [e, f]] = value.map(&short);
            bytes.extend_from_slice(&[a, b, c, d, e, f, 0, 0]);
        }
        Self::vertices(component, Type::Vec3, values.len(), 8, bytes)
    }

    const fn vertices(
        component: ComponentType,
        kind: Type,
        count: usize,
        stride: usize,
        bytes: Vec<u8>,
    ) -> Self {
        let usage = Usage::Vertices;
        Self {
            usage,
            component,
            kind,
            normalized: false,
            count,
            stride,
            range: None,
            bytes,
            compressed: false,
        }
    }
}

fn range(points: &[[f32; 3]]) -> Option<[[f32; 3]; 2]> {
    let (&first, rest) = points.split_first()?;
    Some(rest.iter().fold([first; 2], |[low, high], p| {
        [std::array::from_fn(|i| low[i].min(p[i])), std::array::from_fn(|i| high[i].max(p[i]))]
    }))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use trimloop_geom::Aabb;

    use super::*;

    #[test]
    fn indices_are_short_while_they_can_be() {
        let short = Stream::indices(Usage::LineIndices, &[0, 65534], 65535);
        assert_eq!((short.component, short.bytes.as_slice()), (ComponentType::U16, &[0, 0, 0xfe, 0xff][..]));
        let long = Stream::indices(Usage::LineIndices, &[0, 65535], 65536);
        assert_eq!((long.component, long.bytes.len()), (ComponentType::U32, 8));
    }

    #[test]
    fn quantized_attributes_are_aligned_to_four_bytes() {
        let grid = Grid::steps(Aabb { min: DVec3::ZERO, max: DVec3::ONE });
        let stored = [grid.store(DVec3::ZERO), grid.store(DVec3::ONE)];
        let positions = Stream::positions(&stored, &grid);
        assert_eq!(positions.bytes, [0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0]);
        assert_eq!(positions.range, Some([[0.0; 3], [65535.0; 3]]));
        assert!(positions.is_padded());
        let normals = Stream::normals(&[[0.0, -1.0, 1.0]], true);
        assert_eq!(normals.bytes, [0, 0, 0x01, 0x80, 0xff, 0x7f, 0, 0]);
        assert!(normals.normalized);
    }

    #[test]
    fn the_range_is_of_what_is_stored() {
        let grid = Grid::floats(Aabb { min: DVec3::ZERO, max: DVec3::ONE });
        let stream = Stream::positions(&[[0.1, 5.0, -1.0], [0.3, -5.0, -1.0]], &grid);
        assert_eq!(stream.range, Some([[0.1, -5.0, -1.0], [0.3, 5.0, -1.0]]));
        assert!(!stream.is_padded());
    }
}
