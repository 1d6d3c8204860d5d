//! A comparison for people.

use std::fmt::Write;

use trimloop_compare::html::{figure_rows, number};
use trimloop_compare::{FaceDistances, Side, Verdict};

use crate::compare::Held;
use crate::side::FileReport;

/// The verdict; what it rests on unless `quiet`; every face that differs where `verbose`.
pub fn of(held: &Held, quiet: bool, verbose: bool) -> String {
    let mut out = String::new();
    let verdict = verdict_line(held) + &guesses(held);
    if quiet {
        return verdict + "\n";
    }
    // Writing to a String cannot fail.
    for (name, file, side) in [("A", &held.files[0], &held.found.a), ("B", &held.files[1], &held.found.b)] {
        let _ = writeln!(out, "{name}  {}", about(file, side));
        for note in file.notes.iter().take(if verbose { usize::MAX } else { 3 }) {
            let _ = writeln!(out, "   {note}");
        }
        if file.unusable_triangles > 0 {
            let _ =
                writeln!(out, "   {} triangles left out: NaN or infinite corners", file.unusable_triangles);
        }
    }
    let _ = writeln!(out, "\n{:<20} {:>16} {:>16} {:>12}", "", "A", "B", "B / A");
    for (name, a, b) in figure_rows(&held.found.a, &held.found.b) {
        let is_detail = a == 0.0 && b == 0.0 || a.is_nan() && b.is_nan() || name.starts_with("moment");
        if is_detail && !verbose {
            continue;
        }
        let share = if a == b || a == 0.0 || a.is_nan() || b.is_nan() {
            String::new()
        } else {
            format!("{:+.4} %", (b / a - 1.0) * 100.0)
        };
        let _ = writeln!(out, "{name:<20} {:>16} {:>16} {share:>12}", number(a), number(b));
    }
    let _ = writeln!(
        out,
        "\n{:<20} {:>10} {:>10} {:>10} {:>10}  largest at",
        "distance, mm", "max", "99.9 %", "rms", "mean"
    );
    let found = &held.found;
    let rows =
        [("A to B", &found.a_to_b), ("B to A", &found.b_to_a), ("corners of B to A", &found.b_corners_to_a)];
    for (name, d) in rows {
        let [x, y, z] = d.at_mm;
        let _ = writeln!(
            out,
            "{name:<20} {:>10.5} {:>10.5} {:>10.5} {:>10.5}  {x:.2} {y:.2} {z:.2}",
            d.max_mm, d.p999_mm, d.rms_mm, d.mean_mm
        );
    }
    if verbose {
        let near_mm = held.scale_mm();
        let off = |face: &FaceDistances| face.distances.max_mm.max(face.back_max_mm);
        let mut faces: Vec<&FaceDistances> = found.faces.iter().filter(|face| off(face) > near_mm).collect();
        faces.sort_by(|a, b| off(b).total_cmp(&off(a)));
        for face in faces {
            let _ = writeln!(
                out,
                "  {} ({}) {}: max {:.5} mm, rms {:.5} mm, {:.1} % covered",
                face.name,
                face.surface,
                face.part,
                off(face),
                face.distances.rms_mm,
                face.covered * 100.0
            );
        }
    }
    out.push('\n');
    for reason in &held.judgement.reasons {
        let _ = writeln!(out, "  {reason}");
    }
    let _ = writeln!(out, "{verdict}");
    out
}

fn about(file: &FileReport, side: &Side) -> String {
    let kind = if side.exact {
        "exact surfaces".to_owned()
    } else {
        format!("mesh of {} triangles", side.topology.triangles)
    };
    let convention = file.convention.as_ref().map_or_else(String::new, |text| format!("; {text}"));
    format!("{} ({}, {kind}{convention})", file.path, file.format)
}

/// Units and axes that are not those of the format.
fn guesses(held: &Held) -> String {
    let sides = ["A", "B"].iter().zip(&held.files);
    sides.filter_map(|(name, file)| Some(format!(" [{name} taken in {}]", file.guess()?))).collect()
}

fn verdict_line(held: &Held) -> String {
    let missed: Vec<String> = held
        .judgement
        .gates
        .iter()
        .filter(|gate| !gate.kept)
        .map(|gate| match gate.unit {
            "share" => format!("{} {:.3} % of {:.3} %", gate.name, gate.found * 100.0, gate.allowed * 100.0),
            unit => format!("{} {} of {} {unit}", gate.name, number(gate.found), number(gate.allowed)),
        })
        .collect();
    match held.judgement.verdict {
        Verdict::Same => {
            let gate = &held.judgement.gates[0];
            format!("same: at most {} mm apart, {} mm allowed", number(gate.found), number(gate.allowed))
        }
        verdict => format!("{}: {}", verdict.as_str(), missed.join(", ")),
    }
}
