//! An axis-aligned box.

use glam::{DAffine3, DVec3};

/// An axis-aligned box; empty while `min` exceeds `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The lower corner.
    pub min: DVec3,
    /// The upper corner.
    pub max: DVec3,
}

impl Default for Aabb {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Aabb {
    /// The box of nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box of some points.
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }

    /// This box grown to hold `point`.
    pub fn with(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// The box of both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether all of `other` lies inside.
    pub fn contains(self, other: Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Whether nothing has been added yet.
    pub fn is_empty(self) -> bool {
        !(self.min.cmple(self.max).all())
    }

    /// The length of the diagonal, 0 for an empty box.
    pub fn diagonal(self) -> f64 {
        if self.is_empty() { 0.0 } else { self.max.distance(self.min) }
    }

    /// The middle of the box; meaningless while it is empty.
    pub fn center(self) -> DVec3 {
        (self.min + self.max) * 0.5
    }

    /// The eight corners, lower z first.
    pub fn corners(self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }

    /// The box of the transformed corners.
    pub fn transformed(self, map: &DAffine3) -> Self {
        if self.is_empty() {
            self
        } else {
            Self::from_points(self.corners().map(|c| map.transform_point3(c)))
        }
    }
}
