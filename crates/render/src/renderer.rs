//! Draws pictures of a scene.

mod identify;

use std::time::{Duration, Instant};

use glam::DAffine3;
use rustc_hash::FxHashSet;
use trimloop_gpu::{Evaluator, Gpu, GpuError};
use trimloop_mesh::{Monitor, Silent};

use crate::RenderError;
use crate::camera::Camera;
use crate::clock::{Clock, TIMED};
use crate::emission::{Emission, Emitter, Strips};
use crate::error::MOST_PIXELS;
use crate::frame::{Numbered, Shot, Tile, Visible};
use crate::look::{Background, EdgeStyle, Look, MOST_SECTIONS, encode, linear};
use crate::passes::{Pass, Passes, Trim};
use crate::picture::Picture;
use crate::scene::{Highlight, Instance, Scene, ScenePart};
use crate::stage::{PieceKey, Stage};
use crate::targets::{Target, Targets, attachment, depth_attachment, view_of};

pub use identify::{Identified, Pending};

/// Draws pictures of a scene.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    scene: Scene,
    stage: Stage,
    passes: Passes,
    emitter: Emitter,
    targets: Option<Targets>,
    statistics: FrameStatistics,
    /// The parts that close what section planes cut open.
    caps: [Option<usize>; MOST_SECTIONS],
    clock: Option<Clock>,
}

/// What the last picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameStatistics {
    /// Faces in the picture, one per instance.
    pub faces: usize,
    /// Triangles sent to the rasterizer, before trimming.
    pub triangles: usize,
    /// Points that were evaluated for it.
    pub evaluated: usize,
    /// Pixels that what is drawn may be off: more than asked for where the device has not enough memory for that.
    pub screen_error_px: f64,
    /// Whether all of it is in the picture, or there was no time for that (see [`Renderer::paint`]).
    pub is_complete: bool,
    /// Seconds to choose levels of detail and to evaluate.
    pub evaluate_s: f64,
    /// Seconds in all.
    pub total_s: f64,
    /// Bytes that the device holds for the scene.
    pub bytes: u64,
    /// Milliseconds that the device took for the passes of an earlier picture in a window, as far as it can tell: emit,
    /// solid, transparent, compose.
    pub passes_ms: Option<[f64; TIMED.len()]>,
}

impl std::fmt::Display for FrameStatistics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            faces, triangles, evaluated, screen_error_px, evaluate_s, total_s, bytes, passes_ms, ..
        } = self;
        let (evaluate_ms, total_ms) = (evaluate_s * 1e3, total_s * 1e3);
        write!(
            f,
            "{faces} faces within {screen_error_px} px, {triangles} triangles, {evaluated} points evaluated in {evaluate_ms:.1} ms, \
             {total_ms:.1} ms in all, {} KiB on the device",
            bytes / 1024
        )?;
        for (name, ms) in TIMED.iter().zip(passes_ms.iter().flatten()) {
            write!(f, ", {name} {ms:.1} ms")?;
        }
        Ok(())
    }
}

/// Larger pictures are drawn in tiles.
const TILE: u32 = 2048;
/// How many times the error that was asked for is tried at most, where memory is short.
const COARSEST: f64 = 64.0;
/// Pieces that are evaluated together where there is little time.
const PARCEL: usize = 256;
/// Pieces that the last picture did not need are kept while all of them take less than this.
const KEPT_BYTES: u64 = 64 << 20;

