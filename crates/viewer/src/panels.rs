//! The panels beside the view.

use egui::{RichText, Ui};
use glam::DVec3;
use trimloop_brep::{FaceGeometry, Severity};
use trimloop_geom::Aabb;

use crate::display::{Colors, Display, Mode, short};
use crate::document::{Document, Picked};
use crate::measure::{number, vector};
use crate::pick::Filter;
use crate::section::Cuts;

/// What is shown below the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tab {
    #[default]
    Selection,
    Section,
    Display,
    Report,
}

/// What is known of the selection.
pub(crate) fn selection(ui: &mut Ui, document: &mut Document, filter: &mut Filter) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("pick").weak());
        ui.checkbox(&mut filter.faces, "faces");
        ui.checkbox(&mut filter.edges, "edges");
        ui.checkbox(&mut filter.vertices, "vertices");
    });
    let facts = document.facts();
    if facts.is_empty() {
        ui.label(
            RichText::new("Click a face, an edge or a vertex; with Shift a second one to measure.").weak(),
        );
    }
    egui::Grid::new("facts").num_columns(2).spacing([12.0, 4.0]).show(ui, |ui| {
        for (name, value) in &facts {
            ui.label(RichText::new(name).weak());
            ui.add(egui::Label::new(RichText::new(value).monospace()).wrap());
            ui.end_row();
        }
    });
    if !facts.is_empty() {
        ui.horizontal(|ui| {
            if ui.button("Copy as text").clicked() {
                let text: Vec<String> =
                    facts.iter().map(|(name, value)| format!("{name}: {value}")).collect();
                ui.ctx().copy_text(text.join("\n"));
            }
            let can_keep = document.measure.found.is_some();
            if ui.add_enabled(can_keep, egui::Button::new("Keep (M)")).clicked() {
                document.measure.keep();
            }
        });
    }
    let mut dropped = None;
    for (k, kept) in document.measure.kept.iter().enumerate() {
        ui.horizontal(|ui| {
            if ui.small_button("×").on_hover_text("forget").clicked() {
                dropped = Some(k);
            }
            ui.monospace(kept.label());
        });
    }
    if let Some(k) = dropped {
        document.measure.kept.remove(k);
    }
}

/// The section planes and their places.
pub(crate) fn section(ui: &mut Ui, cuts: &mut Cuts, bounds: Aabb, document: &Document) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("plane").weak());
        for k in 0..cuts.all.len() {
            let text = if cuts.all[k].is_on { format!("{} on", k + 1) } else { format!("{}", k + 1) };
            ui.selectable_value(&mut cuts.active, k, text);
        }
    });
    let cut = cuts.active_mut();
    ui.horizontal(|ui| {
        ui.checkbox(&mut cut.is_on, "on (X)");
        for (axis, name) in [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")] {
            let is_own = cut.normal.dot(axis).abs() > 1.0 - 1e-12;
            if ui.selectable_label(is_own, name).clicked() {
                cut.turn(axis, None);
                cut.is_on = true;
            }
        }
        if ui.button("flip").clicked() {
            cut.flip(bounds);
        }
    });
    ui.horizontal(|ui| {
        let through = document.selected_face().and_then(|(picked, _)| picked.place);
        let button = egui::Button::new("through the selection");
        if ui.add_enabled(through.is_some(), button).on_hover_text("across the face's normal").clicked()
            && let Some(place) = through
        {
            cut.turn(place.normal, Some(place.point));
            cut.is_on = true;
        }
        ui.checkbox(&mut cut.has_gizmo, "handles");
    });
    let [low, high] = cut.range(bounds);
    // Without the sign of nothing.
    let mut offset = cut.plane(bounds).offset_mm + 0.0;
    if !(low < high) {
        return;
    }
    ui.add_enabled_ui(cut.is_on, |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 110.0).max(60.0);
        let slider = egui::Slider::new(&mut offset, low..=high).suffix(" mm").max_decimals(3);
        if ui.add(slider).changed() {
            cut.offset_mm = Some(offset);
        }
        let n = cut.normal;
        ui.label(RichText::new(format!("normal {}", vector(n))).weak().monospace());
    });
    if document.caps.is_busy() {
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(RichText::new("closing the cut").weak());
        });
    }
}

/// What was asked for in the display's panel.
pub(crate) enum DisplayAction {
    ChooseReference,
}

