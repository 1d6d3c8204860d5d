//! The window.

mod ask;
mod files;
mod keys;
mod menu;
mod receive;
mod sight;

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use egui::{Key, RichText, Ui};
use egui_wgpu::RenderState;
use glam::DVec3;
use trimloop_geom::Aabb;
use trimloop_gpu::Gpu;
use trimloop_render::{Lod, Look};

use crate::deviation::Distances;
use crate::display::{self, Display};
use crate::document::Document;
use crate::export::Exporting;
use crate::job::Job;
use crate::loader::{Loading, ReadyPart};
use crate::navigation::Navigation;
use crate::panels::{self, DisplayAction, Tab};
use crate::resume::{Resume, State};
use crate::section::{self, Cuts};
use crate::settings::{self, Settings};
use crate::tree::{Tree, TreeAction};
use crate::viewport::{Controls, Shown, Viewport};
use crate::watch::Watch;
use crate::{ViewError, ViewOptions};

use ask::{Asking, Typing, Wanted};

pub(crate) use sight::Sight;

/// The viewer's window and all that is open in it.
pub struct App {
    gpu: Gpu,
    state: RenderState,
    context: egui::Context,
    documents: Vec<Document>,
    /// Counts documents.
    next_id: u64,
    next_order: u64,
    active: usize,
    /// The document that view and sections are of.
    shown: Option<u64>,
    /// The one whose tab has been brought into sight.
    told_active: Option<u64>,
    loading: Vec<Load>,
    /// Files that changed on disk while they were being read.
    changed: Vec<PathBuf>,
    viewport: Viewport,
    view: Navigation,
    /// The view as it was fitted while parts were still to come.
    fitted: Option<Navigation>,
    fitted_aspect: f64,
    /// Views to return to.
    past: Vec<Navigation>,
    future: Vec<Navigation>,
    look: Look,
    display: Display,
    cuts: Cuts,
    tree: Tree,
    tab: Tab,
    settings: Settings,
    /// What went wrong, for as long as nobody closes it.
    messages: Vec<String>,
    /// What went well, and when last.
    notes: Vec<String>,
    noted: Option<std::time::Instant>,
    is_help_open: bool,
    is_export_open: bool,
    exporting: Option<Exporting>,
    /// A document's distances from a reference, on their way.
    comparing: Option<Comparing>,
    /// A file, and what it is to be held against once it is there.
    reference: Option<(PathBuf, PathBuf)>,
    /// For tests: the device is to be destroyed.
    loses_device: bool,
    /// A path that somebody is being asked for.
    asking: Option<Asking>,
    typing: Option<Typing>,
    watch: Watch,
    shared: Arc<Mutex<State>>,
    /// The shape of the picture, as it was last.
    aspect: f64,
    is_fitted: bool,
    /// The view is that of a window that is gone: nothing is fitted until somebody opens another file.
    is_resumed: bool,
}

/// The document that is compared, with what, and what comes of it.
type Comparing = (u64, PathBuf, Job<Result<Distances, String>>);

/// A file being read.
struct Load {
    loading: Loading,
    /// What arrived of a file that replaces another, which stays until all of it is there.
    held: Option<(Arc<trimloop_brep::Model>, Vec<ReadyPart>)>,
    /// Whether it comes to the front as soon as there is something to see.
    is_front: bool,
    /// The number of its opening: tabs stand in that order, whichever file is read first.
    order: u64,
}

const SIDES: [(&str, Key); 7] = [
    ("front", Key::Num1),
    ("back", Key::Num2),
    ("left", Key::Num3),
    ("right", Key::Num4),
    ("top", Key::Num5),
    ("bottom", Key::Num6),
    ("iso", Key::Num0),
];

