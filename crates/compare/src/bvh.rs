//! The nearest triangle: a hierarchy of boxes, split where that costs least (surface area heuristic).

use glam::DVec3;
use trimloop_geom::Aabb;

use crate::triangles::Triangles;

/// A hierarchy of boxes over triangles.
#[derive(Clone, Debug)]
pub struct Bvh {
    nodes: Vec<Node>,
    /// Triangles in the order of the leaves.
    order: Vec<u32>,
    /// The corners of those.
    corners: Vec<[DVec3; 3]>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    /// A leaf's first triangle, or an inner node's second child; its first one follows it.
    first: u32,
    /// How many triangles a leaf has; 0 for inner nodes.
    count: u32,
}

/// The place of some triangles that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Which triangle.
    pub triangle: u32,
    /// The place.
    pub point: DVec3,
    /// Its weights of the triangle's corners.
    pub weights: [f64; 3],
    /// Its distance.
    pub distance: f64,
}

const LEAF: usize = 4;
const BINS: usize = 16;
/// Below this, splitting in parallel costs more than it gives.
const PARALLEL: usize = 1 << 14;

impl Bvh {
    /// A hierarchy over all triangles.
    pub fn new(triangles: &Triangles) -> Self {
        let mut items: Vec<Item> = (0..triangles.triangles.len())
            .map(|index| {
                let bounds = Aabb::from_points(triangles.corners(index));
                Item { bounds, center: bounds.center(), index: index as u32 }
            })
            .collect();
        let nodes = build(&mut items, 0);
        let order: Vec<u32> = items.iter().map(|item| item.index).collect();
        let corners = order.iter().map(|&index| triangles.corners(index as usize)).collect();
        Self { nodes, order, corners }
    }

    /// The nearest place that is nearer than `limit`.
    pub fn nearest(&self, point: DVec3, limit: f64) -> Option<Hit> {
        self.nearest_of(point, limit, |_| true)
    }

    /// The nearest place that is nearer than `limit`, of those triangles that are `wanted`.
    pub fn nearest_of(&self, point: DVec3, limit: f64, wanted: impl Fn(u32) -> bool) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut most2 = if limit.is_finite() { limit * limit } else { f64::INFINITY };
        let mut stack = [(0u32, 0.0f64); 96];
        let mut height = usize::from(!self.nodes.is_empty());
        if height > 0 {
            stack[0] = (0, distance2(&self.nodes[0].bounds, point));
        }
        while height > 0 {
            height -= 1;
            let (index, away2) = stack[height];
            if away2 > most2 {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for k in node.first..node.first + node.count {
                    let (place, weights) = nearest_in_triangle(&self.corners[k as usize], point);
                    let away2 = place.distance_squared(point);
                    let is_nearer = away2 < most2 || (best.is_none() && away2 <= most2);
                    if is_nearer && wanted(self.order[k as usize]) {
                        most2 = away2;
                        let triangle = self.order[k as usize];
                        best = Some(Hit { triangle, point: place, weights, distance: 0.0 });
                    }
                }
                continue;
            }
            let near = |child: u32| (child, distance2(&self.nodes[child as usize].bounds, point));
            let (a, b) = (near(index + 1), near(node.first));
            let (near, far) = if a.1 <= b.1 { (a, b) } else { (b, a) };
            if height + 2 <= stack.len() {
                stack[height] = far;
                stack[height + 1] = near;
                height += 2;
            }
        }
        best.map(|hit| Hit { distance: most2.sqrt(), ..hit })
    }
}

struct Item {
    bounds: Aabb,
    center: DVec3,
    index: u32,
}

/// The nodes over `items`, which are put in the order of the leaves; `first` is the place of the first item.
fn build(items: &mut [Item], first: usize) -> Vec<Node> {
    let mut nodes = Vec::new();
    if !items.is_empty() {
        add(items, first, 0, &mut nodes);
    }
    nodes
}

fn add(items: &mut [Item], first: usize, depth: usize, nodes: &mut Vec<Node>) {
    let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
    let own = nodes.len();
    nodes.push(Node { bounds, first: first as u32, count: items.len() as u32 });
    if items.len() <= LEAF {
        return;
    }
    // A lopsided tree would overflow the search's stack: below some depth the middle is good enough.
    let at = if depth < 48 { cheapest_split(items) } else { items.len() / 2 };
    let (left, right) = items.split_at_mut(at);
    nodes[own].count = 0;
    if left.len().min(right.len()) > PARALLEL {
        let (a, b) =
            rayon::join(|| build_at(left, first, depth + 1), || build_at(right, first + at, depth + 1));
        append(nodes, a);
        nodes[own].first = nodes.len() as u32;
        append(nodes, b);
    } else {
        add(left, first, depth + 1, nodes);
        nodes[own].first = nodes.len() as u32;
        add(right, first + at, depth + 1, nodes);
    }
}

fn build_at(items: &mut [Item], first: usize, depth: usize) -> Vec<Node> {
    let mut nodes = Vec::new();
    add(items, first, depth, &mut nodes);
    nodes
}

