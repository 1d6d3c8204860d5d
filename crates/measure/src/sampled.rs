//! An item as elements, on which minima of distances may lie, and as simplices near them, from which to start.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use trimloop_brep::{Edge, FaceGeometry, Part};
use trimloop_geom::{Aabb, Curve, Direction, Interval, Surface};
use trimloop_mesh::{FaceMesh, FaceStatus, LinearDeflection, MeshOptions, PartMesh, Silent, mesh_part};
use trimloop_trim::{Classifier, EdgeSamples, Side, Tolerance, TrimDomain, sample_edges};

use crate::Item;
use crate::bvh::Bvh;
use crate::element::Element;
use crate::isolines::{Isoline, creases, sides};
use crate::simplex::Simplex;

/// Samples are this near to the exact shape, as a share of the item's size: near enough to start from.
const DEFLECTION: f64 = 1e-3;
/// And turn by no more than this from one to the next.
const ANGLE_DEG: f64 = 20.0;
/// Deflections are measured at a few places; elsewhere they may be a little more.
const MARGIN: f64 = 1.5;

/// The item on its own, sampled, in its part's coordinates.
pub(crate) struct Ground {
    pub part: Part,
    samples: EdgeSamples,
    domain: Option<TrimDomain>,
    mesh: Option<PartMesh>,
    deflection_mm: f64,
}

impl Ground {
    /// Samples the item.
    pub fn new(item: &Item) -> Self {
        let part = item.alone();
        let deflection_mm = (DEFLECTION * size_mm(&part)).max(1e-9);
        let angular_rad = ANGLE_DEG.to_radians();
        let tolerance = Tolerance { linear_mm: deflection_mm * 0.9, angular_rad };
        let samples = sample_edges(&part, tolerance);
        let is_surface = part.faces.first().is_some_and(|f| matches!(f.geometry, FaceGeometry::Surface(_)));
        let domain = if is_surface { TrimDomain::new(&part, 0, &samples, tolerance).ok() } else { None };
        let options = MeshOptions {
            linear_deflection: LinearDeflection::Absolute(deflection_mm),
            angular_deflection_rad: angular_rad,
            max_triangles: 200_000,
        };
        let mesh = if part.faces.is_empty() { None } else { mesh_part(&part, &options, &Silent).ok() };
        Self { part, samples, domain, mesh, deflection_mm }
    }

    /// The item's triangles.
    fn face_mesh(&self) -> Option<(&PartMesh, &FaceMesh)> {
        self.mesh.as_ref().and_then(|mesh| mesh.faces.first().map(|face| (mesh, face)))
    }
}

/// The diagonal of a box around the part's edges, or around a closed surface.
fn size_mm(part: &Part) -> f64 {
    let edges = part.edges.iter().map(|e| e.curve.bounds(e.range));
    let points = part.facet_points.iter().copied().chain(part.vertices.iter().map(|v| v.point));
    let mut bounds = edges.fold(Aabb::from_points(points), Aabb::union);
    if part.edges.is_empty() {
        for face in &part.faces {
            if let FaceGeometry::Surface(surface) = &face.geometry {
                let domain = surface.domain();
                if domain.iter().all(|d| d.is_finite()) {
                    bounds = bounds.union(surface.bounds(domain));
                }
            }
        }
    }
    let size = bounds.diagonal();
    if size.is_finite() { size } else { 1.0 }
}

/// An item in the world.
pub(crate) struct Sampled<'g> {
    pub elements: Vec<Element>,
    /// For each element how far its samples may be from it.
    pub slack: Vec<f64>,
    pub tree: Bvh,
    /// Lines on the surface, of which only what is inside counts: elements from the first to before the last.
    creases: std::ops::Range<u32>,
    /// The face, for telling what is inside.
    classifier: Option<Classifier<'g>>,
    periods: [Option<f64>; 2],
    /// Whether the elements are the whole of the item: not so for faces whose surface could not be used.
    pub is_whole: bool,
}

impl<'g> Sampled<'g> {
    /// A single point.
    pub fn of_point(point: DVec3) -> Self {
        Self {
            elements: vec![Element::Point(point)],
            slack: vec![0.0],
            tree: Bvh::new(vec![Simplex::point(point, 0)]),
            creases: 0..0,
            classifier: None,
            periods: [None; 2],
            is_whole: true,
        }
    }

