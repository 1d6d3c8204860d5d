//! Points inside a face, to start its triangulation with.

use glam::DVec2;
use trimloop_trim::TrimDomain;

use crate::warp::Warp;

/// The crossings of the warp's lines that lie inside the domain and not next to its boundary; (u, v) of each.
pub(crate) fn seeds(domain: &TrimDomain, warp: &Warp) -> Vec<DVec2> {
    let [us, vs] = &warp.lines;
    if us.is_empty() || vs.is_empty() {
        return Vec::new();
    }
    let xs: Vec<f64> = us.iter().map(|&u| warp.map(DVec2::new(u, 0.0)).x).collect();
    let ys: Vec<f64> = vs.iter().map(|&v| warp.map(DVec2::new(0.0, v)).y).collect();
    let segments = warped_segments(domain, warp);
    let near = mark_near(&segments, &xs, &ys);
    let crossings = crossings_by_row(&segments, &ys);
    let mut out = Vec::new();
    for (j, row) in crossings.iter().enumerate() {
        for pair in row.chunks_exact(2) {
            let first = xs.partition_point(|&x| x <= pair[0]);
            let last = xs.partition_point(|&x| x < pair[1]);
            let inside = (first..last).filter(|i| !near[j * xs.len() + i]);
            out.extend(inside.map(|i| DVec2::new(us[i], vs[j])));
        }
    }
    out
}

fn warped_segments(domain: &TrimDomain, warp: &Warp) -> Vec<(DVec2, DVec2)> {
    let mut out = Vec::new();
    for l in &domain.loops {
        let points: Vec<DVec2> = l.uvs().map(|uv| warp.map(uv)).collect();
        out.extend((0..points.len()).map(|i| (points[i], points[(i + 1) % points.len()])));
    }
    out
}

/// A boundary keeps the grid's points this far off, in steps.
const CLEARANCE: f64 = 0.5;

/// Which grid points (row j, column i at `j * xs.len() + i`) lie next to a segment.
fn mark_near(segments: &[(DVec2, DVec2)], xs: &[f64], ys: &[f64]) -> Vec<bool> {
    let mut near = vec![false; xs.len() * ys.len()];
    for &(a, b) in segments {
        let (low, high) = (a.min(b) - CLEARANCE, a.max(b) + CLEARANCE);
        let columns = xs.partition_point(|&x| x < low.x)..xs.partition_point(|&x| x <= high.x);
        let rows = ys.partition_point(|&y| y < low.y)..ys.partition_point(|&y| y <= high.y);
        for j in rows {
            for i in columns.clone() {
                let p = DVec2::new(xs[i], ys[j]);
                if trimloop_trim::polygon::segment_distance(p, a, b) < CLEARANCE {
                    near[j * xs.len() + i] = true;
                }
            }
        }
    }
    near
}

/// Per row the sorted x at which the boundary crosses it.
fn crossings_by_row(segments: &[(DVec2, DVec2)], ys: &[f64]) -> Vec<Vec<f64>> {
    let mut rows = vec![Vec::new(); ys.len()];
    for &(a, b) in segments {
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        let range = ys.partition_point(|&y| y < low.y)..ys.partition_point(|&y| y < high.y);
        for j in range {
            rows[j].push(low.x + (ys[j] - low.y) / (high.y - low.y) * (high.x - low.x));
        }
    }
    rows.iter_mut().for_each(|row| row.sort_by(f64::total_cmp));
    rows
}
