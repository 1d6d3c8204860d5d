//! Whether a picture is what it claims to be.

use rayon::prelude::*;

use crate::picture::{Pick, Seen};
use crate::{Camera, CpuRenderer, Look, RenderError, Renderer, Scene};

/// How far a picture is from the exact model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pixels that show a face.
    pub covered: usize,
    /// The largest distance of a pixel's middle from the projection of the exact point at its parameters, pixels.
    pub farthest_px: f64,
    /// Pixels for which that is more than half a pixel.
    pub off: usize,
    /// Pixels that show the background, or something farther away, where the reference shows a face all around.
    pub cracks: usize,
    /// Pixels that show a face where the reference has nothing near it, or something in front.
    pub spills: usize,
    /// Pixels without an exact point: triangles.
    pub unproved: usize,
}

impl Proof {
    /// Whether every pixel is within half a pixel, and nothing is open.
    pub fn holds(&self) -> bool {
        self.off == 0 && self.cracks == 0 && self.spills == 0
    }
}

/// Depths may differ by this share of the picture's depth and still be the same face.
const SAME_DEPTH: f64 = 2e-3;

/// Compares what every pixel of a picture shows with the exact surfaces, and with `reference`: triangles of the same
/// model, as fine as is affordable.
///
/// # Errors
/// What the device refuses.
pub fn prove(
    renderer: &mut Renderer,
    reference: &CpuRenderer,
    camera: &Camera,
    size: [u32; 2],
    look: &Look,
) -> Result<Proof, RenderError> {
    let own = renderer.seen(camera, size, look)?;
    let wanted = reference.seen(camera, size, look)?;
    let scene = renderer.scene();
    let of =
        |seen: &Seen| -> Vec<Spot> { seen.pixels.par_iter().map(|p| Spot::of(scene, camera, p)).collect() };
    let (own, wanted) = (of(&own), of(&wanted));
    let depths = || own.iter().chain(&wanted).map(|s| s.depth).filter(|d| d.is_finite());
    let range = depths().fold(f64::NEG_INFINITY, f64::max) - depths().fold(f64::INFINITY, f64::min);
    let slack = SAME_DEPTH * range.max(0.0)
        + 2.0 * camera.pixel(size[1]) * if camera.is_parallel() { 1.0 } else { depths().fold(0.0, f64::max) };
    let mut proof = Proof::default();
    let [width, height] = size.map(|n| n as usize);
    for (k, spot) in own.iter().enumerate() {
        let (x, y) = (k % width, k / width);
        let middle = glam::DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        if let Some(point) = spot.point {
            proof.covered += 1;
            let off = camera.project(point, size).map_or(f64::INFINITY, |at| at.distance(middle));
            proof.farthest_px = proof.farthest_px.max(off);
            proof.off += usize::from(off > 0.5);
        } else if spot.is_covered {
            proof.covered += 1;
            proof.unproved += 1;
            continue;
        }
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let around =
            rows.flat_map(|j| (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |i| j * width + i));
        let near: Vec<&Spot> = around.map(|k| &wanted[k]).collect();
        if near.iter().any(|s| s.is_covered && s.point.is_none()) {
            continue;
        }
        let farthest = near.iter().map(|s| s.depth).fold(f64::NEG_INFINITY, f64::max);
        let nearest = near.iter().map(|s| s.depth).fold(f64::INFINITY, f64::min);
        proof.cracks += usize::from(spot.depth > farthest + slack);
        proof.spills += usize::from(spot.depth < nearest - slack);
    }
    Ok(proof)
}

/// What a pixel shows.
struct Spot {
    is_covered: bool,
    point: Option<glam::DVec3>,
    /// Infinite for the background.
    depth: f64,
}

impl Spot {
    fn of(scene: &Scene, camera: &Camera, pick: &Option<Pick>) -> Self {
        let point = pick.as_ref().and_then(|pick| scene.point(pick));
        let depth = point.map_or(f64::INFINITY, |p| -camera.to_eye(p).z);
        Self { is_covered: pick.is_some(), point, depth }
    }
}
