//! `trimloop regress`: the cases of a suite, all at once, and the reports on them.

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, bail};
use rayon::prelude::*;
use serde::Serialize;
use trimloop_compare::{
    Baseline, BaselineOutcome, Case, Detail, Quantities, Ran, Reach, Status, Suite, Verdict, junit, page,
    pictures, status_of,
};
use trimloop_mesh::{LinearDeflection, Monitor};

use crate::arguments::{MeshUnit, MeshUp, RegressArguments};
use crate::compare::Held;
use crate::contained::contained;
use crate::draft::{self, Draft};
use crate::interrupt;
use crate::manual;
use crate::message;
use crate::outcome::Outcome;
use crate::progress::Progress;
use crate::threads;
use crate::{quantity, regress_text, side};

/// Gates as the command line has them.
struct AsTyped;

impl Quantities for AsTyped {
    fn reach(&self, text: &str) -> Result<Reach, String> {
        Ok(match quantity::linear_deflection(text)? {
            LinearDeflection::Absolute(mm) => Reach::Mm(mm),
            LinearDeflection::Relative(share) => Reach::Share(share),
        })
    }

    fn share(&self, text: &str) -> Result<f64, String> {
        quantity::share(text)
    }
}

/// `results.json`.
#[derive(Serialize)]
struct Results<'r> {
    version: u32,
    suite: &'r str,
    passed: bool,
    cases: &'r [Ran],
}

/// Runs a suite.
pub fn run(arguments: &RegressArguments) -> anyhow::Result<Outcome> {
    if arguments.bless && std::env::var_os("CI").is_some_and(|value| !value.is_empty() && value != "false") {
        bail!("--bless is for people who have looked at the report: it does nothing where CI is set");
    }
    interrupt::listen()?;
    threads::start(arguments.jobs)?;
    let suite = Suite::read(&arguments.suite, arguments.gates.gates(), &AsTyped)?;
    let cases: Vec<&Case> = suite.cases.iter().filter(|case| arguments.chooses(case)).collect();
    if cases.is_empty() {
        bail!("none of the {} cases is chosen", suite.cases.len());
    }
    let mut baseline = Baseline::read(&suite.baseline).map_err(anyhow::Error::msg)?;
    std::fs::create_dir_all(&arguments.output)
        .with_context(|| format!("cannot create the folder `{}`", arguments.output.display()))?;

    let progress = Progress::counting(cases.len(), "cases", arguments.quiet);
    let ran: Vec<Ran> = cases
        .par_iter()
        .map(|case| {
            let ran = run_case(case, &baseline, arguments);
            progress.add(1);
            ran
        })
        .collect();
    drop(progress);
    if interrupt::requested() {
        return Ok(Outcome::Cancelled);
    }
    let passed = ran.iter().all(|case| case.status.is_good());
    write_reports(&suite, &ran, &baseline, passed, &arguments.output)?;
    if arguments.bless {
        bless(&suite, &ran, &mut baseline, cases.len() == suite.cases.len())?;
    }
    manual::print(regress_text::of(&suite, &ran, arguments).as_bytes())?;
    let is_broken = ran.iter().any(|case| case.status == Status::Broken);
    Ok(if passed || arguments.bless && !is_broken { Outcome::Good } else { Outcome::Incomplete })
}

/// Nothing that meshing has to say concerns the suite's own progress.
struct Quiet;

impl Monitor for Quiet {
    fn face_done(&self) {}

    fn cancelled(&self) -> bool {
        interrupt::requested()
    }
}

fn run_case(case: &Case, baseline: &Baseline, arguments: &RegressArguments) -> Ran {
    let start = Instant::now();
    let before = baseline.last(&case.name).cloned();
    let mut ran = Ran {
        name: case.name.clone(),
        input: case.input.display().to_string(),
        reference: case.reference.display().to_string(),
        tags: case.tags.clone(),
        status: Status::Broken,
        why: Vec::new(),
        seconds: 0.0,
        convention: None,
        outcome: None,
        baseline: before.clone(),
        judgement: None,
        comparison: None,
        pictures: Vec::new(),
        scale_mm: 1.0,
    };
    match contained(|| hold(case, arguments)) {
        Ok(held) => {
            let (status, why) = status_of(case, &held.judgement, before.as_ref());
            (ran.status, ran.why) = (status, why);
            if let Some(guess) = held.files[1].guess() {
                ran.why.push(format!(
                    "The reference is taken in {guess}, which is not what is usual for its format."
                ));
            }
            ran.scale_mm = held.scale_mm();
            if !arguments.no_pictures {
                let detail =
                    if held.judgement.verdict == Verdict::Same { Detail::Brief } else { Detail::Full };
                ran.pictures = pictures(&held.shapes[0], &held.shapes[1], ran.scale_mm, detail);
            }
            ran.convention = held.files[1].convention.clone();
            ran.outcome = Some(BaselineOutcome::new(&held.found, &held.judgement));
            // The places were for the figures: what is kept of a suite of hundreds must be little.
            let mut found = held.found;
            found.places = Default::default();
            (ran.judgement, ran.comparison) = (Some(held.judgement), Some(found));
        }
        Err(error) => ran.why.push(message::of(&error)),
    }
    ran.seconds = start.elapsed().as_secs_f64();
    ran
}

fn hold(case: &Case, arguments: &RegressArguments) -> anyhow::Result<Held> {
    interrupt::check()?;
    let unit = match &case.unit {
        Some(text) => quantity::mesh_unit(text).map_err(anyhow::Error::msg)?,
        None => MeshUnit(None),
    };
    let up = match case.up.as_deref() {
        Some("y") => MeshUp::Y,
        Some("z") => MeshUp::Z,
        None | Some("auto") => MeshUp::Auto,
        Some(other) => bail!("`{other}` is no axis: y, z or auto"),
    };
    let sides = side::load_both([&case.input, &case.reference], [unit; 2], [up; 2], false, &Quiet)?;
    Held::new(sides, &case.gates, arguments.samples as usize, &|_| !interrupt::requested())
}

fn write_reports(
    suite: &Suite,
    ran: &[Ran],
    baseline: &Baseline,
    passed: bool,
    folder: &Path,
) -> anyhow::Result<()> {
    let results = Results { version: 1, suite: &suite.name, passed, cases: ran };
    let files = [
        ("results.json", serde_json::to_string(&results)? + "\n"),
        ("junit.xml", junit(&suite.name, ran).map_err(anyhow::Error::msg)?),
        ("report.html", page(&suite.name, ran, baseline)),
    ];
    let mut drafts = Vec::new();
    for (name, text) in files {
        let mut draft = Draft::beside(&folder.join(name))?;
        draft.write_all(text.as_bytes())?;
        drafts.push(draft);
    }
    draft::publish(drafts)
}

/// Takes what has come as good; where every case has run, those that are no more are forgotten.
fn bless(suite: &Suite, ran: &[Ran], baseline: &mut Baseline, all: bool) -> anyhow::Result<()> {
    for case in ran {
        if let Some(outcome) = &case.outcome {
            baseline.bless(&case.name, outcome.clone());
        }
    }
    if all {
        baseline.cases.retain(|name, _| suite.cases.iter().any(|case| case.name == *name));
    }
    baseline.version = 1;
    let mut draft = Draft::beside(&suite.baseline)?;
    draft.write_all(baseline.to_json().as_bytes())?;
    draft::publish(vec![draft])
}
