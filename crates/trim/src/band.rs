//! From unrolled loops to a domain: bands round a closed surface, caps over a pole, whole surfaces, flat pieces.

use glam::{DVec2, DVec3};
use trimloop_brep::{Diagnostic, EntityRef, Severity};
use trimloop_geom::{Direction, Interval, Surface};

use crate::polygon::{contains, segments_cross, signed_area};
use crate::unroll::{UnrolledLoop, pole_pieces, without_slits};
use crate::{Tolerance, TrimDomain, TrimError, TrimLoop, TrimVertex, cut};

/// A surface with the tolerance that lines on it are sampled by.
pub(crate) struct Chart<'a> {
    pub surface: &'a Surface,
    pub tolerance: Tolerance,
}

impl Chart<'_> {
    /// Whether isoparametric lines across the closed direction are straight.
    pub fn is_straight(&self) -> bool {
        matches!(self.surface, Surface::Plane { .. } | Surface::Cylinder { .. } | Surface::Cone { .. })
    }
}

/// Makes `loops` into polygons of `domain`.
pub(crate) fn assemble(
    chart: &Chart<'_>,
    loops: Vec<UnrolledLoop>,
    domain: &mut TrimDomain,
) -> Result<(), TrimError> {
    if loops.is_empty() {
        return whole(chart, Vec::new(), domain);
    }
    let (around, flat): (Vec<_>, Vec<_>) = loops.into_iter().partition(|l| l.winding != [0, 0]);
    if around.is_empty() {
        return flat_piece(chart, flat, domain);
    }
    let flat: Vec<Vec<TrimVertex>> = flat.into_iter().map(|l| l.vertices).collect();
    let axis = match (around.iter().all(|l| l.winding[1] == 0), around.iter().all(|l| l.winding[0] == 0)) {
        (true, _) => Direction::U,
        (_, true) => Direction::V,
        _ => return Err(TrimError::Winding("a loop goes round the surface in both directions")),
    };
    band(&Turned::new(chart, axis), around, flat, domain)
}

/// Loops that go round nothing: the largest is the boundary, unless it runs clockwise round a hole in a closed surface.
fn flat_piece(chart: &Chart<'_>, loops: Vec<UnrolledLoop>, domain: &mut TrimDomain) -> Result<(), TrimError> {
    let seamed: Vec<bool> = loops.iter().map(|l| l.seamed).collect();
    let loops: Vec<Vec<TrimVertex>> = loops.into_iter().map(|l| l.vertices).collect();
    let area = |l: &Vec<TrimVertex>| signed_area(l.iter().map(|v| v.uv));
    let outer = (0..loops.len()).max_by(|&i, &j| area(&loops[i]).abs().total_cmp(&area(&loops[j]).abs()));
    let Some(outer) = outer else { return Ok(()) };
    // A loop that brings its own seam encloses the face whatever its direction, which some writers get wrong.
    if area(&loops[outer]) < 0.0 && !seamed[outer] && closes_up(chart.surface) {
        // Lines that are run both ways lie in the face, and only lead from one part of a hole to another.
        return whole(chart, loops.into_iter().map(without_slits).collect(), domain);
    }
    let mut loops = loops;
    let boundary = loops.remove(outer);
    let periods = chart.surface.periods();
    if periods != [None, None] {
        loops.iter_mut().for_each(|hole| move_inside(hole, &boundary, periods));
    }
    domain.loops.push(TrimLoop { vertices: boundary, turned: false });
    domain.loops.extend(loops.into_iter().map(|vertices| TrimLoop { vertices, turned: false }));
    Ok(())
}

/// Whether the surface bounds a volume of itself: sphere, torus.
pub(crate) fn closes_up(surface: &Surface) -> bool {
    let [u, v] = surface.periods();
    let [du, dv] = surface.domain();
    let singular = |constant: Direction, at: f64, range: f64| {
        surface
            .singularities()
            .iter()
            .any(|s| s.constant == constant && (s.at - at).abs() <= 1e-9 * range.max(1e-9))
    };
    let ends = |c: Direction, d: Interval| {
        d.is_finite() && singular(c, d.start, d.length()) && singular(c, d.end, d.length())
    };
    match (u, v) {
        (Some(_), Some(_)) => true,
        (Some(_), None) => ends(Direction::V, dv),
        (None, Some(_)) => ends(Direction::U, du),
        (None, None) => false,
    }
}

