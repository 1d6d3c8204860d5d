//! The window.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use egui::{Key, KeyboardShortcut, Modifiers, RichText, Ui};
use egui_wgpu::RenderState;
use glam::DVec3;
use trimloop_geom::Aabb;
use trimloop_gpu::Gpu;
use trimloop_measure::Feature;
use trimloop_render::{Direction, Lod, Look};

use crate::deviation::{self, Deviation, Distances};
use crate::display::{self, Display, Mode};
use crate::document::{Document, Picked};
use crate::export::{ExportOptions, Exporting};
use crate::job::{Job, Polled};
use crate::loader::{Arrival, Loading, ReadyPart};
use crate::measure::Subject;
use crate::navigation::{Navigation, Style, TwoFingers};
use crate::panels::{self, DisplayAction, Tab};
use crate::resume::{Resume, State};
use crate::section::{self, Cuts};
use crate::settings::{self, Settings};
use crate::tree::{Tree, TreeAction};
use crate::viewport::{Controls, Shown, Viewport};
use crate::watch::Watch;
use crate::{ViewError, ViewOptions};

/// The viewer's window and all that is open in it.
pub struct App {
    gpu: Gpu,
    state: RenderState,
    context: egui::Context,
    documents: Vec<Document>,
    /// Counts documents.
    next_id: u64,
    active: usize,
    loading: Vec<Load>,
    viewport: Viewport,
    view: Navigation,
    /// The view as it was fitted while parts were still to come.
    fitted: Option<Navigation>,
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
    /// What went well.
    notes: Vec<String>,
    is_help_open: bool,
    is_export_open: bool,
    exporting: Option<Exporting>,
    /// A document's distances from a reference, on their way.
    comparing: Option<(u64, Job<Result<Distances, String>>)>,
    /// What the first file is to be held against, once it is there.
    reference: Option<PathBuf>,
    /// For tests: the device is to be destroyed.
    loses_device: bool,
    watch: Watch,
    shared: Arc<Mutex<State>>,
    /// The shape of the picture, as it was last.
    aspect: f64,
    is_fitted: bool,
    /// The view is that of a window that is gone: nothing is fitted until somebody opens another file.
    is_resumed: bool,
}

/// A file being read.
struct Load {
    loading: Loading,
    /// What arrived of a file that replaces another, which stays until all of it is there.
    held: Option<(Arc<trimloop_brep::Model>, Vec<ReadyPart>)>,
}

