//! The glTF document: its JSON, and the pieces of its buffer.

use std::collections::HashMap;

use glam::DAffine3;
use gltf::json::accessor::GenericComponentType;
use gltf::json::buffer::{Stride, View};
use gltf::json::extras::RawValue;
use gltf::json::mesh::{Primitive as JsonPrimitive, Semantic};
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Accessor, Asset, Buffer, Extras, Index, Material, Mesh, Node, Root, Scene, Value};
use serde_json::{Map, json};
use trimloop_brep::{Model, Part};

use crate::GltfOptions;
use crate::compression;
use crate::paint::{Finish, Tint};
use crate::placement::{conversion, place};
use crate::shape::{Primitive, Shape};
use crate::stream::Stream;
use crate::tree::{Use, visible};

/// The accessors of one primitive; uses with other colours share them.
struct Accessors {
    attributes: Vec<(Semantic, Index<Accessor>)>,
    indices: Index<Accessor>,
}

/// A document that is being put together.
pub(crate) struct Document<'a> {
    model: &'a Model,
    options: &'a GltfOptions,
    /// Per part, if it is seen anywhere and has anything to show.
    shapes: Vec<Option<Shape>>,
    /// Per part: the accessors of its primitives, once they are written.
    accessors: HashMap<usize, Vec<Accessors>>,
    meshes: HashMap<(usize, Tint), Index<Mesh>>,
    finishes: HashMap<Finish, Index<Material>>,
    root: Root,
    /// The pieces of the buffer, in order; each starts at a multiple of four.
    pieces: Vec<Vec<u8>>,
    /// Bytes of the buffer so far.
    stored_len: usize,
    /// Bytes of the buffer that compressed views unpack to.
    unpacked_len: usize,
}

/// A finished document.
pub(crate) struct Finished {
    /// The JSON; its buffer has no URI yet.
    pub(crate) root: Root,
    /// The pieces of the buffer, in order; each is padded with zeros to a multiple of four.
    pub(crate) pieces: Vec<Vec<u8>>,
    /// Bytes of the buffer.
    pub(crate) stored_len: usize,
}

impl<'a> Document<'a> {
    /// `shapes[i]` belongs to `model.parts[i]`.
    pub(crate) fn new(model: &'a Model, shapes: Vec<Option<Shape>>, options: &'a GltfOptions) -> Self {
        let generator = Some(concat!("trimloop ", env!("CARGO_PKG_VERSION")).to_owned());
        let root = Root { asset: Asset { generator, ..Asset::default() }, ..Root::default() };
        Self {
            model,
            options,
            shapes,
            accessors: HashMap::new(),
            meshes: HashMap::new(),
            finishes: HashMap::new(),
            root,
            pieces: Vec::new(),
            stored_len: 0,
            unpacked_len: 0,
        }
    }

    /// Writes everything that is seen.
    pub(crate) fn finish(mut self) -> Finished {
        let model = self.model;
        let (uses, roots) = visible(model);
        self.add_nodes(&uses, &roots);
        self.add_buffers();
        if self.options.quantize && !self.root.meshes.is_empty() {
            self.require("KHR_mesh_quantization");
        }
        let nodes = roots.into_iter().map(|root| Index::new(root as u32)).collect();
        let scene = Scene { nodes, extensions: None, extras: None, name: None };
        self.root.scene = Some(self.root.push(scene));
        Finished { root: self.root, pieces: self.pieces, stored_len: self.stored_len }
    }

