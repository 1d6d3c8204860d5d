//! What is under the mouse: a vertex, an edge or a face.

use egui::{Pos2, Rect};
use glam::DVec2;
use trimloop_brep::EdgeId;
use trimloop_measure::Feature;
use trimloop_render::{Camera, Identified, Place};

use crate::document::{Document, Picked};

/// What can be picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Filter {
    pub faces: bool,
    pub edges: bool,
    pub vertices: bool,
}

impl Default for Filter {
    fn default() -> Self {
        Self { faces: true, edges: true, vertices: true }
    }
}

/// A picture as it is shown.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub camera: Camera,
    /// Pixels.
    pub size: [u32; 2],
    /// Where it is, in points.
    pub rect: Rect,
}

impl Frame {
    /// Pixels per point.
    pub fn scale(&self) -> f64 {
        f64::from(self.size[1]) / f64::from(self.rect.height().max(1.0))
    }

    /// Where a place of the model is drawn, in points.
    pub fn at(&self, point: glam::DVec3) -> Option<Pos2> {
        let pixel = self.camera.project(point, self.size)? / self.scale();
        Some(self.rect.min + egui::vec2(pixel.x as f32, pixel.y as f32))
    }

    /// The pixel at a place of the window.
    pub fn pixel(&self, at: Pos2) -> DVec2 {
        let off = at - self.rect.min;
        DVec2::new(f64::from(off.x), f64::from(off.y)) * self.scale()
    }
}

/// Vertices and edges are caught from so far, points.
const VERTEX_REACH: f64 = 7.0;
const EDGE_REACH: f64 = 5.0;

/// The pixels around a place of the window that [`under`] looks at: the left upper one, and how many.
pub(crate) fn around(frame: &Frame, at: Pos2) -> [[u32; 2]; 2] {
    let reach = DVec2::splat(VERTEX_REACH.max(EDGE_REACH) * frame.scale() + 4.0);
    let pixel = frame.pixel(at);
    let whole = DVec2::new(f64::from(frame.size[0]), f64::from(frame.size[1]));
    let low = (pixel - reach).clamp(DVec2::ZERO, whole - 1.0).floor();
    let high = (pixel + reach).clamp(low + 1.0, whole).ceil();
    [[low.x as u32, low.y as u32], [(high.x - low.x) as u32, (high.y - low.y) as u32]]
}

/// What lies at a place of the window, as the picture shows it. Vertices go before edges, those before faces.
pub(crate) fn under(
    document: &mut Document,
    identified: &Identified,
    frame: &Frame,
    at: Pos2,
    filter: Filter,
) -> Option<Picked> {
    let pixel = frame.pixel(at);
    let near = faces_near(document, identified, pixel, EDGE_REACH.max(VERTEX_REACH) * frame.scale());
    if filter.edges || filter.vertices {
        let mut best: Option<(f64, Picked)> = None;
        for &(instance, face) in &near {
            for edge in document.edges_of(instance, face) {
                let found = on_edge(document, identified, frame, pixel, (instance, edge), filter);
                if let Some((rank, picked)) = found
                    && best.as_ref().is_none_or(|(own, _)| rank < *own)
                {
                    best = Some((rank, picked));
                }
            }
        }
        if let Some((_, picked)) = best {
            return Some(picked);
        }
    }
    if !filter.faces {
        return None;
    }
    let scene = document.renderer.scene();
    let pick = identified.at(scene, [pixel.x.floor() as i64, pixel.y.floor() as i64])?;
    document.node_of(pick.instance)?;
    let place = Place::new(scene, &pick, frame.camera.ray(pixel, frame.size));
    Some(Picked { instance: pick.instance, feature: Some(Feature::Face(pick.face as u32)), place })
}

/// The place of the model at a place of the window.
pub(crate) fn place_at(
    document: &Document,
    identified: &Identified,
    frame: &Frame,
    at: Pos2,
) -> Option<glam::DVec3> {
    let scene = document.renderer.scene();
    let pixel = frame.pixel(at);
    let pick = identified.at(scene, [pixel.x.floor() as i64, pixel.y.floor() as i64])?;
    Some(Place::new(scene, &pick, frame.camera.ray(pixel, frame.size))?.point)
}

/// Faces of the model that are seen within `reach` pixels.
fn faces_near(document: &Document, identified: &Identified, pixel: DVec2, reach: f64) -> Vec<(usize, u32)> {
    let mut out = Vec::new();
    let steps = reach.ceil() as i64;
    let [x, y] = [pixel.x.floor() as i64, pixel.y.floor() as i64];
    for row in -steps..=steps {
        for column in -steps..=steps {
            let pick = identified.at(document.renderer.scene(), [x + column, y + row]);
            let Some(pick) = pick.filter(|pick| document.node_of(pick.instance).is_some()) else { continue };
            if !out.contains(&(pick.instance, pick.face as u32)) {
                out.push((pick.instance, pick.face as u32));
            }
        }
    }
    out
}

/// Whether the mouse is at an edge, or at one of its ends: how good a catch that is (less is better), and what it is.
fn on_edge(
    document: &mut Document,
    identified: &Identified,
    frame: &Frame,
    pixel: DVec2,
    (instance, edge): (usize, EdgeId),
    filter: Filter,
) -> Option<(f64, Picked)> {
    let scale = frame.scale();
    if filter.vertices {
        let ends = document.part_of(instance)?.edges.get(edge as usize).map(|own| [own.start, own.end])?;
        for vertex in ends {
            let point = document.vertex(instance, vertex)?;
            let Some(at) = frame.camera.project(point, frame.size) else { continue };
            let off = at.distance(pixel) / scale;
            if off <= VERTEX_REACH && is_seen(document, identified, at, (instance, edge)) {
                let feature = Some(Feature::Vertex(vertex));
                return Some((off - 1000.0, Picked { instance, feature, place: None }));
            }
        }
    }
    if !filter.edges {
        return None;
    }
    let line = document.line(instance, edge);
    let places: Vec<Option<DVec2>> = line.iter().map(|p| frame.camera.project(*p, frame.size)).collect();
    let mut best: Option<(f64, DVec2)> = None;
    for pair in places.windows(2) {
        let [Some(a), Some(b)] = [pair[0], pair[1]] else { continue };
        let along = b - a;
        let share = ((pixel - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
        let foot = a + along * share;
        let off = foot.distance(pixel) / scale;
        if off <= EDGE_REACH && best.is_none_or(|(own, _)| off < own) {
            best = Some((off, foot));
        }
    }
    let (off, foot) = best?;
    let picked = Picked { instance, feature: Some(Feature::Edge(edge)), place: None };
    is_seen(document, identified, foot, (instance, edge)).then_some((off, picked))
}

/// Whether a face that ends at the edge is seen next to a pixel.
fn is_seen(
    document: &Document,
    identified: &Identified,
    at: DVec2,
    (instance, edge): (usize, EdgeId),
) -> bool {
    let Some(part) = document.part_of(instance) else { return false };
    let [x, y] = [at.x.floor() as i64, at.y.floor() as i64];
    let around = (-2..=2).flat_map(|row| (-2..=2).map(move |column| [x + column, y + row]));
    around.filter_map(|pixel| identified.at(document.renderer.scene(), pixel)).any(|pick| {
        pick.instance == instance
            && part.faces.get(pick.face).is_some_and(|face| {
                face.loops.iter().flat_map(|l| &l.coedges).any(|coedge| coedge.edge == edge)
            })
    })
}
