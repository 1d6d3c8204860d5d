//! The unbounded shape that an edge or a face is a piece of, as far as it has a name and a closed form.

use std::f64::consts::FRAC_PI_2;

use glam::{DAffine3, DVec3};
use trimloop_geom::{Curve, Frame, Interval, Surface};

use crate::Item;

/// A straight line without ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point of it, millimetres.
    pub origin: DVec3,
    /// Unit vector along it.
    pub direction: DVec3,
}

/// The unbounded shape of an item, in the world.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Carrier {
    Point(DVec3),
    Line(Axis),
    /// `normal` is a unit vector, on the side of the surface's own.
    Plane {
        origin: DVec3,
        normal: DVec3,
    },
    Circle {
        center: DVec3,
        normal: DVec3,
        radius: f64,
    },
    Ellipse {
        center: DVec3,
        normal: DVec3,
        major: f64,
        minor: f64,
    },
    Cylinder {
        axis: Axis,
        radius: f64,
    },
    EllipticCylinder {
        axis: Axis,
        major: f64,
        minor: f64,
    },
    Cone {
        axis: Axis,
        apex: DVec3,
        half_angle_rad: f64,
    },
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Torus {
        axis: Axis,
        major: f64,
        minor: f64,
    },
    Revolution(Axis),
    /// Nothing with a closed form: what to call it.
    Free(&'static str),
}

impl Carrier {
    /// Of an item; `None` where it has no geometry.
    pub fn of(item: &Item) -> Option<Self> {
        if let Some(point) = item.vertex() {
            return Some(Self::Point(point));
        }
        if let Some(edge) = item.edge() {
            return Some(curve(&edge.curve, edge.range, &item.transform));
        }
        match &item.face()?.geometry {
            trimloop_brep::FaceGeometry::Surface(s) => Some(surface(s, &item.transform)),
            trimloop_brep::FaceGeometry::Facets(_) => Some(Self::Free("triangles")),
            trimloop_brep::FaceGeometry::Unreadable(_) => None,
        }
    }

    /// What it is called.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Point(_) => "vertex",
            Self::Line(_) => "line",
            Self::Plane { .. } => "plane",
            Self::Circle { .. } => "circle",
            Self::Ellipse { .. } => "ellipse",
            Self::Cylinder { .. } => "cylinder",
            Self::EllipticCylinder { .. } => "elliptic cylinder",
            Self::Cone { .. } => "cone",
            Self::Sphere { .. } => "sphere",
            Self::Torus { .. } => "torus",
            Self::Revolution(_) => "surface of revolution",
            Self::Free(kind) => kind,
        }
    }

    /// The axis that it turns about.
    pub fn axis(&self) -> Option<Axis> {
        match *self {
            Self::Circle { center, normal, .. } | Self::Ellipse { center, normal, .. } => {
                Some(Axis { origin: center, direction: normal })
            }
            Self::Cylinder { axis, .. }
            | Self::EllipticCylinder { axis, .. }
            | Self::Cone { axis, .. }
            | Self::Torus { axis, .. }
            | Self::Revolution(axis) => Some(axis),
            _ => None,
        }
    }

    /// The point that it lies around: the centre of a circle, an ellipse, a sphere, a torus; a cone's apex is none.
    pub fn center(&self) -> Option<DVec3> {
        match *self {
            Self::Circle { center, .. } | Self::Ellipse { center, .. } | Self::Sphere { center, .. } => {
                Some(center)
            }
            Self::Torus { axis, .. } => Some(axis.origin),
            _ => None,
        }
    }
}

/// Lengths this much smaller than others count for nothing.
const SHAPE: f64 = 1e-9;