    /// The ground in its place; `None` where there is nothing.
    pub fn new(ground: &'g Ground, map: &DAffine3) -> Option<Self> {
        let mut builder = Builder {
            ground,
            map,
            elements: Vec::new(),
            slack: Vec::new(),
            simplices: Vec::new(),
            creases: 0..0,
        };
        let mut classifier = None;
        let mut periods = [None; 2];
        let mut is_whole = true;
        if let Some(face) = ground.part.faces.first() {
            match &face.geometry {
                FaceGeometry::Surface(surface) => {
                    classifier = builder.surface(surface);
                    periods = surface.periods();
                    is_whole = classifier.is_some();
                }
                FaceGeometry::Facets(_) => builder.triangles(),
                FaceGeometry::Unreadable(_) => return None,
            }
        }
        for index in 0..ground.part.edges.len() {
            builder.edge(index);
        }
        ground.part.vertices.iter().for_each(|v| builder.point(v.point));
        let Builder { elements, slack, mut simplices, creases, .. } = builder;
        simplices.retain(|s| s.corners.iter().all(|c| c.is_finite()));
        (!simplices.is_empty()).then(|| Self {
            elements,
            slack,
            tree: Bvh::new(simplices),
            creases,
            classifier,
            periods,
            is_whole,
        })
    }

    /// Whether a place on an element belongs to the item. Surfaces of revolution and the like may be asked with whole
    /// turns too many.
    pub fn contains(&self, element: u32, at: DVec2) -> bool {
        match &self.elements[element as usize] {
            Element::Curve { curve, .. } if self.creases.contains(&element) => {
                Isoline::parameters(curve, at.x).is_some_and(|uv| self.is_inside(uv))
            }
            Element::Point(_) | Element::Curve { .. } => true,
            Element::Triangle { .. } => at.min_element() >= -1e-12 && at.x + at.y <= 1.0 + 1e-12,
            Element::Surface { .. } => self.is_inside(at),
        }
    }

    /// Whether parameters of the surface lie in the face.
    fn is_inside(&self, uv: DVec2) -> bool {
        let Some(classifier) = &self.classifier else { return false };
        let of_v = self.shifts(1);
        let shifts = self.shifts(0).into_iter().flat_map(|u| of_v.iter().map(move |&v| DVec2::new(u, v)));
        shifts.into_iter().any(|shift| classifier.classify(uv + shift) == Side::Inside)
    }

    /// Whole periods that a parameter may be off by.
    fn shifts(&self, k: usize) -> Vec<f64> {
        match self.periods[k] {
            Some(period) => [0.0, 1.0, -1.0, 2.0, -2.0].map(|turns| turns * period).to_vec(),
            None => vec![0.0],
        }
    }

    /// The largest coordinate.
    pub fn extent(&self) -> f64 {
        let bounds = self.tree.bounds();
        bounds.min.abs().max(bounds.max.abs()).max_element()
    }

    /// The largest slack of all.
    pub fn most_slack(&self) -> f64 {
        self.slack.iter().copied().fold(0.0, f64::max)
    }
}

struct Builder<'g, 'm> {
    ground: &'g Ground,
    map: &'m DAffine3,
    elements: Vec<Element>,
    slack: Vec<f64>,
    simplices: Vec<Simplex>,
    creases: std::ops::Range<u32>,
}

