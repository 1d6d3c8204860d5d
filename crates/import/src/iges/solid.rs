//! B-rep solids: shells, faces, loops and lists of edges and vertices (IGES 5.3 sections 4.47 and 4.137 to 4.141).

use std::collections::hash_map::Entry;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use trimloop_brep::{
    Body, BodyKind, Coedge, Edge, EdgeId, EntityRef, FaceGeometry, FaceId, Loop, Rgba, Severity, Shell,
    ShellFace, VertexId,
};
use trimloop_geom::{Curve, Surface};

use super::curve::{Piece, joined};
use super::look::{color_of, levels_of, name_of};
use super::reader::{Fault, Outcome, Reader};
use super::shape::ShapeBuilder;
use crate::parallel::map_each;
use crate::sew::free_edges;

/// An edge whose curve ends away from its vertices.
#[derive(Clone, Copy)]
struct Astray {
    edge: EdgeId,
    /// Whether the loop runs along it.
    agrees: bool,
    /// Its curve in the parameters of the loop's surface.
    image: u32,
}

/// Curves that end farther from their vertices than this are looked for in the parameters of a surface.
const LEAST_ASTRAY_MM: f64 = 1e-2;

impl ShapeBuilder<'_> {
    /// Adds a solid (type 186) with its voids, or a shell of its own (type 514).
    pub fn add_solid(&mut self, entry: u32, color: Option<Rgba>) {
        let before = [self.part.faces.len(), self.part.edges.len(), self.part.vertices.len()];
        let solid = self.solid(entry, color).and_then(|body| {
            self.place(entry, before)?;
            Ok(body)
        });
        self.hide_blanked(entry, before[0] as FaceId);
        match solid {
            Ok(body) => self.add_body(body),
            Err(fault) => self.diagnostics.push(fault.diagnostic(Severity::Error, "shell-unreadable")),
        }
    }

    /// Adds a face (type 510) that stands in no shell; such faces share their edges.
    pub fn add_brep_face(&mut self, entry: u32, color: Option<Rgba>) {
        let mut shared = std::mem::take(&mut self.loose_edges);
        let face = self.face(entry, color, |builder| {
            let surface = face_surface(&builder.reader, entry)?;
            builder.shell_face(entry, surface, &mut shared)
        });
        self.loose_edges = shared;
        self.hide_blanked(entry, face);
        self.loose.push(face);
    }

    /// Moves what was added since there were so many faces, edges and vertices by a solid's own matrix, which holds for
    /// all that the solid is made of.
    fn place(&mut self, entry: u32, [faces, edges, vertices]: [usize; 3]) -> Outcome<()> {
        let directory = self.reader.parameters(entry)?.directory;
        if directory.transformation == 0 {
            return Ok(());
        }
        let map = self.reader.placement_mm(directory)?;
        let mirrored = map.matrix3.determinant() < 0.0;
        for face in &mut self.part.faces[faces..] {
            if let FaceGeometry::Surface(surface) = &mut face.geometry {
                let (image, turned) = surface.transformed(&map);
                *surface = Arc::new(image);
                face.same_sense ^= turned;
            }
            for bound in face.loops.iter_mut().filter(|_| mirrored) {
                bound.coedges.reverse();
                bound.coedges.iter_mut().for_each(|coedge| coedge.reversed ^= true);
            }
        }
        for edge in &mut self.part.edges[edges..] {
            edge.curve = Arc::new(edge.curve.transformed(&map));
        }
        for vertex in &mut self.part.vertices[vertices..] {
            vertex.point = map.transform_point3(vertex.point);
        }
        Ok(())
    }

    fn solid(&mut self, entry: u32, color: Option<Rgba>) -> Outcome<Body> {
        let mut parameters = self.reader.parameters(entry)?;
        let name = name_of(&self.reader, entry).unwrap_or_default();
        let is_solid = parameters.directory.entity_type == 186;
        let form = parameters.directory.form;
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
        let layers = levels_of(&self.reader, entry);
        let mut body = Body { name, entity: EntityRef::Iges(entry), kind: BodyKind::Solid, shells, layers };
        // A shell that stands alone bounds a solid where it is said to close, and does.
        let mut uses = vec![0; self.part.edges.len()];
        if !is_solid && (form == 2 || !free_edges(&self.part, &body, &mut uses).is_empty()) {
            body.kind = BodyKind::Sheet;
            body.shells[0].closed = false;
        }
        Ok(body)
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
        let listed: Vec<(u32, bool)> = (0..parameters.count(2)?)
            .map(|_| Ok((parameters.pointer()?, parameters.integer()? != 0)))
            .collect::<Outcome<_>>()?;
        let reader = self.reader;
        let surfaces = map_each(&listed, |&(face, _)| face_surface(&reader, face));
        let mut faces = Vec::with_capacity(listed.len());
        for ((face, agrees), surface) in listed.into_iter().zip(surfaces) {
            let own = color_of(&self.reader, face).or(color);
            let id = self.face(face, own, |builder| builder.shell_face(face, surface?, shared));
            faces.push(ShellFace { face: id, reversed: agrees == turned });
        }
        Ok(Shell { entity: EntityRef::Iges(entry), closed, void, faces })
    }

    /// Type 510, on the surface that [`face_surface`] has read.
    fn shell_face(
        &mut self,
        entry: u32,
        (surface, same_sense): (Surface, bool),
        shared: &mut SharedEdges,
    ) -> Outcome<(FaceGeometry, bool, Vec<Loop>)> {
        let mut parameters = self.reader.parameters(entry)?;
        parameters.pointer()?;
        let count = parameters.count(1)?;
        let has_outer = parameters.integer()? != 0;
        let mut loops = Vec::with_capacity(count);
        let mut astray = Vec::new();
        for k in 0..count {
            let bound = parameters.pointer()?;
            loops.push(self.edge_loop(bound, has_outer && k == 0, shared, &mut astray)?);
        }
        if !astray.is_empty() {
            self.mend(entry, &astray)?;
        }
        Ok((FaceGeometry::Surface(Arc::new(surface)), same_sense, loops))
    }

    /// Type 508. Edges that end away from their vertices are listed in `astray`.
    fn edge_loop(
        &mut self,
        entry: u32,
        outer: bool,
        shared: &mut SharedEdges,
        astray: &mut Vec<Astray>,
    ) -> Outcome<Loop> {
        let mut parameters = self.reader.parameters(entry)?;
        parameters.expect(&[508], "loop")?;
        let mut bound = Loop { entity: EntityRef::Iges(entry), outer, ..Loop::default() };
        for _ in 0..parameters.count(5)? {
            let is_vertex = parameters.integer()? == 1;
            let (list, index) = (parameters.pointer()?, parameters.integer()?);
            let agrees = parameters.integer()? != 0;
            let mut images = Vec::new();
            for _ in 0..parameters.count(2)? {
                parameters.integer()?;
                images.push(parameters.pointer()?);
            }
            let number = u32::try_from(index).ok().filter(|number| *number > 0);
            let number = number.ok_or_else(|| parameters.fault("names an edge by a number that is none"))?;
            if is_vertex {
                bound.vertex = Some(self.listed_vertex(list, number, shared)?);
            } else {
                let edge = self.listed_edge(list, number as usize - 1, shared)?;
                if let [image] = images[..]
                    && self.astray_mm(&self.part.edges[edge as usize]) > LEAST_ASTRAY_MM
                {
                    astray.push(Astray { edge, agrees, image });
                }
                bound.coedges.push(Coedge { edge, reversed: !agrees, pcurve: None });
            }
        }
        if !bound.coedges.is_empty() {
            bound.vertex = None;
        }
        Ok(bound)
    }

    /// How far an edge's curve ends from its vertices, millimetres.
    fn astray_mm(&self, edge: &Edge) -> f64 {
        let vertices = if edge.same_sense { [edge.start, edge.end] } else { [edge.end, edge.start] };
        let ends = [edge.range.start, edge.range.end].map(|t| edge.curve.point(t));
        let apart = |k: usize| self.part.vertices[vertices[k] as usize].point.distance(ends[k]);
        apart(0).max(apart(1))
    }

    /// Gives edges of a face (type 510) that end away from their vertices the curves that they have in the parameters of
    /// its surface, where those end at the vertices: OpenCASCADE turns whole ellipses in their planes where it writes
    /// them, and has them right in parameters.
    fn mend(&mut self, face: u32, astray: &[Astray]) -> Outcome<()> {
        let ground = self.reader.surface(self.reader.parameters(face)?.pointer()?)?;
        let surface = Arc::new(ground.surface);
        let mut maps = vec![ground.parameters];
        if let Surface::Cone { half_angle_rad, .. } = *surface {
            // It counts lengths on cones along their sides, not along their axes.
            maps.push(DAffine3::from_scale(DVec3::new(1.0, half_angle_rad.cos(), 1.0)) * ground.parameters);
        }
        for &Astray { edge: id, agrees, image } in astray {
            let edge = &self.part.edges[id as usize];
            let Ok([image]) = <[Piece; 1]>::try_from(self.reader.parameter_curve(image)?) else { continue };
            let mended = maps.iter().map(|map| {
                let pcurve = Arc::new(image.curve.transformed(map));
                let curve = Arc::new(Curve::OnSurface { surface: surface.clone(), pcurve });
                let mut mended = Edge { curve, range: image.range, same_sense: true, ..edge.clone() };
                mended.same_sense = if edge.start == edge.end {
                    // In parameters curves run as the loop does.
                    agrees
                } else {
                    let [start, end] = [edge.start, edge.end].map(|id| self.part.vertices[id as usize].point);
                    let first = mended.curve.point(mended.range.start);
                    first.distance(start) <= first.distance(end)
                };
                mended
            });
            let best = mended.min_by(|a, b| self.astray_mm(a).total_cmp(&self.astray_mm(b)));
            let best = best.filter(|mended| self.astray_mm(mended) < 0.1 * self.astray_mm(edge));
            if let Some(mended) = best {
                self.part.edges[id as usize] = mended;
            }
        }
        Ok(())
    }

    /// An edge of a list (type 504).
    fn listed_edge(&mut self, list: u32, index: usize, shared: &mut SharedEdges) -> Outcome<u32> {
        if let Some(&known) = shared.edges.get(&(list, index)) {
            return Ok(known);
        }
        let [curve, from, from_index, to, to_index] = self.lists.edge(&self.reader, list, index)?;
        let start = self.listed_vertex(from, from_index, shared)?;
        let end = self.listed_vertex(to, to_index, shared)?;
        let pieces = self.reader.curve(curve)?;
        let Piece { curve, range, .. } = joined(pieces, &self.reader.parameters(curve)?)?;
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
    fn listed_vertex(&mut self, list: u32, index: u32, shared: &mut SharedEdges) -> Outcome<VertexId> {
        if let Some(&known) = shared.vertices.get(&(list, index)) {
            return Ok(known);
        }
        let point = self.lists.vertex(&self.reader, list, index)?;
        let id = self.vertex(point, EntityRef::Iges(list));
        shared.vertices.insert((list, index), id);
        Ok(id)
    }
}

