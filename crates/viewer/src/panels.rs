//! The panels beside the view.

use egui::{RichText, Ui};
use trimloop_brep::Severity;
use trimloop_render::Highlight;

use crate::document::Document;

/// What was asked for in the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TreeAction {
    Show(usize, bool),
    Isolate(usize),
    Select(usize),
    Fit(usize),
}

/// Nodes of the tree that are listed one below the other, before the rest is left out.
const MOST_ROWS: usize = 4000;

/// The instance tree: what is shown, what is selected.
pub(crate) fn tree(ui: &mut Ui, document: &Document, search: &str) -> Option<TreeAction> {
    let mut action = None;
    let mut rows = 0;
    let wanted = search.trim().to_lowercase();
    for &root in &document.model.roots {
        node(ui, document, root, &wanted, 0, &mut rows, &mut action);
    }
    if rows >= MOST_ROWS {
        ui.label("… and more: search for a name");
    }
    action
}

fn matches_below(document: &Document, index: usize, wanted: &str) -> bool {
    let own = &document.model.nodes[index];
    own.name.to_lowercase().contains(wanted)
        || own.children.iter().any(|&c| matches_below(document, c, wanted))
}

fn node(
    ui: &mut Ui,
    document: &Document,
    index: usize,
    wanted: &str,
    depth: usize,
    rows: &mut usize,
    action: &mut Option<TreeAction>,
) {
    if *rows >= MOST_ROWS || (!wanted.is_empty() && !matches_below(document, index, wanted)) {
        return;
    }
    *rows += 1;
    let own = &document.model.nodes[index];
    let scene = document.renderer.scene();
    let instance = scene.instances.iter().position(|i| i.node == Some(index));
    let name = if own.name.is_empty() { own.id.as_str() } else { own.name.as_str() };
    let name = if name.is_empty() { "unnamed" } else { name };
    let is_selected = document.selection.is_some_and(|s| scene.instances[s.instance].node == Some(index));
    let row = |ui: &mut Ui, action: &mut Option<TreeAction>| {
        let below = if own.children.is_empty() {
            instance.into_iter().collect()
        } else {
            document.instances_below(index)
        };
        let mut is_shown = below.is_empty() || below.iter().any(|&i| scene.instances[i].is_shown);
        let check = ui.checkbox(&mut is_shown, "").on_hover_text("show or hide");
        if check.changed() {
            *action = Some(TreeAction::Show(index, is_shown));
        }
        let faces = own.part.map(|part| scene.parts[part].faces.len());
        let text = match faces {
            Some(1) => format!("{name}  (1 face)"),
            Some(faces) => format!("{name}  ({faces} faces)"),
            None => name.to_owned(),
        };
        let label = ui.selectable_label(is_selected, text);
        check.labelled_by(label.id);
        if label.clicked() {
            *action = Some(TreeAction::Select(index));
        }
        if label.double_clicked() {
            *action = Some(TreeAction::Fit(index));
        }
        label.context_menu(|ui| {
            if ui.button("Fit").clicked() {
                *action = Some(TreeAction::Fit(index));
                ui.close();
            }
            if ui.button("Isolate").clicked() {
                *action = Some(TreeAction::Isolate(index));
                ui.close();
            }
            if ui.button(if is_shown { "Hide" } else { "Show" }).clicked() {
                *action = Some(TreeAction::Show(index, !is_shown));
                ui.close();
            }
        });
        if is_selected && document.place.is_some() {
            label.scroll_to_me(None);
        }
    };
    if own.children.is_empty() {
        ui.horizontal(|ui| row(ui, action));
        return;
    }
    let id = ui.make_persistent_id(("node", index));
    let is_open = depth < 2 || !wanted.is_empty();
    egui::collapsing_header::CollapsingState::load_with_default_open(ui.ctx(), id, is_open)
        .show_header(ui, |ui| row(ui, action))
        .body(|ui| {
            for &child in &own.children {
                node(ui, document, child, wanted, depth + 1, rows, action);
            }
        });
}

/// What is known of the selection.
pub(crate) fn selection(ui: &mut Ui, document: &Document) {
    let facts = document.facts();
    if facts.is_empty() {
        ui.label(RichText::new("Click a face to see what it is.").weak());
        return;
    }
    egui::Grid::new("facts").num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
        for (name, value) in &facts {
            ui.label(RichText::new(name).weak());
            ui.add(egui::Label::new(RichText::new(value).monospace()).wrap());
            ui.end_row();
        }
    });
    if ui.button("Copy as text").clicked() {
        let text: Vec<String> = facts.iter().map(|(name, value)| format!("{name}: {value}")).collect();
        ui.ctx().copy_text(text.join("\n"));
    }
}

/// What was lost or approximated; a click selects the face.
pub(crate) fn report(ui: &mut Ui, document: &Document) -> Option<Highlight> {
    if document.diagnostics.is_empty() {
        ui.label(RichText::new("Nothing was lost.").weak());
        return None;
    }
    let mut chosen = None;
    egui::ScrollArea::vertical().id_salt("report").max_height(180.0).show(ui, |ui| {
        for diagnostic in document.diagnostics.iter().take(MOST_ROWS) {
            let color = match diagnostic.severity {
                Severity::Error => ui.visuals().error_fg_color,
                _ => ui.visuals().warn_fg_color,
            };
            let text = RichText::new(format!("{}: {}", diagnostic.entity, diagnostic.message)).color(color);
            if ui.add(egui::Label::new(text).wrap().sense(egui::Sense::click())).clicked() {
                chosen = document.find_face(diagnostic.entity);
            }
        }
    });
    chosen
}
