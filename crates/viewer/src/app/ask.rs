//! Asks where files are: in the system's dialog, and where there is none, in a line of text.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::{Key, Ui};

use crate::job::{Job, Polled};

use super::App;

/// What a path is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    Open,
    Reference,
    Picture,
    Export,
}

/// A dialog that is open.
#[derive(Debug)]
pub(super) struct Asking {
    wanted: Wanted,
    /// The document that it is about.
    document: Option<u64>,
    suggested: PathBuf,
    since: Instant,
    job: Job<Vec<PathBuf>>,
}

/// A path that is being typed.
#[derive(Debug)]
pub(super) struct Typing {
    wanted: Wanted,
    document: Option<u64>,
    text: String,
    is_new: bool,
}

/// Files that can be opened, by the ends of their names.
const CAD: [&str; 7] = ["step", "stp", "stpz", "igs", "iges", "tspline", "gz"];
const MESHES: [&str; 7] = ["stl", "obj", "ply", "gltf", "glb", "3mf", "step"];
/// Nobody closes a dialog as fast as this: there was none.
const AT_ONCE: Duration = Duration::from_millis(400);

impl Wanted {
    fn title(self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::Reference => "Compare with",
            Self::Picture => "Save a picture",
            Self::Export => "Export to glTF",
        }
    }

    fn show(self, suggested: &Path) -> Vec<PathBuf> {
        let mut dialog = rfd::FileDialog::new().set_title(self.title());
        if let Some(folder) = suggested.parent().filter(|folder| folder.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        let name = suggested.file_name().unwrap_or_default().to_string_lossy();
        let all = ["*"];
        match self {
            Self::Open => {
                dialog.add_filter("CAD", &CAD).add_filter("Everything", &all).pick_files().unwrap_or_default()
            }
            Self::Reference => dialog
                .add_filter("Meshes and CAD", &MESHES)
                .add_filter("Everything", &all)
                .pick_file()
                .into_iter()
                .collect(),
            Self::Picture => {
                dialog.add_filter("PNG", &["png"]).set_file_name(name).save_file().into_iter().collect()
            }
            Self::Export => {
                dialog.add_filter("glTF", &["glb"]).set_file_name(name).save_file().into_iter().collect()
            }
        }
    }
}

impl App {
    /// Asks for a path, unless that is being done.
    pub(super) fn ask(&mut self, wanted: Wanted) {
        if self.asking.is_some() {
            return;
        }
        let own = self.documents.get(self.active).map(|document| document.path.clone());
        let path = own.or_else(|| self.settings.recent.first().cloned()).unwrap_or_default();
        let path = std::path::absolute(&path).unwrap_or(path);
        let suggested = match wanted {
            Wanted::Open | Wanted::Reference => path,
            Wanted::Picture => path.with_extension("png"),
            Wanted::Export => path.with_extension("glb"),
        };
        let for_dialog = suggested.clone();
        // Windows must go on while the dialog is open; on macOS dialogs are the main thread's.
        let job = match cfg!(target_os = "macos") {
            true => Job::done(wanted.show(&for_dialog)),
            false => Job::start(&self.context, move || wanted.show(&for_dialog)),
        };
        let document = self.documents.get(self.active).map(|document| document.id);
        self.asking = Some(Asking { wanted, document, suggested, since: Instant::now(), job });
    }

    /// Takes over what was chosen.
    pub(super) fn receive_answer(&mut self) {
        let Some(asking) = &self.asking else { return };
        let paths = match asking.job.poll() {
            Polled::Waiting => return,
            Polled::Done(paths) => paths,
            Polled::Failed => Vec::new(),
        };
        let Some(asking) = self.asking.take() else { return };
        if paths.is_empty() && asking.since.elapsed() < AT_ONCE {
            let text = asking.suggested.display().to_string();
            let Asking { wanted, document, .. } = asking;
            self.typing = Some(Typing { wanted, document, text, is_new: true });
        }
        self.answer(asking.wanted, asking.document, paths);
    }

    fn answer(&mut self, wanted: Wanted, document: Option<u64>, paths: Vec<PathBuf>) {
        if wanted == Wanted::Open {
            self.open_all(paths);
            return;
        }
        let Some(path) = paths.into_iter().next() else { return };
        // The one that it was about when somebody asked, which may not be in front any more.
        let Some(index) = self.documents.iter().position(|own| Some(own.id) == document) else { return };
        if index != self.active {
            self.activate(index);
        }
        let with_ending = |ending: &str| match path.extension() {
            Some(_) => path.clone(),
            None => path.with_extension(ending),
        };
        match wanted {
            Wanted::Open => {}
            Wanted::Reference => self.compare_with(path),
            Wanted::Export => self.export_to(with_ending("glb")),
            Wanted::Picture => {
                let height = 1440;
                let width = (f64::from(height) * self.aspect).round().clamp(1.0, 8192.0);
                self.picture_to(&with_ending("png"), [width as u32, height]);
            }
        }
    }

    /// The line of text in which a path is typed.
    pub(super) fn path_dialog(&mut self, ui: &Ui) {
        let Some(typing) = &mut self.typing else { return };
        let mut is_done = false;
        let mut is_over = ui.input(|input| input.key_pressed(Key::Escape));
        let title = typing.wanted.title();
        egui::Window::new(title).id(egui::Id::unique("path")).collapsible(false).show(ui.ctx(), |ui| {
            ui.label("There is no file dialog here (xdg-desktop-portal and zenity have one). The path:");
            let line = ui.add(egui::TextEdit::singleline(&mut typing.text).desired_width(520.0));
            if std::mem::take(&mut typing.is_new) {
                line.request_focus();
            }
            is_done = line.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            ui.horizontal(|ui| {
                is_done |= ui.button("OK").clicked();
                is_over |= ui.button("Cancel").clicked();
            });
        });
        if is_done || is_over {
            let typing = self.typing.take();
            if let Some(Typing { wanted, document, text, .. }) = typing.filter(|_| is_done) {
                self.answer(wanted, document, vec![PathBuf::from(text.trim())]);
            }
        }
    }
}
