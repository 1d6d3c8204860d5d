//! Tells when a file changes on disk.

use std::collections::HashSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use notify::{RecursiveMode, Watcher};

/// Files that are watched, by their folders: programs replace files rather than write into them.
pub(crate) struct Watch {
    watcher: Option<notify::RecommendedWatcher>,
    told: Receiver<PathBuf>,
    /// What changed, and when last.
    pending: Vec<(PathBuf, Instant)>,
    /// Names of the files.
    names: Arc<Mutex<HashSet<OsString>>>,
}

/// A file that is still written to is left alone for so long.
const QUIET: Duration = Duration::from_millis(400);

impl Watch {
    pub fn new(wake: impl Fn() + Send + 'static) -> Self {
        let (sender, told) = channel();
        let names: Arc<Mutex<HashSet<OsString>>> = Arc::default();
        let wanted = names.clone();
        let watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else { return };
            if event.kind.is_modify() || event.kind.is_create() {
                // Others in the same folder are nobody's business.
                let names = wanted.lock().unwrap_or_else(PoisonError::into_inner);
                let is_own = |path: &PathBuf| path.file_name().is_some_and(|name| names.contains(name));
                for path in event.paths.into_iter().filter(is_own) {
                    // Nobody listens where the window is closed.
                    let _ = sender.send(path);
                    wake();
                }
            }
        });
        Self { watcher: watcher.ok(), told, pending: Vec::new(), names }
    }

    pub fn add(&mut self, path: &Path) {
        if let Some(name) = path.file_name() {
            self.names.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_owned());
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if let Some(watcher) = &mut self.watcher {
            // Without it, a file is not read again by itself; nothing else is lost.
            let _ = watcher.watch(folder, RecursiveMode::NonRecursive);
        }
    }

    /// Those of `paths` that changed, and are there and at rest; and whether to ask again soon.
    pub fn changed(&mut self, paths: &[PathBuf]) -> (Vec<PathBuf>, bool) {
        let full = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        for path in self.told.try_iter() {
            let Some(own) = paths.iter().find(|own| full(own) == full(&path)) else { continue };
            self.pending.retain(|(other, _)| other != own);
            self.pending.push((own.clone(), Instant::now()));
        }
        let is_ready = |(path, since): &(PathBuf, Instant)| since.elapsed() >= QUIET && path.is_file();
        let ready: Vec<PathBuf> =
            self.pending.iter().filter(|p| is_ready(p)).map(|(p, _)| p.clone()).collect();
        self.pending.retain(|(path, _)| !ready.contains(path));
        (ready, !self.pending.is_empty())
    }
}
