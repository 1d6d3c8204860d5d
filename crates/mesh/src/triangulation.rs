//! The constrained Delaunay triangulation of a domain in the warped parameter plane.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};
use spade::handles::{
    DirectedEdgeHandle, FixedDirectedEdgeHandle, FixedFaceHandle, FixedVertexHandle, InnerTag,
    PossiblyOuterTag, UndirectedEdgeHandle,
};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation as _};
use trimloop_trim::TrimDomain;

use crate::strips::Strips;
use crate::warp::Warp;

/// A vertex of the triangulation: its warped place and its index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    pub at: DVec2,
    pub index: u32,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

type Cdt = ConstrainedDelaunayTriangulation<Site>;

/// The triangulation of a domain, and what became of its boundary.
pub(crate) struct Triangulation {
    cdt: Cdt,
    /// Corners of the domain's loops, one after the other, to sites (corners at the same place share one).
    pub site_of_corner: Vec<u32>,
    /// Per inner point whether it has a site of its own (not when it falls on a corner); these follow the corners'.
    pub inner_is_new: Vec<bool>,
    /// Pairs of sites that the boundary runs over an even number of times: both sides are alike.
    slits: FxHashSet<(u32, u32)>,
    /// Whether every boundary segment is an edge of the triangulation.
    pub intact: bool,
    /// What is known since the sides were first told; nothing where that does not hold for what was added since.
    sides: Option<Sides>,
    domain: Strips,
    /// Edges that sites had when they were added, in all: the work that adding them took.
    spokes: usize,
}

/// An edge that is no boundary.
#[derive(Clone, Copy)]
pub(crate) struct InnerEdge {
    pub sites: [u32; 2],
    /// The faces on both sides, the outer one included.
    pub faces: [u32; 2],
    edge: FixedDirectedEdgeHandle,
}

impl InnerEdge {
    fn new(edge: DirectedEdgeHandle<'_, Site, (), spade::CdtEdge<()>, ()>) -> Self {
        let sites = edge.vertices().map(|v| v.data().index);
        let faces = [edge, edge.rev()].map(|side| side.face().index() as u32);
        Self { sites, faces, edge: edge.fix() }
    }
}

/// Which triangles lie inside the domain, told once: those that are made later lie round a new site, and no boundary
/// runs between a site and its triangles.
#[derive(Default)]
struct Sides {
    /// Sites from this one on are no corners.
    first_inner: u32,
    /// Triangles of corners only that lie inside, their sites sorted.
    inside: FxHashSet<[u32; 3]>,
    /// Sites that are no corners and yet lie outside.
    outside: FxHashSet<u32>,
}

/// Why a domain has no triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Untriangulable {
    OutOfRange,
    Tangled,
}

impl std::fmt::Display for Untriangulable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::OutOfRange => "its parameters are out of range",
            Self::Tangled => "its boundary crosses itself all over",
        })
    }
}

/// Sides that triangles' middles may be held against in one go, and crossings of the boundary with itself that the
/// triangulation may meet: both take about as long.
const MAX_CROSSINGS: usize = 30_000_000;

/// Edges that added sites may have when they are added: in all, and where that is more for each site. Six are usual;
/// there are thousands where sites lie close together along lines that are far apart.
const MAX_SPOKES: usize = 1_000_000;
const SPOKES_EACH: usize = 32;

/// How far the plane is sheared and flattened before it is triangulated.
const SHEAR: f64 = 1e-7;
const FLATTENING: f64 = 1.0 - 1e-10;

/// A warped point as the triangulation takes it. The shear decides between the two equally good diagonals of a
/// rectangle, always for the one that rises with both parameters, the flattening between those of a square that stands
/// on a corner, for the one along the second parameter (as OpenCASCADE mostly does); coordinates that are very small but
/// not zero are refused by spade.
fn tame(p: DVec2) -> DVec2 {
    let f = |x: f64| if x.abs() < 1e-40 { 0.0 } else { x };
    DVec2::new(f(p.x - SHEAR * p.y), f(p.y * FLATTENING))
}

/// The warped point of a triangulated one.
fn untame(p: DVec2) -> DVec2 {
    let y = p.y / FLATTENING;
    DVec2::new(p.x + SHEAR * y, y)
}

