//! A part before its geometry is read: which entities it is made of, and how they hang together.

use std::sync::Arc;

use glam::DVec3;
use rustc_hash::FxHashMap;
use trimloop_brep::{Body, Diagnostics, EdgeId, Facets, FreeCurve, Loop, Rgba, VertexId};
use trimloop_geom::{Curve, Interval, Surface};

use super::fault::{Fault, Outcome};
use super::units::Units;

/// Where a vertex gets its point from.
#[derive(Clone, Debug)]
pub(crate) enum VertexSeed {
    /// A `vertex_point` or a `cartesian_point`.
    Entity { index: usize, units: Units },
    /// Already there.
    Point(DVec3),
    /// Not to be had.
    Lost(Fault),
}

/// Where an edge gets its curve from.
#[derive(Clone, Debug)]
pub(crate) enum EdgeCurve {
    /// An entry of [`Seeds::curves`].
    Slot(usize),
    /// The straight line between its vertices.
    Straight,
    /// Already there, with its range.
    Ready(Arc<Curve>, Interval),
    /// Not to be had.
    Lost(Fault),
}

/// An edge whose curve has not been read.
#[derive(Clone, Debug)]
pub(crate) struct EdgeSeed {
    /// The `edge_curve`, where it is one.
    pub index: Option<usize>,
    pub start: VertexId,
    pub end: VertexId,
    pub curve: EdgeCurve,
    pub same_sense: bool,
    pub units: Units,
}

/// Where a face gets its geometry from.
#[derive(Clone, Debug)]
pub(crate) enum FaceSurface {
    /// An entry of [`Seeds::surfaces`].
    Slot(usize),
    /// The plane through its polygon.
    Flat,
    /// Already there.
    Ready(Arc<Surface>),
    /// Triangles.
    Facets(Facets),
}

/// A face whose surface has not been read.
#[derive(Clone, Debug)]
pub(crate) struct FaceSeed {
    pub index: usize,
    pub name: String,
    /// The surface, or why the face is lost.
    pub surface: Outcome<FaceSurface>,
    pub same_sense: bool,
    pub loops: Vec<Loop>,
    pub color: Option<Rgba>,
    pub hidden: bool,
}

/// A part's entities and their topology. Every `vertex_point`, `edge_curve`, curve and surface appears once.
#[derive(Default)]
pub(crate) struct Seeds {
    pub vertices: Vec<VertexSeed>,
    pub edges: Vec<EdgeSeed>,
    pub faces: Vec<FaceSeed>,
    pub bodies: Vec<Body>,
    pub free_curves: Vec<FreeCurve>,
    pub facet_points: Vec<DVec3>,
    /// Curves of edges, each once.
    pub curves: Vec<(usize, Units)>,
    /// Surfaces of faces, each once, and whether they are used as a whole.
    pub surfaces: Vec<(usize, Units, bool)>,
    pub diagnostics: Diagnostics,
    pub vertex_of: FxHashMap<usize, VertexId>,
    pub lost_vertex_of: FxHashMap<u64, VertexId>,
    pub lost_edge_of: FxHashMap<u64, EdgeId>,
    pub edge_of: FxHashMap<usize, Outcome<EdgeId>>,
    pub polygon_edge_of: FxHashMap<(VertexId, VertexId), EdgeId>,
    pub face_of: FxHashMap<usize, u32>,
    pub curve_slot_of: FxHashMap<usize, usize>,
    pub surface_slot_of: FxHashMap<(usize, bool), usize>,
    /// Where the points of a `coordinates_list` lie in `facet_points`.
    pub coordinates_of: FxHashMap<usize, Arc<[u32]>>,
    /// Points of facets by the bits of their coordinates.
    pub facet_point_of: FxHashMap<[u64; 3], u32>,
}

impl Seeds {
    /// The vertex of an entity, made when it is new.
    pub fn vertex(&mut self, index: usize, units: Units) -> VertexId {
        let vertices = &mut self.vertices;
        *self.vertex_of.entry(index).or_insert_with(|| {
            vertices.push(VertexSeed::Entity { index, units });
            (vertices.len() - 1) as VertexId
        })
    }

    /// The vertex that should have been `#id`.
    pub fn lost_vertex(&mut self, id: u64, fault: Fault) -> VertexId {
        let vertices = &mut self.vertices;
        *self.lost_vertex_of.entry(id).or_insert_with(|| {
            vertices.push(VertexSeed::Lost(fault));
            (vertices.len() - 1) as VertexId
        })
    }

    /// A vertex at a point.
    pub fn vertex_at(&mut self, point: DVec3) -> VertexId {
        self.vertices.push(VertexSeed::Point(point));
        (self.vertices.len() - 1) as VertexId
    }

    /// A point of facets; one at the very same place is used again.
    pub fn facet_point(&mut self, point: DVec3) -> u32 {
        let points = &mut self.facet_points;
        // Adding zero turns -0 into 0.
        *self.facet_point_of.entry((point + DVec3::ZERO).to_array().map(f64::to_bits)).or_insert_with(|| {
            points.push(point);
            (points.len() - 1) as u32
        })
    }

    /// The place of a curve in [`Self::curves`].
    pub fn curve_slot(&mut self, index: usize, units: Units) -> usize {
        let curves = &mut self.curves;
        *self.curve_slot_of.entry(index).or_insert_with(|| {
            curves.push((index, units));
            curves.len() - 1
        })
    }

    /// The place of a surface in [`Self::surfaces`]; `whole` where no loops bound the face.
    pub fn surface_slot(&mut self, index: usize, units: Units, whole: bool) -> usize {
        let surfaces = &mut self.surfaces;
        *self.surface_slot_of.entry((index, whole)).or_insert_with(|| {
            surfaces.push((index, units, whole));
            surfaces.len() - 1
        })
    }

    /// Adds an edge.
    pub fn add_edge(&mut self, edge: EdgeSeed) -> EdgeId {
        self.edges.push(edge);
        (self.edges.len() - 1) as EdgeId
    }

    /// The straight edge between two vertices of polygons, and whether it runs from `to` to `from`.
    pub fn polygon_edge(&mut self, from: VertexId, to: VertexId, units: Units) -> (EdgeId, bool) {
        let key = (from.min(to), from.max(to));
        if let Some(&edge) = self.polygon_edge_of.get(&key) {
            return (edge, from != self.edges[edge as usize].start);
        }
        let edge = EdgeSeed {
            index: None,
            start: from,
            end: to,
            curve: EdgeCurve::Straight,
            same_sense: true,
            units,
        };
        let id = self.add_edge(edge);
        self.polygon_edge_of.insert(key, id);
        (id, false)
    }
}
