//! Containers: GLB, and JSON with its buffer apart.

use std::io::{self, Write};

use glam::DVec3;
use trimloop_brep::Model;
use trimloop_gltf::{GltfError, GltfOptions, write_glb, write_gltf};

use crate::models::{cube, machine, single};
use crate::reading::Document;

const ALL: GltfOptions =
    GltfOptions { up: trimloop_gltf::UpAxis::Y, edges: true, face_ids: true, quantize: true, meshopt: true };

fn glb(options: &GltfOptions) -> Vec<u8> {
    let (model, meshes) = machine();
    let mut bytes = Vec::new();
    let written = write_glb(&model, &meshes, options, &mut bytes).unwrap();
    assert_eq!(written.bytes, bytes.len() as u64);
    bytes
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for options in [GltfOptions::default(), ALL] {
        let first = glb(&options);
        assert!((0..5).all(|_| glb(&options) == first));
    }
}

#[test]
fn the_gltf_crate_reads_it_and_finds_nothing_wrong() {
    for options in
        [GltfOptions::default(), GltfOptions { edges: true, face_ids: true, ..GltfOptions::default() }]
    {
        let file = gltf::Gltf::from_slice(&glb(&options)).expect("is valid");
        assert_eq!(file.nodes().filter(|n| n.mesh().is_some()).count(), 3);
        let generator = file.document.as_json().asset.generator.clone().unwrap();
        assert!(generator.starts_with("trimloop "));
    }
}

#[test]
fn everything_lies_at_multiples_of_four() {
    for options in [GltfOptions::default(), ALL] {
        let bytes = glb(&options);
        assert_eq!(bytes.len() % 4, 0);
        let document = Document::new(&bytes);
        assert!(document.all("bufferViews").iter().all(|v| v["byteOffset"].as_u64().unwrap_or(0) % 4 == 0));
        assert_eq!(document.json["buffers"][0]["byteLength"].as_u64(), Some(document.bin.len() as u64));
    }
}

#[test]
fn a_gltf_is_a_glb_in_two_files() {
    let (model, meshes) = machine();
    for options in [GltfOptions::default(), ALL] {
        let (mut json, mut bin) = (Vec::new(), Vec::new());
        let written = write_gltf(&model, &meshes, &options, "machine.bin", &mut json, &mut bin).unwrap();
        assert_eq!(written.bytes, (json.len() + bin.len()) as u64);
        let mut json: serde_json::Value = serde_json::from_slice(&json).unwrap();
        assert_eq!(json["buffers"][0].as_object_mut().unwrap().remove("uri"), Some("machine.bin".into()));
        let glb = Document::new(&glb(&options));
        assert_eq!(json, glb.json);
        assert_eq!(bin, glb.bin);
    }
}

#[test]
fn an_empty_model_is_an_empty_scene() {
    let mut bytes = Vec::new();
    write_glb(&Model::default(), &[], &ALL, &mut bytes).unwrap();
    let document = Document::new(&bytes);
    assert!(document.all("buffers").is_empty() && document.json.get("extensionsUsed").is_none());
    assert_eq!(document.json["scene"], 0);
}

#[test]
fn a_model_without_meshes_keeps_its_tree() {
    let (model, _) = machine();
    let mut bytes = Vec::new();
    write_glb(&model, &[], &ALL, &mut bytes).unwrap();
    let document = Document::new(&bytes);
    assert_eq!(document.all("nodes").len(), 4);
    assert!(document.all("meshes").is_empty() && document.bin.is_empty());
}

/// Takes some bytes, then no more.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0 == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_strikes() {
    let (model, meshes) = single(cube("cube", DVec3::ZERO, 1.0));
    let mut whole = Vec::new();
    write_glb(&model, &meshes, &GltfOptions::default(), &mut whole).unwrap();
    for room in [0, 11, 100, whole.len() - 1] {
        let result = write_glb(&model, &meshes, &GltfOptions::default(), &mut Full(room));
        assert!(matches!(result, Err(GltfError::Io(error)) if error.kind() == io::ErrorKind::StorageFull));
    }
    let result = write_gltf(&model, &meshes, &GltfOptions::default(), "b", &mut Vec::new(), &mut Full(10));
    assert!(matches!(result, Err(GltfError::Io(_))));
}
