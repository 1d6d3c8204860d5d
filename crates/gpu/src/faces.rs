//! The faces of a part, ready to be evaluated and trimmed.

use rayon::prelude::*;
use trimloop_brep::{FaceGeometry, FaceId, Part};
use trimloop_geom::Interval;
use trimloop_trim::{EdgeSamples, Tolerance, TrimDomain, TrimError, sample_edges};

use crate::Shape;

/// A face's surface over the box of its trim loops, and the loops.
#[derive(Debug)]
pub struct FaceShape {
    /// Index of the face in its part.
    pub face: FaceId,
    /// The surface.
    pub shape: Shape,
    /// The trim loops, in the surface's own parameters.
    pub domain: TrimDomain,
}

/// A part's faces.
#[derive(Debug)]
pub struct FaceShapes {
    /// The edges, sampled once for all faces.
    pub samples: EdgeSamples,
    /// Each face, or why it cannot be drawn.
    pub faces: Vec<Result<FaceShape, TrimError>>,
}

impl FaceShapes {
    /// Makes all faces of `part` ready, their trim loops within `tolerance`.
    pub fn new(part: &Part, tolerance: Tolerance) -> Self {
        let samples = sample_edges(part, tolerance);
        let of = |face: usize| FaceShape::new(part, face as FaceId, &samples, tolerance);
        let faces = (0..part.faces.len()).into_par_iter().map(of).collect();
        Self { samples, faces }
    }
}

impl FaceShape {
    fn new(
        part: &Part,
        face: FaceId,
        samples: &EdgeSamples,
        tolerance: Tolerance,
    ) -> Result<Self, TrimError> {
        let domain = TrimDomain::new(part, face, samples, tolerance)?;
        let FaceGeometry::Surface(surface) = &part.faces[face as usize].geometry else {
            return Err(TrimError::NoSurface);
        };
        let (low, high) = domain.uv_bounds();
        let extent = [Interval::new(low.x, high.x), Interval::new(low.y, high.y)];
        let shape =
            Shape::surface(surface, extent).ok_or(TrimError::Winding("the trim loops enclose nothing"))?;
        Ok(Self { face, shape, domain })
    }
}
