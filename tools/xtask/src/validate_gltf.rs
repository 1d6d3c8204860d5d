//! Converts every fixture in every way the writer knows, and runs the Khronos validator over the results.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, ensure};
use trimloop_tests::fixture::{self, Fixture};

use crate::command;

/// Folder, extension and options of each way.
const WAYS: [(&str, &str, &[&str]); 5] = [
    ("plain", "glb", &[]),
    ("everything", "glb", &["--edges", "--face-ids", "--up", "z"]),
    ("quantized", "glb", &["--quantize", "--edges", "--face-ids"]),
    ("compressed", "glb", &["--meshopt", "--quantize", "--edges", "--face-ids"]),
    ("two-files", "gltf", &["--edges"]),
];

/// Fails where the validator finds an error or a warning, and where nothing could be converted.
pub fn run(root: &Path) -> anyhow::Result<()> {
    let program = build(root)?;
    let out = root.join("target/validate-gltf");
    if out.exists() {
        fs::remove_dir_all(&out)?;
    }
    let fixtures = fixture::all();
    let mut written = 0;
    for (way, extension, options) in WAYS {
        for fixture in &fixtures {
            written += usize::from(convert(&program, fixture, &out.join(way), extension, options)?);
        }
    }
    println!("{} fixtures, {written} files made of them", fixtures.len());
    ensure!(written > 0, "nothing could be converted");
    command::run(root.join("tools/gltf_validate/run"), root, [&out])
}

/// The path of the command, built.
fn build(root: &Path) -> anyhow::Result<PathBuf> {
    let arguments = ["build", "--quiet", "--package", "trimloop-cli", "--message-format", "json"];
    let output = Command::new("cargo").args(arguments).current_dir(root).output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let messages = String::from_utf8(output.stdout)?;
    let executable =
        |line| Some(serde_json::from_str::<serde_json::Value>(line).ok()?["executable"].as_str()?.into());
    messages.lines().rev().find_map(executable).context("cargo names no executable")
}

/// Converts a fixture into `folder`; whether there was something to convert. A broken one fails, and leaves nothing.
fn convert(
    program: &Path,
    fixture: &Fixture,
    folder: &Path,
    extension: &str,
    options: &[&str],
) -> anyhow::Result<bool> {
    let target = folder.join(format!("{}.{extension}", fixture.name));
    fs::create_dir_all(target.parent().unwrap_or(folder))?;
    let mut command = Command::new(program);
    command.args(["convert", "--quiet", "-o"]).arg(&target).arg(&fixture.path).args(options);
    let code = command.output().with_context(|| format!("cannot run {}", program.display()))?.status.code();
    ensure!(matches!(code, Some(0..=2)), "{} ended with {code:?}", fixture.name);
    Ok(target.exists())
}
