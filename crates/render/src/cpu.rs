//! Pictures without any graphics device: triangles of `mesh`, drawn into a depth buffer.

use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;
use trimloop_brep::{Model, Rgba};
use trimloop_mesh::{Cancelled, LinearDeflection, MeshOptions, Monitor, PartMesh};

use crate::camera::Camera;
use crate::look::{Background, EdgeStyle, Look, MOST_SECTIONS, encode, linear};
use crate::picture::{Pick, Picture, Seen};
use crate::renderer::check;
use crate::scene::{FaceKind, Scene};
use crate::surface_face::SurfaceFace;
use crate::{Place, RenderError};

/// Draws the triangles of a scene on the CPU.
#[derive(Debug)]
pub struct CpuRenderer {
    scene: Scene,
    meshes: Vec<PartMesh>,
}

/// Share of a part's size that its triangles may be off.
const DEFLECTION: f64 = 3e-4;
/// Rows that one task draws.
const BAND: usize = 32;
const EDGE_SHIFT_PX: f64 = 2.0;

/// A corner on the screen: pixels, and what is linear there; 1 / depth (in a parallel view the depth itself, negated).
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: DVec2,
    near: f64,
    eye: DVec3,
    normal: DVec3,
    uv: DVec2,
}

#[derive(Clone, Copy, Debug)]
struct Drawn<'a> {
    corners: [Corner; 3],
    color: [f32; 4],
    pick: (u32, u32),
    /// The plane that does not cut it.
    closes: Option<usize>,
    /// The face that is to be trimmed; triangles of a mesh need not be.
    trimmed: Option<&'a SurfaceFace>,
}

#[derive(Clone, Copy, Debug)]
struct Line {
    ends: [Corner; 2],
    color: [f32; 4],
    is_edge: bool,
    /// The plane that does not cut it.
    closes: Option<usize>,
}

/// What a sample shows.
#[derive(Clone, Copy, Debug)]
struct Sample {
    near: f64,
    /// Premultiplied.
    color: [f32; 4],
    pick: Option<(u32, u32, DVec2)>,
    sums: [f32; 4],
    through: f32,
}

const NOTHING: Sample =
    Sample { near: f64::NEG_INFINITY, color: [0.0; 4], pick: None, sums: [0.0; 4], through: 1.0 };

impl CpuRenderer {
    /// Meshes all parts of the model that `scene` was made of.
    ///
    /// # Errors
    /// Where `monitor` stops it.
    pub fn new(model: &Model, scene: Scene, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        Self::with_deflection(model, scene, DEFLECTION, monitor)
    }

    /// The same with triangles that are off by at most a share of their part's size.
    ///
    /// # Errors
    /// Where `monitor` stops it.
    pub fn with_deflection(
        model: &Model,
        scene: Scene,
        deflection: f64,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let options = MeshOptions {
            linear_deflection: LinearDeflection::Relative(deflection),
            angular_deflection_rad: 12f64.to_radians(),
            ..MeshOptions::default()
        };
        let mesh = |part| trimloop_mesh::mesh_part(part, &options, monitor);
        let meshes: Result<Vec<PartMesh>, Cancelled> = model.parts.par_iter().map(mesh).collect();
        Ok(Self { scene, meshes: meshes? })
    }

