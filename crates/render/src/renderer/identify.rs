//! What the pixels of a picture show: at once, or as soon as the device knows.

use trimloop_gpu::GpuError;

use crate::camera::Camera;
use crate::emission::{Emission, Strips};
use crate::frame::{Numbered, Shot, Tile};
use crate::look::Look;
use crate::passes::{Pass, Trim};
use crate::picture::{Pick, Seen};
use crate::scene::{FaceKind, Scene};
use crate::targets::{IdTargets, attachment, depth_attachment, view_of};
use crate::{Place, RenderError};

use super::{Bound, Renderer, check, copy_rows, read_back, tiles, trim_of};

impl Renderer {
    /// What every pixel of a picture of `size` pixels shows.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn seen(&mut self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Seen, RenderError> {
        check(size)?;
        let (emission, faces) = self.prepare(camera, size, look, true, None)?;
        let mut out = Seen::empty(size);
        for tile in tiles(size) {
            let texels = self.identify(camera, size, look, &emission, &tile)?;
            for (k, texel) in texels.into_iter().enumerate() {
                let (x, y) = (k as u32 % tile.size[0], k as u32 / tile.size[0]);
                let at = (tile.row + y) as usize * size[0] as usize + (tile.column + x) as usize;
                out.pixels[at] = pick_of(&self.scene, texel, &faces);
            }
        }
        Ok(out)
    }

    /// Begins to find out what every pixel of a picture shows, and does not wait for it.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn begin_seen(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
    ) -> Result<Pending, RenderError> {
        check(size)?;
        let (emission, faces) = self.prepare(camera, size, look, true, None)?;
        let mut parts = Vec::new();
        for tile in tiles(size) {
            let (buffer, row) = self.encode_identify(camera, size, look, &emission, &tile)?;
            let (sender, done) = std::sync::mpsc::channel();
            // Told by the device when it is polled; nobody listens where the picture is not wanted any more.
            buffer.map_async(wgpu::MapMode::Read, .., move |result| _ = sender.send(result.is_ok()));
            parts.push(PendingTile { tile, buffer, row, done, is_done: false });
        }
        Ok(Pending { size, parts, faces })
    }

    /// What every pixel shows, once the device has found out; `None` until then. An error where it cannot be told any more.
    ///
    /// # Errors
    /// A lost device.
    pub fn finish_seen(&self, pending: &mut Pending) -> Result<Option<Identified>, RenderError> {
        // Whether that failed shows in what the buffers say.
        let _ = self.gpu.device().poll(wgpu::PollType::Poll);
        let request = || "identify pixels".to_owned();
        for part in pending.parts.iter_mut().filter(|part| !part.is_done) {
            match part.done.try_recv() {
                Ok(true) => part.is_done = true,
                Err(std::sync::mpsc::TryRecvError::Empty) => return Ok(None),
                _ => return Err(GpuError::Lost { request: request(), reason: "no answer".to_owned() }.into()),
            }
        }
        let [width, height] = pending.size.map(|n| n as usize);
        let mut texels = vec![[0; 3]; width * height];
        for PendingTile { tile, buffer, row, .. } in &pending.parts {
            let refused = |reason: String| GpuError::Refused { request: request(), reason };
            let bytes = buffer.get_mapped_range(..).map_err(|error| refused(error.to_string()))?;
            for (y, line) in (tile.row as usize..).zip(bytes.chunks_exact(*row as usize)) {
                let from = line[..tile.size[0] as usize * 16].chunks_exact(16).map(texel);
                let to = &mut texels[y * width + tile.column as usize..];
                to.iter_mut().zip(from).for_each(|(to, [id, u, v, _])| *to = [id, u, v]);
            }
        }
        let faces = std::mem::take(&mut pending.faces);
        Ok(Some(Identified { low: [0; 2], size: pending.size, texels, faces }))
    }

    /// What some pixels of a picture of `size` pixels show: `count` columns and rows from `low` on, which must lie within it
    /// and be no more than a tile.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn identify_within(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        low: [u32; 2],
        count: [u32; 2],
    ) -> Result<Identified, RenderError> {
        check(size)?;
        check(count)?;
        let (emission, faces) = self.prepare(camera, size, look, true, None)?;
        let tile = Tile { column: low[0], row: low[1], size: count, jitter: [0.0; 2] };
        let texels = self.identify(camera, size, look, &emission, &tile)?;
        let texels = texels.into_iter().map(|[id, u, v, _]| [id, u, v]).collect();
        Ok(Identified { low, size: count, texels, faces })
    }

    /// What lies at a pixel; `None` also outside of the picture.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn pick(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        [column, row]: [u32; 2],
    ) -> Result<Option<Place>, RenderError> {
        check(size)?;
        if column >= size[0] || row >= size[1] {
            return Ok(None);
        }
        let found = self.identify_within(camera, size, look, [column, row], [1, 1])?;
        let at = glam::DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
        let pick = found.at(&self.scene, [column, row].map(i64::from));
        Ok(pick.and_then(|pick| Place::new(&self.scene, &pick, camera.ray(at, size))))
    }

    /// The work that tells what the pixels of a tile show, submitted: the buffer that will hold it, and its bytes per row.
    fn encode_identify(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        emission: &Emission,
        tile: &Tile,
    ) -> Result<(wgpu::Buffer, u32), RenderError> {
        let gpu = self.gpu.clone();
        let row = (tile.size[0] * 16).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.scoped("identify pixels", || {
            let (mut encoder, texture) = self.identify_pass(camera, size, look, emission, tile);
            let buffer = gpu.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some("identify"),
                size: u64::from(row) * u64::from(tile.size[1]),
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            copy_rows(&mut encoder, &texture, &buffer, row);
            gpu.queue().submit([encoder.finish()]);
            Ok(buffer)
        })?;
        Ok((buffer, row))
    }

    /// What the pixels of a tile show.
    fn identify(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        emission: &Emission,
        tile: &Tile,
    ) -> Result<Vec<[u32; 4]>, RenderError> {
        let gpu = self.gpu.clone();
        let bytes = read_back(&gpu, "identify pixels", tile.size, 16, || {
            Ok(self.identify_pass(camera, size, look, emission, tile))
        })?;
        Ok(bytes.chunks_exact(16).map(texel).collect())
    }

    /// The work that tells what the pixels of a tile show, and the texture that it goes to.
    fn identify_pass(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        emission: &Emission,
        tile: &Tile,
    ) -> (wgpu::CommandEncoder, wgpu::Texture) {
        let shot = Shot { scene: &self.scene, camera, look, size };
        let gpu = &self.gpu;
        let (passes, emitter) = (&mut self.passes, &mut self.emitter);
        let targets = IdTargets::new(gpu, tile.size);
        let bound = Bound::new(gpu, passes, &self.stage, &shot, emission, tile);
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        emitter.encode(gpu, &mut encoder, emission, self.stage.cells.buffer(), &shot.bounds(tile), None);
        let view = view_of(&targets.ids);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("identify"),
            color_attachments: &[attachment(&view, None, [0.0; 4])],
            depth_stencil_attachment: Some(depth_attachment(&targets.depth, true)),
            ..Default::default()
        });
        bound.trims(&mut pass);
        for (k, trim) in [(0, Trim::None), (1, trim_of(look))] {
            bound.faces(gpu, &mut pass, passes, Pass::Identify(trim), 1, k);
        }
        bound.strips(gpu, &mut pass, passes, Pass::IdentifyBorder, 1, Strips::Borders);
        drop(pass);
        (encoder, targets.ids)
    }
}