/// The carrier of a curve's piece.
fn curve(curve: &Curve, range: Interval, map: &DAffine3) -> Carrier {
    match curve {
        Curve::Line { origin, direction } => straight(*origin, *direction, map),
        Curve::Circle { frame, radius } => ellipse(frame, [*radius; 2], map),
        Curve::Ellipse { frame, major, minor } => ellipse(frame, [*major, *minor], map),
        Curve::Parabola { .. } => Carrier::Free("parabola"),
        Curve::Hyperbola { .. } => Carrier::Free("hyperbola"),
        Curve::Polyline(polyline) => line_through(&polyline.points, map).unwrap_or(Carrier::Free("polyline")),
        Curve::Nurbs(nurbs) => line_through(nurbs.points(), map).unwrap_or(Carrier::Free("B-spline curve")),
        Curve::Offset(_) => Carrier::Free("offset curve"),
        Curve::Composite(composite) => match &composite.segments[..] {
            [only] => self::curve(&only.curve, only.range, map),
            _ => Carrier::Free("composite curve"),
        },
        Curve::OnSurface { .. } => {
            let shares = [0.0, 0.1, 0.25, 0.4, 0.5, 0.65, 0.8, 0.9, 1.0];
            let points = shares.map(|s| curve.point(range.at(s)));
            line_through(&points, map).unwrap_or(Carrier::Free("curve on a surface"))
        }
    }
}

fn straight(origin: DVec3, direction: DVec3, map: &DAffine3) -> Carrier {
    match map.transform_vector3(direction).try_normalize() {
        Some(direction) => Carrier::Line(Axis { origin: map.transform_point3(origin), direction }),
        None => Carrier::Free("point"),
    }
}

/// The line that all of the points are on.
fn line_through(points: &[DVec3], map: &DAffine3) -> Option<Carrier> {
    let first = *points.first()?;
    let farthest = points.iter().max_by(|a, b| a.distance(first).total_cmp(&b.distance(first)))?;
    let along = (*farthest - first).try_normalize()?;
    let reach = SHAPE * farthest.distance(first);
    // A polygon that runs back over itself is no line, for it would be longer.
    let is_straight = points.iter().all(|p| (*p - first).reject_from_normalized(along).length() <= reach)
        && points.windows(2).all(|w| (w[1] - w[0]).dot(along) >= -reach);
    if !is_straight {
        return None;
    }
    Some(straight(first, points.last().map_or(along, |last| *last - first), map))
}

/// The image of an ellipse, its semi-axes those of the image.
fn ellipse(frame: &Frame, radii: [f64; 2], map: &DAffine3) -> Carrier {
    let center = map.transform_point3(frame.origin);
    let (a, b) = (map.transform_vector3(frame.x * radii[0]), map.transform_vector3(frame.y * radii[1]));
    let Some(normal) = a.cross(b).try_normalize() else { return Carrier::Free("ellipse") };
    let [major, minor] = semi_axes(a, b);
    if major - minor <= SHAPE * major {
        Carrier::Circle { center, normal, radius: (major + minor) * 0.5 }
    } else {
        Carrier::Ellipse { center, normal, major, minor }
    }
}

/// The semi-axes of the ellipse `a cos t + b sin t`: the singular values of `[a b]`, without squaring what is small.
fn semi_axes(a: DVec3, b: DVec3) -> [f64; 2] {
    // Sum and difference of the singular values from area and squares.
    let squares = a.length_squared() + b.length_squared();
    let area = a.cross(b).length();
    let difference = a.length_squared() - b.length_squared();
    let spread = (difference * difference + 4.0 * a.dot(b) * a.dot(b)).sqrt();
    let major = ((squares + spread) * 0.5).sqrt();
    let minor = if major > 0.0 { area / major } else { 0.0 };
    [major, minor]
}

