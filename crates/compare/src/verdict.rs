//! Whether what differs is more than is allowed, and whose fault that seems to be.

use serde::{Deserialize, Serialize};

use crate::comparison::{Comparison, FaceDistances};

/// A length, or a share of the diagonal of A's box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Reach {
    /// Millimetres.
    Mm(f64),
    /// A share (0.001 = 0.1 %).
    Share(f64),
}

impl Reach {
    /// In millimetres.
    pub fn mm(self, diagonal_mm: f64) -> f64 {
        match self {
            Self::Mm(mm) => mm,
            Self::Share(share) => share * diagonal_mm,
        }
    }
}

/// What is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gates {
    /// The largest distance, both ways.
    pub max_distance: Reach,
    /// The largest difference of the areas, as a share of A's.
    pub max_area: f64,
    /// The largest difference of the volumes, as a share of A's; where both sides close.
    pub max_volume: f64,
    /// Whether both sides must close.
    pub watertight: bool,
}

impl Default for Gates {
    /// 0.5 % of the diagonal; 1 % of area and volume.
    fn default() -> Self {
        Self { max_distance: Reach::Share(0.005), max_area: 0.01, max_volume: 0.01, watertight: false }
    }
}

/// The end of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Within the gates.
    Same,
    /// Outside.
    Different,
    /// Outside, and all that speaks for it is that the reference mesh leaves the exact surface or misses faces.
    ReferenceSuspect,
}

impl Verdict {
    /// `same`, `different`, `reference suspect`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Different => "different",
            Self::ReferenceSuspect => "reference suspect",
        }
    }
}

/// A gate and what came.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Gate {
    /// `distance`, `area`, `volume`, `watertight`, `orientation`, `faces`.
    pub name: &'static str,
    /// What came.
    pub found: f64,
    /// What is allowed.
    pub allowed: f64,
    /// `mm`, `share`, `faces`, `edges`.
    pub unit: &'static str,
    /// Whether it is kept.
    pub kept: bool,
}

/// The verdict and what it rests on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// Every gate.
    pub gates: Vec<Gate>,
    /// Why, in sentences.
    pub reasons: Vec<String>,
}

/// Judges a comparison by what is allowed.
pub fn judge(found: &Comparison, gates: &Gates) -> Judgement {
    let near_mm = gates.max_distance.mm(found.diagonal_mm);
    let mut list = vec![gate("distance", found.a_to_b.max_mm.max(found.b_to_a.max_mm), near_mm, "mm")];
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (b / a - 1.0).abs() };
    let (a, b) = (&found.a, &found.b);
    list.push(gate("area", relative(a.figures.area_mm2, b.figures.area_mm2), gates.max_area, "share"));
    if a.topology.is_watertight() && b.topology.is_watertight() {
        let off = relative(a.figures.volume_mm3, b.figures.volume_mm3);
        list.push(gate("volume", off, gates.max_volume, "share"));
    }
    if gates.watertight {
        let open = |side: &crate::comparison::Side| {
            side.topology.open_edges + side.topology.non_manifold_edges + side.topology.flipped_edges
        };
        list.push(gate("watertight", (open(a) + open(b)) as f64, 0.0, "edges"));
    }
    let turned = found.faces.iter().filter(|face| is_turned(face)).count();
    list.push(gate("orientation", turned as f64, 0.0, "faces"));
    // Where one side is of a piece, the other one must be too.
    let (flipped_a, flipped_b) = (a.topology.flipped_edges, b.topology.flipped_edges);
    list.push(gate("flipped", flipped_a.max(flipped_b) as f64, flipped_a.min(flipped_b) as f64, "edges"));
    list.push(gate("faces", (a.lost.len() + b.lost.len()) as f64, 0.0, "faces"));
    let kept = list.iter().all(|gate| gate.kept);
    let suspicion = if kept { None } else { suspicion(found, near_mm) };
    let verdict = match (kept, &suspicion) {
        (true, _) => Verdict::Same,
        (false, Some(_)) => Verdict::ReferenceSuspect,
        (false, None) => Verdict::Different,
    };
    let mut reasons: Vec<String> = suspicion.into_iter().collect();
    if !kept {
        reasons.extend(differences(found, near_mm));
    }
    Judgement { verdict, gates: list, reasons }
}

fn gate(name: &'static str, found: f64, allowed: f64, unit: &'static str) -> Gate {
    Gate { name, found, allowed, unit, kept: found <= allowed }
}

