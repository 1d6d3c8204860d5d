//! Where a picture is taken from.

use glam::{DMat3, DVec2, DVec3};

/// Which axis of the model points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// +Y.
    Y,
    /// +Z, as CAD has it.
    #[default]
    Z,
}

/// How depth becomes size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Far things are smaller; the picture is this high, radians.
    Perspective {
        /// Angle between the lower and the upper border.
        fov_y_rad: f64,
    },
    /// Parallel; the picture is this high, millimetres.
    Parallel {
        /// Distance between the lower and the upper border.
        height_mm: f64,
    },
}

/// From which side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// Degrees about the upward axis, counter-clockwise seen from above; 0 is the front, 90 the right side.
    pub azimuth_deg: f64,
    /// Degrees above the horizon.
    pub elevation_deg: f64,
}

/// An eye, its axes and its projection. Millimetres, in the model's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: DVec3,
    /// Unit vectors: to the right, up, and back from the picture to the eye.
    pub axes: [DVec3; 3],
    /// The projection.
    pub projection: Projection,
}

/// The part of the plane that a picture is left empty around the model.
const MARGIN: f64 = 0.04;

impl Up {
    /// Unit vectors: to the right, to the back and up, for one who stands in front.
    fn frame(self) -> [DVec3; 3] {
        match self {
            Self::Z => [DVec3::X, DVec3::Y, DVec3::Z],
            Self::Y => [DVec3::X, -DVec3::Z, DVec3::Y],
        }
    }

    /// The axis.
    pub fn axis(self) -> DVec3 {
        self.frame()[2]
    }
}

impl Direction {
    /// The standard view between front, right and top.
    pub const ISO: Self = Self { azimuth_deg: 45.0, elevation_deg: 35.264_389_682_754_654 };

    /// `iso`, `front`, `back`, `left`, `right`, `top` or `bottom`.
    pub fn named(name: &str) -> Option<Self> {
        let of = |azimuth_deg, elevation_deg| Some(Self { azimuth_deg, elevation_deg });
        match name {
            "iso" => Some(Self::ISO),
            "front" => of(0.0, 0.0),
            "right" => of(90.0, 0.0),
            "back" => of(180.0, 0.0),
            "left" => of(270.0, 0.0),
            "top" => of(0.0, 90.0),
            "bottom" => of(0.0, -90.0),
            _ => None,
        }
    }

    /// The side on which the eye is when it looks against `outward`; `None` for no direction at all.
    pub fn towards(outward: DVec3, up: Up) -> Option<Self> {
        let outward = outward.try_normalize()?;
        let [right, back, above] = up.frame();
        let (x, y) = (outward.dot(right), -outward.dot(back));
        // Straight from above or below, the front stays at the lower border.
        let azimuth_deg = if x.hypot(y) < 1e-9 { 0.0 } else { x.atan2(y).to_degrees().rem_euclid(360.0) };
        Some(Self { azimuth_deg, elevation_deg: outward.dot(above).clamp(-1.0, 1.0).asin().to_degrees() })
    }

    /// The picture's axes: to the right, up, back to the eye.
    pub fn axes(self, up: Up) -> [DVec3; 3] {
        let [right, back, above] = up.frame();
        let (sin, cos) = self.azimuth_deg.to_radians().sin_cos();
        let (rise, run) = self.elevation_deg.to_radians().sin_cos();
        let across = right * cos + back * sin;
        let outward = right * sin - back * cos;
        [across, above * run - outward * rise, outward * run + above * rise]
    }
}

impl Camera {
    /// Looks at `points` from `direction` so that all of them are in the picture, which is `aspect` times as wide as
    /// high. `None` where there are no points.
    pub fn fit(
        points: &[DVec3],
        direction: Direction,
        up: Up,
        projection: Projection,
        aspect: f64,
    ) -> Option<Self> {
        let axes = direction.axes(up);
        let seen: Vec<DVec3> = points.iter().map(|p| DVec3::from(axes.map(|axis| p.dot(axis)))).collect();
        let (low, high) = seen
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
        if !(low.is_finite() && high.is_finite()) {
            return None;
        }
        let size = (high - low).length().max(1e-6);
        let shown = 1.0 - 2.0 * MARGIN;
        let back_to_world = |p: DVec3| axes[0] * p.x + axes[1] * p.y + axes[2] * p.z;
        match projection {
            Projection::Parallel { .. } => {
                let extent = high - low;
                let height = extent.y.max(extent.x / aspect).max(1e-3 * size) / shown;
                let middle = ((low + high) * 0.5).with_z(high.z + size);
                let projection = Projection::Parallel { height_mm: height };
                Some(Self { eye: back_to_world(middle), axes, projection })
            }
            Projection::Perspective { fov_y_rad } => {
                let slope_y = (0.5 * fov_y_rad).tan() * shown;
                let slopes = [slope_y * aspect, slope_y];
                // Both borders of each direction touch the points: x ± slope (eye.z - z) at its largest.
                let mut eye = DVec3::ZERO;
                let mut spreads = [0.0; 2];
                for k in 0..2 {
                    let most = |sign: f64| {
                        seen.iter().map(|p| sign * p[k] + slopes[k] * p.z).fold(f64::NEG_INFINITY, f64::max)
                    };
                    let (right, left) = (most(1.0), most(-1.0));
                    eye[k] = 0.5 * (right - left);
                    spreads[k] = (right + left) / (2.0 * slopes[k]);
                }
                eye.z = spreads[0].max(spreads[1]).max(high.z + 1e-2 * size);
                Some(Self { eye: back_to_world(eye), axes, projection })
            }
        }
    }

