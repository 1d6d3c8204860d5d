//! A scene on the device: what does not depend on the view, and the grids that were evaluated so far.

use glam::{DVec3, Vec4};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use trimloop_gpu::{Evaluator, Gpu, GpuError, Places, Quantities, Request, TrimHeader, TrimTable};

use crate::arena::Arena;
use crate::border::Segment;
use crate::grid::{Grid, Triangulated};
use crate::scene::{FaceKind, Scene, Triangles};
use crate::surface_face::SurfaceFace;

/// Vertices of a block; segments of a block.
pub(crate) const VERTICES: usize = 64;
pub(crate) const SEGMENTS: usize = 8;

/// A scene on the device.
#[derive(Debug)]
pub(crate) struct Stage {
    pub trims: Trims,
    /// Two vectors per vertex, in blocks.
    pub vertices: Arena<[Vec4; 2]>,
    /// Four vectors per segment, in blocks.
    pub segments: Arena<[Vec4; 4]>,
    /// By part and face.
    pub faces: Vec<Vec<StagedFace>>,
    /// By part: the free curves, relative to their middle.
    pub curves: Vec<Vec<StagedCurve>>,
    pieces: FxHashMap<PieceKey, Piece>,
    /// Points that were evaluated since the last time that somebody asked.
    pub evaluated: usize,
}

/// What does not depend on the view.
#[derive(Clone, Debug, Default)]
pub(crate) struct StagedFace {
    /// What positions are relative to.
    pub origin: DVec3,
    /// Number of its trim table.
    pub trim: u32,
    pub border: Strip,
    pub edges: Strip,
    /// The triangles of a face that is not evaluated.
    pub triangles: Option<Piece>,
}

/// A free curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StagedCurve {
    pub origin: DVec3,
    pub strip: Strip,
}

/// Blocks of segments.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Strip {
    pub first: u32,
    pub blocks: u32,
}

/// A face at a level of detail: within 2^level millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct PieceKey {
    pub part: u32,
    pub face: u32,
    pub level: i32,
}

/// Blocks of vertices and triangles over them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    pub first_vertex: u32,
    pub blocks: u32,
    pub triangles: Triangulated,
}

/// The trim tables of all faces, behind each other.
#[derive(Debug)]
pub(crate) struct Trims {
    headers: Arena<TrimHeader>,
    words: Arena<u32>,
    bands: Arena<u32>,
    entries: Arena<u32>,
    curves: Arena<Vec4>,
}

impl Trims {
    fn new(gpu: &Gpu) -> Self {
        let none = wgpu::BufferUsages::empty();
        Self {
            headers: Arena::new(gpu, "trim headers", none),
            words: Arena::new(gpu, "trim cells", none),
            bands: Arena::new(gpu, "trim bands", none),
            entries: Arena::new(gpu, "trim entries", none),
            curves: Arena::new(gpu, "trim curves", none),
        }
    }

    fn add(&mut self, gpu: &Gpu, table: &TrimTable) -> Result<u32, GpuError> {
        let header = TrimHeader {
            first_word: self.words.add(gpu, table.words())? as u32,
            first_band: self.bands.add(gpu, table.bands())? as u32,
            first_entry: self.entries.add(gpu, table.entries())? as u32,
            first_curve: (self.curves.add(gpu, table.curves())? / 2) as u32,
            ..table.header()
        };
        Ok(self.headers.add(gpu, &[header])? as u32)
    }

    pub fn buffers(&self) -> [&wgpu::Buffer; 5] {
        [
            self.headers.buffer(),
            self.words.buffer(),
            self.bands.buffer(),
            self.entries.buffer(),
            self.curves.buffer(),
        ]
    }

    fn bytes(&self) -> u64 {
        self.buffers().iter().map(|b| b.size()).sum()
    }
}

impl Stage {
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, GpuError> {
        let none = wgpu::BufferUsages::empty();
        let mut stage = Self {
            trims: Trims::new(gpu),
            vertices: Arena::new(gpu, "vertices", none),
            segments: Arena::new(gpu, "segments", none),
            faces: Vec::new(),
            curves: Vec::new(),
            pieces: FxHashMap::default(),
            evaluated: 0,
        };
        for part in &scene.parts {
            let mut faces = Vec::with_capacity(part.faces.len());
            for face in &part.faces {
                let mut staged = StagedFace { origin: face.sphere.0, ..StagedFace::default() };
                match &face.kind {
                    FaceKind::Surface(surface) => {
                        staged.origin = surface.shape.origin();
                        staged.trim = stage.trims.add(gpu, &surface.table)?;
                        staged.border = stage.add_strip(gpu, &face.border, staged.origin, Some(surface))?;
                    }
                    FaceKind::Triangles(triangles) => {
                        staged.origin = triangles.origin;
                        staged.triangles = Some(stage.add_triangles(gpu, triangles)?);
                    }
                    FaceKind::Empty | FaceKind::Lost(_) => {}
                }
                staged.edges = stage.add_strip(gpu, &face.edges, staged.origin, None)?;
                faces.push(staged);
            }
            stage.faces.push(faces);
            let mut curves = Vec::new();
            for (points, _) in &part.curves {
                let origin = points[points.len() / 2];
                let chords =
                    points.windows(2).map(|pair| Segment { a: pair[0], b: pair[1], uv: Default::default() });
                let chords: Vec<Segment> = chords.collect();
                curves.push(StagedCurve { origin, strip: stage.add_strip(gpu, &chords, origin, None)? });
            }
            stage.curves.push(curves);
        }
        Ok(stage)
    }

