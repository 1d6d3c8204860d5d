//! Triangles for a domain, refined until they keep to the exact surface.

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use trimloop_geom::{Interval, Surface};
use trimloop_trim::{EdgeSamples, Tolerance, TrimDomain, TrimVertex, doubtful_quarters};

use crate::FaceVertex;
use crate::crease::Creases;
use crate::fringe::Fringe;
use crate::seeds::seeds;
use crate::triangulation::{InnerEdge, Triangulation, Untriangulable};
use crate::warp::Warp;

/// A domain's triangulation with what its sites are in space.
pub(crate) struct Filling<'a> {
    surface: &'a Surface,
    tolerance: Tolerance,
    creases: Creases,
    /// No second derivatives by u twice, by both and by v twice are longer than these, where that is known.
    bends: Option<[f64; 3]>,
    fringe: Fringe,
    warp: Warp,
    triangulation: Triangulation,
    /// Per face of the triangulation as it is now whether it lies inside the domain, where that is known.
    inside: Option<Vec<bool>>,
    /// Room for what is known of the triangles' sides, kept from round to round.
    sides: Vec<MeasuredSides>,
    sites: Vec<SiteInSpace>,
    /// The number of the first point that this filling adds, and of the next one.
    first_inner: u32,
    next_point: u32,
    /// The largest deviation that was accepted.
    pub max_deviation_mm: f64,
    /// The largest one found in the last round, which was not.
    unmet_mm: f64,
    /// How far the edges lie off the surface.
    pub max_lift_mm: f64,
    /// Whether everything that was measured keeps the bounds.
    pub within_bounds: bool,
    /// Whether two corners that are different points fell on one site.
    merged: bool,
    max_sites: usize,
}

#[derive(Clone, Copy)]
struct SiteInSpace {
    uv: DVec2,
    point: u32,
    position: DVec3,
    /// From the surface to `position`, where that is no more than the tolerance: triangles are measured without it.
    /// Edges that are farther off have a strip in which nothing is measured.
    lift: DVec3,
    normal: DVec3,
    /// Whether it is one of several sites for a single point: a pole, where the normal is whatever one likes.
    pole: bool,
    /// Whether the surface's normal jumps here.
    creased: bool,
}

impl SiteInSpace {
    fn on_surface(&self) -> DVec3 {
        self.position - self.lift
    }
}

/// An edge held against the surface.
#[derive(Default)]
struct MeasuredEdge {
    /// Where it is to be split.
    split: Option<DVec2>,
    /// How far it is from the surface, at some places or at most.
    off: f64,
    /// Whether it is nowhere farther off than that.
    is_bound: bool,
}

/// What is known of a triangle by its sides.
#[derive(Clone, Copy, Default)]
struct MeasuredSides {
    /// Whether one of them is to be split.
    broken: bool,
    count: u8,
    bounds: u8,
    /// The sum of their deviations.
    sum: f64,
}

impl MeasuredSides {
    fn add(&mut self, edge: &MeasuredEdge) {
        self.count += 1;
        self.bounds += u8::from(edge.is_bound);
        self.sum += edge.off;
    }

    /// How far the surface is from the triangle's middle, where that need not be measured to know that it is within the
    /// tolerance. A quadric that is zero in the corners has 4/9 of the sum of its values in the middles of the sides
    /// there; what bounds second derivatives for the sides does so for the middle, in the same ratio.
    fn middle(&self, tolerance_mm: f64) -> Option<f64> {
        let off = self.sum * 4.0 / 9.0;
        let enough = if self.bounds == 3 { tolerance_mm } else { CLEARLY_WITHIN * tolerance_mm };
        (self.count == 3 && off <= enough).then_some(off)
    }
}

/// A triangle whose middle is as near as this part of the tolerance, by measures at its sides, is not measured there.
const CLEARLY_WITHIN: f64 = 0.5;

/// An edge across a crease is to be nearer than this part of the tolerance.
const CREASE_SHARE: f64 = 0.25;

/// Edges that are measured together, and the fewest edges or points that another thread is worth waking for.
const BATCH: usize = 8192;
const LEAST_SHARE: usize = 512;

/// Rounds of refinement; each halves what is still too long.
const MAX_ROUNDS: usize = 16;

