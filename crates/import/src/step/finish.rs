//! From a part's seeds to its exact geometry: every curve, surface, edge and face on its own, in parallel.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;
use trimloop_brep::{
    Coedge, Diagnostic, Diagnostics, Edge, EntityRef, Face, FaceGeometry, Loop, Part, Severity, Vertex,
};
use trimloop_geom::{Curve, Frame, Interval, Surface};

use super::chain::mend_loops;
use super::edge_range::edge_range;
use super::fault::{Fault, Outcome};
use super::find_vertices::find_vertices;
use super::pcurve_hints::hints;
use super::reader::{Budget, Reader};
use super::seeds::{EdgeCurve, EdgeSeed, FaceSeed, FaceSurface, Seeds, VertexSeed};
use super::straighten::straighten;
use super::table::Table;
use super::units::Units;
use crate::parallel::map;

/// How far a vertex may lie off its edge's curve without being reported, millimetres, where the file states no
/// larger uncertainty.
const UNREPORTED_GAP_MM: f64 = 1e-3;

/// Reads all geometry of a part.
pub(crate) fn finish(table: &Table<'_>, budget: &Budget, mut seeds: Seeds) -> (Part, Diagnostics) {
    let stage = Stage { table, budget };
    let mut points = map(&seeds.vertices, |vertex| stage.point(vertex));
    mend_loops(&mut seeds, &points);
    let mut diagnostics = std::mem::take(&mut seeds.diagnostics);
    let curves = collect(map(&seeds.curves, |&(index, units)| stage.curve(index, units)), &mut diagnostics);
    find_vertices(&seeds, &mut points, &curves, &mut diagnostics);
    let surfaces = collect(
        map(&seeds.surfaces, |&(index, units, whole)| stage.surface(index, units, whole)),
        &mut diagnostics,
    );
    let mut edges = collect(map(&seeds.edges, |edge| stage.edge(edge, &points, &curves)), &mut diagnostics);
    straighten(table, &seeds, &points, &surfaces, &mut edges, &mut diagnostics);
    let hints = hints(table, budget, &seeds, &surfaces);
    let mut faces = Vec::with_capacity(seeds.faces.len());
    for (mut seed, hints) in seeds.faces.into_iter().zip(hints) {
        let coedges = seed.loops.iter_mut().flat_map(|bound| &mut bound.coedges);
        coedges.zip(hints).for_each(|(coedge, hint)| coedge.pcurve = hint);
        faces.push(stage.face(seed, &points, &surfaces, &edges, &mut diagnostics));
    }
    let vertices = seeds.vertices.iter().zip(&points).map(|(seed, point)| Vertex {
        entity: stage.vertex_entity(seed),
        point: point.as_ref().copied().unwrap_or_default(),
    });
    let mut part = Part {
        bodies: seeds.bodies,
        faces,
        vertices: vertices.collect(),
        curves: seeds.free_curves,
        facet_points: seeds.facet_points,
        ..Part::default()
    };
    keep_used_edges(&mut part, edges);
    (part, diagnostics)
}

/// Separates values from the notes taken while they were read.
fn collect<T>(read: Vec<(T, Diagnostics)>, diagnostics: &mut Diagnostics) -> Vec<T> {
    let values = read.into_iter().map(|(value, mut notes)| {
        diagnostics.append(&mut notes);
        value
    });
    values.collect()
}

/// Drops edges that could not be read and renumbers the rest; no face refers to a dropped one.
fn keep_used_edges(part: &mut Part, edges: Vec<Outcome<Edge>>) {
    let mut number = vec![u32::MAX; edges.len()];
    for (old, edge) in edges.into_iter().enumerate() {
        if let Ok(edge) = edge {
            number[old] = part.edges.len() as u32;
            part.edges.push(edge);
        }
    }
    for coedge in part.faces.iter_mut().flat_map(|face| &mut face.loops).flat_map(|bound| &mut bound.coedges)
    {
        coedge.edge = number[coedge.edge as usize];
    }
}

struct Stage<'t> {
    table: &'t Table<'t>,
    budget: &'t Budget,
}