    /// What is drawn.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// A picture of `size` pixels.
    ///
    /// # Errors
    /// A size that cannot be.
    pub fn picture(&self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Picture, RenderError> {
        check(size)?;
        let fine = if look.samples > 4 { 3 } else { look.samples.min(4).isqrt() } as usize;
        let prepared = Prepared::new(self, camera, size, look, fine as f64);
        let [width, height] = size.map(|n| n as usize);
        let mut rgba = vec![0; width * height * 4];
        let bands = rgba.par_chunks_mut(width * 4 * BAND).enumerate();
        bands.for_each(|(band, out)| {
            let rows = out.len() / (width * 4);
            let samples = prepared.band(band * BAND * fine, rows * fine, width * fine, look);
            for (k, pixel) in out.chunks_exact_mut(4).enumerate() {
                let (x, y) = (k % width, k / width);
                let down = (band * BAND + y) as f32 / height as f32;
                let mut sum = [0.0; 4];
                for j in 0..fine {
                    for i in 0..fine {
                        let own = samples[(y * fine + j) * width * fine + x * fine + i].over(look, down);
                        (0..4).for_each(|c| sum[c] += own[c] / (fine * fine) as f32);
                    }
                }
                let opacity = sum[3].max(1e-6);
                (0..3).for_each(|c| pixel[c] = encode(sum[c] / opacity));
                pixel[3] = (sum[3].clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
            }
        });
        Ok(Picture { width: size[0], height: size[1], rgba })
    }

    /// What every pixel of a picture of `size` pixels shows.
    ///
    /// # Errors
    /// A size that cannot be.
    pub fn seen(&self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Seen, RenderError> {
        let samples = self.samples(camera, size, look)?;
        let pick = |(instance, face, share)| Pick { instance: instance as usize, face: face as usize, share };
        let pixels = samples.into_iter().map(|s| s.pick.map(pick)).collect();
        Ok(Seen { width: size[0], height: size[1], pixels })
    }

    /// How far from the eye's plane what every pixel shows is, millimetres; infinite for the background.
    ///
    /// # Errors
    /// A size that cannot be.
    pub fn depths(&self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Vec<f64>, RenderError> {
        let depth = |s: Sample| match s.pick {
            None => f64::INFINITY,
            Some(_) if camera.is_parallel() => -s.near,
            Some(_) => 1.0 / s.near,
        };
        Ok(self.samples(camera, size, look)?.into_iter().map(depth).collect())
    }

    /// One sample per pixel; transparent faces count as solid.
    fn samples(&self, camera: &Camera, size: [u32; 2], look: &Look) -> Result<Vec<Sample>, RenderError> {
        check(size)?;
        let plain = Look { edges: EdgeStyle::None, ..*look };
        let mut prepared = Prepared::new(self, camera, size, &plain, 1.0);
        let clear = std::mem::take(&mut prepared.clear);
        prepared.solid.extend(clear);
        prepared.lines.clear();
        let [width, height] = size.map(|n| n as usize);
        let bands: Vec<usize> = (0..height.div_ceil(BAND)).collect();
        let samples = bands.into_par_iter().flat_map_iter(|band| {
            let rows = BAND.min(height - band * BAND);
            prepared.band(band * BAND, rows, width, &plain)
        });
        Ok(samples.collect())
    }

    /// What lies at a pixel.
    ///
    /// # Errors
    /// A size that cannot be.
    pub fn pick(
        &self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        [x, y]: [u32; 2],
    ) -> Result<Option<Place>, RenderError> {
        let seen = self.seen(camera, size, look)?;
        let found = if x < size[0] && y < size[1] { seen.at(x, y) } else { None };
        let ray = camera.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), size);
        Ok(found.and_then(|pick| Place::new(&self.scene, &pick, ray)))
    }
}

impl Sample {
    /// With what is transparent in front and the background behind; premultiplied.
    fn over(&self, look: &Look, down: f32) -> [f32; 4] {
        let (top, bottom) = match look.background {
            Background::Gradient(top, bottom) => (linear(top), linear(bottom)),
            Background::Plain(color) => (linear(color), linear(color)),
        };
        let back: [f32; 4] = std::array::from_fn(|c| top[c] + (bottom[c] - top[c]) * down);
        let veil = 1.0 - self.through;
        std::array::from_fn(|c| {
            let behind = if c == 3 { back[3] } else { back[c] * back[3] };
            let solid = self.color[c] + behind * (1.0 - self.color[3]);
            let own = if c == 3 { 1.0 } else { self.sums[c] / self.sums[3].max(1e-6) };
            own * veil + solid * self.through
        })
    }
}

/// Everything on the screen, by the bands of rows that it reaches into.
struct Prepared<'a> {
    solid: Vec<Drawn<'a>>,
    clear: Vec<Drawn<'a>>,
    lines: Vec<Line>,
    half_width: f64,
    is_parallel: bool,
    sections: [Option<(DVec3, f64)>; MOST_SECTIONS],
    up: DVec3,
}

impl<'a> Prepared<'a> {
    fn new(of: &'a CpuRenderer, camera: &Camera, size: [u32; 2], look: &Look, fine: f64) -> Self {
        let mut out = Self {
            solid: Vec::new(),
            clear: Vec::new(),
            lines: Vec::new(),
            half_width: 0.5 * f64::from(look.edge_width_px) * fine,
            is_parallel: camera.is_parallel(),
            sections: look.sections.map(|section| {
                section.map(|s| (camera.rotation() * s.normal, s.normal.dot(camera.eye) - s.offset_mm))
            }),
            up: camera.rotation() * look.up.axis(),
        };
        let pixel = camera.pixel(size[1]) / fine;
        let middle = DVec2::new(f64::from(size[0]), f64::from(size[1])) * 0.5 * fine;
        let is_parallel = out.is_parallel;
        let project = |eye: DVec3, normal: DVec3, uv: DVec2| {
            let scale = if is_parallel { 1.0 } else { -1.0 / eye.z };
            let at = middle + DVec2::new(eye.x, -eye.y) * scale / pixel;
            Corner { at, near: if is_parallel { eye.z } else { scale }, eye, normal, uv }
        };
        let shift = EDGE_SHIFT_PX * pixel * fine;
        for (index, instance) in (0u32..).zip(&of.scene.instances).filter(|(_, i)| i.is_shown) {
            let rotation = camera.rotation();
            let to_eye = DAffine3 {
                matrix3: rotation * instance.transform.matrix3,
                translation: rotation * (instance.transform.translation - camera.eye),
            };
            let part = &of.scene.parts[instance.part];
            // What closes a cut has no mesh: its plane is trimmed sample by sample.
            for (number, face) in (0u32..).zip(&part.faces).filter(|_| instance.closes.is_some()) {
                let FaceKind::Surface(surface) = &face.kind else { continue };
                let corner = |u: f64, v: f64| {
                    let uv = DVec2::new(u, v);
                    let own = surface.shape.derivatives(surface.parameters(uv)).point;
                    project(to_eye.transform_point3(own), surface.shape.normal(surface.parameters(uv)), uv)
                };
                let [a, b, c, d] = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
                let color = linear(instance.color.or(face.color).unwrap_or(look.color));
                for corners in [[a, b, c], [a, c, d]] {
                    if is_parallel || corners.iter().all(|c| c.eye.z < 0.0) {
                        let (pick, closes) = ((index, number), instance.closes);
                        out.solid.push(Drawn { corners, color, pick, closes, trimmed: Some(surface) });
                    }
                }
            }
            let mesh = of.meshes.get(instance.part);
            let deflection_mm = mesh.map_or(part.bounds.diagonal() * DEFLECTION, |m| m.linear_deflection_mm);
            let faces = mesh.into_iter().flat_map(|mesh| mesh.faces.iter().map(move |own| (mesh, own)));
            for ((number, (mesh, own)), face) in (0u32..).zip(faces).zip(&part.faces) {
                if face.is_hidden {
                    continue;
                }
                let color = linear(instance.color.or(face.color).unwrap_or(look.color));
                let list = if color[3] < 0.999 { &mut out.clear } else { &mut out.solid };
                for t in &own.triangles {
                    let corners = t.map(|k| {
                        let v = &own.vertices[k as usize];
                        let eye = to_eye.transform_point3(mesh.positions[v.position as usize]);
                        project(eye, to_eye.matrix3 * v.normal, share(face, v.uv))
                    });
                    if is_parallel || corners.iter().all(|c| c.eye.z < 0.0) {
                        list.push(Drawn {
                            corners,
                            color,
                            pick: (index, number),
                            closes: instance.closes,
                            trimmed: None,
                        });
                    }
                }
            }
            let mut add = |a: DVec3, b: DVec3, color: [f32; 4], is_edge: bool| {
                let moved = |p: DVec3| {
                    let eye = to_eye.transform_point3(p);
                    let eye = if is_parallel { eye + DVec3::Z * shift } else { eye * (1.0 - shift) };
                    project(eye, DVec3::ZERO, DVec2::ZERO)
                };
                let ends = [moved(a), moved(b)];
                if is_parallel || ends.iter().all(|c| c.eye.z < 0.0) {
                    out.lines.push(Line { ends, color, is_edge, closes: instance.closes });
                }
            };
            if look.edges != EdgeStyle::None {
                let edges = part.faces.iter().filter(|face| !face.is_hidden).flat_map(|face| &face.edges);
                for edge in edges {
                    let points = edge.sample(deflection_mm);
                    points
                        .windows(2)
                        .for_each(|pair| add(pair[0], pair[1], [0.012, 0.014, 0.018, 1.0], true));
                }
            }
            for (points, color) in &part.curves {
                let color = linear(instance.color.or(*color).unwrap_or(Rgba::opaque(0.1, 0.1, 0.1)));
                points.windows(2).for_each(|pair| add(pair[0], pair[1], color, false));
            }
        }
        out
    }