/// Moves `hole` by whole periods so that it lies inside `boundary`.
fn move_inside(hole: &mut [TrimVertex], boundary: &[TrimVertex], periods: [Option<f64>; 2]) {
    let shifts = |period: Option<f64>| -> Vec<f64> {
        period.map_or(vec![0.0], |p| [0.0, 1.0, -1.0, 2.0, -2.0].iter().map(|k| k * p).collect())
    };
    let score = |shift: DVec2| {
        let step = hole.len().div_ceil(8).max(1);
        let probes = hole.iter().step_by(step);
        probes.filter(|v| contains(boundary.iter().map(|b| b.uv), v.uv + shift)).count()
    };
    let mut best = (score(DVec2::ZERO), DVec2::ZERO);
    for dv in shifts(periods[1]) {
        for du in shifts(periods[0]) {
            let shift = DVec2::new(du, dv);
            let s = score(shift);
            if s > best.0 {
                best = (s, shift);
            }
        }
    }
    hole.iter_mut().for_each(|v| v.uv += best.1);
}

/// The parameter plane turned so that `a` runs round the surface and `b` across; orientation is kept.
struct Turned<'a> {
    chart: &'a Chart<'a>,
    axis: Direction,
    period: f64,
    period_across: Option<f64>,
}

impl<'a> Turned<'a> {
    fn new(chart: &'a Chart<'a>, axis: Direction) -> Self {
        let [u, v] = chart.surface.periods();
        let (along, across) = if axis == Direction::U { (u, v) } else { (v, u) };
        Self { chart, axis, period: along.unwrap_or(1.0), period_across: across }
    }

    fn to_ab(&self, uv: DVec2) -> DVec2 {
        if self.axis == Direction::U { uv } else { DVec2::new(uv.y, -uv.x) }
    }

    fn to_uv(&self, ab: DVec2) -> DVec2 {
        if self.axis == Direction::U { ab } else { DVec2::new(-ab.y, ab.x) }
    }

    /// Where the surface ends beyond `b` on the upper or the lower side: (b, whether that side is a single point).
    fn end_beyond(&self, b: f64, upper: bool) -> Option<(f64, bool)> {
        let sign = if self.axis == Direction::U { 1.0 } else { -1.0 };
        let constant = if self.axis == Direction::U { Direction::V } else { Direction::U };
        let beyond = |at: f64| if upper { at > b } else { at < b };
        let poles = self.chart.surface.singularities();
        let pole =
            poles.iter().filter(|s| s.constant == constant).map(|s| s.at * sign).filter(|&at| beyond(at));
        let pole = pole.min_by(|x, y| (x - b).abs().total_cmp(&(y - b).abs()));
        if let Some(pole) = pole {
            return Some((pole, true));
        }
        let domain = self.chart.surface.domain()[if self.axis == Direction::U { 1 } else { 0 }];
        let ends = [domain.start * sign, domain.end * sign];
        ends.into_iter().find(|&e| e.is_finite() && beyond(e)).map(|e| (e, false))
    }
}

/// A loop in (a, b) that goes round once, towards higher `a`.
struct Ring {
    vertices: Vec<TrimVertex>,
}

impl Ring {
    fn mean_b(&self) -> f64 {
        self.vertices.iter().map(|v| v.uv.y).sum::<f64>() / self.vertices.len() as f64
    }

    fn shift(&mut self, by: DVec2) {
        self.vertices.iter_mut().for_each(|v| v.uv += by);
    }

    /// The vertices from `start` once round, the start repeated a period on.
    fn round_from(&self, start: usize, period: f64) -> Vec<TrimVertex> {
        let n = self.vertices.len();
        (0..=n)
            .map(|k| {
                let v = self.vertices[(start + k) % n];
                let turns = ((start + k) / n) as f64;
                TrimVertex { uv: v.uv + DVec2::new(turns * period, 0.0), ..v }
            })
            .collect()
    }
}