impl<'t> Stage<'t> {
    fn reader(&self, units: Units) -> Reader<'t> {
        Reader::new(self.table, self.budget, units)
    }

    fn vertex_entity(&self, seed: &VertexSeed) -> EntityRef {
        match seed {
            VertexSeed::Entity { index, .. } => self.table.entity(*index),
            VertexSeed::Point(_) => EntityRef::None,
            VertexSeed::Lost(fault) => fault.entity,
        }
    }

    fn point(&self, seed: &VertexSeed) -> Outcome<DVec3> {
        match seed {
            &VertexSeed::Entity { index, units } => {
                let reader = self.reader(units);
                if self.table.kind(index) == super::keyword::Kind::VertexPoint {
                    let mut attributes = self.table.attributes(index).after(1);
                    reader.point(attributes.reference("vertex geometry")?)
                } else {
                    reader.point(index)
                }
            }
            VertexSeed::Point(point) => Ok(*point),
            VertexSeed::Lost(fault) => Err(fault.clone()),
        }
    }

    fn curve(&self, index: usize, units: Units) -> (Outcome<Arc<Curve>>, Diagnostics) {
        let mut reader = self.reader(units);
        (reader.curve(index).map(Arc::new), reader.notes)
    }

    fn surface(&self, index: usize, units: Units, whole: bool) -> (Outcome<Arc<Surface>>, Diagnostics) {
        let mut reader = self.reader(units);
        reader.whole_surface = whole;
        (reader.surface(index).map(Arc::new), reader.notes)
    }

    fn edge(
        &self,
        seed: &EdgeSeed,
        points: &[Outcome<DVec3>],
        curves: &[Outcome<Arc<Curve>>],
    ) -> (Outcome<Edge>, Diagnostics) {
        let mut notes = Vec::new();
        let edge = self.place_edge(seed, points, curves, &mut notes);
        (edge, notes)
    }

    fn place_edge(
        &self,
        seed: &EdgeSeed,
        points: &[Outcome<DVec3>],
        curves: &[Outcome<Arc<Curve>>],
        notes: &mut Diagnostics,
    ) -> Outcome<Edge> {
        let start = points[seed.start as usize].clone()?;
        let end = points[seed.end as usize].clone()?;
        let entity = seed.index.map_or(EntityRef::None, |index| self.table.entity(index));
        let made = |curve, range, same_sense| Edge {
            entity,
            start: seed.start,
            end: seed.end,
            curve,
            range,
            same_sense,
        };
        let curve = match &seed.curve {
            EdgeCurve::Slot(slot) => curves[*slot].clone()?,
            EdgeCurve::Lost(fault) => return Err(fault.clone()),
            EdgeCurve::Straight => {
                let direction = if start == end { DVec3::X } else { end - start };
                let range = Interval::new(0.0, if start == end { 0.0 } else { 1.0 });
                let curve = Curve::Line { origin: start, direction };
                return Ok(made(Arc::new(curve), range, true));
            }
            EdgeCurve::Ready(curve, range) => return Ok(made(curve.clone(), *range, seed.same_sense)),
        };
        let tolerance = seed.units.uncertainty_mm.clamp(1e-7, 0.1);
        let found = edge_range(&curve, start, end, seed.start == seed.end, seed.same_sense, tolerance);
        if !found.range.is_finite() {
            return Err(Fault { entity, message: format!("{entity} does not lie on its curve") });
        }
        self.note_edge(entity, seed, &found, notes);
        Ok(made(curve, found.range, found.same_sense))
    }

    fn note_edge(
        &self,
        entity: EntityRef,
        seed: &EdgeSeed,
        found: &super::edge_range::EdgeRange,
        notes: &mut Diagnostics,
    ) {
        if found.gap > UNREPORTED_GAP_MM.max(2.0 * seed.units.uncertainty_mm) {
            let message = format!("A vertex of edge {entity} lies {:.3} mm off the edge's curve.", found.gap);
            notes.push(Diagnostic::new(Severity::Warning, "vertex-off-curve", entity, message));
        }
        if found.same_sense != seed.same_sense && seed.start != seed.end {
            let message = format!(
                "Edge {entity} runs against its curve, not with it as the file says (or the reverse)."
            );
            notes.push(Diagnostic::new(Severity::Warning, "edge-sense", entity, message));
        }
    }

    fn face(
        &self,
        seed: FaceSeed,
        points: &[Outcome<DVec3>],
        surfaces: &[Outcome<Arc<Surface>>],
        edges: &[Outcome<Edge>],
        diagnostics: &mut Diagnostics,
    ) -> Face {
        let entity = self.table.entity(seed.index);
        let geometry = self.face_geometry(&seed, points, surfaces, edges);
        let (geometry, loops) = match geometry {
            Ok(geometry) => (geometry, seed.loops),
            Err(fault) => {
                let message =
                    format!("Face {entity} is lost: {}{}.", fault.message, self.place(fault.entity));
                diagnostics.push(
                    Diagnostic::new(Severity::Error, "face-unreadable", fault.entity, message)
                        .on_face(entity),
                );
                (FaceGeometry::Unreadable(fault.message), Vec::new())
            }
        };
        Face {
            entity,
            name: seed.name,
            geometry,
            same_sense: seed.same_sense,
            loops,
            color: seed.color,
            hidden: seed.hidden,
        }
    }

    /// Where in the file an entity stands, for a message.
    fn place(&self, entity: EntityRef) -> String {
        let EntityRef::Step(id) = entity else { return String::new() };
        let exchange = self.table.exchange();
        let instance = exchange.get(id);
        instance.map_or_else(String::new, |it| format!(" (line {})", exchange.position(it.offset()).line))
    }

    fn face_geometry(
        &self,
        seed: &FaceSeed,
        points: &[Outcome<DVec3>],
        surfaces: &[Outcome<Arc<Surface>>],
        edges: &[Outcome<Edge>],
    ) -> Outcome<FaceGeometry> {
        let surface = seed.surface.as_ref().map_err(Clone::clone)?;
        for bound in &seed.loops {
            if let Some(vertex) = bound.vertex {
                points[vertex as usize].as_ref().map_err(Clone::clone)?;
            }
            for coedge in &bound.coedges {
                edges[coedge.edge as usize].as_ref().map_err(Clone::clone)?;
            }
        }
        match surface {
            FaceSurface::Slot(slot) => {
                let surface = surfaces[*slot].clone()?;
                Ok(FaceGeometry::Surface(part_in_use(&surface, &seed.loops, edges).unwrap_or(surface)))
            }
            FaceSurface::Ready(surface) => Ok(FaceGeometry::Surface(surface.clone())),
            FaceSurface::Facets(facets) => Ok(FaceGeometry::Facets(facets.clone())),
            FaceSurface::Flat => {
                let plane = polygon_plane(&seed.loops, points, edges);
                let fault = || Fault {
                    entity: self.table.entity(seed.index),
                    message: "the face has no area".into(),
                };
                Ok(FaceGeometry::Surface(Arc::new(Surface::Plane { frame: plane.ok_or_else(fault)? })))
            }
        }
    }
}

