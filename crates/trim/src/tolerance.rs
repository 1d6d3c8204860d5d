//! How finely curves become polylines.

/// How finely curves become polylines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// The largest distance between a chord and its curve, millimetres.
    pub linear_mm: f64,
    /// The largest angle between the exact tangents (on an edge also the adjoining surfaces' normals) at a chord's
    /// ends, radians.
    pub angular_rad: f64,
}

impl Tolerance {
    /// Limits both to what the algorithms can use: more than a sixth of a turn per chord would leave the winding of a
    /// closed curve unclear.
    pub fn clamped(self) -> Self {
        Self {
            linear_mm: if self.linear_mm > 0.0 { self.linear_mm } else { f64::MIN_POSITIVE },
            angular_rad: self.angular_rad.clamp(0.25f64.to_radians(), 60f64.to_radians()),
        }
    }

    /// The shortest chord that is still split to satisfy the angle: below it, corners and cusps would split for ever.
    pub fn shortest_chord_mm(&self) -> f64 {
        self.linear_mm * 0.02
    }

    /// The angle step at which a circle of `radius_mm` meets both bounds.
    pub fn arc_step_rad(&self, radius_mm: f64) -> f64 {
        let ratio = (self.linear_mm / radius_mm).min(1.0);
        (2.0 * (1.0 - ratio).acos()).min(self.angular_rad)
    }
}
