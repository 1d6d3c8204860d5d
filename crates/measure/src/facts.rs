//! What one item is.

use glam::DVec3;
use trimloop_brep::FaceGeometry;
use trimloop_geom::{DVec2, Surface};

use crate::carrier::{Axis, Carrier, map_normal};
use crate::{Item, area, length};

/// Facts of one item: world coordinates, millimetres, degrees. What does not apply is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// What it is: `vertex`, `line`, `circle`, `ellipse`, `B-spline curve`, …, `plane`, `cylinder`, `cone`, `sphere`,
    /// `torus`, `B-spline surface`, …, `triangles`, `unreadable`. Extruded and turned lines and circles, offsets of
    /// elementary surfaces, and splines whose control points are in a line or plane go by what they are. Under an
    /// instance that is not scaled evenly a circle is an `ellipse`, a sphere an `ellipsoid`, and so on.
    pub kind: String,
    /// A vertex' place; the centre of a circle, an ellipse, a sphere, a torus; a cone's apex.
    pub position: Option<DVec3>,
    /// The length of an edge, to 1e-10 of itself (exact for lines); the perimeter of a face: all of its edges' lengths,
    /// seams left out.
    pub length_mm: Option<f64>,
    /// The area of a face inside its trims, by integration over the exact surface, to about 1e-9 of itself.
    pub area_mm2: Option<f64>,
    /// The radius of a circle, a cylinder, a sphere; a torus' larger one; the larger semi-axis of an ellipse.
    pub radius_mm: Option<f64>,
    /// A torus' tube; the smaller semi-axis of an ellipse.
    pub minor_radius_mm: Option<f64>,
    /// Between a cone's axis and its side.
    pub half_angle_deg: Option<f64>,
    /// The axis of what turns about one; for circles and ellipses through the centre, square to their plane; for lines
    /// the line itself, from its start on.
    pub axis: Option<Axis>,
    /// A plane's unit normal, outwards as the face is oriented.
    pub normal: Option<DVec3>,
    /// Where an edge starts and where it ends; equal where it closes on itself.
    pub ends: Option<[DVec3; 2]>,
    /// The angle that a piece of a circle spans, 360 for whole ones.
    pub arc_angle_deg: Option<f64>,
}

/// What an item is.
pub fn facts(item: Item) -> Facts {
    let Some(carrier) = Carrier::of(&item) else {
        return Facts { kind: "unreadable".into(), ..Facts::default() };
    };
    let mut out = of_carrier(&carrier);
    if let Some(edge) = item.edge() {
        out.length_mm = finite(length::edge_length(edge, &item.transform));
        out.ends = item.vertex_point(edge.start).zip(item.vertex_point(edge.end)).map(|(a, b)| [a, b]);
        if let (Carrier::Circle { radius, .. }, Some(length)) = (&carrier, out.length_mm) {
            out.arc_angle_deg = finite((length / radius).to_degrees());
        }
        if let (Carrier::Line(axis), Some([start, end])) = (&carrier, out.ends) {
            let direction =
                if (end - start).dot(axis.direction) < 0.0 { -axis.direction } else { axis.direction };
            out.axis = Some(Axis { origin: start, direction });
        }
    }
    if let Some(face) = item.face() {
        out.length_mm = finite(length::perimeter(item.part, face, &item.transform)).filter(|&l| l > 0.0);
        out.area_mm2 = area::face_area(&item);
        if let (Carrier::Plane { normal, .. }, FaceGeometry::Surface(surface)) = (&carrier, &face.geometry) {
            let is_outward =
                is_along(&item, surface, *normal) == (face.same_sense != item.is_used_backwards());
            out.normal = Some(if is_outward { *normal } else { -*normal });
        }
    }
    out
}

/// Whether a plane's normal is on the side of the surface's own.
fn is_along(item: &Item, surface: &Surface, normal: DVec3) -> bool {
    let at = surface.domain().map(|d| if d.is_finite() { d.at(0.5) } else { 0.0 });
    let own = surface.normal(DVec2::from(at)).and_then(|own| map_normal(own, &item.transform));
    own.is_none_or(|own| own.dot(normal) >= 0.0)
}

fn of_carrier(carrier: &Carrier) -> Facts {
    let mut out = Facts { kind: carrier.kind().into(), position: carrier.center(), ..Facts::default() };
    out.axis = carrier.axis();
    match *carrier {
        Carrier::Point(point) => out.position = Some(point),
        Carrier::Line(axis) => out.axis = Some(axis),
        Carrier::Circle { radius, .. }
        | Carrier::Cylinder { radius, .. }
        | Carrier::Sphere { radius, .. } => {
            out.radius_mm = Some(radius);
        }
        Carrier::Ellipse { major, minor, .. }
        | Carrier::EllipticCylinder { major, minor, .. }
        | Carrier::Torus { major, minor, .. } => {
            (out.radius_mm, out.minor_radius_mm) = (Some(major), Some(minor));
        }
        Carrier::Cone { apex, half_angle_rad, .. } => {
            (out.position, out.half_angle_deg) = (Some(apex), Some(half_angle_rad.to_degrees()));
        }
        Carrier::Plane { .. } | Carrier::Revolution(_) | Carrier::Free(_) => {}
    }
    out
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
