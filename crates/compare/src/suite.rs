//! Suites: lists of models and the shapes that they are held against.
//!
//! A folder is a suite: every CAD file in it (and below) with a mesh of the same name beside it. A TOML file says more:
//!
//! ```toml
//! name = "brackets"
//! baseline = "baseline.json"        # beside the suite
//!
//! [gates]                           # of every case that has none of its own
//! max-distance = "0.3%"
//! max-area = "1%"
//! max-volume = "1%"
//! watertight = false
//!
//! [[case]]
//! input = "bracket.step"
//! reference = "exports/bracket.stl"
//! name = "bracket"                  # else the reference's path
//! tags = ["cadquery"]
//! max-distance = "0.05mm"
//! known = { verdict = "different", reason = "exported before the fillet was added" }
//!
//! [[pattern]]                       # a case for every input that has the reference
//! input = "parts/*.step"
//! reference = "exports/{name}.stl"
//! tags = ["freecad"]
//! ```

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde::Deserialize;

use crate::read::is_mesh_extension;
use crate::verdict::{Gates, Reach, Verdict};

/// Models and what they are held against.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite {
    /// Its name.
    pub name: String,
    /// Where its baseline is kept.
    pub baseline: PathBuf,
    /// Its cases, in order.
    pub cases: Vec<Case>,
    /// Inputs that patterns found and that have no reference.
    pub without_reference: usize,
}

/// A model and what it is held against.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Its name, unlike that of any other case.
    pub name: String,
    /// The model.
    pub input: PathBuf,
    /// What it is held against.
    pub reference: PathBuf,
    /// What is allowed.
    pub gates: Gates,
    /// Words to choose cases by.
    pub tags: Vec<String>,
    /// The difference that is expected, and why.
    pub known: Option<Known>,
    /// The unit of the reference, as the command line has it.
    pub unit: Option<String>,
    /// The axis that points up in the reference, as the command line has it.
    pub up: Option<String>,
}

/// A difference that is expected.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// Which.
    #[serde(default = "different")]
    pub verdict: Verdict,
    /// Why, in a sentence.
    pub reason: String,
}

fn different() -> Verdict {
    Verdict::Different
}

/// Why a suite cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// It cannot be read.
    #[error("cannot read `{0}`: {1}")]
    Io(PathBuf, std::io::Error),
    /// It is no TOML, or says what is not known.
    #[error("`{0}`: {1}")]
    Toml(PathBuf, Box<toml::de::Error>),
    /// It says what cannot be.
    #[error("{0}")]
    Wrong(String),
}

/// Lengths and shares as text, by the caller's rules.
pub trait Quantities {
    /// `0.1mm`, `0.1%`.
    fn reach(&self, text: &str) -> Result<Reach, String>;
    /// `1%`, `0.01`.
    fn share(&self, text: &str) -> Result<f64, String>;
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct File {
    name: Option<String>,
    baseline: Option<PathBuf>,
    #[serde(default)]
    gates: GateText,
    #[serde(default)]
    case: Vec<CaseText>,
    #[serde(default)]
    pattern: Vec<CaseText>,
}

#[derive(Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct GateText {
    max_distance: Option<String>,
    max_area: Option<String>,
    max_volume: Option<String>,
    watertight: Option<bool>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct CaseText {
    name: Option<String>,
    input: String,
    reference: String,
    #[serde(default)]
    tags: Vec<String>,
    known: Option<Known>,
    unit: Option<String>,
    up: Option<String>,
    max_distance: Option<String>,
    max_area: Option<String>,
    max_volume: Option<String>,
    watertight: Option<bool>,
}

impl Suite {
    /// Reads a suite: a folder, or a TOML file. `gates` are those of cases that say nothing else.
    ///
    /// # Errors
    ///
    /// Where it cannot be read, says what is not known, or holds no case.
    pub fn read(path: &Path, gates: Gates, quantities: &dyn Quantities) -> Result<Self, SuiteError> {
        let suite = if path.is_dir() {
            let inner = path.join("suite.toml");
            if inner.is_file() {
                Self::of_file(&inner, gates, quantities)?
            } else {
                Self::of_folder(path, gates)?
            }
        } else {
            Self::of_file(path, gates, quantities)?
        };
        if suite.cases.is_empty() {
            return Err(SuiteError::Wrong(format!(
                "`{}` holds no case: no CAD file with a mesh to hold it against",
                path.display()
            )));
        }
        let mut seen: BTreeMap<&str, ()> = BTreeMap::new();
        for case in &suite.cases {
            if seen.insert(&case.name, ()).is_some() {
                return Err(SuiteError::Wrong(format!("two cases have the name `{}`", case.name)));
            }
        }
        Ok(suite)
    }

