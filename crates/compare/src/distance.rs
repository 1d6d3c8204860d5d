//! How far one shape is from another, point to surface.

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use crate::bvh::{Bvh, Hit};
use crate::shape::Shape;
use crate::triangles::Triangles;

/// Distances from one shape to the other.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Distances {
    /// How many places were looked at.
    pub samples: usize,
    /// The largest distance.
    pub max_mm: f64,
    /// 99.9 % of the area is nearer than this.
    pub p999_mm: f64,
    /// Root of the mean square over the area.
    pub rms_mm: f64,
    /// Mean over the area.
    pub mean_mm: f64,
    /// Where the largest distance is.
    pub at_mm: [f64; 3],
    /// The place of the other shape that is nearest to that.
    pub nearest_mm: [f64; 3],
}

/// A place on a shape, and how far it is from the other one.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The place.
    pub point: DVec3,
    /// The nearest one of the other shape.
    pub nearest: DVec3,
    /// The distance between them.
    pub distance: f64,
    /// The patch that it is on.
    pub patch: u32,
    /// The other shape's patch that is nearest.
    pub other_patch: u32,
    /// The area that it stands for; none where it is there for the maximum's sake alone.
    pub weight: f64,
    /// Whether it is a corner of a triangle as the file has it.
    pub corner: bool,
    /// The triangle that it is on.
    pub triangle: u32,
    /// Whether the two shapes face opposite sides here.
    pub turned: bool,
}

/// A shape made ready to be asked for its nearest place.
pub struct Target<'s> {
    shape: &'s Shape,
    bvh: Bvh,
}

impl<'s> Target<'s> {
    /// Makes a shape ready.
    pub fn new(shape: &'s Shape) -> Self {
        Self { shape, bvh: Bvh::new(&shape.triangles) }
    }

    /// Whether the target faces the other way where it is nearest to a point: no triangle that faces about the same way
    /// as `normal` is as near (solids that touch have both).
    fn is_turned(&self, point: DVec3, normal: DVec3, hit: &Hit) -> bool {
        let facing = |triangle: u32| {
            self.shape.triangles.area_vector(triangle as usize).normalize_or_zero().dot(normal)
        };
        if facing(hit.triangle) >= -0.5 {
            return false;
        }
        let reach = hit.distance + 2.0 * self.shape.deviation_mm + 1e-9 * (1.0 + point.length());
        self.bvh.nearest_of(point, reach, |triangle| facing(triangle) > -0.5).is_none()
    }

    /// The place nearest to `point`: of the exact surface where there is one. `limit` is a distance within which some
    /// place is known to be.
    ///
    /// The exact one is the foot on the surface of the nearest triangles' face where that lies within the face. Where it
    /// lies beyond its boundary (or there is none), the nearest place is on an edge, where triangles and surfaces have
    /// the same points but for the sag of the chords.
    pub fn nearest(&self, point: DVec3, limit: f64) -> Option<(DVec3, Hit)> {
        let hit = self.bvh.nearest(point, limit).or_else(|| self.bvh.nearest(point, f64::INFINITY))?;
        let flat = Some((hit.point, hit));
        let Some(surface) = &self.shape.patch(hit.triangle).surface else { return flat };
        let (_, foot) = surface.foot(point, self.shape.uv_at(hit.triangle as usize, hit.weights));
        let slack = self.shape.deviation_mm;
        let distance = foot.distance(point);
        if distance > hit.distance + slack {
            return flat;
        }
        // Within the face, the foot has a triangle of it near.
        let patch = self.shape.patch_of[hit.triangle as usize];
        let reach = 1.5 * slack + 1e-9 * (1.0 + foot.length());
        match self.bvh.nearest(foot, reach) {
            Some(near) if self.shape.patch_of[near.triangle as usize] == patch || near.distance <= 1e-9 => {
                Some((foot, Hit { distance, ..hit }))
            }
            Some(near) => Some((foot, Hit { distance, triangle: near.triangle, ..hit })),
            None => flat,
        }
    }
}