/// The carrier of a surface.
fn surface(surface: &Surface, map: &DAffine3) -> Carrier {
    match surface {
        Surface::Plane { frame } => plane(frame.origin, frame.z, map),
        Surface::Cylinder { frame, radius } => {
            cylinder(frame.origin, frame.z, [frame.x * *radius, frame.y * *radius], map)
        }
        Surface::Cone { frame, radius, half_angle_rad } => cone(frame, *radius, *half_angle_rad, map),
        Surface::Sphere { frame, radius } => match similarity(map) {
            Some(scale) => {
                Carrier::Sphere { center: map.transform_point3(frame.origin), radius: radius.abs() * scale }
            }
            None => Carrier::Free("ellipsoid"),
        },
        Surface::Torus { frame, major, minor, .. } => {
            match (similarity(map), axis(frame.origin, frame.z, map)) {
                (Some(scale), Some(axis)) => {
                    Carrier::Torus { axis, major: major.abs() * scale, minor: minor.abs() * scale }
                }
                _ => Carrier::Free("scaled torus"),
            }
        }
        Surface::Extrusion { profile, direction } => extrusion(profile, *direction, map),
        Surface::Revolution { profile, origin, axis } => revolution(profile, *origin, *axis, map),
        Surface::Nurbs(nurbs) => planar(nurbs.points(), map).unwrap_or(Carrier::Free("B-spline surface")),
        Surface::Offset { basis, distance } => match offset(basis, *distance) {
            Some(plain) => self::surface(&plain, map),
            None => Carrier::Free("offset surface"),
        },
    }
}

/// The scale of a similarity; `None` for other maps.
pub(crate) fn similarity(map: &DAffine3) -> Option<f64> {
    let m = map.matrix3.transpose() * map.matrix3;
    let square = (m.x_axis.x + m.y_axis.y + m.z_axis.z) / 3.0;
    let off = m - glam::DMat3::from_diagonal(DVec3::splat(square));
    let is_similar = off.to_cols_array().iter().all(|c| c.abs() <= 1e-9 * square);
    (is_similar && square > 0.0).then(|| square.sqrt())
}

fn axis(origin: DVec3, direction: DVec3, map: &DAffine3) -> Option<Axis> {
    let direction = map.transform_vector3(direction).try_normalize()?;
    Some(Axis { origin: map.transform_point3(origin), direction })
}

/// Normals go with the inverse transpose, so that they stay square to the plane and on their side of it.
pub(crate) fn map_normal(normal: DVec3, map: &DAffine3) -> Option<DVec3> {
    (map.matrix3.inverse().transpose() * normal).try_normalize()
}

fn plane(origin: DVec3, normal: DVec3, map: &DAffine3) -> Carrier {
    match map_normal(normal, map) {
        Some(normal) => Carrier::Plane { origin: map.transform_point3(origin), normal },
        None => Carrier::Free("plane"),
    }
}

/// A cylinder over the ellipse with the given conjugate semi-diameters.
fn cylinder(origin: DVec3, along: DVec3, section: [DVec3; 2], map: &DAffine3) -> Carrier {
    let Some(axis) = axis(origin, along, map) else { return Carrier::Free("cylinder") };
    let [a, b] = section.map(|v| map.transform_vector3(v).reject_from_normalized(axis.direction));
    let [major, minor] = semi_axes(a, b);
    if major - minor <= SHAPE * major {
        Carrier::Cylinder { axis, radius: (major + minor) * 0.5 }
    } else {
        Carrier::EllipticCylinder { axis, major, minor }
    }
}

fn cone(frame: &Frame, radius: f64, half_angle_rad: f64, map: &DAffine3) -> Carrier {
    let apex = frame.origin - frame.z * (radius / half_angle_rad.tan());
    match (similarity(map), axis(frame.origin, frame.z, map)) {
        (Some(_), Some(axis)) if apex.is_finite() => {
            Carrier::Cone { axis, apex: map.transform_point3(apex), half_angle_rad: half_angle_rad.abs() }
        }
        _ => Carrier::Free("scaled cone"),
    }
}

fn extrusion(profile: &Curve, direction: DVec3, map: &DAffine3) -> Carrier {
    match curve(profile, profile.domain(), &DAffine3::IDENTITY) {
        Carrier::Line(line) => match line.direction.cross(direction).try_normalize() {
            Some(normal) => plane(line.origin, normal, map),
            None => Carrier::Free("extruded surface"),
        },
        Carrier::Circle { center, normal, radius } => {
            let (x, y) = normal.any_orthonormal_pair();
            cylinder(center, direction, [x * radius, y * radius], map)
        }
        _ => Carrier::Free("extruded surface"),
    }
}

