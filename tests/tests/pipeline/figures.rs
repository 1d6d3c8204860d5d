//! Areas, volumes, boxes and centroids, against integrals over the exact surfaces.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use trimloop_brep::Model;
use trimloop_mesh::FaceStatus;
use trimloop_tests::conversion::Conversion;

use crate::{DEFAULT, FINE, Known, all_hold};

/// How far figures may be off.
struct Tolerance {
    area: f64,
    volume: f64,
    /// Share of the diagonal.
    place: f64,
}

const BY_DEFAULT: Tolerance = Tolerance { area: 0.01, volume: 0.02, place: 0.002 };
const WHEN_FINE: Tolerance = Tolerance { area: 0.001, volume: 0.002, place: 0.0002 };

#[test]
fn no_face_is_lost_and_all_are_counted() {
    all_hold(&DEFAULT, |reference, conversion| {
        let counts = shown_counts(&conversion.model);
        let mut lines = Vec::new();
        let mut placed = 0;
        for ((part, mesh), count) in conversion.model.parts.iter().zip(&conversion.meshes).zip(counts) {
            // A composite surface's patches are faces of one name.
            let shown = part.faces.iter().filter(|face| !face.hidden);
            placed += count * shown.map(|face| face.entity).collect::<HashSet<_>>().len();
            for (face, face_mesh) in part.faces.iter().zip(&mesh.faces) {
                if let FaceStatus::Lost(why) = &face_mesh.status {
                    lines.push(format!("{} is lost: {why}", face.entity));
                }
            }
        }
        if reference.faces.is_some_and(|faces| faces != placed) {
            lines.push(format!("{placed} faces, not {:?}", reference.faces));
        }
        lines
    });
}

/// How often each part is placed where nothing is hidden.
fn shown_counts(model: &Model) -> Vec<usize> {
    let mut counts = vec![0; model.parts.len()];
    let mut stack = model.roots.clone();
    while let Some(index) = stack.pop() {
        let node = &model.nodes[index];
        if !node.hidden {
            node.part.iter().for_each(|&part| counts[part] += 1);
            stack.extend(&node.children);
        }
    }
    counts
}

#[test]
fn areas() {
    let check = |known: &[Known], tolerance: &Tolerance| {
        all_hold(known, |reference, conversion| {
            let area = conversion.scene().measure().area_mm2;
            off(reference.area_mm2, area, tolerance.area).into_iter().collect()
        });
    };
    check(&DEFAULT, &BY_DEFAULT);
    check(&FINE, &WHEN_FINE);
}

#[test]
fn areas_of_faces() {
    all_hold(&FINE, |reference, conversion| {
        let areas = face_areas(conversion);
        let mut lines = Vec::new();
        for face in &reference.face_areas_mm2 {
            match areas.get(&face.entity) {
                None => lines.push(format!("{} is missing", face.entity)),
                Some(&area) => lines.extend(
                    off(Some(face.area_mm2), area, 0.005).map(|line| format!("{} {line}", face.entity)),
                ),
            }
        }
        lines
    });
}

#[test]
fn volumes() {
    let check = |known: &[Known], tolerance: &Tolerance| {
        all_hold(known, |reference, conversion| {
            let volume = conversion.scene().measure().volume_mm3;
            let expected = reference.volume_mm3.filter(|_| reference.closed);
            off(expected, volume, tolerance.volume).into_iter().collect()
        });
    };
    check(&DEFAULT, &BY_DEFAULT);
    check(&FINE, &WHEN_FINE);
}

#[test]
fn boxes_and_centroids() {
    let check = |known: &[Known], tolerance: &Tolerance| {
        all_hold(known, |reference, conversion| {
            let measure = conversion.scene().measure();
            let (Some(bbox), true) = (reference.bbox_mm, measure.area_mm2 > 0.0) else { return Vec::new() };
            let [low, high] = bbox.map(DVec3::from);
            let allowed = tolerance.place * high.distance(low) + 1.01 * reference.sloppy_mm;
            let mut lines = Vec::new();
            let [found_low, found_high] = measure.bbox_mm;
            let away = (found_low - low).abs().max((found_high - high).abs()).max_element();
            if away > allowed {
                lines.push(format!("box {found_low} {found_high}, not {low} {high}"));
            }
            let centroid = reference.area_centroid_mm.map(|c| DVec3::from(c.map(Option::unwrap_or_default)));
            if let Some(centroid) = centroid.filter(|c| c.distance(measure.centroid_mm) > allowed) {
                lines.push(format!("centroid {}, not {centroid}", measure.centroid_mm));
            }
            lines
        });
    };
    check(&DEFAULT, &BY_DEFAULT);
    check(&FINE, &WHEN_FINE);
}

#[test]
fn the_writer_says_what_it_wrote() {
    all_hold(&DEFAULT, |_, conversion| {
        let said: usize = conversion.written.parts.iter().map(|part| part.instances * part.triangles).sum();
        let found = conversion.scene().measure().triangles;
        if said == found { Vec::new() } else { vec![format!("said {said} triangles, the GLB has {found}")] }
    });
}

fn off(expected: Option<f64>, found: f64, tolerance: f64) -> Option<String> {
    let expected = expected?;
    let wrong = (found - expected).abs() > tolerance * expected.abs();
    wrong.then(|| format!("{found:.6}, not {expected:.6} ({:+.3} %)", 100.0 * (found / expected - 1.0)))
}

/// Area by the file's own name for the face, placed once.
fn face_areas(conversion: &Conversion) -> HashMap<String, f64> {
    let mut areas = HashMap::new();
    for (part, mesh) in conversion.model.parts.iter().zip(&conversion.meshes) {
        let mut of_part: HashMap<String, f64> = HashMap::new();
        for (face, face_mesh) in part.faces.iter().zip(&mesh.faces) {
            *of_part.entry(face.entity.to_string()).or_default() += face_mesh.area_mm2;
        }
        areas.extend(of_part);
    }
    areas
}
