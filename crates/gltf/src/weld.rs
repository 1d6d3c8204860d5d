//! Faces to the vertices and triangles of one primitive.

use trimloop_mesh::FaceMesh;

/// Normals at a position count as one when they differ by less than this (radians): smooth edges merge, sharp ones split.
const SAME_NORMAL_RAD: f32 = 1e-3;

/// No vertex.
const NONE: u32 = u32::MAX;

/// The vertices and triangles of one primitive.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Triangles {
    /// Stored coordinates, one per vertex.
    pub(crate) points: Vec<[f32; 3]>,
    /// Unit normals, one per vertex.
    pub(crate) normals: Vec<[f32; 3]>,
    /// Index of the vertex's face in the part, one per vertex; empty unless asked for.
    pub(crate) faces: Vec<u32>,
    /// Three per triangle.
    pub(crate) indices: Vec<u32>,
}

/// Welds faces into primitives: vertices at the same position with the same normal become one.
///
/// Its memory is kept from primitive to primitive, and what resetting it costs is in proportion to the primitive.
pub(crate) struct Welder<'a> {
    /// Stored coordinates of all positions of the part.
    stored: &'a [[f32; 3]],
    /// Whether vertices remember their face, and so never merge across faces.
    keep_faces: bool,
    /// Per position: the newest of the primitive's vertices there.
    newest: Vec<u32>,
    /// Per vertex of the primitive: an older one at the same position.
    older: Vec<u32>,
    /// Per vertex of the primitive: its position.
    positions: Vec<u32>,
    /// Per vertex of the current face: the primitive's vertex.
    local: Vec<u32>,
    out: Triangles,
}

impl<'a> Welder<'a> {
    pub(crate) fn new(stored: &'a [[f32; 3]], keep_faces: bool) -> Self {
        Self {
            stored,
            keep_faces,
            newest: vec![NONE; stored.len()],
            older: Vec::new(),
            positions: Vec::new(),
            local: Vec::new(),
            out: Triangles::default(),
        }
    }

    /// Adds the triangles of the part's face number `face` that still have three different corners as stored.
    pub(crate) fn add(&mut self, face: u32, mesh: &FaceMesh) {
        self.local.clear();
        self.local.resize(mesh.vertices.len(), NONE);
        self.out.indices.reserve(3 * mesh.triangles.len());
        for triangle in &mesh.triangles {
            let corners = triangle.map(|i| self.stored[mesh.vertices[i as usize].position as usize]);
            if is_flat(corners) {
                continue;
            }
            for &i in triangle {
                let vertex = match self.local[i as usize] {
                    NONE => self.vertex(face, mesh, i, corners),
                    known => known,
                };
                self.out.indices.push(vertex);
            }
        }
    }

    /// The primitive so far; the next one starts empty.
    pub(crate) fn finish(&mut self) -> Triangles {
        for &position in &self.positions {
            self.newest[position as usize] = NONE;
        }
        self.positions.clear();
        self.older.clear();
        std::mem::take(&mut self.out)
    }

    /// The primitive's vertex for vertex `i` of a face, which may be an older one.
    fn vertex(&mut self, face: u32, mesh: &FaceMesh, i: u32, corners: [[f32; 3]; 3]) -> u32 {
        let own = &mesh.vertices[i as usize];
        let normal = unit(own.normal).unwrap_or_else(|| flat_normal(corners));
        let vertex = self.find(face, own.position, normal).unwrap_or_else(|| {
            let new = self.out.points.len() as u32;
            self.out.points.push(self.stored[own.position as usize]);
            self.out.normals.push(normal);
            if self.keep_faces {
                self.out.faces.push(face);
            }
            self.positions.push(own.position);
            self.older.push(std::mem::replace(&mut self.newest[own.position as usize], new));
            new
        });
        self.local[i as usize] = vertex;
        vertex
    }

    /// A vertex that the primitive already has.
    fn find(&self, face: u32, position: u32, normal: [f32; 3]) -> Option<u32> {
        let mut vertex = self.newest[position as usize];
        while vertex != NONE {
            let i = vertex as usize;
            let same_face = !self.keep_faces || self.out.faces[i] == face;
            if same_face && distance_squared(self.out.normals[i], normal) < SAME_NORMAL_RAD * SAME_NORMAL_RAD
            {
                return Some(vertex);
            }
            vertex = self.older[i];
        }
        None
    }
}

