//! The instance tree: what there is, what is shown, what is selected.

use std::collections::HashSet;

use egui::{Color32, RichText, Sense, Stroke, StrokeKind, Ui, Vec2};

use crate::document::Document;

/// What was asked for in the tree.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TreeAction {
    Show(usize, bool),
    Isolate(usize),
    Select(usize, bool),
    Fit(usize),
}

/// What of the tree is open, and what is sought.
#[derive(Debug, Default)]
pub(crate) struct Tree {
    pub search: String,
    /// Nodes that are the other way than usual: open below the second level, or closed above.
    turned: HashSet<usize>,
    /// What belongs to the rows: the document, what was sought, how often something was opened.
    made_for: Option<(u64, String, u64)>,
    turns: u64,
    rows: Vec<Row>,
}

#[derive(Clone, Copy, Debug)]
struct Row {
    node: usize,
    depth: u16,
}

/// Levels that are open from the beginning, as long as they are not long.
const OPEN_LEVELS: u16 = 2;
const LONG: usize = 200;
/// A tree that is deeper is not indented any further.
const DEEPEST: u16 = 40;
const INDENT: f32 = 14.0;

impl Tree {
    /// Another document is shown.
    pub fn reset(&mut self) {
        self.turned.clear();
        self.made_for = None;
    }

    fn is_open(&self, document: &Document, node: usize, depth: u16) -> bool {
        let usual = depth < OPEN_LEVELS && document.model.nodes[node].children.len() <= LONG;
        usual != self.turned.contains(&node)
    }

    /// The rows that are there, whether or not they can be seen.
    fn update(&mut self, document: &Document) {
        let key = (document.id, self.search.trim().to_lowercase(), self.turns);
        if self.made_for.as_ref() == Some(&key) {
            return;
        }
        let nodes = &document.model.nodes;
        let wanted = &key.1;
        // With a search, whatever is on the way to something that was found.
        let mut is_wanted = vec![wanted.is_empty(); nodes.len()];
        if !wanted.is_empty() {
            for (index, node) in nodes.iter().enumerate() {
                let names = [Some(&node.name), Some(&node.id), node.instance_name.as_ref()];
                if names.into_iter().flatten().any(|name| name.to_lowercase().contains(wanted)) {
                    let mut up = Some(index);
                    while let Some(own) = up.filter(|own| !is_wanted[*own]) {
                        is_wanted[own] = true;
                        up = document.parent_of(own);
                    }
                }
            }
        }
        self.rows.clear();
        let mut stack: Vec<Row> =
            document.model.roots.iter().rev().map(|&node| Row { node, depth: 0 }).collect();
        while let Some(row) = stack.pop() {
            if !is_wanted[row.node] {
                continue;
            }
            self.rows.push(row);
            if !wanted.is_empty() || self.is_open(document, row.node, row.depth) {
                let children = nodes[row.node].children.iter().rev();
                stack.extend(children.map(|&node| Row { node, depth: (row.depth + 1).min(DEEPEST) }));
            }
        }
        self.made_for = Some(key);
    }

    /// Opens what is above a node; its row.
    fn reveal(&mut self, document: &Document, node: usize) -> Option<usize> {
        let mut above = Vec::new();
        let mut up = document.parent_of(node);
        while let Some(own) = up {
            above.push(own);
            up = document.parent_of(own);
        }
        for (depth, own) in (0..).zip(above.iter().rev()) {
            if !self.is_open(document, *own, depth) {
                if !self.turned.remove(own) {
                    self.turned.insert(*own);
                }
                self.turns += 1;
            }
        }
        self.update(document);
        self.rows.iter().position(|row| row.node == node)
    }

