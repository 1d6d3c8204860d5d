//! Levels of detail of an evaluated grid, up and down without evaluating again.

use glam::Vec4;

use crate::device::Key;
use crate::{Gpu, GpuError};

/// How a level becomes the next coarser one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wavelet {
    /// Averages of 2 x 2 points (Tan, Zhao, Lu 2012, section 4.3), for 2^n points in each direction. Averages leave the
    /// surface, and each border moves inwards by half a cell.
    Haar,
    /// Every other point, for 2^n + 1 points in each direction (the 5/3 wavelet's prediction without its update). All
    /// points stay on the surface, borders on borders.
    Lifting,
}

/// What a grid of levels consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Levels {
    wavelet: Wavelet,
    rows: usize,
    columns: usize,
    level: u32,
}

/// A grid of points with its details: the coarsest level in front, in both directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    levels: Levels,
    points: Vec<Vec4>,
}

/// A [`Pyramid`] that stays on the device.
#[derive(Debug)]
pub struct DevicePyramid {
    gpu: Gpu,
    levels: Levels,
    /// Vectors per point.
    width: u32,
    /// The grid, and room for the step along one direction.
    buffers: [wgpu::Buffer; 2],
}

/// As in `shaders/shared/wavelet.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Step {
    rows: u32,
    columns: u32,
    region_rows: u32,
    region_columns: u32,
    direction: u32,
    width: u32,
    unused: [u32; 2],
}

impl Wavelet {
    /// `haar`, `lifting`
    pub fn name(self) -> &'static str {
        match self {
            Self::Haar => "haar",
            Self::Lifting => "lifting",
        }
    }

    fn coarser(self, length: usize) -> Option<usize> {
        match self {
            Self::Haar => (length >= 2 && length.is_multiple_of(2)).then_some(length / 2),
            Self::Lifting => (length >= 3 && !length.is_multiple_of(2)).then_some(length / 2 + 1),
        }
    }

    fn shader(self, is_down: bool) -> &'static str {
        match (self, is_down) {
            (Self::Haar, true) => "haar_down",
            (Self::Haar, false) => "haar_up",
            (Self::Lifting, true) => "lifting_down",
            (Self::Lifting, false) => "lifting_up",
        }
    }

    /// The CPU twin of a step along one line.
    fn line(self, is_down: bool, line: &[Vec4]) -> Vec<Vec4> {
        let n = line.len();
        match (self, is_down) {
            (Self::Haar, true) => {
                let pairs = || line.chunks_exact(2);
                pairs().map(|p| 0.5 * (p[0] + p[1])).chain(pairs().map(|p| 0.5 * (p[0] - p[1]))).collect()
            }
            (Self::Haar, false) => {
                let (averages, details) = line.split_at(n / 2);
                averages.iter().zip(details).flat_map(|(&a, &d)| [a + d, a - d]).collect()
            }
            (Self::Lifting, true) => {
                let odd = (1..n).step_by(2).map(|k| line[k] - 0.5 * (line[k - 1] + line[k + 1]));
                line.iter().step_by(2).copied().chain(odd).collect()
            }
            (Self::Lifting, false) => {
                let (even, details) = line.split_at(n.div_ceil(2));
                let middle = |k: usize| details[k] + 0.5 * (even[k] + even[k + 1]);
                (0..n).map(|k| if k % 2 == 0 { even[k / 2] } else { middle(k / 2) }).collect()
            }
        }
    }
}

impl Levels {
    fn size(&self) -> [usize; 2] {
        self.size_at(self.level)
    }

    fn size_at(&self, level: u32) -> [usize; 2] {
        [self.rows, self.columns]
            .map(|length| (0..level).fold(length, |length, _| self.wavelet.coarser(length).unwrap_or(length)))
    }

    fn can_go_down(&self) -> bool {
        self.size().into_iter().all(|length| self.wavelet.coarser(length).is_some())
    }

    /// Goes to the next level; the region that the step works on and the order of its directions. `None` at the ends.
    fn step(&mut self, is_down: bool) -> Option<([usize; 2], [u32; 2])> {
        if (is_down && !self.can_go_down()) || (!is_down && self.level == 0) {
            return None;
        }
        let before = self.level;
        self.level = if is_down { before + 1 } else { before - 1 };
        // The finer of the two levels is what a step works on: down along rows, then along columns; up the other way.
        Some((self.size_at(before.min(self.level)), if is_down { [0, 1] } else { [1, 0] }))
    }

    /// The points of the present level, row-major.
    fn points(&self, all: &[Vec4]) -> Vec<Vec4> {
        let [rows, columns] = self.size();
        all.chunks(self.columns).take(rows).flat_map(|row| row[..columns].to_vec()).collect()
    }
}

impl Pyramid {
    /// The finest level: `rows` x `columns` points, row-major, as evaluated (not homogeneous).
    ///
    /// # Errors
    /// Where the points do not fill the grid.
    pub fn new(wavelet: Wavelet, rows: usize, columns: usize, points: Vec<Vec4>) -> Result<Self, GpuError> {
        if rows.checked_mul(columns) != Some(points.len()) || points.is_empty() {
            return Err(GpuError::Request(format!(
                "{} points do not fill {rows} rows of {columns}",
                points.len()
            )));
        }
        Ok(Self { levels: Levels { wavelet, rows, columns, level: 0 }, points })
    }

    /// How many steps lead down from the finest level.
    pub fn level(&self) -> u32 {
        self.levels.level
    }

    /// Rows and columns of the present level.
    pub fn size(&self) -> [usize; 2] {
        self.levels.size()
    }

