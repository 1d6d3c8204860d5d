//! Images of curves.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::{CompositeCurve, CompositeSegment, Curve, OffsetCurve, Polyline};
use crate::Frame;

impl Curve {
    /// The curve's image; any affine map for splines, lines and polylines; similarity (rotation, uniform scale,
    /// mirror) for the rest.
    ///
    /// The parametrization stays: `transformed(t) = map(self(t))`. A spline that the map would send beyond f64 stays
    /// as it is.
    pub fn transformed(&self, map: &DAffine3) -> Self {
        let scale = scale_of(map);
        match self {
            Self::Line { origin, direction } => Self::Line {
                origin: map.transform_point3(*origin),
                direction: map.transform_vector3(*direction),
            },
            Self::Circle { frame, radius } => {
                Self::Circle { frame: flat_frame(frame, map), radius: radius * scale }
            }
            Self::Ellipse { frame, major, minor } => {
                Self::Ellipse { frame: flat_frame(frame, map), major: major * scale, minor: minor * scale }
            }
            Self::Parabola { frame, focal } => {
                Self::Parabola { frame: flat_frame(frame, map), focal: focal * scale }
            }
            Self::Hyperbola { frame, major, minor } => {
                Self::Hyperbola { frame: flat_frame(frame, map), major: major * scale, minor: minor * scale }
            }
            Self::Polyline(polyline) => {
                let points = polyline.points.iter().map(|&p| map.transform_point3(p)).collect();
                Self::Polyline(Polyline { points })
            }
            Self::Nurbs(nurbs) => Self::Nurbs(nurbs.transformed(map).unwrap_or_else(|_| nurbs.clone())),
            Self::Offset(offset) => Self::Offset(Box::new(offset.transformed(map, scale))),
            Self::Composite(composite) => {
                let moved = |s: &CompositeSegment| CompositeSegment { curve: s.curve.transformed(map), ..*s };
                Self::Composite(CompositeCurve { segments: composite.segments.iter().map(moved).collect() })
            }
            Self::OnSurface { surface, pcurve } => {
                let parameters = surface.parameter_map(map);
                let (surface, _) = surface.transformed(map);
                let pcurve = pcurve.stretched(DVec3::new(parameters[0], parameters[1], 1.0));
                Self::OnSurface { surface: Arc::new(surface), pcurve: Arc::new(pcurve) }
            }
        }
    }

    /// A pcurve's image under different scales along u and v; a conic becomes a spline where it must.
    fn stretched(&self, scale: DVec3) -> Self {
        let map = DAffine3::from_scale(scale);
        let similar = scale.x.abs() == scale.y.abs();
        let affine = matches!(self, Self::Line { .. } | Self::Polyline(_) | Self::Nurbs(_));
        if similar && scale.x.abs() == 1.0 || affine {
            return self.transformed(&map);
        }
        if similar {
            // The third axis carries nothing; with the same scale there the map is a similarity.
            return self.transformed(&DAffine3::from_scale(DVec3::new(scale.x, scale.y, scale.x.abs())));
        }
        match self.to_nurbs(self.domain()) {
            Some(nurbs) => Self::Nurbs(nurbs).transformed(&map),
            None => self.transformed(&map),
        }
    }
}

impl OffsetCurve {
    /// A mirror turns cross products over, which the reference direction makes good.
    fn transformed(&self, map: &DAffine3, scale: f64) -> Self {
        let hand = map.matrix3.determinant().signum();
        Self {
            basis: self.basis.transformed(map),
            distance: self.distance * scale,
            ref_direction: map.transform_vector3(self.ref_direction) * (hand / scale),
        }
    }
}

/// The uniform scale of a similarity.
pub(crate) fn scale_of(map: &DAffine3) -> f64 {
    let DMat3 { x_axis, .. } = map.matrix3;
    let volume = map.matrix3.determinant().abs().cbrt();
    // A rotation's determinant is 1 only within rounding; its own scale should be exactly 1.
    if (volume - 1.0).abs() <= 1e-14 && (x_axis.length() - 1.0).abs() <= 1e-14 { 1.0 } else { volume }
}

/// The image of a frame's x and y; z becomes square to them, on whichever side makes the frame right-handed.
pub(crate) fn flat_frame(frame: &Frame, map: &DAffine3) -> Frame {
    let [x, y] = [frame.x, frame.y].map(|axis| map.transform_vector3(axis));
    Frame::new(map.transform_point3(frame.origin), x.cross(y), x)
}
