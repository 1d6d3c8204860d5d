//! `render`: pictures, sheets, turntables, picking, and what is refused.

use std::process::Command;

use serde_json::Value;

use crate::Scratch;

/// Width and height of a PNG file.
fn size_of(png: &[u8]) -> [u32; 2] {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|k| u32::from_be_bytes([png[k], png[k + 1], png[k + 2], png[k + 3]]))
}

#[test]
fn a_picture_lies_beside_its_input() {
    let scratch = Scratch::with_fixture("bracket");
    let run = scratch.run(["render", "bracket.step", "--size", "200x150"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(scratch.files(), ["bracket.png", "bracket.step"]);
    assert_eq!(size_of(&scratch.read("bracket.png")), [200, 150]);
}

#[test]
fn several_inputs_make_a_sheet_or_a_file_each() {
    let scratch = Scratch::with_fixture("box");
    std::fs::copy(scratch.path("box.step"), scratch.path("other.step")).expect("copied");
    let run = scratch.run(["render", "box.step", "other.step", "-o", "sheet.png", "--size", "64"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let [width, height] = size_of(&scratch.read("sheet.png"));
    assert!(width > 128 && height > 64, "{width} x {height}");
    let run = scratch.run(["render", "box.step", "other.step", "-o", "thumbs/", "--size", "64"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(size_of(&scratch.read("thumbs/other.png")), [64, 64]);
}

#[test]
fn a_turntable_turns() {
    let scratch = Scratch::with_fixture("bracket");
    let run = scratch.run(["render", "bracket.step", "-o", "turn.png", "--turntable", "3", "--size", "64"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(scratch.files(), ["bracket.step", "turn_001.png", "turn_002.png", "turn_003.png"]);
    assert_ne!(scratch.read("turn_001.png"), scratch.read("turn_002.png"));
}

#[test]
fn a_pick_is_exact() {
    let scratch = Scratch::with_fixture("sphere");
    let run = scratch.run(["render", "sphere.step", "--size", "101", "--ortho", "--pick", "50,50"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let picked: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(picked["surface"], "sphere");
    let radius = picked["radius_mm"].as_f64().expect("a radius");
    let of = |name: &str| -> Vec<f64> {
        picked[name].as_array().expect("three").iter().map(|x| x.as_f64().expect("a number")).collect()
    };
    let (point, normal) = (of("point_mm"), of("normal"));
    // Through the middle: the normal is the line of sight, and the point lies on it at the radius.
    for k in 0..3 {
        let iso = [1.0, -1.0, 1.0][k] / 3f64.sqrt();
        assert!((normal[k] - iso).abs() < 1e-9, "{normal:?}");
        assert!((point[k] - iso * radius).abs() < 1e-9 * radius, "{point:?}");
    }
    let run = scratch.run(["render", "sphere.step", "--size", "100", "--pick", "0,0"]);
    assert_eq!((run.code, run.stdout.trim()), (Some(0), "null"));
    assert_eq!(scratch.run(["render", "sphere.step", "--size", "100", "--pick", "100,0"]).code, Some(2));
    assert_eq!(scratch.files(), ["sphere.step"]);
}

#[test]
fn names_choose_what_is_drawn() {
    let scratch = Scratch::with_fixture("assembly_nested");
    let all = scratch.run(["render", "assembly_nested.step", "--size", "64", "-o", "all.png"]);
    assert_eq!(all.code, Some(0), "{}", all.stderr);
    let run = scratch.run(["render", "assembly_nested.step", "--only", "no such thing"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("no such thing"), "{}", run.stderr);
    let run = scratch.run(["render", "assembly_nested.step", "--hide", "*", "-o", "none.png"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert_eq!(scratch.files(), ["all.png", "assembly_nested.step"]);
}

#[test]
fn bad_values_are_refused_with_what_is_wanted() {
    let scratch = Scratch::with_fixture("box");
    for (option, value, wanted) in [
        ("--size", "0x10", "32768"),
        ("--size", "99999", "32768"),
        ("--view", "sideways", "iso"),
        ("--view", "10,100", "elevation"),
        ("--section", "q=1mm", "axis"),
        ("--section", "x=1lightyear", "unit"),
        ("--background", "mauve-ish", "#rrggbb"),
        ("--samples", "3", "64"),
        ("--screen-error", "0", "0.05"),
        ("--lod", "best", "adaptive"),
        ("--pick", "5", "640,480"),
    ] {
        let run = scratch.run(["render", "box.step", option, value]);
        assert_eq!(run.code, Some(2), "{option} {value}");
        assert!(run.stderr.contains(wanted), "{option} {value}: {}", run.stderr);
    }
    assert_eq!(scratch.files(), ["box.step"]);
}

#[test]
fn what_cannot_be_read_or_written_leaves_nothing() {
    let scratch = Scratch::with_fixture("box");
    scratch.write("empty.step", "");
    for arguments in [
        ["render", "missing.step", "-o", "a.png"],
        ["render", "empty.step", "-o", "a.png"],
        ["render", "box.step", "-o", "a.jpeg"],
        ["render", "box.step", "-o", "no/such/folder.png"],
    ] {
        let run = scratch.run(arguments);
        assert_eq!(run.code, Some(2), "{arguments:?}");
        assert!(run.stderr.contains("error: "), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(scratch.files(), ["box.step", "empty.step"]);
}

#[test]
fn without_any_device_triangles_are_drawn() {
    let scratch = Scratch::with_fixture("bracket");
    let run = Command::new(env!("CARGO_BIN_EXE_trimloop"))
        .args(["render", "bracket.step", "--size", "64", "--section", "x=1mm"])
        .current_dir(scratch.path("."))
        .env("WGPU_ADAPTER_NAME", "there is none of this name")
        .output()
        .expect("it runs");
    let stderr = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(0), "{stderr}");
    assert!(stderr.contains("mesa-vulkan-drivers"), "{stderr}");
    assert_eq!(size_of(&scratch.read("bracket.png")), [64, 64]);
}
