//! How the cases of a suite ended, and the reports on that.

use std::fmt::Write;
use std::time::Duration;

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use serde::Serialize;

use crate::baseline::{Baseline, Outcome};
use crate::comparison::Comparison;
use crate::html::{self, Picture, badge, escape, number};
use crate::suite::Case;
use crate::verdict::{Judgement, Verdict};

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Within the gates.
    Passed,
    /// The difference that is expected (or that the baseline has) is there.
    Known,
    /// A difference that nobody expects.
    Failed,
    /// The verdict is another one than that of the baseline.
    Changed,
    /// An expected difference is there no more.
    Gone,
    /// A file could not be read.
    Broken,
}

impl Status {
    /// Whether the suite passes with it.
    pub const fn is_good(self) -> bool {
        matches!(self, Self::Passed | Self::Known)
    }

    /// In a word.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Known => "known",
            Self::Failed => "FAILED",
            Self::Changed => "CHANGED",
            Self::Gone => "GONE",
            Self::Broken => "BROKEN",
        }
    }
}

/// A case that has been run.
#[derive(Clone, Debug, Serialize)]
pub struct Ran {
    /// Its name.
    pub name: String,
    /// The model's file.
    pub input: String,
    /// The reference's file.
    pub reference: String,
    /// Its tags.
    pub tags: Vec<String>,
    /// How it ended.
    pub status: Status,
    /// Why, in sentences.
    pub why: Vec<String>,
    /// What it took.
    pub seconds: f64,
    /// Unit and axes of the reference, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub convention: Option<String>,
    /// What it came to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outcome: Option<Outcome>,
    /// What the baseline has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub baseline: Option<Outcome>,
    /// The judgement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub judgement: Option<Judgement>,
    /// Everything that was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<Comparison>,
    /// Pictures of it.
    #[serde(skip)]
    pub pictures: Vec<Picture>,
    /// The end of their scale.
    #[serde(skip)]
    pub scale_mm: f64,
}

/// What a verdict means for a case, with the reasons.
pub fn status_of(case: &Case, judgement: &Judgement, baseline: Option<&Outcome>) -> (Status, Vec<String>) {
    let now = judgement.verdict;
    let mut why = judgement.reasons.clone();
    if let Some(known) = &case.known {
        if now == known.verdict {
            why.insert(0, format!("Known: {}", known.reason));
            return (Status::Known, why);
        }
        let (is, was) = (now.as_str(), known.verdict.as_str());
        why.insert(0, format!("Expected to be {was} ({}), but is {is}.", known.reason));
        return (if now == Verdict::Same { Status::Gone } else { Status::Changed }, why);
    }
    match baseline {
        Some(before) if before.verdict != now => {
            why.insert(
                0,
                format!("The baseline has {}, now it is {}.", before.verdict.as_str(), now.as_str()),
            );
            (Status::Changed, why)
        }
        Some(_) if now != Verdict::Same => {
            why.insert(0, "As the baseline has it.".to_owned());
            (Status::Known, why)
        }
        None if now != Verdict::Same => (Status::Failed, why),
        _ => (Status::Passed, why),
    }
}

/// JUnit's XML, which every CI system reads.
///
/// # Errors
///
/// Where a text cannot be written as XML.
pub fn junit(suite: &str, ran: &[Ran]) -> Result<String, String> {
    let mut tests = TestSuite::new(suite);
    for case in ran {
        let text = printable(&case.why.join("\n"));
        let mut status = if case.status.is_good() {
            TestCaseStatus::success()
        } else {
            TestCaseStatus::non_success(if case.status == Status::Broken {
                NonSuccessKind::Error
            } else {
                NonSuccessKind::Failure
            })
        };
        if !case.status.is_good() {
            status.set_message(printable(case.why.first().map_or("", String::as_str)));
            status.set_type(case.status.as_str());
            status.set_description(text.clone());
        }
        let mut test = TestCase::new(printable(&case.name), status);
        test.set_classname(suite);
        test.set_time(Duration::from_secs_f64(case.seconds));
        if case.status.is_good() && !text.is_empty() {
            test.set_system_out(text);
        }
        tests.add_test_case(test);
    }
    let mut report = Report::new(suite);
    report.add_test_suite(tests);
    report.to_string().map_err(|error| error.to_string())
}

