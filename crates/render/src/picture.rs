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

impl Seen {
    pub(crate) fn empty(size: [u32; 2]) -> Self {
        Self { width: size[0], height: size[1], pixels: vec![None; size[0] as usize * size[1] as usize] }
    }
}

/// How much two pictures differ: 0 for not at all, 1 for black and white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Over the whole picture.
    pub mean: f64,
    /// Over the square of 16 x 16 pixels where it is largest.
    pub worst_region: f64,
}

/// Pixels along the side of a region.
const REGION: u32 = 16;

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

    /// A picture from a PNG file with eight bits a channel, with or without opacity.
    ///
    /// # Errors
    /// Where it is none.
    pub fn from_png(bytes: &[u8]) -> Result<Self, RenderError> {
        let failed = |error: png::DecodingError| RenderError::Encode(error.to_string());
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder
            .set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().map_err(failed)?;
        let size = reader.output_buffer_size();
        let mut rgba = vec![0; size.ok_or_else(|| RenderError::Encode("it is too large".to_owned()))?];
        let info = reader.next_frame(&mut rgba).map_err(failed)?;
        if info.color_type != png::ColorType::Rgba {
            return Err(RenderError::Encode("it has no colours".to_owned()));
        }
        Ok(Self { width: info.width, height: info.height, rgba })
    }

    /// How much two pictures of the same size differ to the eye; `None` where the sizes differ.
    pub fn difference(&self, other: &Self) -> Option<Difference> {
        if [self.width, self.height] != [other.width, other.height] {
            return None;
        }
        let columns = self.width.div_ceil(REGION);
        let mut regions = vec![(0.0, 0.0); (columns * self.height.div_ceil(REGION)) as usize];
        let pixels = self.rgba.chunks_exact(4).zip(other.rgba.chunks_exact(4));
        for (k, (a, b)) in (0u32..).zip(pixels) {
            let (x, y) = (k % self.width, k / self.width);
            let own = (0..4).map(|c| f64::from(a[c]) - f64::from(b[c])).map(|d| d * d).sum::<f64>();
            let region = &mut regions[(y / REGION * columns + x / REGION) as usize];
            *region = (region.0 + (own / 4.0).sqrt() / 255.0, region.1 + 1.0);
        }
        let mean = regions.iter().map(|r| r.0).sum::<f64>() / f64::from((self.width * self.height).max(1));
        let worst_region = regions.iter().map(|r| r.0 / r.1).fold(0.0, f64::max);
        Some(Difference { mean, worst_region })
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
