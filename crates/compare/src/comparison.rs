//! Two shapes held against each other.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};
use serde::Serialize;

use crate::distance::{Distances, Sample, Target, distances, measure, places};
use crate::integrals::{Figures, figures, patch_areas};
use crate::shape::Shape;
use crate::topology::{Topology, topology};

/// What is known of one side.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Side {
    /// Whether its figures are integrals over exact surfaces.
    pub exact: bool,
    /// Area, volume, centroid, moments, box.
    pub figures: Figures,
    /// How its triangles hang together.
    pub topology: Topology,
    /// The largest distance between its triangles and its exact surface; 0 for meshes.
    pub deviation_mm: f64,
    /// Faces without triangles: name and reason.
    pub lost: Vec<String>,
}

/// A face of the CAD side (or a piece of A where both are meshes), and how far the other side is from it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct FaceDistances {
    /// `#14`, `D45`.
    pub name: String,
    /// The part (instances above it, `/` between them).
    pub part: String,
    /// `plane`, `nurbs`, …
    pub surface: String,
    /// Its area.
    pub area_mm2: f64,
    /// From the face to the other side.
    #[serde(flatten)]
    pub distances: Distances,
    /// From the other side's places that are nearest to this face, the largest.
    pub back_max_mm: f64,
    /// The share of its area near which the other side has something, within the gate.
    pub covered: f64,
    /// The share of its area where the other side faces the other way.
    pub turned: f64,
    /// How many corners of the other side's triangles lie on it, within the gate.
    pub corners: usize,
}

/// A part of the CAD side.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PartDistances {
    /// The part (instances above it, `/` between them).
    pub name: String,
    /// From the part to the other side.
    #[serde(flatten)]
    pub distances: Distances,
}

/// Two shapes held against each other.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Comparison {
    /// The diagonal of A's box, which shares are of.
    pub diagonal_mm: f64,
    /// The one side.
    pub a: Side,
    /// The other, the reference where there is one.
    pub b: Side,
    /// From A to B.
    pub a_to_b: Distances,
    /// From B to A.
    pub b_to_a: Distances,
    /// From the corners of B's triangles to A.
    pub b_corners_to_a: Distances,
    /// By face of the CAD side.
    pub faces: Vec<FaceDistances>,
    /// By part of the CAD side.
    pub parts: Vec<PartDistances>,
    /// Which side `faces` are of: `a` or `b`.
    pub faces_of: &'static str,
    /// The plane in which B is A's mirror image, where it is one.
    pub mirrored: Option<String>,
    /// The places on A and on B.
    #[serde(skip)]
    pub places: [Vec<Sample>; 2],
}

/// What is asked of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct CompareOptions {
    /// Places spread over each side, corners not counted.
    pub samples: usize,
    /// The distance within which places count as covered.
    pub near_mm: f64,
}

/// The user has asked to stop.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error("stopped")]
pub struct Stopped;

/// Holds two shapes against each other. `done` hears of places that were looked at and answers whether to go on.
///
/// # Errors
///
/// Where `done` has answered false.
pub fn compare(
    a: &Shape,
    b: &Shape,
    options: CompareOptions,
    done: &(dyn Fn(usize) -> bool + Sync),
) -> Result<Comparison, Stopped> {
    let (sides, targets) = rayon::join(
        || rayon::join(|| side(a), || side(b)),
        || rayon::join(|| Target::new(a), || Target::new(b)),
    );
    let mut on_a = places(a, options.samples);
    let mut on_b = places(b, options.samples);
    if !measure(&mut on_a, a, &targets.1, done) || !measure(&mut on_b, b, &targets.0, done) {
        return Err(Stopped);
    }
    let mut out = Comparison {
        diagonal_mm: a.triangles.bounds().diagonal(),
        a: sides.0,
        b: sides.1,
        a_to_b: distances(on_a.iter()),
        b_to_a: distances(on_b.iter()),
        b_corners_to_a: distances(on_b.iter().filter(|sample| sample.corner)),
        faces_of: if b.exact && !a.exact { "b" } else { "a" },
        ..Comparison::default()
    };
    let (shape, own, other) = if out.faces_of == "a" { (a, &on_a, &on_b) } else { (b, &on_b, &on_a) };
    out.faces = faces(shape, own, other, options.near_mm);
    out.parts = parts(shape, own);
    // A coarse mesh of something symmetric is no mirror image: where that is all, its corners lie on the shape.
    if out.b_corners_to_a.max_mm > options.near_mm {
        out.mirrored = mirror_plane(b, &targets.0, options.near_mm);
    }
    out.places = [on_a, on_b];
    Ok(out)
}