/// How the model is shown.
pub(crate) fn display(
    ui: &mut Ui,
    display: &mut Display,
    size_mm: f64,
    document: &mut Document,
) -> Option<DisplayAction> {
    let mut action = None;
    egui::ComboBox::from_label("faces").selected_text(name_of(&Mode::ALL, display.mode)).show_ui(ui, |ui| {
        for (mode, name) in Mode::ALL {
            ui.selectable_value(&mut display.mode, mode, name);
        }
    });
    egui::ComboBox::from_label("colours").selected_text(name_of(&Colors::ALL, display.colors)).show_ui(
        ui,
        |ui| {
            for (colors, name) in Colors::ALL {
                ui.selectable_value(&mut display.colors, colors, name);
            }
        },
    );
    match display.colors {
        Colors::Curvature => {
            let mut radius = display.tightest(size_mm);
            let speed = 0.02 * radius;
            ui.horizontal(|ui| {
                ui.label("red from a radius of");
                let drag = egui::DragValue::new(&mut radius).speed(speed).range(1e-6..=1e6);
                if ui.add(drag.suffix(" mm").max_decimals(3)).changed() {
                    display.tightest_mm = Some(radius);
                }
            });
        }
        Colors::Deviation => {
            if ui.button("Reference…").clicked() {
                action = Some(DisplayAction::ChooseReference);
            }
            let mut is_changed = false;
            match &mut document.deviation {
                None => {
                    ui.label(RichText::new("Choose a mesh or a CAD file to compare with.").weak());
                }
                Some(deviation) => {
                    let name = deviation.reference.file_name().unwrap_or_default().to_string_lossy();
                    ui.label(format!("{name}: at most {} mm away", short(deviation.largest_mm())));
                    if let Some(convention) = &deviation.convention {
                        ui.label(RichText::new(convention).weak());
                    }
                    ui.horizontal(|ui| {
                        ui.label("red from");
                        let speed = 0.02 * deviation.most_mm;
                        let drag = egui::DragValue::new(&mut deviation.most_mm)
                            .speed(speed)
                            .range(1e-9..=1e6)
                            .suffix(" mm")
                            .custom_formatter(|value, _| short(value));
                        is_changed = ui.add(drag).changed();
                    });
                }
            }
            document.revision += u64::from(is_changed);
        }
        Colors::Own | Colors::Parts | Colors::Kinds => {}
    }
    let mut explosion = document.explosion();
    ui.add_enabled_ui(document.can_explode(), |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 110.0).max(60.0);
        let slider = egui::Slider::new(&mut explosion, 0.0..=2.0).show_value(false).text("apart");
        if ui.add(slider).on_disabled_hover_text("there is only one part").changed() {
            document.explode(explosion);
        }
    });
    action
}

fn name_of<T: PartialEq>(all: &[(T, &'static str)], own: T) -> &'static str {
    all.iter().find(|(other, _)| *other == own).map_or("", |(_, name)| name)
}

/// What was lost or approximated; a click selects the face.
pub(crate) fn report(ui: &mut Ui, document: &Document) -> Option<Picked> {
    let faces = || document.model.parts.iter().flat_map(|part| &part.faces);
    let lost = faces().filter(|face| matches!(face.geometry, FaceGeometry::Unreadable(_))).count();
    ui.label(format!(
        "{}, {} parts, {} faces{}",
        document.model.source.schema,
        document.model.parts.len(),
        faces().count(),
        if lost > 0 { format!(", {lost} unreadable") } else { String::new() }
    ));
    if let Some(seconds) = document.seconds {
        ui.label(RichText::new(format!("read in {} s", number((seconds * 100.0).round() / 100.0))).weak());
    }
    if document.diagnostics.is_empty() {
        ui.label(RichText::new("Nothing was lost.").weak());
        ui.allocate_space(ui.available_size());
        return None;
    }
    let mut chosen = None;
    let height = ui.text_style_height(&egui::TextStyle::Body);
    let area = egui::ScrollArea::vertical().id_salt("report").auto_shrink([false, false]);
    area.show_rows(ui, height, document.diagnostics.len(), |ui, range| {
        for diagnostic in &document.diagnostics[range] {
            let color = match diagnostic.severity {
                Severity::Error => ui.visuals().error_fg_color,
                _ => ui.visuals().warn_fg_color,
            };
            let text = format!("{}: {}", diagnostic.entity, diagnostic.message);
            let face = document.find(diagnostic.face.unwrap_or(diagnostic.entity));
            let label = egui::Label::new(RichText::new(&text).color(color)).truncate();
            let label = if face.is_some() { label.sense(egui::Sense::click()) } else { label };
            if ui.add(label).on_hover_text(text).clicked() {
                chosen = face;
            }
        }
    });
    chosen
}