    fn of_folder(folder: &Path, gates: Gates) -> Result<Self, SuiteError> {
        let mut files = Vec::new();
        collect(folder, &mut files)?;
        files.sort();
        let mut cases = Vec::new();
        let mut without_reference = 0;
        for input in files.iter().filter(|path| is_cad_extension(path)) {
            let stem = input.with_extension("");
            let own: Vec<&PathBuf> = files
                .iter()
                .filter(|path| is_mesh_extension(path) && path.with_extension("") == stem)
                .collect();
            without_reference += usize::from(own.is_empty());
            for reference in own {
                let name = reference.strip_prefix(folder).unwrap_or(reference).display().to_string();
                cases.push(Case {
                    name: name.replace('\\', "/"),
                    input: input.clone(),
                    reference: reference.clone(),
                    gates,
                    tags: Vec::new(),
                    known: None,
                    unit: None,
                    up: None,
                });
            }
        }
        let name =
            folder.file_name().map_or_else(|| "suite".to_owned(), |name| name.to_string_lossy().into_owned());
        Ok(Self { name, baseline: folder.join("baseline.json"), cases, without_reference })
    }

    fn of_file(path: &Path, gates: Gates, quantities: &dyn Quantities) -> Result<Self, SuiteError> {
        let text = std::fs::read_to_string(path).map_err(|error| SuiteError::Io(path.to_owned(), error))?;
        let file: File =
            toml::from_str(&text).map_err(|error| SuiteError::Toml(path.to_owned(), Box::new(error)))?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let usual = apply(gates, &file.gates, quantities)?;
        let mut cases = Vec::new();
        for case in &file.case {
            let name = case.name.clone().unwrap_or_else(|| case.reference.clone());
            cases.push(case.case(
                name,
                folder.join(&case.input),
                folder.join(&case.reference),
                usual,
                quantities,
            )?);
        }
        let mut bare: BTreeSet<PathBuf> = BTreeSet::new();
        for pattern in &file.pattern {
            // The folder itself is no pattern.
            let wanted =
                Path::new(&glob::Pattern::escape(&folder.display().to_string())).join(&pattern.input);
            let wanted = wanted.display().to_string();
            let found =
                glob::glob(&wanted).map_err(|error| SuiteError::Wrong(format!("`{wanted}`: {error}")))?;
            for input in found.filter_map(Result::ok).filter(|input| is_cad_extension(input)) {
                let stem = input.file_stem().unwrap_or_default().to_string_lossy();
                let reference = pattern.reference.replace("{name}", &stem);
                let path = folder.join(&reference);
                // Cases of their own go before patterns.
                if cases.iter().any(|case: &Case| case.input == input && case.reference == path) {
                    continue;
                }
                if path.is_file() {
                    cases.push(pattern.case(reference, input, path, usual, quantities)?);
                } else {
                    bare.insert(input);
                }
            }
        }
        // Of several patterns one is enough.
        bare.retain(|input| !cases.iter().any(|case| case.input == *input));
        let without_reference = bare.len();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            name: file.name.unwrap_or(stem),
            baseline: folder.join(file.baseline.unwrap_or_else(|| "baseline.json".into())),
            cases,
            without_reference,
        })
    }
}

impl CaseText {
    fn case(
        &self,
        name: String,
        input: PathBuf,
        reference: PathBuf,
        usual: Gates,
        quantities: &dyn Quantities,
    ) -> Result<Case, SuiteError> {
        let own = GateText {
            max_distance: self.max_distance.clone(),
            max_area: self.max_area.clone(),
            max_volume: self.max_volume.clone(),
            watertight: self.watertight,
        };
        let gates = apply(usual, &own, quantities)?;
        let Self { tags, known, unit, up, .. } = self.clone();
        Ok(Case { name, input, reference, gates, tags, known, unit, up })
    }
}