/// What the pixels of a picture show, as soon as the device knows.
#[derive(Debug)]
pub struct Pending {
    size: [u32; 2],
    parts: Vec<PendingTile>,
    faces: Vec<Numbered>,
}

#[derive(Debug)]
struct PendingTile {
    tile: Tile,
    buffer: wgpu::Buffer,
    /// Bytes of a row of pixels.
    row: u32,
    done: std::sync::mpsc::Receiver<bool>,
    is_done: bool,
}

/// What the pixels of a picture show.
#[derive(Debug)]
pub struct Identified {
    /// The left upper pixel, and how many there are.
    low: [u32; 2],
    size: [u32; 2],
    texels: Vec<[u32; 3]>,
    faces: Vec<Numbered>,
}

impl Identified {
    /// What a pixel shows; `None` also outside of the picture.
    pub fn at(&self, scene: &Scene, [column, row]: [i64; 2]) -> Option<Pick> {
        let [width, height] = self.size.map(i64::from);
        let (column, row) = (column - i64::from(self.low[0]), row - i64::from(self.low[1]));
        if !(0..width).contains(&column) || !(0..height).contains(&row) {
            return None;
        }
        let [id, u, v] = self.texels[(row * width + column) as usize];
        pick_of(scene, [id, u, v, 0], &self.faces)
    }
}

/// Four words.
fn texel(bytes: &[u8]) -> [u32; 4] {
    [0, 4, 8, 12].map(|k| u32::from_ne_bytes([bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]]))
}

/// What a texel of the pass that identifies means.
fn pick_of(scene: &Scene, [id, u, v, _]: [u32; 4], faces: &[Numbered]) -> Option<Pick> {
    let Numbered { instance, face, tile } = *faces.get(id.checked_sub(1)? as usize)?;
    let (instance, face) = (instance as usize, face as usize);
    let share = glam::DVec2::new(f64::from(f32::from_bits(u)), f64::from(f32::from_bits(v)));
    let part = scene.parts.get(scene.instances.get(instance)?.part)?;
    let share = match &part.faces.get(face)?.kind {
        FaceKind::Surface(whole) => whole.tile(tile)?.share_of_whole(share),
        _ => share,
    };
    Some(Pick { instance, face, share })
}
