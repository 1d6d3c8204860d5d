//! How a suite ended, for people.

use std::fmt::Write;

use trimloop_compare::{Ran, Status, Suite};

use crate::arguments::RegressArguments;

/// A table of the cases, what failed and why, and the sum.
pub fn of(suite: &Suite, ran: &[Ran], arguments: &RegressArguments) -> String {
    let mut out = String::new();
    let width = ran.iter().map(|case| case.name.chars().count()).max().unwrap_or(0).clamp(8, 64);
    // Writing to a String cannot fail.
    if !arguments.quiet {
        let _ = writeln!(
            out,
            "{:<width$}  {:<8} {:>10} {:>10} {:>10} {:>10}",
            "case", "", "max mm", "rms mm", "area", "volume"
        );
        for case in ran {
            let _ = write!(out, "{:<width$}  {:<8}", case.name, case.status.as_str());
            if let Some(it) = &case.outcome {
                let share = |a: f64, b: f64| {
                    if a == 0.0 { String::new() } else { format!("{:+.3} %", (b / a - 1.0) * 100.0) }
                };
                let _ = write!(
                    out,
                    " {:>10.5} {:>10.5} {:>10} {:>10}",
                    it.max_mm,
                    it.rms_mm,
                    share(it.area_mm2, it.reference_area_mm2),
                    share(it.volume_mm3, it.reference_volume_mm3)
                );
            }
            out.push('\n');
        }
        out.push('\n');
    }
    for case in ran.iter().filter(|case| !case.status.is_good()) {
        let _ = writeln!(out, "{} {}", case.status.as_str(), case.name);
        for why in &case.why {
            let _ = writeln!(out, "    {why}");
        }
    }
    let count = |status: Status| ran.iter().filter(|case| case.status == status).count();
    let good = count(Status::Passed) + count(Status::Known);
    let _ = writeln!(
        out,
        "{}: {} of {} cases good ({} with a known difference), report in {}",
        suite.name,
        good,
        ran.len(),
        count(Status::Known),
        arguments.output.join("report.html").display()
    );
    let guessed = ran
        .iter()
        .filter(|case| case.convention.as_ref().is_some_and(|text| text.contains("(guessed")))
        .count();
    if guessed > 0 {
        let _ = writeln!(
            out,
            "{guessed} references are in another unit, or another way up, than is usual for their format"
        );
    }
    if suite.without_reference > 0 {
        let _ = writeln!(out, "{} files have no reference to be held against", suite.without_reference);
    }
    if arguments.bless {
        let _ = writeln!(out, "blessed: {}", suite.baseline.display());
    }
    out
}