impl<'a> Filling<'a> {
    /// The first triangulation of `domain`, or why it has none.
    pub fn new(
        surface: &'a Surface,
        domain: &TrimDomain,
        samples: &EdgeSamples,
        tolerance: Tolerance,
        max_sites: usize,
    ) -> Result<Self, Untriangulable> {
        let (low, high) = domain.uv_bounds();
        let warp = Warp::new(surface, low, high, tolerance, max_sites, has_pole(domain));
        let fringe = fringe(surface, domain, samples, tolerance);
        let mut inner = seeds(domain, &warp);
        if !fringe.is_empty() {
            inner.retain(|&uv| !fringe.holds(surface.point(uv)));
        }
        let triangulation = Triangulation::new(domain, &inner, &warp)?;
        let first_inner = domain.own_base + domain.own_points.len() as u32;
        let mut filling = Self {
            surface,
            tolerance,
            creases: Creases::new(surface, low, high),
            bends: bends(surface, low, high),
            fringe,
            warp,
            sites: Vec::with_capacity(triangulation.len()),
            triangulation,
            inside: None,
            sides: Vec::new(),
            first_inner,
            next_point: first_inner,
            max_deviation_mm: 0.0,
            unmet_mm: 0.0,
            max_lift_mm: 0.0,
            within_bounds: true,
            merged: false,
            max_sites,
        };
        filling.place_corners(domain, samples);
        let new = std::mem::take(&mut filling.triangulation.inner_is_new);
        let new: Vec<DVec2> = inner.into_iter().zip(new).filter(|(_, new)| *new).map(|(uv, _)| uv).collect();
        let mut sites = std::mem::take(&mut filling.sites);
        let placed = new.par_iter().with_min_len(LEAST_SHARE).enumerate();
        sites.par_extend(placed.map(|(k, &uv)| filling.inner_site(uv, first_inner + k as u32)));
        filling.next_point += new.len() as u32;
        filling.sites = sites;
        Ok(filling)
    }

    fn place_corners(&mut self, domain: &TrimDomain, samples: &EdgeSamples) {
        let corners = domain.loops.iter().flat_map(|l| {
            let before = l.vertices.iter().cycle().skip(l.vertices.len() - 1);
            let after = l.vertices.iter().cycle().skip(1);
            let same = |a: &TrimVertex, b: &TrimVertex| a.point == b.point && a.uv != b.uv;
            l.vertices.iter().zip(before.zip(after)).map(move |(v, (a, b))| (v, same(v, a) || same(v, b)))
        });
        let sites = std::mem::take(&mut self.triangulation.site_of_corner);
        for ((corner, pole), &site) in corners.zip(&sites) {
            if site as usize == self.sites.len() {
                let position = domain.point(corner, samples);
                let (on_surface, normal) = self.point_and_normal(corner.uv);
                let creased = self.creases.hold(corner.uv);
                let lift = position - on_surface;
                self.max_lift_mm = self.max_lift_mm.max(lift.length());
                let lift = if lift.length() > self.tolerance.linear_mm { DVec3::ZERO } else { lift };
                self.sites.push(SiteInSpace {
                    uv: corner.uv,
                    point: corner.point,
                    position,
                    lift,
                    normal,
                    pole,
                    creased,
                });
            } else if self.sites[site as usize].point != corner.point {
                self.merged = true;
            }
        }
        self.triangulation.site_of_corner = sites;
    }

    fn place_inner(&mut self, uv: DVec2) {
        self.sites.push(self.inner_site(uv, self.next_point));
        self.next_point += 1;
    }

    fn inner_site(&self, uv: DVec2, point: u32) -> SiteInSpace {
        let (position, normal) = self.point_and_normal(uv);
        let creased = self.creases.hold(uv);
        SiteInSpace { uv, point, position, lift: DVec3::ZERO, normal, pole: false, creased }
    }

    fn point_and_normal(&self, uv: DVec2) -> (DVec3, DVec3) {
        if self.creases.within(uv) != uv {
            return (self.surface.point(uv), self.normal(uv));
        }
        let (point, normal) = self.surface.point_and_normal(uv);
        (point, normal.unwrap_or(DVec3::ZERO))
    }

    fn normal(&self, uv: DVec2) -> DVec3 {
        self.surface.normal(self.creases.within(uv)).unwrap_or(DVec3::ZERO)
    }

    /// Whether the triangles end exactly at the domain's boundary.
    pub fn intact(&self) -> bool {
        self.triangulation.intact && !self.merged
    }

