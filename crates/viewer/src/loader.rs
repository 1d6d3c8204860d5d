//! Reads files in the background: first the model, then its parts, one by one as they are ready to be drawn.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use rayon::prelude::*;
use trimloop_brep::{Diagnostic, Model};
use trimloop_import::ImportOptions;
use trimloop_mesh::Monitor;
use trimloop_render::ScenePart;

use crate::job::{FaceProgress, READERS};

/// A file on its way.
#[derive(Debug)]
pub(crate) struct Loading {
    pub path: PathBuf,
    /// Whether it replaces what was read before from the same place.
    pub is_reload: bool,
    /// The document that its parts go to.
    pub document: Option<u64>,
    progress: Arc<FaceProgress>,
    arrivals: Receiver<Arrival>,
}

/// What comes from a file, in this order: its model, its parts in any order, the end.
#[derive(Debug)]
pub(crate) enum Arrival {
    Model(Arc<Model>),
    Part(Box<ReadyPart>),
    /// Seconds that it took.
    Done(f64),
    Failed(String),
}

/// A part that can be drawn.
#[derive(Debug)]
pub(crate) struct ReadyPart {
    pub index: usize,
    pub part: ScenePart,
    pub diagnostics: Vec<Diagnostic>,
}

impl Loading {
    /// Begins to read `path`; `wake` is called whenever something has arrived.
    pub fn start(path: PathBuf, is_reload: bool, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let progress = Arc::new(FaceProgress::default());
        let (sender, arrivals) = channel();
        let (own, from) = (progress.clone(), path.clone());
        std::thread::spawn(move || {
            let read = || READERS.run(|| load(&from, &own, &sender, &wake));
            let told = std::panic::catch_unwind(std::panic::AssertUnwindSafe(read))
                .unwrap_or_else(|_| Err("the program failed on this file; please report it".to_owned()));
            if let Err(reason) = told {
                // Nobody listens where the window is closed.
                let _ = sender.send(Arrival::Failed(reason));
            }
            wake();
        });
        Self { path, is_reload, document: None, progress, arrivals }
    }

    /// What has arrived next; `None` for nothing yet.
    pub fn poll(&self) -> Option<Arrival> {
        match self.arrivals.try_recv() {
            Ok(arrival) => Some(arrival),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Arrival::Failed("reading ended without a result".to_owned()))
            }
        }
    }

    /// The share that is done; `None` while the file is being read.
    pub fn share(&self) -> Option<f32> {
        self.progress.share()
    }

    pub fn cancel(&self) {
        self.progress.cancel();
    }

    pub fn is_cancelled(&self) -> bool {
        self.progress.cancelled()
    }
}

/// What nobody listens to any more needs not be done.
impl Drop for Loading {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn load(
    path: &Path,
    progress: &FaceProgress,
    sender: &Sender<Arrival>,
    wake: &(dyn Fn() + Send + Sync),
) -> Result<(), String> {
    let start = std::time::Instant::now();
    // Pipes and devices may never end.
    if std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
        return Err("it is no regular file".to_owned());
    }
    let model = trimloop_import::read(path, &ImportOptions::default()).map_err(|error| error.to_string())?;
    if model.parts.iter().all(|part| part.faces.is_empty() && part.curves.is_empty()) {
        return Err("there is nothing in it that could be drawn".to_owned());
    }
    progress.expect(&model);
    let model = Arc::new(model);
    let send = |arrival: Arrival| {
        let _ = sender.send(arrival);
        wake();
    };
    send(Arrival::Model(model.clone()));
    // Large parts first: small ones fill the gaps.
    let mut order: Vec<usize> = (0..model.parts.len()).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(model.parts[k].faces.len()));
    let make = |index: usize| {
        let (part, diagnostics) = ScenePart::new(&model.parts[index], progress)?;
        send(Arrival::Part(Box::new(ReadyPart { index, part, diagnostics })));
        Ok(())
    };
    let made: Result<(), trimloop_mesh::Cancelled> = order.into_par_iter().with_max_len(1).try_for_each(make);
    made.map_err(|error| error.to_string())?;
    send(Arrival::Done(start.elapsed().as_secs_f64()));
    Ok(())
}