/// The piece between two loops that go round the surface, or between one and a pole.
fn band(
    plane: &Turned<'_>,
    around: Vec<UnrolledLoop>,
    flat: Vec<Vec<TrimVertex>>,
    domain: &mut TrimDomain,
) -> Result<(), TrimError> {
    let axis = if plane.axis == Direction::U { 0 } else { 1 };
    if around.iter().any(|l| l.winding[axis].abs() != 1) {
        return Err(TrimError::Winding("a loop goes round the surface more than once"));
    }
    let mut rings: Vec<(i32, Ring)> = around.into_iter().map(|l| ring(plane, l, axis)).collect();
    let holes: Vec<Vec<TrimVertex>> = flat.into_iter().map(|l| map(&l, |uv| plane.to_ab(uv))).collect();
    rings.sort_by(|x, y| x.1.mean_b().total_cmp(&y.1.mean_b()));
    let bounds = match rings.len() {
        1 => {
            let (winding, ring) = rings.remove(0);
            cap(plane, winding, ring, &holes, domain)?
        }
        2 => {
            let (second, first) = (rings.remove(1), rings.remove(0));
            between(plane, first, second, &holes, domain)
        }
        _ => return Err(TrimError::Winding("more than two loops go round the surface")),
    };
    let mut holes = holes;
    let periods = [Some(plane.period), plane.period_across];
    holes.iter_mut().for_each(|hole| move_inside(hole, &bounds, periods));
    for vertices in std::iter::once(bounds).chain(holes) {
        domain.loops.push(TrimLoop { vertices: map(&vertices, |ab| plane.to_uv(ab)), turned: false });
    }
    Ok(())
}

fn map(l: &[TrimVertex], f: impl Fn(DVec2) -> DVec2) -> Vec<TrimVertex> {
    l.iter().map(|v| TrimVertex { uv: f(v.uv), ..*v }).collect()
}

/// The loop turned to run towards higher `a`, with its winding as it was.
fn ring(plane: &Turned<'_>, l: UnrolledLoop, axis: usize) -> (i32, Ring) {
    let mut vertices = map(&l.vertices, |uv| plane.to_ab(uv));
    if l.winding[axis] < 0 {
        vertices.reverse();
    }
    (l.winding[axis], Ring { vertices })
}

/// The polygon between two rings.
fn between(
    plane: &Turned<'_>,
    first: (i32, Ring),
    second: (i32, Ring),
    holes: &[Vec<TrimVertex>],
    domain: &mut TrimDomain,
) -> Vec<TrimVertex> {
    // The inside lies left of a ring that runs forward: it is the lower one.
    let (mut lower, mut upper) = match (first.0 > 0, second.0 > 0, plane.period_across) {
        (false, true, Some(_)) => (second.1, first.1),
        (true, false, _) => (first.1, second.1),
        _ => {
            note_direction(domain);
            (first.1, second.1)
        }
    };
    if let Some(p) = plane.period_across {
        let ahead = (upper.mean_b() - lower.mean_b()).rem_euclid(p);
        let shift = lower.mean_b() + ahead - upper.mean_b();
        upper.shift(DVec2::new(0.0, shift));
    }
    let (i, j, shift) = choose_cut(plane, &lower, &upper, holes);
    upper.shift(DVec2::new(shift, 0.0));
    let lower_run = lower.round_from(i, plane.period);
    let mut upper_run = upper.round_from(j, plane.period);
    let (from, to) = (lower_run[0].uv, upper_run[0].uv);
    let cut = cut_points(plane, from, to, domain);
    upper_run.reverse();
    lower.vertices.clear();
    close_band(plane, lower_run, cut, upper_run)
}

fn note_direction(domain: &mut TrimDomain) {
    let message = "the two loops round the face run in the wrong directions; turned";
    domain.diagnostics.push(Diagnostic::new(Severity::Info, "loop-direction", EntityRef::None, message));
}

