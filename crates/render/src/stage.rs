//! A scene on the device: what does not depend on the view, and the grids that were evaluated so far.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec4};
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_gpu::{
    CHANNELS, DevicePyramid, Evaluator, Gpu, GpuError, PatchGrid, PatchRequest, PatchTree, Places,
    Quantities, Request, TrimFans, TrimHeader, TrimTable, Wavelet, evaluate_patches, trim_masks,
};
use trimloop_trim::curves::Cubic;

use crate::arena::{Arena, Mark};
use crate::border::{EdgeCurve, Segment, border_of, segments_of};
use crate::grid::{Cells, Grid, LONGEST, MOST_CELLS};
use crate::hierarchy::{APPROXIMATION, Hierarchy};
use crate::lod::Lod;
use crate::scene::{FaceKind, Scene, SceneFace, ScenePart, Triangles};
use crate::skirt::ribbon_of;
use crate::surface_face::SurfaceFace;

/// Chords of boundaries and edges may be off by this share of what faces may.
const STRIPS: f64 = 0.5;

/// Trim curves of hierarchies, and their chords, may be off by this share.
const TRIMS: f64 = 0.25;
/// Doublings and halvings of what a piece may be off, within which it stands for one that is not there yet.
const FARTHEST: i32 = 10;
/// Pieces of a patch's side, each of which is drawn or not.
const SIDE_PIECES: u32 = 16;

/// Texels of a trim texture along a direction; 32 of them fill a word.
const MOST_TEXELS: u32 = 4096;
const FEWEST_TEXELS: u32 = 32;

/// Vertices of a block; segments of a block.
pub(crate) const VERTICES: usize = 16;
pub(crate) const SEGMENTS: usize = 8;

/// A scene on the device.
#[derive(Debug)]
pub(crate) struct Stage {
    pub trims: Trims,
    /// Two vectors per vertex, in blocks.
    pub vertices: Arena<[Vec4; 2]>,
    /// Four vectors per segment, in blocks.
    pub segments: Arena<[Vec4; 4]>,
    /// Numbers of cells.
    pub cells: Arena<u32>,
    /// By part and face.
    pub faces: Vec<Vec<StagedFace>>,
    /// By part: the free curves, relative to their middle.
    pub curves: Vec<Vec<StagedCurve>>,
    pieces: FxHashMap<PieceKey, Piece>,
    /// By part, face and strategy.
    pyramids: FxHashMap<(u32, u32, Lod), Leveled>,
    /// Trim tables by part, face and tile.
    tables: FxHashMap<(u32, u32, u64), TableRoom>,
    /// Points that were evaluated since the last time that somebody asked.
    pub evaluated: usize,
}

/// What does not depend on the view.
#[derive(Clone, Debug, Default)]
pub(crate) struct StagedFace {
    /// What positions are relative to.
    pub origin: DVec3,
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

/// Numbers of cells: those inside, then those that are trimmed (see `Cells`).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CellList {
    pub columns: u32,
    pub first: u32,
    pub whole: u32,
    pub part: u32,
}

/// A face at a level of detail: within 2^level millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct PieceKey {
    pub part: u32,
    pub face: u32,
    /// The part of the face (see `SurfaceFace::tile`); 0 for its edges. In a hierarchy 1 for the boundary and the trim
    /// texture, then a number per patch.
    pub tile: u64,
    pub level: i32,
    pub lod: Lod,
}

impl PieceKey {
    /// The whole of a face.
    pub const WHOLE: u64 = 1;
    const PATCHES: u64 = 2;
    const SKIRT: u64 = 1 << 63;

    /// The skirt of the part of a face that it stands for.
    pub fn skirt(self) -> Self {
        Self { tile: self.tile | Self::SKIRT, ..self }
    }

    pub fn is_skirt(&self) -> bool {
        self.tile & Self::SKIRT != 0
    }

    /// The part of the face that shares in it are of.
    pub fn part_of_face(&self) -> u64 {
        if self.lod == Lod::BezierHierarchy { Self::WHOLE } else { self.tile & !Self::SKIRT }
    }

    /// The number of a patch of a hierarchy.
    pub fn patch(node: usize) -> u64 {
        Self::PATCHES + node as u64
    }

    /// The patch of a hierarchy, if it is one.
    fn node(&self) -> Option<usize> {
        self.is_patch().then(|| (self.tile - Self::PATCHES) as usize)
    }

