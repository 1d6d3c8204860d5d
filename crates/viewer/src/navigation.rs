//! Moving around a model.

use glam::{DVec2, DVec3};
use trimloop_render::{Camera, Direction, Projection, Up};

/// The height of the view as an angle.
const FOV_Y_RAD: f64 = 0.5;
/// Degrees that the model turns for each point that the mouse moves.
const DEGREES_PER_POINT: f64 = 0.35;

/// Where the model is looked at from: the eye goes around a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Navigation {
    /// What the eye turns around, millimetres.
    pub target: DVec3,
    /// From the target to the eye.
    pub distance_mm: f64,
    /// From which side.
    pub direction: Direction,
    /// Which axis points up.
    pub up: Up,
    /// Parallel instead of perspective.
    pub is_parallel: bool,
}

/// What two fingers on a touchpad do; pinching always zooms, and with Shift they move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) enum TwoFingers {
    #[default]
    Turn,
    Move,
    Zoom,
}

impl TwoFingers {
    pub(crate) const ALL: [(Self, &'static str); 3] =
        [(Self::Turn, "turn"), (Self::Move, "move"), (Self::Zoom, "zoom")];
}

/// Which buttons do what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Style {
    /// Left turns, middle and right move.
    #[default]
    Trimloop,
    /// As FreeCAD's CAD style: middle moves, middle and left turn, as do Shift and right.
    FreeCad,
    /// Middle turns, Shift and middle move, Ctrl and middle zoom.
    Blender,
    /// Middle turns, Ctrl and middle move, Shift and middle zoom.
    SolidWorks,
}

/// What a drag does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drag {
    Turn,
    Move,
    Zoom,
}

/// What is held down.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Held {
    pub left: bool,
    pub middle: bool,
    pub right: bool,
    pub shift: bool,
    pub ctrl: bool,
}

impl Style {
    pub(crate) const ALL: [Self; 4] = [Self::Trimloop, Self::FreeCad, Self::Blender, Self::SolidWorks];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Trimloop => "Trimloop",
            Self::FreeCad => "FreeCAD",
            Self::Blender => "Blender",
            Self::SolidWorks => "SolidWorks",
        }
    }

    pub(crate) fn hint(self) -> &'static str {
        match self {
            Self::Trimloop => "left turns, right or middle moves, wheel zooms",
            Self::FreeCad => "middle moves, middle + left or Shift + right turns, wheel zooms",
            Self::Blender => "middle turns, Shift + middle moves, Ctrl + middle or wheel zooms",
            Self::SolidWorks => "middle turns, Ctrl + middle moves, Shift + middle or wheel zooms",
        }
    }

    pub(crate) fn drag(self, held: Held) -> Option<Drag> {
        let Held { left, middle, right, shift, ctrl } = held;
        match self {
            Self::Trimloop => match () {
                () if middle || right || (left && shift) => Some(Drag::Move),
                () if left && ctrl => Some(Drag::Zoom),
                () if left => Some(Drag::Turn),
                () => None,
            },
            Self::FreeCad => match () {
                () if (middle && left) || (right && shift) => Some(Drag::Turn),
                () if middle || (right && ctrl) => Some(Drag::Move),
                () => None,
            },
            Self::Blender | Self::SolidWorks if middle => {
                let (moves, zooms) = if self == Self::Blender { (shift, ctrl) } else { (ctrl, shift) };
                match () {
                    () if moves => Some(Drag::Move),
                    () if zooms => Some(Drag::Zoom),
                    () => Some(Drag::Turn),
                }
            }
            Self::Blender | Self::SolidWorks => None,
        }
    }
}

impl Navigation {
    /// The standard view of nothing yet.
    pub fn new(up: Up) -> Self {
        Self { target: DVec3::ZERO, distance_mm: 1000.0, direction: Direction::ISO, up, is_parallel: false }
    }

    /// The camera of this view.
    pub fn camera(&self) -> Camera {
        let axes = self.direction.axes(self.up);
        let height_mm = 2.0 * (0.5 * FOV_Y_RAD).tan() * self.distance_mm;
        let (projection, back) = match self.is_parallel {
            // Far enough for anything to be in front.
            true => (Projection::Parallel { height_mm }, 1e3 * self.distance_mm),
            false => (Projection::Perspective { fov_y_rad: FOV_Y_RAD }, self.distance_mm),
        };
        Camera { eye: self.target + axes[2] * back, axes, projection }
    }

    /// Looks at all of `points` from the present side; nothing happens without points.
    pub fn fit(&mut self, points: &[DVec3], aspect: f64) {
        let projection = match self.is_parallel {
            true => Projection::Parallel { height_mm: 1.0 },
            false => Projection::Perspective { fov_y_rad: FOV_Y_RAD },
        };
        let Some(camera) = Camera::fit(points, self.direction, self.up, projection, aspect) else { return };
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let back = camera.axes[2];
        self.distance_mm = match camera.projection {
            Projection::Parallel { height_mm } => 0.5 * height_mm / (0.5 * FOV_Y_RAD).tan(),
            Projection::Perspective { .. } => (camera.eye - middle).dot(back),
        };
        self.target = camera.eye - back * (camera.eye - middle).dot(back);
    }

    /// Turns by as much as the mouse moved, points.
    pub(crate) fn turn(&mut self, by: DVec2) {
        let Direction { azimuth_deg, elevation_deg } = self.direction;
        self.direction = Direction {
            azimuth_deg: (azimuth_deg - by.x * DEGREES_PER_POINT).rem_euclid(360.0),
            elevation_deg: (elevation_deg + by.y * DEGREES_PER_POINT).clamp(-90.0, 90.0),
        };
    }

