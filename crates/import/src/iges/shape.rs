//! What a part is made of: faces, bodies, curves and points, each with the group that it stands in.

use std::sync::Arc;

use glam::DVec3;
use trimloop_brep::{
    Body, Coedge, Diagnostics, Edge, EdgeId, EntityRef, Face, FaceGeometry, FaceId, FreeCurve, FreePoint,
    Loop, Part, Rgba, Severity, Vertex, VertexId,
};
use trimloop_geom::{Curve, Interval};

use super::curve::Piece;
use super::face::{BoundDraft, FaceDraft};
use super::look::name_of;
use super::reader::{Outcome, Reader};
use super::solid::{Lists, SharedEdges};

/// A part in the making.
pub(crate) struct ShapeBuilder<'f> {
    pub reader: Reader<'f>,
    pub part: Part,
    pub diagnostics: Diagnostics,
    /// Lists of edges and vertices that were read already.
    pub lists: Lists,
    /// The edges that faces share which stand in no shell.
    pub loose_edges: SharedEdges,
    /// The faces that came one by one.
    pub loose: Vec<FaceId>,
    /// Edges that the file also gives as curves that lie elsewhere.
    pub told: Vec<(EdgeId, Arc<(Curve, Interval)>)>,
    /// The group that is being filled.
    pub group: usize,
    /// The groups of faces, bodies, curves and points.
    pub face_groups: Vec<usize>,
    pub body_groups: Vec<usize>,
    pub curve_groups: Vec<usize>,
    pub point_groups: Vec<usize>,
}

impl<'f> ShapeBuilder<'f> {
    /// A builder with nothing in it.
    pub fn new(reader: Reader<'f>, part: Part) -> Self {
        Self {
            reader,
            part,
            diagnostics: Vec::new(),
            lists: Lists::default(),
            loose_edges: SharedEdges::default(),
            loose: Vec::new(),
            told: Vec::new(),
            group: 0,
            face_groups: Vec::new(),
            body_groups: Vec::new(),
            curve_groups: Vec::new(),
            point_groups: Vec::new(),
        }
    }

    /// Adds a face that came on its own, also where it could not be read.
    pub fn add_loose(&mut self, entry: u32, color: Option<Rgba>, read: Outcome<FaceDraft>) {
        let face = self.face(entry, color, |builder| {
            let FaceDraft { surface, same_sense, bounds } = read?;
            let loops = bounds.into_iter().map(|bound| builder.bound(bound)).collect();
            Ok((FaceGeometry::Surface(surface), same_sense, loops))
        });
        self.hide_blanked(entry, face);
        self.loose.push(face);
    }

    /// Hides the faces from `first` on where the entity that they come from is blanked.
    pub fn hide_blanked(&mut self, entry: u32, first: FaceId) {
        if self.reader.file.get(entry).is_some_and(|it| it.directory.status.blanked) {
            self.part.faces[first as usize..].iter_mut().for_each(|face| face.hidden = true);
        }
    }

    /// Adds a face, also where its geometry cannot be read.
    pub fn face(
        &mut self,
        entry: u32,
        color: Option<Rgba>,
        geometry: impl FnOnce(&mut Self) -> Outcome<(FaceGeometry, bool, Vec<Loop>)>,
    ) -> FaceId {
        let entity = EntityRef::Iges(entry);
        let (geometry, same_sense, loops) = geometry(self).unwrap_or_else(|fault| {
            let diagnostic = fault.diagnostic(Severity::Error, "face-unreadable").on_face(entity);
            self.diagnostics.push(diagnostic);
            (FaceGeometry::Unreadable(fault.message), true, Vec::new())
        });
        let name = name_of(&self.reader, entry).unwrap_or_default();
        self.part.faces.push(Face { entity, name, geometry, same_sense, loops, color, hidden: false });
        self.face_groups.push(self.group);
        (self.part.faces.len() - 1) as FaceId
    }

    /// A loop of edges that no other face has yet.
    fn bound(&mut self, bound: BoundDraft) -> Loop {
        let entity = EntityRef::Iges(bound.entry);
        let mut vertices: Vec<VertexId> = Vec::with_capacity(bound.pieces.len());
        // What comes after a piece that closes on itself starts where that piece does.
        let mut closed_before = None;
        for (piece, turned) in &bound.pieces {
            let ends = piece.ends();
            let start = ends[usize::from(*turned)];
            let vertex = closed_before.unwrap_or_else(|| self.vertex(start, entity));
            vertices.push(vertex);
            let is_closed = ends[0].distance(ends[1]) <= 1e-9 * (1.0 + start.length());
            closed_before = is_closed.then_some(vertex);
        }
        if let Some(vertex) = closed_before {
            vertices[0] = vertex;
        }
        let mut coedges = Vec::with_capacity(vertices.len());
        for (k, (piece, turned)) in bound.pieces.into_iter().enumerate() {
            let (from, to) = (vertices[k], vertices[(k + 1) % vertices.len()]);
            let (start, end) = if turned { (to, from) } else { (from, to) };
            let pcurve = piece.image.clone();
            let edge = self.edge(entity, piece, start, end);
            coedges.push(Coedge { edge, reversed: turned, pcurve });
        }
        Loop { entity, coedges, vertex: None, outer: bound.outer }
    }

    /// Adds an edge that runs with its curve.
    pub fn edge(&mut self, entity: EntityRef, piece: Piece, start: VertexId, end: VertexId) -> u32 {
        let Piece { curve, range, told, .. } = piece;
        self.part.edges.push(Edge { entity, start, end, curve: Arc::new(curve), range, same_sense: true });
        let edge = (self.part.edges.len() - 1) as EdgeId;
        self.told.extend(told.map(|told| (edge, told)));
        edge
    }

    /// Adds a vertex.
    pub fn vertex(&mut self, point: DVec3, entity: EntityRef) -> VertexId {
        self.part.vertices.push(Vertex { entity, point });
        (self.part.vertices.len() - 1) as VertexId
    }

    /// Adds a free curve.
    pub fn add_curve(&mut self, entry: u32, color: Option<Rgba>) {
        match self.reader.curve(entry) {
            Ok(pieces) => {
                self.curve_groups.extend(pieces.iter().map(|_| self.group));
                self.part.curves.extend(pieces.into_iter().map(|Piece { curve, range, .. }| FreeCurve {
                    entity: EntityRef::Iges(entry),
                    curve: Arc::new(curve),
                    range,
                    color,
                }));
            }
            Err(fault) => self.diagnostics.push(fault.diagnostic(Severity::Warning, "curve-unreadable")),
        }
    }

    /// Adds free points: a point (116), or copious data that are no line (106 forms 1 to 3).
    pub fn add_points(&mut self, entry: u32, color: Option<Rgba>) {
        match self.reader.free_points(entry) {
            Ok(points) => {
                self.point_groups.extend(points.iter().map(|_| self.group));
                let entity = EntityRef::Iges(entry);
                self.part.points.extend(points.into_iter().map(|point| FreePoint { entity, point, color }));
            }
            Err(fault) => self.diagnostics.push(fault.diagnostic(Severity::Warning, "point-unreadable")),
        }
    }

    /// Adds a body.
    pub fn add_body(&mut self, body: Body) {
        self.part.bodies.push(body);
        self.body_groups.push(self.group);
    }
}
