//! The section plane: where it is, the handles that move it, and what closes the solids that it cuts open.

use std::sync::Arc;
use std::time::Instant;

use egui::{Color32, Pos2, Response, Stroke, Ui};
use glam::{DVec2, DVec3};
use trimloop_geom::Aabb;
use trimloop_mesh::Silent;
use trimloop_render::{Cutter, Instance, MOST_SECTIONS, RenderError, ScenePart, Section};

use crate::document::Document;
use crate::job::{Job, Polled};
use crate::pick::Frame;

/// A section plane; everything on the side that `normal` points to is cut away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cut {
    pub is_on: bool,
    /// Unit normal, in the model's coordinates.
    pub normal: DVec3,
    /// Where the plane cuts the normal, millimetres from the origin; the model's middle as long as nobody moved it.
    pub offset_mm: Option<f64>,
    pub has_gizmo: bool,
}

impl Default for Cut {
    fn default() -> Self {
        Self { is_on: false, normal: DVec3::X, offset_mm: None, has_gizmo: true }
    }
}

impl Cut {
    /// The plane, if it is on.
    pub fn section(&self, bounds: Aabb) -> Option<Section> {
        (self.is_on && !bounds.is_empty()).then(|| self.plane(bounds))
    }

    /// The plane, on or not.
    pub fn plane(&self, bounds: Aabb) -> Section {
        let offset_mm = self.offset_mm.unwrap_or_else(|| self.normal.dot(bounds.center()));
        Section { normal: self.normal, offset_mm }
    }

    /// Offsets at which the plane just touches the model.
    pub fn range(&self, bounds: Aabb) -> [f64; 2] {
        let all = bounds.corners().map(|corner| self.normal.dot(corner));
        let low = all.iter().copied().fold(f64::INFINITY, f64::min);
        let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [low, high]
    }

    /// Cuts across another direction, through the same place as far as that was chosen.
    pub fn turn(&mut self, normal: DVec3, through: Option<DVec3>) {
        self.normal = normal.normalize_or(DVec3::X);
        self.offset_mm = through.map(|point| self.normal.dot(point));
    }

    pub fn flip(&mut self, bounds: Aabb) {
        let plane = self.plane(bounds);
        self.normal = -self.normal;
        self.offset_mm = Some(-plane.offset_mm);
    }
}

/// The section planes: up to three, which cut independently.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Cuts {
    pub all: [Cut; MOST_SECTIONS],
    /// The one that the panel and the handles move.
    pub active: usize,
}

impl Cuts {
    /// As they are when a file is opened: none is on, each across an axis of its own.
    pub fn new() -> Self {
        let mut own = Self::default();
        for (cut, normal) in own.all.iter_mut().zip([DVec3::X, DVec3::Y, DVec3::Z]) {
            cut.normal = normal;
        }
        own
    }

    pub fn active(&self) -> &Cut {
        &self.all[self.active.min(MOST_SECTIONS - 1)]
    }

    pub fn active_mut(&mut self) -> &mut Cut {
        &mut self.all[self.active.min(MOST_SECTIONS - 1)]
    }

    /// The planes that are on.
    pub fn sections(&self, bounds: Aabb) -> [Option<Section>; MOST_SECTIONS] {
        self.all.map(|cut| cut.section(bounds))
    }
}

/// What closes the solids of a document that are cut open.
#[derive(Debug, Default)]
pub(crate) struct Caps {
    /// Meshes of the parts, once somebody needs them.
    cutter: Option<Arc<Cutter>>,
    making: Option<Job<Option<Cutter>>>,
    planes: [PlaneCaps; MOST_SECTIONS],
    /// Counts how often they changed.
    pub changes: u64,
}

/// What closes the cut of one plane.
#[derive(Debug, Default)]
struct PlaneCaps {
    job: Option<(Key, Job<Option<ScenePart>>)>,
    /// What the caps that are shown belong to.
    shown: Option<Key>,
    /// Seconds that the last ones took.
    seconds: f64,
}

