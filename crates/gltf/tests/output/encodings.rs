//! Face ids, quantization, compression.

use glam::DVec3;
use serde_json::{Value, json};
use trimloop_brep::Model;
use trimloop_gltf::GltfOptions;
use trimloop_mesh::{CurveLine, PartMesh};

use crate::models::{BLUE, RED, cube, machine, single};
use crate::reading::{Document, open_edges, written};

/// Two colours, curves, and a place off the origin.
fn colored() -> (Model, Vec<PartMesh>) {
    let (mut part, mut mesh) = cube("cube", DVec3::new(3.0, -70.0, 11.0), 10.0);
    part.color = Some(RED);
    part.faces[2].color = Some(BLUE);
    let spiral = |i: i32| (f64::from(i) * 0.1).sin_cos();
    let points = (0..100).map(spiral).map(|(x, y)| DVec3::new(x, y, 5.0 * x)).collect();
    mesh.curves.push(CurveLine { points, color: None });
    single((part, mesh))
}

/// The triangles of the scene, in an order that does not depend on the file's.
fn sorted(document: &Document) -> Vec<[DVec3; 3]> {
    let key = |p: &DVec3| p.to_array().map(|c| (c * 1e7).round() as i64);
    let mut triangles = document.world_triangles();
    for t in &mut triangles {
        let first = (0..3).min_by_key(|&i| key(&t[i])).unwrap();
        t.rotate_left(first);
    }
    triangles.sort_by_key(|t| [key(&t[0]), key(&t[1]), key(&t[2])]);
    triangles
}

fn same(a: &Document, b: &Document, tolerance_m: f64) {
    let (a, b) = (sorted(a), sorted(b));
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!(a.distance(*b) <= tolerance_m, "{a} {b}");
    }
}

fn stored_triangles(document: &Document) -> Vec<[DVec3; 3]> {
    let primitives = document.json["meshes"][0]["primitives"].as_array().unwrap();
    let faces = primitives.iter().filter(|p| p["mode"].is_null());
    let corners: Vec<DVec3> = faces.flat_map(|p| document.corners(p)).collect();
    corners.chunks(3).map(|t| [t[0], t[1], t[2]]).collect()
}

#[test]
fn face_ids_lead_to_entities() {
    let (mut model, meshes) = colored();
    model.parts[0].faces[1].hidden = true;
    let document = written(&(model, meshes), &GltfOptions { face_ids: true, ..GltfOptions::default() });
    let mesh = &document.json["meshes"][0];
    assert_eq!(mesh["extras"]["face_entities"], json!(["#10", "#11", "#12", "#13", "#14", "#15"]));
    let ids = |primitive: &Value| -> Vec<f64> {
        document.numbers(&primitive["attributes"]["_FEATURE_ID_0"]).concat()
    };
    assert_eq!(ids(&mesh["primitives"][1]), [2.0; 4], "the blue face");
    let mut others = ids(&mesh["primitives"][0]);
    others.dedup();
    assert_eq!(others, [0.0, 3.0, 4.0, 5.0]);
    assert!(mesh["primitives"][2]["attributes"].get("_FEATURE_ID_0").is_none(), "curves have no face");
}

#[test]
fn without_face_ids_there_is_no_trace_of_them() {
    let document = written(&colored(), &GltfOptions::default());
    assert!(document.json["meshes"][0].get("extras").is_none());
}

#[test]
fn quantized_parts_stay_closed_and_within_half_a_step() {
    let plain = written(&colored(), &GltfOptions::default());
    let document = written(&colored(), &GltfOptions { quantize: true, ..GltfOptions::default() });
    assert_eq!(document.json["extensionsRequired"], json!(["KHR_mesh_quantization"]));
    assert_eq!(document.json["extensionsUsed"], json!(["KHR_mesh_quantization"]));
    // The box is 81 mm wide in y: from the spiral to the far side of the cube.
    let step_m = 81e-3 / 65535.0;
    same(&plain, &document, 0.5 * step_m * 3f64.sqrt() + 1e-8);
    assert_eq!(open_edges(&stored_triangles(&document)), 0);
    let normals = document.vectors(&document.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"]);
    assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-4));
    assert!(document.bin.len() < plain.bin.len());
    let scale: Vec<f64> = serde_json::from_value(document.json["nodes"][0]["scale"].clone()).unwrap();
    assert!(scale[0] == scale[1] && scale[1] == scale[2], "normals need no correction");
}

#[test]
fn a_quantized_assembly_is_the_same_assembly() {
    let plain = written(&machine(), &GltfOptions::default());
    let document = written(&machine(), &GltfOptions { quantize: true, ..GltfOptions::default() });
    assert_eq!(document.all("nodes").len(), plain.all("nodes").len());
    same(&plain, &document, 2e-6);
}

