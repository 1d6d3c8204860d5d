//! A progress bar over the faces of a file, on a terminal only.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};
use trimloop_mesh::Monitor;

use crate::interrupt;

/// Counts finished faces, and passes on the wish to stop.
pub struct Progress {
    bar: Option<ProgressBar>,
}

impl Progress {
    /// A bar for `count` of whatever `what` names; 0 where the number is not known yet.
    pub fn counting(count: usize, what: &'static str, quiet: bool) -> Self {
        let seen = !quiet && std::io::stderr().is_terminal();
        Self { bar: seen.then(|| bar_of(count as u64, what)) }
    }

    /// So many more are done.
    pub fn add(&self, count: usize) {
        if let Some(bar) = &self.bar {
            bar.inc(count as u64);
        }
    }

    /// A bar for `faces` faces; none where nobody would see it.
    pub fn new(faces: usize, quiet: bool) -> Self {
        let seen = !quiet && std::io::stderr().is_terminal();
        Self { bar: seen.then(|| bar(faces as u64)) }
    }
}

fn bar(faces: u64) -> ProgressBar {
    bar_of(faces, "faces")
}

fn bar_of(count: u64, what: &'static str) -> ProgressBar {
    if count == 0 {
        let bar = ProgressBar::new_spinner().with_message(what);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {pos} {msg}") {
            bar.set_style(style);
        }
        return bar;
    }
    let bar = ProgressBar::new(count).with_message(what);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg}, {eta} left") {
        bar.set_style(style);
    }
    bar
}

impl Monitor for Progress {
    fn face_done(&self) {
        if let Some(bar) = &self.bar {
            bar.inc(1);
        }
    }

    fn cancelled(&self) -> bool {
        interrupt::requested()
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
