//! Meshes: primitives, materials, normals, lines.

use glam::DVec3;
use serde_json::{Value, json};
use trimloop_brep::BodyKind;
use trimloop_gltf::{GltfOptions, write_glb};
use trimloop_mesh::CurveLine;

use crate::models::{BLUE, GLASS, RED, body, cube, machine, single};
use crate::reading::{Document, open_edges, written};

fn plain() -> GltfOptions {
    GltfOptions::default()
}

fn primitives(document: &Document) -> &Vec<Value> {
    document.json["meshes"][0]["primitives"].as_array().expect("has a mesh")
}

#[test]
fn there_is_one_primitive_per_colour() {
    let (mut part, mesh) = cube("cube", DVec3::ZERO, 10.0);
    part.color = Some(RED);
    part.faces[1].color = Some(BLUE);
    part.faces[3].color = Some(GLASS);
    part.faces[4].color = Some(BLUE);
    let document = written(&single((part, mesh)), &plain());
    let triangles: Vec<_> = primitives(&document).iter().map(|p| document.corners(p).len() / 3).collect();
    assert_eq!(triangles, [6, 4, 2]);
    let materials = document.all("materials");
    assert_eq!(materials.len(), 3);
    let pbr = &materials[0]["pbrMetallicRoughness"];
    assert_eq!(pbr["baseColorFactor"], json!([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(pbr["metallicFactor"], json!(0.0));
    assert_eq!(materials[0]["alphaMode"], "OPAQUE");
    assert_eq!(materials[2]["alphaMode"], "BLEND");
    assert_eq!(materials[2]["pbrMetallicRoughness"]["baseColorFactor"][3], json!(0.25));
}

#[test]
fn primitives_of_a_closed_part_close_bit_for_bit() {
    let (mut part, mut mesh) = cube("cube", DVec3::splat(0.1), 1.0 / 3.0);
    for (i, face) in part.faces.iter_mut().enumerate() {
        face.color = Some(if i % 2 == 0 { RED } else { BLUE });
    }
    // A coordinate that f32 cannot hold.
    mesh.positions[7] *= 1.000_000_001;
    let document = written(&single((part, mesh)), &plain());
    let stored: Vec<DVec3> = primitives(&document).iter().flat_map(|p| document.corners(p)).collect();
    let triangles: Vec<[DVec3; 3]> = stored.chunks(3).map(|t| [t[0], t[1], t[2]]).collect();
    assert_eq!(triangles.len(), 12);
    assert_eq!(open_edges(&triangles), 0);
}

#[test]
fn normals_are_unit_and_split_at_sharp_edges() {
    let document = written(&single(cube("cube", DVec3::ZERO, 10.0)), &plain());
    let attributes = &primitives(&document)[0]["attributes"];
    let normals = document.vectors(&attributes["NORMAL"]);
    assert_eq!(normals.len(), 24);
    assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-6));
    let points = document.vectors(&attributes["POSITION"]);
    let outwards = points.iter().zip(&normals).all(|(p, n)| (*p - DVec3::splat(5.0)).dot(*n) > 0.0);
    assert!(outwards);
}

#[test]
fn what_has_no_colour_is_no_metal() {
    let document = written(&single(cube("cube", DVec3::ZERO, 10.0)), &plain());
    assert!(primitives(&document)[0]["material"].is_u64());
    let [material] = document.all("materials") else { panic!("one material") };
    assert_eq!(material["pbrMetallicRoughness"]["metallicFactor"], 0.0);
}

#[test]
fn sheets_are_seen_from_both_sides() {
    let (mut part, mesh) = cube("sheet", DVec3::ZERO, 10.0);
    part.bodies = vec![body(BodyKind::Sheet)];
    part.faces[0].color = Some(RED);
    let document = written(&single((part, mesh)), &plain());
    assert_eq!(document.all("materials").len(), 2);
    assert!(document.all("materials").iter().all(|m| m["doubleSided"] == true));
}

#[test]
fn hidden_faces_are_left_out() {
    let (mut part, mesh) = cube("cube", DVec3::ZERO, 10.0);
    part.faces[0].hidden = true;
    let (mut model, meshes) = single((part, mesh));
    let document = written(&(model.clone(), meshes.clone()), &GltfOptions { edges: true, ..plain() });
    let [faces, edges] = primitives(&document).as_slice() else { panic!("faces and edges") };
    assert_eq!(document.corners(faces).len(), 10 * 3);
    assert_eq!(document.corners(edges).len(), 12 * 2, "its edges still bound its neighbours");
    for face in &mut model.parts[0].faces {
        face.hidden = true;
    }
    let document = written(&(model, meshes), &GltfOptions { edges: true, ..plain() });
    assert!(document.all("meshes").is_empty());
    assert!(document.json["nodes"][0].get("mesh").is_none());
}

#[test]
fn edges_of_visible_faces_are_lines() {
    let (mut part, mesh) = cube("cube", DVec3::ZERO, 10.0);
    for hidden in [0, 2] {
        part.faces[hidden].hidden = true;
    }
    let document = written(&single((part, mesh)), &GltfOptions { edges: true, ..plain() });
    let edges = &primitives(&document)[1];
    assert_eq!(edges["mode"], 1);
    let segments = document.corners(edges);
    assert_eq!(segments.len(), 11 * 2, "the edge between the hidden faces goes");
    assert!(segments.chunks(2).all(|s| (s[0].distance(s[1]) - 10.0).abs() < 1e-6));
    assert!(edges["attributes"].get("NORMAL").is_none());
    assert!(edges["material"].is_u64());
}

#[test]
fn free_curves_are_lines_of_their_colour() {
    let (part, mut mesh) = cube("cube", DVec3::ZERO, 10.0);
    let curve = |z: f64, color| CurveLine {
        points: (0..4).map(|i| DVec3::new(f64::from(i), 0.0, z)).collect(),
        color,
    };
    mesh.curves = vec![curve(20.0, Some(RED)), curve(30.0, None), curve(40.0, Some(RED))];
    mesh.curves.push(CurveLine { points: vec![DVec3::ONE; 5], color: Some(BLUE) });
    let document = written(&single((part, mesh)), &plain());
    let [_, red, none] = primitives(&document).as_slice() else { panic!("faces and two colours of curves") };
    assert_eq!((&red["mode"], &none["mode"]), (&json!(1), &json!(1)));
    assert_eq!(document.corners(red).len(), 2 * 3 * 2);
    assert_eq!(document.corners(none).len(), 3 * 2);
    assert_eq!(document.all("materials").len(), 2);
}

#[test]
fn bounds_are_what_is_stored() {
    let (part, mesh) = cube("cube", DVec3::splat(0.1), 0.7);
    let document = written(&single((part, mesh)), &plain());
    let accessor = &document.json["accessors"][0];
    let points = document.vectors(&primitives(&document)[0]["attributes"]["POSITION"]);
    let bound =
        |key: &str| DVec3::from_slice(&serde_json::from_value::<Vec<f64>>(accessor[key].clone()).unwrap());
    assert_eq!(bound("min"), points.iter().copied().reduce(DVec3::min).unwrap());
    assert_eq!(bound("max"), points.iter().copied().reduce(DVec3::max).unwrap());
}

#[test]
fn triangles_lost_to_rounding_leave_the_part_closed_and_are_not_counted() {
    let (part, mut mesh) = cube("cube", DVec3::splat(100.0), 100.0);
    mesh.positions[1] = mesh.positions[0] + DVec3::new(1e-9, 0.0, 0.0);
    let (model, meshes) = single((part, mesh));
    let mut glb = Vec::new();
    let counts = write_glb(&model, &meshes, &plain(), &mut glb).unwrap();
    let triangles = Document::new(&glb).world_triangles();
    assert_eq!(counts.parts[0].triangles, 10);
    assert_eq!(triangles.len(), 10);
    assert_eq!(open_edges(&triangles), 0);
}

#[test]
fn counts_are_of_one_instance_and_of_what_is_seen() {
    let (mut model, meshes) = machine();
    model.nodes[1].hidden = true;
    let counts = write_glb(&model, &meshes, &plain(), &mut Vec::new()).unwrap();
    assert_eq!((counts.parts[0].instances, counts.parts[0].triangles), (0, 0));
    assert_eq!((counts.parts[1].instances, counts.parts[1].triangles, counts.parts[1].vertices), (2, 12, 24));
}

#[test]
fn points_that_are_none_cost_only_their_triangles() {
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        let (part, mut mesh) = cube("cube", DVec3::ZERO, 10.0);
        mesh.positions[7].y = bad;
        for quantize in [false, true] {
            let options = GltfOptions { quantize, edges: true, ..plain() };
            let document = written(&single((part.clone(), mesh.clone())), &options);
            let points = document.world_triangles().concat();
            assert_eq!(points.len(), 6 * 3, "those of the three faces that do not touch the corner");
            assert!(points.iter().all(|p| p.is_finite() && p.length() < 0.02));
        }
    }
}
