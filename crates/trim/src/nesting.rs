//! Which polygon lies inside which.

use glam::DVec2;

use crate::TrimLoop;
use crate::polygon::contains;

/// For each polygon, in how many others it lies.
pub(crate) fn depths(loops: &[TrimLoop]) -> Vec<usize> {
    if loops.len() < 2 {
        return vec![0; loops.len()];
    }
    let boxes: Vec<(DVec2, DVec2)> = loops.iter().map(bounds).collect();
    let inside = |i: usize, j: usize| {
        let (low, high) = boxes[j];
        let p = probe(&loops[i], &loops[j]);
        p.cmpge(low).all() && p.cmple(high).all() && contains(loops[j].uvs(), p)
    };
    (0..loops.len()).map(|i| (0..loops.len()).filter(|&j| j != i && inside(i, j)).count()).collect()
}

/// A point of `l` that is not a corner of `other`, where there is one.
fn probe(l: &TrimLoop, other: &TrimLoop) -> DVec2 {
    let shared = |p: u32| other.vertices.iter().any(|v| v.point == p);
    let free = l.vertices.iter().take(64).find(|v| !shared(v.point));
    match (free, l.vertices.as_slice()) {
        (Some(v), _) => v.uv,
        (None, [a, b, ..]) => (a.uv + b.uv) * 0.5,
        (None, [a]) => a.uv,
        (None, []) => DVec2::ZERO,
    }
}

fn bounds(l: &TrimLoop) -> (DVec2, DVec2) {
    l.uvs().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), uv| (low.min(uv), high.max(uv)))
}