/// What caps depend on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    section: Section,
    /// The document's.
    arrangement: u64,
}

/// Caps that take less are made in the frame that needs them.
const AT_ONCE_S: f64 = 0.02;

/// Brings the caps of `document` up to date with the sections.
///
/// # Errors
/// What the device refuses.
pub(crate) fn update_caps(
    context: &egui::Context,
    document: &mut Document,
    sections: [Option<Section>; MOST_SECTIONS],
) -> Result<(), RenderError> {
    for (k, section) in sections.into_iter().enumerate() {
        let is_change = find_caps(context, document, k, section)?;
        document.caps.changes += u64::from(is_change);
    }
    Ok(())
}

/// The same for one plane; whether its caps are others now.
fn find_caps(
    context: &egui::Context,
    document: &mut Document,
    k: usize,
    section: Option<Section>,
) -> Result<bool, RenderError> {
    let wanted = section.map(|section| Key { section, arrangement: document.arrangement });
    if document.caps.planes[k].shown == wanted {
        return Ok(false);
    }
    let Some(wanted) = wanted.filter(|_| document.seconds.is_some()) else {
        let is_change = document.caps.planes[k].shown.take().is_some();
        document.caps.planes[k].job = None;
        document.renderer.set_caps(k, None)?;
        return Ok(is_change);
    };
    let Some(cutter) = cutter_of(context, document) else { return Ok(false) };
    match document.caps.planes[k].job.as_ref().map(|(key, job)| (*key, job.poll())) {
        Some((key, Polled::Waiting)) if key == wanted => return Ok(false),
        Some((key, Polled::Done(caps))) if key == wanted => {
            document.caps.planes[k].job = None;
            document.caps.planes[k].shown = Some(wanted);
            document.renderer.set_caps(k, caps)?;
            return Ok(true);
        }
        // The same would fail again.
        Some((key, Polled::Failed)) if key == wanted => {
            document.caps.planes[k].job = None;
            document.caps.planes[k].shown = Some(wanted);
            return Ok(false);
        }
        _ => {}
    }
    let instances: Vec<Instance> = document
        .renderer
        .scene()
        .instances
        .iter()
        .filter(|instance| instance.is_shown && instance.node.is_some())
        .cloned()
        .collect();
    let model = document.model.clone();
    let plane = wanted.section.aside(document.bounds().diagonal());
    let cut = move || {
        let instances: Vec<&Instance> = instances.iter().collect();
        cutter.caps(&model, &instances, &plane)
    };
    if document.caps.planes[k].seconds < AT_ONCE_S {
        let start = Instant::now();
        let caps = cut();
        document.caps.planes[k].seconds = start.elapsed().as_secs_f64();
        document.caps.planes[k].job = None;
        document.caps.planes[k].shown = Some(wanted);
        document.renderer.set_caps(k, caps)?;
        return Ok(true);
    }
    document.caps.planes[k].job = Some((wanted, Job::start(context, cut)));
    // Those of another plane would be wrong.
    let is_change = document.caps.planes[k].shown.take().is_some();
    document.renderer.set_caps(k, None)?;
    Ok(is_change)
}

/// The document's meshes; `None` as long as they are being made.
fn cutter_of(context: &egui::Context, document: &mut Document) -> Option<Arc<Cutter>> {
    if let Some(cutter) = &document.caps.cutter {
        return Some(cutter.clone());
    }
    match document.caps.making.as_ref().map(Job::poll) {
        None => {
            let model = document.model.clone();
            let make = move || Cutter::new(&model, |_| true, &Silent).ok();
            document.caps.making = Some(Job::start(context, make));
            None
        }
        Some(Polled::Done(Some(cutter))) => {
            document.caps.cutter = Some(Arc::new(cutter));
            document.caps.cutter.clone()
        }
        Some(_) => None,
    }
}

impl Caps {
    pub fn is_busy(&self) -> bool {
        self.planes.iter().any(|plane| plane.job.is_some())
            || (self.making.is_some() && self.cutter.is_none())
    }
}

