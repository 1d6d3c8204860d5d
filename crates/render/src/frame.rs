//! What a view needs: which faces are seen, how fine, and the tables that the passes read.

use glam::{DAffine3, DVec3, Mat4, Vec2, Vec3, Vec4};
use rayon::prelude::*;
use trimloop_brep::Rgba;

use crate::camera::{Camera, Projection};
use crate::emission::{Bounds, Draw, Strips};
use crate::grid::{LONGEST, cells};
use crate::hierarchy::{Chosen, Sight};
use crate::lod::Lod;
use crate::look::{EdgeStyle, Look, MOST_SECTIONS, Paint, Section, linear};
use crate::scene::{FaceKind, Instance, Scene, SceneFace};
use crate::stage::{PieceKey, Stage};
use crate::surface_face::SurfaceFace;

/// As in `shaders/shared/frame.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct View {
    clip: Mat4,
    size: Vec2,
    pixel: f32,
    is_parallel: u32,
    up: Vec3,
    border: f32,
    sections: [Vec4; MOST_SECTIONS],
    edge: Vec4,
    /// The radius of curvature that is red; 0 for the items' own colours.
    tightest: Vec4,
    edge_width: f32,
    border_shift: f32,
    edge_shift: f32,
    near: f32,
}

/// As in `shaders/shared/frame.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Item {
    rows: [Vec4; 3],
    color: [f32; 4],
    trim: u32,
    id: u32,
    flags: u32,
    mask: u32,
}

/// A part of the picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tile {
    pub column: u32,
    pub row: u32,
    pub size: [u32; 2],
    /// Pixels that the picture is moved by, for samples between pixels.
    pub jitter: [f64; 2],
}

/// What is looked at from where, and how exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shot<'a> {
    pub scene: &'a Scene,
    pub camera: &'a Camera,
    pub look: &'a Look,
    /// Pixels of the whole picture.
    pub size: [u32; 2],
}

impl Visible {
    /// How large it appears to be.
    pub fn apparent(&self) -> f64 {
        self.radius / self.center.length().max(f64::MIN_POSITIVE)
    }
}

/// A face in the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Visible {
    pub instance: u32,
    pub key: PieceKey,
    /// Its sphere in the eye's coordinates.
    center: DVec3,
    radius: f64,
    /// Of a patch of a hierarchy, the level of the trim texture.
    trim_level: i32,
}

/// What a picture is drawn from.
#[derive(Debug, Default)]
pub(crate) struct Lists {
    pub items: Vec<Item>,
    /// By item.
    pub draws: Vec<Draw>,
    /// By an item's id, less one.
    pub faces: Vec<Numbered>,
}

/// What an item's id stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbered {
    pub instance: u32,
    pub face: u32,
    pub tile: u64,
}

/// Half the width of borders, pixels.
const BORDER_PX: f32 = 0.25;
/// Likewise where trim textures end faces, which are off by half a texel.
const MASK_BORDER_PX: f32 = 0.32;
const BORDER_SHIFT_PX: f32 = 0.5;
const EDGE_SHIFT_PX: f32 = 2.0;
/// Of what a picture may be off, the share for the distance between triangles and surface.
const GEOMETRY: f64 = 0.5;
/// A sphere that the eye is inside of counts as this share of its radius away.
const INSIDE: f64 = 0.02;

