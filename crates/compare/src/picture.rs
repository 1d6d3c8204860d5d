//! Pictures of shapes, drawn without a GPU: triangles into a depth buffer, colours by the caller.

use glam::DVec3;
use rayon::prelude::*;
use tiny_skia::{Pixmap, PremultipliedColorU8};
use trimloop_geom::Aabb;

use crate::distance::Target;
use crate::shape::Shape;

/// Where a picture is taken from: orthographic, +Z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From the eye into the picture.
    pub towards: DVec3,
    /// What is to be seen.
    pub bounds: Aabb,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// The triangle.
    pub triangle: u32,
    /// The place on it.
    pub point: DVec3,
    /// The triangle's normal, turned to the eye.
    pub normal: DVec3,
    /// Whether its inside is seen.
    pub inside: bool,
}

impl View {
    /// The two views that show all six sides of a box.
    pub fn pair(bounds: Aabb, width: u32, height: u32) -> [Self; 2] {
        let view = |towards: DVec3| Self { towards: towards.normalize(), bounds, width, height };
        [view(DVec3::new(-1.0, 1.6, -0.9)), view(DVec3::new(1.0, -1.6, 0.9))]
    }

    /// The picture's axes: to the right, up, into it.
    fn axes(&self) -> [DVec3; 3] {
        let right = self.towards.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        [right, right.cross(self.towards), self.towards]
    }

    /// From millimetres to pixels: the scale, and the middle of what is to be seen.
    fn frame(&self) -> (f64, DVec3) {
        let [right, up, _] = self.axes();
        let center = self.bounds.center();
        let (mut x, mut y) = (0.0f64, 0.0f64);
        for corner in self.bounds.corners() {
            x = x.max((corner - center).dot(right).abs());
            y = y.max((corner - center).dot(up).abs());
        }
        let scale =
            (0.46 * f64::from(self.width) / x.max(1e-300)).min(0.46 * f64::from(self.height) / y.max(1e-300));
        (scale, center)
    }

    /// What every pixel shows, row by row from the top.
    pub fn spots(&self, shape: &Shape) -> Vec<Option<Spot>> {
        let (width, height) = (self.width as usize, self.height as usize);
        let axes = self.axes();
        let (scale, center) = self.frame();
        let project = |p: DVec3| {
            let [x, y, z] = axes.map(|axis| (p - center).dot(axis) * scale);
            DVec3::new(x + 0.5 * width as f64, 0.5 * height as f64 - y, z)
        };
        let mut depth = vec![f64::INFINITY; width * height];
        let mut seen: Vec<(u32, f64, f64)> = vec![(u32::MAX, 0.0, 0.0); width * height];
        for triangle in 0..shape.triangles.triangles.len() {
            let [a, b, c] = shape.triangles.corners(triangle).map(project);
            let area = (b - a).truncate().perp_dot((c - a).truncate());
            if !(area.abs() > 1e-12) {
                continue;
            }
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let columns = low.x.floor().max(0.0) as usize..(high.x.ceil().max(0.0) as usize).min(width);
            for row in low.y.floor().max(0.0) as usize..(high.y.ceil().max(0.0) as usize).min(height) {
                for column in columns.clone() {
                    let p = glam::DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                    let wb = (p - a.truncate()).perp_dot((c - a).truncate()) / area;
                    let wc = (b - a).truncate().perp_dot(p - a.truncate()) / area;
                    let wa = 1.0 - wb - wc;
                    if wa < 0.0 || wb < 0.0 || wc < 0.0 {
                        continue;
                    }
                    let z = a.z * wa + b.z * wb + c.z * wc;
                    let pixel = row * width + column;
                    if z < depth[pixel] {
                        depth[pixel] = z;
                        seen[pixel] = (triangle as u32, wb, wc);
                    }
                }
            }
        }
        seen.into_iter()
            .map(|(triangle, wb, wc)| {
                (triangle != u32::MAX).then(|| {
                    let [a, b, c] = shape.triangles.corners(triangle as usize);
                    let normal = shape.triangles.area_vector(triangle as usize).normalize_or_zero();
                    let inside = normal.dot(self.towards) > 0.0;
                    let normal = if inside { -normal } else { normal };
                    Spot { triangle, point: a * (1.0 - wb - wc) + b * wb + c * wc, normal, inside }
                })
            })
            .collect()
    }
}