impl<'g> Builder<'g, '_> {
    fn add(&mut self, element: Element, slack_mm: f64) -> u32 {
        self.elements.push(element);
        self.slack.push(slack_mm * stretch(self.map));
        self.elements.len() as u32 - 1
    }

    /// A point given in the part's coordinates.
    fn point(&mut self, point: DVec3) {
        let point = self.map.transform_point3(point);
        let element = self.add(Element::Point(point), 0.0);
        self.simplices.push(Simplex::point(point, element));
    }

    /// The inside of the face; plain triangles where its parameters make no sense.
    fn surface(&mut self, surface: &Arc<Surface>) -> Option<Classifier<'g>> {
        let Ground { part, samples, domain, deflection_mm, .. } = self.ground;
        let (mesh, face) = self.ground.face_mesh()?;
        let Some(domain) = domain.as_ref().filter(|_| !matches!(face.status, FaceStatus::Lost(_))) else {
            self.triangles();
            return None;
        };
        let classifier = Classifier::new(part, 0, samples, domain)?;
        let is_straight = part.edges.iter().all(|edge| matches!(*edge.curve, Curve::Line { .. }));
        let rim = if is_straight && !part.edges.is_empty() { 0.0 } else { *deflection_mm };
        let limits = limits(surface, domain);
        let (surface, map) = (surface.clone(), *self.map);
        let poles = surface.singularities();
        let element =
            self.add(Element::Surface { surface, limits, map }, MARGIN * face.max_deviation_mm.max(rim));
        let mut is_met = vec![false; poles.len()];
        for t in &face.triangles {
            let vertices = t.map(|index| face.vertices[index as usize]);
            let corners = vertices.map(|v| mesh.positions[v.position as usize]);
            let mut parameters = vertices.map(|v| v.uv);
            for (pole, is_met) in poles.iter().zip(&mut is_met) {
                let reach = 1e-7 * (deflection_mm / DEFLECTION);
                if let Some(k) = (0..3).find(|&k| corners[k].distance(pole.point) <= reach) {
                    *is_met = true;
                    // The free parameter of a pole says nothing.
                    let free = if pole.constant == Direction::U { 1 } else { 0 };
                    parameters[k][free] =
                        (parameters[(k + 1) % 3][free] + parameters[(k + 2) % 3][free]) * 0.5;
                }
            }
            let corners = corners.map(|c| self.map.transform_point3(c));
            self.simplices.push(Simplex { corners, count: 3, element, parameters });
        }
        self.isolines(domain);
        for (pole, _) in poles.iter().zip(is_met).filter(|(_, is_met)| *is_met) {
            self.point(pole.point);
        }
        Some(classifier)
    }

    /// What has no edge of its own: creases, and the sides of a surface without loops.
    fn isolines(&mut self, domain: &TrimDomain) {
        let part = &self.ground.part;
        let Some(FaceGeometry::Surface(surface)) = part.faces.first().map(|face| &face.geometry) else {
            return;
        };
        if domain.loops.is_empty() {
            return;
        }
        let (low, high) = domain.uv_bounds();
        let within = [0, 1].map(|k| Interval::new(low[k], high[k]));
        if part.edges.is_empty() {
            for side in sides(surface) {
                [side.range.start, side.range.end].into_iter().for_each(|t| self.point(side.curve.point(t)));
                self.isoline(&side, |_| true);
            }
        }
        let creases = creases(surface, within);
        let first = self.elements.len() as u32;
        // The polygons leave out what is within a chord's sag of an edge; there the edge's own samples are.
        let is_near = |uv: DVec2| domain.contains(uv);
        creases.iter().for_each(|crease| self.isoline(crease, is_near));
        self.creases = first..self.elements.len() as u32;
        self.crossings(&creases, is_near);
    }

    fn isoline(&mut self, line: &Isoline, is_near: impl Fn(DVec2) -> bool) {
        let (curve, limits, map) = (line.curve.clone(), line.range, *self.map);
        let element = self.add(Element::Curve { curve, limits, map }, MARGIN * line.sag());
        for w in line.samples.windows(2) {
            let inside = |t: f64| Isoline::parameters(&line.curve, t).is_some_and(&is_near);
            if !w.iter().any(|&t| inside(t)) {
                continue;
            }
            let [a, b] = [w[0], w[1]].map(|t| self.map.transform_point3(line.curve.point(t)));
            let [s, e] = [w[0], w[1]].map(|t| DVec2::new(t, 0.0));
            self.simplices.push(Simplex { corners: [a, b, a], count: 2, element, parameters: [s, e, s] });
        }
    }

    /// Where creases along u cross those along v.
    fn crossings(&mut self, creases: &[Isoline], is_near: impl Fn(DVec2) -> bool) {
        let Some(Curve::OnSurface { surface, .. }) = creases.first().map(|crease| &*crease.curve) else {
            return;
        };
        let places = creases.iter().filter_map(|c| match &*c.curve {
            Curve::OnSurface { pcurve, .. } => Some(pcurve.derivatives(0.0)),
            _ => None,
        });
        let (along_v, along_u): (Vec<_>, Vec<_>) = places.partition(|[_, way, _]| way.x == 0.0);
        for u in along_v.iter().map(|[at, ..]| at.x) {
            let crossings = along_u.iter().map(|[at, ..]| DVec2::new(u, at.y));
            crossings.filter(|uv| is_near(*uv)).for_each(|uv| self.point(surface.point(uv)));
        }
    }

    /// Triangles that stand for themselves.
    fn triangles(&mut self) {
        let Some((mesh, face)) = self.ground.face_mesh() else { return };
        for t in &face.triangles {
            let corners = t.map(|index| mesh.positions[face.vertices[index as usize].position as usize]);
            let corners = corners.map(|c| self.map.transform_point3(c));
            let [corner, b, c] = corners;
            let element = self.add(Element::Triangle { corner, sides: [b - corner, c - corner] }, 0.0);
            let parameters = [DVec2::ZERO, DVec2::X, DVec2::Y];
            self.simplices.push(Simplex { corners, count: 3, element, parameters });
        }
    }

    /// The chords of an edge, and its corners.
    fn edge(&mut self, index: usize) {
        let (edge, samples) = (&self.ground.part.edges[index], &self.ground.samples);
        let Some(sampled) = samples.edges.get(index) else { return };
        let is_straight = matches!(*edge.curve, Curve::Line { .. });
        let slack = if is_straight { 0.0 } else { MARGIN * self.ground.deflection_mm };
        // A closed edge has no ends.
        let is_closed = edge.start == edge.end
            && edge.curve.period().is_some_and(|period| edge.range.length() >= period * (1.0 - 1e-9));
        let limits = if is_closed { Interval::INFINITE } else { edge.range };
        let element = self.add(Element::Curve { curve: edge.curve.clone(), limits, map: *self.map }, slack);
        for (points, t) in sampled.points.windows(2).zip(sampled.parameters.windows(2)) {
            let [a, b] =
                [points[0], points[1]].map(|p| self.map.transform_point3(samples.points[p as usize]));
            let [s, e] = [t[0], t[1]].map(|t| DVec2::new(t, 0.0));
            self.simplices.push(Simplex { corners: [a, b, a], count: 2, element, parameters: [s, e, s] });
        }
        kinks(edge).into_iter().for_each(|kink| self.point(kink));
    }
}