impl App {
    /// A window that begins to read the files of `options`, with the settings that `storage` kept.
    ///
    /// # Errors
    /// Where the window is drawn by something that the renderer cannot use.
    pub fn new(
        context: &egui::Context,
        state: Option<&RenderState>,
        storage: Option<&dyn eframe::Storage>,
        options: ViewOptions,
    ) -> Result<Self, ViewError> {
        let state = state.ok_or_else(|| ViewError::Window("there is no graphics device".to_owned()))?.clone();
        let gpu = Gpu::of(state.device.clone(), state.queue.clone(), state.adapter.get_info());
        let wake = {
            let context = context.clone();
            move || context.request_repaint()
        };
        let settings: Settings =
            storage.and_then(|kept| eframe::get_value(kept, settings::KEY)).unwrap_or_default();
        let lod = Lod::named(&settings.lod).unwrap_or_default();
        let view = Navigation { is_parallel: settings.is_parallel, ..Navigation::new(options.up) };
        let mut app = Self {
            gpu,
            state,
            documents: Vec::new(),
            next_id: 1,
            next_order: 1,
            active: 0,
            loading: Vec::new(),
            viewport: Viewport::default(),
            view,
            fitted: None,
            fitted_aspect: 1.0,
            past: Vec::new(),
            future: Vec::new(),
            look: Look { up: options.up, lod, ..Look::default() },
            display: Display::default(),
            cuts: Cuts::new(),
            tree: Tree::default(),
            tab: Tab::default(),
            settings,
            messages: Vec::new(),
            notes: Vec::new(),
            noted: None,
            shown: None,
            told_active: None,
            changed: Vec::new(),
            is_help_open: false,
            is_export_open: false,
            exporting: None,
            comparing: None,
            reference: options.files.first().cloned().zip(options.reference),
            loses_device: options.loses_device,
            asking: None,
            typing: None,
            watch: Watch::new(wake),
            shared: Arc::default(),
            aspect: 1.0,
            is_fitted: false,
            is_resumed: false,
            context: context.clone(),
        };
        if let Some(Resume { view, .. }) = options.resume {
            if let Some(view) = view {
                app.view = Navigation { up: options.up, ..view };
                app.is_resumed = true;
            }
            app.messages.push("the graphics device was lost; the files were opened again".to_owned());
        }
        app.open_all(options.files);
        Ok(app)
    }

    /// Keeps `state` up to date.
    pub(crate) fn share(&mut self, state: Arc<Mutex<State>>) {
        self.shared = state;
    }

    fn update_shared(&self) {
        let mut state = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        if state.gpu.is_none() {
            state.gpu = Some(self.gpu.clone());
        }
        state.view = self.is_fitted.then_some(self.view);
        // What is still being read is wanted as well.
        let loading =
            self.loading.iter().filter(|load| load.loading.document.is_none()).map(|l| &l.loading.path);
        let files = || self.documents.iter().map(|document| &document.path).chain(loading.clone());
        if !state.files.iter().eq(files()) {
            state.files = files().cloned().collect();
        }
    }

    /// Whether nothing is being read, measured, compared or written any more.
    pub fn is_idle(&self) -> bool {
        let is_busy = |document: &Document| document.measure.is_busy() || document.caps.is_busy();
        self.loading.is_empty()
            && self.exporting.is_none()
            && self.comparing.is_none()
            && !self.viewport.is_busy()
            && !self.documents.get(self.active).is_some_and(is_busy)
    }

    /// Names of the open files.
    pub fn open_files(&self) -> Vec<String> {
        self.documents.iter().map(Document::name).collect()
    }

    /// What went wrong and nobody closed yet.
    pub fn messages(&self) -> &[String] {
        &self.messages
    }

    /// What went well and nobody closed yet.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// What is known of the selection: names and values.
    pub fn facts(&self) -> Vec<(String, String)> {
        self.documents.get(self.active).map(Document::facts).unwrap_or_default()
    }

    /// Where a place of the model is drawn in the window.
    pub fn place_of(&self, point: DVec3) -> Option<egui::Pos2> {
        self.viewport.frame?.at(point)
    }

    /// Whether faces of the model have been drawn.
    pub fn has_picture(&self) -> bool {
        self.viewport.statistics.faces > 0
    }

    /// From where the model is seen.
    pub fn view(&self) -> Navigation {
        self.view
    }

    /// Begins to read a file.
    pub fn open(&mut self, path: PathBuf) {
        self.open_all(vec![path]);
    }

