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

/// A grid of points with its details: the coarsest level in front, in both directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    wavelet: Wavelet,
    rows: usize,
    columns: usize,
    level: u32,
    points: Vec<Vec4>,
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
    unused: [u32; 3],
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
        Ok(Self { wavelet, rows, columns, level: 0, points })
    }

    /// How many steps lead down from the finest level.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Rows and columns of the present level.
    pub fn size(&self) -> [usize; 2] {
        self.size_at(self.level)
    }

    fn size_at(&self, level: u32) -> [usize; 2] {
        [self.rows, self.columns]
            .map(|length| (0..level).fold(length, |length, _| self.wavelet.coarser(length).unwrap_or(length)))
    }

    /// The points of the present level, row-major.
    pub fn points(&self) -> Vec<Vec4> {
        let [rows, columns] = self.size();
        self.points.chunks(self.columns).take(rows).flat_map(|row| row[..columns].to_vec()).collect()
    }

    /// Whether a coarser level exists: both directions can be halved.
    pub fn can_go_down(&self) -> bool {
        self.size().into_iter().all(|length| self.wavelet.coarser(length).is_some())
    }

    /// One level coarser (`true`) or finer, on the device; without one, by the CPU twin. Nothing happens at the ends.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn step(&mut self, gpu: Option<&Gpu>, is_down: bool) -> Result<(), GpuError> {
        if (is_down && !self.can_go_down()) || (!is_down && self.level == 0) {
            return Ok(());
        }
        // The finer of the two levels is what a step works on.
        let finer = if is_down { self.level } else { self.level - 1 };
        let region = self.size_at(finer);
        // Down along rows, then along columns; up the other way.
        let directions = if is_down { [0, 1] } else { [1, 0] };
        match gpu {
            Some(gpu) => self.step_on_device(gpu, is_down, region, directions)?,
            None => directions.into_iter().for_each(|direction| self.step_on_cpu(is_down, region, direction)),
        }
        self.level = if is_down { self.level + 1 } else { self.level - 1 };
        Ok(())
    }

    fn step_on_cpu(&mut self, is_down: bool, [rows, columns]: [usize; 2], direction: u32) {
        let (lines, length) = if direction == 0 { (rows, columns) } else { (columns, rows) };
        for line in 0..lines {
            let at =
                |k: usize| if direction == 0 { line * self.columns + k } else { k * self.columns + line };
            let values: Vec<Vec4> = (0..length).map(|k| self.points[at(k)]).collect();
            for (k, value) in self.wavelet.line(is_down, &values).into_iter().enumerate() {
                self.points[at(k)] = value;
            }
        }
    }

    fn step_on_device(
        &mut self,
        gpu: &Gpu,
        is_down: bool,
        region: [usize; 2],
        directions: [u32; 2],
    ) -> Result<(), GpuError> {
        let request = format!("{} of {} x {} points", self.wavelet.shader(is_down), region[0], region[1]);
        let bytes = 16 * self.points.len() as u64;
        if bytes > gpu.largest_binding() {
            let reason = format!("{bytes} bytes of points, the device allows {}", gpu.largest_binding());
            return Err(GpuError::TooLarge { request, reason });
        }
        let result = gpu.scoped(&request, || {
            let mut before = gpu.upload("level", &self.points);
            let mut after = gpu.reserve("next level", bytes);
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            for direction in directions {
                let step = Step {
                    rows: self.rows as u32,
                    columns: self.columns as u32,
                    region_rows: region[0] as u32,
                    region_columns: region[1] as u32,
                    direction,
                    unused: [0; 3],
                };
                let step = gpu.upload("step", &[step]);
                let key = Key::new(self.wavelet.shader(is_down), "main");
                gpu.dispatch(&mut encoder, &key, &[&step, &before, &after], self.points.len().div_ceil(64));
                std::mem::swap(&mut before, &mut after);
            }
            gpu.queue().submit([encoder.finish()]);
            Ok(before)
        })?;
        self.points = gpu.download(&request, &result, bytes)?;
        Ok(())
    }
}
