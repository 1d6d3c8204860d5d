//! Keeps the promise that a face's triangles end exactly at its edges' samples.

use std::collections::{BTreeMap, HashMap};

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::FaceVertex;
use crate::draft::FaceDraft;
use crate::ear_clipping;

/// How often each pair of points is run over: forward minus backward, from the lower number to the higher.
#[derive(Default)]
pub(crate) struct NetEdges(FxHashMap<(u32, u32), i32>);

impl NetEdges {
    /// Counts one run from `a` to `b`.
    pub fn add(&mut self, [a, b]: [u32; 2], times: i32) {
        if a != b {
            let (key, sign) = if a < b { ((a, b), 1) } else { ((b, a), -1) };
            *self.0.entry(key).or_insert(0) += sign * times;
        }
    }

    /// The runs that are not balanced by opposite ones, in order.
    pub fn directed(&self) -> Vec<[u32; 2]> {
        let mut out: Vec<[u32; 2]> = Vec::new();
        for (&(a, b), &n) in &self.0 {
            let pair = if n > 0 { [a, b] } else { [b, a] };
            out.extend(std::iter::repeat_n(pair, n.unsigned_abs() as usize));
        }
        out.sort_unstable();
        out
    }
}

/// Adds the triangles that `draft` lacks to end exactly at `required`; returns how many.
pub(crate) fn close(draft: &mut FaceDraft, required: &[[u32; 2]], shared: &[DVec3]) -> usize {
    let mut net = NetEdges::default();
    required.iter().for_each(|&run| net.add(run, 1));
    for t in &draft.triangles {
        let [a, b, c] = t.map(|i| draft.vertices[i as usize].position);
        [[a, b], [b, c], [c, a]].into_iter().for_each(|run| net.add(run, -1));
    }
    let missing = net.directed();
    let before = draft.triangles.len();
    let mut known = FxHashMap::default();
    if !missing.is_empty() {
        known.extend(draft.vertices.iter().enumerate().rev().map(|(i, vertex)| (vertex.position, i as u32)));
    }
    for ring in rings(&missing) {
        fill(draft, &ring, shared, &mut known);
    }
    draft.triangles.len() - before
}

/// Takes balanced directed runs apart into simple closed rings.
fn rings(runs: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    runs.iter().for_each(|&[a, b]| next.entry(a).or_default().push(b));
    let mut out = Vec::new();
    while let Some((&start, _)) = next.first_key_value() {
        let mut path = vec![start];
        let mut place: HashMap<u32, usize> = HashMap::from([(start, 0)]);
        while let Some(&at) = path.last() {
            let Some(to) = take(&mut next, at) else { break };
            if let Some(&k) = place.get(&to) {
                let ring = path.split_off(k);
                ring.iter().for_each(|p| {
                    place.remove(p);
                });
                out.push(ring);
                path.push(to);
                place.insert(to, k);
            } else {
                place.insert(to, path.len());
                path.push(to);
            }
        }
    }
    out
}

fn take(next: &mut BTreeMap<u32, Vec<u32>>, at: u32) -> Option<u32> {
    let list = next.get_mut(&at)?;
    let to = list.pop();
    if list.is_empty() {
        next.remove(&at);
    }
    to
}

/// `known` holds the first vertex at each point.
fn fill(draft: &mut FaceDraft, ring: &[u32], shared: &[DVec3], known: &mut FxHashMap<u32, u32>) {
    let places: Vec<DVec3> = ring.iter().map(|&p| draft.position(p, shared)).collect();
    let triangles = ear_clipping::triangles(&places);
    let normal = ear_clipping::newell(&places).try_normalize().unwrap_or(DVec3::Z);
    let vertices: Vec<u32> = ring.iter().map(|&p| vertex_of(draft, p, normal, known)).collect();
    draft.triangles.extend(triangles.into_iter().map(|t| t.map(|i| vertices[i])));
}

/// A vertex of the draft at `point`, an existing one where there is one.
fn vertex_of(draft: &mut FaceDraft, point: u32, normal: DVec3, known: &mut FxHashMap<u32, u32>) -> u32 {
    *known.entry(point).or_insert_with(|| {
        draft.vertices.push(FaceVertex { position: point, normal, uv: DVec2::ZERO });
        draft.vertices.len() as u32 - 1
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FaceStatus;

    fn square() -> (FaceDraft, Vec<DVec3>) {
        let points =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        (FaceDraft::empty(FaceStatus::Exact, 4), points)
    }

    const SIDES: [[u32; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];

    #[test]
    fn an_empty_face_is_filled_from_its_loop() {
        let (mut draft, points) = square();
        assert_eq!(close(&mut draft, &SIDES, &points), 2);
        assert_eq!(close(&mut draft, &SIDES, &points), 0);
    }

    #[test]
    fn a_cut_off_corner_is_put_back() {
        let (mut draft, points) = square();
        draft.vertices =
            (0..3).map(|p| FaceVertex { position: p, normal: DVec3::Z, uv: DVec2::ZERO }).collect();
        draft.triangles = vec![[0, 1, 2]];
        assert_eq!(close(&mut draft, &SIDES, &points), 1);
    }

    #[test]
    fn a_figure_of_eight_is_two_rings() {
        let runs = [[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]];
        let mut sizes: Vec<usize> = rings(&runs).iter().map(Vec::len).collect();
        sizes.sort_unstable();
        assert_eq!(sizes, [3, 3]);
    }
}
