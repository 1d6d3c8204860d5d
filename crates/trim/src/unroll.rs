//! A loop's samples in the parameter plane, unrolled over closed directions and led through poles.

use std::collections::HashMap;

use glam::DVec2;
use trimloop_brep::{FaceId, Loop};
use trimloop_geom::{Direction, Singularity, Surface};

use crate::{EdgeSamples, TrimError, TrimVertex};

/// A loop in the parameter plane, its inside to the left.
#[derive(Clone, Debug, Default)]
pub(crate) struct UnrolledLoop {
    /// In order; the last joins the first plus `winding` periods.
    pub vertices: Vec<TrimVertex>,
    /// How often it goes round in u and in v.
    pub winding: [i32; 2],
    /// Whether it runs along a seam both ways, a period apart: its inside is what it encloses.
    pub seamed: bool,
    /// Whether it leads through a pole, which it passes on the side that its direction tells.
    pub through_pole: bool,
}

/// A sample before unrolling.
#[derive(Clone, Copy)]
struct Raw {
    uv: DVec2,
    point: u32,
    singular: Option<u8>,
}

/// The loop `l` of `face` in the parameter plane of `surface`; run backwards where `reverse`, so that the inside lies
/// to the left of the surface's own normal.
pub(crate) fn unroll(
    l: &Loop,
    face: FaceId,
    reverse: bool,
    samples: &EdgeSamples,
    surface: &Surface,
    angular_rad: f64,
) -> Result<UnrolledLoop, TrimError> {
    let mut raw = gather(l, face, samples)?;
    if reverse {
        raw.reverse();
    }
    let periods = surface.periods();
    let singularities =
        if raw.iter().any(|r| r.singular.is_some()) { surface.singularities() } else { Vec::new() };
    // Start at a regular sample, so that every run of singular ones has a regular neighbour on both sides.
    if let Some(first) = raw.iter().position(|r| r.singular.is_none()) {
        raw.rotate_left(first);
    }
    let runs_both_ways =
        l.coedges.iter().any(|c| l.coedges.iter().any(|d| d.edge == c.edge && d.reversed != c.reversed));
    let through_pole = raw.iter().any(|r| r.singular.is_some());
    let out = Vec::with_capacity(raw.len() + 4);
    let unroller = Unroller { periods, singularities: &singularities, angular_rad, out };
    let unrolled = unroller.run(&raw);
    let seamed = runs_both_ways && has_seam(&unrolled.vertices);
    Ok(UnrolledLoop { seamed, through_pole, ..unrolled })
}

/// Whether a line is run both ways at different parameters.
fn has_seam(vertices: &[TrimVertex]) -> bool {
    let next = vertices.iter().cycle().skip(1);
    let segments: Vec<[TrimVertex; 2]> =
        vertices.iter().zip(next).map(|(a, b)| [*a, *b]).filter(|[a, b]| a.point != b.point).collect();
    let there: HashMap<[u32; 2], DVec2> = segments.iter().map(|[a, b]| ([a.point, b.point], a.uv)).collect();
    segments.iter().any(|[a, b]| there.get(&[b.point, a.point]).is_some_and(|&back| !is_at(back, b.uv)))
}

/// The loop without lines that it runs along and at once back again.
pub(crate) fn without_slits(vertices: Vec<TrimVertex>) -> Vec<TrimVertex> {
    let same = |a: &TrimVertex, b: &TrimVertex| a.point == b.point && is_at(a.uv, b.uv);
    let mut out: Vec<TrimVertex> = Vec::with_capacity(vertices.len());
    for vertex in vertices {
        if out.len() > 1 && same(&out[out.len() - 2], &vertex) {
            out.pop();
        } else {
            out.push(vertex);
        }
    }
    // The loop may have begun on such a line.
    let (mut from, mut to) = (0, out.len());
    while to - from > 2 {
        if same(&out[from + 1], &out[to - 1]) {
            (from, to) = (from + 1, to - 1);
        } else if same(&out[from], &out[to - 2]) {
            to -= 2;
        } else {
            break;
        }
    }
    out.truncate(to);
    out.drain(..from);
    out
}

