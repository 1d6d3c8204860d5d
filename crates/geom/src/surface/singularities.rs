//! Isoparametric lines that are single points.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::{Direction, Singularity, Surface};
use crate::project::axis_touches;

impl Surface {
    /// The isoparametric lines that are single points, inside or on the border of the domain: poles, apexes, places
    /// where a turned profile meets its axis, degenerate spline sides. An offset has those of its basis that stay points.
    pub fn singularities(&self) -> Vec<Singularity> {
        match self {
            Self::Plane { .. } | Self::Cylinder { .. } | Self::Extrusion { .. } => Vec::new(),
            Self::Cone { radius, half_angle_rad, .. } => self.along_v(&[-radius / half_angle_rad.tan()]),
            Self::Sphere { .. } => self.along_v(&[-FRAC_PI_2, FRAC_PI_2]),
            Self::Torus { major, minor, v_range, .. } => {
                let range = v_range.unwrap_or(crate::Interval::new(0.0, TAU));
                let angle = (-major / minor).acos();
                let turns = [-angle, angle, TAU - angle, TAU + angle];
                let inside = |v: f64| range.start - 1e-9 <= v && v <= range.end + 1e-9;
                let mut found: Vec<f64> =
                    turns.into_iter().filter(|&v| inside(v)).map(|v| range.clamp(v)).collect();
                found.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
                self.along_v(&found)
            }
            Self::Revolution { profile, origin, axis } => {
                self.along_v(&axis_touches(profile, *origin, *axis))
            }
            Self::Nurbs(nurbs) => nurbs.singularities(),
            Self::Offset { basis, .. } => {
                let kept = basis.singularities().into_iter().filter(|s| self.is_single_point(s));
                kept.map(|s| Singularity { point: self.point(s.at_share(self, 0.0)), ..s }).collect()
            }
        }
    }

    fn along_v(&self, values: &[f64]) -> Vec<Singularity> {
        let finite = values.iter().filter(|v| v.is_finite());
        finite
            .map(|&at| Singularity { constant: Direction::V, at, point: self.point(DVec2::new(0.0, at)) })
            .collect()
    }

    /// Whether the line of `singularity` is a single point on this surface too.
    fn is_single_point(&self, singularity: &Singularity) -> bool {
        let points = [0.0, 0.2, 0.4, 0.6, 0.8].map(|s| self.point(singularity.at_share(self, s)));
        let size =
            self.point(DVec2::from(self.domain().map(|d| if d.is_finite() { d.at(0.5) } else { 0.0 })));
        points.iter().all(|p| p.distance(points[0]) <= 1e-6 * size.distance(points[0]))
    }
}

impl Singularity {
    /// The parameters at share `s` of this line.
    fn at_share(&self, surface: &Surface, s: f64) -> DVec2 {
        let [u, v] = surface.domain();
        let other = if self.constant == Direction::V { u } else { v };
        let t = if other.is_finite() { other.at(s) } else { s };
        match self.constant {
            Direction::U => DVec2::new(self.at, t),
            Direction::V => DVec2::new(t, self.at),
        }
    }
}