/// Keys and what they do, as the help lists them.
const KEYS: [(&str, &str); 21] = [
    ("Ctrl+O", "open files"),
    ("F", "fit everything"),
    ("Space", "fit the selection"),
    ("1 – 6", "front, back, left, right, top, bottom"),
    ("0", "isometric"),
    ("P", "perspective or parallel"),
    ("E", "shaded, with hidden edges, edges alone, transparent"),
    ("H", "hide what is selected"),
    ("I", "isolate what is selected"),
    ("A", "show all"),
    ("X", "section"),
    ("Shift+X", "flip the section"),
    ("M", "keep the measure of what is selected"),
    ("Shift+click", "select one more; two are measured"),
    ("Double click", "turn around this place"),
    ("Esc", "select nothing"),
    ("Ctrl+Z, Ctrl+Y", "undo and redo a change of the view"),
    ("F5", "read the file again"),
    ("Ctrl+S, Ctrl+C", "save or copy a picture"),
    ("Ctrl+E", "export to glTF"),
    ("Ctrl+W", "close the file"),
];
/// The height of messages, points.
const MOST_NOTICES: f32 = 120.0;
/// Views that can be returned to.
const MOST_PAST: usize = 100;
/// Files that can be opened, by the ends of their names.
const CAD: [&str; 7] = ["step", "stp", "stpz", "igs", "iges", "tspline", "gz"];
const MESHES: [&str; 7] = ["stl", "obj", "ply", "gltf", "glb", "3mf", "step"];

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
            active: 0,
            loading: Vec::new(),
            viewport: Viewport::default(),
            view,
            fitted: None,
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
            is_help_open: false,
            is_export_open: false,
            exporting: None,
            comparing: None,
            reference: options.reference,
            loses_device: options.loses_device,
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
        options.files.into_iter().for_each(|file| app.open(file));
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
        self.start(path, false);
    }

    fn start(&mut self, path: PathBuf, is_reload: bool) {
        let context = self.context.clone();
        let loading = Loading::start(path, is_reload, move || context.request_repaint());
        self.loading.push(Load { loading, held: None });
    }

    /// Takes over what has been read, and reads again what changed.
    fn receive(&mut self) {
        let mut still = Vec::new();
        for mut load in std::mem::take(&mut self.loading) {
            if load.loading.is_cancelled() {
                self.documents.retain(|own| Some(own.id) != load.loading.document);
                self.active = self.active.min(self.documents.len().saturating_sub(1));
                continue;
            }
            if self.receive_of(&mut load) {
                still.push(load);
            }
        }
        still.append(&mut self.loading);
        self.loading = still;
        let paths: Vec<PathBuf> = self.documents.iter().map(|d| d.path.clone()).collect();
        let (changed, is_pending) = self.watch.changed(&paths);
        for path in changed {
            if !self.loading.iter().any(|own| own.loading.path == path) {
                self.start(path, true);
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
    }

    /// Takes over what has arrived of a file; whether more is to come.
    fn receive_of(&mut self, load: &mut Load) -> bool {
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
        self.messages.push(format!("{}: {reason}", load.loading.path.display()));
        self.documents.retain(|own| Some(own.id) != load.loading.document);
        self.active = self.active.min(self.documents.len().saturating_sub(1));
    }

    /// A file's model is there: its tree can be shown, its parts are to come.
    fn begin(
        &mut self,
        load: &mut Load,
        model: Arc<trimloop_brep::Model>,
    ) -> Result<(), trimloop_render::RenderError> {
        let path = load.loading.path.clone();
        let document = Document::new(&self.gpu, self.next_id, path.clone(), model)?;
        load.loading.document = Some(self.next_id);
        self.next_id += 1;
        self.watch.add(&path);
        self.settings.remember(&path);
        self.documents.push(document);
        self.activate(self.documents.len() - 1);
        Ok(())
    }

    /// All of a file is there.
    fn end(
        &mut self,
        load: &Load,
        held: Option<(Arc<trimloop_brep::Model>, Vec<ReadyPart>)>,
        seconds: f64,
    ) -> Result<(), trimloop_render::RenderError> {
        let Some((model, parts)) = held else {
            let wanted = load.loading.document;
            if let Some(place) = self.documents.iter().position(|own| Some(own.id) == wanted) {
                self.documents[place].finish(seconds);
                if let Some(reference) = self.reference.take() {
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
        // What was hidden stays hidden, where it can be told.
        let before = &self.documents[place];
        let hidden: std::collections::HashSet<&str> = before
            .renderer
            .scene()
            .instances
            .iter()
            .filter(|i| !i.is_shown)
            .filter_map(|i| Some(before.model.nodes[i.node?].name.as_str()))
            .collect();
        for node in 0..document.model.nodes.len() {
            let own = &document.model.nodes[node];
            if own.part.is_some() && !own.name.is_empty() && hidden.contains(own.name.as_str()) {
                document.show(node, false);
            }
        }
        document.explode(before.explosion());
        self.documents[place] = document;
        self.tree.reset();
        Ok(())
    }

    fn activate(&mut self, index: usize) {
        self.active = index;
        self.is_fitted = std::mem::take(&mut self.is_resumed);
        self.fitted = None;
        self.tree.reset();
        self.cuts = Cuts::new();
    }

    fn close(&mut self, index: usize) {
        if index < self.documents.len() {
            self.documents.remove(index);
            self.activate(self.active.min(self.documents.len().saturating_sub(1)));
        }
    }

    /// Remembers the present view before it changes.
    fn remember(&mut self, view: Navigation) {
        self.past.push(view);
        self.future.clear();
        if self.past.len() > MOST_PAST {
            self.past.remove(0);
        }
    }

    fn look_from(&mut self, direction: Direction) {
        self.remember(self.view);
        self.view.direction = direction;
    }

    fn fit(&mut self, nodes: Option<&[usize]>) {
        let Some(document) = self.documents.get(self.active) else { return };
        let points: Vec<DVec3> = match nodes {
            Some(nodes) => nodes
                .iter()
                .flat_map(|node| document.outline(Some(document.instances_below(*node))))
                .collect(),
            None => document.outline(None),
        };
        let before = self.view;
        self.view.fit(&points, self.aspect);
        if before != self.view {
            self.remember(before);
        }
    }

    fn act(&mut self, action: TreeAction) {
        let Some(document) = self.documents.get_mut(self.active) else { return };
        match action {
            TreeAction::Show(node, is_shown) => document.show(node, is_shown),
            TreeAction::Isolate(node) => document.isolate(&[node]),
            TreeAction::Select(node, is_added) => document.select_node(node, is_added),
            TreeAction::Fit(node) => {
                document.select_node(node, false);
                self.fit(Some(&[node]));
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

    fn keys(&mut self, ui: &Ui) {
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let hit = |modifiers: Modifiers, key: Key| {
            ui.ctx().input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))
        };
        let plain = |key: Key| hit(Modifiers::NONE, key);
        if hit(Modifiers::COMMAND, Key::O) {
            self.choose_files();
        }
        if hit(Modifiers::COMMAND, Key::S) {
            self.save_picture();
        }
        // Windows make an event of their own of this key.
        if ui.input(|input| input.events.iter().any(|event| matches!(event, egui::Event::Copy))) {
            self.copy_picture();
        }
        if hit(Modifiers::COMMAND, Key::E) {
            self.is_export_open ^= true;
        }
        if hit(Modifiers::COMMAND, Key::W) {
            self.close(self.active);
        }
        if hit(Modifiers::COMMAND, Key::Z)
            && let Some(view) = self.past.pop()
        {
            self.future.push(self.view);
            self.view = view;
        }
        if hit(Modifiers::COMMAND, Key::Y)
            && let Some(view) = self.future.pop()
        {
            self.past.push(self.view);
            self.view = view;
        }
        for (name, key) in SIDES {
            if plain(key)
                && let Some(direction) = Direction::named(name)
            {
                self.look_from(direction);
            }
        }
        if plain(Key::F) {
            self.fit(None);
        }
        if plain(Key::P) {
            self.remember(self.view);
            self.view.is_parallel ^= true;
        }
        if plain(Key::E) {
            self.display.mode = self.display.mode.next();
        }
        let bounds = self.bounds();
        if hit(Modifiers::SHIFT, Key::X) && !bounds.is_empty() {
            self.cuts.active_mut().flip(bounds);
        }
        if plain(Key::X) {
            self.cuts.active_mut().is_on ^= true;
            self.tab = Tab::Section;
        }
        if plain(Key::F1)
            || ui.input(|input| input.events.iter().any(|e| *e == egui::Event::Text("?".into())))
        {
            self.is_help_open ^= true;
        }
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let nodes = document.selected_nodes();
        if plain(Key::A) {
            document.isolate(&[]);
        }
        if plain(Key::H) {
            nodes.iter().for_each(|node| document.show(*node, false));
        }
        if plain(Key::I) && !nodes.is_empty() {
            document.isolate(&nodes);
        }
        if plain(Key::M) {
            document.measure.keep();
        }
        if plain(Key::Escape) {
            document.select(None, false);
        }
        if plain(Key::F5) {
            let path = document.path.clone();
            self.start(path, true);
        }
        if plain(Key::Space) && !nodes.is_empty() {
            self.fit(Some(&nodes));
        }
    }

    fn choose_files(&mut self) {
        let dialog =
            rfd::FileDialog::new().set_title("Open").add_filter("CAD", &CAD).add_filter("Everything", &["*"]);
        for file in dialog.pick_files().unwrap_or_default() {
            self.open(file);
        }
    }

    fn choose_reference(&mut self) {
        let dialog = rfd::FileDialog::new()
            .set_title("Compare with")
            .add_filter("Meshes and CAD", &MESHES)
            .add_filter("Everything", &["*"]);
        if let Some(path) = dialog.pick_file() {
            self.compare_with(path);
        }
    }

    /// Begins to measure how far the file that is shown is from a reference.
    pub fn compare_with(&mut self, reference: PathBuf) {
        self.compare_with_of(self.active, reference);
    }

    fn compare_with_of(&mut self, index: usize, reference: PathBuf) {
        let Some(document) = self.documents.get(index) else { return };
        let model = document.model.clone();
        let work = move || {
            deviation::measure(&model, &reference)
                .map_err(|reason| format!("cannot compare with {}: {reason}", reference.display()))
        };
        self.comparing = Some((document.id, Job::start(&self.context, work)));
    }

    fn receive_comparison(&mut self) {
        let Some((id, job)) = &self.comparing else { return };
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
            Err(reason) => self.messages.push(reason),
        }
    }

    fn choose_export(&mut self) {
        let Some(document) = self.documents.get(self.active) else { return };
        let name = document.path.with_extension("glb");
        let dialog = rfd::FileDialog::new()
            .set_title("Export")
            .add_filter("glTF", &["glb"])
            .set_file_name(name.file_name().unwrap_or_default().to_string_lossy());
        if let Some(path) = dialog.save_file() {
            self.export_to(path);
        }
    }

    /// Begins to write what is shown to a glTF file.
    pub fn export_to(&mut self, path: PathBuf) {
        let Some(document) = self.documents.get(self.active) else { return };
        let options = self.settings.export.clone();
        let is_shown: Vec<bool> = (0..document.model.nodes.len())
            .map(|node| !options.is_shown_only || document.is_shown(node))
            .collect();
        let exporting = Exporting::start(&self.context, &document.model, is_shown, options, path);
        self.exporting = Some(exporting);
        self.is_export_open = false;
    }

    fn receive_export(&mut self) {
        let Some(exporting) = &self.exporting else { return };
        match exporting.job.poll() {
            Polled::Waiting => return,
            Polled::Done(Ok(note)) => self.notes.push(note),
            Polled::Done(Err(_)) if exporting.is_cancelled() => {}
            Polled::Done(Err(reason)) => self.messages.push(reason),
            Polled::Failed => self.messages.push("the export failed; please report it".to_owned()),
        }
        self.exporting = None;
    }

    fn save_picture(&mut self) {
        let Some(document) = self.documents.get(self.active) else { return };
        let name = document.path.with_extension("png");
        let dialog = rfd::FileDialog::new()
            .set_title("Save a picture")
            .add_filter("PNG", &["png"])
            .set_file_name(name.file_name().unwrap_or_default().to_string_lossy());
        if let Some(path) = dialog.save_file() {
            self.picture_to(&path, [1920, 1440]);
        }
    }

    fn picture(&mut self, size: [u32; 2]) -> Result<trimloop_render::Picture, String> {
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
        let written = made.and_then(|png| std::fs::write(path, png).map_err(|e| e.to_string()));
        match written {
            Ok(()) => self.notes.push(format!("wrote {}", path.display())),
            Err(error) => self.messages.push(format!("cannot save {}: {error}", path.display())),
        }
    }

    fn copy_picture(&mut self) {
        if self.documents.is_empty() {
            return;
        }
        let height = 1080;
        match self.picture([(f64::from(height) * self.aspect).round().clamp(1.0, 4096.0) as u32, height]) {
            Ok(picture) => {
                let size = [picture.width as usize, picture.height as usize];
                self.context.copy_image(egui::ColorImage::from_rgba_unmultiplied(size, &picture.rgba));
                self.notes.push("the picture is in the clipboard".to_owned());
            }
            Err(error) => self.messages.push(error),
        }
    }

    fn menu(&mut self, ui: &mut Ui) {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| self.file_menu(ui));
            ui.menu_button("View", |ui| {
                for (name, _) in SIDES {
                    if ui.button(name).clicked()
                        && let Some(direction) = Direction::named(name)
                    {
                        self.look_from(direction);
                    }
                }
                ui.separator();
                if ui.button("Fit  (F)").clicked() {
                    self.fit(None);
                }
                ui.checkbox(&mut self.view.is_parallel, "Parallel  (P)");
                ui.checkbox(&mut self.settings.has_cube, "View cube");
                ui.separator();
                let mut up = self.look.up;
                for (axis, name) in [(trimloop_render::Up::Z, "Z up"), (trimloop_render::Up::Y, "Y up")] {
                    ui.radio_value(&mut up, axis, name);
                }
                if up != self.look.up {
                    (self.look.up, self.view.up) = (up, up);
                    self.fit(None);
                }
            });
            ui.menu_button("Display", |ui| {
                for (mode, name) in Mode::ALL {
                    ui.radio_value(&mut self.display.mode, mode, name);
                }
                ui.separator();
                ui.label("Colours");
                for (colors, name) in display::Colors::ALL {
                    if ui.radio_value(&mut self.display.colors, colors, name).clicked() {
                        self.tab = Tab::Display;
                    }
                }
                ui.separator();
                ui.label("Levels of detail");
                for lod in Lod::ALL {
                    ui.radio_value(&mut self.look.lod, lod, lod.name());
                }
                ui.separator();
                ui.checkbox(&mut self.settings.are_statistics_shown, "Statistics");
            });
            ui.menu_button("Mouse", |ui| {
                for style in Style::ALL {
                    ui.radio_value(&mut self.settings.style, style, style.name()).on_hover_text(style.hint());
                }
                ui.separator();
                ui.label("Two fingers on a touchpad");
                for (own, name) in TwoFingers::ALL {
                    ui.radio_value(&mut self.settings.two_fingers, own, name);
                }
            });
            ui.menu_button("Help", |ui| {
                if ui.button("Keys  (?)").clicked() {
                    ui.close();
                    self.is_help_open = true;
                }
                egui::widgets::global_theme_preference_buttons(ui);
                ui.label(RichText::new(format!("drawn by {}", self.gpu.name())).weak());
            });
            ui.separator();
            let mut closed = None;
            for (index, document) in self.documents.iter().enumerate() {
                let tab = ui
                    .selectable_label(index == self.active, document.name())
                    .on_hover_text(document.path.display().to_string());
                if tab.clicked() && index != self.active {
                    closed = Some((index, false));
                }
                if tab.middle_clicked() {
                    closed = Some((index, true));
                }
            }
            match closed {
                Some((index, true)) => self.close(index),
                Some((index, false)) => self.activate(index),
                None => {}
            }
        });
    }

    fn file_menu(&mut self, ui: &mut Ui) {
        if ui.button("Open…  (Ctrl+O)").clicked() {
            ui.close();
            self.choose_files();
        }
        let mut chosen = None;
        ui.menu_button("Open recent", |ui| {
            if self.settings.recent.is_empty() {
                ui.label(RichText::new("nothing yet").weak());
            }
            for path in &self.settings.recent {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    chosen = Some(path.clone());
                    ui.close();
                }
            }
        });
        if let Some(path) = chosen {
            self.open(path);
        }
        ui.separator();
        let has_file = !self.documents.is_empty();
        if ui.add_enabled(has_file, egui::Button::new("Save a picture…  (Ctrl+S)")).clicked() {
            ui.close();
            self.save_picture();
        }
        if ui.add_enabled(has_file, egui::Button::new("Copy the picture  (Ctrl+C)")).clicked() {
            ui.close();
            self.copy_picture();
        }
        if ui.add_enabled(has_file, egui::Button::new("Export to glTF…  (Ctrl+E)")).clicked() {
            ui.close();
            self.is_export_open = true;
        }
        if ui.add_enabled(has_file, egui::Button::new("Compare with a reference…")).clicked() {
            ui.close();
            self.choose_reference();
        }
        ui.separator();
        if ui.add_enabled(has_file, egui::Button::new("Close  (Ctrl+W)")).clicked() {
            ui.close();
            self.close(self.active);
        }
        if ui.button("Quit").clicked() {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }

    /// What is being done, and what came of it.
    fn notices(&mut self, ui: &mut Ui) {
        for Load { loading, .. } in &self.loading {
            ui.horizontal(|ui| {
                let name = loading.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                match loading.share() {
                    Some(share) => {
                        ui.add(egui::ProgressBar::new(share).desired_width(220.0).text(name));
                    }
                    None => {
                        ui.spinner();
                        ui.label(format!("reading {name}"));
                    }
                }
                if ui.small_button("Cancel").clicked() {
                    loading.cancel();
                }
            });
        }
        if let Some(exporting) = &self.exporting {
            ui.horizontal(|ui| {
                let name = exporting.path.file_name().unwrap_or_default().to_string_lossy();
                let text = format!("writing {name}");
                ui.add(egui::ProgressBar::new(exporting.share()).desired_width(220.0).text(text));
                if ui.small_button("Cancel").clicked() {
                    exporting.cancel();
                }
            });
        }
        let mut is_stopped = false;
        if self.comparing.is_some() {
            ui.horizontal(|ui| {
                ui.spinner();
                ui.label("comparing with the reference");
                is_stopped = ui.small_button("Cancel").clicked();
            });
        }
        if is_stopped {
            self.comparing = None;
        }
        let area = egui::ScrollArea::vertical().id_salt("notices").max_height(MOST_NOTICES);
        area.show(ui, |ui| self.told(ui));
    }

    /// What went wrong, and what went well.
    fn told(&mut self, ui: &mut Ui) {
        let error = ui.visuals().error_fg_color;
        let usual = ui.visuals().text_color();
        for (list, color) in [(&mut self.messages, error), (&mut self.notes, usual)] {
            let mut closed = None;
            for (index, message) in list.iter().enumerate() {
                ui.horizontal(|ui| {
                    if ui.small_button("×").clicked() {
                        closed = Some(index);
                    }
                    ui.add(egui::Label::new(RichText::new(message).color(color)).wrap());
                });
            }
            if let Some(index) = closed {
                list.remove(index);
            }
        }
    }

    fn has_notices(&self) -> bool {
        !self.loading.is_empty()
            || !self.messages.is_empty()
            || !self.notes.is_empty()
            || self.exporting.is_some()
            || self.comparing.is_some()
    }

    fn side(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        let search = egui::TextEdit::singleline(&mut self.tree.search).hint_text("search");
        ui.add(search.desired_width(f32::INFINITY));
        let bounds = self.bounds();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let mut chosen = None;
        let mut asked = None;
        // Not of what is left: messages come and go.
        let height = ui.ctx().content_rect().height();
        egui::Panel::bottom("details").resizable(true).default_size(0.42 * height).show(ui, |ui| {
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
                    let area = egui::ScrollArea::vertical().id_salt("details").auto_shrink([false, false]);
                    area.show(ui, |ui| match tab {
                        Tab::Section => panels::section(ui, &mut self.cuts, bounds, document),
                        Tab::Display => {
                            asked = panels::display(ui, &mut self.display, bounds.diagonal(), document);
                        }
                        _ => panels::selection(ui, document, &mut self.settings.filter),
                    });
                }
            }
        });
        if let Some(chosen) = chosen {
            document.select(Some(chosen), false);
            let nodes = document.selected_nodes();
            self.fit(Some(&nodes));
        }
        let Some(document) = self.documents.get_mut(self.active) else { return };
        for action in self.tree.show(ui, document) {
            self.act(action);
        }
        if let Some(DisplayAction::ChooseReference) = asked {
            self.choose_reference();
        }
    }

    fn help(&mut self, context: &egui::Context) {
        egui::Window::new("Keys").open(&mut self.is_help_open).resizable(false).show(context, |ui| {
            egui::Grid::new("keys").num_columns(2).spacing([20.0, 4.0]).show(ui, |ui| {
                for (keys, what) in KEYS {
                    ui.monospace(keys);
                    ui.label(what);
                    ui.end_row();
                }
                ui.monospace("?");
                ui.label("this list");
                ui.end_row();
            });
            ui.separator();
            let style = self.settings.style;
            ui.label(format!("Mouse ({}): {}", style.name(), style.hint()));
        });
    }

    fn export_dialog(&mut self, context: &egui::Context) {
        let mut is_open = self.is_export_open && !self.documents.is_empty();
        let mut is_chosen = false;
        let options = &mut self.settings.export;
        egui::Window::new("Export to glTF").open(&mut is_open).resizable(false).show(context, |ui| {
            ui.horizontal(|ui| {
                ui.label("deflection");
                if options.is_relative {
                    let percent = egui::DragValue::new(&mut options.relative_percent);
                    ui.add(percent.speed(0.005).range(1e-4..=10.0).suffix(" % of a part").max_decimals(4));
                } else {
                    let mm = egui::DragValue::new(&mut options.absolute_mm);
                    ui.add(mm.speed(0.005).range(1e-6..=1e4).suffix(" mm").max_decimals(6));
                }
                ui.checkbox(&mut options.is_relative, "relative");
            });
            ui.horizontal(|ui| {
                ui.label("angle");
                let angle = egui::DragValue::new(&mut options.angle_deg);
                ui.add(angle.speed(0.1).range(1.0..=90.0).suffix("°").max_decimals(1));
            });
            ui.checkbox(&mut options.is_shown_only, "only what is shown");
            ui.checkbox(&mut options.is_z_up, "Z up, instead of Y as glTF asks");
            ui.checkbox(&mut options.edges, "edges as lines");
            ui.checkbox(&mut options.face_ids, "entities of faces");
            ui.checkbox(&mut options.quantize, "quantized (KHR_mesh_quantization)");
            ui.checkbox(&mut options.meshopt, "compressed (EXT_meshopt_compression)");
            ui.horizontal(|ui| {
                is_chosen = ui.button("Write…").clicked();
                if ui.button("As converted by default").clicked() {
                    *options = ExportOptions::default();
                }
            });
        });
        self.is_export_open = is_open;
        if is_chosen {
            self.choose_export();
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
        dropped.into_iter().for_each(|file| self.open(file.path().to_path_buf()));
        self.keys(ui);
        egui::Panel::top("menu").show(ui, |ui| self.menu(ui));
        if self.has_notices() {
            egui::Panel::bottom("notices").show(ui, |ui| self.notices(ui));
        }
        egui::Panel::left("side").default_size(330.0).resizable(true).show(ui, |ui| self.side(ui));
        self.help(&ui.ctx().clone());
        self.export_dialog(&ui.ctx().clone());
        let frame = egui::Frame::NONE;
        egui::CentralPanel::default().frame(frame).show(ui, |ui| self.model(ui));
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
        if !self.is_fitted && !bounds.is_empty() {
            if let Some(document) = self.documents.get(self.active) {
                self.view.fit(&document.outline(None), self.aspect);
            }
            self.fitted = Some(self.view);
            self.is_fitted = true;
        }
        let look = self.look(bounds);
        let rect = ui.available_rect_before_wrap();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let is_deviation = self.display.colors == display::Colors::Deviation && document.deviation.is_some();
        if let Err(error) = section::update_caps(ui.ctx(), document, self.cuts.sections(bounds)) {
            self.messages.push(error.to_string());
        }
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
        if let Some(error) = outcome.error {
            let message = error.to_string();
            if !self.messages.contains(&message) && !self.gpu.is_lost() {
                self.messages.push(message);
            }
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

    /// One thing that is selected is measured, or two.
    fn want_measures(&mut self) {
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let subject = |picked: &Picked| -> Option<Subject> {
            let feature: Feature = picked.feature?;
            let part = document.renderer.scene().instances.get(picked.instance)?.part;
            Some(Subject { picked: *picked, part, transform: document.item(picked)?.transform, feature })
        };
        let subjects: Option<Vec<Subject>> = document.selection.iter().map(subject).collect();
        let subjects = subjects.filter(|subjects| subjects.len() <= 2).unwrap_or_default();
        let model = document.model.clone();
        document.measure.want(&self.context, &model, subjects);
    }
}
