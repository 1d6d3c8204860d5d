//! Runs other programs and takes their failure for one's own.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

use anyhow::{Context, ensure};

/// Runs a program in `folder`.
pub fn run<S: AsRef<OsStr>>(
    program: impl AsRef<OsStr>,
    folder: &Path,
    arguments: impl IntoIterator<Item = S>,
) -> anyhow::Result<()> {
    check(Command::new(program).args(arguments).current_dir(folder))
}

/// Runs cargo in `folder`.
pub fn cargo<S: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = S>) -> anyhow::Result<()> {
    cargo_with(folder, arguments, [])
}

/// Runs cargo in `folder` with further variables in its environment.
pub fn cargo_with<'a, S: AsRef<OsStr>>(
    folder: &Path,
    arguments: impl IntoIterator<Item = S>,
    variables: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> anyhow::Result<()> {
    check(Command::new("cargo").args(arguments).envs(variables).current_dir(folder))
}

fn check(command: &mut Command) -> anyhow::Result<()> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status = command.status().with_context(|| format!("cannot run {name}"))?;
    ensure!(status.success(), "{name} ended with {status}");
    Ok(())
}