/// Whether two parameters of one point are the same, and not a period apart.
fn is_at(a: DVec2, b: DVec2) -> bool {
    a.distance(b) <= 1e-6 * (1.0 + a.abs().max_element())
}

fn gather(l: &Loop, face: FaceId, samples: &EdgeSamples) -> Result<Vec<Raw>, TrimError> {
    let mut raw: Vec<Raw> = Vec::new();
    for coedge in &l.coedges {
        let edge = samples.edges.get(coedge.edge as usize).ok_or(TrimError::EdgeOffSurface)?;
        let side = edge.side(face).ok_or(TrimError::EdgeOffSurface)?;
        let at = |i: usize| Raw { uv: side.uv[i], point: edge.points[i], singular: side.singular[i] };
        let count = edge.points.len();
        let push = |raw: &mut Vec<Raw>, r: Raw| {
            // Where edges don't quite chain, both ends stay: the gap is closed by a straight piece.
            if raw.last().is_none_or(|last| last.point != r.point) {
                raw.push(r);
            }
        };
        if coedge.reversed {
            (0..count).rev().for_each(|i| push(&mut raw, at(i)));
        } else {
            (0..count).for_each(|i| push(&mut raw, at(i)));
        }
    }
    if raw.len() > 1 && raw[0].point == raw[raw.len() - 1].point {
        raw.pop();
    }
    if raw.iter().any(|r| !r.uv.is_finite()) {
        return Err(TrimError::EdgeOffSurface);
    }
    Ok(raw)
}

struct Unroller<'a> {
    periods: [Option<f64>; 2],
    singularities: &'a [Singularity],
    angular_rad: f64,
    out: Vec<TrimVertex>,
}

impl Unroller<'_> {
    fn run(mut self, raw: &[Raw]) -> UnrolledLoop {
        let mut i = 0;
        let mut current = raw.first().map_or(DVec2::ZERO, |r| r.uv);
        let first = current;
        while i < raw.len() {
            match raw[i].singular {
                Some(s) if raw[0].singular.is_none() => {
                    let run = raw[i..].iter().take_while(|r| r.singular == Some(s)).count();
                    let next = raw[(i + run) % raw.len()].uv;
                    current = self.through_pole(&raw[i..i + run], s, current, next);
                    i += run;
                }
                _ => {
                    current = self.near(raw[i].uv, current);
                    self.out.push(TrimVertex { uv: current, point: raw[i].point });
                    i += 1;
                }
            }
        }
        let end = self.near(first, current);
        let turns = |d: f64, period: Option<f64>| period.map_or(0, |p| (d / p).round() as i32);
        UnrolledLoop {
            vertices: self.out,
            winding: [turns(end.x - first.x, self.periods[0]), turns(end.y - first.y, self.periods[1])],
            ..UnrolledLoop::default()
        }
    }

    /// `uv` moved by whole periods to be nearest to `to`.
    fn near(&self, uv: DVec2, to: DVec2) -> DVec2 {
        let shift = |period: Option<f64>, d: f64| period.map_or(0.0, |p| (d / p).round() * p);
        let d = to - uv;
        uv + DVec2::new(shift(self.periods[0], d.x), shift(self.periods[1], d.y))
    }

    /// Runs along the pole's side of the domain from where the loop came in to where it leaves. Returns the last
    /// parameters, from which the loop goes on.
    fn through_pole(&mut self, run: &[Raw], singularity: u8, from: DVec2, next: DVec2) -> DVec2 {
        let s = self.singularities[singularity as usize];
        // (a, b): a runs along the pole's side, b across it. The inside lies to the left, so that along an upper side
        // the loop runs towards lower a, along a lower one towards higher a; u and v change roles by a quarter turn.
        let (along, across, period, from_a, next_a, from_b) = match s.constant {
            Direction::V => (DVec2::X, DVec2::Y, self.periods[0], from.x, next.x, from.y),
            Direction::U => (-DVec2::Y, DVec2::X, self.periods[1], -from.y, -next.y, from.x),
        };
        // Round a closed profile the pole comes again with every turn.
        let turn = match s.constant {
            Direction::V => self.periods[1],
            Direction::U => self.periods[0],
        };
        let at = turn.map_or(s.at, |turn| s.at + ((from_b - s.at) / turn).round() * turn);
        let upper = from_b < at;
        let step = match period {
            Some(p) => pole_step(next_a - from_a, p, upper),
            None => next_a - from_a,
        };
        let pieces = period.map_or(8, |p| pole_pieces(step / p, self.angular_rad));
        let point = |k: usize| run[(k * run.len() / (pieces + 1)).min(run.len() - 1)].point;
        for k in 0..=pieces {
            let a = from_a + step * k as f64 / pieces as f64;
            self.out.push(TrimVertex { uv: along * a + across * at, point: point(k) });
        }
        along * (from_a + step) + across * from_b
    }
}

