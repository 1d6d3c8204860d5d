//! One number of a file damaged: the file is read all the same, and takes no more triangles than it can ask for.

use std::fs;
use std::path::Path;

use rayon::prelude::*;
use trimloop_import::ImportOptions;
use trimloop_mesh::{Silent, mesh_part};
use trimloop_tests::conversion::default_deflection;
use trimloop_tests::fixture;

const MODELS: [&str; 6] = [
    "cadquery/ellipsoid",
    "cadquery/loft_airfoil",
    "iges_opencascade/bspline_degree_3_brep",
    "iges_opencascade/ellipsoid_brep",
    "iges_opencascade/loft_airfoil_faces",
    "iges_opencascade/spline_revolved_brep",
];

/// Numbers of each file that are damaged, one at a time.
const DAMAGES: usize = 12;

/// Where the numbers with a decimal point lie in a file's data, wide enough for another.
fn numbers(text: &str) -> Vec<std::ops::Range<usize>> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | 'E');
    let mut out = Vec::new();
    let mut at = 0;
    for token in text.split(|c| !is_part(c)) {
        if token.contains('.') && token.len() >= 4 && token.parse::<f64>().is_ok() {
            out.push(at..at + token.len());
        }
        at += token.len() + 1;
    }
    out
}

#[test]
fn one_wild_number_takes_no_millions_of_triangles() {
    let folder = tempfile::tempdir().expect("a folder");
    let fixtures = fixture::all();
    let damaged = MODELS.par_iter().flat_map(|name| {
        let fixture = fixtures.iter().find(|fixture| fixture.name == *name);
        let path = &fixture.unwrap_or_else(|| panic!("{name} is a fixture")).path;
        let text = fs::read_to_string(path).expect("text");
        let data = text.find("DATA;").or_else(|| text.find("D0000001")).expect("data");
        let all: Vec<_> = numbers(&text).into_iter().filter(|number| number.start > data).collect();
        let step = (all.len() / DAMAGES).max(1);
        let pick = all.into_iter().step_by(step).collect::<Vec<_>>();
        pick.into_par_iter().map(move |number| {
            let mut text = text.clone();
            let wild = format!("{:<width$}", "1.E9", width = number.len());
            text.replace_range(number.clone(), &wild);
            (path.extension().expect("an extension").to_owned(), number.start, text, *name)
        })
    });
    let findings: Vec<String> = damaged
        .filter_map(|(extension, at, text, name)| {
            let path = folder.path().join(format!("{}-{at}", name.replace('/', "-")));
            let path = path.with_extension(extension);
            fs::write(&path, text).expect("room");
            let triangles = triangles(&path);
            (triangles > 2_000_000).then(|| format!("{name} at {at}: {triangles} triangles"))
        })
        .collect();
    assert!(findings.is_empty(), "{findings:#?}");
}

/// The triangles that a file comes to, if anything.
fn triangles(path: &Path) -> usize {
    let Ok(model) = trimloop_import::read(path, &ImportOptions::default()) else { return 0 };
    let mesh = |part| mesh_part(part, &default_deflection(), &Silent).expect("nobody cancels");
    model.parts.iter().map(mesh).flat_map(|mesh| mesh.faces).map(|face| face.triangles.len()).sum()
}
