//! `trimloop view`: files in a window.

use trimloop_viewer::ViewOptions;

use crate::arguments::{Up, ViewArguments};
use crate::outcome::Outcome;

/// Opens a window and returns when it is closed.
pub fn run(arguments: ViewArguments) -> anyhow::Result<Outcome> {
    let up = match arguments.up {
        Up::Y => trimloop_render::Up::Y,
        Up::Z => trimloop_render::Up::Z,
    };
    trimloop_viewer::run(ViewOptions { files: arguments.inputs, up })?;
    Ok(Outcome::Good)
}
