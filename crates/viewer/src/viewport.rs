//! The part of the window that shows the model: its picture, what lies over it, and what the mouse does there.

use std::time::{Duration, Instant};

use egui::{Align2, Color32, FontId, PointerButton, Pos2, Response, Sense, Stroke, Ui, Vec2};
use egui_wgpu::RenderState;
use glam::{DVec2, DVec3};
use trimloop_geom::Aabb;
use trimloop_measure::Feature;
use trimloop_render::{FrameStatistics, Identified, Look, MOST_SECTIONS, Pending, RenderError, Section};

use crate::document::{Document, Picked};
use crate::measure::Measured;
use crate::navigation::{Drag, Held, Navigation, Style, TwoFingers};
use crate::pick::{self, Filter, Frame};
use crate::section::{self, Cut, Cuts, Handle};
use crate::view_cube::{self, Turned};

/// The picture of the model, and what it was drawn for.
#[derive(Default)]
pub(crate) struct Viewport {
    texture: Option<(wgpu::Texture, egui::TextureId)>,
    drawn: Option<Drawn>,
    drawn_at: Option<Instant>,
    /// Seconds that it took to have the picture drawn.
    paint_s: f64,
    /// What the mouse has been pressed for.
    drag: Option<Drag>,
    handle: Option<Handle>,
    /// Whether it was two fingers that scrolled last, not a wheel.
    is_touchpad: bool,
    /// The place of the model that it turns around.
    pivot: Option<DVec3>,
    /// Where the mouse is while it zooms, when last, and the place of the model there.
    zoom: Option<(Pos2, Instant, Option<DVec3>)>,
    /// What the pixels show.
    seen: Seen,
    pub hovered: Option<Picked>,
    /// The picture as it was shown last.
    pub frame: Option<Frame>,
    /// What it took.
    pub statistics: FrameStatistics,
}

/// What is known of the pixels.
#[derive(Default)]
enum Seen {
    #[default]
    Unknown,
    Pending(Pending),
    Known(Identified),
}

/// What a picture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn {
    document: u64,
    view: Navigation,
    look: Look,
    size: [u32; 2],
    is_deviation: bool,
    /// Counts of changes: of what is where, of what closes sections, of anything else.
    arrangement: u64,
    caps: u64,
    revision: u64,
}

/// What is shown, and how.
pub(crate) struct Shown<'a> {
    pub document: &'a mut Document,
    pub view: &'a mut Navigation,
    pub cuts: &'a mut Cuts,
    pub bounds: Aabb,
    pub look: &'a Look,
    /// Coloured by the distance from the reference.
    pub is_deviation: bool,
    pub controls: Controls,
}

/// What mouse and keys mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controls {
    pub style: Style,
    pub two_fingers: TwoFingers,
    pub filter: Filter,
    pub has_cube: bool,
}

/// What happened in the view.
#[derive(Default)]
pub(crate) struct Outcome {
    /// A drag or a turn of the wheel began: what came before can be returned to.
    pub began: Option<Navigation>,
    /// Something was double-clicked: it is to be in the middle.
    pub centered: Option<DVec3>,
    pub error: Option<RenderError>,
}

/// The mouse may move so far, points, and rest so long while it zooms to one place.
const ZOOM_REACH: f32 = 4.0;
const ZOOM_LASTS: Duration = Duration::from_millis(1500);
/// What one notch of the wheel is worth.
const ZOOM_PER_POINT: f64 = 0.0025;
/// What the mouse may hover over is found out when the view is at rest for so long.
const REST: Duration = Duration::from_millis(60);
/// What a picture needs more time to evaluate for comes in several frames. Where the device is a program, which takes as long
/// for each of them, they are fewer.
const BUDGET: Duration = Duration::from_millis(25);
const SOFTWARE_BUDGET: Duration = Duration::from_millis(120);
/// While parts arrive, the picture is drawn no more often than this.
const PATIENCE_S: f64 = 0.15;

type Sections = [Option<Section>; MOST_SECTIONS];

const HOVERED: Color32 = Color32::from_rgb(20, 120, 230);
const SELECTED: Color32 = Color32::from_rgb(240, 110, 20);
const KEPT: Color32 = Color32::from_rgb(120, 60, 170);