    /// Shows the tree in what is left of `ui`.
    pub fn show(&mut self, ui: &mut Ui, document: &mut Document) -> Vec<TreeAction> {
        let mut actions = Vec::new();
        let row_height = ui.spacing().interact_size.y;
        let reveal = document.wanted_row.take().and_then(|node| self.reveal(document, node));
        self.update(document);
        if self.rows.is_empty() {
            ui.label(RichText::new("Nothing has such a name.").weak());
            return actions;
        }
        let mut selected: HashSet<usize> = document.selected_nodes().into_iter().collect();
        selected.extend(document.node);
        let mut area = egui::ScrollArea::both().id_salt("tree").auto_shrink([false, false]);
        if let Some(row) = reveal {
            let whole = row_height + ui.spacing().item_spacing.y;
            let middle = (row as f32 * whole - 0.4 * ui.available_height()).max(0.0);
            area = area.vertical_scroll_offset(middle);
        }
        let mut toggled = None;
        area.show_rows(ui, row_height, self.rows.len(), |ui, range| {
            for row in &self.rows[range] {
                let is_open = self.is_open(document, row.node, row.depth);
                let row_selected = selected.contains(&row.node);
                if show_row(ui, document, *row, is_open, row_selected, &mut actions) {
                    toggled = Some(row.node);
                }
            }
        });
        if let Some(node) = toggled {
            if !self.turned.remove(&node) {
                self.turned.insert(node);
            }
            self.turns += 1;
        }
        actions
    }
}

/// Shows a row; whether it is to be opened or closed.
fn show_row(
    ui: &mut Ui,
    document: &Document,
    row: Row,
    is_open: bool,
    is_selected: bool,
    actions: &mut Vec<TreeAction>,
) -> bool {
    let own = &document.model.nodes[row.node];
    let name = if own.name.is_empty() { own.id.as_str() } else { own.name.as_str() };
    let name = if name.is_empty() { "unnamed" } else { name };
    let mut is_toggled = false;
    ui.horizontal(|ui| {
        ui.add_space(INDENT * f32::from(row.depth));
        let (area, toggle) = ui.allocate_exact_size(Vec2::splat(14.0), Sense::click());
        if !own.children.is_empty() {
            is_toggled = toggle.clicked();
            let openness = if is_open { 1.0 } else { 0.0 };
            let icon = toggle.with_new_rect(area.shrink(2.0));
            egui::collapsing_header::paint_default_icon(ui, openness, &icon);
        }
        let is_shown = document.is_shown(row.node);
        let mut tick = is_shown;
        let check = ui.checkbox(&mut tick, "").on_hover_text("show or hide");
        if check.changed() {
            actions.push(TreeAction::Show(row.node, tick));
        }
        if let Some(color) = color_of(document, row.node) {
            let (area, _) = ui.allocate_exact_size(Vec2::splat(10.0), Sense::hover());
            let stroke = Stroke::new(1.0, Color32::from_gray(120));
            ui.painter().rect(area, 2.0, color, stroke, StrokeKind::Inside);
        }
        let text = match own.part.map(|part| document.model.parts[part].faces.len()) {
            Some(1) => format!("{name}  (1 face)"),
            Some(faces) => format!("{name}  ({faces} faces)"),
            None if own.children.is_empty() => name.to_owned(),
            None => format!("{name}  ({})", own.children.len()),
        };
        let text = if is_shown { RichText::new(text) } else { RichText::new(text).weak() };
        let label = ui.selectable_label(is_selected, text);
        check.labelled_by(label.id);
        let label = match &own.instance_name {
            Some(instance) if instance != name => label.on_hover_text(instance),
            _ => label,
        };
        if label.double_clicked() {
            actions.push(TreeAction::Fit(row.node));
        } else if label.clicked() {
            let is_added = ui.input(|input| input.modifiers.shift || input.modifiers.command);
            actions.push(TreeAction::Select(row.node, is_added));
        }
        label.context_menu(|ui| {
            for (text, action) in [
                ("Fit", TreeAction::Fit(row.node)),
                ("Isolate", TreeAction::Isolate(row.node)),
                (if is_shown { "Hide" } else { "Show" }, TreeAction::Show(row.node, !is_shown)),
            ] {
                if ui.button(text).clicked() {
                    actions.push(action);
                    ui.close();
                }
            }
        });
    });
    is_toggled
}

/// The colour of a node's part.
fn color_of(document: &Document, node: usize) -> Option<Color32> {
    let own = &document.model.nodes[node];
    let part = document.model.parts.get(own.part?)?;
    let color = own.color.or(part.color).or_else(|| part.faces.iter().find_map(|face| face.color))?;
    let [r, g, b] = [color.r, color.g, color.b].map(|c| (c * 255.0).round() as u8);
    Some(Color32::from_rgb(r, g, b))
}
