//! Wireframe models: edges that bound no face.

use trimloop_brep::FreeCurve;

use super::context::Context;
use super::edge_range::edge_range;
use super::fault::Outcome;
use super::keyword::Kind;
use super::look::Look;
use super::part_builder::PartBuilder;

impl PartBuilder<'_> {
    /// `edge_based_wireframe_model` and `shell_based_wireframe_model`: every edge becomes a free curve.
    pub fn wireframe(&mut self, index: usize, look: Look, context: Context) {
        if look.hidden {
            return;
        }
        let mut edges = Vec::new();
        for boundary in self.table.attributes(index).after(1).found_references() {
            let members = self.table.attributes(boundary).after(1).found_references();
            match self.table.kind(boundary) {
                Kind::ConnectedEdgeSet => edges.extend(members),
                Kind::WireShell => {
                    for member in members {
                        edges.extend(self.table.attributes(member).after(1).found_references());
                    }
                }
                _ => {}
            }
        }
        for edge in edges {
            self.wire_edge(edge, look, context);
        }
    }

    fn wire_edge(&mut self, index: usize, inherited: Look, context: Context) {
        let look = self.looks.of(index).over(inherited);
        match self.free_edge(index, look, context) {
            Ok(curve) => self.seeds.free_curves.push(curve),
            Err(fault) => self.seeds.diagnostics.push(fault.warning("curve-unreadable")),
        }
    }

    fn free_edge(&mut self, index: usize, look: Look, context: Context) -> Outcome<FreeCurve> {
        let index = match self.table.kind(index) {
            Kind::OrientedEdge => self.table.attributes(index).after(3).reference("edge element")?,
            _ => index,
        };
        let mut reader = self.reader(context);
        if self.table.kind(index) != Kind::EdgeCurve {
            return Err(reader.unexpected(index, "edge"));
        }
        let mut attributes = self.table.attributes(index).after(1);
        let (start, end) = (attributes.reference("start vertex")?, attributes.reference("end vertex")?);
        let curve = reader.curve(attributes.reference("edge geometry")?)?;
        let same_sense = attributes.flag();
        let point = |vertex: usize| {
            let mut attributes = self.table.attributes(vertex).after(1);
            reader.point(attributes.reference("vertex geometry")?)
        };
        let (from, to) = (point(start)?, point(end)?);
        let found = edge_range(&curve, from, to, start == end, same_sense, 1e-6);
        self.seeds.diagnostics.append(&mut reader.notes);
        if !found.range.is_finite() {
            return Err(reader.fault(index, "does not lie on its curve"));
        }
        Ok(FreeCurve {
            entity: self.table.entity(index),
            curve: curve.into(),
            range: found.range,
            color: look.curve.or(look.surface),
        })
    }
}
