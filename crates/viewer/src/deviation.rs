//! The model coloured by its distance from a reference, as `trimloop compare` measures it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;
use trimloop_brep::{Model, Rgba};
use trimloop_compare::{Shape, Target, choose, heat, is_mesh_extension, mesh_for_comparison, read_mesh};
use trimloop_gpu::Gpu;
use trimloop_import::ImportOptions;
use trimloop_mesh::Silent;
use trimloop_render::{Instance, RenderError, Renderer, Scene, ScenePart, Triangles};

/// A model's distances from a reference, ready to be drawn.
pub(crate) struct Deviation {
    /// The reference's file.
    pub reference: PathBuf,
    /// What the reference's unit and axes were taken to be.
    pub convention: Option<String>,
    found: Arc<Distances>,
    /// The distance that is red.
    pub most_mm: f64,
    /// The distance that is red in what is drawn.
    drawn_mm: f64,
    pub renderer: Renderer,
    /// What of the document was shown where.
    pub arrangement: Option<u64>,
}

/// Distances at the corners of a fine mesh of the model.
#[derive(Debug)]
pub(crate) struct Distances {
    pub reference: PathBuf,
    pub convention: Option<String>,
    /// By instance, and by face.
    parts: Vec<Vec<Measured>>,
    pub largest_mm: f64,
    /// 99 % of the corners are nearer than this.
    pub usual_mm: f64,
}

#[derive(Debug)]
struct Measured {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    distances: Vec<f64>,
    triangles: Vec<[u32; 3]>,
}

/// Sides of triangles are no longer than this share of the model's size.
const LONGEST: f64 = 0.012;
/// Colours between blue and red.
const BANDS: usize = 24;

/// Measures how far `model` is from what `reference` holds, a mesh or a CAD file.
///
/// # Errors
/// Where the reference cannot be read.
pub(crate) fn measure(model: &Model, reference: &Path) -> Result<Distances, String> {
    let meshes = mesh_for_comparison(model, &Silent).map_err(|error| error.to_string())?;
    let own = Shape::of_model(model, &meshes);
    let (shape, convention) = read(reference, &own)?;
    if shape.triangles.triangles.is_empty() {
        return Err("nothing in it has an area that could be compared".to_owned());
    }
    let target = Target::new(&shape);
    let mut parts = Vec::new();
    let mut placed = Vec::new();
    model.visit(|node, world| {
        if let Some(part) = node.part {
            placed.push((part, *world));
        }
    });
    let longest = LONGEST * own.triangles.bounds().diagonal();
    let limit = own.triangles.bounds().union(shape.triangles.bounds()).diagonal();
    for (part, world) in placed {
        let mut faces = Vec::new();
        let mesh = &meshes[part];
        let turn = world.matrix3.inverse().transpose();
        for (face, own) in model.parts[part].faces.iter().zip(&mesh.faces) {
            if face.hidden || own.triangles.is_empty() {
                continue;
            }
            let mut points: Vec<DVec3> = own
                .vertices
                .iter()
                .map(|v| world.transform_point3(mesh.positions[v.position as usize]))
                .collect();
            let mut normals = own.vertices.iter().map(|v| (turn * v.normal).normalize_or_zero()).collect();
            let triangles = divide(&mut points, &mut normals, &own.triangles, longest);
            let distance =
                |p: &DVec3| target.nearest(*p, limit).map_or(0.0, |(nearest, _)| nearest.distance(*p));
            let distances = points.par_iter().map(distance).collect();
            faces.push(Measured { points, normals, distances, triangles });
        }
        parts.push(faces);
    }
    let mut all: Vec<f64> = parts.iter().flatten().flat_map(|face| &face.distances).copied().collect();
    all.sort_by(f64::total_cmp);
    let largest_mm = all.last().copied().unwrap_or(0.0);
    let usual_mm = all.get(all.len() * 99 / 100).copied().unwrap_or(largest_mm);
    Ok(Distances { reference: reference.to_path_buf(), convention, parts, largest_mm, usual_mm })
}