    /// The same around a place of the model, which stays where it is seen.
    pub(crate) fn turn_around(&mut self, by: DVec2, pivot: DVec3) {
        let before = self.direction.axes(self.up);
        self.turn(by);
        let after = self.direction.axes(self.up);
        let off = self.target - pivot;
        self.target = pivot + (0..3).map(|k| after[k] * off.dot(before[k])).sum::<DVec3>();
    }

    /// Millimetres of a point of a view of `height` points, at the target.
    fn point_mm(&self, height: f64) -> f64 {
        2.0 * (0.5 * FOV_Y_RAD).tan() * self.distance_mm / height.max(1.0)
    }

    /// Moves the model with the mouse, which moved by so many points in a view that is `height` points high.
    pub(crate) fn shift(&mut self, by: DVec2, height: f64) {
        let [right, up, _] = self.direction.axes(self.up);
        self.target -= (right * by.x - up * by.y) * self.point_mm(height);
    }

    /// Goes nearer (`factor` below 1) or away, so that what is under the mouse stays there. `off` is the mouse's place from
    /// the middle of the view, to the right and down, points.
    pub(crate) fn zoom(&mut self, factor: f64, off: DVec2, height: f64) {
        let [right, up, _] = self.direction.axes(self.up);
        let under = self.target + (right * off.x - up * off.y) * self.point_mm(height);
        self.zoom_to(under, factor);
    }

    /// Likewise towards a point.
    pub(crate) fn zoom_to(&mut self, point: DVec3, factor: f64) {
        let factor = factor.clamp(0.1, 10.0);
        let distance_mm = self.distance_mm * factor;
        if (1e-9..1e12).contains(&distance_mm) {
            self.target += (point - self.target) * (1.0 - factor);
            self.distance_mm = distance_mm;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [800, 600];

    fn cube() -> Vec<DVec3> {
        let corner = |k: i32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 10.0;
        (0..8).map(corner).collect()
    }

    #[test]
    fn everything_fits_from_every_side_in_both_projections() {
        for is_parallel in [false, true] {
            for name in ["iso", "front", "top", "left"] {
                let direction = Direction::named(name).expect("a view");
                let mut view = Navigation { direction, is_parallel, ..Navigation::new(Up::Z) };
                view.fit(&cube(), 800.0 / 600.0);
                for corner in cube() {
                    let at = view.camera().project(corner, SIZE).expect("in front");
                    assert!(at.x > 0.0 && at.y > 0.0 && at.x < 800.0 && at.y < 600.0, "{name} {at}");
                }
            }
        }
    }

    #[test]
    fn what_is_under_the_mouse_stays_there() {
        for is_parallel in [false, true] {
            let mut view = Navigation { is_parallel, ..Navigation::new(Up::Z) };
            view.fit(&cube(), 800.0 / 600.0);
            let point = DVec3::new(10.0, 0.0, 10.0);
            let before = view.camera().project(point, SIZE).expect("in front");
            view.zoom_to(point, 0.3);
            let after = view.camera().project(point, SIZE).expect("in front");
            assert!(before.distance(after) < 1e-6, "{before} {after}");
            let target = view.camera().project(view.target, SIZE).expect("in front");
            view.shift(DVec2::new(30.0, -20.0), 600.0);
            let moved = view.camera().project(view.target, SIZE).expect("in front");
            assert!(target.distance(moved) < 1e-6);
        }
    }

    #[test]
    fn the_place_that_is_turned_around_stays_where_it_is_seen() {
        for is_parallel in [false, true] {
            let mut view = Navigation { is_parallel, ..Navigation::new(Up::Z) };
            view.fit(&cube(), 800.0 / 600.0);
            let pivot = DVec3::new(10.0, 0.0, 10.0);
            let before = view.camera().project(pivot, SIZE).expect("in front");
            view.turn_around(DVec2::new(70.0, -40.0), pivot);
            let after = view.camera().project(pivot, SIZE).expect("in front");
            assert!(before.distance(after) < 1e-6, "{before} {after}");
        }
    }

    #[test]
    fn a_turn_around_comes_back() {
        let mut view = Navigation::new(Up::Y);
        let before = view;
        view.turn(DVec2::new(360.0 / DEGREES_PER_POINT, 0.0));
        assert!((view.direction.azimuth_deg - before.direction.azimuth_deg).abs() < 1e-9);
        view.turn(DVec2::new(0.0, 1e6));
        assert_eq!(view.direction.elevation_deg, 90.0);
    }

    #[test]
    fn styles_differ_in_what_buttons_do() {
        let left = Held { left: true, ..Held::default() };
        let middle = Held { middle: true, ..Held::default() };
        assert_eq!(Style::Trimloop.drag(left), Some(Drag::Turn));
        assert_eq!(Style::Blender.drag(left), None);
        assert_eq!(Style::Blender.drag(Held { shift: true, ..middle }), Some(Drag::Move));
        assert_eq!(Style::SolidWorks.drag(Held { shift: true, ..middle }), Some(Drag::Zoom));
        assert_eq!(Style::FreeCad.drag(middle), Some(Drag::Move));
        assert_eq!(Style::FreeCad.drag(Held { left: true, ..middle }), Some(Drag::Turn));
    }
}
