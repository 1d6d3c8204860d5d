//! Faces, bodies and free curves of a part.

use std::sync::Arc;

use glam::DVec3;
use trimloop_brep::{
    Body, BodyKind, Coedge, Diagnostics, Edge, EntityRef, Face, FaceGeometry, FaceId, FreeCurve, Loop, Part,
    Rgba, Severity, Shell, ShellFace, Vertex, VertexId,
};
use trimloop_geom::{Curve, Surface};

use super::curve::Piece;
use super::reader::{Fault, Outcome, Parameters, Reader};
use super::surface::Ground;

/// A part in the making.
pub(crate) struct ShapeBuilder<'f> {
    pub reader: Reader<'f>,
    pub part: Part,
    pub diagnostics: Diagnostics,
    /// The faces that came one by one.
    pub loose: Vec<FaceId>,
}

impl ShapeBuilder<'_> {
    /// Adds a face that came on its own: types 143, 144, or a surface without any trimming.
    pub fn add_loose(&mut self, entry: u32, color: Option<Rgba>) {
        let face = self.face(entry, color, |builder| builder.loose_geometry(entry));
        self.loose.push(face);
    }

    /// Adds a face, also where its geometry cannot be read.
    fn face(
        &mut self,
        entry: u32,
        color: Option<Rgba>,
        geometry: impl FnOnce(&mut Self) -> Outcome<(Arc<Surface>, bool, Vec<Loop>)>,
    ) -> FaceId {
        let name = self.reader.file.get(entry).map(|it| it.directory.label.clone()).unwrap_or_default();
        let entity = EntityRef::Iges(entry);
        let (geometry, same_sense, loops) = match geometry(self) {
            Ok((surface, same_sense, loops)) => (FaceGeometry::Surface(surface), same_sense, loops),
            Err(fault) => {
                let diagnostic = fault.diagnostic(Severity::Error, "face-unreadable").on_face(entity);
                self.diagnostics.push(diagnostic);
                (FaceGeometry::Unreadable(fault.message), true, Vec::new())
            }
        };
        let face = Face { entity, name, geometry, same_sense, loops, color, hidden: false };
        self.part.faces.push(face);
        (self.part.faces.len() - 1) as FaceId
    }

    fn loose_geometry(&mut self, entry: u32) -> Outcome<(Arc<Surface>, bool, Vec<Loop>)> {
        let mut parameters = self.reader.parameters(entry)?;
        match parameters.directory.entity_type {
            144 => {
                let surface = parameters.pointer()?;
                let has_outer = parameters.integer()? != 0;
                let inner = parameters.count(0)?;
                let outer = parameters.pointer()?;
                let mut boundaries = Vec::new();
                if has_outer && outer != 0 {
                    boundaries.push(outer);
                }
                for _ in 0..inner {
                    boundaries.push(parameters.pointer()?);
                }
                self.trimmed(surface, &boundaries, has_outer)
            }
            143 => {
                parameters.integer()?;
                let surface = parameters.pointer()?;
                let boundaries = (0..parameters.count(1)?).map(|_| parameters.pointer());
                let boundaries = boundaries.collect::<Outcome<Vec<u32>>>()?;
                self.trimmed(surface, &boundaries, true)
            }
            108 => {
                parameters.reals(4)?;
                let boundary = parameters.pointer()?;
                if boundary == 0 {
                    return Err(parameters.fault("is a plane without bounds"));
                }
                let ground = self.reader.surface(entry)?;
                let surface = Arc::new(ground.surface);
                let pieces = self.reader.curve(boundary)?;
                let bound = self.bound(pieces, boundary, true)?;
                Ok((surface, !ground.reversed, vec![bound]))
            }
            _ => {
                let ground = self.reader.surface(entry)?;
                let surface =
                    ground.untrimmed().ok_or_else(|| parameters.fault("never ends, and has no bounds"))?;
                Ok((Arc::new(surface), !ground.reversed, Vec::new()))
            }
        }
    }

    fn trimmed(
        &mut self,
        surface: u32,
        boundaries: &[u32],
        has_outer: bool,
    ) -> Outcome<(Arc<Surface>, bool, Vec<Loop>)> {
        let ground = self.reader.surface(surface)?;
        let exact = if has_outer {
            ground.surface.clone()
        } else {
            ground.untrimmed().ok_or_else(|| Fault::new(surface, "never ends, and has no outer boundary"))?
        };
        let exact = Arc::new(exact);
        let mut on_model = true;
        let mut loops = Vec::with_capacity(boundaries.len());
        for (k, &boundary) in boundaries.iter().enumerate() {
            let pieces = self.boundary(boundary, &ground, &exact)?;
            on_model &= pieces.iter().all(|piece| !matches!(piece.curve, Curve::OnSurface { .. }));
            loops.push(self.bound(pieces, boundary, has_outer && k == 0)?);
        }
        let exact = if has_outer && on_model { Arc::new(ground.simplified()) } else { exact };
        Ok((exact, !ground.reversed, loops))
    }

    /// The curves of a boundary (types 141 and 142), in the model or else on the surface.
    fn boundary(&self, entry: u32, ground: &Ground, surface: &Arc<Surface>) -> Outcome<Vec<Piece>> {
        let mut parameters = self.reader.parameters(entry)?;
        match parameters.directory.entity_type {
            142 => {
                parameters.integer()?;
                parameters.pointer()?;
                let (in_plane, in_model) = (parameters.pointer()?, parameters.pointer()?);
                let prefers_plane = parameters.integer()? == 1;
                self.either(&parameters, in_model, &[in_plane], prefers_plane, ground, surface)
            }
            141 => {
                parameters.integer()?;
                let prefers_plane = parameters.integer()? == 2;
                parameters.pointer()?;
                let mut out = Vec::new();
                for _ in 0..parameters.count(3)? {
                    let in_model = parameters.pointer()?;
                    // Whether the curve is turned: the chain is put in order by its ends all the same.
                    parameters.integer()?;
                    let in_plane = (0..parameters.count(1)?).map(|_| parameters.pointer());
                    let in_plane = in_plane.collect::<Outcome<Vec<u32>>>()?;
                    let pieces =
                        self.either(&parameters, in_model, &in_plane, prefers_plane, ground, surface)?;
                    out.extend(pieces);
                }
                Ok(out)
            }
            _ => self.reader.curve(entry),
        }
    }

    /// The model curve where it is there and lies on the surface, else the one in the parameter plane.
    fn either(
        &self,
        parameters: &Parameters<'_>,
        in_model: u32,
        in_plane: &[u32],
        prefers_plane: bool,
        ground: &Ground,
        surface: &Arc<Surface>,
    ) -> Outcome<Vec<Piece>> {
        let model = match in_model {
            0 => Err(parameters.fault("has no curve in the model")),
            entry => self.reader.curve(entry),
        };
        let reach = self.part.uncertainty_mm.max(1e-3) * if prefers_plane { 1.0 } else { 100.0 };
        if let Ok(pieces) = &model
            && pieces.iter().all(|piece| lies_on(piece, surface, reach))
        {
            return model;
        }
        let mut out = Vec::new();
        for &entry in in_plane.iter().filter(|&&entry| entry != 0) {
            match self.reader.parameter_curve(entry) {
                Ok(pieces) => out.extend(pieces.into_iter().map(|piece| {
                    let pcurve = Arc::new(piece.curve.transformed(&ground.parameters));
                    let curve = Curve::OnSurface { surface: surface.clone(), pcurve };
                    Piece { curve, range: piece.range }
                })),
                Err(fault) => return model.map_err(|_| fault),
            }
        }
        if out.is_empty() { model } else { Ok(out) }
    }

    /// A loop of curves end to end, each run in the direction that joins it to the one before.
    fn bound(&mut self, pieces: Vec<Piece>, entry: u32, outer: bool) -> Outcome<Loop> {
        let entity = EntityRef::Iges(entry);
        let pieces: Vec<Piece> = pieces.into_iter().filter(|piece| !is_point(piece)).collect();
        let turned = directions(&pieces);
        if pieces.is_empty() {
            return Err(Fault::new(entry, "is a boundary of no length"));
        }
        let vertices: Vec<VertexId> = pieces
            .iter()
            .zip(&turned)
            .map(|(piece, &turned)| self.vertex(piece.ends()[usize::from(turned)], entity))
            .collect();
        let mut coedges = Vec::with_capacity(pieces.len());
        for (k, (piece, &turned)) in pieces.into_iter().zip(&turned).enumerate() {
            let (from, to) = (vertices[k], vertices[(k + 1) % vertices.len()]);
            let (start, end) = if turned { (to, from) } else { (from, to) };
            let Piece { curve, range } = piece;
            let edge = Edge { entity, start, end, curve: Arc::new(curve), range, same_sense: true };
            self.part.edges.push(edge);
            let edge = (self.part.edges.len() - 1) as u32;
            coedges.push(Coedge { edge, reversed: turned, pcurve: None });
        }
        Ok(Loop { entity, coedges, vertex: None, outer })
    }

    fn vertex(&mut self, point: DVec3, entity: EntityRef) -> VertexId {
        self.part.vertices.push(Vertex { entity, point });
        (self.part.vertices.len() - 1) as VertexId
    }

    /// Adds a free curve.
    pub fn add_curve(&mut self, entry: u32, color: Option<Rgba>) {
        match self.reader.curve(entry) {
            Ok(pieces) => self.part.curves.extend(pieces.into_iter().map(|Piece { curve, range }| {
                FreeCurve { entity: EntityRef::Iges(entry), curve: Arc::new(curve), range, color }
            })),
            Err(fault) => self.diagnostics.push(fault.diagnostic(Severity::Warning, "curve-unreadable")),
        }
    }

    /// Adds a solid (type 186) with its voids, or a shell of its own (type 514).
    pub fn add_solid(&mut self, entry: u32, color: Option<Rgba>) {
        match self.solid(entry, color) {
            Ok(body) => self.part.bodies.push(body),
            Err(fault) => self.diagnostics.push(fault.diagnostic(Severity::Error, "shell-unreadable")),
        }
    }

    fn solid(&mut self, entry: u32, color: Option<Rgba>) -> Outcome<Body> {
        let mut parameters = self.reader.parameters(entry)?;
        let name = parameters.directory.label.clone();
        let is_solid = parameters.directory.entity_type == 186;
        let mut shared = SharedEdges::default();
        let mut shells = Vec::new();
        if is_solid {
            let outer = (parameters.pointer()?, parameters.integer()? != 0);
            shells.push(self.shell(outer.0, !outer.1, false, color, &mut shared)?);
            for _ in 0..parameters.count(2)? {
                let (shell, agrees) = (parameters.pointer()?, parameters.integer()? != 0);
                shells.push(self.shell(shell, !agrees, true, color, &mut shared)?);
            }
        } else {
            shells.push(self.shell(entry, false, false, color, &mut shared)?);
        }
        let kind = if is_solid { BodyKind::Solid } else { BodyKind::Sheet };
        Ok(Body { name, entity: EntityRef::Iges(entry), kind, shells, layers: Vec::new() })
    }

    /// Type 514.
    fn shell(
        &mut self,
        entry: u32,
        turned: bool,
        void: bool,
        color: Option<Rgba>,
        shared: &mut SharedEdges,
    ) -> Outcome<Shell> {
        let mut parameters = self.reader.parameters(entry)?;
        parameters.expect(&[514], "shell")?;
        let closed = parameters.directory.form != 2;
        let mut faces = Vec::new();
        for _ in 0..parameters.count(2)? {
            let (face, agrees) = (parameters.pointer()?, parameters.integer()? != 0);
            let own = super::look::color_of(&self.reader, face).or(color);
            let id = self.face(face, own, |builder| builder.shell_face(face, shared));
            faces.push(ShellFace { face: id, reversed: agrees == turned });
        }
        Ok(Shell { entity: EntityRef::Iges(entry), closed, void, faces })
    }

    /// Type 510.
    fn shell_face(
        &mut self,
        entry: u32,
        shared: &mut SharedEdges,
    ) -> Outcome<(Arc<Surface>, bool, Vec<Loop>)> {
        let mut parameters = self.reader.parameters(entry)?;
        parameters.expect(&[510], "face")?;
        let ground = self.reader.surface(parameters.pointer()?)?;
        let count = parameters.count(1)?;
        let has_outer = parameters.integer()? != 0;
        let mut loops = Vec::with_capacity(count);
        for k in 0..count {
            let bound = parameters.pointer()?;
            loops.push(self.edge_loop(bound, has_outer && k == 0, shared)?);
        }
        Ok((Arc::new(ground.surface), !ground.reversed, loops))
    }

    /// Type 508.
    fn edge_loop(&mut self, entry: u32, outer: bool, shared: &mut SharedEdges) -> Outcome<Loop> {
        let mut parameters = self.reader.parameters(entry)?;
        parameters.expect(&[508], "loop")?;
        let mut bound = Loop { entity: EntityRef::Iges(entry), outer, ..Loop::default() };
        for _ in 0..parameters.count(5)? {
            let is_vertex = parameters.integer()? == 1;
            let (list, index) = (parameters.pointer()?, parameters.integer()?);
            let agrees = parameters.integer()? != 0;
            for _ in 0..parameters.count(2)? {
                parameters.integer()?;
                parameters.pointer()?;
            }
            let index = usize::try_from(index).ok().and_then(|index| index.checked_sub(1));
            let index = index.ok_or_else(|| parameters.fault("names an edge by a number that is none"))?;
            if is_vertex {
                bound.vertex = Some(self.listed_vertex(list, index, shared)?);
            } else {
                let edge = self.listed_edge(list, index, shared)?;
                bound.coedges.push(Coedge { edge, reversed: !agrees, pcurve: None });
            }
        }
        if !bound.coedges.is_empty() {
            bound.vertex = None;
        }
        Ok(bound)
    }

    /// An edge of a list (type 504).
    fn listed_edge(&mut self, list: u32, index: usize, shared: &mut SharedEdges) -> Outcome<u32> {
        if let Some(&known) = shared.edges.get(&(list, index)) {
            return Ok(known);
        }
        let mut parameters = self.reader.parameters(list)?;
        parameters.expect(&[504], "edge list")?;
        let count = parameters.count(5)?;
        if index >= count {
            return Err(parameters.fault(format!("has {count} edges, not {}", index + 1)));
        }
        for _ in 0..5 * index {
            parameters.integer()?;
        }
        let curve = parameters.pointer()?;
        let mut end = || -> Outcome<(u32, usize)> {
            let (list, index) = (parameters.pointer()?, parameters.integer()?);
            Ok((list, usize::try_from(index - 1).unwrap_or(usize::MAX)))
        };
        let [from, to] = [end()?, end()?];
        let [start, end] =
            [self.listed_vertex(from.0, from.1, shared)?, self.listed_vertex(to.0, to.1, shared)?];
        let parameters = self.reader.parameters(list)?;
        let Piece { curve, range } = super::curve::joined(self.reader.curve(curve)?, &parameters)?;
        // The curve may run the other way than the edge.
        let point = |id: VertexId| self.part.vertices[id as usize].point;
        let [first, last] = [curve.point(range.start), curve.point(range.end)];
        let straight = first.distance(point(start)) + last.distance(point(end));
        let crossed = first.distance(point(end)) + last.distance(point(start));
        let same_sense = straight <= crossed;
        let entity = EntityRef::Iges(list);
        let edge = Edge { entity, start, end, curve: Arc::new(curve), range, same_sense };
        self.part.edges.push(edge);
        let id = (self.part.edges.len() - 1) as u32;
        shared.edges.insert((list, index), id);
        Ok(id)
    }

    /// A vertex of a list (type 502).
    fn listed_vertex(&mut self, list: u32, index: usize, shared: &mut SharedEdges) -> Outcome<VertexId> {
        if let Some(&known) = shared.vertices.get(&(list, index)) {
            return Ok(known);
        }
        let mut parameters = self.reader.parameters(list)?;
        parameters.expect(&[502], "vertex list")?;
        let count = parameters.count(3)?;
        if index >= count {
            return Err(parameters.fault(format!("has {count} vertices, not as many as are asked for")));
        }
        parameters.reals(3 * index)?;
        let map = self.reader.placement(parameters.directory)?;
        let point = map.transform_point3(parameters.point()?);
        let id = self.vertex(point, EntityRef::Iges(list));
        shared.vertices.insert((list, index), id);
        Ok(id)
    }
}