impl Viewport {
    /// Draws the model into what is left of `ui`, and follows the mouse.
    pub fn show(&mut self, ui: &mut Ui, state: &RenderState, shown: Shown<'_>) -> Outcome {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let Shown { document, view, cuts, bounds, look, is_deviation, controls } = shown;
        let mut outcome = Outcome::default();
        let scale = ui.ctx().pixels_per_point();
        let size = [rect.width(), rect.height()].map(|n| (n * scale).round().clamp(1.0, 8192.0) as u32);
        let before = Frame { camera: view.camera(), size, rect };
        let hovered_handle =
            response.hover_pos().and_then(|at| section::handle_at(cuts.active(), bounds, &before, at));
        if !self.hold_gizmo(ui, &response, cuts.active_mut(), bounds, &before, hovered_handle) {
            self.navigate(ui, &response, document, view, controls, &mut outcome);
        }
        let frame = Frame { camera: view.camera(), size, rect };
        self.frame = Some(frame);
        let wanted = Drawn {
            document: document.id,
            view: *view,
            look: *look,
            size,
            is_deviation,
            arrangement: document.arrangement,
            caps: document.caps.changes,
            revision: document.revision,
        };
        if let Err(error) = self.paint(ui, state, document, &frame, wanted) {
            outcome.error = Some(error);
        }
        if let Some((_, id)) = &self.texture {
            let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
            ui.painter().image(*id, rect, whole, Color32::WHITE);
        }
        if let Err(error) = self.find_out(ui, document, &frame, look) {
            outcome.error = Some(error);
        }
        self.hover(document, &frame, &response, controls.filter, hovered_handle.is_some());
        match self.clicked(document, &frame, &response, look, controls.filter) {
            // What is clicked twice is to be in the middle.
            Ok(Some(picked)) if response.double_clicked() => {
                outcome.centered = picked.and_then(|picked| Some(picked.place?.point));
            }
            Ok(Some(picked)) => {
                let is_added = ui.input(|input| input.modifiers.shift || input.modifiers.command);
                document.select(picked, is_added);
                ui.ctx().request_repaint();
            }
            Ok(None) => {}
            Err(error) => outcome.error = Some(error),
        }
        self.overlay(ui, document, &frame, &look.sections);
        if !bounds.is_empty() {
            section::show_gizmo(ui, cuts, bounds, &frame, self.handle.or(hovered_handle));
        }
        if controls.has_cube {
            match view_cube::show(ui, rect, view.direction, view.up) {
                Some(Turned::To(direction)) => {
                    outcome.began = Some(*view);
                    view.direction = direction;
                }
                Some(Turned::By(by)) => view.turn(by),
                None => {}
            }
        }
        outcome
    }

    /// Draws again even if nothing that is known of changed.
    pub fn invalidate(&mut self) {
        self.drawn = None;
    }

    /// Whether something is still being found out about the picture.
    pub fn is_busy(&self) -> bool {
        matches!(self.seen, Seen::Pending(_))
    }

    /// Forgets what belongs to the device.
    fn paint(
        &mut self,
        ui: &Ui,
        state: &RenderState,
        document: &mut Document,
        frame: &Frame,
        wanted: Drawn,
    ) -> Result<(), RenderError> {
        if self.drawn == Some(wanted) {
            return Ok(());
        }
        // While parts arrive, most of the time is theirs.
        let is_arrival = self.drawn.is_some_and(|own| {
            let Drawn { revision, arrangement, .. } = wanted;
            Drawn { revision, arrangement, ..own } == wanted && document.seconds.is_none()
        });
        let since = self.drawn_at.map_or(f64::INFINITY, |at| at.elapsed().as_secs_f64());
        if is_arrival && since < PATIENCE_S.max(3.0 * self.paint_s) {
            ui.ctx().request_repaint_after(Duration::from_millis(50));
            return Ok(());
        }
        let start = Instant::now();
        let renderer = match &mut document.deviation {
            Some(deviation) if wanted.is_deviation => {
                deviation.update()?;
                &mut deviation.renderer
            }
            _ => &mut document.renderer,
        };
        // Colours change nothing about what lies where.
        let is_same = |own: Drawn| Drawn { revision: wanted.revision, ..own } == wanted;
        if !self.drawn.is_some_and(is_same) {
            self.seen = Seen::Unknown;
        }
        // What failed once would fail again, frame by frame.
        self.drawn = Some(wanted);
        self.drawn_at = Some(start);
        let is_software = state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let budget = if is_software { SOFTWARE_BUDGET } else { BUDGET };
        let texture = renderer.paint(&frame.camera, wanted.size, &wanted.look, budget)?;
        self.paint_s = start.elapsed().as_secs_f64();
        self.statistics = renderer.statistics();
        if !self.statistics.is_complete {
            // The rest comes with the next frames.
            self.drawn = None;
            ui.ctx().request_repaint();
        }
        self.register(state, texture);
        Ok(())
    }

