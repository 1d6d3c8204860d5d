//! `trimloop compare` and `trimloop regress` from outside.

use std::fs;

use crate::{Scratch, fixture};

/// Three corners and a facet around them, as text.
const FACET: &str =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 0\nendloop\nendfacet\n";

fn binary_stl(header: &[u8], claimed: u32, facets: usize) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(claimed.to_le_bytes());
    for k in 0..facets {
        for x in [0.0, 0.0, 1.0, k as f32, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 10.0, 0.0f32] {
            out.extend(x.to_le_bytes());
        }
        out.extend([0, 0]);
    }
    out
}

#[test]
fn a_model_and_its_mesh_are_the_same() {
    let scratch = Scratch::with_fixture("bracket");
    fs::copy(fixture("bracket").with_extension("stl"), scratch.path("b.stl")).expect("a mesh");
    let run = scratch.run(["compare", "bracket.step", "b.stl", "--report", "r.json", "--html", "r.html"]);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("same: at most"), "{}", run.stdout);
    let report = scratch.json("r.json");
    assert_eq!(report["verdict"], "same");
    assert_eq!(report["a"]["format"], "step AP214");
    let area = report["comparison"]["a"]["figures"]["area_mm2"].as_f64().expect("an area");
    assert!((area - 10173.5937).abs() < 0.01, "{area}");
    let page = String::from_utf8(scratch.read("r.html")).expect("text");
    assert!(page.matches("data:image/png;base64,").count() == 8 && !page.contains("http"));
}

#[test]
fn what_differs_exits_with_1() {
    let scratch = Scratch::with_fixture("torus");
    fs::copy(fixture("sphere").with_extension("stl"), scratch.path("b.stl")).expect("a mesh");
    let run = scratch.run(["compare", "torus.step", "b.stl", "-q"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.starts_with("different: distance"), "{}", run.stdout);
}

#[test]
fn units_are_guessed_and_can_be_told() {
    let scratch = Scratch::with_fixture("box");
    fs::copy(fixture("box").with_extension("stl"), scratch.path("b.stl")).expect("a mesh");
    let guessed = scratch.run(["compare", "box.step", "b.stl"]);
    assert_eq!(guessed.code, Some(0), "{}", guessed.stderr);
    let told = scratch.run(["compare", "box.step", "b.stl", "--unit", "in", "--up", "z"]);
    assert_eq!(told.code, Some(1), "{}", told.stderr);
}

#[test]
fn meshes_that_cannot_be_used_are_named() {
    let scratch = Scratch::new();
    scratch.write("good.stl", format!("solid\n{FACET}endsolid\n"));
    scratch.write("empty.stl", "");
    scratch.write("claims.stl", binary_stl(b"huge", u32::MAX, 3));
    scratch.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scratch.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    scratch.write(
        "count.ply",
        "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
    );
    scratch.write("out.gltf", gltf("../secret.bin"));
    scratch.write("gone.gltf", gltf("gone.bin"));
    scratch.write("web.gltf", gltf("http://example.org/a.bin"));
    for (file, text) in [
        ("empty.stl", "no mesh"),
        ("claims.stl", "claims 4294967295 triangles"),
        ("nan.obj", "NaN"),
        ("range.obj", "damaged"),
        ("count.ply", "4000000000"),
        ("out.gltf", "outside"),
        ("gone.gltf", "cannot be read"),
        ("web.gltf", "outside"),
        ("missing.stl", "o such file"),
    ] {
        let run = scratch.run(["compare", "good.stl", file]);
        run.fails_with(text);
        assert!(run.stderr.contains(file), "{}", run.stderr);
    }
}

fn gltf(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
"bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36,"uri":"{uri}"}}]}}"#
    )
}

/// Binary STL may start with the word that text starts with, and the other way round.
#[test]
fn stl_is_told_by_what_it_holds() {
    let scratch = Scratch::new();
    scratch.write("text.stl", format!("solid a\n{FACET}endsolid a\n"));
    scratch.write("binary.stl", binary_stl(b"solid a facet normal", 1, 1));
    scratch.write("renamed.step", binary_stl(b"x", 1, 1));
    for file in ["binary.stl", "renamed.step"] {
        let run = scratch.run(["compare", "text.stl", file]);
        assert_eq!(run.code, Some(0), "{file}: {}{}", run.stdout, run.stderr);
    }
}