/// Places on a shape: `count` of them spread evenly over its area, at least some on every patch, and every corner as
/// well, up to `MAX_CORNERS`. The same ones every time.
pub fn places(shape: &Shape, count: usize) -> Vec<Sample> {
    let areas: Vec<f64> =
        (0..shape.triangles.triangles.len()).map(|k| shape.triangles.area_vector(k).length()).collect();
    let total: f64 = areas.iter().sum();
    let mut of_patch: Vec<Vec<u32>> = vec![Vec::new(); shape.patches.len()];
    for (triangle, &patch) in shape.patch_of.iter().enumerate() {
        of_patch[patch as usize].push(triangle as u32);
    }
    let mut out = Vec::with_capacity(count + LEAST_PER_PATCH * shape.patches.len());
    for (patch, triangles) in of_patch.iter().enumerate() {
        let area: f64 = triangles.iter().map(|&t| areas[t as usize]).sum();
        if !(area > 0.0) {
            continue;
        }
        let own = ((count as f64 * area / total).ceil() as usize).max(LEAST_PER_PATCH);
        let (mut sum, mut triangle) = (0.0, 0);
        for k in 0..own {
            // A step through the area each, at another place within it each time (or they would keep step with what is
            // regular in the mesh), and in the triangle: three coordinates of a low-discrepancy sequence (R3).
            let want = (k as f64 + (k as f64 * R3[2]).fract()) / own as f64 * area;
            while triangle + 1 < triangles.len() && sum + areas[triangles[triangle] as usize] < want {
                sum += areas[triangles[triangle] as usize];
                triangle += 1;
            }
            let (mut s, mut t) = ((k as f64 * R3[0]).fract(), (k as f64 * R3[1]).fract());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let point = place(shape, triangles[triangle], [1.0 - s - t, s, t]);
            out.push(Sample::at(point, patch as u32, triangles[triangle], area / own as f64, false));
        }
    }
    let mut seen = vec![false; shape.triangles.points.len()];
    let mut corners = 0;
    for (k, (t, &patch)) in shape.triangles.triangles.iter().zip(&shape.patch_of).enumerate() {
        for &index in t {
            if corners < MAX_CORNERS && !std::mem::replace(&mut seen[index as usize], true) {
                corners += 1;
                out.push(Sample::at(shape.triangles.points[index as usize], patch, k as u32, 0.0, true));
            }
        }
    }
    out
}

const LEAST_PER_PATCH: usize = 24;
const MAX_CORNERS: usize = 4_000_000;
/// Powers of the inverse of the root of x⁴ = x + 1.
const R3: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];

/// The place of a triangle with these weights of its corners, on the exact surface where there is one.
fn place(shape: &Shape, triangle: u32, weights: [f64; 3]) -> DVec3 {
    match &shape.patch(triangle).surface {
        Some(surface) => surface.point(shape.uv_at(triangle as usize, weights)),
        None => flat_place(&shape.triangles, triangle, weights),
    }
}

fn flat_place(triangles: &Triangles, triangle: u32, [wa, wb, wc]: [f64; 3]) -> DVec3 {
    let [a, b, c] = triangles.corners(triangle as usize);
    a * wa + b * wb + c * wc
}

impl Sample {
    fn at(point: DVec3, patch: u32, triangle: u32, weight: f64, corner: bool) -> Self {
        let (nearest, distance, other_patch, turned) = (point, 0.0, 0, false);
        Self { point, nearest, distance, patch, other_patch, weight, corner, triangle, turned }
    }
}

/// Finds for each place how far it is from the target. `done` hears of every few thousand; where it answers false, the
/// rest is left.
pub fn measure(
    samples: &mut [Sample],
    shape: &Shape,
    target: &Target<'_>,
    done: &(dyn Fn(usize) -> bool + Sync),
) -> bool {
    samples
        .par_chunks_mut(2048)
        .map(|chunk| {
            let mut known: Option<(DVec3, DVec3)> = None;
            for sample in chunk.iter_mut() {
                // The last one's nearest place is a good bound for the next one's.
                let limit = known.map_or(f64::INFINITY, |(_, nearest)| {
                    nearest.distance(sample.point) * (1.0 + 1e-9) + 1e-12 + 2.0 * target.shape.deviation_mm
                });
                if let Some((nearest, hit)) = target.nearest(sample.point, limit) {
                    sample.nearest = nearest;
                    sample.distance = hit.distance;
                    sample.other_patch = target.shape.patch_of[hit.triangle as usize];
                    let normal = shape.triangles.area_vector(sample.triangle as usize).normalize_or_zero();
                    sample.turned = target.is_turned(sample.point, normal, &hit);
                    known = Some((sample.point, nearest));
                }
            }
            done(chunk.len())
        })
        .reduce(|| true, |a, b| a && b)
}

/// The figures of some samples.
pub fn distances<'a>(samples: impl Iterator<Item = &'a Sample> + Clone) -> Distances {
    let mut out = Distances::default();
    let Some(worst) = samples.clone().max_by(|a, b| a.distance.total_cmp(&b.distance)) else { return out };
    out.max_mm = worst.distance;
    out.at_mm = worst.point.to_array();
    out.nearest_mm = worst.nearest.to_array();
    let mut weighted: Vec<(f64, f64)> = Vec::new();
    for sample in samples {
        out.samples += 1;
        weighted.push((sample.distance, sample.weight));
    }
    // Of corners alone, each counts the same.
    if weighted.iter().all(|(_, weight)| *weight == 0.0) {
        weighted.iter_mut().for_each(|(_, weight)| *weight = 1.0);
    }
    let total: f64 = weighted.iter().map(|(_, weight)| weight).sum();
    if total > 0.0 {
        out.mean_mm = weighted.iter().map(|(d, w)| d * w).sum::<f64>() / total;
        out.rms_mm = (weighted.iter().map(|(d, w)| d * d * w).sum::<f64>() / total).sqrt();
        weighted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        let at = weighted.iter().find(|(_, w)| {
            sum += w;
            sum >= 0.999 * total
        });
        out.p999_mm = at.map_or(out.max_mm, |(d, _)| *d);
    }
    out
}
