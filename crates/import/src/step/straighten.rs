//! Edges whose curve cannot be read, between faces that show what it was.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{Diagnostic, Diagnostics, Edge, EntityRef, Severity};
use trimloop_geom::{Curve, Interval, Surface};

use super::fault::Outcome;
use super::keyword::Kind;
use super::seeds::{EdgeCurve, EdgeSeed, FaceSurface, Seeds};
use super::table::Table;

/// How far from its faces a straight line may run to be taken for an edge, millimetres.
const ON_SURFACE_MM: f64 = 1e-3;

/// Replaces edges that could not be read by the straight line between their vertices, where that line lies on the
/// surfaces of all faces that meet there: then it is the edge.
pub(crate) fn straighten(
    table: &Table<'_>,
    seeds: &Seeds,
    points: &[Outcome<DVec3>],
    surfaces: &[Outcome<Arc<Surface>>],
    edges: &mut [Outcome<Edge>],
    diagnostics: &mut Diagnostics,
) {
    if edges.iter().all(Result::is_ok) {
        return;
    }
    let mut grounds: FxHashMap<u32, Vec<Option<&Surface>>> = FxHashMap::default();
    for face in &seeds.faces {
        let surface = match &face.surface {
            Ok(FaceSurface::Slot(slot)) => surfaces[*slot].as_deref().ok(),
            _ => None,
        };
        for coedge in face.loops.iter().flat_map(|bound| &bound.coedges) {
            if edges[coedge.edge as usize].is_err() {
                grounds.entry(coedge.edge).or_default().push(surface);
            }
        }
    }
    let mut broken: Vec<_> = grounds.into_iter().collect();
    broken.sort_unstable_by_key(|(edge, _)| *edge);
    for (id, surfaces) in broken {
        let seed = &seeds.edges[id as usize];
        let (Ok(start), Ok(end)) = (&points[seed.start as usize], &points[seed.end as usize]) else {
            continue;
        };
        if start == end {
            // A line of no length has no direction to be read.
            let EdgeCurve::Slot(slot) = seed.curve else { continue };
            if table.kind(seeds.curves[slot].0) == Kind::Line {
                edges[id as usize] = Ok(straight(table, seed, *start, *end));
            }
            continue;
        }
        if !surfaces.into_iter().flatten().all(|surface| runs_on(surface, *start, *end)) {
            continue;
        }
        if let Err(fault) = &edges[id as usize] {
            let message = format!("{}; the edge is straight as its faces show.", fault.message);
            diagnostics.push(Diagnostic::new(Severity::Error, "edge-straightened", fault.entity, message));
        }
        edges[id as usize] = Ok(straight(table, seed, *start, *end));
    }
}

/// The straight edge between two points; of no length where they are the same.
fn straight(table: &Table<'_>, seed: &EdgeSeed, start: DVec3, end: DVec3) -> Edge {
    let (direction, length) = if start == end { (DVec3::X, 0.0) } else { (end - start, 1.0) };
    Edge {
        entity: seed.index.map_or(EntityRef::None, |index| table.entity(index)),
        start: seed.start,
        end: seed.end,
        curve: Arc::new(Curve::Line { origin: start, direction }),
        range: Interval::new(0.0, length),
        same_sense: true,
    }
}

/// Whether the straight line between two points lies on a surface.
fn runs_on(surface: &Surface, start: DVec3, end: DVec3) -> bool {
    [0.25, 0.5, 0.75].iter().all(|&s| surface.project(start.lerp(end, s), None).distance <= ON_SURFACE_MM)
}
