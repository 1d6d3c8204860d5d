//! The smallest distance of points, segments and triangles, which stand for vertices, edges and faces.

use glam::{DVec2, DVec3};

/// A point, a segment or a triangle, of some element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex {
    /// The corners; those that there are not repeat the first.
    pub corners: [DVec3; 3],
    /// How many corners there are, 1 to 3.
    pub count: u8,
    /// Whose samples these are.
    pub element: u32,
    /// The element's parameters at the corners.
    pub parameters: [DVec2; 3],
}

/// Two nearest places, each as weights of its simplex' corners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub distance: f64,
    pub weights: [[f64; 3]; 2],
}

impl Simplex {
    /// A single point.
    pub fn point(point: DVec3, element: u32) -> Self {
        Self { corners: [point; 3], count: 1, element, parameters: [DVec2::ZERO; 3] }
    }

    /// Where some weights of the corners are.
    pub fn at(&self, [a, b, c]: [f64; 3]) -> DVec3 {
        self.corners[0] * a + self.corners[1] * b + self.corners[2] * c
    }

    /// The parameters there.
    pub fn parameters_at(&self, [a, b, c]: [f64; 3]) -> DVec2 {
        self.parameters[0] * a + self.parameters[1] * b + self.parameters[2] * c
    }

    /// Length or area (1 for a point): what the simplex counts for in a mean.
    pub fn measure(&self) -> f64 {
        let [a, b, c] = self.corners;
        match self.count {
            1 => 1.0,
            2 => a.distance(b),
            _ => (b - a).cross(c - a).length() * 0.5,
        }
    }

    fn sides(&self) -> &'static [[usize; 2]] {
        match self.count {
            1 => &[[0, 0]],
            2 => &[[0, 1]],
            _ => &[[0, 1], [1, 2], [2, 0]],
        }
    }
}

/// The nearest places of two simplices; distance 0 where they cross.
pub(crate) fn nearest(a: &Simplex, b: &Simplex) -> Nearest {
    let mut best = Nearest { distance: f64::INFINITY, weights: [[1.0, 0.0, 0.0]; 2] };
    let mut offer = |wa: [f64; 3], wb: [f64; 3]| {
        let distance = a.at(wa).distance(b.at(wb));
        if distance < best.distance {
            best = Nearest { distance, weights: [wa, wb] };
        }
    };
    for &[i, j] in a.sides() {
        for &[k, l] in b.sides() {
            let [s, t] = segments([a.corners[i], a.corners[j]], [b.corners[k], b.corners[l]]);
            offer(along(i, j, s), along(k, l, t));
        }
    }
    if b.count == 3 {
        inner(a, b, &mut |wa, wb| offer(wa, wb));
    }
    if a.count == 3 {
        inner(b, a, &mut |wb, wa| offer(wa, wb));
    }
    best
}

fn along(i: usize, j: usize, s: f64) -> [f64; 3] {
    let mut weights = [0.0; 3];
    weights[i] += 1.0 - s;
    weights[j] += s;
    weights
}

/// Offers what lies inside of the triangle: the feet of the other's corners, and where its sides go through.
fn inner(other: &Simplex, triangle: &Simplex, offer: &mut impl FnMut([f64; 3], [f64; 3])) {
    let [a, b, c] = triangle.corners;
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    if !(square > 0.0) {
        return;
    }
    let weights = |p: DVec3| {
        let ap = p - a;
        let (x, y) = (ap.cross(ac).dot(normal) / square, ab.cross(ap).dot(normal) / square);
        (x >= 0.0 && y >= 0.0 && x + y <= 1.0).then_some([1.0 - x - y, x, y])
    };
    for i in 0..other.count as usize {
        if let Some(foot) = weights(other.corners[i]) {
            offer(along(i, i, 0.0), foot);
        }
    }
    for &[i, j] in other.sides().iter().filter(|[i, j]| i != j) {
        let [from, to] = [other.corners[i], other.corners[j]].map(|p| (p - a).dot(normal));
        if from * to < 0.0 {
            let s = from / (from - to);
            if let Some(hit) = weights(other.corners[i].lerp(other.corners[j], s)) {
                offer(along(i, j, s), hit);
            }
        }
    }
}

/// The shares at which two segments are nearest (Ericson, Real-Time Collision Detection, 5.1.9).
fn segments([p, p_end]: [DVec3; 2], [q, q_end]: [DVec3; 2]) -> [f64; 2] {
    let (d, e, r) = (p_end - p, q_end - q, p - q);
    let (dd, ee) = (d.length_squared(), e.length_squared());
    let (dr, er) = (d.dot(r), e.dot(r));
    if dd <= 0.0 {
        let t = if ee > 0.0 { (er / ee).clamp(0.0, 1.0) } else { 0.0 };
        return [0.0, t];
    }
    if ee <= 0.0 {
        return [(-dr / dd).clamp(0.0, 1.0), 0.0];
    }
    let de = d.dot(e);
    let denominator = dd * ee - de * de;
    let s =
        if denominator > 1e-14 * dd * ee { ((de * er - dr * ee) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let t = (de * s + er) / ee;
    if t < 0.0 {
        [(-dr / dd).clamp(0.0, 1.0), 0.0]
    } else if t > 1.0 {
        [((de - dr) / dd).clamp(0.0, 1.0), 1.0]
    } else {
        [s, t]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [DVec3; 3]) -> Simplex {
        Simplex { corners, count: 3, element: 0, parameters: [DVec2::ZERO; 3] }
    }

    #[test]
    fn a_corner_above_the_inside() {
        let flat = triangle([DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0]);
        let tip = DVec3::new(1.0, 1.0, 2.0);
        let above = triangle([tip, tip + DVec3::new(1.0, 0.0, 1.0), tip + DVec3::new(0.0, 1.0, 1.0)]);
        let found = nearest(&above, &flat);
        assert_eq!(found.distance, 2.0);
        assert_eq!(above.at(found.weights[0]), tip);
        assert!(flat.at(found.weights[1]).distance(DVec3::new(1.0, 1.0, 0.0)) < 1e-15);
    }

    #[test]
    fn a_segment_through_a_triangle() {
        let flat = triangle([DVec3::ZERO, DVec3::X, DVec3::Y]);
        let (low, high) = (DVec3::new(0.2, 0.3, -1.0), DVec3::new(0.2, 0.3, 3.0));
        let through = Simplex { count: 2, ..triangle([low, high, low]) };
        assert!(nearest(&flat, &through).distance < 1e-15);
    }

    #[test]
    fn sides_against_sampled_points() {
        let a = triangle([DVec3::new(0.3, 0.1, 2.0), DVec3::new(2.0, 1.5, 1.4), DVec3::new(-1.0, 1.1, 1.7)]);
        let b =
            triangle([DVec3::new(0.5, 3.1, 0.2), DVec3::new(2.5, -1.5, 0.9), DVec3::new(-2.0, -1.1, 0.1)]);
        let found = nearest(&a, &b).distance;
        let grid = |s: &Simplex| -> Vec<DVec3> {
            let shares = (0..=60).flat_map(|i| (0..=60 - i).map(move |j| (i, j)));
            shares.map(|(i, j)| [i, j, 60 - i - j].map(|k| f64::from(k) / 60.0)).map(|w| s.at(w)).collect()
        };
        let (left, right) = (grid(&a), grid(&b));
        let pairs = left.iter().flat_map(|p| right.iter().map(move |q| p.distance(*q)));
        let least = pairs.fold(f64::INFINITY, f64::min);
        assert!(found <= least && least - found < 0.02, "{found} {least}");
    }
}
