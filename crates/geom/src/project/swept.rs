//! Surfaces swept by a profile curve: projection in the plane where the profile is all there is.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::curve_search::CurveSearch;
use crate::period::{near, turn, wrap};
use crate::surface::Meridian;
use crate::{Curve, Interval};

/// Extrusion: along the direction both the point and the profile fall onto a plane; the foot there gives u, and what
/// remains along the direction gives v.
pub(super) fn project_extrusion(
    profile: &Curve,
    direction: DVec3,
    point: DVec3,
    hint: Option<DVec2>,
) -> DVec2 {
    let Some(unit) = direction.try_normalize() else {
        let foot = profile.project(point, hint.map(|h| h.x));
        return DVec2::new(foot.t, hint.map_or(0.0, |h| h.y));
    };
    let flatten = |p: DVec3| p - unit * p.dot(unit);
    let hint_u = hint.map(|h| h.x);
    let u = match profile {
        _ if is_square(profile, unit) => {
            // The profile's own height along the direction is the same everywhere.
            let lifted = flatten(point) + unit * profile.point(0.0).dot(unit);
            near_hint(profile.project(lifted, hint_u).t, hint_u, profile.period())
        }
        Curve::Line { origin, direction: along } => {
            let along = flatten(*along);
            let t = (flatten(point) - flatten(*origin)).dot(along) / along.length_squared();
            if t.is_finite() { t } else { 0.0 }
        }
        _ => {
            let samples = || flattened(profile, point, flatten);
            let evaluate = |t: f64| profile.derivatives(t).map(flatten);
            search(profile, evaluate, samples, flatten(point), hint_u)
        }
    };
    DVec2::new(u, (point - profile.point(u)).dot(unit) / direction.length())
}

/// Whether a conic lies in a plane square to the direction (or is a line square to it).
fn is_square(profile: &Curve, unit: DVec3) -> bool {
    match profile {
        Curve::Line { direction, .. } => direction.dot(unit).abs() <= 1e-15 * direction.length(),
        Curve::Circle { frame, .. }
        | Curve::Ellipse { frame, .. }
        | Curve::Parabola { frame, .. }
        | Curve::Hyperbola { frame, .. } => frame.z.cross(unit).length_squared() <= 1e-28,
        _ => false,
    }
}

/// Revolution: in the half-plane of radius and height the point and the profile are a point and a curve; the foot
/// there gives v, and the angle between the two gives u.
pub(super) fn project_revolution(
    profile: &Curve,
    origin: DVec3,
    axis: DVec3,
    point: DVec3,
    hint: Option<DVec2>,
) -> DVec2 {
    let meridian = Meridian { profile, origin, axis };
    let target = meridian.flatten(point);
    let hint_v = hint.map(|h| h.y);
    let v = match axial_plane(profile, origin, axis) {
        Some(out) => {
            let at = |radius: f64| profile.project(origin + axis * target.y + out * radius, hint_v);
            let (one, other) = (at(target.x), at(-target.x));
            let [t, opposite] = [one.t, other.t].map(|t| near_hint(t, hint_v, profile.period()));
            // A profile that is its own mirror image covers the surface twice: the hint says which sheet is meant.
            let alike = (one.distance - other.distance).abs() <= 1e-9 * (target.length() + one.distance);
            let nearer = match hint_v.filter(|hint| alike && hint.is_finite()) {
                Some(hint) => (t - hint).abs() <= (opposite - hint).abs(),
                None => alike || one.distance <= other.distance,
            };
            if nearer { t } else { opposite }
        }
        None => {
            let samples = || flattened(profile, point, |p| meridian.flatten(p));
            search(profile, |t| meridian.derivatives(t), samples, target, hint_v)
        }
    };
    DVec2::new(angle_between(&meridian, v, point, hint.map(|h| h.x)), v)
}

/// The direction away from the axis in which a conic or line profile lies, if it lies in a plane with the axis.
fn axial_plane(profile: &Curve, origin: DVec3, axis: DVec3) -> Option<DVec3> {
    let (center, normal) = match profile {
        Curve::Line { origin: start, direction } => {
            let across = axis.cross(*direction);
            let normal = if across.length() > 1e-12 * direction.length() {
                across
            } else {
                axis.cross(*start - origin)
            };
            (*start, normal.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector()))
        }
        Curve::Circle { frame, .. }
        | Curve::Ellipse { frame, .. }
        | Curve::Parabola { frame, .. }
        | Curve::Hyperbola { frame, .. } => (frame.origin, frame.z),
        _ => return None,
    };
    let offset = center - origin;
    let flat = normal.dot(axis).abs() <= 1e-12 && offset.dot(normal).abs() <= 1e-12 * offset.length();
    flat.then(|| normal.cross(axis).normalize_or_zero())
}

