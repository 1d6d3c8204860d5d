//! Which output belongs to which input.

use std::collections::HashMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// One input and what becomes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The CAD file.
    pub input: PathBuf,
    /// Where the result goes.
    pub target: Target,
}

/// Where a result goes, and as what.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// One binary file.
    Glb(PathBuf),
    /// A JSON file, and its buffer beside it.
    Gltf {
        /// The `.gltf`.
        json: PathBuf,
        /// The `.bin`.
        bin: PathBuf,
    },
}

impl Target {
    /// The file that the user asked for.
    pub fn path(&self) -> &Path {
        match self {
            Self::Glb(path) | Self::Gltf { json: path, .. } => path,
        }
    }

    /// All files that are written.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        let bin = match self {
            Self::Glb(_) => None,
            Self::Gltf { bin, .. } => Some(bin.as_path()),
        };
        std::iter::once(self.path()).chain(bin)
    }

    fn of(path: PathBuf) -> anyhow::Result<Self> {
        let extension = path.extension().map(|e| e.to_ascii_lowercase());
        match extension.as_ref().and_then(|e| e.to_str()) {
            Some("glb") => Ok(Self::Glb(path)),
            Some("gltf") => Ok(Self::Gltf { bin: path.with_extension("bin"), json: path }),
            // `/dev/stdout`, a named pipe: no name to go by.
            _ if path.exists() => Ok(Self::Glb(path)),
            _ => bail!("cannot write `{}`: the output is a .glb, a .gltf or a folder", path.display()),
        }
    }
}

/// The jobs for `inputs`: with `output` a file for a single input, with `output` a folder one file each in it, and
/// without one beside each input.
///
/// Refuses to overwrite an input, and to write one file twice. Creates the folder.
pub fn jobs(inputs: &[PathBuf], output: Option<&Path>) -> anyhow::Result<Vec<Job>> {
    let folder = output.filter(|path| is_folder(path));
    if let (Some(path), None) = (output, folder)
        && inputs.len() > 1
    {
        bail!("several inputs need a folder as output, and `{}` is a file", path.display());
    }
    if let Some(folder) = folder {
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder `{}`", folder.display()))?;
    }
    let jobs = inputs
        .iter()
        .map(|input| {
            let target = match (folder, output) {
                (Some(folder), _) => Target::Glb(folder.join(name_for(input, "glb"))),
                (None, Some(file)) => Target::of(file.to_path_buf())?,
                (None, None) => Target::Glb(input.with_file_name(name_for(input, "glb"))),
            };
            Ok(Job { input: input.clone(), target })
        })
        .collect::<anyhow::Result<Vec<_>>>()?;
    check_collisions(&jobs)?;
    Ok(jobs)
}

/// Whether the user means a folder: an existing one, or a name with a slash at its end or without extension.
pub fn is_folder(path: &Path) -> bool {
    match fs::metadata(path) {
        Ok(metadata) => metadata.is_dir(),
        Err(_) => path.extension().is_none() || path.as_os_str().as_encoded_bytes().ends_with(b"/"),
    }
}

/// The input's name with another extension; `part.stp.gz` loses both of its own.
pub fn name_for(input: &Path, extension: &str) -> OsString {
    let mut stem = PathBuf::from(input.file_name().unwrap_or(input.as_os_str()));
    if stem.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz") || e.eq_ignore_ascii_case("zip")) {
        stem.set_extension("");
    }
    stem.set_extension(extension);
    stem.into_os_string()
}

/// The name of a file beside the one that refers to it, as a URI reference (RFC 3986).
pub fn uri_of(file: &Path) -> String {
    let name = file.file_name().unwrap_or_default().as_encoded_bytes();
    let mut uri = String::with_capacity(name.len());
    for &byte in name {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri += &format!("%{byte:02X}");
        }
    }
    uri
}

/// The path with its links and dots resolved as far as it exists, so that equal files have equal paths.
pub fn resolved(path: &Path) -> PathBuf {
    if let Ok(path) = fs::canonicalize(path) {
        return path;
    }
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (fs::canonicalize(parent), path.file_name()) {
        (Ok(parent), Some(name)) => parent.join(name),
        _ => path.to_path_buf(),
    }
}

fn check_collisions(jobs: &[Job]) -> anyhow::Result<()> {
    let inputs: HashMap<_, _> = jobs.iter().map(|job| (resolved(&job.input), &job.input)).collect();
    let mut written: HashMap<PathBuf, &Path> = HashMap::new();
    for job in jobs {
        for file in job.target.files() {
            let resolved = resolved(file);
            if inputs.contains_key(&resolved) {
                bail!("the output `{}` is an input", file.display());
            }
            if let Some(other) = written.insert(resolved, &job.input) {
                let (file, input) = (file.display(), job.input.display());
                bail!("`{}` and `{input}` would both be written to `{file}`", other.display());
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::{Target, jobs, name_for, uri_of};

    fn paths(names: &[&str]) -> Vec<PathBuf> {
        names.iter().map(PathBuf::from).collect()
    }

    #[test]
    fn the_default_is_beside_the_input() {
        let jobs = jobs(&paths(&["a/b.step"]), None).expect("jobs");
        assert_eq!(jobs[0].target, Target::Glb("a/b.glb".into()));
    }

    #[test]
    fn packed_files_lose_both_extensions() {
        assert_eq!(name_for(Path::new("x/part.v2.stp.gz"), "glb"), "part.v2.glb");
        assert_eq!(name_for(Path::new("part.stpz"), "glb"), "part.glb");
    }

    #[test]
    fn a_uri_has_no_blanks_and_no_umlauts() {
        assert_eq!(uri_of(Path::new("web/Geh\u{e4}use 2#b.bin")), "Geh%C3%A4use%202%23b.bin");
    }

    #[test]
    fn the_extension_tells_the_kind() {
        let gltf = jobs(&paths(&["b.step"]), Some(Path::new("web.x.GLTF"))).expect("jobs");
        assert_eq!(gltf[0].target, Target::Gltf { json: "web.x.GLTF".into(), bin: "web.x.bin".into() });
        assert!(jobs(&paths(&["b.step"]), Some(Path::new("b.obj"))).is_err());
    }

    #[test]
    fn a_folder_takes_one_file_each_and_is_made() {
        let scratch = tempfile::tempdir().expect("a folder");
        let out = scratch.path().join("new/out");
        let jobs = jobs(&paths(&["a.step", "b.stp"]), Some(&out)).expect("jobs");
        assert_eq!(jobs[1].target, Target::Glb(out.join("b.glb")));
        assert!(out.is_dir());
    }

    #[test]
    fn several_inputs_do_not_fit_one_file() {
        assert!(jobs(&paths(&["a.step", "b.step"]), Some(Path::new("out.glb"))).is_err());
    }

    #[test]
    fn one_output_is_not_written_twice() {
        for inputs in [["a.step", "a.stp"], ["a.step", "a.step"], ["a.step", "./a.step"]] {
            assert!(jobs(&paths(&inputs), None).is_err(), "{inputs:?}");
        }
    }

    #[test]
    fn an_input_is_not_overwritten() {
        let scratch = tempfile::tempdir().expect("a folder");
        let input = scratch.path().join("part.glb");
        fs::write(&input, "ISO-10303-21;").expect("written");
        assert!(jobs(std::slice::from_ref(&input), None).is_err());
        assert!(jobs(std::slice::from_ref(&input), Some(&input)).is_err());
    }
}