/// Lower run, cut upwards on its right, upper run back, cut downwards on its left.
fn close_band(
    plane: &Turned<'_>,
    lower: Vec<TrimVertex>,
    cut: Vec<TrimVertex>,
    upper: Vec<TrimVertex>,
) -> Vec<TrimVertex> {
    let right = DVec2::new(plane.period, 0.0);
    let mut out = lower;
    out.extend(cut.iter().map(|v| TrimVertex { uv: v.uv + right, ..*v }));
    out.extend(upper);
    out.extend(cut.iter().rev());
    out
}

fn cut_points(plane: &Turned<'_>, from: DVec2, to: DVec2, domain: &mut TrimDomain) -> Vec<TrimVertex> {
    let line = cut::line(plane.chart, plane.to_uv(from), plane.to_uv(to));
    line.into_iter().map(|(uv, p)| TrimVertex { uv: plane.to_ab(uv), point: domain.add_point(p) }).collect()
}

/// The polygon between a ring and a pole (or the surface's own end).
fn cap(
    plane: &Turned<'_>,
    winding: i32,
    ring: Ring,
    holes: &[Vec<TrimVertex>],
    domain: &mut TrimDomain,
) -> Result<Vec<TrimVertex>, TrimError> {
    let b = ring.mean_b();
    let wanted = plane.end_beyond(b, winding > 0).filter(|e| e.1);
    let (upper, (end, is_pole)) = match (wanted, plane.end_beyond(b, winding < 0)) {
        (Some(end), _) => (winding > 0, end),
        (None, Some(end)) if end.1 => {
            note_direction(domain);
            (winding < 0, end)
        }
        (None, _) => match plane.end_beyond(b, winding > 0) {
            Some(end) => (winding > 0, end),
            None => return Err(TrimError::Winding("a single loop goes round a surface that has no end")),
        },
    };
    let i = choose_cap_cut(plane, &ring, end, holes);
    let run = ring.round_from(i, plane.period);
    let from = run[0].uv;
    let foot = DVec2::new(from.x, end);
    let cut = cut_points(plane, from, foot, domain);
    let side = end_side(plane, foot, is_pole, domain);
    let right = DVec2::new(plane.period, 0.0);
    if upper {
        let mut side = side;
        side.reverse();
        return Ok(close_band(plane, run, cut, side));
    }
    // The pole's side below, cut upwards on the right, the ring back, cut downwards on the left.
    let mut out = side;
    out.extend(cut.iter().rev().map(|v| TrimVertex { uv: v.uv + right, ..*v }));
    out.extend(run.into_iter().rev());
    out.extend(cut);
    Ok(out)
}

/// The surface's end from `foot` a whole period on: one point for a pole, a closed line otherwise.
fn end_side(plane: &Turned<'_>, foot: DVec2, is_pole: bool, domain: &mut TrimDomain) -> Vec<TrimVertex> {
    let to = foot + DVec2::new(plane.period, 0.0);
    let point = plane.chart.surface.point(plane.to_uv(foot));
    let first = domain.add_point(point);
    if is_pole {
        let n = pole_pieces(1.0, plane.chart.tolerance.angular_rad);
        return (0..=n)
            .map(|k| TrimVertex { uv: foot.lerp(to, k as f64 / n as f64), point: first })
            .collect();
    }
    let mut out = vec![TrimVertex { uv: foot, point: first }];
    out.extend(cut_points(plane, foot, to, domain));
    out.push(TrimVertex { uv: to, point: first });
    out
}

/// Every segment of the rings and holes, as (a, b) pairs, for visibility tests.
struct Obstacles {
    segments: Vec<(DVec2, DVec2)>,
}

impl Obstacles {
    fn new(plane: &Turned<'_>, rings: &[&Ring], holes: &[Vec<TrimVertex>]) -> Self {
        let mut segments = Vec::new();
        for ring in rings {
            let run = ring.round_from(0, plane.period);
            segments.extend(run.windows(2).map(|w| (w[0].uv, w[1].uv)));
        }
        for hole in holes {
            let next = hole.iter().cycle().skip(1);
            segments.extend(hole.iter().zip(next).map(|(a, b)| (a.uv, b.uv)));
        }
        Self { segments }
    }

