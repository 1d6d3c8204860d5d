//! Nodes: the assembly tree, its names, its transforms.

use glam::{DAffine3, DVec3};
use serde_json::{Value, json};
use trimloop_gltf::{GltfOptions, UpAxis};

use crate::models::{BLUE, RED, cube, machine, node, single};
use crate::reading::{transform, written};

const PLAIN: GltfOptions =
    GltfOptions { up: UpAxis::Y, edges: false, face_ids: false, quantize: false, meshopt: false };

fn names(values: &[Value]) -> Vec<&str> {
    values.iter().map(|v| v["name"].as_str().unwrap_or("")).collect()
}

#[test]
fn nodes_are_the_assembly_tree_and_parts_are_shared() {
    let document = written(&machine(), &PLAIN);
    assert_eq!(names(document.all("nodes")), ["machine", "frame", "bolt", "bolt"]);
    assert_eq!(names(document.all("meshes")), ["frame", "bolt"]);
    assert_eq!(document.json["scenes"][0]["nodes"], json!([0]));
    assert_eq!(document.node("machine")["children"], json!([1, 2, 3]));
    let meshes: Vec<_> = document.all("nodes").iter().map(|n| n["mesh"].as_u64()).collect();
    assert_eq!(meshes, [None, Some(0), Some(1), Some(1)]);
    assert_eq!(document.json["nodes"][2]["extras"], json!({ "instance": "bolt \"left\"" }));
    assert_eq!(document.json["nodes"][3].get("extras"), None);
}

#[test]
fn a_product_without_a_name_is_called_by_its_id() {
    let (mut model, meshes) = single(cube("cube", DVec3::ZERO, 1.0));
    model.nodes[0].name.clear();
    model.parts[0].name.clear();
    let document = written(&(model, meshes), &PLAIN);
    assert_eq!(names(document.all("nodes")), ["cube-id"]);
    assert_eq!(names(document.all("meshes")), ["cube-id"]);
}

#[test]
fn the_root_turns_z_up_millimetres_into_y_up_metres() {
    let document = written(&machine(), &PLAIN);
    let root = transform(document.node("machine"));
    assert!(
        root.transform_point3(DVec3::new(1.0, 2.0, 3.0)).abs_diff_eq(DVec3::new(1e-3, 3e-3, -2e-3), 1e-9)
    );
    assert_eq!(transform(document.node("frame")), DAffine3::IDENTITY);
    let bolt = &document.json["nodes"][2];
    assert!(transform(bolt).abs_diff_eq(machine().0.nodes[2].transform, 1e-6));
    assert!(bolt.get("matrix").is_none());
}

#[test]
fn z_may_stay_up() {
    let document = written(&machine(), &GltfOptions { up: UpAxis::Z, ..PLAIN });
    let root = transform(document.node("machine"));
    assert!(root.transform_point3(DVec3::new(1.0, 2.0, 3.0)).abs_diff_eq(DVec3::new(1e-3, 2e-3, 3e-3), 1e-9));
}

#[test]
fn several_roots_are_each_converted() {
    let (mut model, meshes) = machine();
    model.roots = vec![1, 2];
    let document = written(&(model, meshes), &PLAIN);
    assert_eq!(document.json["scenes"][0]["nodes"], json!([0, 1]));
    assert_eq!(names(document.all("nodes")), ["frame", "bolt"]);
    let top = document.world_triangles().iter().flatten().map(|p| p.y).fold(0.0, f64::max);
    assert!((top - 0.105).abs() < 1e-8, "{top}");
}

#[test]
fn a_mirrored_use_keeps_its_shape() {
    let document = written(&machine(), &PLAIN);
    let mirror = &document.json["nodes"][3];
    assert!(transform(mirror).matrix3.determinant() < 0.0);
    // The frame and one bolt, less the mirrored bolt, whose triangles turn inside out.
    assert!((document.volume() * 1e9 - 1e6).abs() < 1.0, "{}", document.volume());
}

#[test]
fn hidden_uses_are_left_out_with_all_below() {
    let (mut model, meshes) = machine();
    model.nodes[2].hidden = true;
    let document = written(&(model.clone(), meshes.clone()), &PLAIN);
    assert_eq!(names(document.all("nodes")), ["machine", "frame", "bolt"]);
    assert_eq!(document.all("meshes").len(), 2);
    model.nodes[3].hidden = true;
    let document = written(&(model.clone(), meshes.clone()), &PLAIN);
    assert_eq!(names(document.all("meshes")), ["frame"]);
    model.nodes[0].hidden = true;
    let document = written(&(model, meshes), &PLAIN);
    assert!(document.all("nodes").is_empty() && document.all("meshes").is_empty());
    assert!(document.bin.is_empty() && document.all("buffers").is_empty());
}

