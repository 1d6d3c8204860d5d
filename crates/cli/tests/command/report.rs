//! `--report`.

use serde_json::{Value, json};

use crate::Scratch;

#[test]
fn a_report_is_a_json_file() {
    let scratch = Scratch::with_fixture("plate_with_hole");
    let run = scratch.run(["convert", "plate_with_hole.step", "--report", "report.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let report = scratch.json("report.json");
    assert_eq!((&report["version"], &report["schema"]), (&json!(1), &json!("AP214")));
    assert_eq!(report["bytes"], scratch.read("plate_with_hole.step").len());
    assert_eq!((&report["totals"]["faces"], &report["totals"]["lost"]), (&json!(7), &json!(0)));
    // 40 x 30 x 5 mm with a hole: 2 (40 30 + 40 5 + 30 5) - 2 pi r² + 2 pi r 5, and r = 6.
    let area = report["totals"]["area_mm2"].as_f64().expect("a number");
    let pi = std::f64::consts::PI;
    let exact = 2.0 * (40.0 * 30.0 + 40.0 * 5.0 + 30.0 * 5.0) - 2.0 * pi * 36.0 + 2.0 * pi * 6.0 * 5.0;
    assert!((area / exact - 1.0).abs() < 1e-3, "{area} mm², not {exact}");
    assert!(report.get("faces").is_none());
}

#[test]
fn its_triangles_are_those_of_the_output() {
    let scratch = Scratch::with_fixture("torus");
    let run = scratch.run(["convert", "torus.step", "-o", "torus.gltf", "--report", "report.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let gltf = scratch.json("torus.gltf");
    let primitives = gltf["meshes"][0]["primitives"].as_array().expect("primitives");
    let count = |primitive: &Value| {
        let accessor = primitive["indices"].as_u64().expect("an index") as usize;
        gltf["accessors"][accessor]["count"].as_u64().expect("a count") / 3
    };
    assert_eq!(scratch.json("report.json")["totals"]["triangles"], primitives.iter().map(count).sum::<u64>());
}

#[test]
fn faces_are_listed_where_that_is_asked_for() {
    let scratch = Scratch::with_fixture("cylinder");
    let arguments = ["convert", "-q", "cylinder.step", "--report", "-", "--report-faces"];
    let run = scratch.run(arguments);
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON on standard output, and nothing else");
    let faces = report["faces"].as_array().expect("faces");
    let mut kinds: Vec<_> = faces.iter().map(|face| face["surface"].as_str().expect("a kind")).collect();
    kinds.sort_unstable();
    assert_eq!(kinds, ["cylinder", "plane", "plane"]);
    assert!(faces.iter().all(|face| face["status"] == "exact" && face["part"] == 0));
}

#[test]
fn several_inputs_report_to_a_folder_or_in_lines() {
    let scratch = Scratch::with_fixture("box");
    scratch.write("empty.step", "");
    assert_eq!(scratch.run(["convert", "box.step", "empty.step", "--report", "reports/"]).code, Some(2));
    assert_eq!(scratch.json("reports/box.json")["totals"]["faces"], 6);
    assert!(!scratch.path("reports/empty.json").exists());

    assert_eq!(scratch.run(["convert", "empty.step", "box.step", "--report", "all.jsonl"]).code, Some(2));
    let text = String::from_utf8(scratch.read("all.jsonl")).expect("UTF-8");
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines[0], json!({"version": 1, "input": "empty.step", "error": "the file is empty"}));
    assert_eq!((&lines[1]["input"], lines.len()), (&json!("box.step"), 2));
}

#[test]
fn one_file_does_not_hold_several_reports() {
    let scratch = Scratch::with_fixture("box");
    let run = scratch.run(["convert", "box.step", "other.step", "--report", "all.json"]);
    run.fails_with("a folder or a .jsonl");
    assert_eq!(scratch.files(), ["box.step"]);
}

#[test]
fn without_a_place_for_the_report_there_is_no_output_either() {
    let scratch = Scratch::with_fixture("box");
    scratch
        .run(["convert", "box.step", "--report", "nowhere/r.json"])
        .fails_with("cannot write `nowhere/r.json`");
    assert_eq!(scratch.files(), ["box.step"]);
}
