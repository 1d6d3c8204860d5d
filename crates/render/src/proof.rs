//! Whether a picture is what it claims to be.

use glam::DVec3;
use rayon::prelude::*;

use crate::border::border_of;
use crate::picture::Pick;
use crate::{Camera, CpuRenderer, FaceKind, Look, RenderError, Renderer, Scene};

/// How far a picture is from the exact model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pixels that show a face.
    pub covered: usize,
    /// The largest distance of a pixel's middle from the projection of the exact point at its parameters, pixels.
    pub farthest_px: f64,
    /// Pixels for which that is more than half a pixel.
    pub off: usize,
    /// Likewise between a face and the edges that it shares, where the file leaves a gap that is bridged.
    pub bridged: usize,
    /// Pixels that show the background, or something farther away, where the reference shows a face all around, also within
    /// half a pixel.
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
/// model, as fine as is affordable. Without one, cracks and spills are not looked for.
///
/// # Errors
/// What the device refuses.
pub fn prove(
    renderer: &mut Renderer,
    reference: Option<&CpuRenderer>,
    camera: &Camera,
    size: [u32; 2],
    look: &Look,
) -> Result<Proof, RenderError> {
    let seen = renderer.seen(camera, size, look)?;
    let wanted = match reference {
        Some(reference) => reference.depths(camera, size, look)?,
        None => Vec::new(),
    };
    let scene = renderer.scene();
    let own: Vec<Spot> = seen.pixels.par_iter().map(|p| Spot::of(scene, camera, p)).collect();
    let depths = || wanted.iter().copied().filter(|d| d.is_finite());
    let range = depths().fold(f64::NEG_INFINITY, f64::max) - depths().fold(f64::INFINITY, f64::min);
    let slack = SAME_DEPTH * range.max(0.0)
        + 2.0 * camera.pixel(size[1]) * if camera.is_parallel() { 1.0 } else { depths().fold(0.0, f64::max) };
    let mut proof = Proof::default();
    let (mut cracks, mut spills) = (Vec::new(), Vec::new());
    let [width, height] = size.map(|n| n as usize);
    for (k, spot) in own.iter().enumerate() {
        let (x, y) = (k % width, k / width);
        let middle = glam::DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        if let Some(point) = spot.point {
            proof.covered += 1;
            let off = camera.project(point, size).map_or(f64::INFINITY, |at| at.distance(middle));
            match off {
                _ if off <= 0.5 => proof.farthest_px = proof.farthest_px.max(off),
                _ if off <= 0.5 + spot.gap_mm / spot.pixel_mm(camera, size) => proof.bridged += 1,
                _ => {
                    proof.farthest_px = proof.farthest_px.max(off);
                    proof.off += 1;
                }
            }
        } else if spot.is_covered {
            proof.covered += 1;
            proof.unproved += 1;
            continue;
        }
        if wanted.is_empty() {
            continue;
        }
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let around =
            rows.flat_map(|j| (x.saturating_sub(1)..=(x + 1).min(width - 1)).map(move |i| j * width + i));
        let near: Vec<f64> = around.map(|k| wanted[k]).collect();
        let farthest = near.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let nearest = near.iter().copied().fold(f64::INFINITY, f64::min);
        if spot.depth > farthest + slack {
            cracks.push(k);
        }
        if spot.depth < nearest - slack {
            // A sheet that is seen edge-on lies between the reference's samples.
            let is_on_face = |pick: &Pick| is_on_face(scene, camera, size, pick);
            if !seen.pixels[k].as_ref().is_some_and(is_on_face) {
                spills.push(k);
            }
        }
    }
    if let (false, Some(reference)) = (cracks.is_empty() && spills.is_empty(), reference) {
        // What is narrower than a pixel is seen in a finer picture.
        let fine = Fine { depths: reference.depths(camera, size.map(|n| n * FINER), look)?, size };
        cracks.retain(|&k| own[k].depth > fine.range(k)[1] + slack);
        spills.retain(|&k| own[k].depth < fine.range(k)[0] - slack);
    }
    Ok(Proof { cracks: cracks.len(), spills: spills.len(), ..proof })
}

/// Pixels of the finer picture along a pixel's side.
const FINER: u32 = 4;

/// A finer picture of the reference.
struct Fine {
    depths: Vec<f64>,
    /// Of the picture that is to be proved.
    size: [u32; 2],
}

impl Fine {
    /// The nearest and the farthest depth within half a pixel around a pixel.
    fn range(&self, pixel: usize) -> [f64; 2] {
        let [width, height] = self.size.map(|n| (n * FINER) as usize);
        let (x, y) = (pixel % self.size[0] as usize, pixel / self.size[0] as usize);
        let finer = FINER as usize;
        let span = |at: usize, most: usize| {
            (at * finer).saturating_sub(finer / 2)..(at * finer + finer + finer / 2).min(most)
        };
        let all = span(y, height).flat_map(|j| span(x, width).map(move |i| j * width + i));
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], k| {
            [low.min(self.depths[k]), high.max(self.depths[k])]
        })
    }
}

/// Whether the exact point is inside its face, or within half a pixel of its boundary.
fn is_on_face(scene: &Scene, camera: &Camera, size: [u32; 2], pick: &Pick) -> bool {
    let instance = &scene.instances[pick.instance];
    let FaceKind::Surface(face) = &scene.parts[instance.part].faces[pick.face].kind else { return true };
    let uv = face.parameters(pick.share);
    if face.domain.contains(uv) {
        return true;
    }
    let place = |p: DVec3| camera.project(instance.transform.transform_point3(p), size);
    let Some(own) = place(face.shape.derivatives(uv).point) else { return false };
    let off_mm = 1e-6 * face.shape.size();
    border_of(face, off_mm).iter().any(|s| match (place(s.a), place(s.b)) {
        (Some(a), Some(b)) => trimloop_trim::polygon::segment_distance(own, a, b) <= 0.5,
        _ => false,
    })
}

fn gap_mm(scene: &Scene, pick: &Pick) -> f64 {
    let instance = &scene.instances[pick.instance];
    let FaceKind::Surface(face) = &scene.parts[instance.part].faces[pick.face].kind else { return 0.0 };
    let m = instance.transform.matrix3;
    face.gap_mm * m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length())
}

/// What a pixel shows.
struct Spot {
    is_covered: bool,
    point: Option<glam::DVec3>,
    /// Infinite for the background.
    depth: f64,
    /// How far the face is away from its edges, as it is drawn.
    gap_mm: f64,
}

impl Spot {
    fn of(scene: &Scene, camera: &Camera, pick: &Option<Pick>) -> Self {
        let point = pick.as_ref().and_then(|pick| scene.point(pick));
        let depth = point.map_or(f64::INFINITY, |p| -camera.to_eye(p).z);
        Self {
            is_covered: pick.is_some(),
            point,
            depth,
            gap_mm: pick.as_ref().map_or(0.0, |p| gap_mm(scene, p)),
        }
    }

    /// Millimetres of a pixel there.
    fn pixel_mm(&self, camera: &Camera, size: [u32; 2]) -> f64 {
        camera.pixel(size[1]) * if camera.is_parallel() { 1.0 } else { self.depth }
    }
}
