//! What keys do.

use egui::text_selection::LabelSelectionState;
use egui::{Key, KeyboardShortcut, Modifiers, Ui};
use trimloop_render::Direction;

use crate::navigation::Navigation;
use crate::panels::Tab;

use super::ask::Wanted;
use super::{App, SIDES};

/// Keys and what they do, as the help lists them.
const KEYS: [(&str, &str); 21] = [
    ("Ctrl+O", "open files"),
    ("F", "fit everything"),
    ("Space", "look at the selection"),
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
    ("Ctrl+W, Ctrl+Tab", "close the file, go to the next one"),
];

impl App {
    pub(super) fn keys(&mut self, ui: &Ui) {
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let hit = |modifiers: Modifiers, key: Key| {
            ui.ctx().input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))
        };
        let plain = |key: Key| hit(Modifiers::NONE, key);
        if hit(Modifiers::COMMAND, Key::O) {
            self.ask(Wanted::Open);
        }
        if hit(Modifiers::COMMAND, Key::S) {
            self.ask(Wanted::Picture);
        }
        // Windows make an event of their own of this key.
        let is_copy = ui.input(|input| input.events.iter().any(|event| matches!(event, egui::Event::Copy)));
        let has_text = ui.ctx().plugin::<LabelSelectionState>().lock().has_selection();
        if is_copy && !has_text {
            self.copy_picture();
        }
        if hit(Modifiers::COMMAND, Key::E) {
            self.is_export_open ^= true;
        }
        let count = self.documents.len();
        if count > 1 && hit(Modifiers::CTRL, Key::Tab) {
            self.activate((self.active + 1) % count);
        }
        if count > 1 && hit(Modifiers::CTRL | Modifiers::SHIFT, Key::Tab) {
            self.activate((self.active + count - 1) % count);
        }
        if hit(Modifiers::COMMAND, Key::W) {
            self.close(self.active);
        }
        if hit(Modifiers::COMMAND, Key::Z)
            && let Some(view) = self.past.pop()
        {
            self.future.push(self.view);
            self.view = Navigation { up: self.look.up, ..view };
        }
        if hit(Modifiers::COMMAND, Key::Y)
            && let Some(view) = self.future.pop()
        {
            self.past.push(self.view);
            self.view = Navigation { up: self.look.up, ..view };
        }
        for (name, key) in SIDES {
            if plain(key)
                && let Some(direction) = Direction::named(name)
            {
                self.look_from(direction);
            }
        }
        if plain(Key::F) {
            self.fit();
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
            match self.is_help_open || self.is_export_open {
                true => (self.is_help_open, self.is_export_open) = (false, false),
                false => document.select(None, false),
            }
        }
        if plain(Key::F5) {
            let path = document.path.clone();
            self.start(path, true, false);
        }
        if plain(Key::Space) {
            self.fit_selection();
        }
    }

    pub(super) fn help(&mut self, context: &egui::Context) {
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
}
