//! The reference trim mask against the exact classifier, face by face.

use glam::DVec2;
use trimloop_brep::{FaceGeometry, FaceId, Part};
use trimloop_tests::conversion::fine_deflection;
use trimloop_trim::polygon::segment_distance;
use trimloop_trim::{Classifier, EdgeSamples, Side, Tolerance, TrimDomain, TrimMask, sample_edges};

use crate::{DEFAULT, all_hold};

/// Pixels in each direction.
const PIXELS: u32 = 32;

#[test]
fn mask_and_classifier_differ_at_the_boundary_alone() {
    all_hold(&DEFAULT, |_, conversion| {
        let mut lines = Vec::new();
        for (part, mesh) in conversion.model.parts.iter().zip(&conversion.meshes) {
            let angular_rad = fine_deflection().angular_deflection_rad;
            let tolerance = Tolerance { linear_mm: 0.1 * mesh.linear_deflection_mm, angular_rad };
            let samples = sample_edges(part, tolerance);
            for (id, face) in part.faces.iter().enumerate() {
                if let FaceGeometry::Surface(_) = &face.geometry
                    && let Ok(domain) = TrimDomain::new(part, id as FaceId, &samples, tolerance)
                    && let Some(line) = difference(part, id as FaceId, &samples, &domain)
                {
                    lines.push(format!("{}: {line}", face.entity));
                }
            }
        }
        lines
    });
}

/// The first pixel away from the boundary on which the two disagree.
fn difference(part: &Part, face: FaceId, samples: &EdgeSamples, domain: &TrimDomain) -> Option<String> {
    let (low, high) = domain.uv_bounds();
    let margin = (high - low) * 0.07;
    let (low, high) = (low - margin, high + margin);
    let mask = TrimMask::draw(domain, low, high, PIXELS, PIXELS).ok()?;
    let classifier = Classifier::new(part, face, samples, domain)?;
    let pixels = (0..PIXELS).flat_map(|row| (0..PIXELS).map(move |column| (column, row)));
    pixels.into_iter().find_map(|(column, row)| {
        let uv = mask.pixel_centre(column, row);
        let drawn = mask.is_inside(column, row);
        let exact = classifier.classify(uv) == Side::Inside;
        if drawn == exact {
            return None;
        }
        let scale = f64::from(PIXELS) / (high - low);
        let away = boundary_distance(domain, uv, scale);
        (away > std::f64::consts::SQRT_2)
            .then(|| format!("at {uv}, {away:.1} pixels away: drawn {drawn}, exactly {exact}"))
    })
}

/// Distance of a point from the domain's boundary, in pixels.
fn boundary_distance(domain: &TrimDomain, uv: DVec2, scale: DVec2) -> f64 {
    let sides = domain.loops.iter().flat_map(|l| {
        let next = l.uvs().cycle().skip(1);
        l.uvs().zip(next)
    });
    sides.map(|(a, b)| segment_distance(uv * scale, a * scale, b * scale)).fold(f64::INFINITY, f64::min)
}