/// Of a torus that crosses itself the other part (apple or lemon), where that is the one that the face's edges lie on:
/// `toroidal_surface` does not say which is meant.
fn part_in_use(surface: &Surface, loops: &[Loop], edges: &[Outcome<Edge>]) -> Option<Arc<Surface>> {
    let &Surface::Torus { ref frame, major, minor, v_range: Some(range) } = surface else { return None };
    let other = Interval::new(range.end, range.start + TAU);
    let other = Surface::Torus { frame: *frame, major, minor, v_range: Some(other) };
    let edges =
        loops.iter().flat_map(|bound| &bound.coedges).map(|coedge| edges[coedge.edge as usize].as_ref());
    let points: Vec<DVec3> = edges
        .flatten()
        .flat_map(|edge| [0.2, 0.5, 0.8].map(|at| edge.curve.point(edge.range.at(at))))
        .collect();
    let off = |surface: &Surface| points.iter().map(|&p| surface.project(p, None).distance).sum::<f64>();
    (off(&other) < 0.5 * off(surface)).then(|| Arc::new(other))
}

/// The vertex at which a coedge begins.
fn coedge_start(coedge: &Coedge, edges: &[Outcome<Edge>]) -> Option<u32> {
    let edge = edges[coedge.edge as usize].as_ref().ok()?;
    Some(if coedge.reversed { edge.end } else { edge.start })
}

/// The plane through the face's largest polygon, its normal by Newell's method.
fn polygon_plane(loops: &[Loop], points: &[Outcome<DVec3>], edges: &[Outcome<Edge>]) -> Option<Frame> {
    let candidates = loops.iter().filter_map(|bound| {
        let corners = bound
            .coedges
            .iter()
            .map(|coedge| points[coedge_start(coedge, edges)? as usize].as_ref().ok().copied());
        let corners = corners.collect::<Option<Vec<_>>>()?;
        let first = *corners.first()?;
        let next = corners.iter().cycle().skip(1);
        let normal: DVec3 = corners.iter().zip(next).map(|(a, b)| (*a - first).cross(*b - first)).sum();
        Some((normal, first, corners.get(1).copied().unwrap_or(first)))
    });
    let (normal, origin, next) = candidates.max_by(|a, b| a.0.length().total_cmp(&b.0.length()))?;
    (normal.length() > 0.0).then(|| Frame::new(origin, normal, next - origin))
}
