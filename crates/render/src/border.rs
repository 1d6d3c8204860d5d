//! A face's boundary and a part's edges as straight segments between the samples that all faces share.

use glam::{DVec2, DVec3};
use trimloop_brep::{FaceId, Part};
use trimloop_gpu::FaceShape;
use trimloop_trim::EdgeSamples;

/// A chord of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segment {
    pub a: DVec3,
    pub b: DVec3,
    /// Shares of the face's domain.
    pub uv: [DVec2; 2],
}

/// The sides of the face's polygons; sides that no edge has (cuts, poles) too.
pub(crate) fn loop_segments(face: &FaceShape, samples: &EdgeSamples) -> Vec<Segment> {
    let [u, v] = face.shape.domain();
    let (low, extent) = (DVec2::new(u.start, v.start), DVec2::new(u.length(), v.length()));
    let domain = &face.domain;
    let mut out = Vec::new();
    for l in &domain.loops {
        for (k, vertex) in l.vertices.iter().enumerate() {
            let next = &l.vertices[(k + 1) % l.vertices.len()];
            let (a, b) = (domain.point(vertex, samples), domain.point(next, samples));
            if a != b {
                out.push(Segment { a, b, uv: [vertex.uv, next.uv].map(|uv| (uv - low) / extent) });
            }
        }
    }
    out
}

/// The chords of the edges that `face` owns.
pub(crate) fn edge_segments(
    part: &Part,
    face: FaceId,
    samples: &EdgeSamples,
    owners: &[Option<FaceId>],
) -> Vec<Segment> {
    let mut edges: Vec<u32> =
        part.faces[face as usize].loops.iter().flat_map(|l| &l.coedges).map(|c| c.edge).collect();
    edges.retain(|&edge| owners.get(edge as usize).is_some_and(|owner| *owner == Some(face)));
    edges.sort_unstable();
    edges.dedup();
    let chords = |edge: u32| {
        let points = samples.edges.get(edge as usize).map_or(&[][..], |e| &e.points);
        points.windows(2).map(|pair| Segment {
            a: samples.points[pair[0] as usize],
            b: samples.points[pair[1] as usize],
            uv: [DVec2::ZERO; 2],
        })
    };
    edges.into_iter().flat_map(chords).filter(|s| s.a != s.b).collect()
}
