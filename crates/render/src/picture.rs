//! What comes out.

use glam::DVec2;

use crate::RenderError;

/// A picture: sRGB with straight alpha, four bytes a pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// `width * height * 4` bytes.
    pub rgba: Vec<u8>,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Index of the instance in the scene.
    pub instance: usize,
    /// Index of the face in its part.
    pub face: usize,
    /// Shares of the face's domain, as the device interpolated them.
    pub share: DVec2,
}

/// What every pixel shows, row by row from the top.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// One per pixel.
    pub pixels: Vec<Option<Pick>>,
}

impl Picture {
    /// The picture as a PNG file.
    ///
    /// # Errors
    /// Where it is too large for the format.
    pub fn to_png(&self) -> Result<Vec<u8>, RenderError> {
        let mut out = Vec::new();
        let failed = |error: png::EncodingError| RenderError::Encode(error.to_string());
        let is_opaque = self.rgba.iter().skip(3).step_by(4).all(|a| *a == 255);
        let mut encoder = png::Encoder::new(&mut out, self.width, self.height);
        encoder.set_color(if is_opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(failed)?;
        if is_opaque {
            let rgb: Vec<u8> = self.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
            writer.write_image_data(&rgb).map_err(failed)?;
        } else {
            writer.write_image_data(&self.rgba).map_err(failed)?;
        }
        writer.finish().map_err(failed)?;
        Ok(out)
    }

    /// The pixel in a column of a row.
    pub fn pixel(&self, column: u32, row: u32) -> [u8; 4] {
        let at = 4 * (row as usize * self.width as usize + column as usize);
        [self.rgba[at], self.rgba[at + 1], self.rgba[at + 2], self.rgba[at + 3]]
    }

    /// Puts `other` into this picture with its upper left corner at `column`, `row`.
    pub(crate) fn paste(&mut self, other: &Self, column: u32, row: u32) {
        for y in 0..other.height.min(self.height.saturating_sub(row)) {
            let count = other.width.min(self.width.saturating_sub(column)) as usize * 4;
            let from = (y * other.width) as usize * 4;
            let to = ((row + y) as usize * self.width as usize + column as usize) * 4;
            self.rgba[to..to + count].copy_from_slice(&other.rgba[from..from + count]);
        }
    }
}

impl Seen {
    /// What the pixel in a column of a row shows.
    pub fn at(&self, column: u32, row: u32) -> Option<Pick> {
        self.pixels[row as usize * self.width as usize + column as usize]
    }
}
