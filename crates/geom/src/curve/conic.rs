//! Circles, ellipses, parabolas and hyperbolas in their own frame.

use glam::DVec3;

use crate::{Curve, Frame};

/// Point, first and second derivative of a conic; of any other curve, nothing.
pub(super) fn derivatives(curve: &Curve, t: f64) -> [DVec3; 3] {
    let (frame, local) = match *curve {
        Curve::Circle { frame, radius } => (frame, ellipse(radius, radius, t)),
        Curve::Ellipse { frame, major, minor } => (frame, ellipse(major, minor, t)),
        Curve::Parabola { frame, focal } => (frame, parabola(focal, t)),
        Curve::Hyperbola { frame, major, minor } => (frame, hyperbola(major, minor, t)),
        _ => return [DVec3::ZERO; 3],
    };
    place(&frame, local)
}

fn place(frame: &Frame, [p, d, dd]: [[f64; 2]; 3]) -> [DVec3; 3] {
    let vector = |[x, y]: [f64; 2]| frame.x * x + frame.y * y;
    [frame.origin + vector(p), vector(d), vector(dd)]
}

fn ellipse(major: f64, minor: f64, t: f64) -> [[f64; 2]; 3] {
    let (sin, cos) = t.sin_cos();
    let (x, y) = (major * cos, minor * sin);
    [[x, y], [-major * sin, minor * cos], [-x, -y]]
}

fn parabola(focal: f64, t: f64) -> [[f64; 2]; 3] {
    [[focal * t * t, 2.0 * focal * t], [2.0 * focal * t, 2.0 * focal], [2.0 * focal, 0.0]]
}

fn hyperbola(major: f64, minor: f64, t: f64) -> [[f64; 2]; 3] {
    let (x, y) = (major * t.cosh(), minor * t.sinh());
    [[x, y], [major * t.sinh(), minor * t.cosh()], [x, y]]
}
