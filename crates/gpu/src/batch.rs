//! Requests as tables for the device.

use std::ops::Range;

use glam::{DVec2, Vec3, Vec4};
use trimloop_geom::Interval;
use trimloop_geom::nurbs::find_span;

use crate::shape::{Bezier, Facet, Net};
use crate::{Backend, Places, Quantities, Request, Shape};

/// As in `shaders/shared/line.wgsl`.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Line {
    pub first: u32,
    pub span: u32,
    pub degree: u32,
    pub knots: u32,
    pub t: f32,
    pub top: f32,
    pub power: f32,
    pub inward: f32,
    pub slope: f32,
    pub bend: f32,
    pub share: f32,
    pub unused: u32,
}

/// As in `shaders/shared/job.wgsl`.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Job {
    pub first_point: u32,
    pub rows: u32,
    pub columns: u32,
    pub first_row: u32,
    pub first_column: u32,
    pub is_list: u32,
    pub control: u32,
    pub control_columns: u32,
    pub facet: u32,
    pub facet_columns: u32,
    pub scratch: u32,
    pub scratch_columns: u32,
}

/// As in `shaders/shared/job.wgsl`.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Tile {
    pub job: u32,
    pub start: u32,
    pub end: u32,
    pub unused: u32,
    pub first_line: u32,
    pub lines: u32,
    pub first_control: u32,
    pub controls: u32,
}

/// Part of a request: some rows of its grid, or some points of its list.
#[derive(Clone, Debug)]
pub(crate) struct Piece<'a> {
    pub request: usize,
    pub shape: &'a Shape,
    pub net: &'a Net,
    pub places: &'a Places,
    pub range: Range<usize>,
}

impl Piece<'_> {
    pub fn points(&self) -> usize {
        match self.places {
            Places::Grid { vs, .. } => self.range.len() * vs.len(),
            Places::List(_) => self.range.len(),
        }
    }

    /// Lines along u, along v.
    fn lines(&self) -> [usize; 2] {
        match self.places {
            Places::Grid { vs, .. } => [self.range.len(), vs.len()],
            Places::List(_) => [self.range.len(); 2],
        }
    }
}

/// A batch that fits the device's limits.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    pub jobs: Vec<Job>,
    pub lines: Vec<Line>,
    pub control: Vec<Vec4>,
    pub facets: Vec<Facet>,
    /// Normalized knots, behind each other (not for Bézier).
    pub knots: Vec<f32>,
    pub points: usize,
    /// Room for the largest order (degree + 1): a power of two.
    pub width: usize,
    /// Vectors that a first pass leaves for a second one, times the kinds of derivatives.
    pub scratch: usize,
}

/// Cuts requests into batches of pieces, none beyond `limit` bytes in any table.
pub(crate) fn batches<'a>(
    requests: &'a [Request<'a>],
    backend: Backend,
    quantities: Quantities,
    limit: u64,
) -> Vec<Vec<Piece<'a>>> {
    let mut out = Vec::new();
    let mut open: Vec<Piece<'a>> = Vec::new();
    let mut sums = Sums::default();
    for (index, request) in requests.iter().enumerate() {
        let Some(net) = &request.shape.net else { continue };
        if request.places.is_empty() {
            continue;
        }
        let fixed = fixed_bytes(request.shape, net, backend);
        let count = match &request.places {
            Places::Grid { us, .. } => us.len(),
            Places::List(list) => list.len(),
        };
        let own = per_row_bytes(net, &request.places, backend, quantities);
        // Half the limit each, so that a shape and its results go together.
        let rows = ((limit / 2) / own.max(1)).clamp(1, count as u64) as usize;
        let mut start = 0;
        while start < count {
            let end = (start + rows).min(count);
            let piece = Piece {
                request: index,
                shape: request.shape,
                net,
                places: &request.places,
                range: start..end,
            };
            let width = (net.degrees[0].max(net.degrees[1]) as u64 + 1).next_power_of_two();
            let grown = sums.with(&piece, own, fixed, width);
            if !open.is_empty() && grown.exceeds(limit) {
                out.push(std::mem::take(&mut open));
                sums = Sums::default().with(&piece, own, fixed, width);
            } else {
                sums = grown;
            }
            open.push(piece);
            start = end;
        }
    }
    if !open.is_empty() {
        out.push(open);
    }
    out
}

/// Bytes of a batch's tables while it grows.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    output: u64,
    control: u64,
    lines: u64,
    width: u64,
}

impl Sums {
    fn with(self, piece: &Piece<'_>, per_row: u64, fixed: u64, width: u64) -> Self {
        let [rows, columns] = piece.lines();
        Self {
            output: self.output + per_row * piece.range.len() as u64,
            control: self.control + fixed,
            lines: self.lines + (rows + columns) as u64,
            width: self.width.max(width),
        }
    }