    /// Adds points until every inner edge and every triangle keeps the bounds.
    pub fn refine(&mut self) {
        let mut fresh = 0;
        for round in 0..=MAX_ROUNDS {
            if self.triangulation.is_tangled() {
                return self.give_up();
            }
            let wanted = self.violations(fresh);
            if wanted.is_empty() {
                return;
            }
            if round == MAX_ROUNDS || self.sites.len() + wanted.len() > self.max_sites {
                return self.give_up();
            }
            fresh = self.sites.len() as u32;
            if let Some(inside) = self.inside.take() {
                self.triangulation.remember(&inside);
            }
            for (at, hint) in wanted {
                if self.triangulation.is_uneven() {
                    return self.give_up();
                }
                if self.triangulation.insert(at, hint).is_some() {
                    self.place_inner(self.warp.unmap(at));
                }
            }
        }
    }

    /// Leaves what the last round found as it is.
    fn give_up(&mut self) {
        self.within_bounds = false;
        self.max_deviation_mm = self.max_deviation_mm.max(self.unmet_mm);
    }

    /// Warped points at which edges or triangles with a site from `fresh` on break a bound, each with a site nearby.
    fn violations(&mut self, fresh: u32) -> Vec<(DVec2, u32)> {
        // Round new sites all lies inside, mostly; nothing else is looked at.
        let all_inside = fresh > 0 && self.triangulation.new_sites_are_inside();
        let inside = if all_inside { Vec::new() } else { self.triangulation.inside() };
        let is_inside = |face: u32| all_inside || inside[face as usize];
        let mut sides = std::mem::take(&mut self.sides);
        sides.clear();
        sides.resize(self.triangulation.face_count(), MeasuredSides::default());
        let mut out = Vec::new();
        let (mut worst, mut unmet) = (self.max_deviation_mm, 0.0_f64);
        let mut edges =
            self.triangulation.inner_edges(fresh).filter(|edge| edge.faces.iter().any(|&f| is_inside(f)));
        let (mut batch, mut measured) = (Vec::new(), Vec::new());
        loop {
            batch.clear();
            batch.extend(edges.by_ref().take(BATCH));
            if batch.is_empty() {
                break;
            }
            let measure = |edge: &InnerEdge| {
                let mut measured = self.measure_edge(edge.sites);
                let is_split = |&at: &DVec2| self.is_open(at) && !self.is_hair(edge, is_inside, measured.off);
                measured.split = measured.split.filter(is_split);
                measured
            };
            batch.par_iter().with_min_len(LEAST_SHARE).map(measure).collect_into_vec(&mut measured);
            for (edge, measured) in batch.iter().zip(&measured) {
                let faces = edge.faces.map(|face| face as usize);
                match measured.split {
                    Some(at) => {
                        faces.iter().for_each(|&f| sides[f].broken = true);
                        unmet = unmet.max(measured.off);
                        out.push((at, edge.sites[0]));
                    }
                    None => {
                        worst = worst.max(measured.off);
                        faces.iter().for_each(|&f| sides[f].add(measured));
                    }
                }
            }
        }
        drop(edges);
        for (face, t) in self.triangulation.triangles_at(fresh) {
            if !is_inside(face as u32) || sides[face].broken {
                continue;
            }
            if let Some(off) = sides[face].middle(self.tolerance.linear_mm) {
                worst = worst.max(off);
                continue;
            }
            let (at, off) = self.triangle_violation(t);
            match at {
                Some(at) if self.is_open(at) => {
                    unmet = unmet.max(off);
                    out.push((at, t[0]));
                }
                _ => worst = worst.max(off),
            }
        }
        self.max_deviation_mm = worst;
        self.unmet_mm = unmet;
        self.sides = sides;
        self.inside = (!all_inside).then_some(inside);
        out
    }

    /// Whether an edge that is near enough to the surface has nothing but slivers on both sides. The normals may turn
    /// along it whatever way they like, as they do beside a border where the surface's derivatives vanish.
    fn is_hair(&self, edge: &InnerEdge, is_inside: impl Fn(u32) -> bool, off: f64) -> bool {
        if off > self.tolerance.linear_mm {
            return false;
        }
        let [a, b] = edge.sites.map(|site| self.sites[site as usize].position);
        let along = (b - a).normalize_or_zero();
        let beside = self.triangulation.opposite(edge).into_iter().zip(edge.faces);
        beside.filter(|&(_, face)| is_inside(face)).filter_map(|(site, _)| site).all(|site| {
            let across = self.sites[site as usize].position - a;
            across.reject_from_normalized(along).length() < self.shortest_turn_mm()
        })
    }

    /// Whether a point may be added at the warped place `at`.
    fn is_open(&self, at: DVec2) -> bool {
        self.fringe.is_empty() || !self.fringe.holds(self.surface.point(self.warp.unmap(at)))
    }