impl Shot<'_> {
    /// The faces in the picture, with the level of detail that each needs.
    pub fn visible(&self) -> Vec<Visible> {
        let whole = Tile { column: 0, row: 0, size: self.size, jitter: [0.0; 2] };
        let frustum = Frustum::new(self, &whole);
        let per_instance = |(index, instance): (usize, &Instance)| {
            let faces = (0u32..).zip(&self.scene.parts[instance.part].faces);
            let placed = Placed::new(self.camera, &instance.transform);
            let mut visible = Vec::new();
            for (number, face) in faces.filter(|(_, face)| !face.is_hidden) {
                let key = PieceKey {
                    part: instance.part as u32,
                    face: number,
                    tile: 0,
                    level: 0,
                    lod: self.look.lod,
                };
                let seek = Seek { shot: self, frustum: &frustum, placed: &placed, instance: index as u32 };
                seek.face(face, key, &mut visible);
            }
            visible
        };
        let shown: Vec<(usize, &Instance)> =
            self.scene.instances.iter().enumerate().filter(|(_, i)| i.is_shown).collect();
        let all: Vec<Vec<Visible>> = shown.into_par_iter().map(per_instance).collect();
        all.concat()
    }

    /// How far off the surface may be, as a power of two, millimetres.
    fn level(&self, center: DVec3, radius: f64, scale: f64) -> i32 {
        level_of(self.allowed_mm(-center.z - radius, radius, scale))
    }

    /// How far off something may be whose nearest point is `depth` away, in its own millimetres.
    fn allowed_mm(&self, depth: f64, radius: f64, scale: f64) -> f64 {
        let depth = match self.camera.is_parallel() {
            true => 1.0,
            false => depth.max(INSIDE * radius).max(f64::MIN_POSITIVE),
        };
        self.look.screen_error_px * GEOMETRY * self.camera.pixel(self.size[1]) * depth / scale
    }

    /// What is drawn, once everything in `visible` is evaluated; `is_solid` takes what is transparent for opaque.
    pub fn lists(&self, stage: &Stage, visible: &[Visible], is_solid: bool) -> Lists {
        let places: Vec<Placed> =
            self.scene.instances.iter().map(|i| Placed::new(self.camera, &i.transform)).collect();
        let found: Vec<(Item, Draw, Numbered)> = visible
            .par_iter()
            .filter_map(|one| self.entry(stage, one, &places[one.instance as usize], is_solid))
            .collect();
        let mut lists = Lists::default();
        for (number, (item, draw, face)) in (0u32..).zip(found) {
            lists.items.push(Item { id: number + 1, ..item });
            lists.draws.push(Draw { item: number, ..draw });
            lists.faces.push(face);
        }
        self.add_curves(stage, &places, &mut lists);
        lists
    }

    /// A piece at its place.
    fn entry(
        &self,
        stage: &Stage,
        one: &Visible,
        placed: &Placed,
        is_solid: bool,
    ) -> Option<(Item, Draw, Numbered)> {
        let Visible { instance, key, center, radius, trim_level } = *one;
        let placed_in = &self.scene.instances[instance as usize];
        let face = &self.scene.parts[placed_in.part].faces[key.face as usize];
        let own = stage.piece(&key).or_else(|| stage.near(&key))?;
        // The patches of a hierarchy share the trim texture of the whole.
        let trimmed = match key.is_patch() {
            true => stage.piece(&PieceKey { tile: PieceKey::WHOLE, level: trim_level, ..key })?,
            false => own,
        };
        let is_highlighted = self.scene.highlights.iter().any(|own| {
            own.instance == instance as usize && own.face.is_none_or(|face| face == key.face as usize)
        });
        let color = self.color(placed_in, face);
        let color = if is_highlighted { highlighted(color) } else { color };
        let flags = placed_in.closes.map_or(0, |k| 1 << k) | u32::from(is_highlighted) << MOST_SECTIONS;
        let item = placed.item(own.origin, color, trimmed.trim, flags);
        let item = Item { mask: trimmed.mask, ..item };
        let is_clear = !is_solid && color[3] < 0.999;
        let is_edge = key.tile == 0;
        let piece = match &stage.faces[placed_in.part][key.face as usize].triangles {
            Some(triangles) if is_edge => triangles,
            _ => own,
        };
        let has_strip = match is_edge {
            true => self.look.edges != EdgeStyle::None || !self.look.has_faces,
            false => !is_clear && self.look.has_faces,
        };
        let draw = Draw {
            center: center.as_vec3().to_array(),
            // Rounding of the centre is made up for.
            radius: (radius * 1.0001 + 1e-6 * center.length()) as f32,
            first_vertex: piece.first_vertex,
            blocks: piece.blocks,
            columns: piece.cells.columns,
            first_cell: piece.cells.first,
            whole: if self.look.has_faces { piece.cells.whole } else { 0 },
            part: if self.look.has_faces { piece.cells.part } else { 0 },
            first_strip: own.strip.first,
            strips: if has_strip { own.strip.blocks } else { 0 },
            kind: Draw::kind(if is_edge { Strips::Edges } else { Strips::Borders }, is_clear),
            ..Draw::default()
        };
        // What is cut away elsewhere is kept where it closes the cut.
        let radius = if placed_in.closes.is_some() { f32::MAX } else { draw.radius };
        Some((item, Draw { radius, ..draw }, Numbered { instance, face: key.face, tile: key.part_of_face() }))
    }

    fn add_curves(&self, stage: &Stage, places: &[Placed], lists: &mut Lists) {
        for (instance, placed) in self.scene.instances.iter().zip(places).filter(|(i, _)| i.is_shown) {
            let curves = stage.curves[instance.part].iter();
            for (curve, (_, color)) in curves.zip(&self.scene.parts[instance.part].curves) {
                let color = linear(instance.color.or(*color).unwrap_or(Rgba::opaque(0.1, 0.1, 0.1)));
                lists.draws.push(Draw {
                    radius: f32::MAX,
                    item: lists.items.len() as u32,
                    first_strip: curve.strip.first,
                    strips: curve.strip.blocks,
                    kind: Draw::kind(Strips::Lines, false),
                    ..Draw::default()
                });
                lists.items.push(placed.item(curve.origin, color, 0, 0));
            }
        }
    }

    /// What a tile shows, and the section.
    pub fn bounds(&self, tile: &Tile) -> Bounds {
        let mut planes = [[0.0, 0.0, 0.0, f32::MAX]; 5];
        for (to, (normal, offset)) in planes.iter_mut().zip(Frustum::new(self, tile).planes()) {
            *to = normal.extend(offset).as_vec4().to_array();
        }
        Bounds { planes, sections: self.sections().map(|s| s.to_array()), count: 0, unused: [0; 3] }
    }

    /// The section planes in the eye's coordinates; all zero for none.
    fn sections(&self) -> [Vec4; MOST_SECTIONS] {
        let plane = |section: Section| {
            let normal = self.camera.rotation() * section.normal;
            let offset = section.normal.dot(self.camera.eye) - section.offset_mm;
            normal.extend(offset).as_vec4()
        };
        self.look.sections.map(|section| section.map_or(Vec4::ZERO, plane))
    }

    fn color(&self, instance: &Instance, face: &SceneFace) -> [f32; 4] {
        let own = instance.color.or(face.color).unwrap_or(self.look.color);
        if instance.closes.is_some() {
            return linear(own);
        }
        let color = match self.look.paint {
            Paint::Own | Paint::Curvature { .. } => own,
            Paint::Parts => Rgba { a: own.a, ..Paint::of_part(instance.part) },
            Paint::Kinds => Rgba { a: own.a, ..Paint::of_kind(face.surface_kind()) },
        };
        linear(Rgba { a: color.a * self.look.opacity, ..color })
    }

    /// The view of a tile.
    pub fn view(&self, tile: &Tile) -> View {
        let camera = self.camera;
        let [width, height] = tile.size.map(f64::from);
        let pixel = camera.pixel(self.size[1]);
        // The tile's middle, pixels from that of the picture: to the right, up.
        let [x, y] = self.middle(tile);
        let scale = [2.0 / (width * pixel), 2.0 / (height * pixel)];
        let shift = [-2.0 * x / width, -2.0 * y / height];
        let (near, far) = self.depths();
        let clip = if camera.is_parallel() {
            let range = 1.0 / (near - far);
            [
                [scale[0], 0.0, 0.0, 0.0],
                [0.0, scale[1], 0.0, 0.0],
                [0.0, 0.0, range, 0.0],
                [shift[0], shift[1], -far * range, 1.0],
            ]
        } else {
            [
                [scale[0], 0.0, 0.0, 0.0],
                [0.0, scale[1], 0.0, 0.0],
                [-shift[0], -shift[1], 0.0, -1.0],
                [0.0, 0.0, near, 0.0],
            ]
        };
        let up = (camera.rotation() * self.look.up.axis()).as_vec3();
        View {
            clip: Mat4::from_cols_array_2d(&clip.map(|column| column.map(|x| x as f32))),
            size: Vec2::new(width as f32, height as f32),
            pixel: pixel as f32,
            is_parallel: u32::from(camera.is_parallel()),
            up,
            border: if self.look.lod.has_masks() { MASK_BORDER_PX } else { BORDER_PX },
            sections: self.sections(),
            edge: Vec4::new(0.012, 0.014, 0.018, 1.0),
            tightest: match self.look.paint {
                Paint::Curvature { tightest_mm } => Vec4::X * tightest_mm as f32,
                _ => Vec4::ZERO,
            },
            edge_width: 0.5 * self.look.edge_width_px,
            border_shift: BORDER_SHIFT_PX,
            edge_shift: EDGE_SHIFT_PX,
            near: near as f32,
        }
    }

    fn middle(&self, tile: &Tile) -> [f64; 2] {
        [
            f64::from(tile.column) + 0.5 * f64::from(tile.size[0]) - 0.5 * f64::from(self.size[0])
                + tile.jitter[0],
            0.5 * f64::from(self.size[1]) - f64::from(tile.row) - 0.5 * f64::from(tile.size[1])
                + tile.jitter[1],
        ]
    }

    /// Perspective: the nearest distance that is drawn. Parallel: z of what is nearest and farthest.
    fn depths(&self) -> (f64, f64) {
        let mut low = f64::INFINITY;
        let mut high = f64::NEG_INFINITY;
        for instance in self.scene.instances.iter().filter(|i| i.is_shown) {
            let placed = Placed::new(self.camera, &instance.transform);
            let part = &self.scene.parts[instance.part];
            for corner in part.bounds.corners().into_iter().filter(|c| c.is_finite()) {
                let z = placed.point(corner).z;
                (low, high) = (low.min(z), high.max(z));
            }
        }
        let size = (high - low).max(1e-6);
        if !size.is_finite() {
            return (1.0, 0.0);
        }
        let pad = 0.01 * size;
        if self.camera.is_parallel() {
            (high + pad, low - pad)
        } else {
            ((-high).max(1e-5 * size) * 0.5, 0.0)
        }
    }
}

