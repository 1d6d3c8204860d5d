//! How triangles hang together.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use serde::Serialize;

use crate::triangles::Triangles;

/// How triangles hang together; whoever wants to print or to mill wants zeros and whole numbers here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Topology {
    /// Triangles.
    pub triangles: usize,
    /// Points.
    pub points: usize,
    /// Pieces that hang together by edges.
    pub components: usize,
    /// Components without open edges.
    pub closed_components: usize,
    /// Edges of one triangle only.
    pub open_edges: usize,
    /// Rings of open edges.
    pub holes: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges that two triangles run along in the same direction: one of them is turned over.
    pub flipped_edges: usize,
    /// Triangles of no area.
    pub degenerate_triangles: usize,
    /// Triangles on the same three points as another one.
    pub duplicate_triangles: usize,
    /// Edges at which the surface folds back onto itself.
    pub folded_edges: usize,
    /// Tunnels through closed components, all of them together (their genus).
    pub genus: usize,
}

impl Topology {
    /// Whether every edge has its two triangles, facing the same side.
    pub fn is_watertight(&self) -> bool {
        self.triangles > 0 && self.open_edges == 0 && self.non_manifold_edges == 0 && self.flipped_edges == 0
    }
}

/// The triangles along an edge.
#[derive(Clone, Copy, Default)]
struct Sides {
    /// How many run along it upwards and downwards (by the numbers of its points).
    up: u32,
    down: u32,
    /// The first two.
    first: u32,
    second: u32,
}

/// Sides that meet at less than this angle, about 2.5 degrees, are folded back.
const FOLD_COSINE: f64 = -0.999;

/// Looks at welded triangles.
pub fn topology(mesh: &Triangles) -> Topology {
    let mut out = Topology { triangles: mesh.triangles.len(), ..Topology::default() };
    let mut edges: FxHashMap<(u32, u32), Sides> =
        FxHashMap::with_capacity_and_hasher(mesh.triangles.len() * 3 / 2, Default::default());
    let mut known: FxHashSet<[u32; 3]> = FxHashSet::default();
    let mut used = vec![false; mesh.points.len()];
    let size = mesh.bounds().diagonal();
    let mut groups = Groups::new(mesh.triangles.len());
    for (index, t) in mesh.triangles.iter().enumerate() {
        t.iter().for_each(|&p| used[p as usize] = true);
        let longest = (0..3)
            .map(|k| mesh.points[t[k] as usize].distance(mesh.points[t[(k + 1) % 3] as usize]))
            .fold(0.0, f64::max);
        let height = 2.0 * mesh.area_vector(index).length() / longest.max(f64::MIN_POSITIVE);
        let mut sorted = *t;
        sorted.sort_unstable();
        let has_area = height > 1e-12 * size && sorted[0] != sorted[1] && sorted[1] != sorted[2];
        out.degenerate_triangles += usize::from(!has_area);
        if sorted[0] == sorted[1] || sorted[1] == sorted[2] {
            // A line or a point: its sides cancel out, or would seem open.
            continue;
        }
        out.duplicate_triangles += usize::from(!known.insert(sorted));
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            let sides = edges.entry((a.min(b), a.max(b))).or_default();
            match sides.up + sides.down {
                0 => sides.first = index as u32,
                n => {
                    if n == 1 {
                        sides.second = index as u32;
                    }
                    groups.join(sides.first, index as u32);
                }
            }
            *(if a < b { &mut sides.up } else { &mut sides.down }) += 1;
        }
    }
    out.points = used.iter().filter(|used| **used).count();
    let mut open_at: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    let mut is_open = vec![false; mesh.triangles.len()];
    let mut edges_of: FxHashMap<u32, usize> = FxHashMap::default();
    for (&(a, b), sides) in &edges {
        let root = groups.root(sides.first);
        *edges_of.entry(root).or_default() += 1;
        match sides.up + sides.down {
            1 => {
                out.open_edges += 1;
                is_open[root as usize] = true;
                open_at.entry(a).or_default().push(b);
                open_at.entry(b).or_default().push(a);
            }
            2 => {
                out.flipped_edges += usize::from(sides.up != 1);
                let normals = [sides.first, sides.second].map(|t| mesh.area_vector(t as usize));
                let same_way = if sides.up == 1 { 1.0 } else { -1.0 };
                out.folded_edges += usize::from(cosine(normals[0], normals[1]) * same_way < FOLD_COSINE);
            }
            _ => out.non_manifold_edges += 1,
        }
    }
    out.holes = rings(&open_at);
    let mut faces_of: FxHashMap<u32, usize> = FxHashMap::default();
    let mut points_of: FxHashMap<u32, FxHashSet<u32>> = FxHashMap::default();
    for (index, t) in mesh.triangles.iter().enumerate() {
        if t[0] == t[1] || t[1] == t[2] || t[2] == t[0] {
            continue;
        }
        let root = groups.root(index as u32);
        *faces_of.entry(root).or_default() += 1;
        if !is_open[root as usize] {
            let points = points_of.entry(root).or_default();
            points.extend(t);
        }
    }
    out.components = faces_of.len();
    out.closed_components = points_of.len();
    for (root, points) in &points_of {
        let euler = points.len() as i64 - edges_of[root] as i64 + faces_of[root] as i64;
        out.genus += ((2 - euler).max(0) / 2) as usize;
    }
    out
}