/// What of the gizmo is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Handle {
    /// The shaft: moves the plane along its normal.
    Shaft,
    /// The tip: turns the normal.
    Tip,
}

/// The gizmo's length as a share of the view's height; how near the mouse must be, points.
const LENGTH: f64 = 0.16;
const REACH: f32 = 12.0;
/// Within so many degrees of an axis of the model, the normal is that axis.
const SNAP_DEG: f64 = 4.0;

/// The gizmo as it is drawn.
struct Drawn {
    center: DVec3,
    base: Pos2,
    tip: Pos2,
    /// Millimetres from the plane to the tip.
    length_mm: f64,
}

fn drawn(cut: &Cut, bounds: Aabb, frame: &Frame) -> Option<Drawn> {
    let plane = cut.plane(bounds);
    let middle = bounds.center();
    let center = middle - plane.normal * (plane.normal.dot(middle) - plane.offset_mm);
    let depth = if frame.camera.is_parallel() { 1.0 } else { -frame.camera.to_eye(center).z };
    if depth <= 0.0 {
        return None;
    }
    let length_mm = LENGTH * f64::from(frame.size[1]) * frame.camera.pixel(frame.size[1]) * depth;
    let tip = center + plane.normal * length_mm;
    Some(Drawn { center, base: frame.at(center)?, tip: frame.at(tip)?, length_mm })
}

/// What of the gizmo is at a place of the window.
pub(crate) fn handle_at(cut: &Cut, bounds: Aabb, frame: &Frame, at: Pos2) -> Option<Handle> {
    if !cut.is_on || !cut.has_gizmo || bounds.is_empty() {
        return None;
    }
    let Drawn { base, tip, .. } = drawn(cut, bounds, frame)?;
    if at.distance(tip) <= REACH {
        return Some(Handle::Tip);
    }
    let along = tip - base;
    let share = (at - base).dot(along) / along.length_sq().max(1e-6);
    let foot = base + along * share.clamp(0.0, 1.0);
    (at.distance(foot) <= 0.6 * REACH).then_some(Handle::Shaft)
}

/// Moves the plane with the mouse.
pub(crate) fn drag(cut: &mut Cut, bounds: Aabb, frame: &Frame, handle: Handle, response: &Response) {
    let (Some(own), Some(at)) = (drawn(cut, bounds, frame), response.interact_pointer_pos()) else { return };
    match handle {
        Handle::Shaft => {
            let along = own.tip - own.base;
            // Seen end on, it cannot be moved by the mouse.
            if along.length() < 4.0 {
                return;
            }
            let share = response.drag_delta().dot(along) / along.length_sq();
            let [low, high] = cut.range(bounds);
            let offset = cut.plane(bounds).offset_mm + f64::from(share) * own.length_mm;
            cut.offset_mm = Some(offset.clamp(low, high));
        }
        Handle::Tip => {
            // The place of the mouse on a sphere around the middle of the plane, on the side that is seen.
            let (from, way) = frame.camera.ray(frame.pixel(at), frame.size);
            let to_middle = own.center - from;
            let near = way * to_middle.dot(way) - to_middle;
            let up = own.length_mm * own.length_mm - near.length_squared();
            let is_behind = cut.normal.dot(way) > 0.0;
            let depth = if is_behind { up.max(0.0).sqrt() } else { -up.max(0.0).sqrt() };
            let Some(normal) = (near + way * depth).try_normalize() else { return };
            let snapped = [DVec3::X, DVec3::Y, DVec3::Z]
                .into_iter()
                .flat_map(|axis| [axis, -axis])
                .find(|axis| axis.angle_between(normal).to_degrees() < SNAP_DEG);
            cut.turn(snapped.unwrap_or(normal), Some(own.center));
        }
    }
}