fn level_of(allowed_mm: f64) -> i32 {
    allowed_mm.log2().floor().clamp(-60.0, 60.0) as i32
}

/// Gaps of less than this share of what faces may be off are left to borders.
const NARROW: f64 = 1.0;

/// Looks for the parts of a face that are in the picture.
struct Seek<'a> {
    shot: &'a Shot<'a>,
    frustum: &'a Frustum,
    placed: &'a Placed,
    instance: u32,
}

/// Parts of faces that need more cells than this along a direction are halved, this often at most.
const MOST_CELLS: f64 = 200.0;
const DEEPEST: u32 = 40;

impl Seek<'_> {
    /// Adds the face's edges, and the parts of its surface.
    fn face(&self, face: &SceneFace, key: PieceKey, out: &mut Vec<Visible>) {
        let Some(whole) = self.sphere(key, face.sphere) else { return };
        let first = out.len();
        out.push(whole);
        match &face.kind {
            FaceKind::Surface(surface) if key.lod == Lod::BezierHierarchy => {
                self.patches(surface, PieceKey { tile: PieceKey::WHOLE, ..key }, out);
            }
            FaceKind::Surface(surface) => {
                self.tile(surface, PieceKey { tile: PieceKey::WHOLE, ..key }, out);
            }
            _ => {}
        }
        // Edges are as fine as the finest part.
        out[first].key.level = out[first..].iter().map(|v| v.key.level).min().unwrap_or(whole.key.level);
    }

    fn tile(&self, face: &SurfaceFace, key: PieceKey, out: &mut Vec<Visible>) {
        let Some(visible) = self.sphere(key, face.sphere()) else { return };
        let [u, v] = cells(&face.bounds, f64::from(visible.key.level).exp2());
        let depth = 63 - key.tile.leading_zeros();
        let is_fine = u.max(v) <= MOST_CELLS || depth >= DEEPEST;
        if is_fine || key.lod != Lod::Adaptive {
            out.push(visible);
            self.skirt(face, visible, out);
            return;
        }
        for (k, half) in (0u64..).zip(face.halves()) {
            if let Some(half) = half {
                self.tile(half, PieceKey { tile: 2 * key.tile + k, ..key }, out);
            }
        }
    }

    /// The boundary with its trim texture, as fine as the finest patch, then patches.
    fn patches(&self, face: &SurfaceFace, key: PieceKey, out: &mut Vec<Visible>) {
        let Some(whole) = self.sphere(key, face.sphere()) else { return };
        let first = out.len();
        out.push(whole);
        let Some(hierarchy) = face.hierarchy() else { return };
        let patch = |chosen: Chosen| Visible {
            instance: self.instance,
            key: PieceKey { tile: PieceKey::patch(chosen.node), level: level_of(chosen.allowed_mm), ..key },
            center: self.placed.point(chosen.center),
            radius: chosen.radius * self.placed.scale,
            trim_level: 0,
        };
        out.extend(hierarchy.choose(face, self, LONGEST).into_iter().map(patch));
        match out[first + 1..].iter().map(|v| v.key.level).min() {
            Some(finest) => {
                out[first].key.level = finest;
                out[first + 1..].iter_mut().for_each(|v| v.trim_level = finest);
            }
            None => out.truncate(first),
        }
        if let Some(whole) = out.get(first).copied() {
            self.skirt(face, whole, out);
        }
    }

    /// What closes a gap between the face and its edges that would be seen.
    fn skirt(&self, face: &SurfaceFace, of: Visible, out: &mut Vec<Visible>) {
        if face.gap_mm > NARROW * f64::from(of.key.level).exp2() {
            out.push(Visible { key: of.key.skirt(), ..of });
        }
    }

    /// What is inside the sphere, if that is in the picture.
    fn sphere(&self, key: PieceKey, (center, radius): (DVec3, f64)) -> Option<Visible> {
        let center = self.placed.point(center);
        let radius = radius * self.placed.scale;
        let level = self.shot.level(center, radius, self.placed.scale);
        let key = PieceKey { level, ..key };
        let is_seen = self.frustum.holds(center, radius);
        is_seen.then_some(Visible { instance: self.instance, key, center, radius, trim_level: level })
    }
}

