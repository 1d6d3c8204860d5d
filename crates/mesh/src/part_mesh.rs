//! The triangles of one part.

use glam::{DVec2, DVec3};
use trimloop_brep::{Diagnostics, EdgeId, Rgba};
use trimloop_geom::Aabb;

/// The triangles of one part.
#[derive(Clone, Debug, Default)]
pub struct PartMesh {
    /// Points in millimetres, each once; faces that meet share them.
    pub positions: Vec<DVec3>,
    /// One per face of the part, in its order.
    pub faces: Vec<FaceMesh>,
    /// The edges of the part that bound a face, as indices into `positions`.
    pub edges: Vec<EdgeLine>,
    /// The part's free curves; a free point is three short lines.
    pub curves: Vec<CurveLine>,
    /// One per shell of the part, bodies in order.
    pub shells: Vec<ShellTopology>,
    /// The linear deflection that was applied, millimetres.
    pub linear_deflection_mm: f64,
    /// What meshing had to say.
    pub diagnostics: Diagnostics,
}

/// The triangles of one face.
#[derive(Clone, Debug)]
pub struct FaceMesh {
    /// How it ended.
    pub status: FaceStatus,
    /// The face's own vertices: a position may occur several times, with several normals.
    pub vertices: Vec<FaceVertex>,
    /// Indices into `vertices`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Area of the triangles.
    pub area_mm2: f64,
    /// The largest distance found between triangles and the exact surface.
    pub max_deviation_mm: f64,
}

/// How a face ended.
#[derive(Clone, Debug, PartialEq)]
pub enum FaceStatus {
    /// Within the bound.
    Exact,
    /// Triangulated, but above the bound or by a fallback: why, in a sentence.
    Approximated(String),
    /// Its exact area is nothing.
    Empty,
    /// No triangles: why, in a sentence.
    Lost(String),
}

impl FaceStatus {
    /// `exact`, `approximated`, `empty`, `lost`.
    pub const fn as_str(&self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Approximated(_) => "approximated",
            Self::Empty => "empty",
            Self::Lost(_) => "lost",
        }
    }
}

/// A vertex as one face sees it.
#[derive(Clone, Copy, Debug)]
pub struct FaceVertex {
    /// Index into [`PartMesh::positions`].
    pub position: u32,
    /// Unit normal of the exact surface, pointing outwards.
    pub normal: DVec3,
    /// Surface parameters (zero where the face has no exact surface).
    pub uv: DVec2,
}

/// An edge's shared samples.
#[derive(Clone, Debug)]
pub struct EdgeLine {
    /// Which edge of the part.
    pub edge: EdgeId,
    /// Indices into [`PartMesh::positions`], from the edge's start to its end.
    pub points: Vec<u32>,
}

/// A free curve as a line strip.
#[derive(Clone, Debug)]
pub struct CurveLine {
    /// Points in millimetres.
    pub points: Vec<DVec3>,
    /// Its colour.
    pub color: Option<Rgba>,
}

/// What a shell's triangles are like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShellTopology {
    /// Index of the body in the part.
    pub body: usize,
    /// Index of the shell in the body.
    pub shell: usize,
    /// Triangle edges used more often in one direction than in the other.
    pub open_edges: usize,
    /// Triangle edges used by more than two triangles.
    pub non_manifold_edges: usize,
    /// Signed volume under the shell's triangles, positive when they face away from the inside.
    pub volume_mm3: f64,
}

impl PartMesh {
    /// Number of triangles of all faces.
    pub fn triangle_count(&self) -> usize {
        self.faces.iter().map(|f| f.triangles.len()).sum()
    }

    /// The box of all triangles' vertices.
    pub fn bounds(&self) -> Aabb {
        let used = self.faces.iter().flat_map(|f| f.triangles.iter().map(move |t| (f, t)));
        Aabb::from_points(
            used.flat_map(|(f, t)| t.map(|i| self.positions[f.vertices[i as usize].position as usize])),
        )
    }
}
