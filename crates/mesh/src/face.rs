//! One face's triangles.

use std::sync::Arc;

use glam::DVec3;
use trimloop_brep::{Diagnostic, FaceGeometry, FaceId, Facets, Part, Severity};
use trimloop_geom::Surface;
use trimloop_trim::{EdgeSamples, Tolerance, TrimDomain};

use crate::FaceVertex;
use crate::boundary::{self, NetEdges};
use crate::draft::FaceDraft;
use crate::filling::Filling;
use crate::limit::SiteLimit;
use crate::{FaceStatus, ear_clipping};

/// What all faces of a part are meshed with.
pub(crate) struct FaceMesher<'a> {
    pub part: &'a Part,
    pub samples: &'a EdgeSamples,
    pub tolerance: Tolerance,
    pub limit: SiteLimit,
}

impl FaceMesher<'_> {
    /// The triangles of one face; should anything below panic, the face is lost and no other.
    pub fn mesh_guarded(&self, face: FaceId) -> FaceDraft {
        let attempt = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| self.mesh(face)));
        attempt.unwrap_or_else(|_| {
            FaceDraft::empty(FaceStatus::Lost("meshing it failed unexpectedly".into()), self.base())
        })
    }

    /// The triangles of one face.
    fn mesh(&self, face: FaceId) -> FaceDraft {
        match &self.part.faces[face as usize].geometry {
            FaceGeometry::Surface(surface) => self.mesh_surface(face, surface),
            FaceGeometry::Facets(facets) => self.take_facets(facets),
            FaceGeometry::Unreadable(reason) => {
                FaceDraft::empty(FaceStatus::Lost(reason.clone()), self.base())
            }
        }
    }

    /// Number of points that faces share.
    fn base(&self) -> u32 {
        (self.samples.points.len() + self.part.facet_points.len()) as u32
    }

    fn mesh_surface(&self, face: FaceId, surface: &Arc<Surface>) -> FaceDraft {
        match TrimDomain::new(self.part, face, self.samples, self.tolerance) {
            Ok(domain) => self.mesh_domain(face, surface, domain),
            Err(error) => self.span_loops(face, error.to_string()),
        }
    }

    fn mesh_domain(&self, face: FaceId, surface: &Surface, mut domain: TrimDomain) -> FaceDraft {
        self.leave_room_for_facets(&mut domain);
        if turns(surface, &domain) > MAX_TURNS {
            return self.span_loops(face, "its boundary goes round the surface thousands of times".into());
        }
        let max_sites = self.limit.of(surface, &domain);
        let filling = Filling::new(surface, &domain, self.samples, self.tolerance, max_sites);
        let mut filling = match filling {
            Ok(filling) => filling,
            Err(reason) => return self.span_loops(face, reason.to_string()),
        };
        if !matches!(surface, Surface::Plane { .. }) {
            filling.refine();
        }
        let mut draft = FaceDraft::empty(FaceStatus::Exact, self.base());
        // The edges are the model's; no triangle that ends at them can be nearer to the surface than they are.
        let lift = filling.max_lift_mm;
        draft.max_deviation_mm = filling.max_deviation_mm.max(lift);
        if lift > self.tolerance.linear_mm {
            draft.status =
                FaceStatus::Approximated(format!("its edges lie up to {lift:.3e} mm off its surface"));
        }
        if !filling.within_bounds {
            let off = draft.max_deviation_mm;
            draft.status =
                FaceStatus::Approximated(format!("refinement ended above the bound, {off:.3e} mm off"));
        }
        draft.diagnostics = std::mem::take(&mut domain.diagnostics);
        draft.diagnostics.iter_mut().for_each(|d| d.face = Some(self.part.faces[face as usize].entity));
        let intact = filling.intact();
        let required = runs(&domain);
        let (vertices, triangles, mut inner) = filling.finish();
        draft.vertices = vertices;
        draft.triangles = triangles;
        draft.own_points = std::mem::take(&mut domain.own_points);
        draft.own_points.append(&mut inner);
        if !intact {
            self.repair_boundary(face, &mut draft, &required);
        }
        draft.boundary = required;
        self.settle_normals(&mut draft);
        if draft.triangles.is_empty() {
            draft.status = FaceStatus::Empty;
        }
        draft
    }

    fn leave_room_for_facets(&self, domain: &mut TrimDomain) {
        let (old, new) = (domain.own_base, self.base());
        if new > old {
            let vertices = domain.loops.iter_mut().flat_map(|l| &mut l.vertices);
            vertices.filter(|v| v.point >= old).for_each(|v| v.point += new - old);
            domain.own_base = new;
        }
    }

    /// Ends the triangles at the edges' samples where the triangulation could not.
    fn repair_boundary(&self, face: FaceId, draft: &mut FaceDraft, required: &[[u32; 2]]) {
        let before = draft.triangles.len();
        let added = boundary::close(draft, required, &self.samples.points);
        if added == 0 {
            return;
        }
        let area = |t: &[u32; 3]| {
            let [a, b, c] =
                t.map(|i| draft.position(draft.vertices[i as usize].position, &self.samples.points));
            (b - a).cross(c - a).length() * 0.5
        };
        let (kept, put): (f64, f64) = (
            draft.triangles[..before].iter().map(area).sum(),
            draft.triangles[before..].iter().map(area).sum(),
        );
        let size = kept.max(f64::MIN_POSITIVE).sqrt();
        let entity = self.part.faces[face as usize].entity;
        let text = format!(
            "the face's boundary crosses or touches itself; closed with {added} triangles ({put:.3e} mm²)"
        );
        draft
            .diagnostics
            .push(Diagnostic::new(Severity::Info, "boundary-crosses", entity, text.clone()).on_face(entity));
        if put > self.tolerance.linear_mm * size * 4.0 {
            draft.status = FaceStatus::Approximated(text);
        }
    }

    /// Vertices at which the surface has no normal take that of their triangles.
    fn settle_normals(&self, draft: &mut FaceDraft) {
        if draft.vertices.iter().all(|v| v.normal != DVec3::ZERO) {
            return;
        }
        let mut sums = vec![DVec3::ZERO; draft.vertices.len()];
        for t in &draft.triangles {
            let [a, b, c] =
                t.map(|i| draft.position(draft.vertices[i as usize].position, &self.samples.points));
            let n = (b - a).cross(c - a);
            t.iter().for_each(|&i| sums[i as usize] += n);
        }
        for (v, sum) in draft.vertices.iter_mut().zip(sums).filter(|(v, _)| v.normal == DVec3::ZERO) {
            v.normal = sum.try_normalize().unwrap_or(DVec3::Z);
        }
    }

    /// The fallback for a face whose surface cannot be used: its loops spanned by plain polygons.
    fn span_loops(&self, face: FaceId, reason: String) -> FaceDraft {
        let face_ref = &self.part.faces[face as usize];
        let mut draft = FaceDraft::empty(FaceStatus::Exact, self.base());
        let mut required = NetEdges::default();
        for coedge in face_ref.loops.iter().flat_map(|l| &l.coedges) {
            let Some(edge) = self.samples.edges.get(coedge.edge as usize) else { continue };
            for pair in edge.points.windows(2) {
                let backwards = coedge.reversed == face_ref.same_sense;
                required.add(if backwards { [pair[1], pair[0]] } else { [pair[0], pair[1]] }, 1);
            }
        }
        draft.boundary = required.directed();
        let runs = draft.boundary.clone();
        boundary::close(&mut draft, &runs, &self.samples.points);
        draft.status = if draft.triangles.is_empty() {
            FaceStatus::Lost(reason)
        } else {
            FaceStatus::Approximated(format!("{reason}; its boundary is spanned by plain triangles"))
        };
        draft
    }

    fn take_facets(&self, facets: &Facets) -> FaceDraft {
        let mut draft = FaceDraft::empty(FaceStatus::Exact, self.base());
        let points = &self.part.facet_points;
        let first = self.samples.points.len() as u32;
        let mut net = NetEdges::default();
        for (k, t) in facets.triangles.iter().enumerate() {
            if t.iter().any(|&i| i as usize >= points.len()) || t[0] == t[1] || t[1] == t[2] || t[2] == t[0] {
                continue;
            }
            let corners = t.map(|i| points[i as usize]);
            let flat = ear_clipping::newell(&corners).try_normalize().unwrap_or(DVec3::Z);
            let normals = facets.normals.get(k).copied().unwrap_or([flat; 3]);
            let base = draft.vertices.len() as u32;
            draft.vertices.extend((0..3).map(|c| FaceVertex {
                position: first + t[c],
                normal: normals[c].try_normalize().unwrap_or(flat),
                uv: glam::DVec2::ZERO,
            }));
            draft.triangles.push([base, base + 1, base + 2]);
            let [a, b, c] = t.map(|i| first + i);
            [[a, b], [b, c], [c, a]].into_iter().for_each(|run| net.add(run, 1));
        }
        draft.boundary = net.directed();
        if draft.triangles.is_empty() {
            draft.status = FaceStatus::Empty;
        }
        draft
    }
}

/// A strip may wind round a surface so often; samples of what winds more often say nothing of where it runs.
const MAX_TURNS: f64 = 4096.0;

/// How many turns of a surface a domain spans.
fn turns(surface: &Surface, domain: &TrimDomain) -> f64 {
    let (low, high) = domain.uv_bounds();
    let turns = surface.periods().into_iter().zip((high - low).to_array());
    turns.map(|(period, length)| period.map_or(0.0, |period| length / period)).fold(0.0, f64::max)
}

/// The domain's directed boundary as points; cuts, which are run over both ways, drop out.
fn runs(domain: &TrimDomain) -> Vec<[u32; 2]> {
    let mut net = NetEdges::default();
    for l in &domain.loops {
        let n = l.vertices.len();
        (0..n).for_each(|i| net.add([l.vertices[i].point, l.vertices[(i + 1) % n].point], 1));
    }
    net.directed()
}