    fn measure_edge(&self, [a, b]: [u32; 2]) -> MeasuredEdge {
        let (sa, sb) = (&self.sites[a as usize], &self.sites[b as usize]);
        if sa.point == sb.point {
            return MeasuredEdge::default();
        }
        let bound = self.tolerance.linear_mm;
        let turned = self.turns(sa, sb) && sa.position.distance(sb.position) > self.shortest_turn_mm();
        if let Some(off) = self.sag_bound(sa, sb).filter(|&off| off <= bound) {
            return MeasuredEdge { split: turned.then(|| self.between(a, b, 0.5)), off, is_bound: true };
        }
        // An edge that crosses a crease is split there, for its sides to lie on smooth pieces.
        let crossing = self.creases.crossing(sa.uv, sb.uv);
        let measured = |split, off| MeasuredEdge { split, off, is_bound: false };
        let mut off = 0.0;
        if let Some((share, uv)) = crossing {
            let at = self.warp.map(uv);
            off = self.above(at, sa.on_surface().lerp(sb.on_surface(), share)).abs();
            // Between two crossings the crease runs on through a triangle, out of its edges' sight.
            if off > bound * CREASE_SHARE {
                return measured(Some(at), off);
            }
        }
        let middle = self.off_chord(a, b, 0.5);
        off = off.max(middle.abs());
        let chord = sb.on_surface() - sa.on_surface();
        let normals = [sa, sb].map(|site| if site.creased { DVec3::ZERO } else { site.normal });
        for quarter in doubtful_quarters(chord, normals, middle, bound) {
            off = off.max(self.off_chord(a, b, quarter).abs());
        }
        let crossing = if turned {
            crossing
        } else if off > bound {
            crossing.filter(|(share, _)| (0.1..=0.9).contains(share))
        } else {
            return measured(None, off);
        };
        let at = crossing.map_or_else(|| self.between(a, b, 0.5), |(_, uv)| self.warp.map(uv));
        measured(Some(at), off)
    }

    /// Whether the surface's normal turns too far from one site to the other.
    fn turns(&self, a: &SiteInSpace, b: &SiteInSpace) -> bool {
        !(a.pole || b.pole || a.creased || b.creased)
            && a.normal.dot(b.normal) < (self.tolerance.angular_rad * 1.001).cos()
            && a.normal != DVec3::ZERO
            && b.normal != DVec3::ZERO
    }

    /// More than the surface can be from the chord between two sites, by its second derivatives: an eighth of what they
    /// bend over the way from one to the other.
    fn sag_bound(&self, a: &SiteInSpace, b: &SiteInSpace) -> Option<f64> {
        let [uu, uv, vv] = self.bends.filter(|_| self.max_lift_mm <= self.tolerance.linear_mm)?;
        let step = (b.uv - a.uv).abs();
        Some((uu * step.x * step.x + 2.0 * uv * step.x * step.y + vv * step.y * step.y) / 8.0)
    }

    /// The warped point at a share of the way between two sites.
    fn between(&self, a: u32, b: u32, share: f64) -> DVec2 {
        self.triangulation.at(a).lerp(self.triangulation.at(b), share)
    }

    /// How high the surface lies above the chord between two sites, at a share of the way.
    fn off_chord(&self, a: u32, b: u32, share: f64) -> f64 {
        let [from, to] = [a, b].map(|site| self.sites[site as usize].on_surface());
        self.above(self.between(a, b, share), from.lerp(to, share))
    }

    /// Chords below this are not split for the angle's sake: a crease inside a surface would split for ever.
    fn shortest_turn_mm(&self) -> f64 {
        self.tolerance.linear_mm * 0.1
    }

    fn triangle_violation(&self, t: [u32; 3]) -> (Option<DVec2>, f64) {
        let [a, b, c] = t.map(|s| &self.sites[s as usize]);
        if a.point == b.point || b.point == c.point || c.point == a.point {
            return (None, 0.0);
        }
        let [pa, pb, pc] = t.map(|s| self.triangulation.at(s));
        let at = (pa + pb + pc) / 3.0;
        let off = self.above(at, (a.on_surface() + b.on_surface() + c.on_surface()) / 3.0).abs();
        ((off > self.tolerance.linear_mm).then_some(at), off)
    }