/// Halves triangles until no side is longer than `longest`: between corners that are far apart, distances are no straight lines.
fn divide(
    points: &mut Vec<DVec3>,
    normals: &mut Vec<DVec3>,
    triangles: &[[u32; 3]],
    longest: f64,
) -> Vec<[u32; 3]> {
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut out = Vec::with_capacity(triangles.len());
    let mut stack = triangles.to_vec();
    while let Some(triangle) = stack.pop() {
        let length =
            |k: usize| points[triangle[k] as usize].distance_squared(points[triangle[(k + 1) % 3] as usize]);
        let side = (0..3).max_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(0);
        if !(length(side) > longest * longest) {
            out.push(triangle);
            continue;
        }
        let [a, b, c] = [0, 1, 2].map(|k| triangle[(side + k) % 3]);
        let middle = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            points.push(0.5 * (points[a as usize] + points[b as usize]));
            normals.push((normals[a as usize] + normals[b as usize]).normalize_or(normals[a as usize]));
            points.len() as u32 - 1
        });
        stack.extend([[a, middle, c], [middle, b, c]]);
    }
    out
}

/// The reference's shape, and what its unit and axes were taken to be.
fn read(path: &Path, own: &Shape) -> Result<(Shape, Option<String>), String> {
    if is_mesh_extension(path) {
        let file = read_mesh(path).map_err(|error| error.to_string())?;
        let choice =
            choose(file.convention, file.triangles.bounds(), Some(own.triangles.bounds()), None, None);
        let shape = Shape::of_mesh(file.triangles.transformed(&choice.convention.to_mm()));
        return Ok((shape, Some(format!("{} ({})", choice.convention, choice.reason))));
    }
    let model = trimloop_import::read(path, &ImportOptions::default()).map_err(|error| error.to_string())?;
    let meshes = mesh_for_comparison(&model, &Silent).map_err(|error| error.to_string())?;
    Ok((Shape::of_model(&model, &meshes), None))
}

impl Deviation {
    /// Brings the distances to the device.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn new(gpu: &Gpu, found: Distances) -> Result<Self, RenderError> {
        // Rounding alone is no deviation.
        let size = found
            .parts
            .iter()
            .flatten()
            .flat_map(|p| &p.points)
            .fold(0.0_f64, |most, p| most.max(p.length()));
        let most_mm = found.usual_mm.max(1e-9 * size).max(1e-9);
        let (reference, convention) = (found.reference.clone(), found.convention.clone());
        let renderer = Renderer::new(gpu, found.scene(most_mm))?;
        Ok(Self {
            reference,
            convention,
            found: Arc::new(found),
            most_mm,
            drawn_mm: most_mm,
            renderer,
            arrangement: None,
        })
    }

    /// The largest distance.
    pub fn largest_mm(&self) -> f64 {
        self.found.largest_mm
    }

    /// Draws with the scale that is wanted now.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn update(&mut self) -> Result<(), RenderError> {
        if self.drawn_mm == self.most_mm {
            return Ok(());
        }
        self.drawn_mm = self.most_mm;
        for k in 0..self.found.parts.len() {
            self.renderer.set_part(k, self.found.part(k, self.most_mm))?;
        }
        Ok(())
    }
}

impl Distances {
    fn scene(&self, most_mm: f64) -> Scene {
        let instance = |part: usize| Instance {
            part,
            node: Some(part),
            transform: Default::default(),
            color: None,
            is_shown: true,
            closes: None,
        };
        let count = self.parts.len();
        Scene {
            parts: (0..count).map(|k| self.part(k, most_mm)).collect(),
            instances: (0..count).map(instance).collect(),
            ..Scene::default()
        }
    }

    /// Triangles cut along lines of equal distance, each band with its colour.
    fn part(&self, instance: usize, most_mm: f64) -> ScenePart {
        let all: Vec<Vec<Band>> =
            self.parts[instance].par_iter().map(|face| face.bands(most_mm / BANDS as f64)).collect();
        let mut lists = Vec::new();
        for k in 0..BANDS {
            let [r, g, b] = heat((k as f64 + 0.5) / BANDS as f64).map(|c| f32::from(c) / 255.0);
            let bands: Vec<&Band> =
                all.iter().map(|bands| &bands[k]).filter(|b| !b.points.is_empty()).collect();
            let Some(first) = bands.first() else { continue };
            let origin = first.points[0];
            let mut own = Triangles { origin, ..Triangles::default() };
            for band in bands {
                own.positions.extend(band.points.iter().map(|p| *p - origin));
                own.normals.extend(&band.normals);
            }
            own.triangles =
                (0..own.positions.len() as u32 / 3).map(|t| [0, 1, 2].map(|c| 3 * t + c)).collect();
            lists.push((own, Rgba::opaque(r, g, b)));
        }
        ScenePart::of_triangles("deviation", lists)
    }
}

