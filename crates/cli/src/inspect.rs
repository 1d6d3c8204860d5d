//! `trimloop inspect`: what is in a file, without meshing it.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use trimloop_brep::{BodyKind, Model, Node, Part, Rgba};
use trimloop_import::ImportOptions;

use crate::arguments::InspectArguments;
use crate::contained::contained;
use crate::outcome::Outcome;
use crate::report::{DiagnosticReport, surface_kind};
use crate::{inspect_text, manual, message};

/// Describes every input on standard output.
pub fn run(arguments: &InspectArguments) -> anyhow::Result<Outcome> {
    let mut worst = Outcome::Good;
    for input in &arguments.inputs {
        match contained(|| Ok(trimloop_import::read(input, &ImportOptions::default())?)) {
            Ok(model) => {
                let inspection = Inspection::new(input, &model);
                let text = if arguments.json {
                    serde_json::to_string(&inspection)? + "\n"
                } else {
                    inspect_text::of(&inspection)
                };
                worst = worst.max(manual::print(text.as_bytes())?);
            }
            Err(error) => {
                eprintln!("error: {}: {}", input.display(), message::of(&error));
                worst = Outcome::Failed;
            }
        }
    }
    Ok(worst)
}

/// What is in a file.
#[derive(Clone, Debug, Serialize)]
pub struct Inspection {
    /// The file, as it was named.
    pub input: String,
    /// Its size.
    pub bytes: u64,
    /// `step`.
    pub format: &'static str,
    /// `AP203`, `AP214`, `AP242`, or what the file says.
    pub schema: String,
    /// The schemas as written.
    pub schema_identifiers: Vec<String>,
    /// The CAD system.
    pub originating_system: String,
    /// The translator.
    pub preprocessor: String,
    /// The name in the header.
    pub name: String,
    /// The time stamp in the header.
    pub time_stamp: String,
    /// Authors.
    pub authors: Vec<String>,
    /// Organizations.
    pub organizations: Vec<String>,
    /// Length units.
    pub length_units: Vec<String>,
    /// Plane angle units.
    pub angle_units: Vec<String>,
    /// What there is of each.
    pub counts: Counts,
    /// Faces by the kind of their surface, the most frequent first.
    pub surfaces: Vec<Counted>,
    /// Edges by the kind of their curve, the most frequent first.
    pub curves: Vec<Counted>,
    /// Colours (`#rrggbb`, `#rrggbbaa` where not opaque) by the number of faces that have them, the most frequent
    /// first.
    pub colors: Vec<Counted>,
    /// Layers, by the number of bodies on them.
    pub layers: Vec<Counted>,
    /// Records of the file by their type, the most frequent first.
    pub entities: Vec<Counted>,
    /// Indices of the topmost nodes.
    pub roots: Vec<usize>,
    /// The instance tree; flat, as it may be deep.
    pub nodes: Vec<NodeReport>,
    /// What reading had to say.
    pub diagnostics: Vec<DiagnosticReport>,
}

/// What there is of each, each part counted once.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Counts {
    /// Parts.
    pub parts: usize,
    /// Uses of parts.
    pub instances: usize,
    /// Bodies that claim to be solid.
    pub solids: usize,
    /// Other bodies.
    pub sheets: usize,
    /// Faces.
    pub faces: usize,
    /// Edges.
    pub edges: usize,
    /// Vertices.
    pub vertices: usize,
    /// Curves that bound no face.
    pub free_curves: usize,
}

/// A name and how often it was met.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Counted {
    /// The name.
    pub name: String,
    /// How often.
    pub count: usize,
}

/// A node of the instance tree.
#[derive(Clone, Debug, Serialize)]
pub struct NodeReport {
    /// The product's name, else its id.
    pub name: String,
    /// The product's id.
    pub id: String,
    /// The name of this use.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instance: Option<String>,
    /// The entity.
    pub entity: String,
    /// Its own geometry: index of the part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<usize>,
    /// Solids of that part.
    pub solids: usize,
    /// Sheets of that part.
    pub sheets: usize,
    /// Faces of that part.
    pub faces: usize,
    /// Whether the file hides it.
    pub hidden: bool,
    /// Indices of the nodes below.
    pub children: Vec<usize>,
}

