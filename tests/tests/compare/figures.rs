//! Exact figures against closed forms and integrals of an independent kind.

use rayon::prelude::*;
use trimloop_compare::figures;
use trimloop_tests::fixture;

use crate::shape;

/// Areas and volumes do not depend on the triangles: at a deflection as coarse as people use, they are those of the
/// surfaces. References rest on another quadrature, good to 1e-6 and in a few cases to 1e-4.
#[test]
fn figures_are_those_of_the_surfaces() {
    let failures: Vec<String> = fixture::all()
        .into_par_iter()
        .filter_map(|fixture| Some((fixture.reference()?, fixture)))
        .filter(|(reference, _)| reference.area_mm2.is_some_and(|area| area > 0.0))
        .flat_map_iter(|(reference, fixture)| {
            let found = figures(&shape(&fixture, 1e-3));
            let size = reference
                .bbox_mm
                .map_or(1.0, |[a, b]| (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt());
            // What the file itself does not agree on cannot be known better.
            let tolerance = 1e-4 + 20.0 * reference.sloppy_mm / size;
            let off = |found: f64, known: f64| (found / known - 1.0).abs();
            let mut lines = Vec::new();
            if let Some(area) = reference.area_mm2.filter(|area| off(found.area_mm2, *area) > tolerance) {
                lines.push(format!("{}: area {} instead of {area}", fixture.name, found.area_mm2));
            }
            let volume = reference.volume_mm3.filter(|volume| reference.closed && *volume > 0.0);
            if let Some(volume) = volume.filter(|volume| off(found.volume_mm3, *volume) > tolerance) {
                lines.push(format!("{}: volume {} instead of {volume}", fixture.name, found.volume_mm3));
            }
            lines
        })
        .collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn a_torus_and_a_ball_in_closed_form() {
    use std::f64::consts::PI;
    let torus = figures(&shape(&fixture::named("cadquery/torus"), 2e-3));
    let (major, minor) = (20.0, 5.0);
    assert!((torus.area_mm2 / (4.0 * PI * PI * major * minor) - 1.0).abs() < 1e-9);
    let volume = 2.0 * PI * PI * major * minor * minor;
    assert!((torus.volume_mm3 / volume - 1.0).abs() < 1e-9);
    // Of a solid torus: about its axis, and across it.
    let along = volume * (major * major + 0.75 * minor * minor);
    let across = volume * (4.0 * major * major + 5.0 * minor * minor) / 8.0;
    for (found, known) in torus.volume_moments_mm5.iter().zip([across, across, along]) {
        assert!((found / known - 1.0).abs() < 1e-9, "{found} {known}");
    }
    let ball = figures(&shape(&fixture::named("cadquery/sphere"), 2e-3));
    let radius = (ball.area_mm2 / (4.0 * PI)).sqrt();
    assert!((ball.volume_mm3 / (4.0 / 3.0 * PI * radius.powi(3)) - 1.0).abs() < 1e-8);
}