/// The surface of a face (type 510), and whether it looks the same way as the face.
fn face_surface(reader: &Reader<'_>, entry: u32) -> Outcome<(Surface, bool)> {
    let mut parameters = reader.parameters(entry)?;
    parameters.expect(&[510], "face")?;
    Ok(reader.surface(parameters.pointer()?)?.simplified())
}

/// Edges and vertices of lists that a body has already.
#[derive(Default)]
pub(crate) struct SharedEdges {
    edges: FxHashMap<(u32, usize), u32>,
    vertices: FxHashMap<(u32, u32), VertexId>,
}

/// Lists of edges and vertices that were read already.
#[derive(Default)]
pub(crate) struct Lists {
    /// Per list and edge: the curve, and list and number of the first and the last vertex.
    edges: FxHashMap<u32, Vec<[u32; 5]>>,
    vertices: FxHashMap<u32, Vec<DVec3>>,
}

impl Lists {
    fn edge(&mut self, reader: &Reader<'_>, list: u32, index: usize) -> Outcome<[u32; 5]> {
        let edges = match self.edges.entry(list) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(empty) => empty.insert(read_edges(reader, list)?),
        };
        let missing = || Fault::new(list, format!("has {} edges, no number {}", edges.len(), index + 1));
        edges.get(index).copied().ok_or_else(missing)
    }

    /// A vertex by its number, from 1.
    fn vertex(&mut self, reader: &Reader<'_>, list: u32, number: u32) -> Outcome<DVec3> {
        let vertices = match self.vertices.entry(list) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(empty) => empty.insert(read_vertices(reader, list)?),
        };
        let missing = || Fault::new(list, format!("has {} vertices, no number {number}", vertices.len()));
        (number as usize).checked_sub(1).and_then(|index| vertices.get(index)).copied().ok_or_else(missing)
    }
}

/// Type 504.
fn read_edges(reader: &Reader<'_>, list: u32) -> Outcome<Vec<[u32; 5]>> {
    let mut parameters = reader.parameters(list)?;
    parameters.expect(&[504], "edge list")?;
    let count = parameters.count(5)?;
    let mut edges = vec![[0; 5]; count];
    for value in edges.iter_mut().flatten() {
        *value = parameters.pointer()?;
    }
    Ok(edges)
}

/// Type 502, placed.
fn read_vertices(reader: &Reader<'_>, list: u32) -> Outcome<Vec<DVec3>> {
    let mut parameters = reader.parameters(list)?;
    parameters.expect(&[502], "vertex list")?;
    let count = parameters.count(3)?;
    let map = reader.placement(parameters.directory)?;
    let points = parameters.points(count)?;
    Ok(points.into_iter().map(|point| map.transform_point3(point)).collect())
}