    pub fn is_patch(&self) -> bool {
        self.lod == Lod::BezierHierarchy && self.tile >= Self::PATCHES && !self.is_skirt()
    }

    /// How far off the piece may be.
    fn off_mm(&self) -> f64 {
        f64::from(self.level).exp2()
    }
}

/// A finest grid with its coarser levels.
#[derive(Debug)]
struct Leveled {
    pyramid: DevicePyramid,
    /// Doublings of each direction of the finest grid.
    doublings: [u32; 2],
    /// What that is fine enough for.
    level: i32,
}

/// Blocks of vertices and triangles over them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    /// What positions are relative to.
    pub origin: DVec3,
    /// Number of its trim table, or first word of its mask.
    pub trim: u32,
    /// Texels of its mask along u, and along v in the upper half; 0 where curves trim it.
    pub mask: u32,
    pub first_vertex: u32,
    pub blocks: u32,
    pub cells: CellList,
    /// Its boundary; of edges, the edges.
    pub strip: Strip,
}

/// What a piece is made of, before it goes to the device.
struct Draft<'a> {
    key: PieceKey,
    origin: DVec3,
    face: Option<&'a SurfaceFace>,
    /// What is evaluated at which shares of the domain.
    grid: Option<Grid>,
    cells: Cells,
    strip: Vec<[Vec4; 4]>,
    /// Vertices that are not evaluated on the device.
    vertices: Vec<[Vec4; 2]>,
}

/// Where a trim table lies: its number, and first elements and lengths of what it is made of.
#[derive(Clone, Copy, Debug)]
struct TableRoom {
    header: u32,
    words: (usize, usize),
    bands: (usize, usize),
    entries: (usize, usize),
    curves: (usize, usize),
}

/// The trim tables of all faces, behind each other.
#[derive(Debug)]
pub(crate) struct Trims {
    headers: Arena<TrimHeader>,
    words: Arena<u32>,
    bands: Arena<u32>,
    entries: Arena<u32>,
    curves: Arena<Vec4>,
    masks: Arena<u32>,
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
            masks: Arena::new(gpu, "trim textures", none),
        }
    }

    fn add(&mut self, gpu: &Gpu, table: &TrimTable) -> Result<TableRoom, GpuError> {
        let words = (self.words.add(gpu, table.words())?, table.words().len());
        let bands = (self.bands.add(gpu, table.bands())?, table.bands().len());
        let entries = (self.entries.add(gpu, table.entries())?, table.entries().len());
        let curves = (self.curves.add(gpu, table.curves())?, table.curves().len());
        let header = TrimHeader {
            first_word: words.0 as u32,
            first_band: bands.0 as u32,
            first_entry: entries.0 as u32,
            first_curve: (curves.0 / 2) as u32,
            ..table.header()
        };
        let header = self.headers.add(gpu, &[header])? as u32;
        Ok(TableRoom { header, words, bands, entries, curves })
    }

    fn give_back(&mut self, room: &TableRoom) {
        self.headers.give_back(room.header as usize, 1);
        self.words.give_back(room.words.0, room.words.1);
        self.bands.give_back(room.bands.0, room.bands.1);
        self.entries.give_back(room.entries.0, room.entries.1);
        self.curves.give_back(room.curves.0, room.curves.1);
    }

    pub fn buffers(&self) -> [&wgpu::Buffer; 6] {
        [
            self.headers.buffer(),
            self.words.buffer(),
            self.bands.buffer(),
            self.entries.buffer(),
            self.curves.buffer(),
            self.masks.buffer(),
        ]
    }

    fn bytes(&self) -> u64 {
        self.buffers().iter().map(|b| b.size()).sum()
    }

    /// That of headers first.
    fn marks(&self) -> [Mark; 6] {
        [
            self.headers.mark(),
            self.words.mark(),
            self.bands.mark(),
            self.entries.mark(),
            self.curves.mark(),
            self.masks.mark(),
        ]
    }

    fn restore(&mut self, [headers, words, bands, entries, curves, masks]: [Mark; 6]) {
        self.headers.restore(headers);
        self.words.restore(words);
        self.bands.restore(bands);
        self.entries.restore(entries);
        self.curves.restore(curves);
        self.masks.restore(masks);
    }
}

