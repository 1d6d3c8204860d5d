//! Numbers that make no sense give results that make none, but no panic and no endless loop.

mod specimens;

use std::f64::consts::TAU;
use std::sync::Arc;

use specimens::{curves, frame, surfaces};
use trimloop_geom::{
    CompositeCurve, Curve, DAffine3, DVec2, DVec3, Direction, Frame, Interval, NurbsCurve, NurbsSurface,
    Polyline, Surface,
};

const STRANGE: [f64; 8] = [0.0, -1.0, 1e308, -1e308, 1e-308, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn exercise_curve(curve: &Curve) {
    let _ = (curve.domain(), curve.period());
    for t in STRANGE {
        let _ = (curve.point(t), curve.derivatives(t));
        for hint in [None, Some(t), Some(0.5)] {
            let _ = curve.project(DVec3::new(t, 1.0, -t), hint);
        }
        for range in [Interval::new(0.0, t), Interval::new(t, 1.0), Interval::new(-1.0, 1.0)] {
            let _ = (curve.bounds(range), curve.to_nurbs(range), curve.breakpoints(range));
            let _ = curve.project_within(DVec3::splat(t), range, None);
        }
        let _ = curve.transformed(&DAffine3::from_scale(DVec3::splat(t)));
    }
}

fn exercise_surface(surface: &Surface) {
    let _ = (surface.domain(), surface.periods(), surface.singularities());
    for s in STRANGE {
        for t in STRANGE {
            let uv = DVec2::new(s, t);
            let _ = (surface.point(uv), surface.derivatives(uv), surface.normal(uv));
        }
        let uv = DVec2::new(s, 0.3);
        for hint in [None, Some(uv), Some(DVec2::splat(0.2))] {
            let _ = surface.project(DVec3::new(1.0, s, -s), hint);
        }
        let domain = [Interval::new(0.0, s), Interval::new(s, 1.0)];
        let _ = (surface.bounds(domain), surface.to_nurbs(domain));
        let _ = (surface.breakpoints(Direction::U, domain[0]), surface.breakpoints(Direction::V, domain[1]));
        let _ = surface.transformed(&DAffine3::from_scale(DVec3::splat(s)));
    }
}

#[test]
fn strange_parameters_and_points() {
    curves().iter().for_each(exercise_curve);
    surfaces().iter().for_each(exercise_surface);
}

#[test]
fn strange_sizes_of_curves() {
    let frame = frame();
    for size in STRANGE {
        for other in [1.0, size] {
            exercise_curve(&Curve::Circle { frame, radius: size });
            exercise_curve(&Curve::Ellipse { frame, major: size, minor: other });
            exercise_curve(&Curve::Parabola { frame, focal: size });
            exercise_curve(&Curve::Hyperbola { frame, major: size, minor: other });
        }
        exercise_curve(&Curve::Line { origin: DVec3::splat(size), direction: DVec3::splat(size) });
        exercise_curve(&Curve::Polyline(Polyline { points: vec![DVec3::splat(size); 4] }));
    }
    exercise_curve(&Curve::Polyline(Polyline { points: vec![] }));
    exercise_curve(&Curve::Polyline(Polyline { points: vec![DVec3::X] }));
    exercise_curve(&Curve::Composite(CompositeCurve { segments: vec![] }));
}

#[test]
fn strange_sizes_of_surfaces() {
    let frame = frame();
    let range = |v: f64| Some(Interval::new(-v, v));
    for size in STRANGE {
        let profile = Arc::new(Curve::Circle { frame, radius: size });
        let line = Arc::new(Curve::Line { origin: DVec3::ZERO, direction: DVec3::splat(size) });
        let surfaces = [
            Surface::Cylinder { frame, radius: size },
            Surface::Cone { frame, radius: size, half_angle_rad: 0.4 },
            Surface::Cone { frame, radius: 1.0, half_angle_rad: size },
            Surface::Sphere { frame, radius: size },
            Surface::Torus { frame, major: size, minor: 1.0, v_range: None },
            Surface::Torus { frame, major: 1.0, minor: size, v_range: range(size) },
            Surface::Extrusion { profile: profile.clone(), direction: DVec3::splat(size) },
            Surface::Extrusion { profile: line.clone(), direction: DVec3::splat(1.0) },
            Surface::Revolution { profile: profile.clone(), origin: DVec3::ZERO, axis: DVec3::splat(size) },
            Surface::Revolution { profile: line, origin: DVec3::X, axis: DVec3::Z },
        ];
        for surface in surfaces {
            exercise_surface(&surface);
            exercise_surface(&Surface::Offset { basis: Arc::new(surface), distance: size });
        }
    }
    let broken = Frame { origin: DVec3::NAN, x: DVec3::ZERO, y: DVec3::NAN, z: DVec3::splat(1e308) };
    exercise_surface(&Surface::Plane { frame: broken });
    exercise_surface(&Surface::Sphere { frame: broken, radius: 1.0 });
}

#[test]
fn splines_of_huge_or_coinciding_points() {
    for point in [DVec3::ZERO, DVec3::splat(1e308), DVec3::splat(1e-308)] {
        let points = vec![point, -point, point, point];
        let curve = NurbsCurve::new(3, points.clone(), vec![], specimens::knots(3, 1)).unwrap();
        exercise_curve(&Curve::Nurbs(curve));
        let knots = [specimens::knots(1, 1), specimens::knots(1, 1)];
        let surface = NurbsSurface::new([1, 1], 2, 2, points, vec![1e-300, 1e300, 1.0, 1.0], knots).unwrap();
        exercise_surface(&Surface::Nurbs(surface));
    }
}

#[test]
fn a_knot_vector_over_tiny_and_huge_spans() {
    let knots = vec![0.0, 0.0, 1e-300, 1e-17, 1.0, 1e300, 1e300];
    let points = (0..5).map(|i| DVec3::new(f64::from(i), 0.0, 0.0)).collect();
    exercise_curve(&Curve::Nurbs(NurbsCurve::new(1, points, vec![], knots).unwrap()));
}

#[test]
fn very_many_control_points_of_the_highest_degree() {
    let count = 100_000;
    let point = |i: usize| DVec3::new((i % 7) as f64, (i % 3) as f64, i as f64 / count as f64);
    let knots = (0..count + 128).map(|i| i as f64).collect();
    let curve = Curve::Nurbs(NurbsCurve::new(127, (0..count).map(point).collect(), vec![], knots).unwrap());
    assert!(curve.project(DVec3::ZERO, None).distance < 10.0);
    assert!(!curve.bounds(curve.domain()).is_empty());
}

#[test]
fn a_range_of_very_many_periods() {
    let curve = Curve::Nurbs(specimens::closed_spline());
    let found = curve.breakpoints(Interval::new(0.0, 1e15));
    assert!(found.len() < 20_000 && found.is_sorted());
    let circle = Curve::Circle { frame: frame(), radius: 1.0 };
    assert!(circle.to_nurbs(Interval::new(0.0, 1e9 * TAU)).is_none());
}