    fn exceeds(self, limit: u64) -> bool {
        self.output > limit || self.control > limit || self.lines * bytes_per_line(self.width) > limit
    }
}

/// Bytes that a line takes in the largest table that grows with lines: lines, rows of knots, basis functions.
fn bytes_per_line(width: u64) -> u64 {
    (size_of::<Line>() as u64).max(4 * (2 * width + 3)).max(12 * width)
}

fn fixed_bytes(shape: &Shape, net: &Net, backend: Backend) -> u64 {
    let points = match backend {
        Backend::Bezier => shape.bezier(net).control.len(),
        _ => net.points.len(),
    };
    16 * points as u64
}

/// Bytes that a row of a grid (or a point of a list) takes in the largest table that grows with rows.
fn per_row_bytes(net: &Net, places: &Places, backend: Backend, quantities: Quantities) -> u64 {
    let columns = match places {
        Places::Grid { vs, .. } => vs.len(),
        Places::List(_) => 1,
    };
    let output = columns * quantities.stride();
    let scratch = match (backend, places) {
        (Backend::Tan, Places::Grid { .. }) => net.shape[1] * quantities.kinds(),
        (Backend::Tan, Places::List(_)) => (net.degrees[1] + 1) * quantities.kinds(),
        _ => 0,
    };
    // A list's points bring two lines each; those of a grid are shared.
    let lines = if matches!(places, Places::List(_)) { 2 } else { 1 };
    let width = (net.degrees[0].max(net.degrees[1]) as u64 + 1).next_power_of_two().max(4);
    (16 * output.max(scratch) as u64).max(lines * bytes_per_line(width))
}

