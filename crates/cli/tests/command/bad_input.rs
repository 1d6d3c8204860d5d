//! Files that are not what they should be.

use std::path::Path;

use serde_json::Value;

use crate::Scratch;

#[test]
fn broken_files_end_as_they_should() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/broken");
    let expected =
        std::fs::read_to_string(folder.join("expected.json")).expect("what is expected of broken files");
    let expected: Vec<Value> = serde_json::from_str(&expected).expect("JSON");
    let findings: Vec<_> = expected.iter().flat_map(|case| broken_file(&folder, case)).collect();
    assert!(findings.is_empty(), "of {} broken files\n{}", expected.len(), findings.join("\n"));
}

/// What is not as `case` expects it.
fn broken_file(folder: &Path, case: &Value) -> Vec<String> {
    let name = case["file"].as_str().expect("a file");
    let scratch = Scratch::new();
    let input = folder.join(name);
    let run = scratch.run([
        "convert".as_ref(),
        input.as_os_str(),
        "-o".as_ref(),
        "out.glb".as_ref(),
        "--report".as_ref(),
        "out.json".as_ref(),
    ]);
    let mut findings = Vec::new();
    let mut find = |what: String| findings.push(format!("{name} ({}): {what}", case["shows"]));
    if !case["exit"]
        .as_array()
        .expect("exit codes")
        .iter()
        .any(|code| code.as_i64() == run.code.map(i64::from))
    {
        find(format!("exit {:?}, not {}: {}", run.code, case["exit"], run.stderr));
    }
    if run.stderr.contains("internal error") {
        find(run.stderr.clone());
    }
    let said = run.stderr.to_lowercase();
    let words = case["words"].as_array().expect("words");
    if run.code != Some(0)
        && !words.is_empty()
        && !words.iter().any(|w| said.contains(&w.as_str().expect("a word").to_lowercase()))
    {
        find(format!("says {said:?}, none of {words:?}"));
    }
    if scratch.path("out.glb").exists() != (run.code != Some(2)) {
        find(format!("exit {:?}, and files {:?}", run.code, scratch.files()));
    } else if let (Some(least), Some(0 | 1)) = (case["area_mm2"].as_f64(), run.code) {
        let area = scratch.json("out.json")["totals"]["area_mm2"].as_f64().expect("an area");
        if area < 0.99 * least {
            find(format!("{area} mm² are left, not {least}"));
        }
    }
    findings
}

#[test]
fn what_is_no_step_file_ends_with_2_and_a_line() {
    for (name, content, message) in [
        ("empty.step", &b""[..], "empty.step: the file is empty"),
        ("text.step", b"Dear Sir or Madam,\n", "not a STEP file"),
        ("zeros.step", &[0; 5000], "the file is empty"),
        (
            "nothing.step",
            b"ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
            "no entities",
        ),
    ] {
        let scratch = Scratch::new();
        scratch.write(name, content);
        scratch.run(["convert", name]).fails_with(message);
        scratch.run(["inspect", name]).fails_with(message);
        assert_eq!(scratch.files(), [name]);
    }
}

#[test]
fn what_is_not_there_ends_with_2_and_a_line() {
    let scratch = Scratch::new();
    scratch.run(["convert", "missing.step"]).fails_with("error: missing.step: ");
    scratch.run(["inspect", "missing.step"]).fails_with("error: missing.step: ");
    assert!(scratch.files().is_empty());
}

#[test]
fn a_file_cut_off_anywhere_ends_with_an_exit_code_and_without_half_an_output() {
    let scratch = Scratch::with_fixture("plate_with_hole");
    let whole = scratch.read("plate_with_hole.step");
    for at in (0..whole.len()).step_by(whole.len() / 40) {
        scratch.write("cut.step", &whole[..at]);
        let run = scratch.run(["convert", "cut.step", "-q"]);
        assert!(matches!(run.code, Some(0..=2)), "cut at {at}: {:?} {}", run.code, run.stderr);
        assert!(!run.stderr.contains("internal error"), "cut at {at}: {}", run.stderr);
        assert_eq!(scratch.path("cut.glb").exists(), run.code != Some(2), "cut at {at}");
        let _ = std::fs::remove_file(scratch.path("cut.glb"));
    }
}

#[test]
fn a_face_that_is_lost_shows_in_exit_code_summary_and_report() {
    let scratch = Scratch::with_fixture("plate_with_hole");
    // The hole's cylinder gets a radius that is none.
    let text = String::from_utf8(scratch.read("plate_with_hole.step")).expect("UTF-8");
    let start = text.find("CYLINDRICAL_SURFACE(").expect("a cylinder");
    let end = start + text[start..].find(");").expect("its end");
    let comma = start + text[start..end].rfind(',').expect("its radius");
    scratch.write("part.step", format!("{},$);{}", &text[..comma], &text[end + 2..]));
    let run = scratch.run(["convert", "part.step", "--report", "part.json", "--report-faces"]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("1 face lost:\n    #"), "{}", run.stderr);
    let report = scratch.json("part.json");
    assert_eq!((&report["totals"]["lost"], &report["totals"]["exact"]), (&1.into(), &6.into()));
    let faces = report["faces"].as_array().expect("faces");
    assert!(faces.iter().any(|face| face["status"] == "lost" && face["reason"].is_string()));
    assert!(scratch.path("part.glb").exists());
}

#[test]
fn the_worst_of_several_inputs_is_the_exit_code_and_the_rest_is_written() {
    let scratch = Scratch::with_fixture("box");
    scratch.write("bad.step", "bad");
    let run = scratch.run(["convert", "bad.step", "box.step"]);
    assert_eq!(run.code, Some(2));
    assert!(scratch.path("box.glb").exists());
}

#[test]
fn bad_usage_ends_with_2() {
    let scratch = Scratch::with_fixture("box");
    for arguments in [
        &[][..],
        &["convert"],
        &["convert", "box.step", "--linear-deflection", "5ft"],
        &["convert", "box.step", "--angular-deflection", "0"],
        &["convert", "box.step", "--no-such-option"],
        &["transmogrify", "box.step"],
    ] {
        assert_eq!(scratch.run(arguments).code, Some(2), "{arguments:?}");
    }
    assert_eq!(scratch.files(), ["box.step"]);
}
