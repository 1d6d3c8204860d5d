//! Work that must not keep the window waiting.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

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
            if let Ok(result) = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)) {
                // Nobody listens where it is not wanted any more.
                let _ = sender.send(result);
            }
            drop(sender);
            context.request_repaint();
        });
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