/// How many places compare() looks at: what `done` hears of, in all.
pub fn places_of(a: &Shape, b: &Shape, options: CompareOptions) -> usize {
    2 * options.samples + a.triangles.points.len() + b.triangles.points.len()
}

fn side(shape: &Shape) -> Side {
    let lost =
        shape.patches.iter().filter_map(|patch| Some(format!("{}: {}", patch.name, patch.lost.as_ref()?)));
    Side {
        exact: shape.exact,
        figures: figures(shape),
        topology: topology(&shape.triangles),
        deviation_mm: shape.deviation_mm,
        lost: lost.collect(),
    }
}

fn faces(shape: &Shape, own: &[Sample], other: &[Sample], near_mm: f64) -> Vec<FaceDistances> {
    let mut of: Vec<Vec<&Sample>> = vec![Vec::new(); shape.patches.len()];
    own.iter().for_each(|sample| of[sample.patch as usize].push(sample));
    let mut back: Vec<Vec<&Sample>> = vec![Vec::new(); shape.patches.len()];
    other.iter().for_each(|sample| back[sample.other_patch as usize].push(sample));
    let areas = patch_areas(shape);
    shape
        .patches
        .iter()
        .enumerate()
        .map(|(k, patch)| {
            let share = |holds: &dyn Fn(&Sample) -> bool| {
                let total: f64 = of[k].iter().map(|sample| sample.weight).sum();
                let held: f64 = of[k].iter().filter(|s| holds(s)).map(|sample| sample.weight).sum();
                if total > 0.0 { held / total } else { 0.0 }
            };
            FaceDistances {
                name: patch.name.clone(),
                part: patch.part.clone(),
                surface: patch.kind.to_owned(),
                area_mm2: areas[k],
                distances: distances(of[k].iter().copied()),
                back_max_mm: back[k].iter().map(|sample| sample.distance).fold(0.0, f64::max),
                covered: share(&|sample| sample.distance <= near_mm),
                turned: share(&|sample| sample.distance <= near_mm && sample.turned),
                corners: back[k].iter().filter(|s| s.corner && s.distance <= near_mm).count(),
            }
        })
        .collect()
}

fn parts(shape: &Shape, own: &[Sample]) -> Vec<PartDistances> {
    let mut of: BTreeMap<&str, Vec<&Sample>> = BTreeMap::new();
    for sample in own {
        of.entry(&shape.patches[sample.patch as usize].part).or_default().push(sample);
    }
    of.into_iter()
        .map(|(name, samples)| PartDistances {
            name: name.to_owned(),
            distances: distances(samples.iter().copied()),
        })
        .collect()
}

/// The plane in which a shape is the target's mirror image: through the origin, or through the middle of its box.
fn mirror_plane(shape: &Shape, target: &Target<'_>, near_mm: f64) -> Option<String> {
    let bounds = shape.triangles.bounds();
    let stride = (shape.triangles.points.len() / 4000).max(1);
    for (axis, name) in [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")] {
        let flip = DAffine3::from_scale(DVec3::ONE - axis * 2.0);
        for (through, middle) in [("the origin", DVec3::ZERO), ("the middle", bounds.center() * axis)] {
            let map = DAffine3::from_translation(middle) * flip * DAffine3::from_translation(-middle);
            let near = |point: DVec3| {
                target
                    .nearest(map.transform_point3(point), f64::INFINITY)
                    .is_some_and(|(_, hit)| hit.distance <= near_mm)
            };
            if shape.triangles.points.iter().step_by(stride).all(|&point| near(point)) {
                return Some(format!("{name}, through {through}"));
            }
        }
    }
    None
}