fn revolution(profile: &Curve, origin: DVec3, along: DVec3, map: &DAffine3) -> Carrier {
    let free = || match (similarity(map), axis(origin, along, map)) {
        (Some(_), Some(axis)) => Carrier::Revolution(axis),
        _ => Carrier::Free("scaled surface of revolution"),
    };
    let flat = |p: DVec3| (p - origin).reject_from_normalized(along);
    match curve(profile, profile.domain(), &DAffine3::IDENTITY) {
        Carrier::Line(line) => {
            let rise = line.direction.dot(along);
            let out = line.direction - along * rise;
            if out.length() <= SHAPE {
                let radius = flat(line.origin).length();
                let (x, y) = along.any_orthonormal_pair();
                return cylinder(origin, along, [x * radius, y * radius], map);
            }
            if rise.abs() <= SHAPE {
                return plane(line.origin, along, map);
            }
            // A line beside the axis makes a hyperboloid, one that meets it a cone.
            let foot = line.origin - line.direction * (flat(line.origin).dot(out) / out.length_squared());
            if flat(foot).length() > SHAPE * (flat(line.origin).length() + foot.distance(line.origin)) {
                return free();
            }
            let frame = Frame::new(foot, along, out);
            cone(&frame, 0.0, (out.length() / rise.abs()).atan(), map)
        }
        Carrier::Circle { center, normal, radius } => {
            let reach = SHAPE * (radius + center.distance(origin));
            let in_plane = normal.dot(along).abs() <= SHAPE && (center - origin).dot(normal).abs() <= reach;
            let major = flat(center).length();
            if !in_plane {
                return free();
            }
            let frame = Frame::new(center - flat(center), along, DVec3::X);
            if major <= reach {
                return surface(&Surface::Sphere { frame, radius }, map);
            }
            surface(&Surface::Torus { frame, major, minor: radius, v_range: None }, map)
        }
        _ => free(),
    }
}

/// The plane that all of a net's points are in.
fn planar(points: &[DVec3], map: &DAffine3) -> Option<Carrier> {
    let first = *points.first()?;
    let farthest = *points.iter().max_by(|a, b| a.distance(first).total_cmp(&b.distance(first)))?;
    let along = (farthest - first).try_normalize()?;
    let off = |p: &DVec3| (*p - first).reject_from_normalized(along).length();
    let widest = *points.iter().max_by(|a, b| off(a).total_cmp(&off(b)))?;
    let normal = (farthest - first).cross(widest - first).try_normalize()?;
    let reach = SHAPE * farthest.distance(first);
    let is_planar = off(&widest) > reach && points.iter().all(|p| (*p - first).dot(normal).abs() <= reach);
    is_planar.then(|| plane(first, normal, map))
}

/// The offset of an elementary surface, which is one as well.
fn offset(basis: &Surface, distance: f64) -> Option<Surface> {
    match *basis {
        Surface::Plane { frame } => {
            Some(Surface::Plane { frame: Frame { origin: frame.origin + frame.z * distance, ..frame } })
        }
        Surface::Cylinder { frame, radius } => Some(Surface::Cylinder { frame, radius: radius + distance }),
        Surface::Cone { frame, radius, half_angle_rad } if half_angle_rad.abs() < FRAC_PI_2 => {
            let radius = radius + distance / half_angle_rad.cos();
            Some(Surface::Cone { frame, radius, half_angle_rad })
        }
        Surface::Sphere { frame, radius } => Some(Surface::Sphere { frame, radius: radius + distance }),
        Surface::Torus { frame, major, minor, v_range } => {
            Some(Surface::Torus { frame, major, minor: minor + distance, v_range })
        }
        _ => None,
    }
}
