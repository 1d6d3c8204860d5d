//! The metric of the parameter plane: lengths in it count tolerance steps.

use glam::DVec2;
use trimloop_geom::{Derivatives, Direction, Interval, Surface};
use trimloop_trim::Tolerance;

/// A monotone map of one parameter, linear between stations.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    parameters: Vec<f64>,
    values: Vec<f64>,
}

impl Axis {
    /// The map whose slope in cell k (between `parameters[k]` and `[k + 1]`) is `1 / steps[k]`.
    fn new(parameters: Vec<f64>, steps: &[f64]) -> Self {
        let mut values = vec![0.0];
        let mut sum = 0.0;
        for (pair, step) in parameters.windows(2).zip(steps) {
            sum += (pair[1] - pair[0]) / step;
            values.push(sum);
        }
        Self { parameters, values }
    }

    /// The warped value of parameter `t`; extends linearly beyond the ends.
    pub fn value(&self, t: f64) -> f64 {
        interpolate(&self.parameters, &self.values, t)
    }

    /// The parameter of warped value `x`.
    pub fn parameter(&self, x: f64) -> f64 {
        interpolate(&self.values, &self.parameters, x)
    }

    /// The warped length of the whole range.
    pub fn length(&self) -> f64 {
        self.values.last().copied().unwrap_or(0.0)
    }
}

fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let cell = xs.partition_point(|&k| k <= x).clamp(1, xs.len() - 1);
    let (x0, x1, y0, y1) = (xs[cell - 1], xs[cell], ys[cell - 1], ys[cell]);
    y0 + (x - x0) * ((y1 - y0) / (x1 - x0))
}

/// The parameter plane warped so that one unit in either direction is one tolerance step, and the parameters at which
/// whole steps lie.
#[derive(Clone, Debug)]
pub(crate) struct Warp {
    axes: [Axis; 2],
    /// Parameters in u of the lines between steps, the range's ends left out; likewise in v.
    pub lines: [Vec<f64>; 2],
}

/// Steps in one cell of a direction: the parameter length of a tolerance step and that of a millimetre.
#[derive(Clone, Copy)]
struct Cell {
    step: f64,
    per_mm: f64,
}

/// A step in a direction without curvature is at most this many times as long as one across it.
const MAX_ASPECT: f64 = 64.0;

/// The same on a face with a pole: there, long triangles would fold over one another.
const MAX_ASPECT_AT_POLES: f64 = 8.0;

/// The same on free-form surfaces, where it also sets how far apart points lie.
const FREE_FORM_ASPECT: f64 = 4.0;

/// Parts of a range that are shorter than this part of it say nothing of the steps.
const LEAST_CELL: f64 = 1e-8;

impl Warp {
    /// The warp for `surface` over `low`..`high`; at most `max_points` line crossings.
    pub fn new(
        surface: &Surface,
        low: DVec2,
        high: DVec2,
        tolerance: Tolerance,
        max_points: usize,
        has_pole: bool,
    ) -> Self {
        let ranges = [widened(low.x, high.x), widened(low.y, high.y)];
        if let Surface::Plane { .. } = surface {
            let flat = |r: Interval| Axis::new(vec![r.start, r.end], &[1.0]);
            return Self { axes: ranges.map(flat), lines: [Vec::new(), Vec::new()] };
        }
        let stations =
            [stations(surface, Direction::U, ranges[0]), stations(surface, Direction::V, ranges[1])];
        let (u_cells, v_cells) = measure(surface, &stations, tolerance);
        let cells = [u_cells, v_cells];
        let cells = limit_lengths(surface, &stations, cells, tolerance);
        let wanted = [wanted_lines(&stations[0], &cells[0]), wanted_lines(&stations[1], &cells[1])];
        let thin = (wanted[0] * wanted[1] / max_points.max(1) as f64).sqrt().max(1.0);
        let lines = [0, 1].map(|k| {
            let steps: Vec<f64> = cells[k].iter().map(|c| c.step).collect();
            even_lines(&Axis::new(stations[k].clone(), &steps), wanted[k] / thin)
        });
        let shortest = |cells: &[Cell]| cells.iter().map(|c| c.step / c.per_mm).fold(f64::INFINITY, f64::min);
        let short_mm = [shortest(&cells[0]), shortest(&cells[1])];
        let axes = [0, 1].map(|k| {
            let across = short_mm[1 - k];
            let steps: Vec<f64> = cells[k]
                .iter()
                .map(|c| c.metric_step(across, if has_pole { MAX_ASPECT_AT_POLES } else { MAX_ASPECT }))
                .collect();
            Axis::new(stations[k].clone(), &steps)
        });
        Self { axes, lines }
    }

