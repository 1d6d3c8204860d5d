//! Area, volume, centroid and moments: integrals over triangles, or over the exact surface that they stand for.

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;
use serde::Serialize;

use crate::rim::Rim;
use crate::shape::{Placed, Shape};

/// What a shape measures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Area.
    pub area_mm2: f64,
    /// Volume inside; means something where the shape closes.
    pub volume_mm3: f64,
    /// Centroid of the area.
    pub area_centroid_mm: [f64; 3],
    /// Centroid of the volume.
    pub volume_centroid_mm: [f64; 3],
    /// Principal moments of the area about its centroid, mm⁴, the least first.
    pub area_moments_mm4: [f64; 3],
    /// Principal moments of inertia of the volume about its centroid (density 1), mm⁵, the least first.
    pub volume_moments_mm5: [f64; 3],
    /// Lower and upper corner.
    pub bbox_mm: [[f64; 3]; 2],
}

/// Sums over pieces of surface, about an origin of their own.
#[derive(Clone, Copy, Debug)]
struct Sums {
    area: f64,
    area_first: DVec3,
    area_second: DMat3,
    volume: f64,
    volume_first: DVec3,
    volume_second: DMat3,
}

/// Points and weights that integrate polynomials up to degree 5 over a triangle (Dunavant 1985).
const RULE: [([f64; 3], f64); 7] = {
    const A: f64 = 0.470_142_064_105_115_1;
    const B: f64 = 0.101_286_507_323_456_34;
    const C: f64 = 1.0 - 2.0 * A;
    const D: f64 = 1.0 - 2.0 * B;
    const WA: f64 = 0.132_394_152_788_506_2;
    const WB: f64 = 0.125_939_180_544_827_15;
    const T: f64 = 1.0 / 3.0;
    [
        ([T, T, T], 0.225),
        ([C, A, A], WA),
        ([A, C, A], WA),
        ([A, A, C], WA),
        ([D, B, B], WB),
        ([B, D, B], WB),
        ([B, B, D], WB),
    ]
};

impl Sums {
    /// Of nothing (a matrix is the identity by default).
    const ZERO: Self = Self {
        area: 0.0,
        area_first: DVec3::ZERO,
        area_second: DMat3::ZERO,
        volume: 0.0,
        volume_first: DVec3::ZERO,
        volume_second: DMat3::ZERO,
    };

    /// Adds a place with its vector of area (divergence theorem: volumes become integrals over the surface).
    fn add(&mut self, p: DVec3, vector: DVec3) {
        self.add_signed(p, vector, vector.length());
    }

    /// The same with an area that may count against the rest.
    fn add_signed(&mut self, p: DVec3, vector: DVec3, area: f64) {
        self.area += area;
        self.area_first += p * area;
        self.area_second += outer(p, p) * area;
        self.volume += p.dot(vector) / 3.0;
        self.volume_first += p * p * vector * 0.5;
        let squares = p * p * p * vector / 3.0;
        // Each product of two different coordinates from both directions, to treat them alike.
        let product = |i: usize, j: usize| 0.25 * p[i] * p[j] * (p[i] * vector[i] + p[j] * vector[j]);
        let (xy, yz, zx) = (product(0, 1), product(1, 2), product(2, 0));
        self.volume_second += DMat3::from_cols(
            DVec3::new(squares.x, xy, zx),
            DVec3::new(xy, squares.y, yz),
            DVec3::new(zx, yz, squares.z),
        );
    }

    fn merged(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            area_first: self.area_first + other.area_first,
            area_second: self.area_second + other.area_second,
            volume: self.volume + other.volume,
            volume_first: self.volume_first + other.volume_first,
            volume_second: self.volume_second + other.volume_second,
        }
    }
}