impl Renderer {
    /// Brings `scene` to the device.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn new(gpu: &Gpu, scene: Scene) -> Result<Self, RenderError> {
        let name = format!("bring {} faces to the device", scene.face_count());
        let stage = gpu.scoped(&name, || Stage::new(gpu, &scene))?;
        Ok(Self {
            gpu: gpu.clone(),
            stage,
            passes: Passes::new(gpu),
            emitter: Emitter::default(),
            scene,
            targets: None,
            statistics: FrameStatistics::default(),
            caps: [None; MOST_SECTIONS],
            clock: Clock::new(gpu),
        })
    }

    /// What is drawn.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Shows or hides an instance.
    pub fn show(&mut self, instance: usize, is_shown: bool) {
        if let Some(instance) = self.scene.instances.get_mut(instance) {
            instance.is_shown = is_shown;
        }
    }

    /// Puts an instance elsewhere.
    pub fn place(&mut self, instance: usize, transform: DAffine3) {
        if let Some(instance) = self.scene.instances.get_mut(instance) {
            instance.transform = transform;
        }
    }

    /// Puts a part in the place of the one with that index, which ought to be of the same faces: what is shown as long as the
    /// part itself is not ready yet is nothing (see [`Scene::of_nothing_yet`]).
    ///
    /// # Errors
    /// What the device refuses.
    pub fn set_part(&mut self, index: usize, part: ScenePart) -> Result<(), RenderError> {
        if index >= self.scene.parts.len() {
            return Ok(());
        }
        let (gpu, stage) = (&self.gpu, &mut self.stage);
        let done = gpu.scoped("bring a part to the device", || stage.set_part(gpu, index, &part));
        // What the device does not have is not drawn.
        self.scene.parts[index] = match done {
            Ok(()) => part,
            Err(_) => ScenePart { name: part.name, ..ScenePart::default() },
        };
        Ok(done?)
    }

    /// What closes solids that a section plane (an index of [`Look::sections`]) cuts open (see [`crate::Cutter`]); `None` for
    /// nothing.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn set_caps(&mut self, section: usize, caps: Option<ScenePart>) -> Result<(), RenderError> {
        let Some(own) = self.caps.get_mut(section) else { return Ok(()) };
        let part = match (*own, &caps) {
            (Some(part), _) => part,
            (None, None) => return Ok(()),
            (None, Some(_)) => {
                self.scene.parts.push(ScenePart::default());
                let part = self.scene.parts.len() - 1;
                self.scene.instances.push(Instance::of_caps(part, section));
                *own = Some(part);
                part
            }
        };
        self.set_part(part, caps.unwrap_or_default())
    }

    /// Highlights instances, or single faces of them, and nothing else.
    pub fn highlight(&mut self, highlights: Vec<Highlight>) {
        self.scene.highlights = highlights;
    }

    /// What the last picture took.
    pub fn statistics(&self) -> FrameStatistics {
        self.statistics
    }

    /// Milliseconds that the device took for the passes of the last picture whose times have come (see
    /// [`FrameStatistics::passes_ms`]).
    pub fn passes_ms(&mut self) -> Option<[f64; TIMED.len()]> {
        let clock = self.clock.as_mut()?;
        clock.collect(&self.gpu);
        Some(clock.last_ms)
    }

    /// A picture of `size` pixels.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn picture(&mut self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Picture, RenderError> {
        self.picture_watched(camera, size, look, &Silent)
    }

    /// The same, where `monitor` is told of each of [`Renderer::steps`] and may stop it.
    ///
    /// # Errors
    /// As [`Renderer::picture`], and [`trimloop_mesh::Cancelled`].
    pub fn picture_watched(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        monitor: &dyn Monitor,
    ) -> Result<Picture, RenderError> {
        check(size)?;
        let start = Instant::now();
        let (emission, _) = self.prepare(camera, size, look, false, None)?;
        self.statistics.triangles = emission.triangles() as usize;
        let mut out = Picture {
            width: size[0],
            height: size[1],
            rgba: vec![0; size[0] as usize * size[1] as usize * 4],
        };
        let rounds = rounds(look);
        for mut tile in tiles(size) {
            let mut sums = Vec::new();
            for round in 0..rounds {
                if monitor.cancelled() {
                    return Err(trimloop_mesh::Cancelled.into());
                }
                tile.jitter = jitter(round, rounds);
                let own = self.tile(camera, size, look, &emission, &tile)?;
                if rounds == 1 {
                    out.paste(&own, tile.column, tile.row);
                } else {
                    accumulate(&mut sums, &own);
                }
                monitor.face_done();
            }
            if rounds > 1 {
                out.paste(&averaged(&sums, tile.size, rounds), tile.column, tile.row);
            }
        }
        self.statistics.total_s = start.elapsed().as_secs_f64();
        Ok(out)
    }

    /// The steps in which a picture of `size` pixels is drawn: its tiles, as often as samples ask for.
    pub fn steps(size: [u32; 2], look: &Look) -> usize {
        tiles(size).len() * rounds(look) as usize
    }

    /// A picture of `size` pixels that stays on the device, for a window: red, green, blue, opacity, as in a PNG file. The
    /// texture is the same as long as the size is; the next picture is drawn over it.
    ///
    /// When evaluating takes longer than `budget`, the rest is left to the next picture: what is there at another level of
    /// detail stands for it, what is not there at all is missing, and [`FrameStatistics::is_complete`] says so.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn paint(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        budget: Duration,
    ) -> Result<wgpu::Texture, RenderError> {
        check(size)?;
        let start = Instant::now();
        let (emission, _) = self.prepare(camera, size, look, false, Some(budget))?;
        self.statistics.triangles = emission.triangles() as usize;
        let tile = Tile { column: 0, row: 0, size, jitter: [0.0; 2] };
        let gpu = self.gpu.clone();
        if let Some(clock) = &mut self.clock {
            clock.collect(&gpu);
        }
        let mut clock = self.clock.take_if(|clock| clock.is_free());
        let texture = gpu.scoped(&format!("draw {} x {} pixels", size[0], size[1]), || {
            let (mut encoder, texture) = self.encode(camera, size, look, &emission, &tile, clock.as_ref())?;
            if let Some(clock) = &clock {
                clock.resolve(&mut encoder);
            }
            gpu.queue().submit([encoder.finish()]);
            if let Some(clock) = &mut clock {
                clock.ask();
            }
            Ok(texture)
        });
        self.clock = clock.or(self.clock.take());
        let texture = texture?;
        self.statistics.passes_ms = self.clock.as_ref().map(|clock| clock.last_ms);
        self.statistics.total_s = start.elapsed().as_secs_f64();
        Ok(texture)
    }

    /// Evaluates what the picture needs, and brings the list of it to the device; the faces that its numbers stand for.
    fn prepare(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        is_solid: bool,
        budget: Option<Duration>,
    ) -> Result<(Emission, Vec<Numbered>), RenderError> {
        let start = Instant::now();
        let evaluator = &Evaluator::on_gpu(&self.gpu, look.lod.backend());
        let mut look = *look;
        let wanted_px = look.screen_error_px;
        let (gpu, scene) = (&self.gpu, &self.scene);
        self.stage.evaluated = 0;
        let mut is_complete = true;
        let visible = loop {
            let shot = Shot { scene, camera, look: &look, size };
            let visible = shot.visible();
            let keys: Vec<PieceKey> = visible.iter().map(|v| v.key).collect();
            let is_coarser = look.screen_error_px > wanted_px;
            // What is not needed any more stands for what is not there yet.
            if is_coarser || (budget.is_none() && self.stage.used_bytes() > KEPT_BYTES) {
                let used: FxHashSet<PieceKey> = keys.iter().copied().collect();
                self.stage.forget(|key| used.contains(key));
            }
            let stage = &mut self.stage;
            let parcels = match budget {
                Some(_) => parcels(stage, &visible),
                None => vec![keys],
            };
            let mut done = Ok(());
            // The first one may have to wait for the picture before.
            let mut since = None;
            for parcel in parcels {
                is_complete = match (budget, since) {
                    (Some(budget), Some(since)) => Instant::elapsed(&since) <= budget,
                    _ => true,
                };
                if !is_complete {
                    break;
                }
                let evaluate = || stage.evaluate(gpu, evaluator, scene, parcel);
                done = gpu.scoped("evaluate the faces in the picture", evaluate);
                since = since.or(Some(Instant::now()));
                if done.is_err() {
                    break;
                }
            }
            match done {
                // A coarser picture is better than none.
                Err(GpuError::OutOfMemory { .. }) if look.screen_error_px < COARSEST * wanted_px => {
                    look.screen_error_px *= 2.0;
                }
                done => {
                    done?;
                    break visible;
                }
            }
        };
        if budget.is_some() && is_complete && self.stage.used_bytes() > KEPT_BYTES {
            let used: FxHashSet<PieceKey> = visible.iter().map(|v| v.key).collect();
            self.stage.forget(|key| used.contains(key));
        }
        let look = &look;
        self.statistics = FrameStatistics {
            is_complete,
            faces: visible.iter().filter(|v| v.key.tile == 0).count(),
            evaluated: self.stage.evaluated,
            evaluate_s: start.elapsed().as_secs_f64(),
            screen_error_px: look.screen_error_px,
            bytes: self.stage.bytes(),
            ..FrameStatistics::default()
        };
        let shot = Shot { scene: &self.scene, camera, look, size };
        let lists = shot.lists(&self.stage, &visible, is_solid);
        let emission =
            self.gpu.scoped("list the faces in the picture", || Emission::new(&self.gpu, &lists))?;
        Ok((emission, lists.faces))
    }

    /// Draws a tile and reads it back.
    fn tile(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        emission: &Emission,
        tile: &Tile,
    ) -> Result<Picture, RenderError> {
        let name = format!("draw {} x {} pixels", tile.size[0], tile.size[1]);
        let gpu = self.gpu.clone();
        let rgba =
            read_back(&gpu, &name, tile.size, 4, || self.encode(camera, size, look, emission, tile, None))?;
        Ok(Picture { width: tile.size[0], height: tile.size[1], rgba })
    }

    /// The work of a tile, and the texture that holds it.
    fn encode(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        emission: &Emission,
        tile: &Tile,
        clock: Option<&Clock>,
    ) -> Result<(wgpu::CommandEncoder, wgpu::Texture), GpuError> {
        let samples = if look.samples > 1 { 4 } else { 1 };
        let gpu = self.gpu.clone();
        let shot = Shot { scene: &self.scene, camera, look, size };
        let is_fit = |t: &Targets| t.size == tile.size && t.samples == samples;
        if !self.targets.as_ref().is_some_and(is_fit) {
            self.targets = Some(Targets::new(&gpu, tile.size, samples));
        }
        let bound = Bound::new(&gpu, &self.passes, &self.stage, &shot, emission, tile);
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let cells = self.stage.cells.buffer();
        self.emitter.encode(&gpu, &mut encoder, emission, cells, &shot.bounds(tile), clock);
        let Some(targets) = &self.targets else {
            return Err(GpuError::Request("there is nothing to draw into".to_owned()));
        };
        let timed = Timed { gpu: &gpu, clock };
        draw(timed, &mut encoder, &mut self.passes, targets, &bound, look, samples);
        compose(timed, &mut encoder, &mut self.passes, targets, &shot, tile);
        Ok((encoder, targets.picture.clone()))
    }
}

