//! Images under similarities, boxes, breakpoints.

mod specimens;

use proptest::prelude::*;
use specimens::{curves, part, surfaces};
use trimloop_geom::{Curve, DAffine3, DMat3, DVec2, DVec3, Direction, Interval, Surface};

fn similarity() -> impl Strategy<Value = DAffine3> {
    let angles = (-3.0..3.0_f64, -3.0..3.0_f64, -3.0..3.0_f64);
    (angles, 0.2..5.0_f64, any::<bool>(), -9.0..9.0_f64).prop_map(|((a, b, c), scale, mirror, shift)| {
        let rotation = DMat3::from_rotation_x(a) * DMat3::from_rotation_y(b) * DMat3::from_rotation_z(c);
        let hand = DMat3::from_diagonal(DVec3::new(1.0, 1.0, if mirror { -1.0 } else { 1.0 }));
        DAffine3::from_mat3_translation(rotation * hand * scale, DVec3::new(shift, 1.0, -shift))
    })
}

proptest! {
    #![proptest_config(specimens::cases(100))]

    #[test]
    fn images_of_curves_keep_the_parameter(map in similarity(), s in 0.0..=1.0_f64) {
        for curve in curves() {
            let t = part(curve.domain()).at(s);
            let image = curve.transformed(&map);
            let gap = image.point(t).distance(map.transform_point3(curve.point(t)));
            prop_assert!(gap < 1e-11, "{}: {gap}", curve.kind());
        }
    }

    #[test]
    fn images_of_surfaces_are_where_they_say(map in similarity(), s in 0.0..=1.0_f64, t in 0.0..=1.0_f64) {
        for surface in surfaces() {
            let [u, v] = surface.domain().map(part);
            let uv = DVec2::new(u.at(s), v.at(t));
            let (image, flipped) = surface.transformed(&map);
            let there = surface.transformed_uv(&map, uv);
            let gap = image.point(there).distance(map.transform_point3(surface.point(uv)));
            prop_assert!(gap < 1e-10, "{}: {gap}", surface.kind());
            let (Some(normal), Some(image_normal)) = (surface.normal(uv), image.normal(there)) else { continue };
            let mapped = map.transform_vector3(normal).normalize() * if flipped { -1.0 } else { 1.0 };
            prop_assert!(mapped.distance(image_normal) < 1e-6, "{}: {mapped} {image_normal}", surface.kind());
        }
    }

    #[test]
    fn boxes_hold_curves(a in 0.0..1.0_f64, b in 0.0..1.0_f64) {
        for curve in curves() {
            let range = part(curve.domain());
            let range = Interval::new(range.at(a.min(b)), range.at(a.max(b)));
            let bounds = curve.bounds(range);
            for i in 0..=50 {
                let point = curve.point(range.at(f64::from(i) / 50.0));
                let out = (point - point.clamp(bounds.min, bounds.max)).length();
                prop_assert!(out < 1e-12 * (1.0 + point.length()), "{} by {out}", curve.kind());
            }
        }
    }

    #[test]
    fn boxes_hold_surfaces(a in 0.0..1.0_f64, b in 0.0..1.0_f64, c in 0.0..1.0_f64, d in 0.0..1.0_f64) {
        for surface in surfaces() {
            let [u, v] = surface.domain().map(part);
            let u = Interval::new(u.at(a.min(b)), u.at(a.max(b)));
            let v = Interval::new(v.at(c.min(d)), v.at(c.max(d)));
            let bounds = surface.bounds([u, v]);
            for i in 0..=15 {
                for j in 0..=15 {
                    let point = surface.point(DVec2::new(u.at(f64::from(i) / 15.0), v.at(f64::from(j) / 15.0)));
                    let out = (point - point.clamp(bounds.min, bounds.max)).length();
                    prop_assert!(out < 1e-12 * (1.0 + point.length()), "{} by {out}", surface.kind());
                }
            }
        }
    }
}

#[test]
fn boxes_of_elementary_things_are_exact() {
    for surface in surfaces() {
        if !matches!(surface.kind(), "plane" | "cylinder" | "cone" | "sphere" | "torus") {
            continue;
        }
        let [u, v] = surface.domain().map(part);
        let [u, v] = [Interval::new(u.at(0.1), u.at(0.8)), Interval::new(v.at(0.2), v.at(0.9))];
        let bounds = surface.bounds([u, v]);
        let steps = |r: Interval| -> Vec<f64> { (0..=400).map(|i| r.at(f64::from(i) / 400.0)).collect() };
        let sampled = trimloop_geom::Aabb::from_points(surface.grid(&steps(u), &steps(v)));
        let slack = (bounds.min - sampled.min).abs().max((bounds.max - sampled.max).abs()).max_element();
        assert!(slack < 1e-3, "{}: {slack}", surface.kind());
    }
}

#[test]
fn breakpoints_repeat_with_the_period() {
    let curve = Curve::Nurbs(specimens::closed_spline());
    let domain = curve.domain();
    assert_eq!(curve.breakpoints(domain), [3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0]);
    assert_eq!(curve.breakpoints(Interval::new(9.5, 13.5)), [9.5, 10.0, 11.0, 12.0, 13.0, 13.5]);
    assert_eq!(curve.breakpoints(Interval::new(-1.5, 0.5)), [-1.5, -1.0, 0.0, 0.5]);
    let surface = Surface::Revolution {
        profile: std::sync::Arc::new(curve),
        origin: DVec3::new(20.0, 0.0, 0.0),
        axis: DVec3::Y,
    };
    assert_eq!(surface.breakpoints(Direction::V, Interval::new(10.5, 12.5)), [10.5, 11.0, 12.0, 12.5]);
    assert_eq!(surface.breakpoints(Direction::U, Interval::new(1.0, 9.0)), [1.0, 9.0]);
}

#[test]
fn breakpoints_of_composites_include_the_segments_own() {
    let composite = curves().into_iter().find(|c| c.kind() == "composite").unwrap();
    let found = composite.breakpoints(composite.domain());
    // Four segments; the spline of three spans over [0.1, 0.9] adds its two inner knots.
    let inner = [1.0 / 3.0, 2.0 / 3.0].map(|k| 2.0 + (k - 0.1) / 0.8);
    let expected = [0.0, 1.0, 2.0, inner[0], inner[1], 3.0, 4.0];
    assert_eq!(found.len(), expected.len());
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
}
