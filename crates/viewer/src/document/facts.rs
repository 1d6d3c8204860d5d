//! What is known of the selection.

use glam::DVec3;
use trimloop_brep::{Face, FaceGeometry};
use trimloop_geom::Aabb;
use trimloop_measure::Feature;

use crate::measure::{number, vector};

use super::Document;

/// What kind of surface a face has.
fn surface_kind(face: &Face) -> String {
    match &face.geometry {
        FaceGeometry::Surface(surface) => surface.kind().to_owned(),
        FaceGeometry::Facets(_) => "triangles".to_owned(),
        FaceGeometry::Unreadable(reason) => format!("unreadable: {reason}"),
    }
}

/// The sides of a box.
fn size_of_box(bounds: Aabb) -> String {
    let d = bounds.max - bounds.min;
    format!("{} x {} x {} mm", number(d.x), number(d.y), number(d.z))
}

impl Document {
    /// What is known of the selection, as lines of a name and a value.
    pub fn facts(&self) -> Vec<(String, String)> {
        let mut out = Vec::new();
        let mut say = |name: &str, value: String| out.push((name.to_owned(), value));
        let Some(picked) = self.selection.last() else { return out };
        let are_features = self.selection.iter().all(|own| own.feature.is_some());
        if self.selection.len() == 2 && are_features {
            self.measure.facts().into_iter().for_each(|(name, value)| say(&name, value));
            return out;
        }
        if self.selection.len() > 1 {
            if let Some(node) = self.node {
                say("node", self.model.nodes[node].name.clone());
            }
            say(if are_features { "selected" } else { "parts" }, self.selection.len().to_string());
            let wholes = self.selection.iter().filter(|own| own.feature.is_none());
            let points: Vec<DVec3> =
                wholes.flat_map(|own| self.outline(Some(own.instance..own.instance + 1))).collect();
            let bounds = Aabb::from_points(points);
            if !bounds.is_empty() {
                say("box", size_of_box(bounds));
            }
            if !are_features {
                self.measure.facts().into_iter().for_each(|(name, value)| say(&name, value));
            }
            return out;
        }
        let Some(part) = self.part_of(picked.instance) else { return out };
        if let Some(node) = self.node_of(picked.instance) {
            let own = &self.model.nodes[node];
            say("node", own.name.clone());
            if own.instance_name.as_ref().is_some_and(|name| *name != own.name) {
                say("use", own.instance_name.clone().unwrap_or_default());
            }
        }
        say("part", if part.name.is_empty() { part.id.clone() } else { part.name.clone() });
        let mut own_kind = None;
        match picked.feature {
            None => {
                say("bodies", part.bodies.len().to_string());
                say("faces", part.faces.len().to_string());
                let size =
                    self.renderer.scene().parts[self.renderer.scene().instances[picked.instance].part].bounds;
                if !size.is_empty() {
                    say("box", size_of_box(size));
                }
            }
            Some(Feature::Face(face)) => {
                let Some(own) = part.faces.get(face as usize) else { return out };
                say("face", own.entity.to_string());
                if !own.name.is_empty() {
                    say("name", own.name.to_string());
                }
                own_kind = Some(surface_kind(own));
                say("surface", surface_kind(own));
            }
            Some(Feature::Edge(edge)) => {
                let Some(own) = part.edges.get(edge as usize) else { return out };
                say("edge", own.entity.to_string());
            }
            Some(Feature::Vertex(vertex)) => {
                let Some(own) = part.vertices.get(vertex as usize) else { return out };
                say("vertex", own.entity.to_string());
            }
        }
        // Of faces, the kind stands there already, unless the surface is a plainer one than the file says.
        let kind = own_kind.unwrap_or_default();
        let facts = self.measure.facts().into_iter();
        facts
            .filter(|(name, value)| name != "kind" || *value != kind)
            .for_each(|(name, value)| say(&name, value));
        if let Some(place) = picked.place {
            // Of a cone, the radius depends on where.
            if let Some(radius) = place.radius_mm
                && self
                    .measure
                    .found
                    .as_ref()
                    .is_some_and(|m| m.facts.as_ref().is_some_and(|f| f.radius_mm.is_none()))
            {
                say("radius here", format!("{} mm", number(radius)));
            }
            say("point", format!("{} mm", vector(place.point - self.moved(picked.instance))));
            say("normal", vector(place.normal));
            say("u, v", format!("{}, {}", number(place.uv.x), number(place.uv.y)));
        }
        out
    }
}
