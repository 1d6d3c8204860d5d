//! Ctrl-C: stop, leave nothing half-written.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::Context;

use crate::outcome::Outcome;

static REQUESTED: AtomicBool = AtomicBool::new(false);
static TEMPORARY: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Listens for Ctrl-C (and a request to terminate): the first asks to stop after the faces at hand, a second stops at
/// once.
pub fn listen() -> anyhow::Result<()> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            stop();
        }
        if io::stderr().is_terminal() {
            eprintln!("stopping; once more to stop at once");
        }
    })
    .context("cannot listen for Ctrl-C")
}

/// Removes what is half-written and ends the process.
fn stop() -> ! {
    let temporary = temporary(); // Held to the end: nothing new begins.
    for path in temporary.iter() {
        let _ = fs::remove_file(path); // There is nobody left to tell.
    }
    std::process::exit(Outcome::Cancelled.code().into());
}

/// Whether a stop has been asked for.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Fails once a stop has been asked for.
pub fn check() -> io::Result<()> {
    if requested() { Err(io::Error::other("stopped")) } else { Ok(()) }
}

/// A file that is to be removed when the process is stopped at once, as long as this lives.
#[derive(Debug)]
pub struct Temporary(PathBuf);

impl Temporary {
    /// Remembers `path`.
    pub fn new(path: &Path) -> Self {
        temporary().insert(path.to_path_buf());
        Self(path.to_path_buf())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        temporary().remove(&self.0);
    }
}

fn temporary() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Temporary, temporary};

    #[test]
    fn files_are_remembered_as_long_as_they_are_temporary() {
        let path = Path::new("a/temporary/file");
        let file = Temporary::new(path);
        assert!(temporary().contains(path));
        drop(file);
        assert!(!temporary().contains(path));
    }
}