/// Edges and vertices of lists that are made already.
#[derive(Default)]
struct SharedEdges {
    edges: rustc_hash::FxHashMap<(u32, usize), u32>,
    vertices: rustc_hash::FxHashMap<(u32, usize), VertexId>,
}

/// Whether a curve lies within `reach` of a surface.
fn lies_on(piece: &Piece, surface: &Surface, reach: f64) -> bool {
    [0.0, 0.31, 0.72, 1.0].into_iter().all(|share| {
        let point = piece.curve.point(piece.range.at(share));
        surface.project(point, None).distance <= reach
    })
}

/// Whether a piece is all at one point.
fn is_point(piece: &Piece) -> bool {
    let at = |share: f64| piece.curve.point(piece.range.at(share));
    let start = at(0.0);
    [0.37, 0.71, 1.0].into_iter().all(|share| at(share).distance(start) <= 1e-9 * (1.0 + start.length()))
}

/// Per piece whether the loop runs it backwards.
fn directions(pieces: &[Piece]) -> Vec<bool> {
    let ends: Vec<[DVec3; 2]> = pieces.iter().map(Piece::ends).collect();
    let mut out = vec![false; pieces.len()];
    if pieces.len() < 2 {
        return out;
    }
    let nearest = |from: DVec3, to: &[DVec3; 2]| from.distance(to[0]).min(from.distance(to[1]));
    // Where both of the first one's ends touch the second, it runs as it is written.
    out[0] = nearest(ends[0][1], &ends[1]) > nearest(ends[0][0], &ends[1]) + 1e-9;
    let mut at = ends[0][usize::from(!out[0])];
    for k in 1..pieces.len() {
        out[k] = at.distance(ends[k][1]) < at.distance(ends[k][0]) - 1e-9;
        at = ends[k][usize::from(!out[k])];
    }
    out
}
