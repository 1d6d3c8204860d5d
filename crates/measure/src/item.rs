//! What is measured: a vertex, an edge or a face of a part where an instance puts it.

use glam::{DAffine3, DVec3};
use trimloop_brep::{
    Body, BodyKind, Coedge, Edge, EdgeId, Face, FaceGeometry, FaceId, Facets, Loop, Part, Shell, ShellFace,
    Vertex, VertexId,
};

/// A vertex, an edge or a face of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Feature {
    /// A vertex.
    Vertex(VertexId),
    /// An edge.
    Edge(EdgeId),
    /// A face.
    Face(FaceId),
}

/// A feature where an instance puts it.
#[derive(Clone, Copy, Debug)]
pub struct Item<'a> {
    /// The part that it belongs to.
    pub part: &'a Part,
    /// From the part's coordinates to the world's; any affine map that does not flatten.
    pub transform: DAffine3,
    /// Which of the part's vertices, edges and faces it is.
    pub feature: Feature,
}

impl<'a> Item<'a> {
    /// The edge, where it is one that the part has.
    pub(crate) fn edge(&self) -> Option<&'a Edge> {
        match self.feature {
            Feature::Edge(edge) => self.part.edges.get(edge as usize),
            _ => None,
        }
    }

    /// The face, where it is one that the part has.
    pub(crate) fn face(&self) -> Option<&'a Face> {
        match self.feature {
            Feature::Face(face) => self.part.faces.get(face as usize),
            _ => None,
        }
    }

    /// The vertex' place in the world, where it is one that the part has.
    pub(crate) fn vertex(&self) -> Option<DVec3> {
        let Feature::Vertex(vertex) = self.feature else { return None };
        self.vertex_point(vertex)
    }

    /// A vertex of the part, in the world.
    pub(crate) fn vertex_point(&self, vertex: VertexId) -> Option<DVec3> {
        self.part.vertices.get(vertex as usize).map(|v| self.transform.transform_point3(v.point))
    }

    /// Whether the shell that holds the face uses it backwards.
    pub(crate) fn is_used_backwards(&self) -> bool {
        let Feature::Face(face) = self.feature else { return false };
        let shells = self.part.bodies.iter().flat_map(|body| &body.shells);
        shells.flat_map(|shell| &shell.faces).find(|used| used.face == face).is_some_and(|used| used.reversed)
    }

    /// A part with nothing but this feature and what bounds it, still in the part's coordinates: what is done to whole
    /// parts (sampling, meshing) can then be done to the feature alone.
    pub(crate) fn alone(&self) -> Part {
        let mut out = Part { uncertainty_mm: self.part.uncertainty_mm, ..Part::default() };
        match self.feature {
            Feature::Vertex(vertex) => out.vertices.extend(self.part.vertices.get(vertex as usize)),
            Feature::Edge(edge) => {
                Copier::new(self.part, &mut out).edge(edge);
            }
            Feature::Face(face) => Copier::new(self.part, &mut out).face(face, self.is_used_backwards()),
        }
        out
    }
}

/// Copies topology from one part to another, each edge and vertex once.
struct Copier<'p> {
    from: &'p Part,
    to: &'p mut Part,
    edges: Vec<EdgeId>,
    vertices: Vec<VertexId>,
}

impl<'p> Copier<'p> {
    fn new(from: &'p Part, to: &'p mut Part) -> Self {
        Self { from, to, edges: Vec::new(), vertices: Vec::new() }
    }

    fn vertex(&mut self, vertex: VertexId) -> Option<VertexId> {
        if let Some(at) = self.vertices.iter().position(|&v| v == vertex) {
            return Some(at as VertexId);
        }
        let found: Vertex = *self.from.vertices.get(vertex as usize)?;
        self.to.vertices.push(found);
        self.vertices.push(vertex);
        Some(self.vertices.len() as VertexId - 1)
    }

    fn edge(&mut self, edge: EdgeId) -> Option<EdgeId> {
        if let Some(at) = self.edges.iter().position(|&e| e == edge) {
            return Some(at as EdgeId);
        }
        let found = self.from.edges.get(edge as usize)?;
        let (start, end) = (self.vertex(found.start)?, self.vertex(found.end)?);
        self.to.edges.push(Edge { start, end, ..found.clone() });
        self.edges.push(edge);
        Some(self.edges.len() as EdgeId - 1)
    }

    fn face(&mut self, face: FaceId, reversed: bool) {
        let Some(found) = self.from.faces.get(face as usize) else { return };
        let loops = found.loops.iter().map(|l| self.a_loop(l)).collect();
        let geometry = match &found.geometry {
            FaceGeometry::Facets(facets) => FaceGeometry::Facets(self.facets(facets)),
            other => other.clone(),
        };
        self.to.faces.push(Face { geometry, loops, hidden: false, ..found.clone() });
        let shell = Shell {
            entity: found.entity,
            closed: false,
            void: false,
            faces: vec![ShellFace { face: 0, reversed }],
        };
        self.to.bodies.push(Body {
            name: String::new(),
            entity: found.entity,
            kind: BodyKind::Sheet,
            shells: vec![shell],
            layers: Vec::new(),
        });
    }

    fn a_loop(&mut self, l: &Loop) -> Loop {
        let coedges =
            l.coedges.iter().filter_map(|c| self.edge(c.edge).map(|edge| Coedge { edge, ..c.clone() }));
        let coedges = coedges.collect();
        Loop { coedges, vertex: l.vertex.and_then(|v| self.vertex(v)), ..l.clone() }
    }

    fn facets(&mut self, facets: &Facets) -> Facets {
        let mut used: Vec<u32> = facets.triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        used.retain(|&p| (p as usize) < self.from.facet_points.len());
        self.to.facet_points = used.iter().map(|&p| self.from.facet_points[p as usize]).collect();
        let own = |p: u32| used.binary_search(&p).map_or(u32::MAX, |at| at as u32);
        Facets {
            triangles: facets.triangles.iter().map(|t| t.map(own)).collect(),
            normals: facets.normals.clone(),
        }
    }
}