fn append(nodes: &mut Vec<Node>, more: Vec<Node>) {
    let base = nodes.len() as u32;
    nodes.extend(more.into_iter().map(|node| match node.count {
        0 => Node { first: node.first + base, ..node },
        _ => node,
    }));
}

/// Sorts items into two sides and gives the size of the first: where the boxes' areas times their triangles are least.
fn cheapest_split(items: &mut [Item]) -> usize {
    let centers = Aabb::from_points(items.iter().map(|item| item.center));
    let extent = centers.max - centers.min;
    let axis = (0..3).max_by(|&a, &b| extent[a].total_cmp(&extent[b])).unwrap_or(0);
    if !(extent[axis] > 0.0) {
        return items.len() / 2;
    }
    let bin = |item: &Item| {
        (((item.center[axis] - centers.min[axis]) / extent[axis] * BINS as f64) as usize).min(BINS - 1)
    };
    let mut bins = [(Aabb::EMPTY, 0usize); BINS];
    for item in items.iter() {
        let bin = &mut bins[bin(item)];
        *bin = (bin.0.union(item.bounds), bin.1 + 1);
    }
    let mut after = [0.0; BINS];
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    for k in (1..BINS).rev() {
        (bounds, count) = (bounds.union(bins[k].0), count + bins[k].1);
        after[k] = half_area(&bounds) * count as f64;
    }
    let (mut bounds, mut count) = (Aabb::EMPTY, 0);
    let mut best = (f64::INFINITY, BINS / 2);
    for k in 1..BINS {
        (bounds, count) = (bounds.union(bins[k - 1].0), count + bins[k - 1].1);
        let cost = half_area(&bounds) * count as f64 + after[k];
        if count > 0 && count < items.len() && cost < best.0 {
            best = (cost, k);
        }
    }
    let mut at = 0;
    for k in 0..items.len() {
        if bin(&items[k]) < best.1 {
            items.swap(at, k);
            at += 1;
        }
    }
    if at == 0 || at == items.len() { items.len() / 2 } else { at }
}

fn half_area(bounds: &Aabb) -> f64 {
    if bounds.is_empty() {
        return 0.0;
    }
    let d = bounds.max - bounds.min;
    d.x * d.y + d.y * d.z + d.z * d.x
}

fn distance2(bounds: &Aabb, point: DVec3) -> f64 {
    (bounds.min - point).max(point - bounds.max).max(DVec3::ZERO).length_squared()
}

/// The place of a triangle nearest to a point, and its weights of the corners (Ericson, Real-Time Collision Detection,
/// 5.1.5: by the Voronoi regions of corners and sides).
pub fn nearest_in_triangle(&[a, b, c]: &[DVec3; 3], point: DVec3) -> (DVec3, [f64; 3]) {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, [1.0, 0.0, 0.0]);
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, [0.0, 1.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return (a + ab * t, [1.0 - t, t, 0.0]);
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, [0.0, 0.0, 1.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return (a + ac * t, [1.0 - t, 0.0, t]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (b + (c - b) * t, [0.0, 1.0 - t, t]);
    }
    let sum = va + vb + vc;
    if !(sum > 0.0) {
        return (a, [1.0, 0.0, 0.0]);
    }
    let (v, w) = (vb / sum, vc / sum);
    (a + ab * v + ac * w, [1.0 - v - w, v, w])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic numbers in 0..1.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        }
    }

    #[test]
    fn the_hierarchy_finds_what_looking_at_all_finds() {
        let mut next = numbers(7);
        let mut point = || DVec3::new(next(), next(), next());
        let mut soup = Triangles::default();
        for k in 0..500u32 {
            let at = point();
            soup.points.extend([at, at + point() * 0.1, at + point() * 0.1]);
            soup.triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        let bvh = Bvh::new(&soup);
        for _ in 0..500 {
            let p = point() * 2.0 - 0.5;
            let hit = bvh.nearest(p, f64::INFINITY).expect("a triangle");
            let all = (0..500).map(|k| nearest_in_triangle(&soup.corners(k), p).0.distance(p));
            let least = all.fold(f64::INFINITY, f64::min);
            assert!((hit.distance - least).abs() < 1e-12);
            let [a, b, c] = soup.corners(hit.triangle as usize);
            let [u, v, w] = hit.weights;
            assert!((a * u + b * v + c * w).distance(hit.point) < 1e-12);
            assert_eq!(bvh.nearest(p, least * 0.5), None);
        }
    }

    #[test]
    fn equal_triangles_and_none_at_all() {
        let mut same = Triangles { points: vec![DVec3::ZERO, DVec3::X, DVec3::Y], ..Default::default() };
        assert_eq!(Bvh::new(&same).nearest(DVec3::Z, f64::INFINITY), None);
        same.triangles = vec![[0, 1, 2]; 1000];
        assert_eq!(Bvh::new(&same).nearest(DVec3::Z, f64::INFINITY).map(|hit| hit.distance), Some(1.0));
    }
}
