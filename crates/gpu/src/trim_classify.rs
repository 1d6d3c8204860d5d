//! Exact trimming: monotone curves in bands of v behind a grid of cells that are inside, outside or mixed.

use glam::{DVec2, Vec2, Vec4};
use trimloop_trim::curves::{Cubic, monotone, point};

use crate::device::Key;
use crate::{Gpu, GpuError};

/// A face's boundary, ready for `shaders/trim_classify.wgsl`: normalized to the unit square.
#[derive(Clone, Debug)]
pub struct TrimTable {
    low: DVec2,
    extent: DVec2,
    header: TrimHeader,
    cells: Vec<u32>,
    bands: Vec<u32>,
    entries: Vec<u32>,
    curves: Vec<Vec4>,
}

/// Sizes of a table, and where it lies among others; as in `shaders/shared/trim.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct TrimHeader {
    /// Cells along u.
    pub columns: u32,
    /// Cells along v.
    pub rows: u32,
    /// Bands of v.
    pub bands: u32,
    /// First word of its cells.
    pub first_word: u32,
    /// First of its bands.
    pub first_band: u32,
    /// First of its entries.
    pub first_entry: u32,
    /// First of its curves.
    pub first_curve: u32,
    /// Nothing.
    pub unused: u32,
}

/// What a rectangle of the parameter plane holds of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cover {
    /// Nothing.
    None,
    /// All of it is inside.
    Whole,
    /// A trim curve may pass through.
    Part,
}

const OUTSIDE: u32 = 0;
const INSIDE: u32 = 1;
const MIXED: u32 = 2;
/// Cells are widened by this share of the domain when it is asked which curves meet them.
const SLACK: f64 = 1e-6;

impl TrimTable {
    /// The table of closed chains of cubics (see [`trimloop_trim::curves::trim_curves`]), with at most `cells` cells
    /// along each direction.
    ///
    /// # Errors
    /// Where the curves span nothing, or their numbers make no sense.
    pub fn new(chains: &[Vec<Cubic>], cells: u32) -> Result<Self, GpuError> {
        let points = || chains.iter().flatten().flatten().copied();
        let (low, high) =
            points().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        Self::within(chains, cells, low, high)
    }

    /// The same with the rectangle from `low` to `high` as the unit square.
    ///
    /// # Errors
    /// Where the rectangle is empty, or numbers make no sense.
    pub fn within(chains: &[Vec<Cubic>], cells: u32, low: DVec2, high: DVec2) -> Result<Self, GpuError> {
        let points = || chains.iter().flatten().flatten().copied();
        let extent = high - low;
        let is_finite = extent.is_finite() && points().all(DVec2::is_finite);
        if !(is_finite && extent.cmpgt(DVec2::ZERO).all()) {
            return Err(GpuError::Request("the trim curves enclose nothing".to_owned()));
        }
        let unit = |p: DVec2| ((p - low) / extent).as_vec2().as_dvec2();
        let pieces: Vec<Cubic> = chains
            .iter()
            .flatten()
            .flat_map(|cubic| monotone(&cubic.map(unit)))
            .map(|piece| piece.map(|p| p.as_vec2().as_dvec2()))
            .collect();
        let count = (pieces.len() as u32).next_power_of_two();
        let side = (4 * count).clamp(8, cells.max(8));
        let band_count = (2 * count).clamp(4, 1024);
        let (bands, entries) = bands_of(&pieces, band_count);
        let curves = pieces.iter().flat_map(|[a, b, c, d]| {
            let pair = |p: &DVec2, q: &DVec2| Vec4::new(p.x as f32, p.y as f32, q.x as f32, q.y as f32);
            [pair(a, b), pair(c, d)]
        });
        let mut table = Self {
            low,
            extent,
            header: TrimHeader { columns: side, rows: side, bands: band_count, ..TrimHeader::default() },
            cells: Vec::new(),
            bands,
            entries,
            curves: curves.collect(),
        };
        table.cells = table.cells_of(&pieces, side);
        Ok(table)
    }