/// The box in which to seek: that of the face and half as much around it, where the surface goes on.
fn limits(surface: &Surface, domain: &TrimDomain) -> [Interval; 2] {
    let (low, high) = domain.uv_bounds();
    let (own, periods) = (surface.domain(), surface.periods());
    [0, 1].map(|k| {
        let room = 0.5 * (high[k] - low[k]);
        let wide = Interval::new(low[k] - room, high[k] + room);
        if periods[k].is_some() {
            wide
        } else {
            Interval::new(wide.start.max(own[k].start), wide.end.min(own[k].end))
        }
    })
}

/// The most corners of a curve that are looked at.
const MOST_KINKS: usize = 10_000;

/// Where the edge's tangent turns at once, away from its ends.
fn kinks(edge: &Edge) -> Vec<DVec3> {
    if !matches!(
        *edge.curve,
        Curve::Polyline(_)
            | Curve::Nurbs(_)
            | Curve::Composite(_)
            | Curve::OnSurface { .. }
            | Curve::Offset(_)
    ) {
        return Vec::new();
    }
    let breaks = edge.curve.breakpoints(edge.range);
    let inner = breaks.windows(3).filter_map(|w| {
        let before = edge.curve.derivatives(w[1] - 1e-7 * (w[1] - w[0]))[1];
        let [point, after, _] = edge.curve.derivatives(w[1]);
        (before.angle_between(after) > 1e-5).then_some(point)
    });
    inner.take(MOST_KINKS).collect()
}

/// A bound of what a map does to lengths (Gershgorin's, of the square of its matrix); exact for similarities.
fn stretch(map: &DAffine3) -> f64 {
    let m = map.matrix3.transpose() * map.matrix3;
    let sums = m.to_cols_array_2d().map(|column| column.iter().map(|c| c.abs()).sum::<f64>());
    sums.into_iter().fold(0.0, f64::max).sqrt()
}