impl Sight for Seek<'_> {
    fn crossed(&self, low: DVec3, high: DVec3, planes: u8) -> Option<u8> {
        let center = self.placed.point(0.5 * (low + high));
        let mut crossed = planes;
        for (k, (normal, offset)) in self.frustum.planes().enumerate().filter(|(k, _)| planes >> k & 1 == 1) {
            let reach = self.placed.reach(high - low, normal);
            let distance = normal.dot(center) + offset;
            if distance < -reach {
                return None;
            }
            if distance >= reach {
                crossed &= !(1 << k);
            }
        }
        Some(crossed)
    }

    fn allowed_mm(&self, low: DVec3, high: DVec3) -> f64 {
        let nearest = self.placed.point(0.5 * (low + high)).z + self.placed.reach(high - low, DVec3::Z);
        let radius = 0.5 * low.distance(high) * self.placed.scale;
        self.shot.allowed_mm(-nearest, radius, self.placed.scale)
    }
}

/// From an instance's coordinates to the eye's.
#[derive(Clone, Copy, Debug)]
struct Placed {
    matrix: DAffine3,
    /// The largest factor that lengths are multiplied with.
    scale: f64,
}

impl Placed {
    fn new(camera: &Camera, transform: &DAffine3) -> Self {
        let rotation = camera.rotation();
        let matrix = DAffine3 {
            matrix3: rotation * transform.matrix3,
            translation: rotation * (transform.translation - camera.eye),
        };
        let m = matrix.matrix3;
        let scale = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
        Self { matrix, scale }
    }