/// Triangles of a band, three places each.
#[derive(Clone, Debug, Default)]
struct Band {
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
}

/// A corner of what is left of a triangle: place, normal, distance.
type Corner = (DVec3, DVec3, f64);

impl Measured {
    /// The triangles by their distances, which grow by `step_mm` from band to band; the last holds all that is farther.
    fn bands(&self, step_mm: f64) -> Vec<Band> {
        let mut out = vec![Band::default(); BANDS];
        let band = |distance: f64| ((distance / step_mm) as usize).min(BANDS - 1);
        for triangle in &self.triangles {
            let corners: Vec<Corner> = triangle
                .iter()
                .map(|&k| (self.points[k as usize], self.normals[k as usize], self.distances[k as usize]))
                .collect();
            let low = corners.iter().map(|c| c.2).fold(f64::INFINITY, f64::min);
            let high = corners.iter().map(|c| c.2).fold(0.0, f64::max);
            let mut rest = corners;
            let wanted = band(low)..=band(high);
            for (k, band) in out.iter_mut().enumerate().filter(|(k, _)| wanted.contains(k)) {
                let end = if k + 1 < BANDS { (k + 1) as f64 * step_mm } else { f64::INFINITY };
                let (inside, beyond) = split(&rest, end);
                for c in 1..inside.len().saturating_sub(1) {
                    for corner in [&inside[0], &inside[c], &inside[c + 1]] {
                        band.points.push(corner.0);
                        band.normals.push(corner.1);
                    }
                }
                rest = beyond;
            }
        }
        out
    }
}

/// A convex polygon cut where the distance is `at`: what is nearer, and what is farther.
fn split(polygon: &[Corner], at: f64) -> (Vec<Corner>, Vec<Corner>) {
    let (mut nearer, mut farther) = (Vec::new(), Vec::new());
    for (k, a) in polygon.iter().enumerate() {
        let b = &polygon[(k + 1) % polygon.len()];
        if a.2 < at {
            nearer.push(*a)
        } else {
            farther.push(*a)
        }
        if (a.2 < at) != (b.2 < at) {
            let share = (at - a.2) / (b.2 - a.2);
            let between = (a.0.lerp(b.0, share), a.1.lerp(b.1, share), at);
            nearer.push(between);
            farther.push(between);
        }
    }
    (nearer, farther)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(bands: &[Band]) -> f64 {
        let one = |p: &[DVec3]| 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
        bands.iter().flat_map(|band| band.points.chunks_exact(3)).map(one).sum()
    }

    #[test]
    fn divided_triangles_have_short_sides_and_the_same_area() {
        let mut points = vec![DVec3::ZERO, DVec3::X * 10.0, DVec3::Y];
        let mut normals = vec![DVec3::Z; 3];
        let triangles = divide(&mut points, &mut normals, &[[0, 1, 2]], 0.7);
        let mut area = 0.0;
        for t in &triangles {
            let [a, b, c] = t.map(|k| points[k as usize]);
            area += 0.5 * (b - a).cross(c - a).z;
            assert!(a.distance(b) <= 0.7 && b.distance(c) <= 0.7 && c.distance(a) <= 0.7);
        }
        assert!((area - 5.0).abs() < 1e-12);
        assert_eq!(points.len(), normals.len());
    }

    #[test]
    fn bands_cover_the_triangle_and_end_at_their_distances() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let points = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)];
        let own = Measured {
            normals: vec![DVec3::Z; 3],
            distances: points.iter().map(|p| p.x).collect(),
            points,
            triangles: vec![[0, 1, 2]],
        };
        let bands = own.bands(1.0 / BANDS as f64);
        assert!((area(&bands) - 0.5).abs() < 1e-12);
        for (k, band) in bands.iter().enumerate() {
            let (low, high) = (k as f64 / BANDS as f64, (k + 1) as f64 / BANDS as f64);
            assert!(band.points.iter().all(|p| p.x > low - 1e-12 && p.x < high + 1e-12), "{k}");
        }
        // What is farther than the scale goes is in the last band.
        let far = own.bands(0.1 / BANDS as f64);
        assert!((area(&far) - 0.5).abs() < 1e-12);
        assert!(!far[BANDS - 1].points.is_empty());
    }
}
