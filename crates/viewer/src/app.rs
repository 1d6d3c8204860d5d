//! The window.

use std::path::{Path, PathBuf};

use egui::{Key, KeyboardShortcut, Modifiers, RichText, Ui};
use egui_wgpu::RenderState;
use glam::DVec3;
use trimloop_gpu::Gpu;
use trimloop_render::{Direction, EdgeStyle, Highlight, Lod, Look, Section};

use crate::document::Document;
use crate::loader::Loading;
use crate::navigation::{Navigation, Style};
use crate::panels::{self, TreeAction};
use crate::viewport::{Shown, Viewport};
use crate::watch::Watch;
use crate::{ViewError, ViewOptions};

/// The viewer's window and all that is open in it.
pub struct App {
    gpu: Gpu,
    state: RenderState,
    context: egui::Context,
    documents: Vec<Document>,
    active: usize,
    loading: Vec<Loading>,
    viewport: Viewport,
    view: Navigation,
    /// Views to return to.
    past: Vec<Navigation>,
    future: Vec<Navigation>,
    look: Look,
    style: Style,
    cut: Cut,
    search: String,
    /// What went wrong, for as long as nobody closes it.
    messages: Vec<String>,
    is_help_open: bool,
    are_statistics_shown: bool,
    watch: Watch,
    /// Counts what changes a picture without changing the view.
    revision: u64,
    is_fitted: bool,
}

/// A section plane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    is_on: bool,
    axis: usize,
    is_flipped: bool,
    /// Share of the model's extent along the axis.
    share: f64,
}