impl Stage {
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, GpuError> {
        let none = wgpu::BufferUsages::empty();
        let mut stage = Self {
            trims: Trims::new(gpu),
            vertices: Arena::new(gpu, "vertices", none),
            segments: Arena::new(gpu, "segments", none),
            cells: Arena::new(gpu, "cells", none),
            faces: Vec::new(),
            curves: Vec::new(),
            pieces: FxHashMap::default(),
            pyramids: FxHashMap::default(),
            tables: FxHashMap::default(),
            evaluated: 0,
        };
        for (index, part) in scene.parts.iter().enumerate() {
            stage.set_part(gpu, index, part)?;
        }
        Ok(stage)
    }

    /// Brings a part to the device, in the place of the one with that index.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn set_part(&mut self, gpu: &Gpu, index: usize, part: &ScenePart) -> Result<(), GpuError> {
        self.clear_part(index);
        let mut faces = Vec::with_capacity(part.faces.len());
        for face in &part.faces {
            let mut staged = StagedFace { origin: face.sphere.0, ..StagedFace::default() };
            match &face.kind {
                FaceKind::Surface(surface) => {
                    staged.origin = surface.shape.origin();
                }
                FaceKind::Triangles(triangles) => {
                    staged.origin = triangles.origin;
                    staged.triangles = Some(self.add_triangles(gpu, triangles)?);
                }
                FaceKind::Empty | FaceKind::Lost(_) => {}
            }
            faces.push(staged);
        }
        self.faces[index] = faces;
        for (points, _) in &part.curves {
            let origin = points[points.len() / 2];
            let packed = packed(&chords(points), origin, None);
            let curve = StagedCurve { origin, strip: self.add_strip(gpu, &packed)? };
            self.curves[index].push(curve);
        }
        Ok(())
    }

    /// Gives back all that the device holds of a part.
    fn clear_part(&mut self, index: usize) {
        let count = self.faces.len().max(index + 1);
        self.faces.resize_with(count, Vec::new);
        self.curves.resize_with(count, Vec::new);
        self.forget(|key| key.part as usize != index);
        for curve in std::mem::take(&mut self.curves[index]) {
            self.segments.give_back(curve.strip.first as usize, curve.strip.blocks as usize * SEGMENTS);
        }
        for triangles in std::mem::take(&mut self.faces[index]).into_iter().filter_map(|f| f.triangles) {
            self.give_back(&triangles);
        }
        self.pyramids.retain(|(part, ..), _| *part as usize != index);
        let is_own = |(part, ..): &(u32, u32, u64)| *part as usize == index;
        let own: Vec<(u32, u32, u64)> = self.tables.keys().copied().filter(is_own).collect();
        for table in own.iter().filter_map(|key| self.tables.remove(key)).collect::<Vec<_>>() {
            self.trims.give_back(&table);
        }
    }

    /// Bytes that the device holds for the scene.
    pub fn bytes(&self) -> u64 {
        self.trims.bytes() + self.vertices.bytes() + self.segments.bytes() + self.cells.bytes()
    }

    /// Bytes of what depends on the view.
    pub fn used_bytes(&self) -> u64 {
        self.trims.masks.used_bytes()
            + self.vertices.used_bytes()
            + self.segments.used_bytes()
            + self.cells.used_bytes()
    }

    fn add_strip(&mut self, gpu: &Gpu, packed: &[[Vec4; 4]]) -> Result<Strip, GpuError> {
        if packed.is_empty() {
            return Ok(Strip::default());
        }
        let first = self.segments.add(gpu, packed)? as u32;
        Ok(Strip { first, blocks: (packed.len() / SEGMENTS) as u32 })
    }

    fn add_cells(&mut self, gpu: &Gpu, cells: &Cells) -> Result<CellList, GpuError> {
        let first = self.cells.take(gpu, cells.whole.len() + cells.part.len())?;
        self.cells.write(gpu, first, &cells.whole);
        self.cells.write(gpu, first + cells.whole.len(), &cells.part);
        let [whole, part] = [&cells.whole, &cells.part].map(|list| list.len() as u32);
        Ok(CellList { columns: cells.columns, first: first as u32, whole, part })
    }

    fn add_triangles(&mut self, gpu: &Gpu, own: &Triangles) -> Result<Piece, GpuError> {
        let vertices = own.positions.iter().zip(&own.normals);
        let mut packed: Vec<[Vec4; 2]> =
            vertices.map(|(p, n)| [p.as_vec3().extend(0.0), n.as_vec3().extend(0.0)]).collect();
        packed.resize(packed.len().next_multiple_of(VERTICES), [Vec4::ZERO; 2]);
        let first = self.vertices.add(gpu, &packed)? as u32;
        let whole = own.triangles.iter().flatten().copied().collect();
        let blocks = (packed.len() / VERTICES) as u32;
        let cells = self.add_cells(gpu, &Cells { whole, ..Cells::default() })?;
        Ok(Piece { first_vertex: first, blocks, cells, ..Piece::default() })
    }

    /// A face at a level, once it is evaluated.
    pub fn piece(&self, key: &PieceKey) -> Option<&Piece> {
        self.pieces.get(key)
    }

    /// A face at the level that is nearest to one that is not there.
    pub fn near(&self, key: &PieceKey) -> Option<&Piece> {
        let at = |off: i32| self.pieces.get(&PieceKey { level: key.level + off, ..*key });
        (1..=FARTHEST).find_map(|off| at(off).or_else(|| at(-off)))
    }

    /// Evaluates what of `wanted` is not there yet, all of it or nothing.
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
        wanted.sort_unstable_by_key(|key| (key.part, key.face, key.tile, key.level));
        wanted.dedup();
        let known: FxHashSet<(u32, u32, u64)> = self.tables.keys().copied().collect();
        let before = (self.trims.marks(), self.vertices.mark(), self.segments.mark(), self.cells.mark());
        let done = self.evaluate_all(gpu, evaluator, scene, wanted.clone());
        if done.is_err() {
            let (trims, vertices, segments, cells) = before;
            wanted.iter().for_each(|key| _ = self.pieces.remove(key));
            self.tables.retain(|tile, _| known.contains(tile));
            self.trims.restore(trims);
            self.vertices.restore(vertices);
            self.segments.restore(segments);
            self.cells.restore(cells);
        }
        done
    }

    fn evaluate_all(
        &mut self,
        gpu: &Gpu,
        evaluator: &Evaluator,
        scene: &Scene,
        wanted: Vec<PieceKey>,
    ) -> Result<(), GpuError> {
        let (leveled, wanted): (Vec<PieceKey>, Vec<PieceKey>) = wanted
            .into_iter()
            .partition(|key| key.tile > 0 && !key.is_skirt() && key.lod.wavelet().is_some());
        self.step_levels(gpu, evaluator, scene, &leveled)?;
        let staged = &self.faces;
        let drafts: Vec<Draft<'_>> = wanted
            .into_par_iter()
            .filter_map(|key| {
                let face = &scene.parts[key.part as usize].faces[key.face as usize];
                Draft::new(key, face, staged[key.part as usize][key.face as usize].origin)
            })
            .collect();
        let grids: Vec<(usize, &SurfaceFace, &Grid)> = drafts
            .iter()
            .enumerate()
            .filter(|(_, draft)| !draft.key.is_patch())
            .filter_map(|(k, draft)| Some((k, draft.face?, draft.grid.as_ref()?)))
            .collect();
        let request = |&(_, face, grid): &(usize, &'_ SurfaceFace, &Grid)| {
            let domain = face.shape.domain();
            [0, 1].map(|d| grid.lines[d].iter().map(|s| domain[d].at(*s)).collect::<Vec<f64>>())
        };
        let requests: Vec<Request<'_>> = grids
            .iter()
            .map(|one| {
                let [us, vs] = request(one);
                Request { shape: &one.1.shape, places: Places::Grid { us, vs } }
            })
            .collect();
        let mut firsts = vec![0; drafts.len()];
        for (first, draft) in firsts.iter_mut().zip(&drafts) {
            if !draft.vertices.is_empty() {
                *first = self.vertices.add(gpu, &draft.vertices)?;
            }
            if let Some(grid) = &draft.grid {
                *first = self.vertices.take(gpu, grid.len().next_multiple_of(VERTICES))?;
                self.evaluated += grid.len();
            }
        }
        if !requests.is_empty() {
            let values = evaluator.evaluate_on_device(&requests, Quantities::Normals)?;
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            let stride = size_of::<[Vec4; 2]>() as u64;
            for batch in values.batches() {
                for piece in &batch.pieces {
                    let (k, _, grid) = grids[piece.request];
                    let to = firsts[k] + piece.first * grid.lines[1].len();
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
        }
        self.evaluate_patches(gpu, &drafts, &firsts)?;
        let mut masks = self.masks(gpu, &drafts)?;
        for (draft, first) in drafts.into_iter().zip(firsts) {
            let strip = self.add_strip(gpu, &draft.strip)?;
            let cells = self.add_cells(gpu, &draft.cells)?;
            let Draft { key, origin, face, grid, .. } = draft;
            let blocks = grid.as_ref().map_or(draft.vertices.len(), Grid::len).div_ceil(VERTICES) as u32;
            let (trim, mask) = match (face, masks.remove(&key)) {
                (_, Some(mask)) => mask,
                (Some(face), None) if !key.lod.has_masks() && !key.is_skirt() => {
                    (self.table(gpu, &key, face)?, 0)
                }
                _ => (0, 0),
            };
            let piece = Piece { origin, trim, mask, first_vertex: first as u32, blocks, cells, strip };
            self.pieces.insert(key, piece);
        }
        Ok(())
    }

    /// The number of a face's trim table.
    fn table(&mut self, gpu: &Gpu, key: &PieceKey, face: &SurfaceFace) -> Result<u32, GpuError> {
        let tile = (key.part, key.face, key.tile);
        if let Some(table) = self.tables.get(&tile) {
            return Ok(table.header);
        }
        let table = self.trims.add(gpu, &face.table)?;
        self.tables.insert(tile, table);
        Ok(table.header)
    }

    /// Pieces from pyramids: a finest grid is evaluated where there is none that is fine enough, others are steps from it.
    fn step_levels(
        &mut self,
        gpu: &Gpu,
        evaluator: &Evaluator,
        scene: &Scene,
        wanted: &[PieceKey],
    ) -> Result<(), GpuError> {
        let surface = |key: &PieceKey| match &scene.parts[key.part as usize].faces[key.face as usize].kind {
            FaceKind::Surface(surface) => Some(&**surface),
            _ => None,
        };
        let mut finest: BTreeMap<(u32, u32), PieceKey> = BTreeMap::new();
        for key in wanted {
            let there = self.pyramids.get(&(key.part, key.face, key.lod));
            if there.is_none_or(|leveled| leveled.level > key.level) {
                let own = finest.entry((key.part, key.face)).or_insert(*key);
                own.level = own.level.min(key.level);
            }
        }
        let bases: Vec<(PieceKey, &SurfaceFace, Wavelet, [u32; 2])> = finest
            .into_values()
            .filter_map(|key| {
                let face = surface(&key)?;
                // Two points at least, so that Haar has something to average.
                let doublings = Grid::doublings(face, key.off_mm()).map(|n| n.max(1));
                Some((key, face, key.lod.wavelet()?, doublings))
            })
            .collect();
        let requests: Vec<Request<'_>> = bases
            .iter()
            .map(|(_, face, wavelet, doublings)| {
                let domain = face.shape.domain();
                let lines = Grid::level(*wavelet, *doublings, 0).lines;
                let [us, vs] = [0, 1].map(|d| lines[d].iter().map(|s| domain[d].at(*s)).collect());
                Request { shape: &face.shape, places: Places::Grid { us, vs } }
            })
            .collect();
        if !requests.is_empty() {
            let values = evaluator.evaluate_on_device(&requests, Quantities::Normals)?;
            for batch in values.batches() {
                for piece in batch.pieces.iter().filter(|piece| piece.first == 0) {
                    let (key, _, wavelet, doublings) = bases[piece.request];
                    let size = Grid::level(wavelet, doublings, 0).lines.map(|lines| lines.len());
                    let offset = (piece.offset * size_of::<[Vec4; 2]>()) as u64;
                    let pyramid = DevicePyramid::of_values(gpu, wavelet, size, 2, &batch.buffer, offset)?;
                    self.evaluated += size[0] * size[1];
                    let leveled = Leveled { pyramid, doublings, level: key.level };
                    self.pyramids.insert((key.part, key.face, key.lod), leveled);
                }
            }
        }
        for key in wanted {
            let (Some(face), Some(wavelet)) = (surface(key), key.lod.wavelet()) else { continue };
            let leveled = self.pyramids.get_mut(&(key.part, key.face, key.lod));
            let Some(Leveled { pyramid, doublings, .. }) = leveled else { continue };
            let needed = Grid::doublings(face, key.off_mm());
            let fewest = u32::from(wavelet == Wavelet::Haar);
            let steps = (0..2).map(|d| doublings[d].saturating_sub(needed[d].max(fewest))).min().unwrap_or(0);
            while pyramid.level() != steps {
                let before = pyramid.level();
                pyramid.step(before < steps)?;
                if pyramid.level() == before {
                    break;
                }
            }
            let grid = Grid::level(wavelet, *doublings, pyramid.level());
            let stride = size_of::<[Vec4; 2]>() as u64;
            let [rows, columns] = pyramid.size();
            let across = pyramid.finest()[1];
            let from = pyramid.buffer().clone();
            let first = self.vertices.take(gpu, grid.len().next_multiple_of(VERTICES))?;
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            for row in 0..rows {
                encoder.copy_buffer_to_buffer(
                    &from,
                    (row * across) as u64 * stride,
                    self.vertices.buffer(),
                    (first + row * columns) as u64 * stride,
                    columns as u64 * stride,
                );
            }
            gpu.queue().submit([encoder.finish()]);
            let origin = face.shape.origin();
            let packed = packed(&border_of(face, STRIPS * key.off_mm()), origin, Some(face));
            let piece = Piece {
                origin,
                trim: self.table(gpu, key, face)?,
                mask: 0,
                first_vertex: first as u32,
                blocks: grid.len().div_ceil(VERTICES) as u32,
                cells: self.add_cells(gpu, &grid.cells(face))?,
                strip: self.add_strip(gpu, &packed)?,
            };
            self.pieces.insert(*key, piece);
        }
        Ok(())
    }

    /// Evaluates the patches of hierarchies among `drafts` to where `firsts` says.
    fn evaluate_patches(&self, gpu: &Gpu, drafts: &[Draft<'_>], firsts: &[usize]) -> Result<(), GpuError> {
        // Patches of one face follow each other: its tree is locked once.
        let mut grids: Vec<(&SurfaceFace, Vec<(usize, &Draft<'_>)>)> = Vec::new();
        for (k, draft) in drafts.iter().enumerate().filter(|(_, draft)| draft.key.is_patch()) {
            let Some(face) = draft.face else { continue };
            match grids.last_mut() {
                Some((last, own)) if std::ptr::eq(*last, face) => own.push((k, draft)),
                _ => grids.push((face, vec![(k, draft)])),
            }
        }
        let requests: Vec<PatchRequest> = grids
            .into_par_iter()
            .filter_map(|(face, own)| Some((face, face.hierarchy()?, own)))
            .flat_map_iter(|(face, hierarchy, own)| {
                hierarchy.with_tree(|tree| {
                    let request = |(k, draft): (usize, &Draft<'_>)| {
                        let grid = draft.patch_grid(face, tree)?;
                        Some(grid.request(draft.origin, firsts[k]))
                    };
                    own.into_iter().filter_map(request).collect::<Vec<_>>()
                })
            })
            .collect();
        evaluate_patches(gpu, &requests, self.vertices.buffer())
    }

    /// Trim textures of what is trimmed by them: the first word and the size, by piece.
    fn masks(
        &mut self,
        gpu: &Gpu,
        drafts: &[Draft<'_>],
    ) -> Result<FxHashMap<PieceKey, (u32, u32)>, GpuError> {
        let mut by_size: BTreeMap<[u32; 2], Vec<(PieceKey, TrimFans)>> = BTreeMap::new();
        for draft in drafts.iter().filter(|d| d.key.lod.has_masks() && !d.key.is_patch() && !d.key.is_skirt())
        {
            let Some(face) = draft.face.filter(|face| !face.is_whole()) else { continue };
            let texels = 0.5 / draft.key.off_mm();
            let side = |d: usize| {
                TrimFans::side(face.bounds.lengths[d], texels, MOST_TEXELS)
                    .next_power_of_two()
                    .max(FEWEST_TEXELS)
            };
            by_size.entry([side(0), side(1)]).or_default().push((draft.key, fans(&draft.key, face)));
        }
        let mut out = FxHashMap::default();
        for ([columns, rows], faces) in by_size {
            for four in faces.chunks(CHANNELS) {
                let (firsts, [columns, rows]) = self.room_for_masks(gpu, four.len(), [columns, rows])?;
                let fans: Vec<TrimFans> = four.iter().map(|(_, fans)| fans.clone()).collect();
                trim_masks(gpu, &fans, [columns, rows], &firsts, self.trims.masks.buffer())?;
                out.extend(
                    four.iter().zip(firsts).map(|((key, _), first)| (*key, (first, columns | rows << 16))),
                );
            }
        }
        Ok(out)
    }

    /// Room for so many masks, coarser ones than wanted where there is not enough: the first word of each, and their size.
    fn room_for_masks(
        &mut self,
        gpu: &Gpu,
        count: usize,
        mut size: [u32; 2],
    ) -> Result<(Vec<u32>, [u32; 2]), GpuError> {
        loop {
            let words = size[0] as usize / 32 * size[1] as usize;
            match self.trims.masks.take(gpu, words * count) {
                Ok(first) => return Ok(((0..count).map(|k| (first + k * words) as u32).collect(), size)),
                Err(error) if size == [FEWEST_TEXELS; 2] => return Err(error),
                Err(_) => size = size.map(|n| (n / 2).max(FEWEST_TEXELS)),
            }
        }
    }

    /// Gives back the room of the pieces that `is_used` does not know.
    pub fn forget(&mut self, is_used: impl Fn(&PieceKey) -> bool) {
        let unused: Vec<PieceKey> = self.pieces.keys().filter(|key| !is_used(key)).copied().collect();
        for key in unused {
            if let Some(piece) = self.pieces.remove(&key) {
                let texels = (piece.mask & 0xffff) as usize * (piece.mask >> 16) as usize;
                if texels > 0 {
                    self.trims.masks.give_back(piece.trim as usize, texels / 32);
                }
                self.give_back(&piece);
            }
        }
    }

    /// Gives back the room of a piece, but for its mask or table.
    fn give_back(&mut self, piece: &Piece) {
        self.vertices.give_back(piece.first_vertex as usize, piece.blocks as usize * VERTICES);
        self.cells.give_back(piece.cells.first as usize, (piece.cells.whole + piece.cells.part) as usize);
        self.segments.give_back(piece.strip.first as usize, piece.strip.blocks as usize * SEGMENTS);
    }
}

impl<'a> Draft<'a> {
    fn new(key: PieceKey, face: &'a SceneFace, origin: DVec3) -> Option<Self> {
        let off_mm = key.off_mm();
        if key.tile == 0 {
            let edge = |edge: &EdgeCurve| chords(&edge.sample(STRIPS * off_mm));
            let edges: Vec<Segment> = face.edges.iter().flat_map(edge).collect();
            let strip = packed(&edges, origin, None);
            return Some(Self { origin, strip, ..Self::empty(key) });
        }
        let FaceKind::Surface(whole) = &face.kind else { return None };
        if key.is_skirt() {
            return Some(Self::of_skirt(key, whole.tile(key.part_of_face())?));
        }
        if let (Lod::BezierHierarchy, Some(hierarchy)) = (key.lod, whole.hierarchy()) {
            return Some(Self::of_hierarchy(key, whole, hierarchy));
        }
        let surface = whole.tile(key.tile)?;
        let origin = surface.shape.origin();
        let grid = match key.lod {
            Lod::Adaptive => Grid::new(surface, off_mm),
            _ => Grid::even(surface, off_mm),
        };
        let cells = grid.cells(surface);
        let strip = packed(&border_of(surface, STRIPS * off_mm), origin, Some(surface));
        Some(Self { origin, face: Some(surface), grid: Some(grid), cells, strip, ..Self::empty(key) })
    }

    fn empty(key: PieceKey) -> Self {
        Self {
            key,
            origin: DVec3::ZERO,
            face: None,
            grid: None,
            cells: Cells::default(),
            strip: Vec::new(),
            vertices: Vec::new(),
        }
    }

    /// What closes the gap between a face and its edges.
    fn of_skirt(key: PieceKey, face: &'a SurfaceFace) -> Self {
        let origin = face.shape.origin();
        let ribbon = ribbon_of(face, STRIPS * key.off_mm());
        let vertex = |(p, uv): &(DVec3, DVec2)| {
            let share = face.share(*uv).as_vec2();
            [(*p - origin).as_vec3().extend(share.x), face.shape.normal(*uv).as_vec3().extend(share.y)]
        };
        let mut vertices: Vec<[Vec4; 2]> = ribbon.places.iter().map(vertex).collect();
        vertices.resize(vertices.len().next_multiple_of(VERTICES), [Vec4::ZERO; 2]);
        let strip = packed(&ribbon.edges, origin, Some(face));
        let cells = Cells { whole: ribbon.triangles, ..Cells::default() };
        Self { origin, face: Some(face), cells, strip, vertices, ..Self::empty(key) }
    }

    /// A patch, or the boundary.
    fn of_hierarchy(key: PieceKey, face: &'a SurfaceFace, hierarchy: &Hierarchy) -> Self {
        let off_mm = key.off_mm();
        let mut draft = Self { origin: face.shape.origin(), face: Some(face), ..Self::empty(key) };
        if !key.is_patch() {
            draft.strip = packed(&border_of(face, STRIPS * off_mm), draft.origin, Some(face));
            return draft;
        }
        let found = hierarchy.with_tree(|tree| {
            let grid = draft.patch_grid(face, tree)?;
            Some((grid.shares(0), grid.shares(1), tree.node(grid.node).bounds.center()))
        });
        let Some((us, vs, origin)) = found else { return draft };
        draft.origin = origin;
        let [low, high] = [[us[0], vs[0]], [us[us.len() - 1], vs[vs.len() - 1]]].map(DVec2::from);
        let grid = Grid { lines: [us, vs] };
        draft.cells = grid.cells(face);
        draft.grid = Some(grid);
        // The boundary's own strip covers the sides of the domain.
        let is_outer = |[a, .., b]: &Cubic| {
            let (a, b) = (face.share(*a), face.share(*b));
            (0..2).any(|d| a[d] == b[d] && (a[d] < 1e-9 || a[d] > 1.0 - 1e-9))
        };
        let mut sides = face.sides(low, high, SIDE_PIECES);
        sides.retain(|side| !is_outer(side));
        draft.strip = packed(&segments_of(face, sides.iter(), STRIPS * off_mm), origin, Some(face));
        draft
    }

    /// The grid of a patch of a hierarchy.
    fn patch_grid<'t>(&self, face: &'t SurfaceFace, tree: &'t PatchTree) -> Option<PatchGrid<'t>> {
        let node = self.key.node()?;
        let off_mm = (1.0 - APPROXIMATION) * self.key.off_mm();
        let cells = tree.patch(node).cells(off_mm, LONGEST * self.key.off_mm()).map(|n| n.min(MOST_CELLS));
        Some(PatchGrid { shape: &face.shape, tree, node, cells })
    }
}

/// What a trim texture is drawn from.
fn fans(key: &PieceKey, face: &SurfaceFace) -> TrimFans {
    if let (Lod::BezierHierarchy, Some(hierarchy)) = (key.lod, face.hierarchy()) {
        let off_mm = TRIMS * key.off_mm();
        let lengths = DVec2::from(face.bounds.lengths);
        return TrimFans::of_curves(&hierarchy.trims(off_mm), lengths, off_mm);
    }
    // What closes a cut has curves alone.
    if face.domain.loops.is_empty() {
        let share = |cubic: &Cubic| cubic.map(|p| face.share(p));
        let chains: Vec<Vec<Cubic>> =
            face.chains.iter().map(|chain| chain.iter().map(share).collect()).collect();
        return TrimFans::of_curves(&chains, DVec2::from(face.bounds.lengths), TRIMS * key.off_mm());
    }
    let [u, v] = face.shape.domain();
    TrimFans::new(&face.domain, DVec2::new(u.start, v.start), DVec2::new(u.end, v.end))
}

fn chords(points: &[DVec3]) -> Vec<Segment> {
    let chord = |pair: &[DVec3]| Segment { a: pair[0], b: pair[1], uv: Default::default() };
    points.windows(2).map(chord).collect()
}

/// Segments as the device reads them, relative to `origin`, in whole blocks.
fn packed(segments: &[Segment], origin: DVec3, surface: Option<&SurfaceFace>) -> Vec<[Vec4; 4]> {
    let end = |p: DVec3, u: f64| (p - origin).as_vec3().extend(u as f32);
    let at = |uv: DVec2| {
        let Some(surface) = surface else { return (DVec2::ZERO, DVec3::ZERO) };
        let [u, v] = surface.shape.domain();
        let share = (uv - DVec2::new(u.start, v.start)) / DVec2::new(u.length(), v.length());
        (share, surface.shape.normal(uv))
    };
    let one = |s: &Segment| {
        let [(a, normal_a), (b, normal_b)] = s.uv.map(at);
        let normal = |n: DVec3, v: f64| n.as_vec3().extend(v as f32);
        [end(s.a, a.x), end(s.b, b.x), normal(normal_a, a.y), normal(normal_b, b.y)]
    };
    let mut packed: Vec<[Vec4; 4]> = segments.iter().map(one).collect();
    // What fills a block is no longer than a point.
    if let Some([_, b, _, normal]) = packed.last().copied() {
        packed.resize(packed.len().next_multiple_of(SEGMENTS), [b, b, normal, normal]);
    }
    packed
}
