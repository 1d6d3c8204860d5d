//! `inspect`, `completions` and `man`.

use std::io::Read;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::{Scratch, fixture};

#[test]
fn a_person_reads_schema_units_contents_and_tree() {
    let scratch = Scratch::with_fixture("cylinder");
    let run = scratch.run(["inspect", "cylinder.step"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for text in
        ["STEP AP214", "Open CASCADE", "millimetre, radian", "1 solid, ", "plane 2, cylinder 1", "tree"]
    {
        assert!(run.stdout.contains(text), "{text:?} is not in\n{}", run.stdout);
    }
}

#[test]
fn a_program_reads_json() {
    let scratch = Scratch::with_fixture("cylinder");
    let run = scratch.run(["inspect", "--json", "cylinder.step"]);
    let inspection: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(inspection["counts"]["faces"], 3);
    assert_eq!(
        inspection["surfaces"],
        json!([{"name": "plane", "count": 2}, {"name": "cylinder", "count": 1}])
    );
    let root = inspection["roots"][0].as_u64().expect("a root") as usize;
    assert_eq!(inspection["nodes"][root]["name"], "cylinder");
}

#[test]
fn a_reader_that_stops_early_is_no_error() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trimloop"));
    let files = std::iter::repeat_n(fixture("box"), 300);
    let mut child = command
        .arg("inspect")
        .args(files)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("trimloop runs");
    drop(child.stdout.take());
    let mut stderr = String::new();
    child.stderr.take().expect("stderr").read_to_string(&mut stderr).expect("UTF-8");
    assert_eq!((child.wait().expect("it ends").code(), stderr.as_str()), (Some(0), ""));
}

#[test]
fn every_shell_gets_completions() {
    let scratch = Scratch::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = scratch.run(["completions", shell]);
        assert!(run.code == Some(0) && run.stdout.contains("linear-deflection"), "{shell}");
    }
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let scratch = Scratch::new();
    assert_eq!(scratch.run(["man", "."]).code, Some(0));
    let files = scratch.files();
    for page in ["trimloop.1", "trimloop-convert.1", "trimloop-inspect.1"] {
        assert!(files.iter().any(|file| file == page), "{page} is not in {files:?}");
    }
}