    /// Bytes that the device holds for the scene.
    pub fn bytes(&self) -> u64 {
        self.trims.bytes() + self.vertices.bytes() + self.segments.bytes()
    }

    fn add_strip(
        &mut self,
        gpu: &Gpu,
        segments: &[Segment],
        origin: DVec3,
        surface: Option<&SurfaceFace>,
    ) -> Result<Strip, GpuError> {
        if segments.is_empty() {
            return Ok(Strip::default());
        }
        let end = |p: DVec3, u: f64| (p - origin).as_vec3().extend(u as f32);
        let normal = |uv: glam::DVec2| {
            let found = surface.map_or(DVec3::ZERO, |s| s.shape.normal(s.parameters(uv)));
            found.as_vec3().extend(uv.y as f32)
        };
        let packed = |s: &Segment| {
            let [a, b] = s.uv;
            [end(s.a, a.x), end(s.b, b.x), normal(a), normal(b)]
        };
        let mut packed: Vec<[Vec4; 4]> = segments.iter().map(packed).collect();
        // What fills a block is no longer than a point.
        let last = packed[packed.len() - 1];
        packed.resize(packed.len().next_multiple_of(SEGMENTS), [last[1], last[1], last[3], last[3]]);
        let first = self.segments.add(gpu, &packed)? as u32;
        Ok(Strip { first, blocks: (packed.len() / SEGMENTS) as u32 })
    }

    fn add_triangles(&mut self, gpu: &Gpu, own: &Triangles) -> Result<Piece, GpuError> {
        let vertices = own.positions.iter().zip(&own.normals);
        let mut packed: Vec<[Vec4; 2]> =
            vertices.map(|(p, n)| [p.as_vec3().extend(0.0), n.as_vec3().extend(0.0)]).collect();
        packed.resize(packed.len().next_multiple_of(VERTICES), [Vec4::ZERO; 2]);
        let first = self.vertices.add(gpu, &packed)? as u32;
        let whole = own.triangles.iter().flatten().copied().collect();
        let blocks = (packed.len() / VERTICES) as u32;
        Ok(Piece { first_vertex: first, blocks, triangles: Triangulated { whole, part: Vec::new() } })
    }

    /// A face at a level, once it is evaluated.
    pub fn piece(&self, key: &PieceKey) -> Option<&Piece> {
        self.pieces.get(key)
    }

    /// Evaluates what of `wanted` is not there yet.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn evaluate(
        &mut self,
        gpu: &Gpu,
        evaluator: &Evaluator,
        scene: &Scene,
        mut wanted: Vec<PieceKey>,
    ) -> Result<(), GpuError> {
        wanted.retain(|key| !self.pieces.contains_key(key));
        wanted.sort_unstable_by_key(|key| (key.part, key.face, key.level));
        wanted.dedup();
        let made: Vec<(PieceKey, &SurfaceFace, Grid, Triangulated)> = wanted
            .into_par_iter()
            .filter_map(|key| {
                let face = &scene.parts[key.part as usize].faces[key.face as usize];
                let FaceKind::Surface(surface) = &face.kind else { return None };
                let grid = Grid::new(surface, f64::from(key.level).exp2());
                let triangles = grid.triangulate(surface);
                Some((key, &**surface, grid, triangles))
            })
            .collect();
        if made.is_empty() {
            return Ok(());
        }
        let requests: Vec<Request<'_>> = made
            .iter()
            .map(|(_, face, grid, _)| {
                let domain = face.shape.domain();
                let [us, vs] = [0, 1].map(|d| grid.lines[d].iter().map(|s| domain[d].at(*s)).collect());
                Request { shape: &face.shape, places: Places::Grid { us, vs } }
            })
            .collect();
        let values = evaluator.evaluate_on_device(&requests, Quantities::Normals)?;
        let mut firsts = Vec::with_capacity(made.len());
        for (_, _, grid, _) in &made {
            firsts.push(self.vertices.take(gpu, grid.len().next_multiple_of(VERTICES))?);
            self.evaluated += grid.len();
        }
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let stride = size_of::<[Vec4; 2]>() as u64;
        for batch in values.batches() {
            for piece in &batch.pieces {
                let columns = made[piece.request].2.lines[1].len();
                let to = firsts[piece.request] + piece.first * columns;
                encoder.copy_buffer_to_buffer(
                    &batch.buffer,
                    piece.offset as u64 * stride,
                    self.vertices.buffer(),
                    to as u64 * stride,
                    piece.points as u64 * stride,
                );
            }
        }
        gpu.queue().submit([encoder.finish()]);
        for ((key, _, grid, triangles), first) in made.into_iter().zip(firsts) {
            let blocks = grid.len().div_ceil(VERTICES) as u32;
            self.pieces.insert(key, Piece { first_vertex: first as u32, blocks, triangles });
        }
        Ok(())
    }

    /// Gives back the room of the pieces that `is_used` does not know.
    pub fn forget(&mut self, is_used: impl Fn(&PieceKey) -> bool) {
        let unused: Vec<PieceKey> = self.pieces.keys().filter(|key| !is_used(key)).copied().collect();
        for key in unused {
            if let Some(piece) = self.pieces.remove(&key) {
                self.vertices.give_back(piece.first_vertex as usize, piece.blocks as usize * VERTICES);
            }
        }
    }
}
