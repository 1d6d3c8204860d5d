//! `cargo xtask`: what developers repeat.

mod command;
mod deviation;
mod screenshots;
mod validate_gltf;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Parser, Subcommand};
use trimloop_tests::fixture;

use crate::command::{cargo, run};

/// What developers repeat.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

/// A task.
#[derive(Debug, Subcommand)]
enum Task {
    /// Make the fixtures and their references again (installs cadquery in an environment of its own)
    Fixtures {
        /// Passed on to tools/reference/make
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Convert every fixture in every way and run the Khronos validator over the results
    ValidateGltf,
    /// Print how far the fixtures' triangles are from the exact surfaces, by kind of surface (use a release build:
    /// cargo run --release --package xtask -- deviation)
    Deviation {
        /// Only the fixtures whose name contains one of these words
        words: Vec<String>,
    },
    /// Run the Criterion benchmarks
    Bench {
        /// Passed on to cargo bench
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Fuzz (needs a nightly toolchain and cargo-fuzz)
    Fuzz {
        /// The target
        target: String,
        /// How long
        #[arg(long, default_value_t = 10)]
        minutes: u32,
    },
    /// Photograph the viewer for the README and the tests (needs Xvfb)
    Screenshots {
        /// Only those whose name contains one of these words
        words: Vec<String>,
    },
    /// Build the documentation, warnings denied
    Docs,
}

fn main() -> anyhow::Result<()> {
    let root = root()?;
    match Arguments::parse().task {
        Task::Fixtures { arguments } => run(root.join("tools/reference/make"), &root, arguments),
        Task::ValidateGltf => validate_gltf::run(&root),
        Task::Deviation { words } => {
            deviation::run(&words);
            Ok(())
        }
        Task::Bench { arguments } => {
            cargo(&root, ["bench", "--workspace"].into_iter().map(str::to_string).chain(arguments))
        }
        Task::Fuzz { target, minutes } => fuzz(&root, &target, minutes),
        Task::Screenshots { words } => screenshots::run(&root, &words),
        Task::Docs => {
            command::cargo_with(&root, ["doc", "--workspace", "--no-deps"], [("RUSTDOCFLAGS", "-D warnings")])
        }
    }
}

fn fuzz(root: &Path, target: &str, minutes: u32) -> anyhow::Result<()> {
    let [corpus, seeds] = ["corpus", "seeds"].map(|folder| root.join("fuzz").join(folder).join(target));
    std::fs::create_dir_all(&corpus)?;
    std::fs::create_dir_all(&seeds)?;
    // The whole path starts from the fixtures; small ones, as every input is run thousands of times.
    let is_iges = |path: &Path| path.extension().is_some_and(|extension| extension == "igs");
    let starts = |path: &Path| target == if is_iges(path) { "iges" } else { "mesh" };
    for fixture in fixture::all().into_iter().filter(|fixture| starts(&fixture.path)) {
        if std::fs::metadata(&fixture.path)?.len() < 24 << 10 {
            std::fs::copy(&fixture.path, corpus.join(fixture.name.replace('/', "-")))?;
        }
    }
    let seconds = format!("-max_total_time={}", 60 * minutes);
    let dictionary = if target == "iges" { "-dict=fuzz/iges.dict" } else { "-dict=fuzz/part21.dict" };
    let limits = [dictionary, "-timeout=10", "-rss_limit_mb=2048", &seconds].map(OsStr::new);
    let run = ["+nightly", "fuzz", "run", "-O", target].map(OsStr::new);
    cargo(
        root,
        run.into_iter().chain([corpus.as_os_str(), seeds.as_os_str(), OsStr::new("--")]).chain(limits),
    )
}

/// The workspace's folder.
fn root() -> anyhow::Result<PathBuf> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).map(Path::to_path_buf).context("xtask lies in tools/xtask")
}
