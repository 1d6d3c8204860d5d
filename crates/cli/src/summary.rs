//! What a person wants to know about a conversion, in a few lines.

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use trimloop_brep::{Diagnostic, EntityRef, Face, Model, Severity};
use trimloop_mesh::{FaceMesh, FaceStatus, PartMesh};

use crate::report::{self, Report};

/// Lost faces are listed up to this number; `--verbose` lists all.
const LISTED_FACES: usize = 20;

/// The summary of a conversion, with a newline at its end.
pub fn of(report: &Report, model: &Model, meshes: &[PartMesh], verbose: bool) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, report, model, meshes, verbose);
    text
}

fn write(
    out: &mut String,
    report: &Report,
    model: &Model,
    meshes: &[PartMesh],
    verbose: bool,
) -> fmt::Result {
    let totals = &report.totals;
    writeln!(out, "{} -> {}", report.input, report.output)?;
    writeln!(
        out,
        "  {}, {}, {}, {}, {:.2} s",
        counted(totals.parts, "part"),
        counted(totals.instances, "instance"),
        counted(totals.tally.faces, "face"),
        counted(totals.tally.triangles, "triangle"),
        report.seconds.total
    )?;
    write_faces(out, model, meshes, verbose)?;
    if verbose {
        report::diagnostics(model, meshes).try_for_each(|diagnostic| write_diagnostic(out, diagnostic))
    } else {
        write_groups(out, report::diagnostics(model, meshes))
    }
}

/// `1 face`, `2 faces`.
pub fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

fn write_faces(out: &mut String, model: &Model, meshes: &[PartMesh], verbose: bool) -> fmt::Result {
    let with = |wanted: fn(&FaceStatus) -> bool| {
        report::faces_of(model, meshes).filter(move |(_, _, mesh)| wanted(&mesh.status))
    };
    let lost = with(|status| matches!(status, FaceStatus::Lost(_)));
    let count = lost.clone().count();
    if count > 0 {
        writeln!(out, "  {} lost:", counted(count, "face"))?;
        let listed = if verbose { count } else { LISTED_FACES };
        lost.take(listed).try_for_each(|(_, face, mesh)| write_face(out, face, mesh))?;
        if count > listed {
            writeln!(out, "    and {} more (--verbose lists all)", count - listed)?;
        }
    }
    let approximated = with(|status| matches!(status, FaceStatus::Approximated(_)));
    match approximated.clone().count() {
        0 => Ok(()),
        count if verbose => {
            writeln!(out, "  {} approximated:", counted(count, "face"))?;
            approximated.clone().try_for_each(|(_, face, mesh)| write_face(out, face, mesh))
        }
        count => writeln!(out, "  {} approximated (--verbose lists them)", counted(count, "face")),
    }
}

fn write_face(out: &mut String, face: &Face, mesh: &FaceMesh) -> fmt::Result {
    write!(out, "    {} {}", face.entity, report::surface_kind(face))?;
    if mesh.max_deviation_mm > 0.0 {
        write!(out, ", off by {:.3e} mm", mesh.max_deviation_mm)?;
    }
    writeln!(out, ": {}", report::reason(&mesh.status).unwrap_or(mesh.status.as_str()))
}

fn write_diagnostic(out: &mut String, diagnostic: &Diagnostic) -> fmt::Result {
    write!(out, "  {} {}", diagnostic.severity.as_str(), diagnostic.code)?;
    if diagnostic.entity != EntityRef::None {
        write!(out, " {}", diagnostic.entity)?;
    }
    match diagnostic.face {
        Some(face) if face != diagnostic.entity => {
            writeln!(out, " (face {face}): {}", diagnostic.message)
        }
        _ => writeln!(out, ": {}", diagnostic.message),
    }
}

/// One line per code, the worst first, with its first message as an example.
fn write_groups<'a>(out: &mut String, diagnostics: impl Iterator<Item = &'a Diagnostic>) -> fmt::Result {
    let mut groups: BTreeMap<_, (usize, &Diagnostic)> = BTreeMap::new();
    for diagnostic in diagnostics.filter(|d| d.severity > Severity::Info) {
        let key = (std::cmp::Reverse(diagnostic.severity), diagnostic.code);
        groups.entry(key).or_insert((0, diagnostic)).0 += 1;
    }
    for (count, first) in groups.into_values() {
        if count == 1 {
            write_diagnostic(out, first)?;
        } else {
            let (severity, code) = (first.severity.as_str(), first.code);
            writeln!(out, "  {severity} {code} {count} times, e.g. {}: {}", first.entity, first.message)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use trimloop_brep::{Diagnostic, EntityRef, Severity};

    use super::{counted, write_groups};

    #[test]
    fn one_is_singular() {
        assert_eq!((counted(1, "face"), counted(0, "face")), ("1 face".into(), "0 faces".into()));
    }

    #[test]
    fn diagnostics_are_grouped_by_code_with_the_worst_first() {
        let about = |severity, code, id| Diagnostic::new(severity, code, EntityRef::Step(id), "Why.");
        let diagnostics = [
            about(Severity::Info, "edition", 1),
            about(Severity::Warning, "gap", 2),
            about(Severity::Warning, "gap", 3),
            about(Severity::Error, "missing", 4),
        ];
        let mut text = String::new();
        write_groups(&mut text, diagnostics.iter()).expect("text");
        assert_eq!(text, "  error missing #4: Why.\n  warning gap 2 times, e.g. #2: Why.\n");
    }
}