    /// Begins to read files, of which the first comes to the front; one that is open already comes to the front as it is.
    pub fn open_all(&mut self, paths: Vec<PathBuf>) {
        let full = |path: &PathBuf| std::fs::canonicalize(path).unwrap_or_else(|_| path.clone());
        for (k, path) in paths.into_iter().enumerate() {
            let own = full(&path);
            let place = self.documents.iter().position(|document| full(&document.path) == own);
            let is_read = self.loading.iter().any(|load| full(&load.loading.path) == own);
            match place {
                Some(place) => self.activate(place),
                None if is_read => {}
                None => self.start(path, false, k == 0),
            }
        }
    }

    /// Tells what went wrong, once.
    fn complain(&mut self, message: String) {
        if !self.messages.contains(&message) {
            self.messages.push(message);
        }
    }

    /// Tells what went well, for a while.
    fn note(&mut self, note: String) {
        self.notes.retain(|own| *own != note);
        self.notes.push(note);
        self.noted = Some(std::time::Instant::now());
    }

    fn act(&mut self, action: TreeAction) {
        let Some(document) = self.documents.get_mut(self.active) else { return };
        match action {
            TreeAction::Show(node, is_shown) => document.show(node, is_shown),
            TreeAction::Isolate(node) => document.isolate(&[node]),
            TreeAction::Select(node, is_added) => document.select_node(node, is_added),
            TreeAction::Fit(node) => {
                document.select_node(node, false);
                self.fit_selection();
            }
        }
    }

    /// The box of what is shown.
    fn bounds(&self) -> Aabb {
        self.documents.get(self.active).map_or(Aabb::EMPTY, Document::bounds)
    }

    /// The picture as it is to be drawn now.
    fn look(&self, bounds: Aabb) -> Look {
        let mut look = self.look;
        self.display.apply(&mut look, bounds.diagonal());
        let sections = self.cuts.sections(bounds);
        look.sections = sections.map(|own| own.map(|section| section.aside(bounds.diagonal())));
        look.edge_width_px *= self.context.pixels_per_point();
        look
    }

    fn side(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        let search = egui::TextEdit::singleline(&mut self.tree.search).hint_text("search");
        ui.add(search.desired_width(f32::INFINITY));
        let bounds = self.bounds();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let mut chosen = None;
        let mut asked = None;
        // Of the window: it is kept from one start to the next.
        let height = ui.ctx().content_rect().height();
        egui::Panel::bottom("details").resizable(true).min_size(140.0).default_size(0.42 * height).show(
            ui,
            |ui| {
                ui.add_space(4.0);
                let count = document.diagnostics.len();
                let report = if count > 0 { format!("Report ({count})") } else { "Report".to_owned() };
                ui.horizontal(|ui| {
                    for (tab, name) in [
                        (Tab::Selection, "Selection"),
                        (Tab::Section, "Section"),
                        (Tab::Display, "Appearance"),
                        (Tab::Report, report.as_str()),
                    ] {
                        ui.selectable_value(&mut self.tab, tab, name);
                    }
                });
                ui.separator();
                match self.tab {
                    Tab::Report => chosen = panels::report(ui, document),
                    tab => {
                        let area =
                            egui::ScrollArea::vertical().id_salt("details").auto_shrink([false, false]);
                        area.show(ui, |ui| match tab {
                            Tab::Section => panels::section(ui, &mut self.cuts, bounds, document),
                            Tab::Display => {
                                asked = panels::display(ui, &mut self.display, bounds.diagonal(), document);
                            }
                            _ => panels::selection(ui, document, &mut self.settings.filter),
                        });
                    }
                }
            },
        );
        if let Some(chosen) = chosen {
            document.reveal(&chosen);
            document.select(Some(chosen), false);
            self.fit_selection();
        }
        let Some(document) = self.documents.get_mut(self.active) else { return };
        for action in self.tree.show(ui, document) {
            self.act(action);
        }
        if let Some(DisplayAction::ChooseReference) = asked {
            self.ask(Wanted::Reference);
        }
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        self.settings.lod = self.look.lod.name().to_owned();
        self.settings.is_parallel = self.view.is_parallel;
        eframe::set_value(storage, settings::KEY, &self.settings);
    }
}

