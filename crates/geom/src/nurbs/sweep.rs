//! Ruled and turned surfaces from curves.

use glam::{DVec3, DVec4};

use super::arc::Arc2;
use super::{NurbsCurve, NurbsError, NurbsSurface};
use crate::Interval;

impl NurbsSurface {
    /// `profile(u) + v direction` for v in `range`.
    ///
    /// # Errors
    /// When `range` is empty or not finite.
    pub fn extruded(profile: &NurbsCurve, direction: DVec3, range: Interval) -> Result<Self, NurbsError> {
        let moved = |p: DVec4, v: f64| p + (direction * (v * p.w)).extend(0.0);
        let profile_points = profile.homogeneous();
        let points: Vec<DVec4> =
            profile_points.iter().flat_map(|&p| [moved(p, range.start), moved(p, range.end)]).collect();
        let across = vec![range.start, range.start, range.end, range.end];
        let knots = [profile.knots().to_vec(), across];
        Self::from_homogeneous([profile.degree(), 1], profile_points.len(), 2, &points, knots)
    }

    /// `profile(v)` turned about the unit `axis` through `origin` (Piegl & Tiller A8.1). Along u the spline's parameter
    /// is the angle at the knots and half-way between them only.
    ///
    /// # Errors
    /// When the range of angles is empty, not finite, or longer than a thousand turns.
    pub fn revolved(
        profile: &NurbsCurve,
        origin: DVec3,
        axis: DVec3,
        angles_rad: Interval,
    ) -> Result<Self, NurbsError> {
        let arc = Arc2::circle(angles_rad).ok_or_else(|| {
            NurbsError(format!("no arc from {} to {} radians", angles_rad.start, angles_rad.end))
        })?;
        let profile_points = profile.homogeneous();
        let turned = |[x, y, w]: [f64; 3], p: &DVec4| {
            let offset = p.truncate() - origin * p.w;
            let along = axis * offset.dot(axis);
            let out = offset - along;
            let center = origin * p.w + along;
            (center * w + out * x + axis.cross(out) * y).extend(w * p.w)
        };
        let points: Vec<DVec4> =
            arc.points.iter().flat_map(|&a| profile_points.iter().map(move |p| turned(a, p))).collect();
        let knots = [arc.knots, profile.knots().to_vec()];
        Self::from_homogeneous([2, profile.degree()], arc.points.len(), profile_points.len(), &points, knots)
    }
}