/// What of a picture is not evaluated yet, in parcels; what appears to be large comes first.
fn parcels(stage: &Stage, visible: &[Visible]) -> Vec<Vec<PieceKey>> {
    let mut missing: Vec<&Visible> = visible.iter().filter(|v| stage.piece(&v.key).is_none()).collect();
    missing.sort_by(|a, b| b.apparent().total_cmp(&a.apparent()));
    missing.chunks(PARCEL).map(|some| some.iter().map(|v| v.key).collect()).collect()
}

/// What trims the cells that are not whole.
fn trim_of(look: &Look) -> Trim {
    if look.lod.has_masks() { Trim::Masks } else { Trim::Curves }
}

pub(crate) fn check([width, height]: [u32; 2]) -> Result<(), RenderError> {
    let is_possible = |n: u32| (1..=MOST_PIXELS).contains(&n);
    if is_possible(width) && is_possible(height) { Ok(()) } else { Err(RenderError::Size(width, height)) }
}

/// How often a tile is drawn, with four samples each.
fn rounds(look: &Look) -> u32 {
    (look.samples / 4).clamp(1, 64)
}

fn tiles([width, height]: [u32; 2]) -> Vec<Tile> {
    let rows = (0..height).step_by(TILE as usize);
    let all = rows.flat_map(|row| (0..width).step_by(TILE as usize).map(move |column| (column, row)));
    all.map(|(column, row)| Tile {
        column,
        row,
        size: [TILE.min(width - column), TILE.min(height - row)],
        jitter: [0.0; 2],
    })
    .collect()
}