/// Whether a triangle has no area because corners coincide, or no place because one is not usable.
fn is_flat([a, b, c]: [[f32; 3]; 3]) -> bool {
    a == b || b == c || c == a || [a, b, c].iter().flatten().any(|x| !x.is_finite())
}

/// A unit normal as f32; none for what is no direction.
fn unit(normal: glam::DVec3) -> Option<[f32; 3]> {
    let length = normal.length();
    (length > 0.0 && length.is_finite()).then(|| ((normal / length).as_vec3() + 0.0).to_array())
}

/// The normal of a triangle's plane.
fn flat_normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(|p| glam::Vec3::from_array(p).as_dvec3());
    unit((b - a).cross(c - a)).unwrap_or([0.0, 0.0, 1.0])
}

fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};
    use trimloop_mesh::{FaceStatus, FaceVertex};

    use super::*;

    const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    fn face(vertices: &[(u32, DVec3)], triangles: &[[u32; 3]]) -> FaceMesh {
        FaceMesh {
            status: FaceStatus::Exact,
            vertices: vertices
                .iter()
                .map(|&(position, normal)| FaceVertex { position, normal, uv: DVec2::ZERO })
                .collect(),
            triangles: triangles.to_vec(),
            area_mm2: 0.5,
            max_deviation_mm: 0.0,
        }
    }

    /// The two halves of a square, the second with a normal turned by `angle_rad`.
    fn halves(angle_rad: f64) -> [FaceMesh; 2] {
        let turned = DVec3::new(angle_rad.sin(), 0.0, angle_rad.cos());
        [
            face(&[(0, DVec3::Z), (1, DVec3::Z), (2, DVec3::Z)], &[[0, 1, 2]]),
            face(&[(2, turned), (3, turned), (0, turned)], &[[0, 1, 2]]),
        ]
    }

    fn weld(faces: &[FaceMesh], keep_faces: bool) -> Triangles {
        let mut welder = Welder::new(&SQUARE, keep_faces);
        for (i, face) in faces.iter().enumerate() {
            welder.add(i as u32, face);
        }
        welder.finish()
    }

    #[test]
    fn smooth_edges_merge_and_sharp_ones_split() {
        assert_eq!(weld(&halves(0.0), false).points.len(), 4);
        assert_eq!(weld(&halves(0.9e-3), false).points.len(), 4);
        assert_eq!(weld(&halves(1.1e-3), false).points.len(), 6);
        assert_eq!(weld(&halves(1.5), false).points.len(), 6);
    }

    #[test]
    fn faces_with_ids_share_no_vertices() {
        let welded = weld(&halves(0.0), true);
        assert_eq!(welded.faces, [0, 0, 0, 1, 1, 1]);
        assert_eq!(welded.indices, [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn triangles_without_three_corners_are_dropped() {
        let mut stored = SQUARE;
        stored[3] = stored[0];
        let mut welder = Welder::new(&stored, false);
        halves(0.0).iter().for_each(|face| welder.add(0, face));
        assert_eq!(welder.finish().indices, [0, 1, 2]);
        stored[3] = [f32::NAN; 3];
        let mut welder = Welder::new(&stored, false);
        halves(0.0).iter().for_each(|face| welder.add(0, face));
        assert_eq!(welder.finish().indices, [0, 1, 2]);
    }

    #[test]
    fn a_missing_normal_is_the_triangle_s() {
        let welded = weld(&[face(&[(0, DVec3::NAN), (1, DVec3::ZERO), (2, DVec3::Z)], &[[0, 1, 2]])], false);
        assert_eq!(welded.normals, [[0.0, 0.0, 1.0]; 3]);
    }

    #[test]
    fn each_primitive_starts_afresh() {
        let mut welder = Welder::new(&SQUARE, false);
        let [first, second] = halves(0.0);
        welder.add(0, &first);
        assert_eq!(welder.finish().indices, [0, 1, 2]);
        welder.add(1, &second);
        let next = welder.finish();
        assert_eq!(next.indices, [0, 1, 2]);
        assert_eq!(next.points, [SQUARE[2], SQUARE[3], SQUARE[0]]);
    }
}