    fn point(&self, p: DVec3) -> DVec3 {
        self.matrix.transform_point3(p)
    }

    /// How far a box with sides of `size` reaches from its middle along a direction in the eye's coordinates.
    fn reach(&self, size: DVec3, direction: DVec3) -> f64 {
        0.5 * (self.matrix.matrix3.transpose() * direction).abs().dot(size)
    }

    fn item(&self, origin: DVec3, color: [f32; 4], trim: u32, flags: u32) -> Item {
        let m = self.matrix.matrix3.transpose();
        let t = self.point(origin);
        let rows = [m.x_axis.extend(t.x), m.y_axis.extend(t.y), m.z_axis.extend(t.z)];
        Item { rows: rows.map(|row| row.as_vec4()), color, trim, id: 0, flags, mask: 0 }
    }
}

/// The colour of what stands out, linear.
fn highlighted([r, g, b, a]: [f32; 4]) -> [f32; 4] {
    let mix = |own: f32, other: f32| 0.35 * own + 0.65 * other;
    [mix(r, 0.95), mix(g, 0.32), mix(b, 0.04), a.max(0.6)]
}

/// The planes around a tile, in the eye's coordinates; normals point inwards.
#[derive(Debug)]
struct Frustum {
    sides: [(DVec3, f64); 4],
    is_parallel: bool,
}