/// Places within a quarter of a pixel's sides, which four samples each make into those of the whole pixel.
fn jitter(round: u32, rounds: u32) -> [f64; 2] {
    if rounds == 1 {
        return [0.0; 2];
    }
    // Halton's sequence to the bases 2 and 3.
    let radical = |base: u32| {
        let (mut k, mut share, mut sum) = (round + 1, 1.0, 0.0);
        while k > 0 {
            share /= f64::from(base);
            sum += share * f64::from(k % base);
            k /= base;
        }
        sum
    };
    [radical(2) - 0.5, radical(3) - 0.5].map(|x| 0.5 * x)
}

fn decode(c: u8) -> f32 {
    let c = f32::from(c) / 255.0;
    if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// Adds a picture to sums of light, premultiplied.
fn accumulate(sums: &mut Vec<[f32; 4]>, own: &Picture) {
    sums.resize(own.rgba.len() / 4, [0.0; 4]);
    for (sum, p) in sums.iter_mut().zip(own.rgba.chunks_exact(4)) {
        let alpha = f32::from(p[3]) / 255.0;
        (0..3).for_each(|k| sum[k] += decode(p[k]) * alpha);
        sum[3] += alpha;
    }
}

fn averaged(sums: &[[f32; 4]], [width, height]: [u32; 2], rounds: u32) -> Picture {
    let pixel = |sum: &[f32; 4]| {
        let [r, g, b] = [sum[0], sum[1], sum[2]].map(|c| encode(c / sum[3].max(1e-6)));
        [r, g, b, (sum[3] / rounds as f32 * 255.0 + 0.5) as u8]
    };
    Picture { width, height, rgba: sums.iter().flat_map(pixel).collect() }
}

/// The bind groups of a tile, and what tells its draw calls how much to draw.
struct Bound<'a> {
    trims: wgpu::BindGroup,
    faces: wgpu::BindGroup,
    strips: wgpu::BindGroup,
    emission: &'a Emission,
}