impl App {
    /// The whole window.
    pub fn show(&mut self, ui: &mut Ui) {
        if self.gpu.is_lost() {
            // Nothing can be drawn any more: another process goes on (see `run`).
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
            return;
        }
        self.receive();
        self.update_shared();
        if self.loses_device && self.is_idle() && self.is_fitted {
            // As a crash of its driver would.
            self.loses_device = false;
            self.gpu.device().destroy();
        }
        let dropped = ui.ctx().input(|input| input.raw.dropped_files.clone());
        if !dropped.is_empty() {
            self.open_all(dropped.iter().map(|file| file.path().to_path_buf()).collect());
        }
        self.keys(ui);
        egui::Panel::top("menu").show(ui, |ui| self.menu(ui));
        egui::Panel::left("side")
            .default_size(330.0)
            .min_size(220.0)
            .resizable(true)
            .show(ui, |ui| self.side(ui));
        self.help(&ui.ctx().clone());
        self.path_dialog(ui);
        self.export_dialog(&ui.ctx().clone());
        let frame = egui::Frame::NONE;
        egui::CentralPanel::default().frame(frame).show(ui, |ui| {
            self.model(ui);
            self.notices(ui);
        });
    }

    fn model(&mut self, ui: &mut Ui) {
        let size = ui.available_size();
        self.aspect = f64::from(size.x / size.y.max(1.0)).max(0.01);
        if self.documents.is_empty() {
            ui.centered_and_justified(|ui| {
                ui.label(RichText::new("Drop STEP or IGES files here, or press Ctrl+O").heading().weak());
            });
            return;
        }
        let bounds = self.bounds();
        // The room for it may change before anybody touched it.
        let is_other_room = self.fitted == Some(self.view) && self.fitted_aspect != self.aspect;
        if (!self.is_fitted || is_other_room) && !bounds.is_empty() {
            if let Some(document) = self.documents.get(self.active) {
                self.view.fit(&document.outline(None), self.aspect);
            }
            self.fitted = Some(self.view);
            self.fitted_aspect = self.aspect;
            self.is_fitted = true;
        }
        let look = self.look(bounds);
        let rect = ui.available_rect_before_wrap();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let is_deviation = self.display.colors == display::Colors::Deviation && document.deviation.is_some();
        let capped = section::update_caps(ui.ctx(), document, self.cuts.sections(bounds));
        if let Err(error) = capped {
            self.complain(error.to_string());
        }
        let Some(document) = self.documents.get_mut(self.active) else { return };
        document.arrange_deviation();
        let controls = Controls {
            style: self.settings.style,
            two_fingers: self.settings.two_fingers,
            filter: self.settings.filter,
            has_cube: self.settings.has_cube,
        };
        let shown = Shown {
            document,
            view: &mut self.view,
            cuts: &mut self.cuts,
            bounds,
            look: &look,
            is_deviation,
            controls,
        };
        let outcome = self.viewport.show(ui, &self.state, shown);
        if let Some(view) = outcome.began {
            self.remember(view);
        }
        if let Some(point) = outcome.centered {
            self.remember(self.view);
            self.view.target = point;
        }
        if let Some(error) = outcome.error.filter(|_| !self.gpu.is_lost()) {
            self.complain(error.to_string());
        }
        self.want_measures();
        let Some(document) = self.documents.get(self.active) else { return };
        display::legend(ui, rect, &self.display, document, bounds.diagonal());
        if self.settings.are_statistics_shown {
            let text = self.statistics();
            let at = rect.left_bottom() + egui::vec2(8.0, -8.0);
            let font = egui::FontId::monospace(11.0);
            ui.painter().text(at, egui::Align2::LEFT_BOTTOM, text, font, egui::Color32::from_gray(60));
        }
    }

    fn statistics(&mut self) -> String {
        let Some(document) = self.documents.get_mut(self.active) else { return String::new() };
        let mut frame = self.viewport.statistics;
        frame.passes_ms = document.renderer.passes_ms();
        let read = document.seconds.map_or("reading".to_owned(), |s| format!("read in {s:.2} s"));
        format!("{frame}\n{}, {read}", self.look.lod.name()).replace(", emit", "\nemit")
    }

    /// One face, edge or vertex that is selected is measured, or two, or whole parts.
    fn want_measures(&mut self) {
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let wanted = document.wanted_measure();
        let model = document.model.clone();
        document.measure.want(&self.context, &model, wanted);
    }
}