/// A shape in one colour, its insides in another; twice as fine as it is shown, so that edges are smooth.
pub fn shaded(shape: &Shape, view: &View, color: [u8; 3]) -> Option<Pixmap> {
    let fine = View { width: view.width * 2, height: view.height * 2, ..*view };
    let spots = fine.spots(shape);
    let inside = [205, 92, 60];
    let colors: Vec<[f64; 4]> = spots
        .iter()
        .map(|spot| match spot {
            Some(spot) => lit(if spot.inside { inside } else { color }, spot.normal, view),
            None => [0.0; 4],
        })
        .collect();
    let width = fine.width as usize;
    picture(view, |x, y| {
        let corner = 2 * y * width + 2 * x;
        let four = [corner, corner + 1, corner + width, corner + width + 1].map(|k| colors[k]);
        std::array::from_fn(|c| four.iter().map(|color| color[c]).sum::<f64>() / 4.0)
    })
}

/// A shape in the colours of its distance to another one: blue at none, green, yellow, red at `most_mm` and beyond.
pub fn heat_map(shape: &Shape, target: &Target<'_>, view: &View, most_mm: f64) -> Option<Pixmap> {
    let spots = view.spots(shape);
    let colors: Vec<[f64; 4]> = spots
        .par_chunks(1024)
        .flat_map_iter(|chunk| {
            chunk.iter().map(|spot| match spot {
                Some(spot) => {
                    let far = target
                        .nearest(spot.point, f64::INFINITY)
                        .map_or(f64::INFINITY, |(_, hit)| hit.distance);
                    lit(heat(far / most_mm.max(f64::MIN_POSITIVE)), spot.normal, view)
                }
                None => [0.0; 4],
            })
        })
        .collect();
    picture(view, |x, y| colors[y * view.width as usize + x])
}

/// The colour of a distance as a share of the largest one on the scale.
pub fn heat(share: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [48.0, 76.0, 178.0],
        [44.0, 160.0, 200.0],
        [92.0, 190.0, 90.0],
        [240.0, 200.0, 50.0],
        [205.0, 40.0, 40.0],
    ];
    let at = share.clamp(0.0, 1.0) * 4.0;
    let (k, t) = ((at as usize).min(3), at - (at as usize).min(3) as f64);
    std::array::from_fn(|c| (STOPS[k][c] + (STOPS[k + 1][c] - STOPS[k][c]) * t).round() as u8)
}

/// A colour in the light of the picture, which comes from above the eye's left shoulder.
fn lit(color: [u8; 3], normal: DVec3, view: &View) -> [f64; 4] {
    let [right, up, into] = view.axes();
    let light = (-into * 1.0 - right * 0.45 + up * 0.65).normalize();
    let strength = 0.38 + 0.62 * normal.dot(light).max(0.0);
    let [r, g, b] = color.map(|c| f64::from(c) * strength);
    [r, g, b, 255.0]
}

fn picture(view: &View, color: impl Fn(usize, usize) -> [f64; 4]) -> Option<Pixmap> {
    let mut pixmap = Pixmap::new(view.width, view.height)?;
    let width = view.width as usize;
    for (k, pixel) in pixmap.pixels_mut().iter_mut().enumerate() {
        let [r, g, b, a] = color(k % width, k / width).map(|c| c.round().clamp(0.0, 255.0) as u8);
        *pixel = PremultipliedColorU8::from_rgba(r.min(a), g.min(a), b.min(a), a)?;
    }
    Some(pixmap)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangles::Triangles;

    #[test]
    fn what_is_in_front_hides_what_is_behind() {
        let square =
            |z: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(x, y, z));
        let points = [square(0.0), square(1.0)].concat();
        let triangles = vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        let shape = Shape::of_mesh(Triangles { points, triangles, pieces: Vec::new() });
        let bounds = shape.triangles.bounds();
        let view = View { towards: DVec3::NEG_Z, bounds, width: 40, height: 40 };
        let spots = view.spots(&shape);
        let middle = spots[20 * 40 + 20].expect("something in the middle");
        assert_eq!((middle.triangle >= 2, middle.inside), (true, false));
        assert!(middle.point.distance(DVec3::Z) < 0.1);
        assert!(spots[0].is_none());
        let below = View { towards: DVec3::Z, ..view }.spots(&shape)[20 * 40 + 20].expect("something");
        assert!(below.triangle < 2 && below.inside);
    }

    #[test]
    fn the_scale_runs_from_blue_to_red() {
        assert_eq!(heat(0.0), [48, 76, 178]);
        assert_eq!(heat(5.0), [205, 40, 40]);
        assert_eq!(heat(0.5), [92, 190, 90]);
    }
}