/// Keys and what they do, as the help lists them.
const KEYS: [(&str, &str); 16] = [
    ("Ctrl+O", "open files"),
    ("F", "fit everything"),
    ("Space", "fit the selection"),
    ("1 – 6", "front, back, left, right, top, bottom"),
    ("0", "isometric"),
    ("P", "perspective or parallel"),
    ("E", "edges: visible, hidden too, none"),
    ("H", "hide what is selected"),
    ("I", "isolate what is selected"),
    ("A", "show all"),
    ("X", "section"),
    ("Ctrl+Z, Ctrl+Y", "undo and redo a change of the view"),
    ("F5", "read the file again"),
    ("Ctrl+S", "save a picture"),
    ("Ctrl+W", "close the file"),
    ("?", "this list"),
];
/// Views that can be returned to.
const MOST_PAST: usize = 100;

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
    /// A window that begins to read the files of `options`.
    ///
    /// # Errors
    /// Where the window is drawn by something that the renderer cannot use.
    pub fn new(
        context: &egui::Context,
        state: Option<&RenderState>,
        options: ViewOptions,
    ) -> Result<Self, ViewError> {
        let state = state.ok_or_else(|| ViewError::Window("there is no graphics device".to_owned()))?.clone();
        let gpu = Gpu::of(state.device.clone(), state.queue.clone(), state.adapter.get_info());
        let wake = |context: &egui::Context| {
            let context = context.clone();
            move || context.request_repaint()
        };
        let mut app = Self {
            gpu,
            state,
            documents: Vec::new(),
            active: 0,
            loading: Vec::new(),
            viewport: Viewport::default(),
            view: Navigation::new(options.up),
            past: Vec::new(),
            future: Vec::new(),
            look: Look { up: options.up, ..Look::default() },
            style: Style::default(),
            cut: Cut { is_on: false, axis: 0, is_flipped: false, share: 0.5 },
            search: String::new(),
            messages: Vec::new(),
            is_help_open: false,
            are_statistics_shown: false,
            watch: Watch::new(wake(context)),
            revision: 0,
            is_fitted: false,
            context: context.clone(),
        };
        options.files.into_iter().for_each(|file| app.open(file));
        Ok(app)
    }

    /// Whether nothing is being read any more.
    pub fn is_idle(&self) -> bool {
        self.loading.is_empty()
    }

    /// Names of the open files.
    pub fn open_files(&self) -> Vec<String> {
        self.documents.iter().map(Document::name).collect()
    }

    /// What went wrong and nobody closed yet.
    pub fn messages(&self) -> &[String] {
        &self.messages
    }

    /// What is known of the selection: names and values.
    pub fn facts(&self) -> Vec<(String, String)> {
        self.documents.get(self.active).map(Document::facts).unwrap_or_default()
    }

    /// Begins to read a file.
    pub fn open(&mut self, path: PathBuf) {
        self.start(path, false);
    }

    fn start(&mut self, path: PathBuf, is_reload: bool) {
        let context = self.context.clone();
        self.loading.push(Loading::start(path, is_reload, move || context.request_repaint()));
    }

    /// Takes over what has been read, and reads again what changed.
    fn receive(&mut self) {
        let mut still = Vec::new();
        for loading in std::mem::take(&mut self.loading) {
            match loading.poll() {
                None => still.push(loading),
                Some(_) if loading.is_cancelled() => {}
                Some(Err(error)) => {
                    self.messages.push(format!("{}: {error}", loading.path.display()));
                }
                Some(Ok(loaded)) => {
                    let made = Document::new(&self.gpu, loading.path.clone(), loaded);
                    match made {
                        Ok(document) => self.take(document, loading.is_reload),
                        Err(error) => self.messages.push(format!("{}: {error}", loading.path.display())),
                    }
                }
            }
        }
        still.append(&mut self.loading);
        self.loading = still;
        let paths: Vec<PathBuf> = self.documents.iter().map(|d| d.path.clone()).collect();
        let (changed, is_pending) = self.watch.changed(&paths);
        for path in changed {
            if !self.loading.iter().any(|own| own.path == path) {
                self.start(path, true);
            }
        }
        if is_pending || !self.loading.is_empty() {
            self.context.request_repaint_after(std::time::Duration::from_millis(100));
        }
    }

    fn take(&mut self, document: Document, is_reload: bool) {
        self.watch.add(&document.path);
        let path = &document.path;
        match self.documents.iter().position(|own| is_reload && own.path == *path) {
            Some(place) => self.documents[place] = document,
            None => {
                self.documents.push(document);
                self.activate(self.documents.len() - 1);
            }
        }
        self.revision += 1;
        self.viewport.invalidate();
    }

    fn activate(&mut self, index: usize) {
        self.active = index;
        self.is_fitted = false;
        self.revision += 1;
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

    fn fit(&mut self, aspect: f64, only: Option<&[usize]>) {
        let Some(document) = self.documents.get(self.active) else { return };
        let scene = document.renderer.scene();
        let points = match only {
            Some(wanted) => scene.outline_of(|instance| wanted.contains(&instance)),
            None => scene.outline(),
        };
        let before = self.view;
        self.view.fit(&points, aspect);
        if before != self.view {
            self.remember(before);
        }
    }

    fn selected_node(&self) -> Option<usize> {
        let document = self.documents.get(self.active)?;
        document.renderer.scene().instances.get(document.selection?.instance)?.node
    }

    fn act(&mut self, action: TreeAction, aspect: f64) {
        let Some(document) = self.documents.get_mut(self.active) else { return };
        match action {
            TreeAction::Show(node, is_shown) => document.show(node, is_shown),
            TreeAction::Isolate(node) => document.isolate(Some(node)),
            TreeAction::Select(node) => {
                let first = document.instances_below(node).first().copied();
                document.select(first.map(|instance| Highlight { instance, face: None }));
            }
            TreeAction::Fit(node) => {
                let wanted = document.instances_below(node);
                self.fit(aspect, Some(&wanted));
            }
        }
        self.revision += 1;
    }

    /// The section plane in the model's coordinates.
    fn section(&self) -> Option<Section> {
        let bounds = self.documents.get(self.active)?.renderer.scene().bounds();
        let Cut { is_on, axis, is_flipped, share } = self.cut;
        let normal = [DVec3::X, DVec3::Y, DVec3::Z][axis] * if is_flipped { -1.0 } else { 1.0 };
        let at = bounds.min.lerp(bounds.max, share);
        is_on.then(|| Section { normal, offset_mm: normal.dot(at) })
    }

    fn keys(&mut self, ui: &Ui, aspect: f64) {
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
            self.fit(aspect, None);
        }
        if plain(Key::Space)
            && let Some(node) = self.selected_node()
        {
            self.act(TreeAction::Fit(node), aspect);
        }
        if plain(Key::P) {
            self.remember(self.view);
            self.view.is_parallel ^= true;
        }
        if plain(Key::E) {
            self.look.edges = match self.look.edges {
                EdgeStyle::Visible => EdgeStyle::Hidden,
                EdgeStyle::Hidden => EdgeStyle::None,
                EdgeStyle::None => EdgeStyle::Visible,
            };
        }
        if plain(Key::X) {
            self.cut.is_on ^= true;
        }
        if plain(Key::A)
            && let Some(document) = self.documents.get_mut(self.active)
        {
            document.isolate(None);
            self.revision += 1;
        }
        let node = self.selected_node();
        if plain(Key::H)
            && let Some(node) = node
        {
            self.act(TreeAction::Show(node, false), aspect);
        }
        if plain(Key::I)
            && let Some(node) = node
        {
            self.act(TreeAction::Isolate(node), aspect);
        }
        if plain(Key::F5)
            && let Some(document) = self.documents.get(self.active)
        {
            self.start(document.path.clone(), true);
        }
        if plain(Key::Escape)
            && let Some(document) = self.documents.get_mut(self.active)
        {
            document.select(None);
        }
        if plain(Key::F1)
            || ui.input(|input| input.events.iter().any(|e| *e == egui::Event::Text("?".into())))
        {
            self.is_help_open ^= true;
        }
    }

    fn choose_files(&mut self) {
        let dialog = rfd::FileDialog::new()
            .set_title("Open")
            .add_filter("CAD", &["step", "stp", "stpz", "igs", "iges", "tspline", "gz"])
            .add_filter("Everything", &["*"]);
        for file in dialog.pick_files().unwrap_or_default() {
            self.open(file);
        }
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

    /// Draws what is shown into a PNG file of `size` pixels.
    pub fn picture_to(&mut self, path: &Path, size: [u32; 2]) {
        let look = Look { section: self.section(), samples: 16, ..self.look };
        let camera = self.view.camera();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let made = document.renderer.picture(&camera, size, &look).and_then(|picture| picture.to_png());
        let written = made
            .map_err(|e| e.to_string())
            .and_then(|png| std::fs::write(path, png).map_err(|e| e.to_string()));
        if let Err(error) = written {
            self.messages.push(format!("cannot save {}: {error}", path.display()));
        }
        self.viewport.invalidate();
    }

    fn menu(&mut self, ui: &mut Ui, aspect: f64) {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                if ui.button("Open…  (Ctrl+O)").clicked() {
                    ui.close();
                    self.choose_files();
                }
                if ui.button("Save a picture…  (Ctrl+S)").clicked() {
                    ui.close();
                    self.save_picture();
                }
                if ui.button("Close  (Ctrl+W)").clicked() {
                    ui.close();
                    self.close(self.active);
                }
                if ui.button("Quit").clicked() {
                    ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
                }
            });
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
                    self.fit(aspect, None);
                }
                ui.checkbox(&mut self.view.is_parallel, "Parallel  (P)");
            });
            ui.menu_button("Display", |ui| {
                for (style, name) in [
                    (EdgeStyle::Visible, "Edges"),
                    (EdgeStyle::Hidden, "Hidden edges too"),
                    (EdgeStyle::None, "No edges"),
                ] {
                    ui.radio_value(&mut self.look.edges, style, name);
                }
                ui.separator();
                ui.label("Levels of detail");
                for lod in Lod::ALL {
                    ui.radio_value(&mut self.look.lod, lod, lod.name());
                }
                ui.separator();
                ui.checkbox(&mut self.are_statistics_shown, "Statistics");
            });
            ui.menu_button("Mouse", |ui| {
                for style in Style::ALL {
                    ui.radio_value(&mut self.style, style, style.name()).on_hover_text(style.hint());
                }
            });
            ui.menu_button("Help", |ui| {
                if ui.button("Keys  (?)").clicked() {
                    ui.close();
                    self.is_help_open = true;
                }
                egui::widgets::global_theme_preference_buttons(ui);
            });
            ui.separator();
            let mut closed = None;
            for (index, name) in self.open_files().into_iter().enumerate() {
                let tab = ui.selectable_label(index == self.active, name);
                if tab.clicked() && index != self.active {
                    self.activate(index);
                }
                if tab.middle_clicked() {
                    closed = Some(index);
                }
            }
            if let Some(index) = closed {
                self.close(index);
            }
        });
    }

    /// What is being read, and what went wrong.
    fn notices(&mut self, ui: &mut Ui) {
        for loading in &self.loading {
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
        let mut closed = None;
        for (index, message) in self.messages.iter().enumerate() {
            ui.horizontal(|ui| {
                if ui.small_button("×").clicked() {
                    closed = Some(index);
                }
                let text = RichText::new(message).color(ui.visuals().error_fg_color);
                ui.add(egui::Label::new(text).wrap());
            });
        }
        if let Some(index) = closed {
            self.messages.remove(index);
        }
    }

    fn side(&mut self, ui: &mut Ui, aspect: f64) {
        ui.add_space(4.0);
        ui.add(egui::TextEdit::singleline(&mut self.search).hint_text("search").desired_width(f32::INFINITY));
        let Some(document) = self.documents.get(self.active) else { return };
        let cut = &mut self.cut;
        let chosen = egui::Panel::bottom("details")
            .resizable(false)
            .show(ui, |ui| {
                ui.add_space(4.0);
                ui.strong("Selection");
                panels::selection(ui, document);
                ui.separator();
                ui.strong("Section");
                ui.horizontal(|ui| {
                    ui.checkbox(&mut cut.is_on, "on  (X)");
                    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                        ui.radio_value(&mut cut.axis, axis, name);
                    }
                    ui.checkbox(&mut cut.is_flipped, "flip");
                });
                ui.spacing_mut().slider_width = ui.available_width() - 60.0;
                let slider = egui::Slider::new(&mut cut.share, 0.0..=1.0).show_value(false).text("place");
                ui.add_enabled(cut.is_on, slider);
                ui.separator();
                ui.strong("Report");
                panels::report(ui, document)
            })
            .inner;
        let action = egui::ScrollArea::both()
            .id_salt("tree")
            .auto_shrink([false, false])
            .show(ui, |ui| panels::tree(ui, document, &self.search))
            .inner;
        if let Some(action) = action {
            self.act(action, aspect);
        }
        if let (Some(chosen), Some(document)) = (chosen, self.documents.get_mut(self.active)) {
            document.select(Some(chosen));
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
            });
            ui.separator();
            ui.label(format!("Mouse ({}): {}", self.style.name(), self.style.hint()));
        });
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}

