//! Closed forms for planes, cylinders, cones, spheres and tori.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::period::{near, turn};
use crate::{Frame, Interval, Surface};

/// A point in cylinder coordinates of a frame.
struct Polar {
    angle_rad: f64,
    radius: f64,
    height: f64,
}

impl Polar {
    /// On the axis, where every angle will do, the hint's.
    fn new(frame: &Frame, point: DVec3, hint: Option<DVec2>) -> Self {
        let local = frame.local_point(point);
        let radius = local.x.hypot(local.y);
        let angle_rad = if radius > 0.0 {
            local.y.atan2(local.x)
        } else {
            hint.map_or(0.0, |h| if h.x.is_finite() { h.x } else { 0.0 })
        };
        Self { angle_rad, radius, height: local.z }
    }
}

/// The parameters of the nearest point: u in [0, 2π) where it is an angle, or near the hint's.
/// `None` for other kinds of surface.
pub(super) fn project(surface: &Surface, point: DVec3, hint: Option<DVec2>) -> Option<DVec2> {
    match *surface {
        Surface::Plane { ref frame } => Some(frame.local_point(point).truncate()),
        Surface::Cylinder { ref frame, radius } => {
            let p = Polar::new(frame, point, hint);
            let half = if radius < 0.0 && p.radius > 0.0 { PI } else { 0.0 };
            Some(DVec2::new(settle(p.angle_rad + half, hint.map(|h| h.x)), p.height))
        }
        Surface::Cone { ref frame, radius, half_angle_rad } => {
            let p = Polar::new(frame, point, hint);
            let (u, v) = cone(radius, half_angle_rad, &p);
            Some(DVec2::new(settle(u, hint.map(|h| h.x)), v))
        }
        Surface::Sphere { ref frame, radius } => {
            let p = Polar::new(frame, point, hint);
            let half = if radius < 0.0 && p.radius > 0.0 { PI } else { 0.0 };
            let v = if radius < 0.0 { (-p.height).atan2(p.radius) } else { p.height.atan2(p.radius) };
            Some(DVec2::new(settle(p.angle_rad + half, hint.map(|h| h.x)), v))
        }
        Surface::Torus { ref frame, major, minor, v_range } => {
            let p = Polar::new(frame, point, hint);
            let (u, v) = torus(major, minor, v_range, &p, hint);
            let v = if v_range.is_some() { v } else { settle(v, hint.map(|h| h.y)) };
            Some(DVec2::new(settle(u, hint.map(|h| h.x)), v))
        }
        _ => None,
    }
}

/// The angle near the hint's, or in [0, 2π).
fn settle(angle_rad: f64, hint: Option<f64>) -> f64 {
    match hint {
        Some(hint) if hint.is_finite() => near(angle_rad, hint, TAU),
        _ => turn(angle_rad),
    }
}

/// The nearer of the two lines in which the axial plane through the point cuts the cone: the one of the point's own
/// angle and the one of the opposite angle (each a generator of both nappes).
fn cone(radius: f64, half_angle_rad: f64, p: &Polar) -> (f64, f64) {
    let (sin, cos) = half_angle_rad.sin_cos();
    // Along and off the line through (radius, 0) with direction (sin, cos).
    let off = |x: f64| ((x - radius) * cos - p.height * sin).abs();
    let along = |x: f64| ((x - radius) * sin + p.height * cos) * cos;
    if off(p.radius) <= off(-p.radius) {
        (p.angle_rad, along(p.radius))
    } else {
        (p.angle_rad + PI, along(-p.radius))
    }
}

/// Each of the two circles in which the axial plane through the point cuts the torus has one nearest point inside
/// `v_range`; the nearer of them.
fn torus(major: f64, minor: f64, v_range: Option<Interval>, p: &Polar, hint: Option<DVec2>) -> (f64, f64) {
    let candidate = |x: f64| {
        let (dx, dy) = ((x - major) * minor.signum(), p.height * minor.signum());
        let free = if dx == 0.0 && dy == 0.0 {
            hint.map_or(0.0, |h| if h.y.is_finite() { h.y } else { 0.0 })
        } else {
            dy.atan2(dx)
        };
        let gap = |v: f64| (major + minor * v.cos() - x).hypot(minor * v.sin() - p.height);
        let v = v_range.map_or(free, |range| into_range(free, range, gap));
        (v, gap(v))
    };
    let (near_side, far_side) = (candidate(p.radius), candidate(-p.radius));
    if near_side.1 <= far_side.1 { (p.angle_rad, near_side.0) } else { (p.angle_rad + PI, far_side.0) }
}

/// The angle itself where a whole number of turns brings it into the range, else the better of the range's ends.
fn into_range(angle_rad: f64, range: Interval, gap: impl Fn(f64) -> f64) -> f64 {
    let inside = near(angle_rad, range.at(0.5), TAU);
    if range.contains(inside) {
        inside
    } else if gap(range.start) <= gap(range.end) {
        range.start
    } else {
        range.end
    }
}