    /// The points of the present level, row-major.
    pub fn points(&self) -> Vec<Vec4> {
        self.levels.points(&self.points)
    }

    /// Whether a coarser level exists: both directions can be halved.
    pub fn can_go_down(&self) -> bool {
        self.levels.can_go_down()
    }

    /// One level coarser (`true`) or finer: the CPU twin of [`DevicePyramid::step`]. Nothing happens at the ends.
    pub fn step(&mut self, is_down: bool) {
        if let Some((region, directions)) = self.levels.step(is_down) {
            directions.into_iter().for_each(|direction| self.step_along(is_down, region, direction));
        }
    }

    fn step_along(&mut self, is_down: bool, [rows, columns]: [usize; 2], direction: u32) {
        let Levels { wavelet, columns: width, .. } = self.levels;
        let (lines, length) = if direction == 0 { (rows, columns) } else { (columns, rows) };
        for line in 0..lines {
            let at = |k: usize| if direction == 0 { line * width + k } else { k * width + line };
            let values: Vec<Vec4> = (0..length).map(|k| self.points[at(k)]).collect();
            for (k, value) in wavelet.line(is_down, &values).into_iter().enumerate() {
                self.points[at(k)] = value;
            }
        }
    }
}

impl DevicePyramid {
    /// The same grid at the same level on the device.
    ///
    /// # Errors
    /// What the device refuses; more points than one of its buffers may have.
    pub fn new(gpu: &Gpu, pyramid: &Pyramid) -> Result<Self, GpuError> {
        let levels = pyramid.levels;
        let request = format!("{} of {} x {} points", levels.wavelet.name(), levels.rows, levels.columns);
        let bytes = size_of_val(&pyramid.points[..]) as u64;
        if bytes > gpu.largest_binding() {
            let reason = format!("{bytes} bytes of points, the device allows {}", gpu.largest_binding());
            return Err(GpuError::TooLarge { request, reason });
        }
        let buffers = gpu.scoped(&request, || {
            Ok([gpu.upload("level", &pyramid.points), gpu.reserve("step of a level", bytes)])
        })?;
        Ok(Self { gpu: gpu.clone(), levels, width: 1, buffers })
    }

    /// The finest level as an evaluator left it: `width` vectors for each of `rows` x `columns` points from the byte
    /// `offset` of `values` on.
    ///
    /// # Errors
    /// What the device refuses; points that are not there.
    pub fn of_values(
        gpu: &Gpu,
        wavelet: Wavelet,
        [rows, columns]: [usize; 2],
        width: u32,
        values: &wgpu::Buffer,
        offset: u64,
    ) -> Result<Self, GpuError> {
        let levels = Levels { wavelet, rows, columns, level: 0 };
        let request = format!("{} of {rows} x {columns} points", wavelet.name());
        let bytes = 16 * (rows * columns) as u64 * u64::from(width);
        let buffers = gpu.scoped(&request, || {
            let buffers = [0, 1].map(|_| gpu.reserve_on_device("level", bytes));
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(values, offset, &buffers[0], 0, bytes);
            gpu.queue().submit([encoder.finish()]);
            Ok(buffers)
        })?;
        Ok(Self { gpu: gpu.clone(), levels, width, buffers })
    }

    /// How many steps lead down from the finest level.
    pub fn level(&self) -> u32 {
        self.levels.level
    }

    /// Rows and columns of the present level.
    pub fn size(&self) -> [usize; 2] {
        self.levels.size()
    }

    /// Rows and columns of the finest level.
    pub fn finest(&self) -> [usize; 2] {
        self.levels.size_at(0)
    }

    /// Whether a coarser level exists: both directions can be halved.
    pub fn can_go_down(&self) -> bool {
        self.levels.can_go_down()
    }

    /// The grid of the finest level's rows and columns; the present level is its first rows and columns.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffers[0]
    }

    /// One level coarser (`true`) or finer; the work may not be done yet when this returns. Nothing happens at the ends.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn step(&mut self, is_down: bool) -> Result<(), GpuError> {
        let mut levels = self.levels;
        let Some((region, directions)) = levels.step(is_down) else { return Ok(()) };
        let shader = levels.wavelet.shader(is_down);
        let request = format!("{shader} of {} x {} points", region[0], region[1]);
        self.gpu.scoped(&request, || {
            let mut encoder = self.gpu.device().create_command_encoder(&Default::default());
            let [mut before, mut after] = self.buffers.each_ref();
            for direction in directions {
                let step = Step {
                    rows: levels.rows as u32,
                    columns: levels.columns as u32,
                    region_rows: region[0] as u32,
                    region_columns: region[1] as u32,
                    direction,
                    width: self.width,
                    unused: [0; 2],
                };
                let step = self.gpu.upload("step", &[step]);
                let points = levels.rows * levels.columns * self.width as usize;
                let key = Key::new(shader, "main");
                self.gpu.dispatch(&mut encoder, &key, &[&step, before, after], points.div_ceil(64));
                std::mem::swap(&mut before, &mut after);
            }
            self.gpu.queue().submit([encoder.finish()]);
            Ok(())
        })?;
        self.levels = levels;
        Ok(())
    }

    /// The points of the present level, row-major (one vector each).
    ///
    /// # Errors
    /// What the device refuses.
    pub fn points(&self) -> Result<Vec<Vec4>, GpuError> {
        let bytes = 16 * (self.levels.rows * self.levels.columns) as u64;
        let all: Vec<Vec4> = self.gpu.download("read a level", &self.buffers[0], bytes)?;
        Ok(self.levels.points(&all))
    }
}