#[test]
fn a_suite_passes_fails_and_is_blessed() {
    let scratch = Scratch::new();
    let suite = scratch.path("suite");
    fs::create_dir(&suite).expect("a folder");
    for name in ["box", "torus"] {
        fs::copy(fixture(name), suite.join(format!("{name}.step"))).expect("a model");
    }
    fs::copy(fixture("box").with_extension("stl"), suite.join("box.stl")).expect("a mesh");
    // Of another model: this case fails.
    fs::copy(fixture("sphere").with_extension("stl"), suite.join("torus.stl")).expect("a mesh");
    let run = scratch.run(["regress", "suite", "-o", "out", "--samples", "2000"]);
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(
        run.stdout.contains("FAILED torus.stl") && run.stdout.contains("1 of 2 cases good"),
        "{}",
        run.stdout
    );
    for file in ["results.json", "junit.xml", "report.html"] {
        assert!(scratch.path("out").join(file).is_file(), "{file}");
    }
    let junit = fs::read_to_string(scratch.path("out").join("junit.xml")).expect("XML");
    assert!(junit.contains("failures=\"1\""), "{junit}");

    let bless = ["regress", "suite", "-o", "out", "--samples", "2000", "--no-pictures", "--bless"];
    let refused = scratch.run_with(bless, &[("CI", "true")]);
    assert_eq!(refused.code, Some(2), "{}", refused.stdout);
    assert_eq!(scratch.run_with(bless, &[("CI", "")]).code, Some(0));
    let again = scratch.run(["regress", "suite", "-o", "out", "--samples", "2000", "--no-pictures"]);
    assert_eq!(again.code, Some(0), "{}", again.stdout);

    // What was blessed as different must stay different.
    fs::copy(fixture("torus").with_extension("stl"), suite.join("torus.stl")).expect("a mesh");
    let changed = scratch.run([
        "regress",
        "suite",
        "-o",
        "out",
        "--samples",
        "2000",
        "--no-pictures",
        "--max-volume",
        "5%",
    ]);
    assert_eq!(changed.code, Some(1), "{}", changed.stdout);
    assert!(changed.stdout.contains("CHANGED torus.stl"), "{}", changed.stdout);
}

#[test]
fn suites_that_make_no_sense() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.path("empty")).expect("a folder");
    scratch.write("broken.toml", "[[case]\n");
    scratch.write("missing.toml", "[[case]]\ninput = 'a.step'\nreference = 'a.stl'\n");
    scratch.run(["regress", "empty"]).fails_with("no case");
    scratch.run(["regress", "broken.toml"]).fails_with("broken.toml");
    scratch.run(["regress", "nothing.toml"]).fails_with("nothing.toml");
    let run = scratch.run(["regress", "missing.toml", "-o", "out"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stdout.contains("BROKEN"), "{}", run.stdout);
}

/// Every fixture against what cadquery and FreeCAD export of it: more than 40 models by each. What differs is listed in
/// the suite, with the reason.
#[test]
fn the_projects_own_suite() {
    let scratch = Scratch::new();
    let suite =
        fixture("box").parent().and_then(|folder| folder.parent()).expect("fixtures").join("suite.toml");
    let out = scratch.path("out");
    let arguments = ["regress".into(), suite.into_os_string(), "-o".into(), out.into_os_string()];
    let options = ["--no-pictures", "--samples", "4000", "-q"].map(std::ffi::OsString::from);
    let run = scratch.run(arguments.into_iter().chain(options));
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    let results: serde_json::Value =
        serde_json::from_slice(&fs::read(scratch.path("out").join("results.json")).expect("results"))
            .expect("JSON");
    for tag in ["cadquery", "freecad"] {
        let cases = results["cases"].as_array().expect("cases").iter();
        let of_tag =
            cases.filter(|case| case["tags"].as_array().is_some_and(|tags| tags.contains(&tag.into())));
        assert!(of_tag.count() > 40, "{tag}");
    }
}
