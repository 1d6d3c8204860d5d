//! One or more of every kind of curve and surface, in general position.
#![allow(dead_code, reason = "each test file uses its own share")]

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use proptest::test_runner::{Config as ProptestConfig, RngSeed};
use trimloop_geom::{
    CompositeCurve, CompositeSegment, Curve, DVec3, Frame, Interval, NurbsCurve, NurbsSurface, OffsetCurve,
    Polyline, Surface,
};

/// The same `count` random cases on every run.
pub fn cases(count: u32) -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(42);
    ProptestConfig { failure_persistence: None, rng_seed, ..ProptestConfig::with_cases(count) }
}

pub fn frame() -> Frame {
    Frame::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.3, 0.2, 0.9), DVec3::new(0.8, -0.5, 0.1))
}

/// Clamped knots with `spans` equal spans over [0, 1].
pub fn knots(degree: usize, spans: usize) -> Vec<f64> {
    let inner = (1..spans).map(|i| i as f64 / spans as f64);
    [vec![0.0; degree + 1], inner.collect(), vec![1.0; degree + 1]].concat()
}

/// A number in [-1, 1] that looks random but is always the same.
pub fn noise(seed: usize) -> f64 {
    ((seed as f64 * 12.9898).sin() * 43758.5453).fract()
}

pub fn spline(degree: usize, spans: usize, rational: bool) -> NurbsCurve {
    let count = degree + spans;
    let points =
        (0..count).map(|i| DVec3::new(i as f64 * 2.0, 3.0 * noise(i), 2.0 * noise(i + 100))).collect();
    let weights = if rational { (0..count).map(|i| 1.5 + noise(i + 7)).collect() } else { vec![] };
    NurbsCurve::new(degree, points, weights, knots(degree, spans)).unwrap()
}

/// A closed spline on unclamped uniform knots.
pub fn closed_spline() -> NurbsCurve {
    let ring: Vec<DVec3> = (0..8)
        .map(|i| {
            let a = TAU * f64::from(i) / 8.0;
            DVec3::new(4.0 * a.cos(), 3.0 * a.sin(), 0.7 * (2.0 * a).sin())
        })
        .collect();
    let points = (0..11).map(|i| ring[i % 8]).collect();
    NurbsCurve::new(3, points, vec![], (0..15).map(f64::from).collect()).unwrap()
}

pub fn sheet(degrees: [usize; 2], spans: [usize; 2], rational: bool) -> NurbsSurface {
    let [rows, columns] = [degrees[0] + spans[0], degrees[1] + spans[1]];
    let mut points = Vec::new();
    let mut weights = Vec::new();
    for i in 0..rows {
        for j in 0..columns {
            let seed = i * 31 + j;
            points.push(DVec3::new(2.0 * i as f64, 2.5 * j as f64, 1.2 * noise(seed)));
            weights.push(1.5 + noise(seed + 1000));
        }
    }
    let weights = if rational { weights } else { vec![] };
    let knots = [knots(degrees[0], spans[0]), knots(degrees[1], spans[1])];
    NurbsSurface::new(degrees, rows, columns, points, weights, knots).unwrap()
}

/// A closed tube whose lower end is a point.
pub fn tube() -> NurbsSurface {
    let sphere = Surface::Sphere { frame: frame(), radius: 3.0 };
    sphere.to_nurbs([Interval::new(0.0, TAU), Interval::new(-0.5 * PI, 0.7)]).unwrap()
}

pub fn curves() -> Vec<Curve> {
    let frame = frame();
    let line = Curve::Line { origin: DVec3::new(1.0, 2.0, 3.0), direction: DVec3::new(0.5, -1.0, 2.0) };
    let circle = Curve::Circle { frame, radius: 2.5 };
    let ellipse = Curve::Ellipse { frame, major: 2.0, minor: 3.5 };
    let parabola = Curve::Parabola { frame, focal: 0.8 };
    let polyline = Polyline {
        points: vec![
            DVec3::ZERO,
            DVec3::new(1.0, 2.0, 0.0),
            DVec3::new(3.0, 1.0, 1.0),
            DVec3::new(4.0, 4.0, 0.0),
        ],
    };
    let segment = |curve: &Curve, start, end, reversed| CompositeSegment {
        curve: curve.clone(),
        range: Interval::new(start, end),
        reversed,
    };
    let composite = CompositeCurve {
        segments: vec![
            segment(&circle, 0.3, 2.0, true),
            segment(&line, -1.0, 0.5, false),
            segment(&Curve::Nurbs(spline(3, 3, true)), 0.1, 0.9, false),
            segment(&parabola, -1.0, 1.5, false),
        ],
    };
    let offset = |basis: Curve| {
        Curve::Offset(Box::new(OffsetCurve {
            basis,
            distance: 0.4,
            ref_direction: DVec3::new(0.1, 0.2, 1.0),
        }))
    };
    let on_surface = Curve::OnSurface {
        surface: Arc::new(Surface::Torus { frame, major: 5.0, minor: 2.0, v_range: None }),
        pcurve: Arc::new(Curve::Nurbs(
            NurbsCurve::new(
                2,
                vec![DVec3::new(0.1, 0.2, 0.0), DVec3::new(1.0, 1.5, 0.0), DVec3::new(2.0, 0.5, 0.0)],
                vec![],
                knots(2, 1),
            )
            .unwrap(),
        )),
    };
    vec![
        line.clone(),
        circle.clone(),
        ellipse,
        parabola,
        Curve::Hyperbola { frame, major: 1.5, minor: 0.7 },
        Curve::Polyline(polyline),
        Curve::Nurbs(spline(1, 4, false)),
        Curve::Nurbs(spline(2, 3, true)),
        Curve::Nurbs(spline(3, 5, false)),
        Curve::Nurbs(spline(7, 3, true)),
        Curve::Nurbs(spline(35, 2, false)),
        Curve::Nurbs(closed_spline()),
        offset(circle),
        offset(Curve::Nurbs(spline(4, 3, false))),
        Curve::Composite(composite),
        on_surface,
    ]
}

