//! The report on a conversion, as JSON. The README documents it; `version` changes with its meaning.

use std::path::Path;

use serde::Serialize;
use trimloop_brep::{Diagnostic, EntityRef, Face, FaceGeometry, Model, Part, Severity};
use trimloop_gltf::Written;
use trimloop_mesh::{FaceMesh, FaceStatus, PartMesh};

use crate::plan::Job;
use crate::tally::{self, Tally, Totals};

/// Everything there is to say about a conversion.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// 1.
    pub version: u32,
    /// The CAD file, as it was named.
    pub input: String,
    /// The file that was written, as it was named.
    pub output: String,
    /// `step`.
    pub format: &'static str,
    /// `AP203`, `AP214`, `AP242`, or what the file says.
    pub schema: String,
    /// The input's size.
    pub bytes: u64,
    /// Where the time went.
    pub seconds: Seconds,
    /// Every instance counted.
    pub totals: Totals,
    /// Each part once.
    pub parts: Vec<PartReport>,
    /// Each face once, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<Vec<FaceReport>>,
    /// What all stages had to say.
    pub diagnostics: Vec<DiagnosticReport>,
}

/// Wall-clock seconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Seconds {
    /// Text to entities.
    pub read: f64,
    /// Entities to the exact model.
    pub import: f64,
    /// The exact model to triangles.
    pub mesh: f64,
    /// Triangles to glTF.
    pub write: f64,
    /// All of it.
    pub total: f64,
}

/// A part.
#[derive(Clone, Debug, Serialize)]
pub struct PartReport {
    /// The product's name, else its id.
    pub name: String,
    /// The product's id.
    pub id: String,
    /// The product definition.
    pub entity: Option<String>,
    /// How often it is placed.
    pub instances: usize,
    /// Its own counts, placed once.
    #[serde(flatten)]
    pub tally: Tally,
}

/// A face.
#[derive(Clone, Debug, Serialize)]
pub struct FaceReport {
    /// The file's own name for it.
    pub entity: Option<String>,
    /// Index into `parts`.
    pub part: usize,
    /// `plane`, `cylinder`, `nurbs`, ..., `facets`, or `unreadable`.
    pub surface: &'static str,
    /// `exact`, `approximated`, `empty` or `lost`.
    pub status: &'static str,
    /// Why it is approximated or lost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Whether the file hides it (and the output leaves it out).
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub hidden: bool,
    /// Number of triangles.
    pub triangles: usize,
    /// Their area.
    pub area_mm2: f64,
    /// The largest distance found between them and the exact surface.
    pub max_deviation_mm: f64,
}

/// A diagnostic.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiagnosticReport {
    /// `info`, `warning`, `error`.
    pub severity: &'static str,
    /// Stable code.
    pub code: &'static str,
    /// The entity at fault.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entity: Option<String>,
    /// The face it concerns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<String>,
    /// One sentence.
    pub message: String,
}

/// What stands in the place of a report where there is nothing to report on.
#[derive(Clone, Debug, Serialize)]
pub struct Failure<'a> {
    /// 1.
    pub version: u32,
    /// The CAD file, as it was named.
    pub input: String,
    /// Why there is no output.
    pub error: &'a str,
}

impl Report {
    /// The report on `model` and its meshes. Times and sizes are the caller's to fill in.
    pub fn new(job: &Job, model: &Model, meshes: &[PartMesh], written: &Written, with_faces: bool) -> Self {
        let tallies = tally::of_parts(model, meshes, written);
        Self {
            version: 1,
            input: job.input.display().to_string(),
            output: job.target.path().display().to_string(),
            format: model.source.format,
            schema: model.source.schema.clone(),
            bytes: 0,
            seconds: Seconds::default(),
            totals: tally::of_model(model, meshes, &tallies),
            faces: with_faces.then(|| faces(model, meshes)),
            diagnostics: diagnostics(model, meshes).map(DiagnosticReport::of).collect(),
            parts: parts(model, tallies),
        }
    }
}

impl DiagnosticReport {
    /// Whether something could not be read or made.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error.as_str()
    }

    /// The diagnostic as JSON has it.
    pub fn of(diagnostic: &Diagnostic) -> Self {
        Self {
            severity: diagnostic.severity.as_str(),
            code: diagnostic.code,
            entity: name_of(diagnostic.entity),
            face: diagnostic.face.and_then(name_of),
            message: diagnostic.message.to_string(),
        }
    }
}

impl<'a> Failure<'a> {
    /// The line for an input that came to nothing.
    pub fn new(input: &Path, error: &'a str) -> Self {
        Self { version: 1, input: input.display().to_string(), error }
    }
}

/// The diagnostics of all stages, in the order of the stages and of the file.
pub fn diagnostics<'a>(model: &'a Model, meshes: &'a [PartMesh]) -> impl Iterator<Item = &'a Diagnostic> {
    model.diagnostics.iter().chain(meshes.iter().flat_map(|mesh| &mesh.diagnostics))
}

/// Every face with its mesh and the index of its part, in the order of the file.
pub fn faces_of<'a>(
    model: &'a Model,
    meshes: &'a [PartMesh],
) -> impl Iterator<Item = (usize, &'a Face, &'a FaceMesh)> + Clone {
    let parts = model.parts.iter().zip(meshes).enumerate();
    parts.flat_map(|(index, (part, mesh))| {
        part.faces.iter().zip(&mesh.faces).map(move |(face, face_mesh)| (index, face, face_mesh))
    })
}