    /// Whether the segment from `p` to `q` crosses nothing, on any turn.
    fn clear(&self, plane: &Turned<'_>, p: DVec2, q: DVec2) -> bool {
        let (low, high) = (p.x.min(q.x), p.x.max(q.x));
        self.segments.iter().all(|&(a, b)| {
            let first = ((low - a.x.max(b.x)) / plane.period).ceil() as i64;
            let last = ((high - a.x.min(b.x)) / plane.period).floor() as i64;
            (first..=last.min(first.saturating_add(4))).all(|k| {
                let shift = DVec2::new(k as f64 * plane.period, 0.0);
                !segments_cross(p, q, a + shift, b + shift)
            })
        })
    }
}

/// The steepest clear line from a vertex of `lower` to one of `upper`: (index, index, shift of `upper` along a).
fn choose_cut(
    plane: &Turned<'_>,
    lower: &Ring,
    upper: &Ring,
    holes: &[Vec<TrimVertex>],
) -> (usize, usize, f64) {
    let obstacles = Obstacles::new(plane, &[lower, upper], holes);
    let stride = lower.vertices.len().div_ceil(128);
    let mut candidates: Vec<(f64, usize, usize, f64)> = Vec::new();
    for (i, l) in lower.vertices.iter().enumerate().step_by(stride) {
        for (j, u) in upper.vertices.iter().enumerate() {
            let shift = ((l.uv.x - u.uv.x) / plane.period).round() * plane.period;
            candidates.push(((u.uv.x + shift - l.uv.x).abs(), i, j, shift));
        }
    }
    candidates.sort_by(|x, y| x.0.total_cmp(&y.0));
    let clear = candidates.iter().take(2000).find(|&&(_, i, j, shift)| {
        let target = upper.vertices[j].uv + DVec2::new(shift, 0.0);
        obstacles.clear(plane, lower.vertices[i].uv, target)
    });
    clear.or(candidates.first()).map_or((0, 0, 0.0), |&(_, i, j, shift)| (i, j, shift))
}

fn choose_cap_cut(plane: &Turned<'_>, ring: &Ring, end: f64, holes: &[Vec<TrimVertex>]) -> usize {
    let obstacles = Obstacles::new(plane, &[ring], holes);
    let clear = |v: &TrimVertex| obstacles.clear(plane, v.uv, DVec2::new(v.uv.x, end));
    ring.vertices.iter().position(clear).unwrap_or(0)
}

/// The whole surface, less `holes`.
fn whole(chart: &Chart<'_>, holes: Vec<Vec<TrimVertex>>, domain: &mut TrimDomain) -> Result<(), TrimError> {
    let periods = chart.surface.periods();
    let [u, v] = chart.surface.domain();
    let range = |d: Interval, period: Option<f64>, coordinate: fn(DVec2) -> f64| match period {
        Some(p) => {
            let start = free_start(&holes, d.start, p, coordinate);
            Some(Interval::new(start, start + p))
        }
        None => d.is_finite().then_some(d),
    };
    let (Some(u), Some(v)) = (range(u, periods[0], |uv| uv.x), range(v, periods[1], |uv| uv.y)) else {
        return Err(TrimError::Winding("the face has no boundary and its surface has no end"));
    };
    let boundary = rectangle(chart, u, v, domain);
    let mut holes = holes;
    holes.iter_mut().for_each(|hole| move_inside(hole, &boundary, periods));
    domain.loops.push(TrimLoop { vertices: boundary, turned: false });
    domain.loops.extend(holes.into_iter().map(|vertices| TrimLoop { vertices, turned: false }));
    Ok(())
}