/// Into how many pieces `turns` of a pole's side are cut: each at most 15 degrees and the angular bound.
pub(crate) fn pole_pieces(turns: f64, angular_rad: f64) -> usize {
    (turns.abs() * (std::f64::consts::TAU / angular_rad).clamp(24.0, 360.0)).ceil().max(1.0) as usize
}

/// How far the loop runs along a pole's side: leftwards on an upper side, rightwards on a lower one, and a whole period
/// where it leaves as it came (a seam).
fn pole_step(difference: f64, period: f64, upper: bool) -> f64 {
    let forward = difference.rem_euclid(period);
    let step = if upper { period - forward } else { forward };
    let step = if step < 1e-6 * period || step > (1.0 - 1e-6) * period { period } else { step };
    if upper { -step } else { step }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use glam::DVec2;

    use super::{has_seam, pole_step, without_slits};
    use crate::TrimVertex;

    fn polygon(corners: &[(u32, f64, f64)]) -> Vec<TrimVertex> {
        corners.iter().map(|&(point, u, v)| TrimVertex { uv: DVec2::new(u, v), point }).collect()
    }

    /// Points 1 and 2 lie on the seam: of a tube run round once, and of a hole with a line that leads from it.
    #[test]
    fn a_seam_is_run_along_a_period_apart_and_a_slit_is_not() {
        let tube = polygon(&[(1, 0.0, 0.0), (1, TAU, 0.0), (2, TAU, 5.0), (2, 0.0, 5.0)]);
        assert!(has_seam(&tube));
        assert_eq!(without_slits(tube.clone()), tube);
        let hole = [(0, 1.0, 1.0), (1, 0.0, 1.0), (2, 0.0, 4.0), (1, 0.0, 1.0), (3, 1.0, 0.0)];
        let bare = [(0, 1.0, 1.0), (1, 0.0, 1.0), (3, 1.0, 0.0)];
        assert!(!has_seam(&polygon(&hole)));
        for start in 0..hole.len() {
            let mut turned = hole;
            turned.rotate_left(start);
            let mut left = without_slits(polygon(&turned));
            let first = left.iter().position(|vertex| vertex.point == 0).expect("a corner of the hole");
            left.rotate_left(first);
            assert_eq!(left, polygon(&bare), "from {start}");
        }
    }

    #[test]
    fn a_loop_turns_left_at_a_pole() {
        assert_eq!(pole_step(PI / 2.0, TAU, false), PI / 2.0);
        assert_eq!(pole_step(-PI / 2.0, TAU, true), -PI / 2.0);
        assert_eq!(pole_step(PI / 2.0, TAU, true), -1.5 * PI);
    }

    #[test]
    fn a_seam_at_a_pole_is_a_whole_turn() {
        assert_eq!(pole_step(0.0, TAU, true), -TAU);
        assert_eq!(pole_step(1e-12, TAU, false), TAU);
    }
}