/// A text without what XML cannot hold, whatever the name of a file or a face is.
fn printable(text: &str) -> String {
    let fits =
        |c: char| (matches!(c, '\n' | '\t') || !c.is_control()) && !matches!(c, '\u{fffe}' | '\u{ffff}');
    text.chars().map(|c| if fits(c) { c } else { '\u{fffd}' }).collect()
}

/// One page on the whole suite: what failed first.
pub fn page(suite: &str, ran: &[Ran], baseline: &Baseline) -> String {
    let mut body = String::new();
    let count = |status: Status| ran.iter().filter(|case| case.status == status).count();
    let all = [Status::Passed, Status::Known, Status::Failed, Status::Changed, Status::Gone, Status::Broken];
    let counts: Vec<String> = all
        .iter()
        .filter(|&&status| count(status) > 0)
        .map(|&status| format!("{} {}", count(status), mark(status)))
        .collect();
    let _ = writeln!(body, "<p>{} cases: {}</p>", ran.len(), counts.join(", "));
    let mut order: Vec<(usize, &Ran)> = ran.iter().enumerate().collect();
    order.sort_by_key(|(k, case)| (case.status.is_good(), case.status == Status::Passed, *k));
    body.push_str(
        "<table><tr><th>case</th><th></th><th class=n>max, mm</th><th class=n>rms, mm</th><th class=n>area</th>\
         <th class=n>volume</th><th class=n>s</th></tr>\n",
    );
    for (k, case) in &order {
        let cells = match &case.outcome {
            Some(it) => format!(
                "<td class=n>{:.5}</td><td class=n>{:.5}</td><td class=n>{}</td><td class=n>{}</td>",
                it.max_mm,
                it.rms_mm,
                share(it.area_mm2, it.reference_area_mm2),
                share(it.volume_mm3, it.reference_volume_mm3)
            ),
            None => "<td></td><td></td><td></td><td></td>".to_owned(),
        };
        let _ = writeln!(
            body,
            "<tr><td><a href=\"#case{k}\">{}</a></td><td>{}</td>{cells}<td class=n>{:.2}</td></tr>",
            escape(&case.name),
            mark(case.status),
            case.seconds
        );
    }
    body.push_str("</table>\n");
    for (k, case) in &order {
        body.push_str(&section(*k, case, baseline));
    }
    html::page(&format!("{suite}: regression"), &body)
}

fn share(a: f64, b: f64) -> String {
    if a == 0.0 { String::new() } else { format!("{:+.3} %", (b / a - 1.0) * 100.0) }
}

fn mark(status: Status) -> String {
    let class = match status {
        Status::Passed => "good",
        Status::Known => "known",
        _ => "bad",
    };
    format!("<span class=\"badge {class}\">{}</span>", status.as_str().to_lowercase())
}

fn section(k: usize, case: &Ran, baseline: &Baseline) -> String {
    let mut out = format!("<h2 id=\"case{k}\">{} {}", escape(&case.name), mark(case.status));
    if let Some(outcome) = &case.outcome {
        let _ = write!(out, " {}", badge(outcome.verdict));
    }
    let convention = case.convention.as_ref().map_or_else(String::new, |text| format!(" ({})", escape(text)));
    let _ = writeln!(
        out,
        "</h2>\n<p>A: <code>{}</code>, B: <code>{}</code>{convention}</p>",
        escape(&case.input),
        escape(&case.reference)
    );
    let own = case.judgement.as_ref().map_or(&[][..], |judgement| &judgement.reasons);
    let more: Vec<String> = case
        .why
        .iter()
        .filter(|why| !own.contains(why))
        .map(|why| format!("<p>{}</p>", escape(why)))
        .collect();
    out.push_str(&more.concat());
    if let (Some(found), Some(judgement)) = (&case.comparison, &case.judgement) {
        out.push_str(&html::comparison(found, judgement, &case.pictures, case.scale_mm));
    }
    out.push_str(&history(case, baseline));
    out
}