impl Triangulation {
    /// Triangulates the domain's corners and `inner` points ((u, v)).
    ///
    /// # Errors
    /// When coordinates are out of range, or the boundary crosses itself so often that there is no telling what is
    /// inside.
    pub fn new(domain: &TrimDomain, inner: &[DVec2], warp: &Warp) -> Result<Self, Untriangulable> {
        let polygons: Vec<Vec<DVec2>> =
            domain.loops.iter().map(|l| l.uvs().map(|uv| tame(warp.map(uv))).collect()).collect();
        let strips = Strips::new(&polygons);
        if strips.crossings_above(MAX_CROSSINGS) {
            return Err(Untriangulable::Tangled);
        }
        let mut sites: Vec<Site> = Vec::new();
        let mut known: FxHashMap<(u64, u64), u32> = FxHashMap::default();
        let mut site_at = |at: DVec2, sites: &mut Vec<Site>| {
            *known.entry((at.x.to_bits(), at.y.to_bits())).or_insert_with(|| {
                sites.push(Site { at, index: sites.len() as u32 });
                sites.len() as u32 - 1
            })
        };
        let site_of_corner: Vec<u32> = polygons.iter().flatten().map(|&at| site_at(at, &mut sites)).collect();
        let mut is_new = |&uv: &DVec2| {
            let before = sites.len();
            site_at(tame(warp.map(uv)), &mut sites);
            sites.len() > before
        };
        let inner_is_new: Vec<bool> = inner.iter().map(&mut is_new).collect();
        let uses = segment_uses(&polygons, &site_of_corner);
        let mut edges: Vec<[usize; 2]> = uses.keys().map(|&(a, b)| [a as usize, b as usize]).collect();
        edges.sort_unstable();
        let mut refused = 0;
        let cdt = Cdt::try_bulk_load_cdt(sites, edges.clone(), |_| refused += 1)
            .map_err(|_| Untriangulable::OutOfRange)?;
        // A side that runs through a corner is there in pieces, which may be sides already.
        let is_there = |[a, b]: &[usize; 2]| {
            let [a, b] = [a, b].map(|&site| FixedVertexHandle::from_index(site));
            cdt.exists_constraint(a, b)
        };
        let intact = refused == 0 && cdt.num_constraints() == edges.len() && edges.iter().all(is_there);
        let slits = uses.into_iter().filter(|&(_, n)| n % 2 == 0).map(|(pair, _)| pair).collect();
        let new =
            Self { cdt, site_of_corner, inner_is_new, slits, intact, sides: None, domain: strips, spokes: 0 };
        if new.is_tangled() { Err(Untriangulable::Tangled) } else { Ok(new) }
    }

    /// Number of sites.
    pub fn len(&self) -> usize {
        self.cdt.num_vertices()
    }

    /// Number of faces, the outer one included.
    pub fn face_count(&self) -> usize {
        self.cdt.num_all_faces()
    }

    /// The warped place of a site.
    pub fn at(&self, site: u32) -> DVec2 {
        untame(self.cdt.vertex(FixedVertexHandle::from_index(site as usize)).data().at)
    }

    /// Adds a point; its site, or `None` if it coincides with one that exists.
    pub fn insert(&mut self, at: DVec2, hint: u32) -> Option<u32> {
        let index = self.len() as u32;
        let hint = FixedVertexHandle::from_index(hint as usize);
        let before = self.cdt.num_vertices();
        let vertex = self.cdt.insert_with_hint(Site { at: tame(at), index }, hint).ok()?;
        if self.cdt.num_vertices() > before {
            let vertex = self.cdt.vertex(vertex);
            self.spokes += vertex.out_edges().count();
            // On a boundary it has triangles on both sides of it.
            if vertex.out_edges().any(|edge| edge.is_constraint_edge()) {
                self.sides = None;
            }
            return Some(index);
        }
        // The vertex that was there already has taken the new one's data: it keeps its own number.
        self.cdt.vertex_data_mut(vertex).index = vertex.index() as u32;
        None
    }

    /// Whether telling inside from outside takes too long to be done after every refinement: the domain's boundary
    /// crosses itself, and runs to and fro.
    pub fn is_tangled(&self) -> bool {
        !self.intact && self.cdt.num_inner_faces().saturating_mul(self.domain.load()) > MAX_CROSSINGS
    }

    /// Whether the sites lie so unevenly that to add more takes too long.
    pub fn is_uneven(&self) -> bool {
        self.spokes > MAX_SPOKES.max(SPOKES_EACH * self.len())
    }

    /// Per face of the triangulation (by index) whether it lies inside the domain.
    pub fn inside(&self) -> Vec<bool> {
        match &self.sides {
            _ if !self.intact => self.inside_by_centre(),
            None => self.inside_by_crossing(),
            Some(sides) => {
                let mut inside = vec![false; self.cdt.num_all_faces()];
                for (face, sites) in self.triangles() {
                    inside[face] = match sites.iter().find(|&&site| site >= sides.first_inner) {
                        Some(site) => sides.outside.is_empty() || !sides.outside.contains(site),
                        None => sides.inside.contains(&sorted(sites)),
                    };
                }
                inside
            }
        }
    }

