//! Images of surfaces.

use std::sync::Arc;

use glam::{DAffine3, DVec2};

use super::Surface;
use crate::Frame;
use crate::curve::{flat_frame, scale_of};

impl Surface {
    /// The surface's image under a similarity (rotation, uniform scale, mirror; any affine map for splines and
    /// extrusions). Returns also whether the image's normal is opposite to the mapped normal.
    ///
    /// With `image` the image, `image(transformed_uv(map, uv)) = map(self(uv))`:
    /// - splines, extrusions and revolutions keep u and v, so a mirror turns their normals over (`true`);
    /// - planes scale u and v with the map, and a mirror turns their normals over (`true`);
    /// - cylinders, cones, spheres and tori keep a right-handed frame: under a mirror u runs the other way
    ///   (`-u`), and the normal stays on its side (`false`); v of cylinders and cones scales with the map;
    /// - offsets go with their basis.
    pub fn transformed(&self, map: &DAffine3) -> (Self, bool) {
        let scale = scale_of(map);
        let mirrored = map.matrix3.determinant() < 0.0;
        match self {
            Self::Plane { frame } => (Self::Plane { frame: flat_frame(frame, map) }, mirrored),
            Self::Cylinder { frame, radius } => {
                (Self::Cylinder { frame: axial_frame(frame, map), radius: radius * scale }, false)
            }
            Self::Cone { frame, radius, half_angle_rad } => {
                let (frame, radius) = (axial_frame(frame, map), radius * scale);
                (Self::Cone { frame, radius, half_angle_rad: *half_angle_rad }, false)
            }
            Self::Sphere { frame, radius } => {
                (Self::Sphere { frame: axial_frame(frame, map), radius: radius * scale }, false)
            }
            Self::Torus { frame, major, minor, v_range } => {
                let (frame, major, minor) = (axial_frame(frame, map), major * scale, minor * scale);
                (Self::Torus { frame, major, minor, v_range: *v_range }, false)
            }
            Self::Extrusion { profile, direction } => {
                let direction = map.transform_vector3(*direction);
                (Self::Extrusion { profile: Arc::new(profile.transformed(map)), direction }, mirrored)
            }
            Self::Revolution { profile, origin, axis } => {
                // A mirror turns rotations over; about the opposite axis they are the same again.
                let hand = if mirrored { -1.0 } else { 1.0 };
                let axis = (map.transform_vector3(*axis) * hand).try_normalize().unwrap_or(*axis);
                let origin = map.transform_point3(*origin);
                (Self::Revolution { profile: Arc::new(profile.transformed(map)), origin, axis }, mirrored)
            }
            Self::Nurbs(nurbs) => match nurbs.transformed(map) {
                Ok(image) => (Self::Nurbs(image), mirrored),
                Err(_) => (self.clone(), false),
            },
            Self::Offset { basis, distance } => {
                let (basis, flipped) = basis.transformed(map);
                let distance = if flipped { -distance * scale } else { distance * scale };
                (Self::Offset { basis: Arc::new(basis), distance }, flipped)
            }
        }
    }

    /// The parameters that [`Surface::transformed`]'s image has for the image of the point at `uv`.
    pub fn transformed_uv(&self, map: &DAffine3, uv: DVec2) -> DVec2 {
        let [u, v] = self.parameter_map(map);
        DVec2::new(uv.x * u, uv.y * v)
    }

    /// The factors by which u and v change.
    pub(crate) fn parameter_map(&self, map: &DAffine3) -> [f64; 2] {
        let scale = scale_of(map);
        let hand = if map.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        match self {
            Self::Plane { .. } => [scale, scale],
            Self::Cylinder { .. } | Self::Cone { .. } => [hand, scale],
            Self::Sphere { .. } | Self::Torus { .. } => [hand, 1.0],
            Self::Extrusion { .. } | Self::Revolution { .. } | Self::Nurbs(_) => [1.0, 1.0],
            Self::Offset { basis, .. } => basis.parameter_map(map),
        }
    }
}

/// The image of a frame's z and x; y becomes right-handed with them.
fn axial_frame(frame: &Frame, map: &DAffine3) -> Frame {
    let [z, x] = [frame.z, frame.x].map(|axis| map.transform_vector3(axis));
    Frame::new(map.transform_point3(frame.origin), z, x)
}