#[test]
fn a_part_far_from_its_origin_keeps_its_detail_and_its_place() {
    let far = DVec3::new(1e6, 2e6, -3e6);
    let document = written(&single(cube("far", far, 1.0)), &PLAIN);
    assert_eq!(document.all("nodes").len(), 1, "no level is added");
    let corners = document.corners(&document.json["meshes"][0]["primitives"][0]);
    assert!(corners.iter().all(|p| p.abs().max_element() <= 1.0), "coordinates are local");
    let width = corners.iter().map(|p| p.x).fold(f64::MIN, f64::max)
        - corners.iter().map(|p| p.x).fold(f64::MAX, f64::min);
    assert!((width - 1.0).abs() < 1e-6);
    let want = DVec3::new(far.x, far.z, -far.y) * 1e-3;
    for point in document.world_triangles().iter().flatten() {
        assert!(point.distance(want) < 2e-3, "{point}");
    }
}

#[test]
fn a_local_origin_does_not_move_what_is_below() {
    let far = DVec3::new(1e6, 0.0, 0.0);
    let ((base, base_mesh), (top, top_mesh)) = (cube("base", far, 1.0), cube("top", DVec3::ZERO, 1.0));
    let mut model = single((base, base_mesh.clone())).0;
    model.parts.push(top);
    model.nodes[0].children.push(1);
    model.nodes.push(node("top", Some(1), DAffine3::IDENTITY, &[]));
    let document = written(&(model, vec![base_mesh, top_mesh]), &PLAIN);
    let holder = document.all("nodes").last().unwrap();
    assert_eq!(holder["name"], "base");
    assert!(document.json["nodes"][0].get("mesh").is_none());
    let reach = document.world_triangles().iter().flatten().map(|p| p.x).collect::<Vec<_>>();
    assert!(reach.iter().any(|x| *x < 0.002) && reach.iter().any(|x| (*x - 1000.0).abs() < 0.01));
}

/// The colour factor of the first primitive of a node's mesh.
fn first_color(document: &crate::reading::Document, node: usize) -> Value {
    let mesh = document.json["nodes"][node]["mesh"].as_u64().unwrap() as usize;
    match document.json["meshes"][mesh]["primitives"][0]["material"].as_u64() {
        Some(material) => {
            document.json["materials"][material as usize]["pbrMetallicRoughness"]["baseColorFactor"].clone()
        }
        None => Value::Null,
    }
}

#[test]
fn a_colour_of_one_use_makes_a_variant_on_the_same_accessors() {
    let (mut model, meshes) = machine();
    model.parts[1].color = Some(RED);
    model.nodes[3].color = Some(BLUE);
    let plain = written(&(machine().0, meshes.clone()), &PLAIN);
    let document = written(&(model, meshes), &PLAIN);
    assert_eq!(document.all("meshes").len(), 3);
    assert_eq!(document.all("accessors").len(), plain.all("accessors").len());
    assert_eq!(document.bin, plain.bin);
    assert_eq!(first_color(&document, 2), json!([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(first_color(&document, 3), json!([0.0, 0.0, 1.0, 1.0]));
}

#[test]
fn a_colour_above_fills_in_only_where_there_is_none() {
    let (mut model, meshes) = machine();
    model.parts[1].color = Some(RED);
    model.nodes[0].color = Some(BLUE);
    let document = written(&(model, meshes), &PLAIN);
    assert_eq!(first_color(&document, 1), json!([0.0, 0.0, 1.0, 1.0]));
    assert_eq!(first_color(&document, 2), json!([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(document.all("meshes").len(), 2, "no needless variant");
}

#[test]
fn a_tree_a_hundred_thousand_deep_is_written() {
    let (mut model, meshes) = single(cube("deep", DVec3::ZERO, 1.0));
    model.nodes[0].part = None;
    for i in 1..100_000 {
        model.nodes[i - 1].children.push(i);
        model.nodes.push(node("level", None, DAffine3::IDENTITY, &[]));
    }
    model.nodes[99_999].part = Some(0);
    let document = written(&(model, meshes), &PLAIN);
    assert_eq!(document.all("nodes").len(), 100_000);
    assert!((document.volume() - 1e-9).abs() < 1e-15);
}
