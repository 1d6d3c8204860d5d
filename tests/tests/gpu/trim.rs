//! Trim masks of every fixture face against the exact classifier.

use glam::DVec2;
use rayon::prelude::*;
use trimloop_brep::{FaceGeometry, Part};
use trimloop_geom::Interval;
use trimloop_gpu::{CHANNELS, FaceShape, FaceShapes, TrimFans, TrimTable, trim_textures};
use trimloop_import::ImportOptions;
use trimloop_tests::fixture;
use trimloop_trim::curves::trim_curves;
use trimloop_trim::polygon::segment_distance;
use trimloop_trim::{Classifier, Side, Tolerance, TrimMask};

use crate::gpu;

/// Texels along u and along v.
const TEXELS: usize = 24;
/// What a wrong texel may be away from the exact curve, as a share of the face's extent along u and v.
const ALLOWED: f64 = 1e-5;

#[test]
fn exact_classification_is_exact() {
    let tolerance = Tolerance { linear_mm: 0.02, angular_rad: 0.2 };
    // Of damaged files nobody knows what their faces are.
    let fixtures: Vec<_> =
        fixture::all().into_iter().filter(|fixture| fixture.reference().is_some()).collect();
    let models = fixtures.par_iter().filter_map(|fixture| {
        let model = trimloop_import::read(&fixture.path, &ImportOptions::default()).ok()?;
        Some((fixture.name.clone(), model))
    });
    let models: Vec<_> = models.collect();
    let found: Vec<(usize, Vec<String>)> = models
        .par_iter()
        .flat_map_iter(|(name, model)| model.parts.iter().map(move |part| (name, part)))
        .map(|(name, part)| {
            let shapes = FaceShapes::new(part, tolerance);
            let faces = shapes.faces.iter().filter_map(|face| face.as_ref().ok());
            let wrong: Vec<Vec<String>> = faces.map(|face| wrong_texels(name, part, &shapes, face)).collect();
            (wrong.len(), wrong.concat())
        })
        .collect();
    let faces: usize = found.iter().map(|(count, _)| count).sum();
    let wrong: Vec<String> = found.into_iter().flat_map(|(_, wrong)| wrong).collect();
    println!("{faces} faces, {TEXELS} x {TEXELS} texels each, {} wrong", wrong.len());
    assert!(faces > 3000);
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong[..wrong.len().min(40)].join("\n"));
}

fn wrong_texels(name: &str, part: &Part, shapes: &FaceShapes, face: &FaceShape) -> Vec<String> {
    let chains = trim_curves(part, face.face, &shapes.samples, &face.domain, 1e-6);
    let Ok(table) = TrimTable::new(&chains, 64) else { return Vec::new() };
    let Some(classifier) = Classifier::new(part, face.face, &shapes.samples, &face.domain) else {
        return Vec::new();
    };
    let (low, high) = table.bounds();
    let margin = (high - low) * 0.05;
    let (first, step) = (low - margin, (high - low + margin * 2.0) / TEXELS as f64);
    let centre = |k: usize| first + step * DVec2::new((k % TEXELS) as f64 + 0.5, (k / TEXELS) as f64 + 0.5);
    let centres: Vec<DVec2> = (0..TEXELS * TEXELS).map(centre).collect();
    let twin: Vec<bool> = centres.iter().map(|&uv| table.contains(uv)).collect();
    let mut out = Vec::new();
    // The device is asked about some faces; the twin does the same about all.
    if let Some(gpu) = gpu().filter(|_| face.face.is_multiple_of(8)) {
        let on_device = table.classify(gpu, &centres).expect("classified");
        for (k, (&device, &twin)) in on_device.iter().zip(&twin).enumerate() {
            if device != twin && boundary_distance(part, shapes, face, centres[k]) > ALLOWED {
                out.push(format!(
                    "{name} face {}: device {device}, twin {twin} at {}",
                    face.face, centres[k]
                ));
            }
        }
    }
    for (&uv, inside) in centres.iter().zip(twin) {
        if (classifier.classify(uv) == Side::Inside) != inside {
            let away = boundary_distance(part, shapes, face, uv);
            if away > ALLOWED {
                out.push(format!("{name} face {}: {inside} at {uv}, {away:.1e} away", face.face));
            }
        }
    }
    out
}