/// A parameter on a closed direction that no hole covers (the middle of the largest gap), else `start`.
fn free_start(holes: &[Vec<TrimVertex>], start: f64, period: f64, coordinate: fn(DVec2) -> f64) -> f64 {
    let mut spans: Vec<(f64, f64)> = holes
        .iter()
        .map(|hole| {
            let low = hole.iter().map(|v| coordinate(v.uv)).fold(f64::INFINITY, f64::min);
            let high = hole.iter().map(|v| coordinate(v.uv)).fold(f64::NEG_INFINITY, f64::max);
            let base = start + (low - start).rem_euclid(period);
            (base, base + (high - low))
        })
        .collect();
    spans.sort_by(|x, y| x.0.total_cmp(&y.0));
    let Some(&(first, _)) = spans.first() else { return start };
    let mut best = (0.0, start);
    let mut reach = f64::NEG_INFINITY;
    for (k, &(_, high)) in spans.iter().enumerate() {
        reach = reach.max(high);
        let next = spans.get(k + 1).map_or(first + period, |s| s.0);
        if next - reach > best.0 {
            best = (next - reach, reach + (next - reach) * 0.5);
        }
    }
    best.1
}

/// The border of `u` x `v`, counter-clockwise; sides that are one line or one point in space share their points.
fn rectangle(chart: &Chart<'_>, u: Interval, v: Interval, domain: &mut TrimDomain) -> Vec<TrimVertex> {
    let periods = chart.surface.periods();
    let corners = [(u.start, v.start), (u.end, v.start), (u.end, v.end), (u.start, v.end)]
        .map(|(a, b)| DVec2::new(a, b));
    let ids = corner_points(chart, corners, domain);
    let mut bottom = side(chart, corners[0], corners[1], ids[0], domain);
    let top = if periods[1].is_some() {
        moved(&bottom, DVec2::new(0.0, v.length()))
    } else {
        side(chart, corners[3], corners[2], ids[3], domain)
    };
    let left = side(chart, corners[0], corners[3], ids[0], domain);
    let right = if periods[0].is_some() {
        moved(&left, DVec2::new(u.length(), 0.0))
    } else {
        side(chart, corners[1], corners[2], ids[1], domain)
    };
    let corner = |k: usize| TrimVertex { uv: corners[k], point: ids[k] };
    let mut out = vec![corner(0)];
    out.append(&mut bottom);
    out.push(corner(1));
    out.extend(right);
    out.push(corner(2));
    out.extend(top.into_iter().rev());
    out.push(corner(3));
    out.extend(left.into_iter().rev());
    out
}

fn moved(side: &[TrimVertex], by: DVec2) -> Vec<TrimVertex> {
    side.iter().map(|v| TrimVertex { uv: v.uv + by, ..*v }).collect()
}

/// Numbers for the four corners; corners at the same place share theirs.
fn corner_points(chart: &Chart<'_>, corners: [DVec2; 4], domain: &mut TrimDomain) -> [u32; 4] {
    let points = corners.map(|c| chart.surface.point(c));
    let middle = chart.surface.point((corners[0] + corners[2]) * 0.5);
    let size = points.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
    let mut ids = [u32::MAX; 4];
    for k in 0..4 {
        let same = (0..k).find(|&m| points[m].distance(points[k]) <= 1e-9 * size);
        ids[k] = same.map_or_else(|| domain.add_point(points[k]), |m| ids[m]);
    }
    ids
}

/// The inner points of one side: a line, or the single point `at_pole` where the side is singular.
fn side(chart: &Chart<'_>, from: DVec2, to: DVec2, at_pole: u32, domain: &mut TrimDomain) -> Vec<TrimVertex> {
    let (constant, at) = if from.y == to.y { (Direction::V, from.y) } else { (Direction::U, from.x) };
    let is_pole = chart.surface.singularities().iter().any(|s| {
        let reach = (from - to).length().max(1e-9);
        s.constant == constant && (s.at - at).abs() <= 1e-9 * reach
    });
    if is_pole {
        let n = pole_pieces(1.0, chart.tolerance.angular_rad);
        return (1..n)
            .map(|k| TrimVertex { uv: from.lerp(to, k as f64 / n as f64), point: at_pole })
            .collect();
    }
    let line: Vec<(DVec2, DVec3)> = cut::line(chart, from, to);
    line.into_iter().map(|(uv, p)| TrimVertex { uv, point: domain.add_point(p) }).collect()
}
