//! `trimloop convert`: file to exact model to triangles to glTF, and the truth about it.

use std::io::Write;
use std::time::Instant;

use anyhow::{Context, bail};
use rayon::prelude::*;
use trimloop_brep::Model;
use trimloop_gltf::{GltfOptions, Written};
use trimloop_import::{ImportOptions, Parsed};
use trimloop_mesh::{Cancelled, MeshOptions, PartMesh};

use crate::arguments::ConvertArguments;
use crate::contained::contained;
use crate::draft::{self, Draft};
use crate::interrupt;
use crate::message;
use crate::outcome::Outcome;
use crate::plan::{self, Job, Target};
use crate::progress::Progress;
use crate::report::{self, DiagnosticReport, Report, Seconds};
use crate::report_sink::ReportSink;
use crate::summary;
use crate::threads;

/// Converts every input; the worst outcome is that of the run.
pub fn run(arguments: &ConvertArguments) -> anyhow::Result<Outcome> {
    let jobs = plan::jobs(&arguments.inputs, arguments.output.as_deref())?;
    let mut reports = ReportSink::open(arguments.report.as_deref(), &jobs)?;
    interrupt::listen()?;
    threads::start(arguments.jobs)?;
    let mut worst = Outcome::Good;
    for job in &jobs {
        // On a worker: a main thread would only wait for them, and wake them up again and again.
        let outcome = match contained(|| rayon::scope(|_| convert(job, arguments, &mut reports))) {
            Ok(outcome) => outcome,
            Err(_) if interrupt::requested() => {
                worst = Outcome::Cancelled;
                break;
            }
            Err(error) => {
                let message = message::of(&error);
                eprintln!("error: {}: {message}", job.input.display());
                reports.add_failure(job, &message)?;
                Outcome::Failed
            }
        };
        worst = worst.max(outcome);
    }
    reports.finish()?;
    Ok(worst)
}

/// One file, from beginning to end.
fn convert(job: &Job, arguments: &ConvertArguments, reports: &mut ReportSink) -> anyhow::Result<Outcome> {
    // Now rather than after minutes of work: can the output be written?
    job.target.files().try_for_each(|file| Draft::beside(file).map(drop))?;
    let mut clock = Clock::start();
    let parsed = Parsed::read(&job.input, &ImportOptions::default())?;
    let read = clock.lap()?;
    let mut model = parsed.import()?;
    drop(parsed);
    if !arguments.skip_hidden {
        model.show_hidden();
    }
    let import = clock.lap()?;
    let meshes = mesh(&model, &arguments.mesh_options(), arguments.quiet)?;
    let mesh = clock.lap()?;
    let (mut drafts, content) = write(&job.target, &model, &meshes, &arguments.gltf_options())?;
    let write = clock.lap()?;

    let mut report = Report::new(job, &model, &meshes, &content, arguments.report_faces);
    report.bytes = std::fs::metadata(&job.input).map_or(0, |metadata| metadata.len());
    report.seconds = Seconds { read, import, mesh, write, total: read + import + mesh + write };
    refuse_nothing(&report, &model, &meshes)?;
    drafts.extend(reports.add(job, &report)?);
    draft::publish(drafts)?;
    if !arguments.quiet {
        eprint!("{}", summary::of(&report, &model, &meshes, arguments.verbose));
    }
    // The next file need not wait until the memory is given back, nor need the end.
    rayon::spawn(move || drop((model, meshes)));
    Ok(outcome(&report, arguments.strict))
}

/// The triangles of every part, each part once, in the model's order.
fn mesh(model: &Model, options: &MeshOptions, quiet: bool) -> Result<Vec<PartMesh>, Cancelled> {
    let progress = Progress::new(model.parts.iter().map(|part| part.faces.len()).sum(), quiet);
    model.parts.par_iter().map(|part| trimloop_mesh::mesh_part(part, options, &progress)).collect()
}

