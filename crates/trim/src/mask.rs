//! The CPU reference trim mask: a face's inside as pixels.

use glam::DVec2;
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

use crate::TrimDomain;

/// A face's inside as pixels of its parameter plane.
#[derive(Clone, Debug)]
pub struct TrimMask {
    mask: Mask,
    low: DVec2,
    high: DVec2,
}

/// Why a mask cannot be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MaskError {
    /// Zero or too many pixels.
    #[error("a mask needs between 1 and 32767 pixels in each direction")]
    Size,
    /// The domain is empty or not finite.
    #[error("the domain has no extent")]
    Extent,
}

impl TrimMask {
    /// Draws `domain` by the even-odd rule on `columns` x `rows` pixels that span `low`..`high` (u to the right, v
    /// upwards: row 0 is the lowest). A pixel is inside when its centre is.
    pub fn draw(
        domain: &TrimDomain,
        low: DVec2,
        high: DVec2,
        columns: u32,
        rows: u32,
    ) -> Result<Self, MaskError> {
        if columns > 32767 || rows > 32767 {
            return Err(MaskError::Size);
        }
        let mut mask = Mask::new(columns, rows).ok_or(MaskError::Size)?;
        let extent = high - low;
        if !(extent.is_finite() && extent.cmpgt(DVec2::ZERO).all()) {
            return Err(MaskError::Extent);
        }
        let scale = DVec2::new(f64::from(columns), f64::from(rows)) / extent;
        let mut path = PathBuilder::new();
        for l in domain.loops.iter().filter(|l| l.vertices.len() > 2) {
            for (k, uv) in l.uvs().enumerate() {
                let p = ((uv - low) * scale).as_vec2();
                if k == 0 { path.move_to(p.x, p.y) } else { path.line_to(p.x, p.y) }
            }
            path.close();
        }
        if let Some(path) = path.finish() {
            mask.fill_path(&path, FillRule::EvenOdd, false, Transform::identity());
        }
        Ok(Self { mask, low, high })
    }

    /// [columns, rows]
    pub fn size(&self) -> [u32; 2] {
        [self.mask.width(), self.mask.height()]
    }

    /// Whether the pixel is inside; row 0 is the lowest v.
    pub fn is_inside(&self, column: u32, row: u32) -> bool {
        let at = row as usize * self.mask.width() as usize + column as usize;
        self.mask.data().get(at).is_some_and(|&a| a > 127)
    }

    /// The parameters of a pixel's centre.
    pub fn pixel_centre(&self, column: u32, row: u32) -> DVec2 {
        let [columns, rows] = self.size();
        let share = DVec2::new(
            (f64::from(column) + 0.5) / f64::from(columns),
            (f64::from(row) + 0.5) / f64::from(rows),
        );
        self.low + (self.high - self.low) * share
    }

    /// A pixel's diagonal in the parameter plane.
    pub fn pixel_diagonal(&self) -> f64 {
        let [columns, rows] = self.size();
        ((self.high - self.low) / DVec2::new(f64::from(columns), f64::from(rows))).length()
    }

    /// Coverage, row-major from the lowest row: 255 inside, 0 outside.
    pub fn data(&self) -> &[u8] {
        self.mask.data()
    }
}