    /// Makes the texture known to the window; the same one needs that once.
    fn register(&mut self, state: &RenderState, texture: wgpu::Texture) {
        if self.texture.as_ref().is_some_and(|(own, _)| *own == texture) {
            return;
        }
        let view = texture.create_view(&Default::default());
        let mut renderer = state.renderer.write();
        if let Some((_, id)) = self.texture.take() {
            renderer.free_texture(&id);
        }
        let id = renderer.register_native_texture(&state.device, &view, wgpu::FilterMode::Nearest);
        self.texture = Some((texture, id));
    }

    /// Finds out what the pixels show, as soon as the view is at rest, without waiting for it.
    fn find_out(
        &mut self,
        ui: &Ui,
        document: &mut Document,
        frame: &Frame,
        look: &Look,
    ) -> Result<(), RenderError> {
        match &mut self.seen {
            Seen::Known(_) => {}
            Seen::Unknown => {
                let rest = self.drawn_at.map_or(REST, |at| at.elapsed());
                let is_moving = self.drag.is_some() || self.handle.is_some();
                if is_moving || self.drawn.is_none() || document.seconds.is_none() {
                    return Ok(());
                }
                if rest < REST {
                    ui.ctx().request_repaint_after(REST - rest);
                    return Ok(());
                }
                let look = Look { has_faces: true, ..*look };
                self.seen = Seen::Pending(document.renderer.begin_seen(&frame.camera, frame.size, &look)?);
                ui.ctx().request_repaint_after(Duration::from_millis(10));
            }
            Seen::Pending(pending) => match document.renderer.finish_seen(pending) {
                Ok(Some(identified)) => {
                    self.seen = Seen::Known(identified);
                    ui.ctx().request_repaint();
                }
                Ok(None) => ui.ctx().request_repaint_after(Duration::from_millis(10)),
                Err(error) => {
                    self.seen = Seen::Unknown;
                    return Err(error);
                }
            },
        }
        Ok(())
    }

    fn hover(
        &mut self,
        document: &mut Document,
        frame: &Frame,
        response: &Response,
        filter: Filter,
        is_at_handle: bool,
    ) {
        self.hovered = match (&self.seen, response.hover_pos()) {
            (Seen::Known(identified), Some(at)) if !response.dragged() && !is_at_handle => {
                pick::under(document, identified, frame, at, filter)
            }
            _ => None,
        };
    }

    /// What was clicked, if something was: perhaps nothing.
    fn clicked(
        &mut self,
        document: &mut Document,
        frame: &Frame,
        response: &Response,
        look: &Look,
        filter: Filter,
    ) -> Result<Option<Option<Picked>>, RenderError> {
        let Some(at) = response.interact_pointer_pos() else { return Ok(None) };
        if !response.clicked_by(PointerButton::Primary) {
            return Ok(None);
        }
        let picked = match &self.seen {
            Seen::Known(identified) => pick::under(document, identified, frame, at, filter),
            // Not known yet: the pixels around are asked for.
            _ => {
                let look = Look { has_faces: true, ..*look };
                let [low, size] = pick::around(frame, at);
                let near = document.renderer.identify_within(&frame.camera, frame.size, &look, low, size)?;
                pick::under(document, &near, frame, at, filter)
            }
        };
        Ok(Some(picked))
    }

    /// What lies over the picture: what is hovered over, selected edges and vertices, measures.
    fn overlay(&self, ui: &Ui, document: &mut Document, frame: &Frame, sections: &Sections) {
        for picked in document.selection.clone() {
            if matches!(picked.feature, Some(Feature::Edge(_) | Feature::Vertex(_))) {
                show_feature(ui, document, frame, &picked, (SELECTED, sections));
            }
        }
        if let Some(hovered) = self.hovered {
            show_feature(ui, document, frame, &hovered, (HOVERED, sections));
        }
        for kept in &document.measure.kept {
            show_measure(ui, document, frame, kept, KEPT);
        }
        if let Some(found) = &document.measure.found {
            show_measure(ui, document, frame, found, SELECTED);
        }
    }

