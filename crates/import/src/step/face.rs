//! Faces, loops and edges: topology without geometry.

use trimloop_brep::{Coedge, EdgeId, Loop, VertexId};

use super::context::Context;
use super::fault::{Fault, Outcome};
use super::keyword::Kind;
use super::look::Look;
use super::part_builder::PartBuilder;
use super::seeds::{EdgeCurve, EdgeSeed, FaceSeed, FaceSurface, VertexSeed};

/// How many oriented entities may be wrapped around each other.
const MAX_WRAPPING: usize = 16;

impl<'t> PartBuilder<'t> {
    /// The face of an entity, made when it is new, and whether oriented faces around it turn it over.
    pub fn face(&mut self, index: usize, look: Look, context: Context) -> (u32, bool) {
        let mut index = index;
        let mut look = look;
        let mut reversed = false;
        let mut depth = 0;
        while self.table.kind(index) == Kind::OrientedFace && depth < MAX_WRAPPING {
            look = self.looks.of(index).over(look);
            let mut attributes = self.table.attributes(index).after(2);
            let Ok(element) = attributes.reference("face element") else { break };
            reversed ^= !attributes.flag();
            index = element;
            depth += 1;
        }
        if let Some(&face) = self.seeds.face_of.get(&index) {
            return (face, reversed);
        }
        let look = self.looks.of(index).over(look);
        let seed = self.face_seed(index, look, context);
        self.seeds.faces.push(seed);
        let face = (self.seeds.faces.len() - 1) as u32;
        self.seeds.face_of.insert(index, face);
        (face, reversed)
    }

    /// The face standing for an entity that is missing from the file.
    pub fn missing_face(&mut self, owner: usize, id: u64) -> u32 {
        let fault = Fault::new(id, "is missing from the file");
        self.seeds.faces.push(FaceSeed {
            index: owner,
            name: String::new(),
            surface: Err(fault),
            same_sense: true,
            loops: Vec::new(),
            color: None,
            hidden: false,
        });
        (self.seeds.faces.len() - 1) as u32
    }

    fn face_seed(&mut self, index: usize, look: Look, context: Context) -> FaceSeed {
        let mut seed = FaceSeed {
            index,
            name: String::new(),
            surface: Ok(FaceSurface::Flat),
            same_sense: true,
            loops: Vec::new(),
            color: look.surface,
            hidden: look.hidden,
        };
        if let Err(fault) = self.fill_face(&mut seed, context) {
            seed.surface = Err(fault);
            seed.loops.clear();
        }
        seed
    }

    fn fill_face(&mut self, seed: &mut FaceSeed, context: Context) -> Outcome<()> {
        let index = seed.index;
        let kind = self.table.kind(index);
        if !matches!(kind, Kind::AdvancedFace | Kind::FaceSurface | Kind::Face | Kind::Subface) {
            return Err(self.reader(context).unexpected(index, "face"));
        }
        let mut attributes = self.table.attributes(index);
        seed.name = attributes.text().into_owned();
        let bounds = attributes.ids("bounds")?;
        match kind {
            Kind::AdvancedFace | Kind::FaceSurface => {
                let surface = attributes.reference("face geometry")?;
                seed.surface =
                    Ok(FaceSurface::Slot(self.seeds.surface_slot(surface, context.units, bounds.is_empty())));
                seed.same_sense = attributes.flag();
            }
            Kind::Subface => {
                let parent = attributes.reference("parent face")?;
                let mut parent = self.table.attributes(parent).after(2);
                let surface = parent.reference("face geometry")?;
                seed.surface =
                    Ok(FaceSurface::Slot(self.seeds.surface_slot(surface, context.units, bounds.is_empty())));
                seed.same_sense = parent.flag();
            }
            _ => {}
        }
        for id in bounds {
            let bound = self.table.find(id);
            let bound = bound.ok_or_else(|| Fault::new(id, "is missing from the file"))?;
            if let Some(bound) = self.bound(bound, context)? {
                seed.loops.push(bound);
            }
        }
        Ok(())
    }

    /// `face_bound`: a loop in the direction in which the face uses it; `None` for an empty one.
    fn bound(&mut self, index: usize, context: Context) -> Outcome<Option<Loop>> {
        let kind = self.table.kind(index);
        if !matches!(kind, Kind::FaceBound | Kind::FaceOuterBound) {
            return Err(self.reader(context).unexpected(index, "face bound"));
        }
        let mut attributes = self.table.attributes(index).after(1);
        let bound = attributes.reference("bound")?;
        let orientation = attributes.flag();
        let mut result = self.bounding_loop(bound, context)?;
        if !orientation {
            result.coedges.reverse();
            result.coedges.iter_mut().for_each(|coedge| coedge.reversed ^= true);
        }
        result.outer = kind == Kind::FaceOuterBound;
        Ok((!result.coedges.is_empty() || result.vertex.is_some()).then_some(result))
    }

    fn bounding_loop(&mut self, index: usize, context: Context) -> Outcome<Loop> {
        let mut result = Loop { entity: self.table.entity(index), ..Loop::default() };
        let mut attributes = self.table.attributes(index).after(1);
        match self.table.kind(index) {
            Kind::EdgeLoop => {
                for oriented in attributes.references("edges")? {
                    let (edge, reversed) = self.oriented_edge(oriented, context)?;
                    result.coedges.push(Coedge { edge, reversed, pcurve: None });
                }
            }
            Kind::PolyLoop => result.coedges = self.polygon(&attributes.references("polygon")?, context),
            Kind::VertexLoop => {
                let vertex = attributes.reference("loop vertex")?;
                result.vertex = Some(self.vertex(vertex, context)?);
            }
            _ => return Err(self.reader(context).unexpected(index, "loop")),
        }
        Ok(result)
    }