/// The angle from the profile's point at `v` to the target, about the axis.
fn angle_between(meridian: &Meridian, v: f64, target: DVec3, hint: Option<f64>) -> f64 {
    let axis = meridian.axis;
    let out = |w: DVec3| w - axis * w.dot(axis);
    let [p, d, _] = meridian.profile.derivatives(v);
    let (from, to) = (out(p - meridian.origin), out(target - meridian.origin));
    let size = (p - meridian.origin).length();
    let hint = hint.filter(|h| h.is_finite());
    let on_axis = from.length() <= 1e-12 * size;
    if to.length_squared() == 0.0 || (on_axis && hint.is_some()) {
        return hint.unwrap_or(0.0);
    }
    // From a pole, the profile leaves in the direction of its tangent.
    let from = if on_axis { out(d) } else { from };
    let angle = axis.dot(from.cross(to)).atan2(from.dot(to));
    hint.map_or_else(|| turn(angle), |h| near(angle, h, TAU))
}

fn flattened<'a>(
    profile: &'a Curve,
    target: DVec3,
    flatten: impl Fn(DVec3) -> DVec3,
) -> Cow<'a, [(f64, DVec3)]> {
    Cow::Owned(profile.samples(target).iter().map(|&(t, p)| (t, flatten(p))).collect())
}

fn search<'a>(
    profile: &Curve,
    evaluate: impl Fn(f64) -> [DVec3; 3],
    samples: impl FnOnce() -> Cow<'a, [(f64, DVec3)]>,
    target: DVec3,
    hint: Option<f64>,
) -> f64 {
    let (domain, period) = (profile.domain(), profile.period());
    let foot = CurveSearch::new(evaluate, domain, period.is_some()).nearest(target, hint, samples);
    let t = if period.is_some() { wrap(foot.t, domain) } else { foot.t };
    near_hint(t, hint, period)
}

fn near_hint(t: f64, hint: Option<f64>, period: Option<f64>) -> f64 {
    match (hint, period) {
        (Some(hint), Some(period)) if hint.is_finite() => near(t, hint, period),
        _ => t,
    }
}

/// The parameters at which a profile meets the axis, within 1e-6 of its own extent or its largest distance
/// from there.
pub(crate) fn axis_touches(profile: &Curve, origin: DVec3, axis: DVec3) -> Vec<f64> {
    let meridian = Meridian { profile, origin, axis };
    let samples = profile.samples(origin);
    let flat: Vec<(f64, DVec3)> = samples.iter().map(|&(t, p)| (t, meridian.flatten(p))).collect();
    let extent = flat.iter().map(|(_, p)| p.x).fold(0.0, f64::max);
    let spread = flat.iter().map(|(_, p)| p.distance(flat[0].1)).fold(0.0, f64::max);
    let tolerance = 1e-6 * extent.max(spread);
    let domain = profile.domain();
    let radial = |t: f64| profile.derivatives(t).map(|w| w - axis * w.dot(axis));
    let target = origin - axis * origin.dot(axis);
    let search = CurveSearch::new(radial, domain, profile.period().is_some());
    let mut found: Vec<f64> = Vec::new();
    for i in 0..flat.len() {
        let beside = [i.saturating_sub(1), (i + 1).min(flat.len() - 1)];
        if beside.iter().any(|&k| flat[k].1.x < flat[i].1.x) {
            continue;
        }
        let t = search.descend(target, flat[i].0).t;
        let t = if profile.period().is_some() { wrap(t, domain) } else { t };
        let radius = meridian.flatten(profile.point(t)).x;
        if radius <= tolerance {
            found.push(snap(t, domain));
        }
    }
    found.sort_by(f64::total_cmp);
    let span = if domain.is_finite() { domain.length() } else { 1.0 };
    found.dedup_by(|a, b| (*a - *b).abs() <= 1e-7 * span);
    found
}

/// An end of the domain where `t` is all but there.
fn snap(t: f64, domain: Interval) -> f64 {
    let slack = 1e-7 * domain.length();
    if !domain.is_finite() {
        t
    } else if t - domain.start <= slack {
        domain.start
    } else if domain.end - t <= slack {
        domain.end
    } else {
        t
    }
}