fn cosine(a: DVec3, b: DVec3) -> f64 {
    let scale = a.length() * b.length();
    if scale > 0.0 { a.dot(b) / scale } else { 1.0 }
}

/// How many rings open edges form (pieces that hang together, where more than two meet at a point).
fn rings(open_at: &FxHashMap<u32, Vec<u32>>) -> usize {
    let mut seen: FxHashSet<u32> = FxHashSet::default();
    let mut rings = 0;
    for &start in open_at.keys() {
        if !seen.insert(start) {
            continue;
        }
        rings += 1;
        let mut stack = vec![start];
        while let Some(at) = stack.pop() {
            stack.extend(open_at[&at].iter().copied().filter(|&next| seen.insert(next)));
        }
    }
    rings
}

/// Sets of triangles (union-find).
struct Groups(Vec<u32>);

impl Groups {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn root(&mut self, mut at: u32) -> u32 {
        while self.0[at as usize] != at {
            self.0[at as usize] = self.0[self.0[at as usize] as usize];
            at = self.0[at as usize];
        }
        at
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron, all sides outwards.
    fn tetrahedron() -> Triangles {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        Triangles { points, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], pieces: Vec::new() }
    }

    #[test]
    fn a_closed_body() {
        let found = topology(&tetrahedron());
        assert!(found.is_watertight());
        assert_eq!((found.components, found.closed_components, found.genus, found.holes), (1, 1, 0, 0));
    }

    #[test]
    fn a_missing_and_a_flipped_side() {
        let mut open = tetrahedron();
        open.triangles.pop();
        let found = topology(&open);
        assert_eq!((found.open_edges, found.holes, found.closed_components), (3, 1, 0));
        let mut flipped = tetrahedron();
        flipped.triangles[2].swap(0, 1);
        assert_eq!(topology(&flipped).flipped_edges, 3);
    }

    #[test]
    fn folds_duplicates_and_degenerate_triangles() {
        let points =
            vec![DVec3::ZERO, DVec3::X, DVec3::new(0.3, 1.0, 0.0), DVec3::new(0.6, 0.9, 0.0), DVec3::X * 2.0];
        let triangles = vec![[0, 1, 2], [1, 0, 3], [0, 1, 4], [2, 0, 1]];
        let found = topology(&Triangles { points, triangles, pieces: Vec::new() });
        assert_eq!((found.degenerate_triangles, found.duplicate_triangles), (1, 1));
        let mut folded = Triangles {
            points: tetrahedron().points,
            triangles: vec![[0, 1, 2], [1, 0, 3]],
            pieces: Vec::new(),
        };
        folded.points[3] = DVec3::new(0.2, 0.8, 0.0);
        assert_eq!(topology(&folded).folded_edges, 1);
    }

    #[test]
    fn a_ring_has_a_tunnel() {
        // Triangles on a torus of 8 by 6 points.
        let (n, m) = (8u32, 6u32);
        let at = |i: u32, j: u32| (i % n) * m + j % m;
        let place = |i: u32, j: u32| {
            let (u, v) =
                (f64::from(i) * std::f64::consts::TAU / 8.0, f64::from(j) * std::f64::consts::TAU / 6.0);
            DVec3::new((3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin())
        };
        let points = (0..n).flat_map(|i| (0..m).map(move |j| place(i, j))).collect();
        let triangles = (0..n)
            .flat_map(|i| {
                (0..m).flat_map(move |j| {
                    [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
                })
            })
            .collect();
        let found = topology(&Triangles { points, triangles, pieces: Vec::new() });
        assert!(found.is_watertight());
        assert_eq!(found.genus, 1);
    }
}