/// What a face is a piece of, in a word.
pub fn surface_kind(face: &Face) -> &'static str {
    match &face.geometry {
        FaceGeometry::Surface(surface) => surface.kind(),
        FaceGeometry::Facets(_) => "facets",
        FaceGeometry::Unreadable(_) => "unreadable",
    }
}

/// Why a face is not exact.
pub fn reason(status: &FaceStatus) -> Option<&str> {
    match status {
        FaceStatus::Approximated(reason) | FaceStatus::Lost(reason) => Some(reason),
        FaceStatus::Exact | FaceStatus::Empty => None,
    }
}

fn parts(model: &Model, tallies: Vec<Tally>) -> Vec<PartReport> {
    let counts = model.instance_counts();
    let parts = model.parts.iter().zip(counts).zip(tallies);
    parts.map(|((part, instances), tally)| part_report(part, instances, tally)).collect()
}

fn part_report(part: &Part, instances: usize, tally: Tally) -> PartReport {
    PartReport {
        name: part.name.clone(),
        id: part.id.clone(),
        entity: name_of(part.entity),
        instances,
        tally,
    }
}

fn faces(model: &Model, meshes: &[PartMesh]) -> Vec<FaceReport> {
    faces_of(model, meshes)
        .map(|(part, face, mesh)| FaceReport {
            entity: name_of(face.entity),
            part,
            surface: surface_kind(face),
            status: mesh.status.as_str(),
            reason: reason(&mesh.status).map(str::to_string),
            hidden: face.hidden,
            triangles: mesh.triangles.len(),
            area_mm2: mesh.area_mm2,
            max_deviation_mm: mesh.max_deviation_mm,
        })
        .collect()
}

fn name_of(entity: EntityRef) -> Option<String> {
    (entity != EntityRef::None).then(|| entity.to_string())
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use trimloop_brep::{Diagnostic, EntityRef, Face, FaceGeometry, Model, Node, Part, Severity, Source};
    use trimloop_geom::DAffine3;
    use trimloop_gltf::{Written, WrittenPart};
    use trimloop_mesh::{FaceMesh, FaceStatus, PartMesh};

    use super::Report;
    use crate::plan::{Job, Target};

    /// One part, placed once, whose only face could not be read.
    fn unreadable() -> (Model, PartMesh) {
        let face = Face {
            entity: EntityRef::Step(14),
            name: String::new(),
            geometry: FaceGeometry::Unreadable("no such surface".into()),
            same_sense: true,
            loops: Vec::new(),
            color: None,
            hidden: false,
        };
        let mesh = FaceMesh {
            status: FaceStatus::Lost("no such surface".into()),
            vertices: Vec::new(),
            triangles: Vec::new(),
            area_mm2: 0.0,
            max_deviation_mm: 0.0,
        };
        let node = Node {
            name: "Bolt".into(),
            id: "B-1".into(),
            instance_name: None,
            entity: EntityRef::Step(2),
            transform: DAffine3::IDENTITY,
            part: Some(0),
            children: Vec::new(),
            color: None,
            hidden: false,
        };
        let diagnostic =
            Diagnostic::new(Severity::Warning, "unknown-surface", EntityRef::Step(77), "An unknown surface.")
                .on_face(EntityRef::Step(14));
        let model = Model {
            source: Source { format: "step", schema: "AP214".into(), ..Source::default() },
            parts: vec![Part { name: "Bolt".into(), id: "B-1".into(), faces: vec![face], ..Part::default() }],
            nodes: vec![node],
            roots: vec![0],
            diagnostics: vec![diagnostic],
        };
        (model, PartMesh { faces: vec![mesh], ..PartMesh::default() })
    }

    fn written(with_faces: bool) -> Value {
        let (model, mesh) = unreadable();
        let job = Job { input: "a.step".into(), target: Target::Glb("a.glb".into()) };
        let written = Written { bytes: 0, parts: vec![WrittenPart::default()] };
        let report = Report::new(&job, &model, &[mesh], &written, with_faces);
        serde_json::to_value(report).expect("JSON")
    }

    #[test]
    fn the_report_has_the_documented_shape() {
        let report = written(true);
        assert_eq!(report["version"], 1);
        assert_eq!(report["input"], "a.step");
        assert_eq!(report["schema"], "AP214");
        let totals = &report["totals"];
        for key in [
            "parts",
            "instances",
            "solids",
            "faces",
            "exact",
            "approximated",
            "lost",
            "empty",
            "triangles",
            "vertices",
            "area_mm2",
            "volume_mm3",
            "closed_shells",
            "open_shells",
            "non_manifold_edges",
        ] {
            assert!(totals[key].is_number(), "totals.{key} is {}", totals[key]);
        }
        for key in ["read", "import", "mesh", "write", "total"] {
            assert!(report["seconds"][key].is_number(), "seconds.{key}");
        }
        assert_eq!((&totals["lost"], &totals["instances"]), (&json!(1), &json!(1)));
        assert_eq!(report["parts"][0]["name"], "Bolt");
        assert_eq!(report["parts"][0]["lost"], 1);
        assert_eq!(
            report["diagnostics"][0],
            json!({"severity": "warning", "code": "unknown-surface", "entity": "#77", "face": "#14",
                   "message": "An unknown surface."})
        );
    }

    #[test]
    fn faces_are_listed_where_asked_for() {
        let face = &written(true)["faces"][0];
        assert_eq!((&face["entity"], &face["part"]), (&json!("#14"), &json!(0)));
        assert_eq!((&face["status"], &face["surface"]), (&json!("lost"), &json!("unreadable")));
        assert_eq!(face["reason"], "no such surface");
        assert!(written(false).get("faces").is_none());
    }
}