impl Batch {
    /// The tables of `pieces`.
    pub fn new(pieces: &[Piece<'_>], backend: Backend) -> Self {
        let mut batch = Self { width: 1, ..Self::default() };
        let mut last: Option<(*const Shape, Placed)> = None;
        for piece in pieces {
            // A shape's pieces follow each other.
            let placed = match last {
                Some((shape, placed)) if std::ptr::eq(shape, piece.shape) => placed,
                _ => batch.place(piece, backend),
            };
            last = Some((std::ptr::from_ref(piece.shape), placed));
            batch.add(piece, placed, backend);
        }
        // Each width is a pipeline of its own: few of them do.
        batch.width = batch.width.next_power_of_two().max(4);
        batch
    }

    fn place(&mut self, piece: &Piece<'_>, backend: Backend) -> Placed {
        let (control, facet) = (self.control.len() as u32, self.facets.len() as u32);
        let net = piece.net;
        self.width = self.width.max(net.degrees[0].max(net.degrees[1]) + 1);
        if backend == Backend::Bezier {
            let bezier = piece.shape.bezier(net);
            self.control.extend(&bezier.control);
            self.facets.extend(&bezier.facets);
            let facet_columns = bezier.breaks[1].len() as u32 - 1;
            return Placed {
                control,
                control_columns: bezier.columns as u32,
                facet,
                facet_columns,
                knots: [0; 2],
            };
        }
        self.control.extend(net.points.iter().map(|p| p.as_vec4()));
        let middle = DVec2::from(piece.shape.domain().map(|d| d.at(0.5)));
        let normal = piece.shape.normal(middle).as_vec3();
        let size = piece.shape.size() as f32;
        self.facets.push(Facet { origin: Vec3::ZERO, size, normal, unused: 0.0 });
        let knots = [0, 1].map(|d| {
            let domain = net.domain(d);
            let first = self.knots.len() as u32;
            self.knots.extend(net.knots[d].iter().map(|k| ((k - domain.start) / domain.length()) as f32));
            first
        });
        Placed { control, control_columns: net.shape[1] as u32, facet, facet_columns: 0, knots }
    }

    fn add(&mut self, piece: &Piece<'_>, placed: Placed, backend: Backend) {
        let first = self.lines.len() as u32;
        let domain = piece.shape.domain();
        let line = |d: usize, t: f64| {
            let share = ((t - domain[d].start) / domain[d].length()).clamp(0.0, 1.0);
            match backend {
                Backend::Bezier => bezier_line(piece.net, piece.shape.bezier(piece.net), d, t, share),
                _ => knot_line(piece.net, d, t, share, placed.knots[d]),
            }
        };
        match piece.places {
            Places::Grid { us, vs } => {
                self.lines.extend(us[piece.range.clone()].iter().map(|&u| line(0, u)));
                self.lines.extend(vs.iter().map(|&v| line(1, v)));
            }
            Places::List(list) => {
                self.lines.extend(list[piece.range.clone()].iter().map(|uv| line(0, uv.x)));
                self.lines.extend(list[piece.range.clone()].iter().map(|uv| line(1, uv.y)));
            }
        }
        let [rows, columns] = piece.lines();
        let is_list = matches!(piece.places, Places::List(_));
        let scratch_columns = if is_list { piece.net.degrees[1] + 1 } else { piece.net.shape[1] };
        self.jobs.push(Job {
            first_point: self.points as u32,
            rows: rows as u32,
            columns: if is_list { 1 } else { columns as u32 },
            first_row: first,
            first_column: first + rows as u32,
            is_list: u32::from(is_list),
            control: placed.control,
            control_columns: placed.control_columns,
            facet: placed.facet,
            facet_columns: placed.facet_columns,
            scratch: self.scratch as u32,
            scratch_columns: scratch_columns as u32,
        });
        self.points += piece.points();
        self.scratch += rows * scratch_columns;
    }

    /// Tiles of `size` points each for passes that go point by point.
    pub fn point_tiles(&self, size: usize) -> Vec<Tile> {
        let mut tiles = Vec::new();
        for (job, j) in self.jobs.iter().enumerate() {
            let points = (j.rows * j.columns) as usize;
            tiles.extend((0..points).step_by(size).map(|start| Tile {
                job: job as u32,
                start: start as u32,
                end: (start + size).min(points) as u32,
                ..Tile::default()
            }));
        }
        tiles
    }

    /// Runs of `count` lines from `first` on that lie in the same span.
    pub fn runs(&self, first: u32, count: u32) -> Vec<Range<u32>> {
        let lines = &self.lines[first as usize..(first + count) as usize];
        let mut runs = Vec::new();
        let mut start = 0;
        for run in lines.chunk_by(|a, b| a.first == b.first) {
            runs.push(start..start + run.len() as u32);
            start += run.len() as u32;
        }
        runs
    }
}

/// Where a shape's tables begin.
#[derive(Clone, Copy, Debug)]
struct Placed {
    control: u32,
    control_columns: u32,
    facet: u32,
    facet_columns: u32,
    knots: [u32; 2],
}

/// +1 before the middle of the domain, -1 behind it.
fn inward(net: &Net, d: usize, t: f64) -> f32 {
    if t <= net.domain(d).at(0.5) { 1.0 } else { -1.0 }
}

/// Spans shorter than this share of the domain are passed over for a neighbour: single precision shows nothing in them.
const SHORTEST: f64 = 1e-7;

/// The nearest span from `span` on that is long enough.
fn usable_span(ends: &[f64], span: usize, domain: f64) -> usize {
    let is_usable = |k: &usize| ends[k + 1] - ends[*k] > SHORTEST * domain;
    let ahead = (span..ends.len() - 1).find(is_usable);
    ahead.or_else(|| (0..span).rev().find(is_usable)).unwrap_or(span)
}

fn bezier_line(net: &Net, bezier: &Bezier, d: usize, u: f64, share: f64) -> Line {
    let degree = net.degrees[d];
    let [t, slope, bend] = net.maps[d].at(u);
    let breaks = &bezier.breaks[d];
    let span = breaks[1..breaks.len() - 1].partition_point(|&end| end <= t);
    let span = usable_span(breaks, span, net.domain(d).length());
    let t = Interval::new(breaks[span], breaks[span + 1]).clamp(t);
    let length = breaks[span + 1] - breaks[span];
    let shares = [(t - breaks[span]) / length, (breaks[span + 1] - t) / length];
    let is_backward = shares[0] > shares[1];
    let (small, top) = if is_backward { (shares[1], shares[0]) } else { (shares[0], shares[1]) };
    Line {
        first: (span * (degree + 1)) as u32,
        span: span as u32,
        degree: degree as u32,
        knots: u32::from(is_backward),
        t: (small / top) as f32,
        top: top as f32,
        power: top.powi(degree.saturating_sub(2) as i32) as f32,
        inward: inward(net, d, t),
        slope: (slope / length) as f32,
        bend: (bend / length) as f32,
        share: share as f32,
        unused: 0,
    }
}

fn knot_line(net: &Net, d: usize, u: f64, share: f64, first_knot: u32) -> Line {
    let degree = net.degrees[d];
    let [t, slope, bend] = net.maps[d].at(u);
    let domain = net.domain(d);
    let inner = &net.knots[d][degree..=net.shape[d]];
    let span = usable_span(
        inner,
        find_span(&net.knots[d], degree, net.shape[d], domain.clamp(t)) - degree,
        domain.length(),
    );
    let t = Interval::new(inner[span], inner[span + 1]).clamp(t);
    let first = span as u32;
    let length = domain.length();
    Line {
        first,
        span: 0,
        degree: degree as u32,
        knots: first_knot + first,
        t: ((t - domain.start) / length) as f32,
        top: 0.0,
        power: 0.0,
        inward: inward(net, d, t),
        slope: (slope / length) as f32,
        bend: (bend / length) as f32,
        share: share as f32,
        unused: 0,
    }
}
