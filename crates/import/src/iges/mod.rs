//! IGES entities to the exact model.

mod bodies;
mod curve;
mod distribute;
mod face;
mod layout;
mod look;
mod outline;
mod plane_order;
mod primitive;
mod reader;
mod scene;
mod shape;
mod solid;
mod surface;

use std::collections::BTreeMap;

use trimloop_brep::{Diagnostic, Diagnostics, EntityRef, Model, Severity, Source};
use trimloop_iges::{IgesFile, Section};

use self::outline::{Outline, Uses};
use self::reader::{Reader, read_long_entities};
use self::scene::SceneBuilder;
use crate::ImportError;

/// The exact model of a parsed IGES file.
pub(crate) fn import(file: &IgesFile) -> Result<Model, ImportError> {
    let mut diagnostics: Diagnostics = file.errors().iter().map(syntax_diagnostic).collect();
    let unit_mm = unit_mm(file, &mut diagnostics);
    let long = read_long_entities(file);
    let reader = Reader { file, long: &long, unit_mm };
    let outline = Outline::of_file(&reader, &Uses::new(&reader), &mut diagnostics);
    let uncertainty_mm = file.global().resolution * unit_mm;
    let scene = SceneBuilder::new(reader, uncertainty_mm, diagnostics);
    let model = scene.finish(outline, &name_of(file));
    let shows = |part: &trimloop_brep::Part| {
        !(part.faces.is_empty() && part.curves.is_empty() && part.points.is_empty())
    };
    if !model.parts.iter().any(shows) {
        return Err(ImportError::Nothing(format!(
            "none of the file's {} entities is geometry that can be shown",
            file.len()
        )));
    }
    Ok(Model { source: source(file), ..model })
}

fn syntax_diagnostic(error: &trimloop_iges::SyntaxError) -> Diagnostic {
    // A wrong count or a stray line loses nothing; an entry without its data does, and without units all may be wrong.
    let loses = error.entry.is_some() || error.section == Section::Global;
    let severity = if loses { Severity::Error } else { Severity::Warning };
    let entity = error.entry.map_or(EntityRef::None, EntityRef::Iges);
    Diagnostic::new(severity, "syntax", entity, error.to_string())
}

/// Millimetres per unit of model space.
fn unit_mm(file: &IgesFile, diagnostics: &mut Diagnostics) -> f64 {
    let global = file.global();
    let unit = global.unit_mm().unwrap_or_else(|| {
        let message =
            format!("The unit of length (\"{}\") is not known; taken for millimetres.", global.unit_name);
        diagnostics.push(Diagnostic::new(Severity::Warning, "unknown-unit", EntityRef::None, message));
        1.0
    });
    let scaled = unit / global.scale;
    if (1e-30..1e30).contains(&scaled) {
        return scaled;
    }
    let message = format!("The scale of model space, {:e}, is none that can be; taken for 1.", global.scale);
    diagnostics.push(Diagnostic::new(Severity::Warning, "unknown-unit", EntityRef::None, message));
    unit
}

fn name_of(file: &IgesFile) -> String {
    let global = file.global();
    let names = [&global.product, &global.file_name];
    names.into_iter().find(|name| !name.is_empty()).cloned().unwrap_or_else(|| "IGES".to_owned())
}

fn source(file: &IgesFile) -> Source {
    let global = file.global();
    let mut counts = BTreeMap::new();
    for entity in file.entities() {
        *counts.entry(entity.directory.entity_type).or_insert(0usize) += 1;
    }
    let mut counts: Vec<(String, usize)> =
        counts.into_iter().map(|(kind, n)| (kind.to_string(), n)).collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let some = |text: &String| if text.is_empty() { Vec::new() } else { vec![text.clone()] };
    Source {
        format: "iges",
        schema: match global.version {
            9 => "IGES 5.1".to_owned(),
            10 => "IGES 5.2".to_owned(),
            11 => "IGES 5.3".to_owned(),
            8 => "IGES 5.0".to_owned(),
            _ => "IGES".to_owned(),
        },
        originating_system: global.system.clone(),
        preprocessor: global.preprocessor.clone(),
        name: global.file_name.clone(),
        time_stamp: global.date.clone(),
        authors: some(&global.author),
        organizations: some(&global.organization),
        length_units: some(&global.unit_name),
        entity_counts: counts,
        ..Source::default()
    }
}