impl<'a> Bound<'a> {
    fn new(
        gpu: &Gpu,
        passes: &Passes,
        stage: &Stage,
        shot: &Shot<'_>,
        emission: &'a Emission,
        tile: &Tile,
    ) -> Self {
        let device = gpu.device();
        let view = shot.view(tile);
        let view = gpu.filled("view", bytemuck::bytes_of(&view), 0, wgpu::BufferUsages::UNIFORM);
        let group = |layout: &wgpu::BindGroupLayout, buffers: &[&wgpu::Buffer]| {
            let entries: Vec<wgpu::BindGroupEntry<'_>> = (0u32..)
                .zip(buffers)
                .map(|(binding, b)| wgpu::BindGroupEntry { binding, resource: b.as_entire_binding() })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
        };
        let frame = |blocks: &wgpu::Buffer, vertices: &wgpu::Buffer| {
            group(&passes.frame, &[&view, &emission.items, blocks, vertices])
        };
        Self {
            trims: group(&passes.trims, &stage.trims.buffers()),
            faces: frame(&emission.blocks, stage.vertices.buffer()),
            strips: frame(&emission.strips, stage.segments.buffer()),
            emission,
        }
    }

    fn trims(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, &self.trims, &[]);
        pass.set_index_buffer(self.emission.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    fn faces(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        passes: &mut Passes,
        which: Pass,
        samples: u32,
        range: usize,
    ) {
        if let Some(offset) = self.emission.range(range) {
            pass.set_pipeline(&passes.get(gpu, which, samples));
            pass.set_bind_group(1, &self.faces, &[]);
            pass.draw_indexed_indirect(&self.emission.arguments, offset);
        }
    }

    fn strips(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        passes: &mut Passes,
        which: Pass,
        samples: u32,
        strips: Strips,
    ) {
        if let Some(offset) = self.emission.list(strips) {
            pass.set_pipeline(&passes.get(gpu, which, samples));
            pass.set_bind_group(1, &self.strips, &[]);
            pass.draw_indirect(&self.emission.arguments, offset);
        }
    }
}

/// A device, and the clock that notes what it does.
#[derive(Clone, Copy)]
struct Timed<'a> {
    gpu: &'a Gpu,
    clock: Option<&'a Clock>,
}