    /// The warped image of (u, v).
    pub fn map(&self, uv: DVec2) -> DVec2 {
        DVec2::new(self.axes[0].value(uv.x), self.axes[1].value(uv.y))
    }

    /// The (u, v) of a warped point.
    pub fn unmap(&self, p: DVec2) -> DVec2 {
        DVec2::new(self.axes[0].parameter(p.x), self.axes[1].parameter(p.y))
    }
}

impl Cell {
    /// Takes the smaller step of both.
    fn tighten(&mut self, other: Self) {
        self.step = self.step.min(other.step);
        self.per_mm = if self.per_mm == 0.0 { other.per_mm } else { self.per_mm.min(other.per_mm) };
    }

    /// The step to measure by, when the shortest step across is `across_mm` long.
    fn metric_step(&self, across_mm: f64, max_aspect: f64) -> f64 {
        let limit = if across_mm.is_finite() { across_mm * max_aspect * self.per_mm } else { self.per_mm };
        self.step.min(limit).max(f64::MIN_POSITIVE)
    }
}

fn widened(start: f64, end: f64) -> Interval {
    let least = 1e-9 * start.abs().max(end.abs()).max(1e-9);
    if end - start > least { Interval::new(start, end) } else { Interval::new(start - least, end + least) }
}

/// Where the steps of one direction are measured: between knots, and a few times in between.
fn stations(surface: &Surface, direction: Direction, range: Interval) -> Vec<f64> {
    let breaks = surface.breakpoints(direction, range);
    let pieces = match (surface, direction) {
        (Surface::Cylinder { .. } | Surface::Cone { .. } | Surface::Sphere { .. }, _) => 1,
        (Surface::Torus { .. }, Direction::U) => 1,
        (Surface::Extrusion { .. }, Direction::V) | (Surface::Revolution { .. }, Direction::U) => 1,
        _ => (16 / breaks.len().max(1)).clamp(1, 8),
    };
    let mut out = Vec::new();
    let stride = (breaks.len() / 256).max(1);
    let mut kept: Vec<f64> = breaks.iter().copied().step_by(stride).collect();
    if let (Some(&last), Some(end)) = (breaks.last(), kept.last_mut())
        && *end != last
    {
        kept.push(last);
    }
    for pair in kept.windows(2) {
        let piece = Interval::new(pair[0], pair[1]);
        out.extend((0..pieces).map(|i| piece.at(i as f64 / pieces as f64)));
    }
    out.push(range.end);
    // Between knots that are the same but for their last digits, derivatives are noise.
    out.dedup_by(|next, before| *next - *before <= LEAST_CELL * range.length());
    if out.len() < 2 {
        return vec![range.start, range.end];
    }
    out.pop();
    out.push(range.end);
    out
}

/// The steps of every cell in both directions: the least over the other direction.
fn measure(surface: &Surface, stations: &[Vec<f64>; 2], tolerance: Tolerance) -> (Vec<Cell>, Vec<Cell>) {
    let none = Cell { step: f64::INFINITY, per_mm: 0.0 };
    let mut cells = [vec![none; stations[0].len() - 1], vec![none; stations[1].len() - 1]];
    let middles = |s: &[f64]| s.windows(2).map(|w| (w[0] + w[1]) * 0.5).collect::<Vec<f64>>();
    let us = middles(&stations[0]);
    let mut vs = middles(&stations[1]);
    // Elementary surfaces have a single cell; its ends may be the extreme.
    if stations[1].len() == 2 {
        vs.extend(&stations[1]);
    }
    let last = cells[1].len() - 1;
    for (k, at) in surface.derivatives_grid(&us, &vs).iter().enumerate() {
        let [su, sv] = steps_at(at, tolerance);
        cells[0][k / vs.len()].tighten(su);
        cells[1][(k % vs.len()).min(last)].tighten(sv);
    }
    let [mut u, mut v] = cells;
    for c in u.iter_mut().chain(&mut v) {
        c.per_mm = if c.per_mm > 0.0 && c.per_mm.is_finite() { c.per_mm } else { 1.0 };
    }
    (u, v)
}