/// Measures a shape: over the exact surface where there is one.
pub fn figures(shape: &Shape) -> Figures {
    let bounds = shape.triangles.bounds();
    let origin = if bounds.is_empty() { DVec3::ZERO } else { bounds.center() };
    let sums = sums_of(shape, origin, true);
    let (area_centroid, area_moments) = moments(sums.area, sums.area_first, sums.area_second);
    let (volume_centroid, volume_moments) = moments(sums.volume, sums.volume_first, sums.volume_second);
    Figures {
        area_mm2: sums.area,
        volume_mm3: sums.volume,
        area_centroid_mm: (area_centroid + origin).to_array(),
        volume_centroid_mm: (volume_centroid + origin).to_array(),
        area_moments_mm4: area_moments,
        volume_moments_mm5: volume_moments,
        bbox_mm: if bounds.is_empty() {
            Default::default()
        } else {
            [bounds.min.to_array(), bounds.max.to_array()]
        },
    }
}

/// The area of every patch.
pub fn patch_areas(shape: &Shape) -> Vec<f64> {
    let mut areas = vec![0.0; shape.patches.len()];
    let mut of = vec![Vec::new(); shape.patches.len()];
    for (triangle, &patch) in shape.patch_of.iter().enumerate() {
        of[patch as usize].push(triangle);
    }
    of.par_iter()
        .map(|triangles| {
            let mut sums = Sums::ZERO;
            triangles
                .iter()
                .for_each(|&triangle| add_triangle(shape, triangle, DVec3::ZERO, true, &mut sums));
            sums.area
        })
        .collect_into_vec(&mut areas);
    for rim in &shape.rims {
        let mut sums = Sums::ZERO;
        add_rim(shape, rim, DVec3::ZERO, &mut sums);
        areas[shape.patch_of[rim.triangle as usize] as usize] += sums.area;
    }
    areas
}

fn sums_of(shape: &Shape, origin: DVec3, exact: bool) -> Sums {
    // In equal portions, so that the sums do not depend on the number of threads.
    let portions: Vec<Sums> = (0..shape.triangles.triangles.len().div_ceil(4096))
        .into_par_iter()
        .map(|portion| {
            let mut sums = Sums::ZERO;
            let end = (portion * 4096 + 4096).min(shape.triangles.triangles.len());
            (portion * 4096..end)
                .for_each(|triangle| add_triangle(shape, triangle, origin, exact, &mut sums));
            sums
        })
        .collect();
    let rims: Vec<Sums> = shape
        .rims
        .par_chunks(1024)
        .filter(|_| exact)
        .map(|rims| {
            let mut sums = Sums::ZERO;
            rims.iter().for_each(|rim| add_rim(shape, rim, origin, &mut sums));
            sums
        })
        .collect();
    portions.into_iter().chain(rims).fold(Sums::ZERO, Sums::merged)
}

fn add_triangle(shape: &Shape, triangle: usize, origin: DVec3, exact: bool, sums: &mut Sums) {
    let [a, b, c] = shape.triangles.corners(triangle);
    let flat = shape.triangles.area_vector(triangle);
    let surface = shape.patch(triangle as u32).surface.as_ref().filter(|_| exact);
    let Some((surface, &[ua, ub, uc])) = surface.zip(shape.uv.get(triangle)) else {
        for ([wa, wb, wc], weight) in RULE {
            sums.add(a * wa + b * wb + c * wc - origin, flat * weight);
        }
        return;
    };
    if let Some((pole, constant)) = shape.pole(triangle) {
        return add_fan(surface, shape.uv[triangle], pole, constant, origin, sums);
    }
    let sign = if surface.outwards { 1.0 } else { -1.0 };
    for [ua, ub, uc] in smooth_pieces([ua, ub, uc], &surface.breaks) {
        // The signs of the area in parameters and of the surface's normal belong together: only their product counts.
        let area = ((ub - ua).perp_dot(uc - ua) * 0.5).abs();
        for ([wa, wb, wc], weight) in RULE {
            let d = surface.derivatives(ua * wa + ub * wb + uc * wc);
            sums.add(d.point - origin, d.du.cross(d.dv) * (sign * area * weight));
        }
    }
}

