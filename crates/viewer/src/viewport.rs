//! The part of the window that shows the model.

use egui::{PointerButton, Response, Sense, Ui, Vec2};
use egui_wgpu::RenderState;
use glam::DVec2;
use trimloop_render::{Highlight, Look, RenderError};

use crate::document::Document;
use crate::navigation::{Drag, Held, Navigation, Style};

/// The picture of the model, and what it was drawn for.
#[derive(Default)]
pub(crate) struct Viewport {
    texture: Option<(wgpu::Texture, egui::TextureId)>,
    drawn: Option<Drawn>,
    /// What the mouse has been pressed for.
    drag: Option<Drag>,
}

/// What a picture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn {
    view: Navigation,
    look: Look,
    size: [u32; 2],
    selection: Option<Highlight>,
    /// Counts what else changed.
    revision: u64,
}

/// What is shown, and how.
pub(crate) struct Shown<'a> {
    pub document: &'a mut Document,
    pub view: &'a mut Navigation,
    pub look: &'a Look,
    pub style: Style,
    pub revision: u64,
}

/// What happened in the view.
#[derive(Default)]
pub(crate) struct Outcome {
    /// A drag or a turn of the wheel began: what came before can be returned to.
    pub began: Option<Navigation>,
    /// Something was clicked.
    pub clicked: bool,
    pub error: Option<RenderError>,
}

/// What one notch of the wheel is worth.
const ZOOM_PER_POINT: f64 = 0.0025;

impl Viewport {
    /// Draws the model into what is left of `ui`, and follows the mouse.
    pub fn show(&mut self, ui: &mut Ui, state: &RenderState, shown: Shown<'_>) -> Outcome {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let Shown { document, view, look, style, revision } = shown;
        let mut outcome = Outcome::default();
        self.navigate(ui, &response, view, style, &mut outcome);
        let scale = ui.ctx().pixels_per_point();
        let size = [rect.width(), rect.height()].map(|n| (n * scale).round().clamp(1.0, 8192.0) as u32);
        if response.clicked_by(PointerButton::Primary)
            && let Some(at) = response.interact_pointer_pos()
        {
            let at = ((at - rect.min) * scale).max(Vec2::ZERO);
            outcome.clicked = true;
            match document.renderer.pick(&view.camera(), size, look, [at.x as u32, at.y as u32]) {
                Ok(place) => {
                    document.select(place.map(|p| Highlight { instance: p.instance, face: Some(p.face) }));
                    document.place = place;
                }
                Err(error) => outcome.error = Some(error),
            }
        }
        let wanted = Drawn { view: *view, look: *look, size, selection: document.selection, revision };
        if self.drawn != Some(wanted) {
            match document.renderer.paint(&view.camera(), size, look) {
                Ok(texture) => {
                    self.register(state, texture);
                    self.drawn = Some(wanted);
                }
                Err(error) => outcome.error = Some(error),
            }
        }
        if let Some((_, id)) = &self.texture {
            let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
            ui.painter().image(*id, rect, whole, egui::Color32::WHITE);
        }
        outcome
    }

    /// Draws again even if nothing that is known of changed.
    pub fn invalidate(&mut self) {
        self.drawn = None;
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

    fn navigate(
        &mut self,
        ui: &Ui,
        response: &Response,
        view: &mut Navigation,
        style: Style,
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
            let drag = style.drag(held);
            if drag.is_some() && self.drag.is_none() {
                outcome.began = Some(before);
            }
            self.drag = drag;
            let by = response.drag_delta();
            let by = DVec2::new(f64::from(by.x), f64::from(by.y));
            match drag {
                Some(Drag::Turn) => view.turn(by),
                Some(Drag::Move) => view.shift(by, height),
                Some(Drag::Zoom) => view.zoom((0.01 * by.y).exp(), DVec2::ZERO, height),
                None => {}
            }
        } else {
            self.drag = None;
        }
        if response.hovered() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
            let factor = (-ZOOM_PER_POINT * f64::from(scroll)).exp() / f64::from(pinch);
            if (factor - 1.0).abs() > 1e-9
                && let Some(at) = ui.input(|input| input.pointer.hover_pos())
            {
                let off = at - middle;
                view.zoom(factor, DVec2::new(f64::from(off.x), f64::from(off.y)), height);
            }
        }
    }
}
