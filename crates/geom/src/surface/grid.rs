//! Many points at once.

use glam::{DVec2, DVec3};

use super::{Surface, revolve};
use crate::Derivatives;

impl Surface {
    /// Points on the grid `us` x `vs`, row-major: index `i * vs.len() + j` is the point at (`us[i]`, `vs[j]`).
    /// Basis values, profile points, sines and cosines are shared along rows and columns.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Vec<DVec3> {
        match self {
            Self::Nurbs(nurbs) => nurbs.grid(us, vs),
            Self::Extrusion { profile, direction } => {
                let bases = us.iter().map(|&u| profile.point(u));
                bases.flat_map(|p| vs.iter().map(move |&v| p + *direction * v)).collect()
            }
            Self::Revolution { profile, origin, axis } => {
                let profile: Vec<DVec3> = vs.iter().map(|&v| profile.point(v) - *origin).collect();
                let turned = |u: f64| {
                    let (axis, origin) = (*axis, *origin);
                    profile.iter().map(move |&p| revolve::turn_point(p, axis, u) + origin)
                };
                us.iter().flat_map(|&u| turned(u)).collect()
            }
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Sphere { .. } | Self::Torus { .. } => {
                self.tube_grid(us, vs)
            }
            Self::Plane { .. } | Self::Offset { .. } => {
                us.iter().flat_map(|&u| vs.iter().map(move |&v| self.point(DVec2::new(u, v)))).collect()
            }
        }
    }

    /// Point, first and second derivatives on the grid `us` x `vs`, in the order of [`Surface::grid`].
    pub fn derivatives_grid(&self, us: &[f64], vs: &[f64]) -> Vec<Derivatives> {
        match self {
            Self::Nurbs(nurbs) => nurbs.derivatives_grid(us, vs),
            _ => {
                us.iter().flat_map(|&u| vs.iter().map(move |&v| self.derivatives(DVec2::new(u, v)))).collect()
            }
        }
    }

    fn tube_grid(&self, us: &[f64], vs: &[f64]) -> Vec<DVec3> {
        let meridian: Vec<[f64; 2]> =
            vs.iter().filter_map(|&v| self.tube(v)).map(|(_, t)| [t.radius[0], t.height[0]]).collect();
        let Some((frame, _)) = self.tube(0.0) else { return Vec::new() };
        let mut grid = Vec::with_capacity(us.len() * vs.len());
        for &u in us {
            let (sin, cos) = u.sin_cos();
            let out = frame.x * cos + frame.y * sin;
            grid.extend(meridian.iter().map(|&[r, h]| frame.origin + out * r + frame.z * h));
        }
        grid
    }
}
