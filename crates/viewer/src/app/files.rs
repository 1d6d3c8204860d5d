//! What goes to files and comes from them: pictures, exports, references.

use std::path::{Path, PathBuf};

use trimloop_render::{Look, Picture};

use crate::deviation::{self, Deviation};
use crate::display;
use crate::export::{Exporting, whole_file};
use crate::job::{Job, Polled};

use super::App;

impl App {
    /// Begins to measure how far the file that is shown is from a reference.
    pub fn compare_with(&mut self, reference: PathBuf) {
        self.compare_with_of(self.active, reference);
    }

    pub(super) fn compare_with_of(&mut self, index: usize, reference: PathBuf) {
        let Some(document) = self.documents.get(index) else { return };
        let (model, path) = (document.model.clone(), reference.clone());
        let work = move || {
            deviation::measure(&model, &reference)
                .map_err(|reason| format!("cannot compare with {}: {reason}", reference.display()))
        };
        self.comparing = Some((document.id, path, Job::start(&self.context, work)));
    }

    pub(super) fn receive_comparison(&mut self) {
        let Some((id, _, job)) = &self.comparing else { return };
        let (id, polled) = (*id, job.poll());
        let found = match polled {
            Polled::Waiting => return,
            Polled::Done(Ok(found)) => Ok(found),
            Polled::Done(Err(reason)) => Err(reason),
            Polled::Failed => Err("the comparison failed; please report it".to_owned()),
        };
        self.comparing = None;
        let made =
            found.and_then(|found| Deviation::new(&self.gpu, found).map_err(|error| error.to_string()));
        match made {
            Ok(deviation) => {
                if let Some(document) = self.documents.iter_mut().find(|own| own.id == id) {
                    document.deviation = Some(deviation);
                    document.revision += 1;
                    self.display.colors = display::Colors::Deviation;
                }
            }
            Err(reason) => self.complain(reason),
        }
    }

    /// Begins to write what is shown to a glTF file.
    pub fn export_to(&mut self, path: PathBuf) {
        let Some(document) = self.documents.get(self.active) else { return };
        let options = self.settings.export.clone();
        let is_any = document.renderer.scene().instances.iter().any(|i| i.is_shown && i.node.is_some());
        if options.is_shown_only && !is_any {
            self.complain("nothing is shown that could be exported".to_owned());
            return;
        }
        let is_shown: Vec<bool> = (0..document.model.nodes.len())
            .map(|node| !options.is_shown_only || document.is_shown(node))
            .collect();
        let exporting = Exporting::start(&self.context, &document.model, is_shown, options, path);
        self.exporting = Some(exporting);
        self.is_export_open = false;
    }

    pub(super) fn receive_export(&mut self) {
        let Some(exporting) = &self.exporting else { return };
        match exporting.job.poll() {
            Polled::Waiting => return,
            Polled::Done(Ok(note)) => self.note(note),
            Polled::Done(Err(_)) if exporting.is_cancelled() => {}
            Polled::Done(Err(reason)) => self.complain(reason),
            Polled::Failed => self.complain("the export failed; please report it".to_owned()),
        }
        self.exporting = None;
    }

    pub(super) fn picture(&mut self, size: [u32; 2]) -> Result<Picture, String> {
        let look = Look { samples: 16, ..self.look(self.bounds()) };
        let camera = self.view.camera();
        let is_deviation = self.display.colors == display::Colors::Deviation;
        self.viewport.invalidate();
        let document = self.documents.get_mut(self.active).ok_or("nothing is open")?;
        let renderer = match &mut document.deviation {
            Some(deviation) if is_deviation => &mut deviation.renderer,
            _ => &mut document.renderer,
        };
        renderer.picture(&camera, size, &look).map_err(|error| error.to_string())
    }

    /// Draws what is shown into a PNG file of `size` pixels.
    pub fn picture_to(&mut self, path: &Path, size: [u32; 2]) {
        let made = self.picture(size).and_then(|picture| picture.to_png().map_err(|e| e.to_string()));
        let written = made.and_then(|png| whole_file(path, |out| out.write_all(&png)));
        match written {
            Ok(()) => self.note(format!("wrote {}", path.display())),
            Err(error) => self.complain(format!("cannot save {}: {error}", path.display())),
        }
    }

    pub(super) fn copy_picture(&mut self) {
        if self.documents.is_empty() {
            return;
        }
        let height = 1080;
        match self.picture([(f64::from(height) * self.aspect).round().clamp(1.0, 4096.0) as u32, height]) {
            Ok(picture) => {
                let size = [picture.width as usize, picture.height as usize];
                self.context.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, &picture.rgba));
                self.note("the picture is in the clipboard".to_owned());
            }
            Err(error) => self.complain(error),
        }
    }
}
