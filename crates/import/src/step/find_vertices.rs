//! Vertices that cannot be read, found again where the edges' lines meet.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{Diagnostic, Diagnostics, Severity, VertexId};
use trimloop_geom::Curve;

use super::fault::Outcome;
use super::seeds::{EdgeCurve, Seeds};

/// How far apart two lines may pass to meet, millimetres.
const MEET_MM: f64 = 1e-3;

/// Puts vertices that could not be read where two lines of their edges meet, if they do.
pub(crate) fn find_vertices(
    seeds: &Seeds,
    points: &mut [Outcome<DVec3>],
    curves: &[Outcome<Arc<Curve>>],
    diagnostics: &mut Diagnostics,
) {
    if points.iter().all(Result::is_ok) {
        return;
    }
    let mut lines: FxHashMap<VertexId, Vec<(DVec3, DVec3)>> = FxHashMap::default();
    for edge in &seeds.edges {
        let EdgeCurve::Slot(slot) = edge.curve else { continue };
        let Ok(Curve::Line { origin, direction }) = curves[slot].as_deref() else { continue };
        for vertex in [edge.start, edge.end] {
            if points[vertex as usize].is_err() {
                lines.entry(vertex).or_default().push((*origin, *direction));
            }
        }
    }
    for (vertex, point) in points.iter_mut().enumerate() {
        let Err(fault) = point else { continue };
        let Some(met) = lines.get(&(vertex as VertexId)).and_then(|lines| common_point(lines)) else {
            continue;
        };
        let message = format!("{}; the vertex was put where its edges meet.", fault.message);
        diagnostics.push(Diagnostic::new(Severity::Error, "vertex-from-edges", fault.entity, message));
        *point = Ok(met);
    }
}

/// Where the first line meets the first other one that is not parallel to it; `None` where not all lines pass there.
fn common_point(lines: &[(DVec3, DVec3)]) -> Option<DVec3> {
    let &(a, along) = lines.first()?;
    let met = lines[1..].iter().find_map(|&(b, other)| {
        // Nearest points of two lines (the common normal has no part along either).
        let normal = along.cross(other);
        let t = (b - a).cross(other).dot(normal) / normal.length_squared();
        let crossing = normal.length() > 1e-6 * along.length() * other.length();
        crossing.then_some(a + along * t)
    })?;
    let passes = |&(origin, direction): &(DVec3, DVec3)| {
        (met - origin).cross(direction).length() <= MEET_MM * direction.length()
    };
    lines.iter().all(passes).then_some(met)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_lines_meet_in_a_corner() {
        let corner = DVec3::new(1.0, 2.0, 3.0);
        let lines = [DVec3::X, DVec3::Y * 5.0, DVec3::Z].map(|along| (corner - along * 7.0, along));
        assert!(common_point(&lines).unwrap().distance(corner) < 1e-12);
    }

    #[test]
    fn lines_that_pass_each_other_do_not_meet() {
        assert_eq!(common_point(&[(DVec3::ZERO, DVec3::X), (DVec3::Z, DVec3::Y)]), None);
        assert_eq!(common_point(&[(DVec3::ZERO, DVec3::X), (DVec3::ZERO, DVec3::X)]), None);
    }
}