#[test]
fn what_steps_cannot_tell_apart_is_dropped_and_the_rest_stays_closed() {
    let (part, mut mesh) = cube("cube", DVec3::ZERO, 100.0);
    mesh.positions[1] = DVec3::new(1e-4, 0.0, 0.0);
    let document = written(&single((part, mesh)), &GltfOptions { quantize: true, ..GltfOptions::default() });
    let triangles = stored_triangles(&document);
    assert_eq!(triangles.len(), 10);
    assert_eq!(open_edges(&triangles), 0);
}

/// A wavy sheet of `2 n n` triangles, large enough to be worth compressing.
fn waves(n: u32) -> (Model, Vec<PartMesh>) {
    let (mut part, mut mesh) = cube("waves", DVec3::ZERO, 1.0);
    part.faces.truncate(1);
    part.edges.truncate(1);
    let height = |x: f64, y: f64| (x * 0.3).sin() * (y * 0.2).cos();
    let at = |i: u32| (f64::from(i % (n + 1)), f64::from(i / (n + 1)));
    mesh.positions = (0..(n + 1) * (n + 1)).map(at).map(|(x, y)| DVec3::new(x, y, height(x, y))).collect();
    let face = &mut mesh.faces[0];
    let vertex = face.vertices[0];
    let own = |position: u32| {
        let p = mesh.positions[position as usize];
        let slope = DVec3::new(
            -0.3 * (p.x * 0.3).cos() * (p.y * 0.2).cos(),
            0.2 * (p.x * 0.3).sin() * (p.y * 0.2).sin(),
            1.0,
        );
        trimloop_mesh::FaceVertex { position, normal: slope.normalize(), ..vertex }
    };
    face.vertices = (0..(n + 1) * (n + 1)).map(own).collect();
    let squares = (0..n * n).map(|i| i / n * (n + 1) + i % n);
    face.triangles = squares.flat_map(|i| [[i, i + 1, i + n + 1], [i + 1, i + n + 2, i + n + 1]]).collect();
    mesh.faces.truncate(1);
    mesh.edges.truncate(1);
    mesh.edges[0].points = (0..=n).collect();
    single((part, mesh))
}

#[test]
fn compressed_files_unpack_to_the_same_triangles() {
    for quantize in [false, true] {
        let options = GltfOptions { quantize, face_ids: true, edges: true, ..GltfOptions::default() };
        let plain = written(&waves(120), &options);
        let document = written(&waves(120), &GltfOptions { meshopt: true, ..options });
        same(&plain, &document, 0.0);
        assert!(2 * document.bin.len() < plain.bin.len(), "{} of {}", document.bin.len(), plain.bin.len());
        let used = &document.json["extensionsRequired"];
        assert!(used.as_array().unwrap().contains(&json!("EXT_meshopt_compression")));
        let edges = |d: &Document| d.corners(&d.json["meshes"][0]["primitives"][1]);
        assert_eq!(edges(&plain), edges(&document));
    }
}

#[test]
fn compressed_views_agree_with_what_the_extension_asks() {
    let options = GltfOptions { meshopt: true, edges: true, ..GltfOptions::default() };
    let document = written(&waves(120), &options);
    let fallback = &document.json["buffers"][1];
    assert_eq!(fallback["extensions"]["EXT_meshopt_compression"], json!({ "fallback": true }));
    assert!(fallback.get("uri").is_none());
    let mut end = 0;
    let mut modes = Vec::new();
    for view in document.all("bufferViews") {
        let packed = &view["extensions"]["EXT_meshopt_compression"];
        assert_eq!((&view["buffer"], &packed["buffer"]), (&json!(1), &json!(0)));
        let size = packed["count"].as_u64().unwrap() * packed["byteStride"].as_u64().unwrap();
        assert_eq!(view["byteLength"], json!(size));
        assert_eq!(view["byteOffset"].as_u64().unwrap_or(0) % 4, 0);
        end = end.max(view["byteOffset"].as_u64().unwrap_or(0) + size);
        modes.push(packed["mode"].as_str().unwrap());
    }
    assert!(end <= fallback["byteLength"].as_u64().unwrap());
    assert_eq!(modes, ["ATTRIBUTES", "ATTRIBUTES", "TRIANGLES", "ATTRIBUTES", "INDICES"]);
}

#[test]
fn what_is_not_worth_compressing_asks_for_no_extension() {
    let (part, mut mesh) = cube("cube", DVec3::ZERO, 1.0);
    mesh.faces.iter_mut().for_each(|face| face.triangles.truncate(0));
    mesh.faces[0].triangles.push([0, 1, 2]);
    let document = written(&single((part, mesh)), &GltfOptions { meshopt: true, ..GltfOptions::default() });
    let compressed = document.all("bufferViews").iter().filter(|v| v.get("extensions").is_some()).count();
    assert_eq!(compressed > 0, document.json.get("extensionsUsed").is_some());
    assert_eq!(document.all("buffers").len(), 1 + usize::from(compressed > 0));
}
