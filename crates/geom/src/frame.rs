//! A right-handed orthonormal placement.

use glam::{DAffine3, DMat3, DVec3};

/// A right-handed orthonormal placement: `axis2_placement_3d` of ISO 10303-42.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Where the placement's origin lies.
    pub origin: DVec3,
    /// Unit x axis.
    pub x: DVec3,
    /// Unit y axis, `z` cross `x`.
    pub y: DVec3,
    /// Unit z axis.
    pub z: DVec3,
}

impl Frame {
    /// The world's own axes.
    pub const WORLD: Self = Self { origin: DVec3::ZERO, x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

    /// The placement with axis `z` and the part of `x` that is normal to it (ISO 10303-42 `build_axes`).
    ///
    /// Neither needs to be a unit vector. A zero `z` counts as +Z; an `x` that is zero or along `z` is replaced
    /// by some normal direction.
    pub fn new(origin: DVec3, z: DVec3, x: DVec3) -> Self {
        let z = z.try_normalize().unwrap_or(DVec3::Z);
        let flat = x - z * x.dot(z);
        let x = if flat.length_squared() > 1e-20 * x.length_squared().max(f64::MIN_POSITIVE) {
            flat.try_normalize().unwrap_or_else(|| z.any_orthonormal_vector())
        } else {
            z.any_orthonormal_vector()
        };
        Self { origin, x, y: z.cross(x), z }
    }

    /// World coordinates of a point given in this frame.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.vector(local)
    }

    /// World components of a vector given in this frame.
    pub fn vector(&self, local: DVec3) -> DVec3 {
        self.x * local.x + self.y * local.y + self.z * local.z
    }

    /// This frame's coordinates of a world point.
    pub fn local_point(&self, world: DVec3) -> DVec3 {
        self.local_vector(world - self.origin)
    }

    /// This frame's components of a world vector.
    pub fn local_vector(&self, world: DVec3) -> DVec3 {
        DVec3::new(world.dot(self.x), world.dot(self.y), world.dot(self.z))
    }

    /// The rigid map from this frame's coordinates to the world's.
    pub fn to_affine(&self) -> DAffine3 {
        DAffine3 { matrix3: DMat3::from_cols(self.x, self.y, self.z), translation: self.origin }
    }
}
