//! IGES entities to the exact model.

mod curve;
mod look;
mod reader;
mod shape;
mod surface;

use std::collections::BTreeMap;

use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{
    Body, BodyKind, Diagnostic, Diagnostics, EdgeId, EntityRef, FaceId, Model, Node, Part, Severity, Shell,
    ShellFace, Source,
};
use trimloop_iges::{DirectoryEntry, IgesFile};

use self::curve::CURVES;
use self::look::color_of;
use self::reader::Reader;
use self::shape::ShapeBuilder;
use self::surface::SURFACES;
use crate::ImportError;
use crate::step::sew::{free_edges, sew_body};

/// The exact model of a parsed IGES file.
pub(crate) fn import(file: &IgesFile) -> Result<Model, ImportError> {
    let mut diagnostics: Diagnostics = file.errors().iter().map(syntax_diagnostic).collect();
    let unit_mm = unit_mm(file, &mut diagnostics);
    let reader = Reader { file, unit_mm };
    let name = name_of(file);
    let uncertainty_mm = file.global().resolution * unit_mm;
    let part = Part { name: name.clone(), id: name.clone(), uncertainty_mm, ..Part::default() };
    let mut builder = ShapeBuilder { reader, part, diagnostics, loose: Vec::new() };
    add_everything(&mut builder);
    let ShapeBuilder { mut part, mut diagnostics, loose, .. } = builder;
    make_bodies(&mut part, loose, uncertainty_mm, &mut diagnostics);
    if part.faces.is_empty() && part.curves.is_empty() {
        return Err(ImportError::Nothing(format!(
            "none of the file's {} entities is geometry that can be shown",
            file.len()
        )));
    }
    let node = Node { name, part: Some(0), ..Node::default() };
    Ok(Model { source: source(file), parts: vec![part], nodes: vec![node], roots: vec![0], diagnostics })
}