/// A triangle in parameters, cut where the surface's derivatives may jump: rules of integration want none inside.
fn smooth_pieces(triangle: [DVec2; 3], breaks: &[Vec<f64>; 2]) -> Vec<[DVec2; 3]> {
    let mut pieces = vec![triangle.to_vec()];
    for (k, breaks) in breaks.iter().enumerate() {
        let range = |corners: &[DVec2]| {
            corners.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |r, c| [r[0].min(c[k]), r[1].max(c[k])])
        };
        let [low, high] = range(&triangle);
        let margin = 1e-9 * (high - low);
        let from = breaks.partition_point(|&at| at <= low + margin);
        for &at in breaks[from..].iter().take_while(|&&at| at < high - margin) {
            pieces = pieces.iter().flat_map(|corners| cut(corners, k, at)).collect();
        }
    }
    pieces
        .iter()
        .flat_map(|corners| (2..corners.len()).map(|c| [corners[0], corners[c - 1], corners[c]]))
        .collect()
}

/// The two sides of a convex polygon, or the one that there is.
fn cut(corners: &[DVec2], k: usize, at: f64) -> Vec<Vec<DVec2>> {
    let mut sides = [Vec::new(), Vec::new()];
    for (index, &a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        if a[k] <= at {
            sides[0].push(a);
        }
        if a[k] >= at {
            sides[1].push(a);
        }
        if (a[k] < at && b[k] > at) || (a[k] > at && b[k] < at) {
            let crossing = a.lerp(b, (at - a[k]) / (b[k] - a[k]));
            sides.iter_mut().for_each(|side| side.push(crossing));
        }
    }
    sides.into_iter().filter(|side| side.len() > 2).collect()
}

/// The sliver between a chord and its edge: added where it lies beyond the triangle, taken off where it lies in it.
fn add_rim(shape: &Shape, rim: &Rim, origin: DVec3, sums: &mut Sums) {
    let triangle = rim.triangle as usize;
    let Some(surface) = &shape.patch(rim.triangle).surface else { return };
    let uv = shape.uv[triangle];
    let side = rim.side as usize;
    let (mut a, mut b, mut inner) = (uv[side], uv[(side + 1) % 3], uv[(side + 2) % 3]);
    // The free parameter of a pole says nothing of the side that it lies on.
    if let Some((k, constant)) = shape.pole(triangle) {
        let free = 1 - constant;
        match (k + 3 - side) % 3 {
            0 => a[free] = b[free],
            1 => b[free] = a[free],
            _ => inner[free] = 0.5 * (a + b)[free],
        }
    }
    let turn = (b - a).perp_dot(inner - a).signum();
    let sign = if surface.outwards { 1.0 } else { -1.0 };
    for (s, ws) in GAUSS {
        let (off, slope) = rim.off_at(s);
        for (r, wr) in GAUSS {
            let jacobian = (b - a + slope * r).perp_dot(off) * -turn * ws * wr;
            let d = surface.derivatives(a.lerp(b, s) + off * r);
            let cross = d.du.cross(d.dv);
            sums.add_signed(d.point - origin, cross * (sign * jacobian), cross.length() * jacobian);
        }
    }
}