    /// The box of the curves.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        (self.low, self.low + self.extent)
    }

    /// The CPU twin: whether (u, v) is inside.
    pub fn contains(&self, uv: DVec2) -> bool {
        self.contains_unit(self.normalized(uv))
    }

    /// Which of the points (u, v) are inside, found on the device.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn classify(&self, gpu: &Gpu, points: &[DVec2]) -> Result<Vec<bool>, GpuError> {
        let mut out = Vec::with_capacity(points.len());
        let most = (gpu.largest_binding() / 8) as usize;
        for points in points.chunks(most) {
            let name =
                format!("classify {} points against {} trim curves", points.len(), self.curves.len() / 2);
            let found = gpu.scoped(&name, || {
                let units: Vec<Vec2> = points.iter().map(|&uv| self.normalized(uv)).collect();
                let header = gpu.upload("trim header", &[self.header]);
                let cells = gpu.upload("trim cells", &self.cells);
                let bands = gpu.upload("trim bands", &self.bands);
                let entries = gpu.upload("trim entries", &self.entries);
                let curves = gpu.upload("trim curves", &self.curves);
                let places = gpu.upload("points", &units);
                let found = gpu.reserve("found", 4 * points.len() as u64);
                let mut encoder = gpu.device().create_command_encoder(&Default::default());
                let buffers = [&header, &cells, &bands, &entries, &curves, &places, &found];
                gpu.dispatch(
                    &mut encoder,
                    &Key::new("trim_classify", "main"),
                    &buffers,
                    points.len().div_ceil(64),
                );
                gpu.queue().submit([encoder.finish()]);
                Ok(found)
            })?;
            let found: Vec<u32> = gpu.download(&name, &found, 4 * points.len() as u64)?;
            out.extend(found.into_iter().map(|inside| inside == 1));
        }
        Ok(out)
    }

    /// What the rectangle between two points (u, v) holds.
    pub fn cover(&self, a: DVec2, b: DVec2) -> Cover {
        let (a, b) = ((a - self.low) / self.extent, (b - self.low) / self.extent);
        let TrimHeader { columns, rows, .. } = self.header;
        let cell = |x: f64, count: u32| ((x * f64::from(count)).floor().max(0.0) as u32).min(count - 1);
        let (low, high) = (a.min(b) - SLACK, a.max(b) + SLACK);
        let mut found = None;
        for row in cell(low.y, rows)..=cell(high.y, rows) {
            for column in cell(low.x, columns)..=cell(high.x, columns) {
                let state = self.state(row * columns + column);
                if state == MIXED || found.is_some_and(|before| before != state) {
                    return Cover::Part;
                }
                found = Some(state);
            }
        }
        if found == Some(INSIDE) { Cover::Whole } else { Cover::None }
    }

    /// Sizes of the tables.
    pub fn header(&self) -> TrimHeader {
        self.header
    }

    /// States of the cells, four bits each.
    pub fn words(&self) -> &[u32] {
        &self.cells
    }

    /// First entry of each band, and the end of the last.
    pub fn bands(&self) -> &[u32] {
        &self.bands
    }

    /// Numbers of curves, band by band.
    pub fn entries(&self) -> &[u32] {
        &self.entries
    }

    /// The control points of the curves, two vectors each.
    pub fn curves(&self) -> &[Vec4] {
        &self.curves
    }

    fn normalized(&self, uv: DVec2) -> Vec2 {
        ((uv - self.low) / self.extent).as_vec2()
    }

    fn state(&self, cell: u32) -> u32 {
        (self.cells[(cell / 8) as usize] >> (4 * (cell % 8))) & 15
    }

    fn contains_unit(&self, uv: Vec2) -> bool {
        if uv.x < 0.0 || uv.y < 0.0 || uv.x > 1.0 || uv.y > 1.0 {
            return false;
        }
        let TrimHeader { columns, rows, .. } = self.header;
        let column = ((uv.x * columns as f32) as u32).min(columns - 1);
        let row = ((uv.y * rows as f32) as u32).min(rows - 1);
        match self.state(row * columns + column) {
            MIXED => self.crossings(uv) % 2 == 1,
            state => state == INSIDE,
        }
    }

    fn crossings(&self, uv: Vec2) -> usize {
        let count = self.header.bands;
        let band = ((uv.y * count as f32) as u32).min(count - 1) as usize;
        let range = self.bands[band] as usize..self.bands[band + 1] as usize;
        self.entries[range].iter().filter(|&&curve| self.crosses(curve as usize, uv)).count()
    }

    fn crosses(&self, curve: usize, uv: Vec2) -> bool {
        let (first, second) = (self.curves[2 * curve], self.curves[2 * curve + 1]);
        if (first.y > uv.y) == (second.w > uv.y) {
            return false;
        }
        if uv.x < first.x.min(second.z) {
            return true;
        }
        if uv.x >= first.x.max(second.z) {
            return false;
        }
        let v = Vec4::new(first.y, first.w, second.y, second.w) - uv.y;
        let u = Vec4::new(first.x, first.z, second.x, second.z);
        let (mut low, mut high) = (0.0, 1.0);
        let rises = v.w > v.x;
        for _ in 0..24 {
            let middle = 0.5 * (low + high);
            if (cubic(v, middle) > 0.0) == rises {
                high = middle
            } else {
                low = middle
            }
            let (a, b) = (cubic(u, low), cubic(u, high));
            if a.min(b) > uv.x {
                return true;
            }
            if a.max(b) < uv.x {
                return false;
            }
        }
        cubic(u, 0.5 * (low + high)) > uv.x
    }

    /// Which cells curves pass through, and on which side of all of them the others lie.
    fn cells_of(&self, pieces: &[Cubic], side: u32) -> Vec<u32> {
        let mut states = vec![OUTSIDE; (side * side) as usize];
        for piece in pieces {
            mark(piece, [0.0, 1.0], side, &mut states);
        }
        for row in 0..side {
            for column in 0..side {
                let state = &mut states[(row * side + column) as usize];
                let centre = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) / side as f32;
                if *state != MIXED && self.crossings(centre) % 2 == 1 {
                    *state = INSIDE;
                }
            }
        }
        states
            .chunks(8)
            .map(|eight| eight.iter().enumerate().fold(0, |word, (k, s)| word | s << (4 * k)))
            .collect()
    }
}

