//! How the model is shown: shaded, as edges, transparent; and what its colours tell.

use egui::{Align2, Color32, FontId, Rect, Stroke, StrokeKind, Ui, Vec2};
use trimloop_render::{EdgeStyle, Look, Paint};

use crate::document::Document;
use crate::measure::number;

/// How faces and edges are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Mode {
    #[default]
    ShadedWithEdges,
    Shaded,
    HiddenEdges,
    Edges,
    Transparent,
}

/// What colours tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Colors {
    #[default]
    Own,
    Parts,
    Kinds,
    Curvature,
    /// The distance from a reference.
    Deviation,
}

/// How the model is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Display {
    pub mode: Mode,
    pub colors: Colors,
    /// The radius of curvature that is red; a share of the model's size as long as nobody chose it.
    pub tightest_mm: Option<f64>,
}

impl Mode {
    pub const ALL: [(Self, &'static str); 5] = [
        (Self::ShadedWithEdges, "shaded, with edges"),
        (Self::Shaded, "shaded"),
        (Self::HiddenEdges, "with hidden edges"),
        (Self::Edges, "edges alone"),
        (Self::Transparent, "transparent"),
    ];

    pub fn next(self) -> Self {
        let place = Self::ALL.iter().position(|(own, _)| *own == self).unwrap_or(0);
        Self::ALL[(place + 1) % Self::ALL.len()].0
    }
}

impl Colors {
    pub const ALL: [(Self, &'static str); 5] = [
        (Self::Own, "as in the file"),
        (Self::Parts, "by part"),
        (Self::Kinds, "by kind of surface"),
        (Self::Curvature, "by curvature"),
        (Self::Deviation, "by distance from a reference"),
    ];
}

/// The opacity of transparent faces.
const CLEAR: f32 = 0.35;
/// The radius that is red as long as nobody chose one: this share of the model's size.
const TIGHTEST: f64 = 0.02;

impl Display {
    pub fn apply(&self, look: &mut Look, size_mm: f64) {
        look.edges = match self.mode {
            Mode::ShadedWithEdges | Mode::Edges | Mode::Transparent => EdgeStyle::Visible,
            Mode::Shaded => EdgeStyle::None,
            Mode::HiddenEdges => EdgeStyle::Hidden,
        };
        look.has_faces = self.mode != Mode::Edges;
        look.opacity = if self.mode == Mode::Transparent { CLEAR } else { 1.0 };
        look.paint = match self.colors {
            Colors::Own | Colors::Deviation => Paint::Own,
            Colors::Parts => Paint::Parts,
            Colors::Kinds => Paint::Kinds,
            Colors::Curvature => Paint::Curvature { tightest_mm: self.tightest(size_mm) },
        };
    }

