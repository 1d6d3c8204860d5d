//! `trimloop view`: files in a window.

use std::path::PathBuf;
use std::process::Command;

use trimloop_viewer::{Ended, Resume, ViewOptions};

use crate::arguments::{Up, ViewArguments};
use crate::outcome::Outcome;

/// Opens a window and returns when it is closed.
pub fn run(arguments: ViewArguments) -> anyhow::Result<Outcome> {
    let up = match arguments.up {
        Up::Y => trimloop_render::Up::Y,
        Up::Z => trimloop_render::Up::Z,
    };
    let options = ViewOptions {
        files: arguments.inputs,
        up,
        reference: arguments.compare,
        loses_device: arguments.lose_device,
        resume: arguments.resume,
    };
    match trimloop_viewer::run(options)? {
        Ended::Closed => Ok(Outcome::Good),
        Ended::Lost(files, resume) => again(&files, &resume, arguments.up),
    }
}

/// Starts the program anew: what a driver leaves behind when it fails is nothing to build on.
fn again(files: &[PathBuf], resume: &Resume, up: Up) -> anyhow::Result<Outcome> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg("view").arg("--resume").arg(resume.to_string()).arg("--up");
    command.arg(if up == Up::Y { "y" } else { "z" }).arg("--").args(files);
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;
        Err(command.exec().into())
    }
    #[cfg(not(unix))]
    {
        let status = command.status()?;
        Ok(if status.success() { Outcome::Good } else { Outcome::Failed })
    }
}
