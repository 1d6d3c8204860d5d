//! A reader of what was written: as plain as it can be, and in f64 throughout.

use glam::{DAffine3, DMat4, DQuat, DVec3};
use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{Filter, Mode, decode_buffer_view};
use serde_json::Value;
use trimloop_brep::Model;
use trimloop_gltf::{GltfOptions, write_glb};
use trimloop_mesh::PartMesh;

/// A GLB, taken apart.
pub struct Document {
    pub json: Value,
    pub bin: Vec<u8>,
}

/// Writes a GLB and reads it.
pub fn written((model, meshes): &(Model, Vec<PartMesh>), options: &GltfOptions) -> Document {
    let mut bytes = Vec::new();
    write_glb(model, meshes, options, &mut bytes).expect("writes to memory");
    Document::new(&bytes)
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

impl Document {
    pub fn new(bytes: &[u8]) -> Self {
        assert_eq!(&bytes[..4], b"glTF");
        assert_eq!((word(bytes, 4), word(bytes, 8)), (2, bytes.len()));
        let json_len = word(bytes, 12);
        assert_eq!(&bytes[16..20], b"JSON");
        let json = serde_json::from_slice(&bytes[20..20 + json_len]).expect("is JSON");
        let rest = &bytes[20 + json_len..];
        let bin = if rest.is_empty() {
            Vec::new()
        } else {
            assert_eq!(&rest[4..8], b"BIN\0");
            assert_eq!(word(rest, 0), rest.len() - 8);
            rest[8..].to_vec()
        };
        Self { json, bin }
    }

    /// The items of a top-level array.
    pub fn all(&self, key: &str) -> &[Value] {
        self.json[key].as_array().map_or(&[], Vec::as_slice)
    }

    pub fn node(&self, name: &str) -> &Value {
        self.all("nodes").iter().find(|n| n["name"] == name).expect("has such a node")
    }

    fn view(&self, index: usize) -> Vec<u8> {
        let view = &self.json["bufferViews"][index];
        let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
        let packed = &view["extensions"]["EXT_meshopt_compression"];
        let source = if packed.is_null() { view } else { packed };
        assert_eq!(number(&source["buffer"]), 0);
        let start = number(&source["byteOffset"]);
        let bytes = &self.bin[start..start + number(&source["byteLength"])];
        if packed.is_null() {
            return bytes.to_vec();
        }
        let mode = Mode::parse(packed["mode"].as_str().unwrap()).unwrap();
        let filter = Filter::parse(packed["filter"].as_str().unwrap_or("NONE")).unwrap();
        let (count, stride) = (number(&packed["count"]), number(&packed["byteStride"]));
        decode_buffer_view(mode, filter, count, stride, bytes, &mut Workspace::default()).expect("unpacks")
    }

    /// The elements of an accessor.
    pub fn numbers(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.json["accessors"][accessor.as_u64().expect("an accessor") as usize];
        let view = accessor["bufferView"].as_u64().unwrap() as usize;
        let bytes = self.view(view);
        let width = if accessor["type"] == "VEC3" { 3 } else { 1 };
        let (size, read): (usize, fn(&[u8]) -> f64) = match accessor["componentType"].as_u64().unwrap() {
            5122 => (2, |b| f64::from(i16::from_le_bytes([b[0], b[1]]))),
            5123 => (2, |b| f64::from(u16::from_le_bytes([b[0], b[1]]))),
            5125 => (4, |b| f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
            5126 => (4, |b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
            other => panic!("component type {other}"),
        };
        let stride =
            self.json["bufferViews"][view]["byteStride"].as_u64().map_or(size * width, |s| s as usize);
        let scale = if accessor["normalized"] == true { 1.0 / 32767.0 } else { 1.0 };
        let element = |i: usize| (0..width).map(|c| read(&bytes[i * stride + c * size..]) * scale).collect();
        (0..accessor["count"].as_u64().unwrap() as usize).map(element).collect()
    }

    /// The three-vectors of an accessor.
    pub fn vectors(&self, accessor: &Value) -> Vec<DVec3> {
        self.numbers(accessor).iter().map(|v| DVec3::from_slice(v)).collect()
    }

    /// The triangles (mode 4) or lines (mode 1) of a primitive, as stored.
    pub fn corners(&self, primitive: &Value) -> Vec<DVec3> {
        let points = self.vectors(&primitive["attributes"]["POSITION"]);
        self.numbers(&primitive["indices"]).iter().map(|i| points[i[0] as usize]).collect()
    }

    /// Every placed mesh: its index, and where it is placed.
    pub fn placed(&self) -> Vec<(usize, DAffine3)> {
        let mut placed = Vec::new();
        let roots = self.json["scenes"][0]["nodes"].as_array().cloned().unwrap_or_default();
        let mut stack: Vec<(Value, DAffine3)> = roots.into_iter().map(|n| (n, DAffine3::IDENTITY)).collect();
        while let Some((index, parent)) = stack.pop() {
            let node = &self.json["nodes"][index.as_u64().unwrap() as usize];
            let world = parent * transform(node);
            if let Some(mesh) = node["mesh"].as_u64() {
                placed.push((mesh as usize, world));
            }
            let children = node["children"].as_array().cloned().unwrap_or_default();
            stack.extend(children.into_iter().map(|child| (child, world)));
        }
        placed
    }

    /// The corners of all placed triangles in the scene, in metres.
    pub fn world_triangles(&self) -> Vec<[DVec3; 3]> {
        let mut all = Vec::new();
        for (mesh, world) in self.placed() {
            for primitive in self.json["meshes"][mesh]["primitives"].as_array().unwrap() {
                if primitive["mode"].is_null() {
                    let corners = self.corners(primitive);
                    all.extend(corners.chunks(3).map(|t| [0, 1, 2].map(|i| world.transform_point3(t[i]))));
                }
            }
        }
        all
    }

    /// The volume under all placed triangles, as if none were mirrored, cubic metres.
    pub fn volume(&self) -> f64 {
        self.world_triangles().iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum()
    }
}

/// A node's own transform.
pub fn transform(node: &Value) -> DAffine3 {
    let numbers = |key: &str| -> Option<Vec<f64>> {
        Some(node[key].as_array()?.iter().map(|c| c.as_f64().unwrap()).collect())
    };
    if let Some(matrix) = numbers("matrix") {
        return DAffine3::from_mat4(DMat4::from_cols_slice(&matrix));
    }
    DAffine3::from_scale_rotation_translation(
        numbers("scale").map_or(DVec3::ONE, |s| DVec3::from_slice(&s)),
        numbers("rotation").map_or(DQuat::IDENTITY, |q| DQuat::from_slice(&q)),
        numbers("translation").map_or(DVec3::ZERO, |t| DVec3::from_slice(&t)),
    )
}

/// Edges of triangles that are not used as often in one direction as in the other.
pub fn open_edges(triangles: &[[DVec3; 3]]) -> usize {
    let mut balance = std::collections::HashMap::new();
    let key = |p: DVec3| p.to_array().map(f64::to_bits);
    for t in triangles {
        for i in 0..3 {
            let (a, b) = (key(t[i]), key(t[(i + 1) % 3]));
            *balance.entry((a.min(b), a.max(b))).or_insert(0) += if a < b { 1 } else { -1 };
        }
    }
    balance.values().filter(|&&n| n != 0).count()
}