    /// Holds on to the section's gizmo; whether it does.
    fn hold_gizmo(
        &mut self,
        ui: &Ui,
        response: &Response,
        cut: &mut Cut,
        bounds: Aabb,
        frame: &Frame,
        hovered: Option<Handle>,
    ) -> bool {
        if response.drag_started_by(PointerButton::Primary) {
            let pressed = ui.input(|input| input.pointer.press_origin());
            self.handle = pressed.and_then(|at| section::handle_at(cut, bounds, frame, at));
        }
        if !response.dragged_by(PointerButton::Primary) {
            self.handle = None;
        }
        if let Some(handle) = self.handle {
            section::drag(cut, bounds, frame, handle, response);
        }
        if self.handle.is_some() || hovered.is_some() {
            ui.ctx().set_cursor_icon(egui::CursorIcon::Grab);
        }
        self.handle.is_some()
    }

    fn navigate(
        &mut self,
        ui: &Ui,
        response: &Response,
        document: &mut Document,
        view: &mut Navigation,
        controls: Controls,
        outcome: &mut Outcome,
    ) {
        let before = *view;
        let (height, middle) = (f64::from(response.rect.height()), response.rect.center());
        let held = ui.input(|input| Held {
            left: input.pointer.primary_down(),
            middle: input.pointer.middle_down(),
            right: input.pointer.secondary_down(),
            shift: input.modifiers.shift,
            ctrl: input.modifiers.command,
        });
        if response.dragged() {
            let drag = controls.style.drag(held);
            if drag.is_some() && self.drag.is_none() {
                outcome.began = Some(before);
                let at = ui.input(|input| input.pointer.press_origin());
                self.pivot = at.and_then(|at| self.place_at(document, at));
            }
            self.drag = drag;
            let by = response.drag_delta();
            let by = DVec2::new(f64::from(by.x), f64::from(by.y));
            match drag {
                Some(Drag::Turn) => match self.pivot {
                    Some(pivot) => view.turn_around(by, pivot),
                    None => view.turn(by),
                },
                Some(Drag::Move) => view.shift(by, height),
                Some(Drag::Zoom) => view.zoom((0.01 * by.y).exp(), DVec2::ZERO, height),
                None => {}
            }
        } else {
            self.drag = None;
        }
        if !response.contains_pointer() {
            return;
        }
        let (scroll, pinch) = ui.input(|input| {
            // Scrolling goes on for some frames after what caused it.
            if let Some(event) =
                input.events.iter().find(|event| matches!(event, egui::Event::MouseWheel { .. }))
            {
                self.is_touchpad = is_of_touchpad(event);
            }
            (input.smooth_scroll_delta, input.zoom_delta())
        });
        let mut zoom = 1.0 / f64::from(pinch);
        let by = DVec2::new(f64::from(scroll.x), f64::from(scroll.y));
        match (self.is_touchpad, controls.two_fingers) {
            _ if by == DVec2::ZERO => {}
            (true, _) if held.shift => view.shift(by, height),
            (true, TwoFingers::Turn) => view.turn(by),
            (true, TwoFingers::Move) => view.shift(by, height),
            _ => zoom *= (-ZOOM_PER_POINT * (by.y + by.x)).exp(),
        }
        if (zoom - 1.0).abs() > 1e-9
            && let Some(at) = ui.input(|input| input.pointer.hover_pos())
        {
            match self.zoomed_at(document, at) {
                (is_first, Some(point)) => {
                    outcome.began = outcome.began.or(is_first.then_some(before));
                    view.zoom_to(point, zoom);
                }
                (is_first, None) => {
                    outcome.began = outcome.began.or(is_first.then_some(before));
                    let off = at - middle;
                    view.zoom(zoom, DVec2::new(f64::from(off.x), f64::from(off.y)), height);
                }
            }
        }
    }
}

impl Viewport {
    /// The place of the model at a place of the window, if that is known.
    fn place_at(&self, document: &Document, at: Pos2) -> Option<DVec3> {
        match (&self.seen, self.frame) {
            (Seen::Known(identified), Some(frame)) => pick::place_at(document, identified, &frame, at),
            _ => None,
        }
    }

