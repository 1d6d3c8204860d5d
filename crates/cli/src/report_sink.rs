//! Where reports go.

use std::collections::HashMap;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::Serialize;

use crate::draft::{self, Draft};
use crate::plan::{self, Job};
use crate::report::{Failure, Report};

/// Where reports go.
pub enum ReportSink {
    /// Nowhere.
    None,
    /// One file, for one input.
    File(PathBuf),
    /// One file per input in a folder.
    Folder(PathBuf),
    /// One line per input in a file.
    Lines(Draft),
    /// One line per input on standard output.
    StandardOutput,
}

impl ReportSink {
    /// Takes the user's word for it: `-`, a `.jsonl`, a folder, or, for a single input, a file.
    ///
    /// Refuses a report in the place of an input, an output or another report.
    pub fn open(path: Option<&Path>, jobs: &[Job]) -> anyhow::Result<Self> {
        let Some(path) = path else { return Ok(Self::None) };
        let sink = if path == Path::new("-") {
            return Ok(Self::StandardOutput);
        } else if plan::is_folder(path) {
            fs::create_dir_all(path)
                .with_context(|| format!("cannot create the folder `{}`", path.display()))?;
            Self::Folder(path.to_path_buf())
        } else if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("jsonl")) {
            refuse_collisions(&[path.to_path_buf()], jobs)?;
            return Ok(Self::Lines(Draft::beside(path)?));
        } else if jobs.len() > 1 {
            bail!("several inputs need a folder or a .jsonl for reports, not `{}`", path.display());
        } else {
            Self::File(path.to_path_buf())
        };
        let files: Vec<_> = jobs.iter().filter_map(|job| sink.file(job)).collect();
        refuse_collisions(&files, jobs)?;
        Ok(sink)
    }

    /// The file for the report on `job`, where it has one of its own.
    fn file(&self, job: &Job) -> Option<PathBuf> {
        match self {
            Self::File(path) => Some(path.clone()),
            Self::Folder(folder) => Some(folder.join(plan::name_for(&job.input, "json"))),
            Self::None | Self::Lines(_) | Self::StandardOutput => None,
        }
    }

    /// Writes a report; a file of its own is returned for the caller to publish together with the output.
    pub fn add(&mut self, job: &Job, report: &Report) -> anyhow::Result<Option<Draft>> {
        if let Some(path) = self.file(job) {
            let mut draft = Draft::beside(&path)?;
            write_line(&mut draft, report).with_context(|| format!("cannot write `{}`", path.display()))?;
            return Ok(Some(draft));
        }
        self.add_line(report)?;
        Ok(None)
    }

    /// Notes that `job` came to nothing: a line where there are lines, else nothing.
    pub fn add_failure(&mut self, job: &Job, error: &str) -> anyhow::Result<()> {
        self.add_line(&Failure::new(&job.input, error))
    }

    fn add_line(&mut self, line: &impl Serialize) -> anyhow::Result<()> {
        match self {
            Self::Lines(draft) => write_line(draft, line)
                .with_context(|| format!("cannot write `{}`", draft.target().display())),
            Self::StandardOutput => {
                write_line(&mut io::stdout().lock(), line).context("cannot write to standard output")
            }
            Self::None | Self::File(_) | Self::Folder(_) => Ok(()),
        }
    }

    /// Puts the file of lines in its place.
    pub fn finish(self) -> anyhow::Result<()> {
        match self {
            Self::Lines(draft) => draft::publish(vec![draft]),
            _ => Ok(()),
        }
    }
}

fn write_line(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *out, value).map_err(io::Error::from)?;
    out.write_all(b"\n")?;
    out.flush()
}

fn refuse_collisions(reports: &[PathBuf], jobs: &[Job]) -> anyhow::Result<()> {
    let mut taken: HashMap<PathBuf, &str> = HashMap::new();
    for job in jobs {
        taken.insert(plan::resolved(&job.input), "an input");
        taken.extend(job.target.files().map(|file| (plan::resolved(file), "the output")));
    }
    for report in reports {
        if let Some(what) = taken.insert(plan::resolved(report), "another report") {
            bail!("the report `{}` is {what}", report.display());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::ReportSink;
    use crate::plan::jobs;

    fn open(report: &Path, inputs: &[&str]) -> anyhow::Result<ReportSink> {
        let inputs: Vec<_> = inputs.iter().map(PathBuf::from).collect();
        ReportSink::open(Some(report), &jobs(&inputs, None)?)
    }

    #[test]
    fn several_inputs_need_a_folder_or_lines() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(open(&folder.path().join("all.json"), &["a.step", "b.step"]).is_err());
        assert!(matches!(open(folder.path(), &["a.step", "b.step"]), Ok(ReportSink::Folder(_))));
        let lines = folder.path().join("all.jsonl");
        assert!(matches!(open(&lines, &["a.step", "b.step"]), Ok(ReportSink::Lines(_))));
    }

    #[test]
    fn a_report_takes_no_other_files_place() {
        assert!(open(Path::new("a.step"), &["a.step"]).is_err());
        assert!(open(Path::new("a.glb"), &["a.step"]).is_err());
        let folder = tempfile::tempdir().expect("a folder");
        assert!(open(folder.path(), &["a/x.step", "b/x.step"]).is_err());
    }
}