fn apply(gates: Gates, text: &GateText, quantities: &dyn Quantities) -> Result<Gates, SuiteError> {
    let wrong = |text: &str, error: String| SuiteError::Wrong(format!("`{text}` is no gate: {error}"));
    let share = |text: &Option<String>, usual: f64| match text {
        Some(text) => quantities.share(text).map_err(|error| wrong(text, error)),
        None => Ok(usual),
    };
    Ok(Gates {
        max_distance: match &text.max_distance {
            Some(text) => quantities.reach(text).map_err(|error| wrong(text, error))?,
            None => gates.max_distance,
        },
        max_area: share(&text.max_area, gates.max_area)?,
        max_volume: share(&text.max_volume, gates.max_volume)?,
        watertight: text.watertight.unwrap_or(gates.watertight),
    })
}

fn is_cad_extension(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    [".step", ".stp", ".p21", ".stpz", ".stp.gz", ".step.gz", ".igs", ".iges"]
        .iter()
        .any(|end| name.ends_with(end))
}

fn collect(folder: &Path, out: &mut Vec<PathBuf>) -> Result<(), SuiteError> {
    let failed = |error| SuiteError::Io(folder.to_owned(), error);
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        // Links to folders could lead in circles.
        let kind = entry.file_type().map_err(failed)?;
        if kind.is_dir() {
            collect(&entry.path(), out)?;
        } else {
            out.push(entry.path());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    struct Plain;

    impl Quantities for Plain {
        fn reach(&self, text: &str) -> Result<Reach, String> {
            text.trim_end_matches("mm").parse().map(Reach::Mm).map_err(|_| "a length is wanted".to_owned())
        }

        fn share(&self, text: &str) -> Result<f64, String> {
            text.parse().map_err(|_| "a share is wanted".to_owned())
        }
    }

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for file in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().expect("a parent")).expect("made");
            fs::write(path, "").expect("written");
        }
        folder
    }

    #[test]
    fn a_folder_pairs_files_of_one_name() {
        let folder = folder(&["a.step", "a.stl", "a.glb", "sub/b.igs", "sub/b.obj", "c.stp", "notes.txt"]);
        let suite = Suite::read(folder.path(), Gates::default(), &Plain).expect("a suite");
        let names: Vec<&str> = suite.cases.iter().map(|case| case.name.as_str()).collect();
        assert_eq!(names, ["a.glb", "a.stl", "sub/b.obj"]);
        assert_eq!(suite.without_reference, 1);
    }

    #[test]
    fn a_file_says_more() {
        let folder = folder(&["p/a.step", "p/b.step", "p/c.step", "x/a.stl", "x/b.stl"]);
        let text = r#"
            [gates]
            max-distance = "0.2mm"
            [[case]]
            input = "p/a.step"
            reference = "x/a.stl"
            max-area = "0.5"
            known = { reason = "old" }
            [[pattern]]
            input = "p/*.step"
            reference = "x/{name}.stl"
            tags = ["t"]
        "#;
        let path = folder.path().join("s.toml");
        fs::write(&path, text).expect("written");
        let suite = Suite::read(&path, Gates::default(), &Plain).expect("a suite");
        assert_eq!((suite.cases.len(), suite.without_reference), (2, 1));
        assert_eq!(suite.cases[0].gates.max_distance, Reach::Mm(0.2));
        assert_eq!(suite.cases[0].gates.max_area, 0.5);
        assert_eq!(suite.cases[0].known.as_ref().map(|known| known.verdict), Some(Verdict::Different));
        assert_eq!((suite.cases[1].name.as_str(), suite.cases[1].tags.len()), ("x/b.stl", 1));
    }

    #[test]
    fn mistakes_are_named() {
        let folder = folder(&["a.step"]);
        let path = folder.path().join("s.toml");
        for (text, word) in [
            ("[[case]]\ninput = 'a.step'\nreference = 'a.stl'\ngate = 1", "gate"),
            ("[[case]]\ninput = 'a.step'\nreference = 'a.stl'\nmax-distance = 'far'", "far"),
            (
                "[[case]]\ninput = 'a.step'\nreference = 'a'\n[[case]]\ninput = 'a.step'\nreference = 'a'",
                "two cases",
            ),
            ("", "no case"),
        ] {
            fs::write(&path, text).expect("written");
            let error = Suite::read(&path, Gates::default(), &Plain).expect_err("a mistake").to_string();
            assert!(error.contains(word), "{error}");
        }
    }
}