fn draw(
    Timed { gpu, clock }: Timed<'_>,
    encoder: &mut wgpu::CommandEncoder,
    passes: &mut Passes,
    targets: &Targets,
    bound: &Bound<'_>,
    look: &Look,
    samples: u32,
) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("solid"),
        color_attachments: &[targets.color.attachment([0.0; 4])],
        depth_stencil_attachment: Some(depth_attachment(&targets.depth, true)),
        timestamp_writes: clock.map(|clock| clock.of_render(1)),
        ..Default::default()
    });
    bound.trims(&mut pass);
    for (k, trim) in [(0, Trim::None), (1, trim_of(look))] {
        bound.faces(gpu, &mut pass, passes, Pass::Surface(trim), samples, k);
    }
    bound.strips(gpu, &mut pass, passes, Pass::Border, samples, Strips::Borders);
    let edges = [Pass::HiddenEdge, Pass::Edge];
    let drawn = match look.edges {
        EdgeStyle::None => &edges[..0],
        EdgeStyle::Visible => &edges[1..],
        EdgeStyle::Hidden => &edges[..],
    };
    for &which in drawn {
        bound.strips(gpu, &mut pass, passes, which, samples, Strips::Edges);
    }
    bound.strips(gpu, &mut pass, passes, Pass::Line, samples, Strips::Lines);
    drop(pass);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("transparent"),
        color_attachments: &[targets.sums.attachment([0.0; 4]), targets.through.attachment([1.0; 4])],
        depth_stencil_attachment: Some(depth_attachment(&targets.depth, false)),
        timestamp_writes: clock.map(|clock| clock.of_render(2)),
        ..Default::default()
    });
    bound.trims(&mut pass);
    for (k, trim) in [(2, Trim::None), (3, trim_of(look))] {
        bound.faces(gpu, &mut pass, passes, Pass::Veil(trim), samples, k);
    }
}

/// As in `shaders/compose.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Ground {
    top: [f32; 4],
    bottom: [f32; 4],
    above: f32,
    share: f32,
    size: [f32; 2],
}

fn compose(
    Timed { gpu, clock }: Timed<'_>,
    encoder: &mut wgpu::CommandEncoder,
    passes: &mut Passes,
    targets: &Targets,
    shot: &Shot<'_>,
    tile: &Tile,
) {
    let (top, bottom) = match shot.look.background {
        Background::Gradient(top, bottom) => (top, bottom),
        Background::Plain(color) => (color, color),
    };
    let whole = shot.size[1] as f32;
    let ground = Ground {
        top: linear(top),
        bottom: linear(bottom),
        above: tile.row as f32 / whole,
        share: tile.size[1] as f32 / whole,
        size: tile.size.map(|n| n as f32),
    };
    let buffer = gpu.filled("ground", bytemuck::bytes_of(&ground), 0, wgpu::BufferUsages::UNIFORM);
    let pipeline = passes.compose(gpu);
    let group = gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("compose"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
            read(1, &targets.color),
            read(2, &targets.sums),
            read(3, &targets.through),
        ],
    });
    let view = view_of(&targets.picture);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("compose"),
        color_attachments: &[attachment(&view, None, [0.0; 4])],
        timestamp_writes: clock.map(|clock| clock.of_render(3)),
        ..Default::default()
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.draw(0..3, 0..1);
}

fn read(binding: u32, target: &Target) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(target.read()) }
}

/// Adds the copy of a texture to a buffer, with so many bytes per row.
fn copy_rows(encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture, buffer: &wgpu::Buffer, row: u32) {
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    let to = wgpu::TexelCopyBufferInfo { buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, texture.size());
}

/// Does the work that `encode` adds, and reads its texture of `bytes` per texel, row by row.
fn read_back(
    gpu: &Gpu,
    name: &str,
    [width, height]: [u32; 2],
    bytes: u32,
    encode: impl FnOnce() -> Result<(wgpu::CommandEncoder, wgpu::Texture), GpuError>,
) -> Result<Vec<u8>, GpuError> {
    let row = width * bytes;
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let all = u64::from(padded) * u64::from(height);
    let copy = gpu.scoped(name, || {
        let (mut encoder, texture) = encode()?;
        let copy = gpu.reserve_for_copies("read back", all);
        copy_rows(&mut encoder, &texture, &copy, padded);
        gpu.queue().submit([encoder.finish()]);
        Ok(copy)
    })?;
    let found: Vec<u8> = gpu.download(name, &copy, all)?;
    Ok(found.chunks_exact(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect())
}
