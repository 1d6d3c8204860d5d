//! The cube in the corner: shows from where the model is seen, and turns it.

use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2};
use glam::{DVec2, DVec3};
use trimloop_render::{Direction, Up};

/// Points of the cube's side, and from the corner to its middle.
const SIDE: f32 = 46.0;
const MARGIN: f32 = 62.0;
/// The share of a face's side that belongs to an edge or a corner.
const RIM: f64 = 0.24;

/// What was done to the cube.
pub(crate) enum Turned {
    /// A face, an edge or a corner was clicked.
    To(Direction),
    /// It was dragged, points.
    By(DVec2),
}

/// Draws the cube at the right upper corner of `rect`.
pub(crate) fn show(ui: &mut Ui, rect: Rect, direction: Direction, up: Up) -> Option<Turned> {
    let middle = Pos2::new(rect.right() - MARGIN, rect.top() + MARGIN);
    let area = Rect::from_center_size(middle, Vec2::splat(1.8 * SIDE));
    if !rect.contains_rect(area) {
        return None;
    }
    let response = ui.interact(area, ui.scope_id().with("view cube"), Sense::click_and_drag());
    let axes = direction.axes(up);
    let place = |p: DVec3| middle + SIDE * 0.5 * Vec2::new(p.dot(axes[0]) as f32, -p.dot(axes[1]) as f32);
    let painter = ui.painter().with_clip_rect(rect);
    let hovered = response.hover_pos().and_then(|at| {
        let off = (at - middle) / (0.5 * SIDE);
        region(DVec2::new(f64::from(off.x), f64::from(-off.y)), axes)
    });
    for (normal, name) in faces(up) {
        let facing = normal.dot(axes[2]);
        if facing < 0.02 {
            continue;
        }
        let (a, b) = sides(normal);
        let quad = [a + b, b - a, -a - b, a - b].map(|off| place(normal + off)).to_vec();
        let light = 190 + (50.0 * facing) as u8;
        let fill = Color32::from_rgba_unmultiplied(light, light, light.saturating_add(8), 225);
        painter.add(Shape::convex_polygon(quad, fill, Stroke::new(1.0, Color32::from_gray(90))));
        if facing > 0.35 {
            let font = FontId::proportional(11.0);
            painter.text(place(normal), Align2::CENTER_CENTER, name, font, Color32::from_gray(50));
        }
    }
    if let Some(towards) = hovered {
        let at = place(towards);
        painter.circle(at, 6.0, Color32::from_rgb(255, 140, 60).gamma_multiply(0.8), Stroke::NONE);
    }
    let corner = DVec3::splat(-1.0);
    for (axis, name, color) in [
        (DVec3::X, "x", Color32::from_rgb(200, 50, 50)),
        (DVec3::Y, "y", Color32::from_rgb(40, 140, 40)),
        (DVec3::Z, "z", Color32::from_rgb(50, 80, 210)),
    ] {
        let tip = corner + 2.6 * axis;
        painter.line_segment([place(corner), place(tip)], Stroke::new(1.5, color));
        let font = FontId::proportional(11.0);
        painter.text(place(corner + 2.95 * axis), Align2::CENTER_CENTER, name, font, color);
    }
    let response = response.on_hover_text("click a side, an edge or a corner; drag to turn");
    if response.dragged() {
        let by = response.drag_delta();
        return Some(Turned::By(DVec2::new(f64::from(by.x), f64::from(by.y))));
    }
    if response.clicked() {
        return Some(Turned::To(Direction::towards(hovered?, up)?));
    }
    None
}

/// The cube's sides: outward normals in the model's coordinates, and their names.
fn faces(up: Up) -> [(DVec3, &'static str); 6] {
    ["front", "back", "left", "right", "top", "bottom"].map(|name| {
        let normal = Direction::named(name).unwrap_or(Direction::ISO).axes(up)[2];
        // Without what sines and cosines leave over.
        (normal.round(), name)
    })
}

/// Two directions in a side of the cube.
fn sides(normal: DVec3) -> (DVec3, DVec3) {
    let a = if normal.x.abs() > 0.5 { DVec3::Y } else { DVec3::X };
    (a, normal.cross(a))
}

/// What of the cube is at a place, in halves of its side to the right and up: the middle of a side, of an edge, or a corner.
fn region(at: DVec2, axes: [DVec3; 3]) -> Option<DVec3> {
    for normal in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z] {
        if normal.dot(axes[2]) < 0.02 {
            continue;
        }
        let (a, b) = sides(normal);
        let flat = |p: DVec3| DVec2::new(p.dot(axes[0]), p.dot(axes[1]));
        let (a2, b2, off) = (flat(a), flat(b), at - flat(normal));
        let determinant = a2.perp_dot(b2);
        if determinant.abs() < 1e-6 {
            continue;
        }
        let (s, t) = (off.perp_dot(b2) / determinant, a2.perp_dot(off) / determinant);
        if s.abs() > 1.0 || t.abs() > 1.0 {
            continue;
        }
        let step = |x: f64| if x.abs() > 1.0 - 2.0 * RIM { x.signum() } else { 0.0 };
        return Some(normal + a * step(s) + b * step(t));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_the_cube_is_the_side_that_is_seen() {
        for name in ["front", "back", "left", "right", "top", "bottom"] {
            let direction = Direction::named(name).expect("a view");
            for up in [Up::Y, Up::Z] {
                let axes = direction.axes(up);
                let towards = region(DVec2::ZERO, axes).expect("a side");
                assert!(towards.distance(axes[2]) < 1e-9, "{name}");
                let found = Direction::towards(towards, up).expect("a direction");
                assert!(found.axes(up)[2].distance(axes[2]) < 1e-9);
                // Its corner is a corner of the cube.
                let corner = region(DVec2::new(0.95, 0.95), axes).expect("a corner");
                assert!((corner.length_squared() - 3.0).abs() < 1e-9, "{corner}");
                assert!(corner.dot(axes[0]) > 0.9 && corner.dot(axes[1]) > 0.9);
            }
        }
    }

    #[test]
    fn seen_from_a_corner_three_sides_meet() {
        let axes = Direction::ISO.axes(Up::Z);
        let middle = region(DVec2::new(0.0, 0.01), axes).expect("a corner");
        assert!(middle.normalize().distance(axes[2]) < 1e-9, "{middle}");
        assert_eq!(region(DVec2::new(1.6, 0.0), axes), None);
    }
}
