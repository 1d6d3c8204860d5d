//! Tolerance-bound, watertight triangles for a part.
//!
//! Every edge is sampled once, by the tolerance of all its faces; faces are filled afterwards and never move an edge's
//! points, so that neighbours share their vertices.

mod assemble;
mod boundary;
mod crease;
mod draft;
mod ear_clipping;
mod face;
mod filling;
mod fringe;
mod limit;
mod monitor;
mod options;
mod orientation;
mod part_mesh;
mod seeds;
mod size;
mod strips;
mod topology;
mod triangulation;
mod warp;

pub use monitor::{Cancelled, Monitor, Silent};
pub use options::{LinearDeflection, MeshOptions};
pub use part_mesh::{CurveLine, EdgeLine, FaceMesh, FaceStatus, FaceVertex, PartMesh, ShellTopology};

use glam::DVec3;
use rayon::prelude::*;
use trimloop_brep::{Diagnostic, FreePoint, Part, Severity};
use trimloop_trim::{EdgeSamples, Tolerance, sample_curve, sample_edges};

use crate::face::FaceMesher;
use crate::limit::SiteLimit;
use crate::size::{most_mm, size_mm};

/// Meshes one part.
///
/// The result holds one [`FaceMesh`] per face; a face that cannot be meshed is [`FaceStatus::Lost`] and costs no other.
pub fn mesh_part(part: &Part, options: &MeshOptions, monitor: &dyn Monitor) -> Result<PartMesh, Cancelled> {
    let (deflection, size) = deflection_and_size_mm(part, options.linear_deflection);
    // Bounds are measured at a few points per chord and triangle; the margin covers what lies between them.
    let tolerance =
        Tolerance { linear_mm: deflection * 0.9, angular_rad: options.angular_deflection_rad * 0.99 }
            .clamped();
    let samples = sample_edges(part, tolerance);
    let limit = SiteLimit {
        most: (options.max_triangles / 4).max(1000),
        size_in_deflections: size / deflection,
        turn_in_deflections: std::f64::consts::TAU / tolerance.angular_rad,
    };
    let mesher = FaceMesher { part, samples: &samples, tolerance, limit };
    let drafts: Result<Vec<_>, Cancelled> = (0..part.faces.len() as u32)
        .into_par_iter()
        .map(|face| {
            if monitor.cancelled() {
                return Err(Cancelled);
            }
            let draft = mesher.mesh_guarded(face);
            monitor.face_done();
            Ok(draft)
        })
        .collect();
    let drafts = drafts?;
    let off = off_surface(part, &samples, deflection);
    let mut mesh = assemble::assemble(part, samples, drafts);
    mesh.diagnostics.extend(off);
    mesh.linear_deflection_mm = deflection;
    mesh.curves =
        part.curves.par_iter().map(|c| CurveLine { points: line(c, tolerance), color: c.color }).collect();
    mesh.curves.retain(|c| c.points.len() > 1);
    if !part.points.is_empty() {
        let arm = POINT_SHARE * size_mm(part);
        mesh.curves.extend(part.points.iter().flat_map(|point| cross(point, arm)));
    }
    Ok(mesh)
}

/// A point is shown as a cross whose arms are this share of the part's size.
const POINT_SHARE: f64 = 0.005;

/// Three lines through a point, along the axes.
fn cross(point: &FreePoint, arm: f64) -> [CurveLine; 3] {
    [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| CurveLine {
        points: vec![point.point - axis * arm, point.point + axis * arm],
        color: point.color,
    })
}

fn line(curve: &trimloop_brep::FreeCurve, tolerance: Tolerance) -> Vec<DVec3> {
    let points = sample_curve(&curve.curve, curve.range, tolerance);
    if points.iter().all(|p| p.is_finite()) { points } else { Vec::new() }
}

/// The bound in millimetres, never zero, and the part's size; more than that where the bound does not ask for it.
fn deflection_and_size_mm(part: &Part, deflection: LinearDeflection) -> (f64, f64) {
    let least = |size: f64| (size * 1e-7).max(1e-9);
    let (wanted, size) = match deflection {
        LinearDeflection::Absolute(mm) => {
            // What surely is enough need not be compared with the exact size.
            let most = most_mm(part);
            (mm, if most.is_finite() && mm >= least(most) { most } else { size_mm(part) })
        }
        LinearDeflection::Relative(share) => {
            let size = size_mm(part);
            (size * share, size)
        }
    };
    (wanted.max(least(size)), size)
}

/// Edges that lie off their surfaces by more than the bound.
fn off_surface(part: &Part, samples: &EdgeSamples, deflection_mm: f64) -> Vec<Diagnostic> {
    let mut out = Vec::new();
    for (edge, sampled) in part.edges.iter().zip(&samples.edges) {
        for side in sampled.sides.iter().filter(|s| s.off_surface_mm > deflection_mm.max(part.uncertainty_mm))
        {
            let face = part.faces[side.face as usize].entity;
            let text = format!("the edge lies up to {:.3e} mm off the face's surface", side.off_surface_mm);
            out.push(Diagnostic::new(Severity::Warning, "edge-off-surface", edge.entity, text).on_face(face));
        }
    }
    out
}
