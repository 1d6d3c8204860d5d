//! A face's triangles before the part's faces are brought together.

use glam::DVec3;
use trimloop_brep::Diagnostics;

use crate::{FaceStatus, FaceVertex};

/// A face's triangles, counter-clockwise about the *surface's* normal, before the part's faces are brought together.
#[derive(Clone, Debug)]
pub(crate) struct FaceDraft {
    pub status: FaceStatus,
    /// Their positions are numbers of points until the faces are brought together.
    pub vertices: Vec<FaceVertex>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of points shared by all faces; vertex points from there on are `own_points`.
    pub own_base: u32,
    pub own_points: Vec<DVec3>,
    /// The directed boundary of the triangles, as points.
    pub boundary: Vec<[u32; 2]>,
    pub max_deviation_mm: f64,
    pub diagnostics: Diagnostics,
}

impl FaceDraft {
    /// A face without triangles.
    pub fn empty(status: FaceStatus, own_base: u32) -> Self {
        Self {
            status,
            vertices: Vec::new(),
            triangles: Vec::new(),
            own_base,
            own_points: Vec::new(),
            boundary: Vec::new(),
            max_deviation_mm: 0.0,
            diagnostics: Vec::new(),
        }
    }

    /// The place of a point.
    pub fn position(&self, point: u32, shared: &[DVec3]) -> DVec3 {
        match point.checked_sub(self.own_base) {
            Some(own) => self.own_points[own as usize],
            None => shared[point as usize],
        }
    }
}