    /// The radius of curvature that is red.
    pub fn tightest(&self, size_mm: f64) -> f64 {
        self.tightest_mm.unwrap_or(TIGHTEST * size_mm).max(1e-9)
    }
}

/// What colours mean, at the right lower corner of the picture.
pub(crate) fn legend(ui: &Ui, rect: Rect, display: &Display, document: &Document, size_mm: f64) {
    match display.colors {
        Colors::Own | Colors::Parts => {}
        Colors::Kinds => {
            let mut kinds: Vec<&str> = Vec::new();
            for face in document.renderer.scene().parts.iter().flat_map(|part| &part.faces) {
                let kind = face.surface_kind();
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
            }
            kinds.sort_unstable();
            let entries: Vec<(Color32, String)> =
                kinds.into_iter().map(|kind| (color_of(Paint::of_kind(kind)), kind.to_owned())).collect();
            swatches(ui, rect, &entries);
        }
        Colors::Curvature => {
            let tightest = display.tightest(size_mm);
            let texts = [
                "flat".to_owned(),
                format!("R {} mm", number(round(2.0 * tightest))),
                format!("R {} mm", number(round(tightest))),
            ];
            scale(ui, rect, &texts, ramp);
        }
        Colors::Deviation => {
            let Some(deviation) = &document.deviation else { return };
            let most = deviation.most_mm;
            let texts = ["0".to_owned(), format!("{} mm", short(0.5 * most)), format!("{} mm", short(most))];
            scale(ui, rect, &texts, |share| {
                let [r, g, b] = trimloop_compare::heat(f64::from(share));
                Color32::from_rgb(r, g, b)
            });
        }
    }
}

fn color_of(color: trimloop_brep::Rgba) -> Color32 {
    let [r, g, b] = [color.r, color.g, color.b].map(|c| (c * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

/// As in `shaders/surface.wgsl`.
fn ramp(share: f32) -> Color32 {
    let x = 4.0 * share.clamp(0.0, 1.0);
    let c = |k: f32| k.clamp(0.0, 1.0);
    let rgb = [c(x - 2.0), c(x) - c(x - 3.0), 1.0 - c(x - 1.0)];
    let light = rgb.map(|c| 0.05 + 0.75 * c);
    let encoded = light.map(|c| (255.0 * (1.055 * c.powf(1.0 / 2.4) - 0.055)).round() as u8);
    Color32::from_rgb(encoded[0], encoded[1], encoded[2])
}

/// Three digits that count.
fn round(value: f64) -> f64 {
    let digits = 10f64.powf(2.0 - value.abs().max(1e-12).log10().floor());
    (value * digits).round() / digits
}

/// Short also where there are only zeros behind the point.
pub(crate) fn short(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:.2e}") } else { number(round(value)) }
}

fn swatches(ui: &Ui, rect: Rect, entries: &[(Color32, String)]) {
    let painter = ui.painter().with_clip_rect(rect);
    let row = 18.0;
    let size = Vec2::new(110.0, row * entries.len() as f32 + 10.0);
    let area = Rect::from_min_size(rect.right_bottom() - size - Vec2::splat(10.0), size);
    frame(ui, area);
    for (k, (color, text)) in entries.iter().enumerate() {
        let at = area.min + Vec2::new(8.0, 5.0 + row * k as f32);
        painter.rect_filled(Rect::from_min_size(at + Vec2::new(0.0, 3.0), Vec2::splat(12.0)), 2.0, *color);
        let font = FontId::proportional(12.0);
        painter.text(at + Vec2::new(20.0, 9.0), Align2::LEFT_CENTER, text, font, ui.visuals().text_color());
    }
}

/// A scale from the lower end, with texts at its ends and in its middle.
fn scale(ui: &Ui, rect: Rect, texts: &[String; 3], color: impl Fn(f32) -> Color32) {
    let painter = ui.painter().with_clip_rect(rect);
    let size = Vec2::new(120.0, 176.0);
    let area = Rect::from_min_size(rect.right_bottom() - size - Vec2::splat(10.0), size);
    frame(ui, area);
    let bar = Rect::from_min_size(area.min + Vec2::new(8.0, 8.0), Vec2::new(16.0, 160.0));
    let steps = 64;
    for k in 0..steps {
        let share = (k as f32 + 0.5) / steps as f32;
        let top = bar.bottom() - bar.height() * (k + 1) as f32 / steps as f32;
        let own = Rect::from_min_size(
            egui::pos2(bar.left(), top),
            Vec2::new(bar.width(), bar.height() / steps as f32 + 0.5),
        );
        painter.rect_filled(own, 0.0, color(share));
    }
    let ends = [(0, bar.bottom() - 5.0), (1, bar.center().y), (2, bar.top() + 5.0)];
    for (k, y) in ends {
        let at = egui::pos2(bar.right() + 8.0, y);
        let font = FontId::proportional(12.0);
        painter.text(at, Align2::LEFT_CENTER, &texts[k], font, ui.visuals().text_color());
    }
}

fn frame(ui: &Ui, area: Rect) {
    let visuals = ui.visuals();
    let fill = visuals.panel_fill.gamma_multiply(0.85);
    let stroke = Stroke::new(1.0, visuals.weak_text_color());
    ui.painter().rect(area, 4.0, fill, stroke, StrokeKind::Inside);
}
