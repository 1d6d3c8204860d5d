//! Where output goes, and that it is all there or not at all.

use std::fs;

use crate::Scratch;

#[test]
fn the_default_output_is_a_glb_beside_the_input() {
    let scratch = Scratch::with_fixture("box");
    let run = scratch.run(["convert", "box.step"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(0), ""));
    assert!(run.stderr.starts_with("box.step -> box.glb\n"), "{}", run.stderr);
    assert_eq!(scratch.files(), ["box.glb", "box.step"]);
    assert!(scratch.read("box.glb").starts_with(b"glTF\x02\0\0\0"));
}

#[test]
fn a_gltf_has_its_buffer_beside_it() {
    let scratch = Scratch::with_fixture("box");
    assert_eq!(scratch.run(["convert", "box.step", "-o", "my box.gltf"]).code, Some(0));
    assert_eq!(scratch.files(), ["box.step", "my box.bin", "my box.gltf"]);
    let gltf = scratch.json("my box.gltf");
    assert_eq!(gltf["buffers"][0]["uri"], "my%20box.bin");
    assert_eq!(gltf["buffers"][0]["byteLength"], scratch.read("my box.bin").len());
}

#[test]
fn several_inputs_go_into_a_folder_that_is_made() {
    let scratch = Scratch::with_fixture("box");
    fs::copy(crate::fixture("wedge"), scratch.path("wedge.stp")).expect("a fixture");
    assert_eq!(scratch.run(["convert", "box.step", "wedge.stp", "-o", "out/"]).code, Some(0));
    assert!(scratch.path("out/box.glb").exists() && scratch.path("out/wedge.glb").exists());
}

#[test]
fn quiet_says_nothing_when_all_is_well() {
    let scratch = Scratch::with_fixture("box");
    let run = scratch.run(["convert", "--quiet", "box.step"]);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", ""));
}

#[test]
fn the_same_input_gives_the_same_bytes_on_any_number_of_threads() {
    let scratch = Scratch::with_fixture("torus");
    assert_eq!(scratch.run(["convert", "torus.step", "-o", "one.glb", "-j", "1"]).code, Some(0));
    assert_eq!(scratch.run(["convert", "torus.step", "-o", "many.glb", "-j", "7"]).code, Some(0));
    assert!(scratch.read("one.glb") == scratch.read("many.glb"));
}

#[test]
fn a_smaller_deflection_gives_more_triangles() {
    let scratch = Scratch::with_fixture("torus");
    let size = |name: &str, deflection: &str| {
        let run = scratch.run(["convert", "torus.step", "-o", name, "--linear-deflection", deflection]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        scratch.read(name).len()
    };
    assert!(size("fine.glb", "2um") > 2 * size("coarse.glb", "0.5mm"));
}

#[test]
fn an_input_is_never_overwritten() {
    let scratch = Scratch::with_fixture("box");
    fs::rename(scratch.path("box.step"), scratch.path("box.glb")).expect("renamed");
    let before = scratch.read("box.glb");
    scratch.run(["convert", "box.glb"]).fails_with("`box.glb` is an input");
    scratch.run(["convert", "box.glb", "-o", "./box.glb"]).fails_with("is an input");
    scratch.run(["convert", "box.glb", "-o", "x.glb", "--report", "box.glb"]).fails_with("is an input");
    assert!(scratch.read("box.glb") == before);
    assert_eq!(scratch.files(), ["box.glb"]);
}

#[test]
fn two_inputs_never_share_an_output() {
    let scratch = Scratch::with_fixture("box");
    scratch.write("box.stp", scratch.read("box.step"));
    scratch.run(["convert", "box.step", "box.stp"]).fails_with("would both be written to `box.glb`");
    assert_eq!(scratch.files(), ["box.step", "box.stp"]);
}

#[test]
fn what_cannot_be_written_is_told_in_a_line() {
    let scratch = Scratch::with_fixture("box");
    scratch.run(["convert", "box.step", "-o", "nowhere/box.glb"]).fails_with("its folder does not exist");
    scratch
        .run(["convert", "box.step", "-o", "box.obj"])
        .fails_with("`box.obj`: the output is a .glb, a .gltf");
    fs::create_dir(scratch.path("box.glb")).expect("a folder in the way");
    scratch.run(["convert", "box.step"]).fails_with("cannot write `box.glb`: it is a folder");
    assert_eq!(scratch.files(), ["box.glb", "box.step"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_in_a_line() {
    let scratch = Scratch::with_fixture("box");
    scratch
        .run(["convert", "box.step", "-o", "/dev/full"])
        .fails_with("cannot write `/dev/full`: No space left");
}

#[test]
fn a_failure_leaves_what_was_there_before() {
    let scratch = Scratch::new();
    scratch.write("part.step", "not a STEP file");
    scratch.write("part.glb", "what was there before");
    assert_eq!(scratch.run(["convert", "part.step", "--report", "part.json"]).code, Some(2));
    assert_eq!(scratch.read("part.glb"), b"what was there before");
    assert_eq!(scratch.files(), ["part.glb", "part.step"]);
}

#[cfg(unix)]
#[test]
fn output_through_a_link_replaces_what_the_link_points_to() {
    let scratch = Scratch::with_fixture("box");
    scratch.write("real.glb", "old");
    std::os::unix::fs::symlink("real.glb", scratch.path("link.glb")).expect("a link");
    assert_eq!(scratch.run(["convert", "box.step", "-o", "link.glb"]).code, Some(0));
    assert!(scratch.path("link.glb").is_symlink());
    assert!(scratch.read("real.glb").starts_with(b"glTF"));
}