/// The steps in u and v at one point that keep both bounds.
fn steps_at(d: &Derivatives, tolerance: Tolerance) -> [Cell; 2] {
    let cross = d.du.cross(d.dv);
    let area = cross.length();
    let none = |t: glam::DVec3| Cell { step: f64::INFINITY, per_mm: 1.0 / t.length() };
    if !(area > 1e-12 * d.du.length() * d.dv.length()) || !area.is_finite() {
        return [none(d.du), none(d.dv)];
    }
    let normal = cross / area;
    let turn = |duu: glam::DVec3, duv: glam::DVec3, first: bool| {
        let change =
            if first { duu.cross(d.dv) + d.du.cross(duv) } else { duv.cross(d.dv) + d.du.cross(duu) };
        (change - normal * normal.dot(change)).length() / area
    };
    let bend = [d.duu.dot(normal).abs(), d.dvv.dot(normal).abs()];
    let turns = [turn(d.duu, d.duv, true), turn(d.dvv, d.duv, false)];
    let curved = turns.map(|t| t > 1e-9 / tolerance.linear_mm.max(1e-9) * 1e-6);
    // Where both directions bend, the diagonals add up.
    let share = if curved[0] && curved[1] { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 };
    [0, 1].map(|k| {
        let tangent = if k == 0 { d.du } else { d.dv };
        let per_mm = 1.0 / tangent.length();
        let by_angle = tolerance.angular_rad / turns[k];
        let by_distance = (8.0 * tolerance.linear_mm / bend[k]).sqrt();
        let floor = tolerance.shortest_chord_mm() * per_mm;
        Cell { step: (by_angle.min(by_distance) * share).max(floor), per_mm }
    })
}

/// How many steps a face has at least in direction `k`: as many as the surface's degree, up to three.
fn pieces_at_least(surface: &Surface, k: usize) -> f64 {
    match surface {
        Surface::Nurbs(nurbs) => nurbs.degrees()[k].min(3) as f64,
        Surface::Extrusion { .. } if k == 1 => 1.0,
        Surface::Revolution { .. } if k == 0 => 1.0,
        Surface::Offset { basis, .. } => pieces_at_least(basis, k),
        _ => 3.0,
    }
}

/// Steps on free-form surfaces are limited where curvature does not: to a share of the face and of the step across, so that no triangle spans a large face from side to side. Lengths near the tolerance are left alone.
fn limit_lengths(
    surface: &Surface,
    stations: &[Vec<f64>; 2],
    mut cells: [Vec<Cell>; 2],
    tolerance: Tolerance,
) -> [Vec<Cell>; 2] {
    if !matches!(surface.kind(), "nurbs" | "extrusion" | "revolution" | "offset") {
        return cells;
    }
    let least_mm = tolerance.linear_mm * 25.0;
    let shortest = |cells: &[Cell]| cells.iter().map(|c| c.step / c.per_mm).fold(f64::INFINITY, f64::min);
    let across_mm = [shortest(&cells[1]), shortest(&cells[0])];
    for k in 0..2 {
        if is_conic_spline(surface) && is_ruling(&cells[k]) {
            continue;
        }
        let ends = [stations[k].first(), stations[k].last()].map(|e| e.copied().unwrap_or(0.0));
        let piece = (ends[1] - ends[0]) / pieces_at_least(surface, k);
        for cell in &mut cells[k] {
            let limit = piece.min(across_mm[k] * FREE_FORM_ASPECT * cell.per_mm);
            cell.step = cell.step.min(limit.max(least_mm * cell.per_mm));
        }
    }
    cells
}

/// Whether a surface is a cylinder or a cone written as a rational spline, as many exporters do: it is to be meshed as
/// those are, whose rulings have no limit.
fn is_conic_spline(surface: &Surface) -> bool {
    matches!(surface, Surface::Nurbs(nurbs) if !nurbs.weights().is_empty() && nurbs.degrees().contains(&1))
}

/// Whether nothing bends or turns along a direction.
fn is_ruling(cells: &[Cell]) -> bool {
    cells.iter().all(|cell| cell.step.is_infinite())
}

fn wanted_lines(stations: &[f64], cells: &[Cell]) -> f64 {
    let total: f64 = stations.windows(2).zip(cells).map(|(w, c)| (w[1] - w[0]) / c.step).sum();
    (total - 1e-6).ceil().max(1.0)
}

/// The parameters that cut the axis into `count` even parts, the ends left out.
fn even_lines(axis: &Axis, count: f64) -> Vec<f64> {
    let count = count.ceil().max(1.0) as usize;
    let length = axis.length();
    if !(length > 0.0) {
        return Vec::new();
    }
    (1..count).map(|k| axis.parameter(length * k as f64 / count as f64)).collect()
}