impl Inspection {
    /// Looks at all of `model`.
    pub fn new(input: &Path, model: &Model) -> Self {
        let source = model.source.clone();
        let faces = || model.parts.iter().flat_map(|part| &part.faces);
        let edges = model.parts.iter().flat_map(|part| &part.edges);
        let layers = model.parts.iter().flat_map(|part| &part.bodies).flat_map(|body| &body.layers);
        Self {
            input: input.display().to_string(),
            bytes: std::fs::metadata(input).map_or(0, |metadata| metadata.len()),
            format: source.format,
            schema: source.schema,
            schema_identifiers: source.schema_identifiers,
            originating_system: source.originating_system,
            preprocessor: source.preprocessor,
            name: source.name,
            time_stamp: source.time_stamp,
            authors: source.authors,
            organizations: source.organizations,
            length_units: source.length_units,
            angle_units: source.angle_units,
            counts: counts(model),
            surfaces: tally(faces().map(|face| surface_kind(face).to_string())),
            curves: tally(edges.map(|edge| edge.curve.kind().to_string())),
            colors: tally(faces().filter_map(|face| face.color).map(hex)),
            layers: tally(layers.cloned()),
            entities: source.entity_counts.into_iter().map(|(name, count)| Counted { name, count }).collect(),
            roots: model.roots.clone(),
            nodes: model.nodes.iter().map(|node| node_report(node, &model.parts)).collect(),
            diagnostics: model.diagnostics.iter().map(DiagnosticReport::of).collect(),
        }
    }
}

fn counts(model: &Model) -> Counts {
    let mut counts = Counts {
        parts: model.parts.len(),
        instances: model.instance_counts().iter().sum(),
        ..Counts::default()
    };
    for part in &model.parts {
        let [solids, sheets] = bodies(part);
        counts.solids += solids;
        counts.sheets += sheets;
        counts.faces += part.faces.len();
        counts.edges += part.edges.len();
        counts.vertices += part.vertices.len();
        counts.free_curves += part.curves.len();
    }
    counts
}

/// Number of solids and of sheets.
fn bodies(part: &Part) -> [usize; 2] {
    [BodyKind::Solid, BodyKind::Sheet].map(|kind| part.bodies.iter().filter(|body| body.kind == kind).count())
}

fn node_report(node: &Node, parts: &[Part]) -> NodeReport {
    let part = node.part.map(|index| &parts[index]);
    let [solids, sheets] = part.map_or([0, 0], bodies);
    NodeReport {
        name: node.name.clone(),
        id: node.id.clone(),
        instance: node.instance_name.clone(),
        entity: node.entity.to_string(),
        part: node.part,
        solids,
        sheets,
        faces: part.map_or(0, |part| part.faces.len()),
        hidden: node.hidden,
        children: node.children.clone(),
    }
}

/// How often each name occurs, the most frequent first, then by name.
fn tally(names: impl Iterator<Item = String>) -> Vec<Counted> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    names.for_each(|name| *counts.entry(name).or_default() += 1);
    let mut counted: Vec<_> = counts.into_iter().map(|(name, count)| Counted { name, count }).collect();
    counted.sort_by_key(|c| std::cmp::Reverse(c.count));
    counted
}

fn hex(color: Rgba) -> String {
    let [r, g, b, a] =
        [color.r, color.g, color.b, color.a].map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8);
    if a == 255 { format!("#{r:02x}{g:02x}{b:02x}") } else { format!("#{r:02x}{g:02x}{b:02x}{a:02x}") }
}

#[cfg(test)]
mod tests {
    use trimloop_brep::Rgba;

    use super::{Counted, hex, tally};

    #[test]
    fn the_most_frequent_comes_first() {
        let names = ["plane", "cylinder", "torus", "cylinder"].into_iter().map(str::to_string);
        let counted = |name: &str, count| Counted { name: name.into(), count };
        let expected = [counted("cylinder", 2), counted("plane", 1), counted("torus", 1)];
        assert_eq!(tally(names), expected);
    }

    #[test]
    fn colours_show_their_alpha_where_they_have_some() {
        assert_eq!(hex(Rgba::opaque(1.0, 0.5, 0.0)), "#ff8000");
        assert_eq!(hex(Rgba { r: 0.0, g: 0.0, b: 1.0, a: 0.5 }), "#0000ff80");
    }
}