/// Distance from the exact boundary in the parameter plane, as a share of the extent.
fn boundary_distance(part: &Part, shapes: &FaceShapes, face: &FaceShape, uv: DVec2) -> f64 {
    let FaceGeometry::Surface(surface) = &part.faces[face.face as usize].geometry else { return 0.0 };
    let (low, high) = face.domain.uv_bounds();
    let extent = high - low;
    let point = surface.point(uv);
    let edges = part.faces[face.face as usize].loops.iter().flat_map(|l| &l.coedges).map(|coedge| {
        let parameters = &shapes.samples.edges[coedge.edge as usize].parameters;
        let (Some(&start), Some(&end)) = (parameters.first(), parameters.last()) else {
            return f64::INFINITY;
        };
        let curve = &part.edges[coedge.edge as usize].curve;
        let foot = curve.project_within(point, Interval::new(start.min(end), start.max(end)), None).point;
        ((surface.project(foot, Some(uv)).uv - uv) / extent).length()
    });
    let own = face.domain.loops.iter().flat_map(|l| {
        let next = l.vertices.iter().cycle().skip(1);
        l.vertices.iter().zip(next).filter(|(a, b)| a.point.max(b.point) >= face.domain.own_base)
    });
    let sides = own.map(|(a, b)| segment_distance(uv / extent, a.uv / extent, b.uv / extent));
    edges.chain(sides).fold(f64::INFINITY, f64::min)
}

/// Share of texels on which trim textures, their twin and `trim`'s mask differ from the exact classification.
#[test]
fn trim_textures_are_wrong_beside_curves_alone() {
    let Some(gpu) = gpu() else { return };
    let tolerance = Tolerance { linear_mm: 0.02, angular_rad: 0.2 };
    println!("{:>8} {:>10} {:>12} {:>12} {:>12}", "texels", "faces", "fans", "twin", "mask");
    for side in [16u32, 64, 256] {
        let (mut faces, mut wrong) = (0, [0usize; 3]);
        for name in [
            "cadquery/bracket",
            "cadquery/plate_with_hole",
            "cadquery/viviani",
            "freecad/fillets",
            "freecad/sweep",
        ] {
            let fixture = fixture::named(name);
            let model = trimloop_import::read(&fixture.path, &ImportOptions::default()).expect("readable");
            for part in &model.parts {
                let shapes = FaceShapes::new(part, tolerance);
                let usable: Vec<&FaceShape> =
                    shapes.faces.iter().filter_map(|face| face.as_ref().ok()).collect();
                for four in usable.chunks(CHANNELS) {
                    let fans: Vec<TrimFans> = four.iter().map(|face| fans_of(face)).collect();
                    let drawn = trim_textures(gpu, &fans, side, side).expect("drawn");
                    for ((face, fans), drawn) in four.iter().zip(&fans).zip(&drawn) {
                        let chains = trim_curves(part, face.face, &shapes.samples, &face.domain, 1e-6);
                        let table = TrimTable::new(&chains, 128).expect("curves");
                        let (low, high) = face.domain.uv_bounds();
                        let mask = TrimMask::draw(&face.domain, low, high, side, side).expect("drawn");
                        let twin = fans.texture(side, side);
                        for k in 0..side * side {
                            let exact = table.contains(mask.pixel_centre(k % side, k / side));
                            let own = [
                                drawn.texels[k as usize] > 127,
                                twin.texels[k as usize] > 127,
                                mask.is_inside(k % side, k / side),
                            ];
                            wrong
                                .iter_mut()
                                .zip(own)
                                .for_each(|(wrong, own)| *wrong += usize::from(own != exact));
                        }
                        faces += 1;
                    }
                }
            }
        }
        assert!(faces > 10, "{faces} faces");
        let share = wrong.map(|wrong| wrong as f64 / (faces * side as usize * side as usize) as f64);
        println!("{side:>8} {faces:>10} {:>12.6} {:>12.6} {:>12.6}", share[0], share[1], share[2]);
        assert!(share[0] < 0.01 && share[1] < 0.01, "{share:?}");
    }
}

fn fans_of(face: &FaceShape) -> TrimFans {
    let (low, high) = face.domain.uv_bounds();
    TrimFans::new(&face.domain, low, high)
}