    fn is_cut_away(&self, closes: Option<usize>, eye: DVec3) -> bool {
        let is_beyond = |(k, plane): (usize, &Option<(DVec3, f64)>)| {
            closes != Some(k) && plane.is_some_and(|(normal, offset)| normal.dot(eye) + offset > 0.0)
        };
        self.sections.iter().enumerate().any(is_beyond)
    }

    /// The samples of some rows, row by row.
    fn band(&self, first: usize, rows: usize, width: usize, look: &Look) -> Vec<Sample> {
        let mut out = vec![NOTHING; rows * width];
        for drawn in &self.solid {
            self.fill(drawn, first, rows, width, &mut out, |sample, near, color, pick| {
                *sample = Sample { near, color, pick: Some(pick), ..*sample };
            });
        }
        for line in &self.lines {
            self.stroke(line, first, rows, width, &mut out, look.edges == EdgeStyle::Hidden);
        }
        for drawn in &self.clear {
            let alpha = drawn.color[3];
            self.fill(drawn, first, rows, width, &mut out, |sample, _, color, pick| {
                (0..3).for_each(|c| sample.sums[c] += color[c] * alpha);
                sample.sums[3] += alpha;
                sample.through *= 1.0 - alpha;
                sample.pick = sample.pick.or(Some(pick));
            });
        }
        out
    }

