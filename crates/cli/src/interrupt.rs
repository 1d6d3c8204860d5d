//! Ctrl-C: stop, leave nothing half-written.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::Context;

use crate::outcome::Outcome;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Listens for Ctrl-C (and a request to terminate): the first asks to stop, a second stops at once.
pub fn listen() -> anyhow::Result<()> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            std::process::exit(Outcome::Cancelled.code().into());
        }
    })
    .context("cannot listen for Ctrl-C")
}

/// Whether a stop has been asked for.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Fails once a stop has been asked for.
pub fn check() -> io::Result<()> {
    if requested() { Err(io::Error::other("stopped")) } else { Ok(()) }
}
