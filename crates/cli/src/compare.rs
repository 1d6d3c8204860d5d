//! `trimloop compare`: two shapes held against each other.

use std::io::Write;
use std::path::Path;

use serde::Serialize;
use trimloop_compare::{
    CompareOptions, Comparison, Detail, Gates, Judgement, Shape, compare, html, judge, pictures, places_of,
};

use crate::arguments::CompareArguments;
use crate::compare_text;
use crate::contained::contained;
use crate::draft::{self, Draft};
use crate::interrupt;
use crate::manual;
use crate::message;
use crate::outcome::Outcome;
use crate::progress::Progress;
use crate::side::{self, FileReport};
use crate::threads;

/// Compares A with B.
pub fn run(arguments: &CompareArguments) -> anyhow::Result<Outcome> {
    interrupt::listen()?;
    threads::start(arguments.jobs)?;
    match contained(|| held_against(arguments)) {
        Ok(outcome) => Ok(outcome),
        Err(_) if interrupt::requested() => Ok(Outcome::Cancelled),
        Err(error) => {
            eprintln!("error: {}", message::of(&error));
            Ok(Outcome::Failed)
        }
    }
}

/// What `--report` holds.
#[derive(Serialize)]
struct Report<'c> {
    version: u32,
    a: &'c FileReport,
    b: &'c FileReport,
    verdict: &'static str,
    judgement: &'c Judgement,
    comparison: &'c Comparison,
}

/// Two files held against each other.
pub struct Held {
    /// What the files are.
    pub files: [FileReport; 2],
    /// Their shapes, millimetres.
    pub shapes: [Shape; 2],
    /// What was measured.
    pub found: Comparison,
    /// And what that means.
    pub judgement: Judgement,
}

impl Held {
    /// Measures and judges.
    pub fn new(
        sides: [(Shape, FileReport); 2],
        gates: &Gates,
        samples: usize,
        done: &(dyn Fn(usize) -> bool + Sync),
    ) -> anyhow::Result<Self> {
        let [(a, a_file), (b, b_file)] = sides;
        let near_mm = gates.max_distance.mm(a.triangles.bounds().diagonal());
        let found = compare(&a, &b, CompareOptions { samples, near_mm }, done)?;
        let judgement = judge(&found, gates);
        Ok(Self { files: [a_file, b_file], shapes: [a, b], found, judgement })
    }

    /// The end of the scale of its pictures.
    pub fn scale_mm(&self) -> f64 {
        self.judgement.gates.first().map_or(1.0, |gate| gate.allowed)
    }
}

fn held_against(arguments: &CompareArguments) -> anyhow::Result<Outcome> {
    let paths = [arguments.a.as_path(), arguments.b.as_path()];
    let outputs =
        [arguments.report.as_deref().filter(|path| *path != Path::new("-")), arguments.html.as_deref()];
    if let [Some(report), Some(html)] = outputs
        && is_same(report, html)
    {
        anyhow::bail!("--report and --html name the same file");
    }
    for output in outputs.iter().flatten() {
        if paths.iter().any(|path| is_same(path, output)) {
            anyhow::bail!("`{}` is an input, and would be overwritten", output.display());
        }
        // Now rather than after minutes of work: can it be written?
        Draft::beside(output).map(drop)?;
    }
    let units = side::pair(&arguments.unit, "--unit")?;
    let ups = side::pair(&arguments.up, "--up")?;
    let progress = Progress::counting(0, "faces", arguments.quiet);
    let sides = side::load_both(paths, units, ups, arguments.hidden, &progress)?;
    drop(progress);
    interrupt::check()?;
    let options = CompareOptions { samples: arguments.samples as usize, near_mm: 0.0 };
    let total = places_of(&sides[0].0, &sides[1].0, options);
    let progress = Progress::counting(total, "places", arguments.quiet);
    let done = |count: usize| {
        progress.add(count);
        !interrupt::requested()
    };
    let held = Held::new(sides, &arguments.gates.gates(), arguments.samples as usize, &done)?;
    drop(progress);

    let mut drafts = Vec::new();
    if let Some(path) = &arguments.html {
        let mut draft = Draft::beside(path)?;
        draft.write_all(page(&held).as_bytes())?;
        drafts.push(draft);
    }
    let report = Report {
        version: 1,
        a: &held.files[0],
        b: &held.files[1],
        verdict: held.judgement.verdict.as_str(),
        judgement: &held.judgement,
        comparison: &held.found,
    };
    match &arguments.report {
        Some(path) if path == Path::new("-") => {
            manual::print((serde_json::to_string_pretty(&report)? + "\n").as_bytes())?;
        }
        Some(path) => {
            let mut draft = Draft::beside(path)?;
            draft.write_all((serde_json::to_string_pretty(&report)? + "\n").as_bytes())?;
            drafts.push(draft);
        }
        None => {}
    }
    draft::publish(drafts)?;
    let text = compare_text::of(&held, arguments.quiet, arguments.verbose);
    if arguments.report.as_deref() == Some(Path::new("-")) {
        eprint!("{text}");
    } else {
        manual::print(text.as_bytes())?;
    }
    Ok(if held.judgement.verdict == trimloop_compare::Verdict::Same {
        Outcome::Good
    } else {
        Outcome::Incomplete
    })
}

fn is_same(a: &Path, b: &Path) -> bool {
    a == b || matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// One page on one comparison.
fn page(held: &Held) -> String {
    let most_mm = held.scale_mm();
    let pictures = pictures(&held.shapes[0], &held.shapes[1], most_mm, Detail::Full);
    let [a, b] = &held.files;
    let head = format!(
        "<p>{} A: <code>{}</code> ({}), B: <code>{}</code> ({}{})</p>\n",
        html::badge(held.judgement.verdict),
        html::escape(&a.path),
        html::escape(&a.format),
        html::escape(&b.path),
        html::escape(&b.format),
        b.convention.as_ref().map_or_else(String::new, |text| format!(", {}", html::escape(text))),
    );
    let body = head + &html::comparison(&held.found, &held.judgement, &pictures, most_mm);
    html::page("Comparison", &body)
}