/// What the case came to, now and at each blessing.
fn history(case: &Ran, baseline: &Baseline) -> String {
    let Some(blessed) = baseline.cases.get(&case.name) else { return String::new() };
    let mut out = String::from(
        "<table><tr><th>history</th><th></th><th class=n>max, mm</th><th class=n>rms, mm</th><th class=n>area, mm²</th>\
         <th class=n>volume, mm³</th><th class=n>reference's area</th><th class=n>volume</th></tr>\n",
    );
    let now = case.outcome.iter().map(|outcome| ("now".to_owned(), outcome));
    let before =
        blessed.history.iter().rev().map(|outcome| (format!("trimloop {}", outcome.trimloop), outcome));
    for (when, it) in now.chain(before) {
        let figures = [it.area_mm2, it.volume_mm3, it.reference_area_mm2, it.reference_volume_mm3]
            .map(|value| format!("<td class=n>{}</td>", number(value)))
            .concat();
        let _ = writeln!(
            out,
            "<tr><td>{when}</td><td>{}</td><td class=n>{:.5}</td><td class=n>{:.5}</td>{figures}</tr>",
            badge(it.verdict),
            it.max_mm,
            it.rms_mm
        );
    }
    out + "</table>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::Known;
    use crate::verdict::Gates;

    fn case(known: Option<Verdict>) -> Case {
        Case {
            name: "a".into(),
            input: "a.step".into(),
            reference: "a.stl".into(),
            gates: Gates::default(),
            tags: Vec::new(),
            known: known.map(|verdict| Known { verdict, reason: "old".into() }),
            unit: None,
            up: None,
        }
    }

    fn status(known: Option<Verdict>, before: Option<Verdict>, now: Verdict) -> Status {
        let judgement = Judgement { verdict: now, gates: Vec::new(), reasons: Vec::new() };
        let before =
            before.map(|verdict| Outcome { verdict, ..Outcome::new(&Comparison::default(), &judgement) });
        status_of(&case(known), &judgement, before.as_ref()).0
    }

    #[test]
    fn what_changes_fails_and_what_is_known_passes() {
        use Verdict::{Different, ReferenceSuspect, Same};
        assert_eq!(status(None, None, Same), Status::Passed);
        assert_eq!(status(None, None, Different), Status::Failed);
        assert_eq!(status(None, None, ReferenceSuspect), Status::Failed);
        assert_eq!(status(None, Some(Same), Different), Status::Changed);
        assert_eq!(status(None, Some(Different), Same), Status::Changed);
        assert_eq!(status(None, Some(Different), Different), Status::Known);
        assert_eq!(status(Some(Different), None, Different), Status::Known);
        assert_eq!(status(Some(Different), Some(Different), Same), Status::Gone);
        assert_eq!(status(Some(Different), None, ReferenceSuspect), Status::Changed);
    }

    #[test]
    fn the_xml_counts_failures() {
        let ran = |name: &str, status| Ran {
            name: name.into(),
            input: String::new(),
            reference: String::new(),
            tags: Vec::new(),
            status,
            why: vec!["because <of> & \"this\"".into()],
            seconds: 0.5,
            convention: None,
            outcome: None,
            baseline: None,
            judgement: None,
            comparison: None,
            pictures: Vec::new(),
            scale_mm: 1.0,
        };
        let list = [ran("good", Status::Passed), ran("bad", Status::Failed), ran("broken", Status::Broken)];
        let xml = junit("suite", &list).expect("XML");
        assert!(
            xml.contains("tests=\"3\"") && xml.contains("failures=\"1\"") && xml.contains("errors=\"1\""),
            "{xml}"
        );
        assert!(!page("suite", &list, &Baseline::default()).contains("<of>"));
    }
}