    /// Adds the uses as nodes with the same indices; behind them come the nodes that only hold a mesh in place.
    fn add_nodes(&mut self, uses: &[Use<'_>], roots: &[usize]) {
        let mut nodes = Vec::with_capacity(uses.len());
        let mut holders = Vec::new();
        let mut transforms: Vec<DAffine3> = uses.iter().map(|used| used.node.transform).collect();
        for &root in roots {
            transforms[root] = conversion(self.options.up) * transforms[root];
        }
        for (used, mut transform) in uses.iter().zip(transforms) {
            let mut node = named(used.node);
            let mut children: Vec<Index<Node>> =
                used.children.iter().map(|&c| Index::new(c as u32)).collect();
            if let Some((mesh, placement)) = self.mesh_of(used) {
                match placement {
                    Some(placement) if !children.is_empty() => {
                        children.push(Index::new((uses.len() + holders.len()) as u32));
                        holders.push(self.holder(mesh, &placement));
                    }
                    placement => {
                        transform *= placement.unwrap_or(DAffine3::IDENTITY);
                        node.mesh = Some(mesh);
                    }
                }
            }
            node.children = (!children.is_empty()).then_some(children);
            place(&mut node, &transform);
            nodes.push(node);
        }
        nodes.append(&mut holders);
        self.root.nodes = nodes;
    }

    /// A node for a mesh whose own node has children, which must not move with the mesh's origin.
    fn holder(&self, mesh: Index<Mesh>, placement: &DAffine3) -> Node {
        let name = self.root.meshes[mesh.value()].name.clone();
        let mut node = Node { mesh: Some(mesh), name, ..Node::default() };
        place(&mut node, placement);
        node
    }

    /// The mesh of a use, and what brings it to the part's coordinates.
    fn mesh_of(&mut self, used: &Use<'_>) -> Option<(Index<Mesh>, Option<DAffine3>)> {
        let part = used.node.part?;
        let shape = self.shapes.get(part)?.as_ref()?;
        let placement = shape.placement;
        let plain = |p: &Primitive| p.paint.finish(used.tint) == p.paint.finish(Tint::None);
        let tint = if shape.primitives.iter().all(plain) { Tint::None } else { used.tint };
        let mesh = match self.meshes.get(&(part, tint)) {
            Some(&mesh) => mesh,
            None => self.add_mesh(part, tint),
        };
        Some((mesh, placement))
    }

    fn add_mesh(&mut self, part: usize, tint: Tint) -> Index<Mesh> {
        if !self.accessors.contains_key(&part) {
            self.add_shape(part);
        }
        let paints: Vec<_> =
            self.shapes[part].iter().flat_map(|s| &s.primitives).map(|p| (p.mode, p.paint)).collect();
        let mut primitives = Vec::with_capacity(paints.len());
        for (i, (mode, paint)) in paints.into_iter().enumerate() {
            let material = Some(self.material(paint.finish(tint)));
            let Accessors { attributes, indices } = &self.accessors[&part][i];
            primitives.push(JsonPrimitive {
                attributes: attributes.iter().map(|(s, a)| (Checked::Valid(s.clone()), *a)).collect(),
                indices: Some(*indices),
                material,
                mode: Checked::Valid(mode),
                extensions: None,
                extras: None,
                targets: None,
            });
        }
        let source = &self.model.parts[part];
        let extras = if self.options.face_ids { face_entities(source) } else { None };
        let name = label(&source.name, &source.id);
        let mesh = self.root.push(Mesh { name, primitives, extras, extensions: None, weights: None });
        self.meshes.insert((part, tint), mesh);
        mesh
    }

    fn material(&mut self, finish: Finish) -> Index<Material> {
        let root = &mut self.root;
        *self.finishes.entry(finish).or_insert_with(|| root.push(finish.material()))
    }

    /// Moves a part's data into the buffer.
    fn add_shape(&mut self, part: usize) {
        let mut primitives = std::mem::take(&mut self.shapes[part].as_mut().expect("has a mesh").primitives);
        let accessors = primitives.iter_mut().map(|primitive| self.add_primitive(primitive)).collect();
        self.shapes[part].as_mut().expect("has a mesh").primitives = primitives;
        self.accessors.insert(part, accessors);
    }

    fn add_primitive(&mut self, primitive: &mut Primitive) -> Accessors {
        let mut attributes = vec![(Semantic::Positions, self.add_stream(&mut primitive.positions))];
        if let Some(normals) = &mut primitive.normals {
            attributes.push((Semantic::Normals, self.add_stream(normals)));
        }
        if let Some(features) = &mut primitive.features {
            attributes.push((Semantic::Extras("FEATURE_ID_0".to_owned()), self.add_stream(features)));
        }
        Accessors { attributes, indices: self.add_stream(&mut primitive.indices) }
    }

    /// Moves a stream's bytes to the end of the buffer and describes them by a view and an accessor.
    fn add_stream(&mut self, stream: &mut Stream) -> Index<Accessor> {
        let offset = self.stored_len;
        let view =
            if stream.compressed { self.compressed_view(stream, offset) } else { plain_view(stream, offset) };
        let mut bytes = std::mem::take(&mut stream.bytes);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        self.stored_len += bytes.len();
        self.pieces.push(bytes);
        let view = self.root.push(view);
        self.root.push(accessor(stream, view))
    }

    /// A view of what a compressed stream at `offset` unpacks to: a piece of the buffer that is not there.
    fn compressed_view(&mut self, stream: &Stream, offset: usize) -> View {
        let place = self.unpacked_len;
        self.unpacked_len += stream.plain_len().next_multiple_of(4);
        let others = named_extension(compression::view_extension(stream, offset));
        View {
            buffer: Index::new(1),
            byte_length: USize64::from(stream.plain_len()),
            byte_offset: (place > 0).then(|| USize64::from(place)),
            extensions: Some(gltf::json::extensions::buffer::View { others }),
            ..plain_view(stream, 0)
        }
    }

    fn add_buffers(&mut self) {
        if self.stored_len > 0 {
            self.root.push(buffer(self.stored_len));
        }
        if self.unpacked_len > 0 {
            let others = named_extension(compression::fallback_extension());
            let extensions = Some(gltf::json::extensions::buffer::Buffer { others });
            self.root.push(Buffer { extensions, ..buffer(self.unpacked_len) });
            self.require(compression::NAME);
        }
    }

    fn require(&mut self, extension: &str) {
        self.root.extensions_used.push(extension.to_owned());
        self.root.extensions_required.push(extension.to_owned());
    }
}

/// A view of a stream's bytes as they are, at `offset` of the first buffer.
fn plain_view(stream: &Stream, offset: usize) -> View {
    View {
        buffer: Index::new(0),
        byte_length: USize64::from(stream.bytes.len()),
        byte_offset: (offset > 0).then(|| USize64::from(offset)),
        byte_stride: stream.is_padded().then_some(Stride(stream.stride)),
        target: Some(Checked::Valid(stream.target())),
        name: None,
        extensions: None,
        extras: None,
    }
}

fn buffer(bytes: usize) -> Buffer {
    Buffer { byte_length: USize64::from(bytes), uri: None, name: None, extensions: None, extras: None }
}

fn named_extension(value: Value) -> Map<String, Value> {
    Map::from_iter([(compression::NAME.to_owned(), value)])
}

fn accessor(stream: &Stream, view: Index<View>) -> Accessor {
    let bound = |i: usize| stream.range.map(|range| Value::from(range[i].map(f64::from).to_vec()));
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: USize64::from(stream.count),
        component_type: Checked::Valid(GenericComponentType(stream.component)),
        type_: Checked::Valid(stream.kind),
        min: bound(0),
        max: bound(1),
        normalized: stream.normalized,
        name: None,
        sparse: None,
        extensions: None,
        extras: None,
    }
}

/// A node with the names of its product and of this use of it.
fn named(node: &trimloop_brep::Node) -> Node {
    let instance = node.instance_name.as_ref().filter(|name| !name.is_empty());
    let extras = instance.and_then(|name| extras(&json!({ "instance": name })));
    Node { name: label(&node.name, &node.id), extras, ..Node::default() }
}

/// A product's name, else its id, else nothing.
fn label(name: &str, id: &str) -> Option<String> {
    [name, id].into_iter().find(|text| !text.is_empty()).map(str::to_owned)
}

/// The entities of the part's faces, in the order that feature ids count.
fn face_entities(part: &Part) -> Extras {
    let entities: Vec<String> = part.faces.iter().map(|face| face.entity.to_string()).collect();
    extras(&json!({ "face_entities": entities }))
}

fn extras(value: &Value) -> Option<Box<RawValue>> {
    serde_json::value::to_raw_value(value).ok()
}