    fn fill(
        &self,
        drawn: &Drawn,
        first: usize,
        rows: usize,
        width: usize,
        out: &mut [Sample],
        mut put: impl FnMut(&mut Sample, f64, [f32; 4], (u32, u32, DVec2)),
    ) {
        let [a, b, c] = drawn.corners;
        let area = (b.at - a.at).perp_dot(c.at - a.at);
        let (low, high) = (a.at.min(b.at).min(c.at), a.at.max(b.at).max(c.at));
        if !(area.abs() > 1e-12) || !low.is_finite() || !high.is_finite() {
            return;
        }
        let columns = low.x.floor().max(0.0) as usize..(high.x.ceil().max(0.0) as usize).min(width);
        let from = (low.y.floor().max(first as f64)) as usize;
        let to = (high.y.ceil().max(0.0) as usize).min(first + rows);
        for row in from..to {
            for column in columns.clone() {
                let p = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                let wb = (p - a.at).perp_dot(c.at - a.at) / area;
                let wc = (b.at - a.at).perp_dot(p - a.at) / area;
                let wa = 1.0 - wb - wc;
                if wa < 0.0 || wb < 0.0 || wc < 0.0 {
                    continue;
                }
                let near = a.near * wa + b.near * wb + c.near * wc;
                let sample = &mut out[(row - first) * width + column];
                if near <= sample.near {
                    continue;
                }
                // Perspective: what is linear in space is linear on the screen over the depth.
                let w = if self.is_parallel { [wa, wb, wc] } else { [wa * a.near, wb * b.near, wc * c.near] };
                let w = w.map(|x| x / (w[0] + w[1] + w[2]));
                let eye = a.eye * w[0] + b.eye * w[1] + c.eye * w[2];
                let uv = a.uv * w[0] + b.uv * w[1] + c.uv * w[2];
                let is_outside = |face: &SurfaceFace| !face.table.contains(face.parameters(uv));
                if self.is_cut_away(drawn.closes, eye) || drawn.trimmed.is_some_and(is_outside) {
                    continue;
                }
                let normal = a.normal * w[0] + b.normal * w[1] + c.normal * w[2];
                let sight = if self.is_parallel { -DVec3::Z } else { eye.normalize() };
                let [r, g, b_, _] = drawn.color;
                let [r, g, b_] = shade([r, g, b_], normal, sight, self.up);
                put(sample, near, [r, g, b_, 1.0], (drawn.pick.0, drawn.pick.1, uv));
            }
        }
    }

