//! What lies between a chord of a face's boundary and the exact edge.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use trimloop_brep::Part;
use trimloop_geom::{Curve, Surface};
use trimloop_mesh::{FaceMesh, FaceVertex, PartMesh};

/// The sliver between a triangle's side and the exact edge that it is a chord of.
#[derive(Clone, Copy, Debug)]
pub struct Rim {
    /// The triangle.
    pub triangle: u32,
    /// Its side, from this corner to the next.
    pub side: u8,
    /// How far the edge is from the chord in parameters, at a quarter, a half and three quarters of the way.
    pub off: [DVec2; 3],
}

/// Where along the chord the edge is looked at.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];

impl Rim {
    /// How far the edge is from the chord at a share of the way, and how fast that changes: the polynomial of degree 4
    /// that vanishes at both ends.
    pub fn off_at(&self, s: f64) -> (DVec2, DVec2) {
        const NODES: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
        let mut value = DVec2::ZERO;
        let mut slope = DVec2::ZERO;
        for (k, off) in self.off.iter().enumerate() {
            let own = NODES[k + 1];
            let others: Vec<f64> = NODES.iter().copied().filter(|node| *node != own).collect();
            let scale: f64 = others.iter().map(|node| own - node).product();
            value += *off * (others.iter().map(|node| s - node).product::<f64>() / scale);
            let derivative: f64 = (0..others.len())
                .map(|left_out| {
                    let rest = others.iter().enumerate().filter(|(j, _)| *j != left_out);
                    rest.map(|(_, node)| s - node).product::<f64>()
                })
                .sum();
            slope += *off * (derivative / scale);
        }
        (value, slope)
    }
}

/// The chords of a part's edges: by their points, the curve and the parameters at both.
pub(crate) struct Chords<'p> {
    by_points: FxHashMap<(u32, u32), (&'p Arc<Curve>, f64, f64)>,
    positions: &'p [DVec3],
}

impl<'p> Chords<'p> {
    /// All chords of a part.
    pub fn new(part: &'p Part, mesh: &'p PartMesh) -> Self {
        let mut chords = FxHashMap::default();
        for line in &mesh.edges {
            let edge = &part.edges[line.edge as usize];
            if matches!(*edge.curve, Curve::Polyline(_)) || line.points.len() < 2 {
                continue;
            }
            let range = edge.range;
            let (first, last) =
                if edge.same_sense { (range.start, range.end) } else { (range.end, range.start) };
            let end = line.points.len() - 1;
            let mut parameters = vec![first];
            for (k, &point) in line.points.iter().enumerate().take(end).skip(1) {
                let before = parameters[k - 1];
                let guess = before + (last - before) / (end + 1 - k) as f64;
                let point = mesh.positions[point as usize];
                parameters.push(edge.curve.project_within(point, range, Some(guess)).t);
            }
            parameters.push(last);
            for (points, t) in line.points.windows(2).zip(parameters.windows(2)) {
                // A chord that two edges have in common is nobody's.
                let (a, b) = (points[0], points[1]);
                let entry = if a < b { (t[0], t[1]) } else { (t[1], t[0]) };
                chords.insert((a.min(b), a.max(b)), (&edge.curve, entry.0, entry.1));
            }
        }
        Self { by_points: chords, positions: &mesh.positions }
    }

    /// The rims of a face, its triangles numbered from `first`; corners are those of the shape's triangles.
    pub fn rims(&self, surface: &Surface, mesh: &FaceMesh, mirrored: bool, first: u32) -> Vec<Rim> {
        let poles = surface.singularities();
        let pole_at = |vertex: &FaceVertex| {
            let point = self.positions[vertex.position as usize];
            let reach = 1e-9 * (1.0 + point.abs().max_element());
            poles.iter().find(|pole| pole.point.distance(point) <= reach).map(|pole| pole.constant as usize)
        };
        let mut out = Vec::new();
        for (index, t) in mesh.triangles.iter().enumerate() {
            let mut corners = t.map(|k| mesh.vertices[k as usize]);
            if mirrored {
                corners.swap(1, 2);
            }
            for side in 0..3 {
                let (mut a, mut b) = (corners[side], corners[(side + 1) % 3]);
                let key = (a.position.min(b.position), a.position.max(b.position));
                let Some(&(curve, low, high)) = self.by_points.get(&key) else { continue };
                if matches!((&**curve, surface), (Curve::Line { .. }, Surface::Plane { .. })) {
                    continue;
                }
                // At a pole the side is where the other end's free parameter leads.
                if let Some(constant) = pole_at(&b) {
                    b.uv[1 - constant] = a.uv[1 - constant];
                } else if let Some(constant) = pole_at(&a) {
                    a.uv[1 - constant] = b.uv[1 - constant];
                }
                let (from, to) = if a.position < b.position { (low, high) } else { (high, low) };
                let off = SHARES.map(|share| {
                    let chord = a.uv.lerp(b.uv, share);
                    let point = curve.point(from + (to - from) * share);
                    surface.project(point, Some(chord)).uv - chord
                });
                // What is farther off than the chord is long is no sag, but a foot gone astray.
                let length = a.uv.distance(b.uv);
                if off.iter().all(|off| off.length() <= 0.5 * length)
                    && off.iter().any(|off| *off != DVec2::ZERO)
                {
                    out.push(Rim { triangle: first + index as u32, side: side as u8, off });
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_meets_its_nodes_and_its_slope() {
        let rim = Rim {
            triangle: 0,
            side: 0,
            off: [DVec2::new(3.0, 0.0), DVec2::new(4.0, 1.0), DVec2::new(3.0, 0.0)],
        };
        for (k, share) in SHARES.iter().enumerate() {
            assert!(rim.off_at(*share).0.distance(rim.off[k]) < 1e-12);
        }
        let h = 1e-6;
        let slope = (rim.off_at(0.3 + h).0 - rim.off_at(0.3 - h).0) / (2.0 * h);
        assert!(slope.distance(rim.off_at(0.3).1) < 1e-6);
        assert_eq!(rim.off_at(0.0).0, DVec2::ZERO);
    }
}
