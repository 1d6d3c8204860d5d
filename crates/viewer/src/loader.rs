//! Reads files in the background.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, OnceLock};

use trimloop_brep::Model;
use trimloop_import::ImportOptions;
use trimloop_mesh::Monitor;
use trimloop_render::Scene;

/// A file on its way.
#[derive(Debug)]
pub(crate) struct Loading {
    pub path: PathBuf,
    /// Whether it replaces what was read before from the same place.
    pub is_reload: bool,
    progress: Arc<LoadProgress>,
    done: Receiver<Result<Loaded, String>>,
}

/// A file's content, ready to be drawn.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub model: Model,
    pub scene: Scene,
    pub seconds: f64,
}

/// How far it is, and whether somebody stopped it.
#[derive(Debug, Default)]
struct LoadProgress {
    faces: OnceLock<usize>,
    done: AtomicUsize,
    is_cancelled: AtomicBool,
}

impl Monitor for LoadProgress {
    fn face_done(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}

impl Loading {
    /// Begins to read `path`; `wake` is called when it is done, and now and then before.
    pub fn start(path: PathBuf, is_reload: bool, wake: impl Fn() + Send + 'static) -> Self {
        let progress = Arc::new(LoadProgress::default());
        let (sender, done) = channel();
        let (own, from) = (progress.clone(), path.clone());
        std::thread::spawn(move || {
            let read = || load(&from, &own);
            let told = std::panic::catch_unwind(std::panic::AssertUnwindSafe(read))
                .unwrap_or_else(|_| Err("the program failed on this file; please report it".to_owned()));
            let _ = sender.send(told);
            wake();
        });
        Self { path, is_reload, progress, done }
    }

    /// The result, once it is there.
    pub fn poll(&self) -> Option<Result<Loaded, String>> {
        match self.done.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err("reading ended without a result".to_owned())),
        }
    }

    /// The share that is done; `None` while the file is being read.
    pub fn share(&self) -> Option<f32> {
        let faces = *self.progress.faces.get()?;
        Some(self.progress.done.load(Ordering::Relaxed) as f32 / faces.max(1) as f32)
    }

    pub fn cancel(&self) {
        self.progress.is_cancelled.store(true, Ordering::Relaxed);
    }

    pub fn is_cancelled(&self) -> bool {
        self.progress.cancelled()
    }
}

fn load(path: &Path, progress: &LoadProgress) -> Result<Loaded, String> {
    let start = std::time::Instant::now();
    let model = trimloop_import::read(path, &ImportOptions::default()).map_err(|error| error.to_string())?;
    let _ = progress.faces.set(model.parts.iter().map(|part| part.faces.len()).sum());
    let scene = Scene::new(&model, progress).map_err(|error| error.to_string())?;
    Ok(Loaded { model, scene, seconds: start.elapsed().as_secs_f64() })
}