    /// Keeps what is `inside` now, for it to be told more quickly once sites have been added.
    pub fn remember(&mut self, inside: &[bool]) {
        if !self.intact || self.sides.is_some() {
            return;
        }
        let corners = self.site_of_corner.iter().max().map_or(0, |&last| last + 1);
        let mut sides = Sides { first_inner: corners, ..Sides::default() };
        for (face, sites) in self.triangles() {
            if sites.iter().all(|&site| site < corners) {
                if inside[face] {
                    sides.inside.insert(sorted(sites));
                }
            } else if !inside[face] {
                sides.outside.extend(sites.iter().filter(|&&site| site >= corners));
            }
        }
        self.sides = Some(sides);
    }

    /// Whether all triangles at sites that are added from now on lie inside, if the sites do.
    pub fn new_sites_are_inside(&self) -> bool {
        self.sides.as_ref().is_some_and(|sides| sides.outside.is_empty())
    }

    /// Walks from the outside in; every boundary edge that is crossed changes the side.
    fn inside_by_crossing(&self) -> Vec<bool> {
        let outer: FixedFaceHandle<PossiblyOuterTag> = self.cdt.outer_face().fix();
        let mut side: Vec<Option<bool>> = vec![None; self.cdt.num_all_faces()];
        side[outer.index()] = Some(false);
        let mut queue: Vec<(FixedFaceHandle<PossiblyOuterTag>, bool)> = Vec::new();
        for edge in self.cdt.convex_hull() {
            let inner = edge.rev().face();
            let inner = if inner.is_outer() { edge.face() } else { inner };
            self.visit(inner.fix(), self.switches(edge.as_undirected()), &mut side, &mut queue);
        }
        while let Some((face, inside)) = queue.pop() {
            let Some(inner) = self.cdt.face(face).as_inner() else { continue };
            for edge in inner.adjacent_edges() {
                let next = edge.rev().face().fix();
                let switched = inside != self.switches(edge.as_undirected());
                self.visit(next, switched, &mut side, &mut queue);
            }
        }
        side.into_iter().map(|s| s.unwrap_or(false)).collect()
    }

    fn visit(
        &self,
        face: FixedFaceHandle<PossiblyOuterTag>,
        inside: bool,
        side: &mut [Option<bool>],
        queue: &mut Vec<(FixedFaceHandle<PossiblyOuterTag>, bool)>,
    ) {
        if side[face.index()].is_none() {
            side[face.index()] = Some(inside);
            queue.push((face, inside));
        }
    }

    fn switches(&self, edge: UndirectedEdgeHandle<'_, Site, (), spade::CdtEdge<()>, ()>) -> bool {
        edge.is_constraint_edge() && {
            let [a, b] = edge.vertices().map(|v| v.data().index);
            self.slits.is_empty() || !self.slits.contains(&(a.min(b), a.max(b)))
        }
    }

    /// Where boundary segments are missing, each triangle is asked for its own middle.
    fn inside_by_centre(&self) -> Vec<bool> {
        let mut inside = vec![false; self.cdt.num_all_faces()];
        for face in self.cdt.inner_faces() {
            let [a, b, c] = face.vertices().map(|v| v.data().at);
            let centre = (a + b + c) / 3.0;
            inside[face.index()] = self.domain.contain(centre);
        }
        inside
    }

    /// The triangles, counter-clockwise: index of the face and its sites.
    pub fn triangles(&self) -> impl Iterator<Item = (usize, [u32; 3])> + '_ {
        self.cdt.inner_faces().map(|f: spade::handles::FaceHandle<'_, InnerTag, _, _, _, _>| {
            (f.index(), f.vertices().map(|v| v.data().index))
        })
    }

    /// The edges that are no boundary and end at a site from `fresh` on.
    pub fn inner_edges(&self, fresh: u32) -> impl Iterator<Item = InnerEdge> + '_ {
        let all = (fresh == 0).then(|| self.cdt.undirected_edges().map(|edge| edge.as_directed()));
        let spokes = (fresh > 0).then(|| self.spokes(fresh)).into_iter().flatten().filter(move |edge| {
            let [from, to] = edge.vertices().map(|v| v.data().index);
            to < fresh || to < from
        });
        let edges = all.into_iter().flatten().chain(spokes);
        edges.filter(|edge| !edge.is_constraint_edge()).map(InnerEdge::new)
    }

    /// The triangles with a site from `fresh` on, as [`Self::triangles`] gives them.
    pub fn triangles_at(&self, fresh: u32) -> impl Iterator<Item = (usize, [u32; 3])> + '_ {
        let all = (fresh == 0).then(|| self.triangles()).into_iter().flatten();
        let round = (fresh > 0).then(|| self.spokes(fresh)).into_iter().flatten().filter_map(|edge| {
            let face = edge.face().as_inner()?;
            let sites = face.vertices().map(|v| v.data().index);
            let is_newest = sites.iter().max() == Some(&edge.from().data().index);
            is_newest.then(|| (face.index(), sites))
        });
        all.chain(round)
    }

    /// The edges out of sites from `fresh` on.
    fn spokes(
        &self,
        fresh: u32,
    ) -> impl Iterator<Item = DirectedEdgeHandle<'_, Site, (), spade::CdtEdge<()>, ()>> {
        let sites = fresh as usize..self.cdt.num_vertices();
        sites.flat_map(|site| self.cdt.vertex(FixedVertexHandle::from_index(site)).out_edges())
    }

    /// The sites across from an edge in the faces on its sides.
    pub fn opposite(&self, edge: &InnerEdge) -> [Option<u32>; 2] {
        let edge = self.cdt.directed_edge(edge.edge);
        [edge, edge.rev()].map(|side| side.opposite_vertex().map(|v| v.data().index))
    }
}