    fn stroke(&self, line: &Line, first: usize, rows: usize, width: usize, out: &mut [Sample], hidden: bool) {
        let [a, b] = line.ends;
        let reach = self.half_width + 0.5;
        let (low, high) = (a.at.min(b.at) - reach, a.at.max(b.at) + reach);
        if !low.is_finite() || !high.is_finite() {
            return;
        }
        let from = (low.y.floor().max(first as f64)) as usize;
        let to = (high.y.ceil().max(0.0) as usize).min(first + rows);
        let way = b.at - a.at;
        let squared = way.length_squared().max(1e-12);
        for row in from..to {
            let columns = low.x.floor().max(0.0) as usize..(high.x.ceil().max(0.0) as usize).min(width);
            for column in columns {
                let p = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                let share = ((p - a.at).dot(way) / squared).clamp(0.0, 1.0);
                let distance = p.distance(a.at + way * share);
                let opacity = (reach - distance).clamp(0.0, 1.0) as f32;
                let near = a.near + (b.near - a.near) * share;
                let sample = &mut out[(row - first) * width + column];
                let is_behind = near < sample.near;
                let opacity = match (is_behind, line.is_edge && hidden) {
                    (true, true) => opacity * 0.22,
                    (true, false) => continue,
                    _ => opacity,
                };
                let eye = a.eye.lerp(b.eye, share);
                if opacity == 0.0 || self.is_cut_away(line.closes, eye) {
                    continue;
                }
                for c in 0..4 {
                    let own = if c == 3 { 1.0 } else { line.color[c] };
                    sample.color[c] = sample.color[c] * (1.0 - opacity) + own * opacity;
                }
            }
        }
    }
}

/// Parameters as shares of the face's domain.
fn share(face: &crate::SceneFace, uv: DVec2) -> DVec2 {
    let crate::FaceKind::Surface(surface) = &face.kind else { return DVec2::ZERO };
    let [u, v] = surface.shape.domain();
    (uv - DVec2::new(u.start, v.start)) / DVec2::new(u.length(), v.length())
}

/// Twin of `shaders/shared/shade.wgsl`.
fn shade(color: [f32; 3], normal: DVec3, sight: DVec3, up: DVec3) -> [f32; 3] {
    const KEY: DVec3 = DVec3::new(-0.408, 0.571, 0.712);
    const FILL: DVec3 = DVec3::new(0.757, 0.108, 0.644);
    let n = normal.try_normalize().unwrap_or(-sight);
    let n = if n.dot(sight) > 0.0 { -n } else { n };
    let sky = 0.5 + 0.5 * n.dot(up);
    let diffuse = 0.22 + 0.26 * sky + 0.62 * n.dot(KEY).max(0.0) + 0.20 * n.dot(FILL).max(0.0);
    let gloss = n.dot((KEY - sight).normalize()).max(0.0).powf(48.0);
    color.map(|c| c * diffuse as f32 + 0.10 * gloss as f32)
}