    /// From the model's coordinates to the eye's: x to the right, y up, z back; a rotation.
    pub fn rotation(&self) -> DMat3 {
        DMat3::from_cols(self.axes[0], self.axes[1], self.axes[2]).transpose()
    }

    /// A point in the eye's coordinates.
    pub fn to_eye(&self, point: DVec3) -> DVec3 {
        self.rotation() * (point - self.eye)
    }

    /// The size of a pixel at distance 1 (in a parallel projection at any distance), millimetres, in a picture of
    /// `height` pixels.
    pub fn pixel(&self, height: u32) -> f64 {
        let whole = match self.projection {
            Projection::Perspective { fov_y_rad } => 2.0 * (0.5 * fov_y_rad).tan(),
            Projection::Parallel { height_mm } => height_mm,
        };
        whole / f64::from(height.max(1))
    }

    /// Whether the projection is parallel.
    pub fn is_parallel(&self) -> bool {
        matches!(self.projection, Projection::Parallel { .. })
    }

    /// Where a point lies in a picture of `size` pixels, from its upper left corner; `None` behind the eye.
    pub fn project(&self, point: DVec3, size: [u32; 2]) -> Option<DVec2> {
        let p = self.to_eye(point);
        let depth = if self.is_parallel() { 1.0 } else { -p.z };
        let scale = 1.0 / (self.pixel(size[1]) * depth);
        let middle = DVec2::new(f64::from(size[0]), f64::from(size[1])) * 0.5;
        (depth > 0.0).then(|| middle + DVec2::new(p.x, -p.y) * scale)
    }

    /// The ray through a place of a picture of `size` pixels: where it starts, and its unit direction.
    pub fn ray(&self, at: DVec2, size: [u32; 2]) -> (DVec3, DVec3) {
        let middle = DVec2::new(f64::from(size[0]), f64::from(size[1])) * 0.5;
        let off = (at - middle) * self.pixel(size[1]);
        let [right, up, back] = self.axes;
        let across = right * off.x - up * off.y;
        if self.is_parallel() { (self.eye + across, -back) } else { (self.eye, (across - back).normalize()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_of_vectors_are_those_of_names() {
        for up in [Up::Y, Up::Z] {
            for name in ["iso", "front", "back", "left", "right", "top", "bottom"] {
                let direction = Direction::named(name).expect("a view");
                let found = Direction::towards(3.0 * direction.axes(up)[2], up).expect("a direction");
                let off = (found.azimuth_deg - direction.azimuth_deg).abs()
                    + (found.elevation_deg - direction.elevation_deg).abs();
                assert!(off < 1e-9, "{name} {found:?}");
            }
        }
        assert_eq!(Direction::towards(DVec3::ZERO, Up::Z), None);
    }

    fn cube() -> Vec<DVec3> {
        (0..8)
            .map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 10.0)
            .collect()
    }

    #[test]
    fn everything_fits_and_two_borders_are_touched() {
        let size = [640, 480];
        for projection in
            [Projection::Perspective { fov_y_rad: 0.6 }, Projection::Parallel { height_mm: 1.0 }]
        {
            for name in ["iso", "front", "back", "left", "right", "top", "bottom"] {
                let direction = Direction::named(name).expect("a view");
                let camera =
                    Camera::fit(&cube(), direction, Up::Z, projection, 640.0 / 480.0).expect("points");
                let places: Vec<DVec2> =
                    cube().iter().map(|p| camera.project(*p, size).expect("in front")).collect();
                let low = places.iter().fold(DVec2::INFINITY, |a, b| a.min(*b));
                let high = places.iter().fold(DVec2::NEG_INFINITY, |a, b| a.max(*b));
                assert!(low.x > 24.0 && low.y > 18.0 && high.x < 616.0 && high.y < 462.0, "{name}");
                let touched = (low.y - 19.2).abs() < 0.1 || (low.x - 25.6).abs() < 0.1;
                assert!(touched, "{name} {projection:?} {low} {high}");
            }
        }
    }

    #[test]
    fn rays_go_through_what_is_projected() {
        let size = [300, 200];
        let camera = Camera::fit(
            &cube(),
            Direction { azimuth_deg: 20.0, elevation_deg: -10.0 },
            Up::Y,
            Projection::Perspective { fov_y_rad: 0.5 },
            1.5,
        )
        .expect("points");
        for p in cube() {
            let (from, way) = camera.ray(camera.project(p, size).expect("in front"), size);
            assert!((p - from).cross(way).length() < 1e-9);
        }
    }

    #[test]
    fn the_front_is_seen_from_minus_y_with_z_up() {
        let [right, up, back] = Direction::named("front").expect("a view").axes(Up::Z);
        assert_eq!([right, up, back], [DVec3::X, DVec3::Z, -DVec3::Y]);
        let [right, up, back] = Direction::named("right").expect("a view").axes(Up::Z);
        assert!(right.distance(DVec3::Y) < 1e-12 && up == DVec3::Z && back.distance(DVec3::X) < 1e-12);
    }
}
