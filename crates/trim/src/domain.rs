//! A face's inside as polygons in its surface's parameter plane.

use glam::{DVec2, DVec3};
use trimloop_brep::{Diagnostic, Diagnostics, Face, FaceGeometry, FaceId, Loop, Part, Severity};
use trimloop_geom::Surface;

use crate::band::{self, Chart};
use crate::unroll::{UnrolledLoop, unroll};
use crate::{EdgeSamples, Tolerance, nesting};

/// A face's inside as polygons in its surface's parameter plane, by the even-odd rule.
///
/// Counter-clockwise outside, clockwise around holes. Parameters on closed directions are unrolled: a loop that goes
/// round a cylinder runs over a whole period, and the cut that opens the cylinder is part of the polygon.
#[derive(Clone, Debug, Default)]
pub struct TrimDomain {
    /// Closed polygons.
    pub loops: Vec<TrimLoop>,
    /// Points in space that the domain adds (poles, cuts); [`TrimVertex::point`] numbers them on from
    /// [`TrimDomain::own_base`].
    pub own_points: Vec<DVec3>,
    /// Number of shared points.
    pub own_base: u32,
    /// What had to be repaired.
    pub diagnostics: Diagnostics,
}

/// One closed polygon; the last vertex joins the first.
#[derive(Clone, Debug, Default)]
pub struct TrimLoop {
    /// At least one vertex, usually three or more.
    pub vertices: Vec<TrimVertex>,
    /// Whether it runs against the file's direction, which was wrong.
    pub turned: bool,
}

/// A polygon's corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrimVertex {
    /// Parameters.
    pub uv: DVec2,
    /// The point in space: an index into [`EdgeSamples::points`], or from `own_base` on into
    /// [`TrimDomain::own_points`]. One point may stand at several parameters (seams, poles).
    pub point: u32,
}

/// Why a face has no domain.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TrimError {
    /// The face has no exact surface.
    #[error("the face has no exact surface")]
    NoSurface,
    /// An edge of the face has no samples on it.
    #[error("an edge of the face could not be brought into the surface's parameters")]
    EdgeOffSurface,
    /// The loops close the surface up in a way that no domain has.
    #[error("{0}")]
    Winding(&'static str),
}

impl TrimLoop {
    /// The corners' parameters.
    pub fn uvs(&self) -> impl ExactSizeIterator<Item = DVec2> + Clone + '_ {
        self.vertices.iter().map(|v| v.uv)
    }

    /// The polygon's area in the parameter plane, positive counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        crate::polygon::signed_area(self.uvs())
    }

    /// Runs the polygon the other way.
    pub fn reverse(&mut self) {
        self.vertices.reverse();
    }
}

impl TrimDomain {
    /// The domain of `face` of `part`, with its edges sampled as in `samples`; `tolerance` for the sides it adds.
    pub fn new(
        part: &Part,
        face: FaceId,
        samples: &EdgeSamples,
        tolerance: Tolerance,
    ) -> Result<Self, TrimError> {
        let face_ref = &part.faces[face as usize];
        let FaceGeometry::Surface(surface) = &face_ref.geometry else { return Err(TrimError::NoSurface) };
        let (loops, turned) = unroll_loops(part, face, samples, surface, tolerance.clamped())?;
        let base = samples.points.len() as u32;
        let mut domain = Self { own_base: base, ..Self::default() };
        if turned {
            domain.note_directions(face_ref, 1, loops.len());
        }
        let chart = Chart { surface, tolerance: tolerance.clamped() };
        band::assemble(&chart, loops, &mut domain)?;
        domain.settle_directions(face_ref);
        Ok(domain)
    }

    /// The point in space of a vertex.
    pub fn point(&self, vertex: &TrimVertex, samples: &EdgeSamples) -> DVec3 {
        match vertex.point.checked_sub(self.own_base) {
            Some(own) => self.own_points[own as usize],
            None => samples.points[vertex.point as usize],
        }
    }

    /// Takes a point of the domain's own; its number.
    pub(crate) fn add_point(&mut self, point: DVec3) -> u32 {
        self.own_points.push(point);
        self.own_base + self.own_points.len() as u32 - 1
    }

    /// The box of all polygons.
    pub fn uv_bounds(&self) -> (DVec2, DVec2) {
        let all = self.loops.iter().flat_map(|l| l.uvs());
        all.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), uv| (low.min(uv), high.max(uv)))
    }

    /// Whether (u, v) lies inside by the even-odd rule over the polygons. Parameters must be unrolled as the domain is.
    pub fn contains(&self, uv: DVec2) -> bool {
        self.loops.iter().filter(|l| crate::polygon::contains(l.uvs(), uv)).count() % 2 == 1
    }

    /// Outer polygons counter-clockwise, holes clockwise, whatever the file says.
    fn settle_directions(&mut self, face: &Face) {
        let depths = nesting::depths(&self.loops);
        let mut turned = 0;
        for (l, depth) in self.loops.iter_mut().zip(depths) {
            let area = l.signed_area();
            if area != 0.0 && (area > 0.0) != (depth % 2 == 0) {
                l.reverse();
                l.turned = !l.turned;
                turned += 1;
            }
        }
        if turned > 0 {
            self.note_directions(face, turned, self.loops.len());
        }
    }

    fn note_directions(&mut self, face: &Face, turned: usize, loops: usize) {
        let message = format!("{turned} of the face's {loops} loops run in the wrong direction; turned");
        self.diagnostics.push(
            Diagnostic::new(Severity::Info, "loop-direction", face.entity, message).on_face(face.entity),
        );
    }
}

/// The loops in the parameter plane, and whether one of them was turned to close.
fn unroll_loops(
    part: &Part,
    face: FaceId,
    samples: &EdgeSamples,
    surface: &Surface,
    tolerance: Tolerance,
) -> Result<(Vec<UnrolledLoop>, bool), TrimError> {
    let face_ref = &part.faces[face as usize];
    let bounds: Vec<_> = face_ref.loops.iter().filter(|l| !l.coedges.is_empty()).collect();
    let unrolled =
        |bound: &Loop, reverse: bool| unroll(bound, face, reverse, samples, surface, tolerance.angular_rad);
    let mut loops = Vec::with_capacity(bounds.len());
    for bound in &bounds {
        loops.push(unrolled(bound, !face_ref.same_sense)?);
    }
    // A loop through a pole that goes once round a surface without another end passes the pole on the wrong side.
    let mut around = (0..loops.len()).filter(|&k| loops[k].winding != [0, 0]);
    let mut turned = false;
    if let (Some(only), None) = (around.next(), around.next())
        && loops[only].through_pole
        && !band::closes_up(surface)
    {
        let other = unrolled(bounds[only], face_ref.same_sense)?;
        turned = other.winding == [0, 0];
        if turned {
            loops[only] = other;
        }
    }
    loops.retain(|l| l.vertices.len() > 1);
    Ok((loops, turned))
}
