//! The NURBS forms of conics and analytic surfaces; areas and lengths in closed form.

mod specimens;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use specimens::{curves, frame, part, surfaces};
use trimloop_geom::{Curve, DVec2, DVec3, Interval, Surface};

fn shares() -> impl Iterator<Item = f64> {
    (0..=30).map(|i| f64::from(i) / 30.0)
}

#[test]
fn spline_forms_lie_on_their_curves() {
    let mut forms = 0;
    for curve in curves() {
        let range = part(curve.domain());
        let range = Interval::new(range.at(0.05), range.at(0.93));
        let Some(spline) = curve.to_nurbs(range) else { continue };
        forms += 1;
        assert_eq!(spline.domain(), range);
        for t in shares().map(|s| range.at(s)) {
            let foot = curve.project_within(spline.point(t), range, Some(t));
            assert!(foot.distance <= 1e-12 * spline.size(), "{} at {t}: {foot:?}", curve.kind());
        }
        for t in [range.start, range.end] {
            assert!(spline.point(t).distance(curve.point(t)) <= 1e-12 * spline.size(), "{}", curve.kind());
        }
    }
    assert_eq!(forms, 13, "all but offsets and curves on surfaces");
}

#[test]
fn polynomial_forms_keep_the_parameter() {
    for curve in curves() {
        if !matches!(curve.kind(), "line" | "parabola" | "polyline" | "nurbs") {
            continue;
        }
        let range = part(curve.domain());
        let spline = curve.to_nurbs(range).unwrap();
        for t in shares().map(|s| range.at(s)) {
            assert!(
                spline.point(t).distance(curve.point(t)) <= 1e-12 * spline.size(),
                "{} at {t}",
                curve.kind()
            );
        }
    }
}

#[test]
fn a_circle_over_several_turns() {
    let circle = Curve::Circle { frame: frame(), radius: 3.0 };
    let spline = circle.to_nurbs(Interval::new(-1.0, 12.0)).unwrap();
    for t in shares().map(|s| -1.0 + 13.0 * s) {
        let gap = spline.point(t).distance(frame().origin) - 3.0;
        assert!(gap.abs() < 1e-14, "{gap}");
    }
}

#[test]
fn spline_forms_lie_on_their_surfaces() {
    for surface in surfaces() {
        let domain = surface.domain().map(part).map(|d| Interval::new(d.at(0.05), d.at(0.9)));
        let Some(spline) = surface.to_nurbs(domain) else {
            assert_eq!(surface.kind(), "offset");
            continue;
        };
        assert_eq!(spline.domain(), domain);
        for u in shares().map(|s| domain[0].at(s)) {
            for v in shares().step_by(3).map(|s| domain[1].at(s)) {
                let foot = surface.project(spline.point(DVec2::new(u, v)), Some(DVec2::new(u, v)));
                assert!(
                    foot.distance <= 1e-12 * (10.0 + spline.size()),
                    "{} at {u} {v}: {foot:?}",
                    surface.kind()
                );
                assert!(foot.uv.distance(DVec2::new(u, v)) < 0.2 * (1.0 + domain[0].length()));
            }
        }
        let corner = DVec2::new(domain[0].end, domain[1].start);
        assert!(spline.point(corner).distance(surface.point(corner)) <= 1e-12 * spline.size());
    }
}

/// Gauss–Legendre with five points on each of `count` parts of the unit interval.
fn quadrature(count: usize) -> Vec<(f64, f64)> {
    let rule = [
        (0.0, 128.0 / 225.0),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let part = 1.0 / count as f64;
    (0..count).flat_map(|i| rule.map(|(x, w)| ((i as f64 + 0.5 + 0.5 * x) * part, 0.5 * w * part))).collect()
}

fn area(surface: &Surface, [u, v]: [Interval; 2]) -> f64 {
    let rule = quadrature(12);
    let mut sum = 0.0;
    for &(s, a) in &rule {
        for &(t, b) in &rule {
            let at = surface.first_derivatives(DVec2::new(u.at(s), v.at(t)));
            sum += a * b * at.du.cross(at.dv).length() * u.length() * v.length();
        }
    }
    sum
}

#[test]
fn areas_in_closed_form() {
    let frame = frame();
    let turn = Interval::new(0.0, TAU);
    let near =
        |got: f64, expected: f64| assert!((got - expected).abs() < 1e-9 * expected, "{got} {expected}");
    let sphere = Surface::Sphere { frame, radius: 3.0 };
    near(area(&sphere, [turn, Interval::new(-FRAC_PI_2, FRAC_PI_2)]), 36.0 * PI);
    let torus = Surface::Torus { frame, major: 5.0, minor: 2.0, v_range: None };
    near(area(&torus, [turn, turn]), 40.0 * PI * PI);
    let cylinder = Surface::Cylinder { frame, radius: 2.0 };
    near(area(&cylinder, [turn, Interval::new(-1.0, 3.0)]), 16.0 * PI);
    // From the apex to radius 3: slant height 5.
    let cone = Surface::Cone { frame, radius: 0.0, half_angle_rad: 0.75_f64.atan() };
    near(area(&cone, [turn, Interval::new(0.0, 4.0)]), 15.0 * PI);
    let ball = sphere.to_nurbs([turn, Interval::new(-FRAC_PI_2, FRAC_PI_2)]).unwrap();
    let mut whole = 0.0;
    for u in ball.distinct_knots(trimloop_geom::Direction::U).windows(2) {
        for v in ball.distinct_knots(trimloop_geom::Direction::V).windows(2) {
            let span = [Interval::new(u[0], u[1]), Interval::new(v[0], v[1])];
            whole += area(&Surface::Nurbs(ball.clone()), span);
        }
    }
    near(whole, 36.0 * PI);
}

#[test]
fn points_as_iso_10303_42_defines_them() {
    let frame = trimloop_geom::Frame::WORLD;
    let (u, v) = (0.7_f64, 0.4_f64);
    let uv = DVec2::new(u, v);
    let out = DVec3::new(u.cos(), u.sin(), 0.0);
    let near = |surface: Surface, expected: DVec3| {
        assert!(surface.point(uv).distance(expected) < 1e-15 * 10.0, "{}", surface.kind());
    };
    near(Surface::Cylinder { frame, radius: 2.0 }, out * 2.0 + DVec3::Z * v);
    let cone = Surface::Cone { frame, radius: 2.0, half_angle_rad: 0.3 };
    near(cone, out * (2.0 + v * 0.3_f64.tan()) + DVec3::Z * v);
    near(Surface::Sphere { frame, radius: 2.0 }, (out * v.cos() + DVec3::Z * v.sin()) * 2.0);
    let torus = Surface::Torus { frame, major: 5.0, minor: 2.0, v_range: None };
    near(torus, out * (5.0 + 2.0 * v.cos()) + DVec3::Z * (2.0 * v.sin()));
    let t = 0.3_f64;
    let hyperbola = Curve::Hyperbola { frame, major: 2.0, minor: 3.0 };
    assert!(hyperbola.point(t).distance(DVec3::new(2.0 * t.cosh(), 3.0 * t.sinh(), 0.0)) < 1e-15);
    let parabola = Curve::Parabola { frame, focal: 2.0 };
    assert!(parabola.point(t).distance(DVec3::new(2.0 * t * t, 4.0 * t, 0.0)) < 1e-15);
}
