//! Lines on the surface that are no edges of the model: cuts that open a closed surface, sides of a natural domain.

use glam::{DVec2, DVec3};

use crate::band::Chart;
use crate::chord::sag;

/// How often a piece of a line may be halved.
const MAX_DEPTH: u32 = 10;

#[derive(Clone, Copy)]
struct Station {
    uv: DVec2,
    point: DVec3,
    normal: Option<DVec3>,
}

/// The samples strictly between `from` and `to` of the straight line in the parameter plane, dense enough for the
/// chart's tolerance.
pub(crate) fn line(chart: &Chart<'_>, from: DVec2, to: DVec2) -> Vec<(DVec2, DVec3)> {
    let pieces = start_pieces(chart, from, to);
    let at = |k: usize| station(chart, from.lerp(to, k as f64 / pieces as f64));
    let mut out = Vec::new();
    let mut last = at(0);
    for k in 1..=pieces {
        let next = at(k);
        fill(chart, &last, &next, 0, &mut out);
        if k < pieces {
            out.push((next.uv, next.point));
        }
        last = next;
    }
    out
}

/// A whole turn needs pieces to start with: its ends are the same point.
fn start_pieces(chart: &Chart<'_>, from: DVec2, to: DVec2) -> usize {
    let turn = |period: Option<f64>, d: f64| period.map_or(0.0, |p| (d / p).abs());
    let periods = chart.surface.periods();
    let turns = turn(periods[0], to.x - from.x).max(turn(periods[1], to.y - from.y));
    let smooth = if chart.is_straight() { 1.0 } else { 4.0 };
    (turns * 8.0).ceil().max(smooth) as usize
}

fn station(chart: &Chart<'_>, uv: DVec2) -> Station {
    Station { uv, point: chart.surface.point(uv), normal: chart.surface.normal(uv) }
}

fn fill(chart: &Chart<'_>, a: &Station, b: &Station, depth: u32, out: &mut Vec<(DVec2, DVec3)>) {
    if depth >= MAX_DEPTH {
        return;
    }
    let middle = station(chart, (a.uv + b.uv) * 0.5);
    if !too_coarse(chart, a, b, &middle) {
        return;
    }
    fill(chart, a, &middle, depth + 1, out);
    out.push((middle.uv, middle.point));
    fill(chart, &middle, b, depth + 1, out);
}

fn too_coarse(chart: &Chart<'_>, a: &Station, b: &Station, middle: &Station) -> bool {
    let chord = b.point - a.point;
    if chord.length().max(middle.point.distance(a.point)) <= chart.tolerance.shortest_chord_mm() {
        return false;
    }
    let quarter = |share: f64| chart.surface.point(a.uv.lerp(b.uv, share));
    let off = sag(a.point, chord, [quarter(0.25), middle.point, quarter(0.75)]);
    let turn = match (a.normal, b.normal) {
        (Some(a), Some(b)) => a.angle_between(b),
        _ => 0.0,
    };
    off > chart.tolerance.linear_mm || turn > chart.tolerance.angular_rad * 1.001
}