/// Draws the planes' outlines, and the handles of the one that is active, over the picture.
pub(crate) fn show_gizmo(ui: &Ui, cuts: &Cuts, bounds: Aabb, frame: &Frame, hovered: Option<Handle>) {
    let painter = ui.painter().with_clip_rect(frame.rect);
    let color = Color32::from_rgb(200, 70, 40);
    let bright = Color32::from_rgb(255, 120, 60);
    for cut in cuts.all.iter().filter(|cut| cut.is_on && cut.has_gizmo) {
        let corners: Vec<Pos2> = outline(cut, bounds).into_iter().filter_map(|p| frame.at(p)).collect();
        if corners.len() > 2 {
            painter.add(egui::Shape::closed_line(corners, Stroke::new(1.0, color.gamma_multiply(0.6))));
        }
    }
    let cut = cuts.active();
    if !cut.is_on || !cut.has_gizmo {
        return;
    }
    let Some(own) = drawn(cut, bounds, frame) else { return };
    let width = if hovered == Some(Handle::Shaft) { 4.0 } else { 2.5 };
    let paint = |is_hovered: bool| if is_hovered { bright } else { color };
    painter.line_segment([own.base, own.tip], Stroke::new(width, paint(hovered == Some(Handle::Shaft))));
    painter.circle_filled(own.base, 3.0, color);
    let radius = if hovered == Some(Handle::Tip) { 8.0 } else { 6.0 };
    painter.circle(own.tip, radius, paint(hovered == Some(Handle::Tip)), Stroke::new(1.0, Color32::WHITE));
}

/// The corners of the polygon in which the plane cuts the model's box, in order.
fn outline(cut: &Cut, bounds: Aabb) -> Vec<DVec3> {
    let plane = cut.plane(bounds);
    let corners = bounds.corners();
    let off = corners.map(|corner| plane.normal.dot(corner) - plane.offset_mm);
    let mut places = Vec::new();
    for (a, b) in (0..8).flat_map(|a| (a + 1..8).map(move |b| (a, b))) {
        let differing = (0..3).filter(|&k| corners[a][k] != corners[b][k]).count();
        if differing == 1 && (off[a] > 0.0) != (off[b] > 0.0) {
            places.push(corners[a].lerp(corners[b], off[a] / (off[a] - off[b])));
        }
    }
    let middle = places.iter().sum::<DVec3>() / places.len().max(1) as f64;
    let (x, y) = plane.normal.any_orthonormal_pair();
    let angle = |p: &DVec3| {
        let flat = DVec2::new((*p - middle).dot(x), (*p - middle).dot(y));
        flat.y.atan2(flat.x)
    };
    places.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Aabb {
        Aabb { min: DVec3::ZERO, max: DVec3::splat(10.0) }
    }

    #[test]
    fn a_plane_cuts_a_box_in_a_polygon() {
        let mut cut = Cut::default();
        assert_eq!(outline(&cut, cube()).len(), 4);
        cut.turn(DVec3::ONE, None);
        let hexagon = outline(&cut, cube());
        assert_eq!(hexagon.len(), 6);
        let side = 0.5 * 10.0 * 2f64.sqrt();
        for k in 0..6 {
            assert!((hexagon[k].distance(hexagon[(k + 1) % 6]) - side).abs() < 1e-9);
        }
    }

    #[test]
    fn a_flipped_plane_is_the_same_plane() {
        let mut cut = Cut { is_on: true, offset_mm: Some(3.0), ..Cut::default() };
        let before = cut.section(cube()).expect("on");
        cut.flip(cube());
        let after = cut.section(cube()).expect("on");
        assert_eq!((before.normal, before.offset_mm), (-after.normal, -after.offset_mm));
        assert_eq!(cut.range(cube()), [-10.0, 0.0]);
    }

    #[test]
    fn turning_keeps_the_place_that_it_is_told() {
        let mut cut = Cut::default();
        let place = DVec3::new(1.0, 2.0, 3.0);
        cut.turn(DVec3::new(0.0, 0.0, 2.0), Some(place));
        assert_eq!(cut.plane(cube()).offset_mm, 3.0);
        assert_eq!(cut.normal, DVec3::Z);
    }
}
