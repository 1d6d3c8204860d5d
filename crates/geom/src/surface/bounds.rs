//! Boxes around surfaces.

use glam::{DVec2, DVec3};

use super::{Surface, revolve};
use crate::curve::angles;
use crate::{Aabb, Curve, Frame, Interval, NurbsSurface};

impl Surface {
    /// A box that holds the surface over a finite `domain`: exact for elementary surfaces, the hull of the control
    /// points of the part for splines and sweeps, grown by the distance for offsets.
    pub fn bounds(&self, domain: [Interval; 2]) -> Aabb {
        let [u, v] = domain;
        match self {
            Self::Plane { .. } => self.corners(u, v),
            Self::Cylinder { frame, .. } | Self::Cone { frame, .. } => {
                let rings = [v.start, v.end].map(|v| self.tube(v).map(|(_, t)| (t.radius[0], t.height[0])));
                rings.into_iter().flatten().fold(Aabb::EMPTY, |b, (radius, height)| {
                    let frame = Frame { origin: frame.origin + frame.z * height, ..*frame };
                    b.union(Curve::Circle { frame, radius }.bounds(u))
                })
            }
            Self::Sphere { frame, radius } => round(frame, 0.0, *radius, u, v),
            Self::Torus { frame, major, minor, .. } => round(frame, *major, *minor, u, v),
            Self::Extrusion { profile, direction } => {
                let base = profile.bounds(u);
                let moved = |t: f64| Aabb { min: base.min + *direction * t, max: base.max + *direction * t };
                moved(v.start).union(moved(v.end))
            }
            Self::Revolution { profile, origin, axis } => match profile.to_nurbs(v) {
                Some(spline) => {
                    let points = spline.points().iter();
                    points.fold(self.corners(u, v), |b, &p| b.union(turned(p, *origin, *axis, u)))
                }
                None => full_turn(profile.bounds(v), *origin, *axis),
            },
            Self::Nurbs(nurbs) => self.corners(u, v).union(hull(nurbs, domain)),
            Self::Offset { basis, distance } => {
                let grown = DVec3::splat(distance.abs());
                let inner = basis.bounds(domain);
                Aabb { min: inner.min - grown, max: inner.max + grown }
            }
        }
    }

    fn corners(&self, u: Interval, v: Interval) -> Aabb {
        let corners = [(u.start, v.start), (u.start, v.end), (u.end, v.start), (u.end, v.end)];
        Aabb::from_points(corners.map(|(u, v)| self.point(DVec2::new(u, v))))
    }
}

/// Sphere and torus: along each world axis the coordinate is linear in the horizontal part of the direction at u, so it is
/// extreme where that is, at one of its ends; for each of them it is a sinusoid in v.
fn round(frame: &Frame, major: f64, minor: f64, u: Interval, v: Interval) -> Aabb {
    let mut bounds = Aabb::EMPTY;
    for axis in 0..3 {
        let (x, y, z) = (frame.x[axis], frame.y[axis], frame.z[axis]);
        let us = angles(y.atan2(x), u).chain([u.start, u.end]);
        for out in us.map(|u| x * u.cos() + y * u.sin()) {
            for t in angles(z.atan2(out), v).chain([v.start, v.end]) {
                let value = frame.origin[axis] + (major + minor * t.cos()) * out + minor * t.sin() * z;
                bounds.min[axis] = bounds.min[axis].min(value);
                bounds.max[axis] = bounds.max[axis].max(value);
            }
        }
    }
    bounds
}

/// The box of one point turned through a range of angles.
fn turned(point: DVec3, origin: DVec3, axis: DVec3, u: Interval) -> Aabb {
    let offset = point - origin;
    let along = axis * offset.dot(axis);
    let out = offset - along;
    let radius = out.length();
    match out.try_normalize() {
        Some(x) => {
            let frame = Frame { origin: origin + along, x, y: axis.cross(x), z: axis };
            Curve::Circle { frame, radius }.bounds(u)
        }
        None => Aabb::from_points([origin + revolve::turn_point(offset, axis, 0.0)]),
    }
}

/// A box turned all the way round.
fn full_turn(bounds: Aabb, origin: DVec3, axis: DVec3) -> Aabb {
    let full = Interval::new(0.0, std::f64::consts::TAU);
    bounds.corners().into_iter().fold(bounds, |b, corner| b.union(turned(corner, origin, axis, full)))
}

/// The control points of the part over `domain`; of the whole surface where there is no such part.
fn hull(nurbs: &NurbsSurface, domain: [Interval; 2]) -> Aabb {
    match nurbs.restricted(domain) {
        Ok(part) => Aabb::from_points(part.points().iter().copied()),
        Err(_) => Aabb::from_points(nurbs.points().iter().copied()),
    }
}