    /// How far along the normal the surface at the warped point `at` lies above `chord`.
    fn above(&self, at: DVec2, chord: DVec3) -> f64 {
        let d = self.surface.first_derivatives(self.warp.unmap(at));
        let gap = d.point - chord;
        match d.du.cross(d.dv).try_normalize() {
            Some(normal) => normal.dot(gap),
            None => 0.0,
        }
    }

    /// The triangles inside, as vertices and indices, and the points the filling adds (numbered on after the domain's
    /// own).
    pub fn finish(mut self) -> (Vec<FaceVertex>, Vec<[u32; 3]>, Vec<DVec3>) {
        let inside = self.inside.take().unwrap_or_else(|| self.triangulation.inside());
        let distinct = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|s| self.sites[s as usize].point);
            a != b && b != c && c != a
        };
        let mut triangles: Vec<[u32; 3]> = self
            .triangulation
            .triangles()
            .filter(|(f, t)| inside[*f] && distinct(t))
            .map(|(_, t)| t)
            .collect();
        let mut vertices: Vec<FaceVertex> =
            self.sites.iter().map(|s| FaceVertex { position: s.point, normal: s.normal, uv: s.uv }).collect();
        self.turn_pole_normals(&mut vertices, &triangles);
        self.split_normals(&mut vertices, &mut triangles);
        let first_own =
            self.sites.iter().filter(|s| s.point >= self.first_inner).map(|s| s.position).collect();
        (vertices, triangles, first_own)
    }

    /// At a pole that a surface runs on through, the normal is that of the side that the face is on.
    fn turn_pole_normals(&self, vertices: &mut [FaceVertex], triangles: &[[u32; 3]]) {
        for t in triangles.iter().filter(|t| t.iter().any(|&s| self.sites[s as usize].pole)) {
            let centre = t.iter().map(|&s| self.sites[s as usize].uv).sum::<DVec2>() / 3.0;
            for &corner in t.iter().filter(|&&s| self.sites[s as usize].pole) {
                let inside = self.normal(self.sites[corner as usize].uv.lerp(centre, 1e-3));
                let vertex = &mut vertices[corner as usize];
                if inside.dot(vertex.normal) < 0.0 {
                    vertex.normal = -vertex.normal;
                }
            }
        }
    }

    /// On creases, gives each side vertices with its own normal.
    fn split_normals(&self, vertices: &mut Vec<FaceVertex>, triangles: &mut [[u32; 3]]) {
        if self.sites.iter().all(|site| !site.creased) {
            return;
        }
        let mut known: FxHashMap<(u32, [i64; 3]), u32> = FxHashMap::default();
        for t in triangles {
            let centre = t.iter().map(|&s| self.sites[s as usize].uv).sum::<DVec2>() / 3.0;
            for corner in t {
                let site = self.sites[*corner as usize];
                let Some(beside) = self.creases.beside(site.uv, centre) else { continue };
                let normal = self.normal(beside);
                let key = (normal * 1e6).round().as_i64vec3().to_array();
                *corner = *known.entry((*corner, key)).or_insert_with(|| {
                    vertices.push(FaceVertex { normal, ..vertices[*corner as usize] });
                    vertices.len() as u32 - 1
                });
            }
        }
    }
}

/// Bounds of the second derivatives of a surface over a domain.
fn bends(surface: &Surface, low: DVec2, high: DVec2) -> Option<[f64; 3]> {
    let Surface::Nurbs(nurbs) = surface else { return None };
    nurbs.second_derivative_bounds([Interval::new(low.x, high.x), Interval::new(low.y, high.y)])
}

/// Whether the domain has a side that is a single point.
fn has_pole(domain: &TrimDomain) -> bool {
    domain.loops.iter().any(|l| l.vertices.windows(2).any(|pair| pair[0].point == pair[1].point))
}

/// The strips along the domain's edges that lie off the surface.
fn fringe(surface: &Surface, domain: &TrimDomain, samples: &EdgeSamples, tolerance: Tolerance) -> Fringe {
    let mut fringe = Fringe::default();
    if matches!(surface, Surface::Plane { .. }) {
        return fringe;
    }
    for l in &domain.loops {
        let corners = l.vertices.iter().map(|v| {
            let point = domain.point(v, samples);
            (point, point - surface.point(v.uv))
        });
        let corners: Vec<(DVec3, DVec3)> = corners.collect();
        for (k, &(from, lift)) in corners.iter().enumerate() {
            let (to, next_lift) = corners[(k + 1) % corners.len()];
            fringe.add([from, to], [lift, next_lift], tolerance.linear_mm);
        }
    }
    fringe
}