/// Points and weights of Gauss' rule of five points over 0..1.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// A triangle with a corner at a pole: in parameters, all between its opposite side and the pole.
fn add_fan(surface: &Placed, uv: [DVec2; 3], pole: usize, constant: usize, origin: DVec3, sums: &mut Sums) {
    let (a, b) = (uv[(pole + 1) % 3], uv[(pole + 2) % 3]);
    let at = uv[pole][constant];
    for (s, ws) in GAUSS {
        let base = a.lerp(b, s);
        let mut top = base;
        top[constant] = at;
        for (t, wt) in GAUSS {
            // Along the side and towards the pole.
            let along = {
                let mut along = b - a;
                along[constant] *= 1.0 - t;
                along
            };
            let area = along.perp_dot(top - base).abs();
            let d = surface.derivatives(base.lerp(top, t));
            let sign = if surface.outwards { 1.0 } else { -1.0 };
            sums.add(d.point - origin, d.du.cross(d.dv) * (sign * area * ws * wt));
        }
    }
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The centroid, and the principal moments of inertia about it.
fn moments(mass: f64, first: DVec3, second: DMat3) -> (DVec3, [f64; 3]) {
    if mass == 0.0 || !mass.is_finite() {
        return (DVec3::ZERO, [0.0; 3]);
    }
    let centroid = first / mass;
    let central = second - outer(centroid, centroid) * mass;
    let trace = central.x_axis.x + central.y_axis.y + central.z_axis.z;
    let inertia = DMat3::from_diagonal(DVec3::splat(trace)) - central;
    let mut values = eigenvalues(inertia);
    values.sort_unstable_by(f64::total_cmp);
    (centroid, values)
}

/// The eigenvalues of a symmetric matrix (Jacobi's rotations).
fn eigenvalues(mut m: DMat3) -> [f64; 3] {
    for _ in 0..32 {
        let off = [(0, 1, m.y_axis.x), (0, 2, m.z_axis.x), (1, 2, m.z_axis.y)];
        let (p, q, value) =
            off.into_iter().max_by(|a, b| a.2.abs().total_cmp(&b.2.abs())).unwrap_or((0, 1, 0.0));
        let scale = m.x_axis.x.abs().max(m.y_axis.y.abs()).max(m.z_axis.z.abs());
        if value.abs() <= 1e-15 * scale {
            break;
        }
        let theta = (m.col(q)[q] - m.col(p)[p]) / (2.0 * value);
        let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
        let t = if theta == 0.0 { 1.0 } else { t };
        let c = 1.0 / (t * t + 1.0).sqrt();
        let s = t * c;
        let mut rotation = DMat3::IDENTITY;
        rotation.col_mut(p)[p] = c;
        rotation.col_mut(q)[q] = c;
        rotation.col_mut(q)[p] = s;
        rotation.col_mut(p)[q] = -s;
        m = rotation.transpose() * m * rotation;
    }
    [m.x_axis.x, m.y_axis.y, m.z_axis.z]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::triangles::Triangles;

    /// A block from `at`, facing outwards.
    fn block(at: DVec3, size: DVec3) -> Shape {
        let points =
            (0..8).map(|k| at + size * DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Shape::of_mesh(Triangles { points: points.collect(), triangles, pieces: Vec::new() })
    }

    #[test]
    fn a_block_in_closed_form() {
        let size = DVec3::new(2.0, 3.0, 5.0);
        let found = figures(&block(DVec3::new(100.0, -50.0, 7.0), size));
        assert!((found.area_mm2 - 62.0).abs() < 1e-10);
        assert!((found.volume_mm3 - 30.0).abs() < 1e-10);
        let center = DVec3::new(101.0, -48.5, 9.5);
        assert!(DVec3::from_array(found.volume_centroid_mm).distance(center) < 1e-10);
        assert!(DVec3::from_array(found.area_centroid_mm).distance(center) < 1e-10);
        let moment = |a: f64, b: f64| 30.0 / 12.0 * (a * a + b * b);
        let expected = [moment(2.0, 3.0), moment(2.0, 5.0), moment(3.0, 5.0)];
        for (found, expected) in found.volume_moments_mm5.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }

    #[test]
    fn pieces_fill_the_triangle_they_are_cut_from() {
        let triangle = [DVec2::ZERO, DVec2::new(3.0, 0.5), DVec2::new(1.0, 2.5)];
        let pieces = smooth_pieces(triangle, &[vec![-1.0, 0.5, 1.0, 1.0, 7.0], vec![0.5, 2.0]]);
        let area = |[a, b, c]: [DVec2; 3]| (b - a).perp_dot(c - a) * 0.5;
        let sum: f64 = pieces.iter().map(|&piece| area(piece)).sum();
        assert!((sum - area(triangle)).abs() < 1e-12);
        let straddles = |piece: &[DVec2; 3], k: usize, at: f64| {
            piece.iter().any(|c| c[k] < at - 1e-9) && piece.iter().any(|c| c[k] > at + 1e-9)
        };
        assert!(!pieces.iter().any(|piece| straddles(piece, 0, 0.5) || straddles(piece, 1, 2.0)));
        assert_eq!(smooth_pieces(triangle, &[Vec::new(), Vec::new()]), [triangle]);
    }

    #[test]
    fn eigenvalues_of_a_turned_diagonal() {
        let turn = DMat3::from_rotation_x(0.3) * DMat3::from_rotation_z(1.1);
        let mut found =
            eigenvalues(turn * DMat3::from_diagonal(DVec3::new(1.0, 2.0, 7.0)) * turn.transpose());
        found.sort_unstable_by(f64::total_cmp);
        for (found, expected) in found.iter().zip([1.0, 2.0, 7.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
    }
}
