//! The models in `fixtures/` and what is known to be true of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

/// A model in `fixtures/`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fixture {
    /// Folder and name, without extension but for containers: `cadquery/torus`, `hand/packed.stpz`.
    pub name: String,
    /// The file.
    pub path: PathBuf,
}

/// What is true of a fixture; what is not known is absent.
#[derive(Clone, Debug, Deserialize)]
pub struct Reference {
    /// Area of all placed faces.
    pub area_mm2: Option<f64>,
    /// Volume of all placed solids.
    pub volume_mm3: Option<f64>,
    /// Lower and upper corner.
    pub bbox_mm: Option<[[f64; 3]; 2]>,
    /// Whether the model is solids and nothing else, all of them valid.
    #[serde(default)]
    pub closed: bool,
    /// Placed solids.
    pub solids: Option<usize>,
    /// Placed faces, without those that the file hides.
    pub faces: Option<usize>,
    /// By how much the file's geometry disagrees with itself.
    #[serde(default)]
    pub sloppy_mm: f64,
    /// Each face once.
    #[serde(default)]
    pub face_areas_mm2: Vec<FaceReference>,
    /// Centroid of the area; of no area there is none.
    pub area_centroid_mm: Option<[Option<f64>; 3]>,
    /// The assembly tree.
    #[serde(default)]
    pub tree: Vec<TreeReference>,
    /// Each part once.
    #[serde(default)]
    pub parts: Vec<PartReference>,
    /// Area by colour (`#rrggbbaa`, sRGB; `none` where there is none).
    #[serde(default)]
    pub colours: BTreeMap<String, f64>,
}

/// What is true of a face.
#[derive(Clone, Debug, Deserialize)]
pub struct FaceReference {
    /// The file's own name for it.
    pub entity: String,
    /// Its area.
    pub area_mm2: f64,
}

/// What is true of a node of the assembly tree.
#[derive(Clone, Debug, Deserialize)]
pub struct TreeReference {
    /// The product's name.
    pub name: String,
    /// The nodes below.
    #[serde(default)]
    pub children: Vec<Self>,
}

/// What is true of a part.
#[derive(Clone, Debug, Deserialize)]
pub struct PartReference {
    /// The product's name.
    pub name: String,
    /// How often it is placed.
    pub instances: usize,
}

impl Fixture {
    /// What is known of it, if anything.
    ///
    /// # Panics
    ///
    /// Where the reference is not what `fixtures/README.md` says.
    pub fn reference(&self) -> Option<Reference> {
        let path = folder().join(format!("{}.reference.json", self.name));
        let text = fs::read_to_string(&path).ok()?;
        Some(serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
    }
}

/// All fixtures, by name.
pub fn all() -> Vec<Fixture> {
    let mut found = Vec::new();
    collect(&folder(), &mut found);
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// The fixture of that name.
///
/// # Panics
///
/// Where there is none.
pub fn named(name: &str) -> Fixture {
    all().into_iter().find(|f| f.name == name).unwrap_or_else(|| panic!("there is no fixture {name}"))
}

/// The folder of the fixtures.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("fixtures")
}

fn collect(folder: &Path, found: &mut Vec<Fixture>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, found);
        } else if let Some(name) = name_of(&path) {
            found.push(Fixture { name, path });
        }
    }
}

/// `cadquery/torus` for the path of `cadquery/torus.step`, the whole `hand/packed.stpz` for a container; nothing for what
/// is no CAD file.
fn name_of(path: &Path) -> Option<String> {
    let name = path.strip_prefix(folder()).ok()?.to_str()?.replace('\\', "/");
    let plain =
        [".step", ".stp", ".p21", ".igs", ".iges"].iter().find_map(|extension| name.strip_suffix(extension));
    let packed = [".stpz", ".gz", ".zip"].iter().any(|extension| name.ends_with(extension));
    plain.map(str::to_string).or_else(|| packed.then(|| name.clone()))
}