fn is_turned(face: &FaceDistances) -> bool {
    face.turned > 0.5
}

/// What speaks against the reference alone; nothing where the model may be what has changed.
fn suspicion(found: &Comparison, near_mm: f64) -> Option<String> {
    let (a, b) = (&found.a, &found.b);
    let sound = a.exact && !b.exact && a.lost.is_empty() && a.deviation_mm <= near_mm;
    if !sound || found.mirrored.is_some() {
        return None;
    }
    if found.b_to_a.max_mm <= near_mm && b.topology.open_edges > a.topology.open_edges {
        let missing: Vec<&str> =
            found.faces.iter().filter(|face| face.covered < 0.5).map(|face| face.name.as_str()).collect();
        let rest_is_covered =
            found.faces.iter().all(|face| face.covered < 0.5 || face.distances.p999_mm <= near_mm);
        if !missing.is_empty() && rest_is_covered {
            let names = listed(&missing);
            return Some(format!(
                "The reference misses {} of {} faces ({names}) and is open there; all that it has lies on the model.",
                missing.len(),
                found.faces.len()
            ));
        }
    }
    let same_topology = b.topology.genus == a.topology.genus
        && b.topology.components == a.topology.components
        && b.topology.is_watertight() == a.topology.is_watertight();
    let off = |face: &&FaceDistances| face.distances.max_mm > near_mm || face.back_max_mm > near_mm;
    let touched = found.faces.iter().filter(off).all(|face| face.corners >= 3);
    if found.b_corners_to_a.max_mm <= near_mm
        && same_topology
        && touched
        && !found.faces.iter().any(is_turned)
    {
        return Some(format!(
            "The reference leaves the exact surface between its corners, which all lie on it within {:.3} mm: it is coarser than the gate.",
            found.b_corners_to_a.max_mm
        ));
    }
    None
}

/// What differs, the most striking first.
fn differences(found: &Comparison, near_mm: f64) -> Vec<String> {
    let mut out = Vec::new();
    if let Some(plane) = &found.mirrored {
        out.push(format!("B is the mirror image of A in {plane}."));
    }
    for (side, name) in [(&found.a, "A"), (&found.b, "B")] {
        out.extend(
            side.lost.first().map(|first| {
                format!("{} faces of {name} could not be meshed, e.g. {first}.", side.lost.len())
            }),
        );
    }
    let turned: Vec<&str> = found.faces.iter().filter(|f| is_turned(f)).map(|f| f.name.as_str()).collect();
    if turned.len() == found.faces.len() && !turned.is_empty() {
        out.push("The two sides face opposite ways everywhere: one of them is inside out.".to_owned());
    } else if !turned.is_empty() {
        out.push(format!("Faces that the other side has turned over: {}.", listed(&turned)));
    }
    for (own, other, name) in [(&found.a, &found.b, "A"), (&found.b, &found.a, "B")] {
        if own.topology.flipped_edges > other.topology.flipped_edges {
            let edges = own.topology.flipped_edges;
            out.push(format!("Neighbouring triangles of {name} face opposite ways at {edges} edges."));
        }
    }
    let missing: Vec<&str> =
        found.faces.iter().filter(|f| f.covered < 0.01).map(|f| f.name.as_str()).collect();
    if !missing.is_empty() {
        out.push(format!("Faces that the other side has nothing near: {}.", listed(&missing)));
    }
    let mut far: Vec<(f64, &FaceDistances)> = found
        .faces
        .iter()
        .map(|face| (face.distances.max_mm.max(face.back_max_mm), face))
        .filter(|(off, _)| *off > near_mm)
        .collect();
    far.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (off, face) in far.iter().take(5) {
        let part = if face.part.is_empty() { String::new() } else { format!(" of {}", face.part) };
        out.push(format!("{} ({}){part}: up to {off:.4} mm apart.", face.name, face.surface));
    }
    if far.len() > 5 {
        out.push(format!("… and {} faces more.", far.len() - 5));
    }
    out
}

fn listed(names: &[&str]) -> String {
    let named = |name: &&str| if name.is_empty() { "(unnamed)".to_owned() } else { (*name).to_owned() };
    let shown = names.iter().take(8).map(named).collect::<Vec<_>>().join(", ");
    if names.len() > 8 { format!("{shown}, …") } else { shown }
}