/// A finite part of a domain.
pub fn part(domain: Interval) -> Interval {
    if domain.is_finite() { domain } else { Interval::new(domain.start.max(-2.0), domain.end.min(2.0)) }
}

pub fn surfaces() -> Vec<Surface> {
    let frame = frame();
    let arc = |curve: Curve| Arc::new(curve);
    let profile = Curve::Nurbs(spline(3, 4, true));
    let axis = DVec3::new(0.1, 0.9, 0.2).normalize();
    let origin = DVec3::new(-3.0, -8.0, 1.0);
    let sheet_surface = Surface::Nurbs(sheet([3, 3], [4, 3], false));
    vec![
        Surface::Plane { frame },
        Surface::Cylinder { frame, radius: 2.0 },
        Surface::Cone { frame, radius: 2.0, half_angle_rad: 0.4 },
        Surface::Cone { frame, radius: 0.0, half_angle_rad: -0.7 },
        Surface::Sphere { frame, radius: 3.0 },
        Surface::Torus { frame, major: 4.0, minor: 1.5, v_range: None },
        apple(),
        lemon(),
        Surface::Extrusion { profile: arc(profile.clone()), direction: DVec3::new(0.3, 0.4, 1.5) },
        Surface::Extrusion {
            profile: arc(Curve::Ellipse { frame, major: 2.0, minor: 1.0 }),
            direction: frame.z * 2.0,
        },
        Surface::Extrusion {
            profile: arc(Curve::Circle { frame, radius: 2.0 }),
            direction: DVec3::new(1.0, 0.3, 0.5),
        },
        Surface::Extrusion {
            profile: arc(Curve::Line { origin, direction: DVec3::X }),
            direction: DVec3::new(1.0, 2.0, 0.0),
        },
        Surface::Revolution { profile: arc(profile), origin, axis },
        // A cylinder's line, a cone's line, a hyperboloid's line.
        Surface::Revolution {
            profile: arc(Curve::Line { origin: DVec3::X, direction: axis * 2.0 }),
            origin,
            axis,
        },
        Surface::Revolution {
            profile: arc(Curve::Line { origin: origin + axis, direction: DVec3::new(1.0, 1.0, 0.0) }),
            origin,
            axis,
        },
        Surface::Revolution {
            profile: arc(Curve::Line { origin: DVec3::ZERO, direction: DVec3::new(1.0, 1.0, 0.5) }),
            origin,
            axis,
        },
        Surface::Revolution {
            profile: arc(Curve::Circle {
                frame: Frame::new(
                    origin + axis.any_orthonormal_vector() * 5.0,
                    axis.any_orthonormal_vector().cross(axis),
                    axis,
                ),
                radius: 2.0,
            }),
            origin,
            axis,
        },
        sheet_surface.clone(),
        Surface::Nurbs(sheet([1, 2], [3, 3], true)),
        Surface::Nurbs(sheet([5, 4], [2, 3], true)),
        Surface::Nurbs(sheet([9, 9], [1, 2], false)),
        Surface::Nurbs(tube()),
        Surface::Offset { basis: arc_surface(sheet_surface), distance: 0.3 },
        Surface::Offset { basis: arc_surface(Surface::Nurbs(tube())), distance: -0.5 },
        Surface::Offset {
            basis: arc_surface(Surface::Torus { frame, major: 4.0, minor: 1.5, v_range: None }),
            distance: 0.5,
        },
    ]
}

fn arc_surface(surface: Surface) -> Arc<Surface> {
    Arc::new(surface)
}

/// The outer part of a self-intersecting torus.
pub fn apple() -> Surface {
    let half = (-0.5_f64).acos();
    Surface::Torus { frame: frame(), major: 1.0, minor: 2.0, v_range: Some(Interval::new(-half, half)) }
}

/// Its inner part.
pub fn lemon() -> Surface {
    let half = (-0.5_f64).acos();
    Surface::Torus { frame: frame(), major: 1.0, minor: 2.0, v_range: Some(Interval::new(half, TAU - half)) }
}
