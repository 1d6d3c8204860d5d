//! The menu, the messages and the dialogs.

use egui::{RichText, Ui};
use trimloop_render::{Direction, Lod};

use crate::display::{self, Mode};
use crate::export::ExportOptions;
use crate::navigation::{Style, TwoFingers};
use crate::panels::Tab;

use super::ask::Wanted;
use super::{App, Load, SIDES};

/// How long it is told what went well.
const NOTE_LASTS: std::time::Duration = std::time::Duration::from_secs(6);
/// Letters of a name in a tab.
const MOST_LETTERS: usize = 28;
/// The height of messages, points.
const MOST_NOTICES: f32 = 120.0;

impl App {
    pub(super) fn menu(&mut self, ui: &mut Ui) {
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
                    self.fit();
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
                    self.fit();
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
                let mut theme = ui.ctx().options(|options| options.theme_preference);
                let before = theme;
                for (own, name) in [
                    (egui::ThemePreference::System, "Colours of the system"),
                    (egui::ThemePreference::Light, "Light"),
                    (egui::ThemePreference::Dark, "Dark"),
                ] {
                    ui.radio_value(&mut theme, own, name);
                }
                if theme != before {
                    ui.ctx().set_theme(theme);
                }
                ui.label(RichText::new(format!("drawn by {}", self.gpu.name())).weak());
            });
            ui.separator();
            let mut closed = None;
            egui::ScrollArea::horizontal().id_salt("files").show(ui, |ui| {
                for (index, document) in self.documents.iter().enumerate() {
                    let name = shortened(&document.name());
                    let tab = ui
                        .selectable_label(index == self.active, name)
                        .on_hover_text(format!("{} (middle click closes)", document.path.display()));
                    if index == self.active && self.told_active != self.shown {
                        tab.scroll_to_me(None);
                    }
                    if tab.clicked() && index != self.active {
                        closed = Some((index, false));
                    }
                    if tab.middle_clicked() {
                        closed = Some((index, true));
                    }
                }
            });
            self.told_active = self.shown;
            match closed {
                Some((index, true)) => self.close(index),
                Some((index, false)) => self.activate(index),
                None => {}
            }
        });
    }

    pub(super) fn file_menu(&mut self, ui: &mut Ui) {
        if ui.button("Open…  (Ctrl+O)").clicked() {
            ui.close();
            self.ask(Wanted::Open);
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
            self.ask(Wanted::Picture);
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
            self.ask(Wanted::Reference);
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
    pub(super) fn notices(&mut self, ui: &Ui) {
        if let Some(noted) = self.noted {
            // What went well needs not be told for ever.
            match NOTE_LASTS.checked_sub(noted.elapsed()) {
                Some(rest) => ui.ctx().request_repaint_after(rest),
                None => {
                    self.notes.clear();
                    self.noted = None;
                }
            }
        }
        if !self.has_notices() {
            return;
        }
        // Over the picture: nothing moves when messages come and go.
        let place = ui.max_rect().left_bottom() + egui::vec2(10.0, -10.0);
        let area = egui::Area::new(egui::Id::unique("notices")).pivot(egui::Align2::LEFT_BOTTOM);
        area.fixed_pos(place).show(ui.ctx(), |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(640.0);
                self.notices_within(ui);
            });
        });
    }

    fn notices_within(&mut self, ui: &mut Ui) {
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
    pub(super) fn told(&mut self, ui: &mut Ui) {
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

    pub(super) fn has_notices(&self) -> bool {
        !self.loading.is_empty()
            || !self.messages.is_empty()
            || !self.notes.is_empty()
            || self.exporting.is_some()
            || self.comparing.is_some()
    }

    pub(super) fn export_dialog(&mut self, context: &egui::Context) {
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
            self.ask(Wanted::Export);
        }
    }
}

/// The beginning and the end of a long name.
fn shortened(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= MOST_LETTERS {
        return name.to_owned();
    }
    let half = MOST_LETTERS / 2;
    let (first, last) = (&letters[..half], &letters[letters.len() - half + 1..]);
    first.iter().chain(&['…']).chain(last).collect()
}
