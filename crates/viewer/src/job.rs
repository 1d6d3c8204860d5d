//! Work that must not keep the window waiting.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use rayon::ThreadPool;
use trimloop_brep::Model;
use trimloop_mesh::Monitor;

/// Workers of their own: those of the window must not wait for what others are busy with.
#[derive(Debug)]
pub(crate) struct Workers(OnceLock<Option<ThreadPool>>);

/// Reads files.
pub(crate) static READERS: Workers = Workers(OnceLock::new());
/// Measures, cuts, compares and writes.
static HELPERS: Workers = Workers(OnceLock::new());

impl Workers {
    /// Does `work` there; on the usual workers where threads cannot be had.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let make = || rayon::ThreadPoolBuilder::new().stack_size(8 << 20).build().ok();
        match self.0.get_or_init(make) {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

/// How far the work on a model's faces is, and whether somebody stopped it.
#[derive(Debug, Default)]
pub(crate) struct FaceProgress {
    faces: OnceLock<usize>,
    done: AtomicUsize,
    is_cancelled: AtomicBool,
}

impl FaceProgress {
    /// It is known now what there is to do.
    pub fn expect(&self, model: &Model) {
        self.faces.get_or_init(|| model.parts.iter().map(|part| part.faces.len()).sum());
    }

    /// The share that is done; `None` as long as nobody knows of what.
    pub fn share(&self) -> Option<f32> {
        let faces = *self.faces.get()?;
        Some(self.done.load(Ordering::Relaxed) as f32 / faces.max(1) as f32)
    }

    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

impl Monitor for FaceProgress {
    fn face_done(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}

/// A result on its way from another thread.
#[derive(Debug)]
pub(crate) struct Job<T> {
    done: Receiver<T>,
}

/// What became of a job.
#[derive(Debug)]
pub(crate) enum Polled<T> {
    Waiting,
    Done(T),
    /// The work panicked.
    Failed,
}

impl<T: Send + 'static> Job<T> {
    /// Begins to do `work`; `context` is redrawn when it is done.
    pub fn start(context: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, done) = channel();
        let context = context.clone();
        std::thread::spawn(move || {
            if let Ok(result) = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| HELPERS.run(work))) {
                // Nobody listens where it is not wanted any more.
                let _ = sender.send(result);
            }
            drop(sender);
            context.request_repaint();
        });
        Self { done }
    }

    /// A job that is done.
    pub fn done(result: T) -> Self {
        let (sender, done) = channel();
        // The other end is here.
        let _ = sender.send(result);
        Self { done }
    }

    pub fn poll(&self) -> Polled<T> {
        match self.done.try_recv() {
            Ok(result) => Polled::Done(result),
            Err(TryRecvError::Empty) => Polled::Waiting,
            Err(TryRecvError::Disconnected) => Polled::Failed,
        }
    }
}
