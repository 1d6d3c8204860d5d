//! Files that are being read: what has arrived of them goes into documents.

use std::path::PathBuf;
use std::sync::Arc;

use trimloop_brep::Model;
use trimloop_render::RenderError;

use crate::document::Document;
use crate::loader::{Arrival, Loading, ReadyPart};

use super::{App, Load};

impl App {
    pub(super) fn start(&mut self, path: PathBuf, is_reload: bool, is_front: bool) {
        let context = self.context.clone();
        // From now on: it may change while it is being read.
        self.watch.add(&path);
        let loading = Loading::start(path, is_reload, move || context.request_repaint());
        self.loading.push(Load { loading, held: None, is_front, order: self.next_order });
        self.next_order += 1;
    }

    /// Takes over what has been read, and reads again what changed.
    pub(super) fn receive(&mut self) {
        let mut still = Vec::new();
        for mut load in std::mem::take(&mut self.loading) {
            if load.loading.is_cancelled() {
                self.drop_document(load.loading.document);
            } else if self.receive_of(&mut load) {
                still.push(load);
            }
        }
        still.append(&mut self.loading);
        self.loading = still;
        let open = self.documents.iter().map(|document| document.path.clone());
        let paths: Vec<PathBuf> =
            open.chain(self.loading.iter().map(|load| load.loading.path.clone())).collect();
        let (changed, is_pending) = self.watch.changed(&paths);
        self.changed.extend(changed);
        // What changes while it is read is read once more, afterwards.
        let is_read = |own: &PathBuf| self.loading.iter().any(|load| load.loading.path == *own);
        let (later, now): (Vec<PathBuf>, Vec<PathBuf>) =
            std::mem::take(&mut self.changed).into_iter().partition(is_read);
        self.changed = later;
        for path in now {
            if self.documents.iter().any(|document| document.path == path) {
                self.start(path, true, false);
            }
        }
        if is_pending || !self.loading.is_empty() || self.exporting.is_some() {
            self.context.request_repaint_after(std::time::Duration::from_millis(100));
        }
        if let Some(document) = self.documents.get_mut(self.active)
            && document.measure.poll()
        {
            self.context.request_repaint();
        }
        self.receive_comparison();
        self.receive_export();
        self.receive_answer();
    }

    /// Takes over what has arrived of a file; whether more is to come.
    pub(super) fn receive_of(&mut self, load: &mut Load) -> bool {
        // Parts go to the device one by one: no frame waits for all of them.
        let start = std::time::Instant::now();
        while start.elapsed().as_millis() < 12 {
            let Some(arrival) = load.loading.poll() else { return true };
            let failed = match arrival {
                Arrival::Failed(reason) => Err(reason),
                Arrival::Model(model) if load.loading.is_reload => {
                    load.held = Some((model, Vec::new()));
                    Ok(())
                }
                Arrival::Model(model) => self.begin(load, model).map_err(|error| error.to_string()),
                Arrival::Part(part) => match &mut load.held {
                    Some((_, parts)) => {
                        parts.push(*part);
                        Ok(())
                    }
                    None => match self.documents.iter_mut().find(|own| Some(own.id) == load.loading.document)
                    {
                        Some(document) => document.take(*part).map_err(|error| error.to_string()),
                        // It was closed meanwhile.
                        None => return false,
                    },
                },
                Arrival::Done(seconds) => {
                    let held = load.held.take();
                    if let Err(error) = self.end(load, held, seconds) {
                        self.fail(load, &error.to_string());
                    }
                    return false;
                }
            };
            if let Err(reason) = failed {
                self.fail(load, &reason);
                return false;
            }
        }
        self.context.request_repaint();
        true
    }

    fn fail(&mut self, load: &Load, reason: &str) {
        self.complain(format!("{}: {reason}", load.loading.path.display()));
        self.drop_document(load.loading.document);
    }

    /// A file's model is there: its tree can be shown, its parts are to come.
    pub(super) fn begin(&mut self, load: &mut Load, model: Arc<Model>) -> Result<(), RenderError> {
        let path = load.loading.path.clone();
        let mut document = Document::new(&self.gpu, self.next_id, path.clone(), model)?;
        document.order = load.order;
        load.loading.document = Some(self.next_id);
        self.next_id += 1;
        self.settings.remember(&path);
        let place = self.documents.partition_point(|own| own.order < load.order);
        self.documents.insert(place, document);
        if place <= self.active && self.documents.len() > 1 {
            self.active += 1;
        }
        if load.is_front || self.documents.len() == 1 {
            self.activate(place);
        }
        Ok(())
    }

    /// All of a file is there.
    pub(super) fn end(
        &mut self,
        load: &Load,
        held: Option<(Arc<Model>, Vec<ReadyPart>)>,
        seconds: f64,
    ) -> Result<(), RenderError> {
        let Some((model, parts)) = held else {
            let wanted = load.loading.document;
            if let Some(place) = self.documents.iter().position(|own| Some(own.id) == wanted) {
                self.documents[place].finish(seconds);
                if let Some((_, reference)) =
                    self.reference.take_if(|(file, _)| *file == self.documents[place].path)
                {
                    self.compare_with_of(place, reference);
                }
                // What is there now may reach farther than what the file's vertices told.
                if place == self.active && self.fitted == Some(self.view) {
                    self.is_fitted = false;
                }
            }
            return Ok(());
        };
        let path = &load.loading.path;
        let Some(place) = self.documents.iter().position(|own| own.path == *path) else { return Ok(()) };
        let mut document = Document::new(&self.gpu, self.next_id, path.clone(), model)?;
        self.next_id += 1;
        for part in parts {
            document.take(part)?;
        }
        document.finish(seconds);
        let before = &self.documents[place];
        document.take_over(before);
        document.order = before.order;
        let compared = self.comparing.take_if(|(id, ..)| *id == before.id).map(|(_, reference, _)| reference);
        let reference = compared.or_else(|| before.deviation.as_ref().map(|own| own.reference.clone()));
        if self.shown == Some(before.id) {
            self.shown = Some(document.id);
        }
        self.documents[place] = document;
        self.tree.reset();
        if let Some(reference) = reference {
            self.compare_with_of(place, reference);
        }
        // It is well again.
        let name = path.display().to_string();
        self.messages.retain(|message| !message.starts_with(&name));
        Ok(())
    }
}