    /// The straight edges around a polygon, which neighbouring polygons share.
    fn polygon(&mut self, points: &[usize], context: Context) -> Vec<Coedge> {
        let mut corners: Vec<VertexId> =
            points.iter().map(|&point| self.seeds.vertex(point, context.units)).collect();
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        let next = corners.iter().cycle().skip(1);
        let sides: Vec<_> = corners.iter().copied().zip(next.copied()).collect();
        let coedges = sides.into_iter().map(|(from, to)| {
            let (edge, reversed) = self.seeds.polygon_edge(from, to, context.units);
            Coedge { edge, reversed, pcurve: None }
        });
        coedges.collect()
    }

    /// An edge and whether it is used from its end to its start.
    fn oriented_edge(&mut self, index: usize, context: Context) -> Outcome<(EdgeId, bool)> {
        let mut index = index;
        let mut reversed = false;
        for _ in 0..MAX_WRAPPING {
            if self.table.kind(index) != Kind::OrientedEdge {
                return Ok((self.edge(index, context)?, reversed));
            }
            let mut attributes = self.table.attributes(index).after(3);
            let id = attributes.id("edge element")?;
            reversed ^= !attributes.flag();
            match self.table.find(id) {
                Some(element) => index = element,
                None => return Ok((self.lost_edge(id, context), reversed)),
            }
        }
        Err(self.reader(context).fault(index, "is wrapped in too many oriented edges"))
    }

    /// An edge that is missing from the file: its neighbours may tell where it was.
    fn lost_edge(&mut self, id: u64, context: Context) -> EdgeId {
        if let Some(&known) = self.seeds.lost_edge_of.get(&id) {
            return known;
        }
        let fault = Fault::new(id, "is missing from the file");
        let ends = [0, 1].map(|_| {
            self.seeds.vertices.push(VertexSeed::Lost(fault.clone()));
            (self.seeds.vertices.len() - 1) as VertexId
        });
        let [start, end] = ends;
        let curve = EdgeCurve::Lost(fault);
        let edge = EdgeSeed { index: None, start, end, curve, same_sense: true, units: context.units };
        let edge = self.seeds.add_edge(edge);
        self.seeds.lost_edge_of.insert(id, edge);
        edge
    }

    /// The edge of an entity, made when it is new.
    pub fn edge(&mut self, index: usize, context: Context) -> Outcome<EdgeId> {
        if let Some(known) = self.seeds.edge_of.get(&index) {
            return known.clone();
        }
        let edge = self.edge_seed(index, context).map(|seed| self.seeds.add_edge(seed));
        self.seeds.edge_of.insert(index, edge.clone());
        edge
    }

    fn edge_seed(&mut self, index: usize, context: Context) -> Outcome<EdgeSeed> {
        let mut attributes = self.table.attributes(index).after(1);
        let (start, end) = (attributes.id("start vertex")?, attributes.id("end vertex")?);
        let (start, end) = (self.edge_vertex(start, context), self.edge_vertex(end, context));
        let units = context.units;
        match self.table.kind(index) {
            Kind::EdgeCurve => {
                let curve = match attributes.reference("edge geometry") {
                    Ok(curve) => EdgeCurve::Slot(self.seeds.curve_slot(curve, units)),
                    Err(fault) => EdgeCurve::Lost(fault),
                };
                Ok(EdgeSeed { index: Some(index), start, end, curve, same_sense: attributes.flag(), units })
            }
            Kind::Edge => Ok(EdgeSeed {
                index: Some(index),
                start,
                end,
                curve: EdgeCurve::Straight,
                same_sense: true,
                units,
            }),
            Kind::Subedge => self.subedge(index, start, end, context),
            _ => Err(self.reader(context).unexpected(index, "edge")),
        }
    }

    /// `subedge`: a piece of its parent's curve.
    fn subedge(
        &mut self,
        index: usize,
        start: VertexId,
        end: VertexId,
        context: Context,
    ) -> Outcome<EdgeSeed> {
        let parent = self.table.attributes(index).after(3).reference("parent edge")?;
        if self.table.kind(parent) != Kind::EdgeCurve {
            return Err(self.reader(context).unexpected(parent, "parent edge"));
        }
        let mut attributes = self.table.attributes(parent).after(3);
        let curve = attributes.reference("edge geometry")?;
        let curve = EdgeCurve::Slot(self.seeds.curve_slot(curve, context.units));
        let same_sense = attributes.flag();
        Ok(EdgeSeed { index: Some(index), start, end, curve, same_sense, units: context.units })
    }

    /// The vertex `#id` of an edge; one that is lost may be found again by the edges that meet there.
    fn edge_vertex(&mut self, id: u64, context: Context) -> VertexId {
        let found = match self.table.find(id) {
            Some(index) => self.vertex(index, context),
            None => Err(Fault::new(id, "is missing from the file")),
        };
        found.unwrap_or_else(|fault| self.seeds.lost_vertex(id, fault))
    }

    fn vertex(&mut self, index: usize, context: Context) -> Outcome<VertexId> {
        if self.table.kind(index) == Kind::VertexPoint {
            Ok(self.seeds.vertex(index, context.units))
        } else {
            Err(self.reader(context).unexpected(index, "vertex"))
        }
    }
}