impl App {
    /// The whole window.
    pub fn show(&mut self, ui: &mut Ui) {
        self.receive();
        let dropped = ui.ctx().input(|input| input.raw.dropped_files.clone());
        dropped.into_iter().for_each(|file| self.open(file.path().to_path_buf()));
        let whole = ui.available_size();
        let aspect = f64::from((whole.x - 300.0).max(50.0) / (whole.y - 40.0).max(50.0));
        self.keys(ui, aspect);
        egui::Panel::top("menu").show(ui, |ui| self.menu(ui, aspect));
        if !self.loading.is_empty() || !self.messages.is_empty() {
            egui::Panel::bottom("notices").show(ui, |ui| self.notices(ui));
        }
        egui::Panel::left("side").default_size(300.0).resizable(true).show(ui, |ui| self.side(ui, aspect));
        self.help(&ui.ctx().clone());
        let frame = egui::Frame::NONE;
        egui::CentralPanel::default().frame(frame).show(ui, |ui| self.model(ui));
    }

    fn model(&mut self, ui: &mut Ui) {
        if self.documents.is_empty() {
            ui.centered_and_justified(|ui| {
                ui.label(RichText::new("Drop STEP or IGES files here, or press Ctrl+O").heading().weak());
            });
            return;
        }
        let size = ui.available_size();
        if !self.is_fitted {
            let aspect = f64::from(size.x / size.y.max(1.0));
            if let Some(document) = self.documents.get(self.active) {
                self.view.fit(&document.renderer.scene().outline(), aspect);
            }
            self.is_fitted = true;
        }
        let look = Look { section: self.section(), ..self.look };
        let rect = ui.available_rect_before_wrap();
        let Some(document) = self.documents.get_mut(self.active) else { return };
        let shown =
            Shown { document, view: &mut self.view, look: &look, style: self.style, revision: self.revision };
        let outcome = self.viewport.show(ui, &self.state, shown);
        if outcome.clicked {
            ui.ctx().request_repaint();
        }
        if let Some(view) = outcome.began {
            self.remember(view);
        }
        if let Some(error) = outcome.error {
            let message = error.to_string();
            if !self.messages.contains(&message) {
                self.messages.push(message);
            }
        }
        if self.are_statistics_shown
            && let Some(document) = self.documents.get(self.active)
        {
            let text = format!("{}\nread in {:.2} s", document.renderer.statistics(), document.seconds);
            let at = rect.left_bottom() + egui::vec2(8.0, -8.0);
            let font = egui::FontId::monospace(11.0);
            ui.painter().text(at, egui::Align2::LEFT_BOTTOM, text, font, egui::Color32::from_gray(60));
        }
    }
}