fn sorted(mut sites: [u32; 3]) -> [u32; 3] {
    sites.sort_unstable();
    sites
}

/// How often the boundary runs over each pair of sites.
fn segment_uses(polygons: &[Vec<DVec2>], site_of_corner: &[u32]) -> FxHashMap<(u32, u32), u32> {
    let mut uses = FxHashMap::default();
    let mut first = 0;
    for polygon in polygons {
        let n = polygon.len();
        for i in 0..n {
            let (a, b) = (site_of_corner[first + i], site_of_corner[first + (i + 1) % n]);
            if a != b {
                *uses.entry((a.min(b), a.max(b))).or_insert(0) += 1;
            }
        }
        first += n;
    }
    uses
}

#[cfg(test)]
mod tests {
    use super::*;
    use trimloop_geom::{Frame, Surface};
    use trimloop_trim::{Tolerance, TrimLoop, TrimVertex};

    /// A domain in a plane between one loop's corners, and its warp.
    fn in_a_plane(corners: &[DVec2]) -> (TrimDomain, Warp) {
        let vertex = |(k, &uv): (usize, &DVec2)| TrimVertex { uv, point: k as u32 };
        let vertices = corners.iter().enumerate().map(vertex).collect();
        let loops = vec![TrimLoop { vertices, turned: false }];
        let own_base = corners.len() as u32;
        let domain = TrimDomain { loops, own_points: Vec::new(), own_base, diagnostics: Vec::new() };
        let surface = Surface::Plane { frame: Frame::WORLD };
        let tolerance = Tolerance { linear_mm: 0.1, angular_rad: 0.3 };
        let (low, high) = domain.uv_bounds();
        (domain, Warp::new(&surface, low, high, tolerance, 100, false))
    }

    #[test]
    fn a_boundary_that_crosses_itself_all_over_is_refused_before_it_is_triangulated() {
        let star = |count: usize, step: usize| -> Vec<DVec2> {
            let at = |k| std::f64::consts::TAU * (k * step % count) as f64 / count as f64;
            (0..count).map(|k| DVec2::from_angle(at(k))).collect()
        };
        let (domain, warp) = in_a_plane(&star(200_001, 100_000));
        let refused = Triangulation::new(&domain, &[], &warp).err();
        assert_eq!(refused, Some(Untriangulable::Tangled));
        let (domain, warp) = in_a_plane(&star(5, 2));
        assert!(Triangulation::new(&domain, &[], &warp).is_ok_and(|it| !it.intact));
    }

    #[test]
    fn a_point_on_a_site_leaves_the_site_as_it_is() {
        let (domain, warp) = in_a_plane(&[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
        let mut triangulation = Triangulation::new(&domain, &[], &warp).expect("a square");
        assert_eq!(triangulation.insert(warp.map(DVec2::ONE), 0), None);
        assert_eq!(triangulation.insert(warp.map(DVec2::splat(0.5)), 0), Some(4));
        assert!(triangulation.triangles().all(|(_, sites)| sites.iter().all(|&site| site < 5)));
        assert_eq!(triangulation.triangles().filter(|(_, sites)| sites.contains(&2)).count(), 2);
    }

    /// Between two dense rows that are far apart every point sees thousands of others.
    #[test]
    fn points_between_dense_rows_are_given_up() {
        const COUNT: u32 = 4000;
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array);
        let (domain, warp) = in_a_plane(&corners);
        let at = |k: u32, y: f64| DVec2::new((f64::from(k) + 0.5) / f64::from(COUNT), y);
        let rows: Vec<DVec2> = (0..COUNT).flat_map(|k| [at(k, 0.2), at(k, 0.8)]).collect();
        let mut triangulation = Triangulation::new(&domain, &rows, &warp).expect("a square");
        let mut added = 0;
        while added < COUNT && !triangulation.is_uneven() {
            triangulation.insert(warp.map(at(added, 0.5)), 0);
            added += 1;
        }
        assert!((100..COUNT).contains(&added), "{added}");
    }
}