impl Frustum {
    fn new(shot: &Shot<'_>, tile: &Tile) -> Self {
        let pixel = shot.camera.pixel(shot.size[1]);
        let middle = shot.middle(tile);
        // Strips reach a little farther than what they belong to.
        let half = tile.size.map(|n| 0.5 * f64::from(n) + 2.0);
        let [left, right] = [middle[0] - half[0], middle[0] + half[0]].map(|x| x * pixel);
        let [lower, upper] = [middle[1] - half[1], middle[1] + half[1]].map(|y| y * pixel);
        let is_parallel = matches!(shot.camera.projection, Projection::Parallel { .. });
        let side = |axis: DVec3, at: f64| {
            if is_parallel {
                (axis, -at * axis.element_sum())
            } else {
                ((axis + DVec3::Z * at * axis.element_sum()).normalize(), 0.0)
            }
        };
        let sides =
            [side(DVec3::X, left), side(-DVec3::X, right), side(DVec3::Y, lower), side(-DVec3::Y, upper)];
        Self { sides, is_parallel }
    }

    /// The four sides and, in a perspective view, the plane through the eye.
    fn planes(&self) -> impl Iterator<Item = (DVec3, f64)> {
        let ahead = (!self.is_parallel).then_some((-DVec3::Z, 0.0));
        self.sides.into_iter().chain(ahead)
    }

    fn holds(&self, center: DVec3, radius: f64) -> bool {
        let is_ahead = self.is_parallel || center.z - radius < 0.0;
        is_ahead && self.sides.iter().all(|(normal, offset)| normal.dot(center) + offset >= -radius)
    }
}