    /// The place of the model under the mouse when zooming began, and whether it begins now.
    fn zoomed_at(&mut self, document: &Document, at: Pos2) -> (bool, Option<DVec3>) {
        let now = Instant::now();
        if let Some((place, last, point)) = self.zoom
            && place.distance(at) < ZOOM_REACH
            && now - last < ZOOM_LASTS
        {
            self.zoom = Some((place, now, point));
            return (false, point);
        }
        let point = self.place_at(document, at);
        self.zoom = Some((at, now, point));
        (true, point)
    }
}

/// Whether two fingers on a touchpad did it, not a wheel.
fn is_of_touchpad(event: &egui::Event) -> bool {
    use egui::MouseWheelSource::{Momentum, Trackpad, Unknown};
    match event {
        egui::Event::MouseWheel { source: Trackpad | Momentum, .. } => true,
        egui::Event::MouseWheel { source: Unknown, unit, .. } => *unit == egui::MouseWheelUnit::Point,
        _ => false,
    }
}

/// Draws the outline of something over the picture.
fn show_feature(
    ui: &Ui,
    document: &mut Document,
    frame: &Frame,
    picked: &Picked,
    (color, sections): (Color32, &Sections),
) {
    let is_cut_away = |p: &DVec3| sections.iter().flatten().any(|s| s.normal.dot(*p) > s.offset_mm);
    let painter = ui.painter().with_clip_rect(frame.rect);
    let edges = match picked.feature {
        Some(Feature::Face(face)) => document.edges_of(picked.instance, face),
        Some(Feature::Edge(edge)) => vec![edge],
        Some(Feature::Vertex(vertex)) => {
            if let Some(at) = document.vertex(picked.instance, vertex).and_then(|p| frame.at(p)) {
                painter.circle(at, 5.0, color, Stroke::new(1.5, Color32::WHITE));
            }
            return;
        }
        None => return,
    };
    let width = if matches!(picked.feature, Some(Feature::Edge(_))) { 3.5 } else { 2.0 };
    for edge in edges {
        let line = document.line(picked.instance, edge);
        let mut run: Vec<Pos2> = Vec::new();
        let seen = |p: &DVec3| if is_cut_away(p) { None } else { frame.at(*p) };
        for at in line.iter().map(seen).chain([None]) {
            match at {
                Some(at) => run.push(at),
                // Behind the eye, or at the end.
                None if run.len() > 1 => {
                    let points = std::mem::take(&mut run);
                    painter.add(egui::Shape::line(points, Stroke::new(width, color)));
                }
                None => run.clear(),
            }
        }
    }
}

/// Draws a measure of two over the picture, or the label of one that is kept.
fn show_measure(ui: &Ui, document: &Document, frame: &Frame, measured: &Measured, color: Color32) {
    let painter = ui.painter().with_clip_rect(frame.rect);
    let moved = |k: usize, p: DVec3| {
        p + measured.subjects().get(k).map_or(DVec3::ZERO, |s| document.moved(s.picked.instance))
    };
    let at = match (measured.ends(), measured.subjects()) {
        (Some([a, b]), _) => {
            let (Some(a), Some(b)) = (frame.at(moved(0, a)), frame.at(moved(1, b))) else { return };
            painter.line_segment([a, b], Stroke::new(2.0, color));
            for end in [a, b] {
                painter.circle_filled(end, 3.5, color);
            }
            a + 0.5 * (b - a)
        }
        // What is selected alone is told in the panel.
        (None, [_]) if color == SELECTED => return,
        (None, [one]) => {
            let own = measured.facts.as_ref();
            let place = one.picked.place.map(|p| p.point);
            let point = place
                .or_else(|| own?.position.map(|p| moved(0, p)))
                .or_else(|| own?.ends.map(|[a, b]| moved(0, 0.5 * (a + b))));
            let Some(at) = point.and_then(|p| frame.at(p)) else { return };
            painter.circle_filled(at, 3.5, color);
            at + Vec2::new(0.0, -14.0)
        }
        _ => return,
    };
    let galley = painter.layout_no_wrap(measured.label(), FontId::proportional(13.0), Color32::WHITE);
    let area = Align2::CENTER_CENTER.anchor_size(at, galley.size() + Vec2::new(10.0, 4.0));
    painter.rect_filled(area, 4.0, color.gamma_multiply(0.9));
    painter.galley(area.center() - 0.5 * galley.size(), galley, Color32::WHITE);
}