/// The output's files, not yet in their places, and what they hold.
fn write(
    target: &Target,
    model: &Model,
    meshes: &[PartMesh],
    options: &GltfOptions,
) -> anyhow::Result<(Vec<Draft>, Written)> {
    let mut main = Draft::beside(target.path())?;
    let failed = || format!("cannot write `{}`", target.path().display());
    match target {
        Target::Glb(_) => {
            let written = trimloop_gltf::write_glb(model, meshes, options, &mut main).with_context(failed)?;
            main.flush().with_context(failed)?;
            Ok((vec![main], written))
        }
        Target::Gltf { bin, .. } => {
            let mut buffer = Draft::beside(bin)?;
            let uri = plan::uri_of(bin);
            let written = trimloop_gltf::write_gltf(model, meshes, options, &uri, &mut main, &mut buffer)
                .with_context(failed)?;
            buffer.flush().with_context(failed)?;
            main.flush().with_context(failed)?;
            // The buffer first: a reader that finds the .gltf finds its buffer too.
            Ok((vec![buffer, main], written))
        }
    }
}

/// Fails where the output would show nothing.
fn refuse_nothing(report: &Report, model: &Model, meshes: &[PartMesh]) -> anyhow::Result<()> {
    let tally = &report.totals.tally;
    if tally.bbox_mm.is_some() {
        return Ok(());
    }
    let reasons = report::faces_of(model, meshes).find_map(|(_, face, mesh)| {
        report::reason(&mesh.status).map(|reason| format!("{}: {reason}", face.entity))
    });
    match reasons {
        Some(reason) => bail!("none of its {} faces could be meshed, e.g. {reason}", tally.faces),
        None => bail!("nothing in it can be shown: every face is empty or hidden"),
    }
}

fn outcome(report: &Report, strict: bool) -> Outcome {
    let tally = &report.totals.tally;
    let is_damaged = report.diagnostics.iter().any(DiagnosticReport::is_error);
    if tally.lost > 0 || is_damaged || strict && tally.approximated > 0 {
        Outcome::Incomplete
    } else {
        Outcome::Good
    }
}

/// Tells what a stage took.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    /// Seconds since the last lap; fails where a stop has been asked for.
    fn lap(&mut self) -> anyhow::Result<f64> {
        interrupt::check()?;
        let last = std::mem::replace(&mut self.0, Instant::now());
        Ok((self.0 - last).as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use trimloop_brep::{Diagnostic, EntityRef, Model, Severity};
    use trimloop_gltf::Written;

    use super::{DiagnosticReport, Job, Outcome, Report, Target, outcome};

    fn report(lost: usize, approximated: usize) -> Report {
        let job = Job { input: "a.step".into(), target: Target::Glb("a.glb".into()) };
        let mut report = Report::new(&job, &Model::default(), &[], &Written::default(), false);
        report.totals.tally.lost = lost;
        report.totals.tally.approximated = approximated;
        report
    }

    #[test]
    fn a_lost_face_shows_in_the_exit_code() {
        assert_eq!(outcome(&report(0, 0), true), Outcome::Good);
        assert_eq!(outcome(&report(1, 0), false), Outcome::Incomplete);
    }

    #[test]
    fn an_approximated_face_shows_where_that_is_strict() {
        assert_eq!(outcome(&report(0, 1), false), Outcome::Good);
        assert_eq!(outcome(&report(0, 1), true), Outcome::Incomplete);
    }

    #[test]
    fn what_could_not_be_read_shows_in_the_exit_code() {
        for (severity, expected) in
            [(Severity::Warning, Outcome::Good), (Severity::Error, Outcome::Incomplete)]
        {
            let mut report = report(0, 0);
            let diagnostic = Diagnostic::new(severity, "syntax", EntityRef::Step(7), "Not closed.");
            report.diagnostics.push(DiagnosticReport::of(&diagnostic));
            assert_eq!(outcome(&report, false), expected);
        }
    }
}