fn syntax_diagnostic(error: &trimloop_iges::SyntaxError) -> Diagnostic {
    // A wrong count or a stray line loses nothing; an entry without its data does.
    let severity = if error.entry.is_some() { Severity::Error } else { Severity::Warning };
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
    unit / global.scale
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

/// Everything that stands on its own and is to be shown.
fn add_everything(builder: &mut ShapeBuilder<'_>) {
    let reader = builder.reader;
    let used = used_by_others(&reader);
    let mut unknown: BTreeMap<i32, usize> = BTreeMap::new();
    for entity in reader.file.entities() {
        let directory = entity.directory;
        let (entry, kind) = (directory.number, directory.entity_type);
        if used.contains(&entry) || !is_shown(directory) {
            continue;
        }
        let first_face = builder.part.faces.len();
        let color = color_of(&reader, entry);
        match kind {
            143 | 144 => builder.add_loose(entry, color),
            186 | 514 => builder.add_solid(entry, color),
            // A plane without bounds is there to be referred to.
            108 if directory.form != 1 => {}
            106 if !matches!(directory.form, 11..=13 | 63) => {}
            190 | 192 | 194 => {}
            kind if SURFACES.contains(&kind) => builder.add_loose(entry, color),
            kind if CURVES.contains(&kind) => builder.add_curve(entry, color),
            // Points, directions, transformations, structure and properties show nothing themselves.
            0 | 116 | 123 | 124 | 141 | 142 | 302..=320 | 400..=499 | 502..=510 => {}
            other => *unknown.entry(other).or_default() += 1,
        }
        if directory.status.blanked {
            builder.part.faces[first_face..].iter_mut().for_each(|face| face.hidden = true);
        }
    }
    for (kind, count) in unknown {
        let message = format!("{count} entities of type {kind} are not read.");
        builder.diagnostics.push(Diagnostic::new(Severity::Info, "unsupported", EntityRef::None, message));
    }
}

/// Whether the status field lets an entity be shown on its own (IGES 5.3 section 2.2.4.4.9); what is blanked is kept
/// as hidden, curves apart.
fn is_shown(directory: &DirectoryEntry) -> bool {
    let status = directory.status;
    let is_curve = CURVES.contains(&directory.entity_type);
    let stands_alone = !is_curve || (!status.blanked && matches!(status.subordinate, 0 | 2));
    stands_alone && matches!(status.usage, 0 | 3 | 4)
}

/// Entities that others are made of, whatever their status says.
fn used_by_others(reader: &Reader<'_>) -> FxHashSet<u32> {
    let mut used = FxHashSet::default();
    for entity in reader.file.entities() {
        let pointers: &[usize] = match entity.directory.entity_type {
            108 => &[5],
            118 | 120 => &[1, 2],
            122 | 130 => &[1],
            140 => &[5],
            142 => &[2, 3, 4],
            143 => &[2],
            144 => &[1],
            186 | 510 => &[1],
            _ => &[],
        };
        let values: Vec<_> = entity.values().collect();
        let at = |place: usize| -> Option<u32> {
            let value = values.get(place)?.integer()?;
            u32::try_from(value.unsigned_abs()).ok().filter(|&entry| entry % 2 == 1)
        };
        used.extend(pointers.iter().filter_map(|&place| at(place)));
        used.extend(pointers.iter().filter_map(|&place| at(place)));
        if entity.directory.entity_type == 141 {
            // Each curve in the model is followed by a sense and by its curves in the parameter plane.
            let mut place = 5;
            while place + 2 < values.len() {
                let count = values[place + 2].integer().unwrap_or(0).clamp(0, values.len() as i64) as usize;
                used.extend(at(place));
                used.extend((place + 3..place + 3 + count).filter_map(at));
                place += 3 + count;
            }
        }
        // Lists: where their length stands, where the first pointer does, and how far apart they are.
        let (length, first, stride) = match entity.directory.entity_type {
            102 => (1, 2, 1),
            143 => (3, 4, 1),
            144 => (3, 4, 1),
            186 => (3, 4, 2),
            504 => (1, 2, 5),
            510 => (2, 4, 1),
            514 => (1, 2, 2),
            _ => continue,
        };
        let count = values.get(length).and_then(trimloop_iges::Value::integer).unwrap_or(0);
        // The outer boundary of a trimmed surface stands before the inner ones.
        let count = count.max(0) as usize + usize::from(entity.directory.entity_type == 144);
        used.extend((first..values.len()).step_by(stride).take(count).filter_map(at));
    }
    used
}

/// Sews the faces that came one by one, and makes a body of each set that hangs together.
fn make_bodies(part: &mut Part, loose: Vec<FaceId>, uncertainty_mm: f64, diagnostics: &mut Diagnostics) {
    if loose.is_empty() {
        return;
    }
    let all = body(loose.clone(), BodyKind::Sheet);
    part.bodies.push(all);
    let index = part.bodies.len() - 1;
    let widest = uncertainty_mm.clamp(2e-2, 0.1);
    sew_body(part, index, &[1e-6, 1e-3, widest]);
    part.bodies.pop();
    for faces in components(part, &loose) {
        let mut made = body(faces, BodyKind::Sheet);
        let mut uses = vec![0u32; part.edges.len()];
        let open = free_edges(part, &made, &mut uses);
        let has_loops = made.shells[0].faces.iter().any(|it| !part.faces[it.face as usize].loops.is_empty());
        if open.is_empty() && has_loops {
            made.kind = BodyKind::Solid;
            made.shells[0].closed = true;
        } else if made.shells[0].faces.len() > 1 && !open.is_empty() {
            let entity = part.faces[made.shells[0].faces[0].face as usize].entity;
            let message = format!(
                "{} edges of the {} faces that hang together with {entity} have no neighbour.",
                open.len(),
                made.shells[0].faces.len()
            );
            diagnostics.push(Diagnostic::new(Severity::Info, "open-edges", entity, message));
        }
        part.bodies.push(made);
    }
}

fn body(faces: Vec<FaceId>, kind: BodyKind) -> Body {
    let faces = faces.into_iter().map(|face| ShellFace { face, reversed: false }).collect();
    let shell = Shell { entity: EntityRef::None, closed: false, void: false, faces };
    Body { name: String::new(), entity: EntityRef::None, kind, shells: vec![shell], layers: Vec::new() }
}

/// The sets of faces that share edges, in the file's order.
fn components(part: &Part, faces: &[FaceId]) -> Vec<Vec<FaceId>> {
    let mut group: Vec<usize> = (0..faces.len()).collect();
    fn root(group: &mut [usize], mut at: usize) -> usize {
        while group[at] != at {
            group[at] = group[group[at]];
            at = group[at];
        }
        at
    }
    let mut first_with: FxHashMap<EdgeId, usize> = FxHashMap::default();
    for (k, &face) in faces.iter().enumerate() {
        for coedge in part.faces[face as usize].loops.iter().flat_map(|bound| &bound.coedges) {
            let other = *first_with.entry(coedge.edge).or_insert(k);
            let (a, b) = (root(&mut group, k), root(&mut group, other));
            group[a.max(b)] = a.min(b);
        }
    }
    let mut sets: BTreeMap<usize, Vec<FaceId>> = BTreeMap::new();
    for (k, &face) in faces.iter().enumerate() {
        sets.entry(root(&mut group, k)).or_default().push(face);
    }
    sets.into_values().collect()
}