fn cubic(p: Vec4, t: f32) -> f32 {
    let s = 1.0 - t;
    ((p.x * s + 3.0 * p.y * t) * s + 3.0 * p.z * t * t) * s + p.w * t * t * t
}

/// Marks the cells that meet the part of a monotone curve between two shares.
fn mark(piece: &Cubic, [from, to]: [f64; 2], side: u32, states: &mut [u32]) {
    let (a, b) = (point(piece, from), point(piece, to));
    let cell = |x: f64| ((x * f64::from(side)).floor().max(0.0) as u32).min(side - 1);
    let (low, high) = (a.min(b) - SLACK, a.max(b) + SLACK);
    let (columns, rows) = (cell(low.x)..=cell(high.x), cell(low.y)..=cell(high.y));
    let is_small = columns.end() - columns.start() <= 1 && rows.end() - rows.start() <= 1;
    if is_small || to - from < 1e-4 {
        for row in rows {
            for column in columns.clone() {
                states[(row * side + column) as usize] = MIXED;
            }
        }
        return;
    }
    let middle = 0.5 * (from + to);
    mark(piece, [from, middle], side, states);
    mark(piece, [middle, to], side, states);
}

/// For each band of v the curves that reach into it.
fn bands_of(pieces: &[Cubic], count: u32) -> (Vec<u32>, Vec<u32>) {
    let mut lists = vec![Vec::new(); count as usize];
    for (number, [a, _, _, d]) in (0u32..).zip(pieces) {
        let band = |v: f64| ((v * f64::from(count)).floor().max(0.0) as usize).min(count as usize - 1);
        for list in &mut lists[band(a.y.min(d.y) - SLACK)..=band(a.y.max(d.y) + SLACK)] {
            list.push(number);
        }
    }
    let mut starts = vec![0];
    starts.extend(lists.iter().scan(0, |sum, list| {
        *sum += list.len() as u32;
        Some(*sum)
    }));
    (starts, lists.concat())
}
