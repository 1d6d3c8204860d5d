//! Projection: points on the thing come back, and nothing sampled is nearer than the foot.

mod specimens;

use proptest::prelude::*;
use specimens::{curves, part, surfaces};
use trimloop_geom::{Curve, DVec2, DVec3, Surface};

fn curve_samples(curve: &Curve, count: usize) -> Vec<DVec3> {
    let range = part(curve.domain());
    (0..=count).map(|i| curve.point(range.at(i as f64 / count as f64))).collect()
}

fn surface_samples(surface: &Surface, count: usize) -> Vec<DVec3> {
    let [u, v] = surface.domain().map(part);
    let steps = |r: trimloop_geom::Interval| -> Vec<f64> {
        (0..=count).map(|i| r.at(i as f64 / count as f64)).collect()
    };
    surface.grid(&steps(u), &steps(v))
}

fn nearest(samples: &[DVec3], point: DVec3) -> f64 {
    samples.iter().map(|p| p.distance(point)).fold(f64::INFINITY, f64::min)
}

fn any_point() -> impl Strategy<Value = DVec3> {
    let x = -8.0..12.0;
    (x.clone(), x.clone(), x).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

proptest! {
    #![proptest_config(specimens::cases(200))]

    #[test]
    fn a_point_of_a_curve_comes_back(s in 0.0..=1.0_f64) {
        for curve in curves() {
            let t = part(curve.domain()).at(s);
            let point = curve.point(t);
            let foot = curve.project(point, None);
            prop_assert!(foot.distance <= 1e-10, "{} at {t}: {foot:?}", curve.kind());
            let hinted = curve.project(point, Some(t + 0.01));
            prop_assert!(hinted.distance <= 1e-10, "{} at {t} with hint: {hinted:?}", curve.kind());
            prop_assert!(curve.domain().contains(foot.t));
        }
    }

    #[test]
    fn no_sample_of_a_curve_is_nearer(point in any_point(), hint in 0.0..=1.0_f64) {
        for curve in curves() {
            let best = nearest(&curve_samples(&curve, 400), point);
            let foot = curve.project(point, None);
            prop_assert!(foot.distance <= best + 1e-9, "{}: {foot:?} but {best}", curve.kind());
            let hinted = curve.project(point, Some(part(curve.domain()).at(hint)));
            prop_assert!(hinted.distance <= best + 1e-9, "{} hinted: {hinted:?} but {best}", curve.kind());
        }
    }

    #[test]
    fn a_point_of_a_surface_comes_back(s in 0.0..=1.0_f64, t in 0.0..=1.0_f64) {
        for surface in surfaces() {
            let [u, v] = surface.domain().map(part);
            let uv = DVec2::new(u.at(s), v.at(t));
            let point = surface.point(uv);
            let foot = surface.project(point, None);
            prop_assert!(foot.distance <= 1e-9, "{} at {uv}: {foot:?}", surface.kind());
            let domain = surface.domain();
            prop_assert!(domain[0].contains(foot.uv.x) && domain[1].contains(foot.uv.y), "{}: {foot:?}", surface.kind());
            let hinted = surface.project(point, Some(uv + DVec2::new(0.01, -0.01)));
            prop_assert!(hinted.distance <= 1e-9, "{} at {uv} with hint: {hinted:?}", surface.kind());
        }
    }

    #[test]
    fn normals_come_with_points_and_with_feet(s in 0.001..0.999_f64, t in 0.001..0.999_f64, away in -0.1..0.1_f64) {
        for surface in surfaces() {
            let [u, v] = surface.domain().map(part);
            let uv = DVec2::new(u.at(s), v.at(t));
            let (point, normal) = surface.point_and_normal(uv);
            prop_assert!(point.distance(surface.point(uv)) <= 1e-12, "{} at {uv}", surface.kind());
            prop_assert_eq!(normal, surface.normal(uv), "{} at {}", surface.kind(), uv);
            let target = point + normal.unwrap_or_default() * away;
            let (foot, normal) = surface.project_with_normal(target, None, 0.0);
            let plain = surface.project(target, None);
            prop_assert_eq!((foot.uv, foot.distance), (plain.uv, plain.distance));
            if let (Some(a), Some(b)) = (normal, surface.normal(foot.uv)) {
                prop_assert!(a.distance(b) <= 1e-9, "{} at {}: {a} {b}", surface.kind(), foot.uv);
            }
        }
    }

    #[test]
    fn hinted_feet_stay_within_half_a_period(s in -3.0..3.0_f64, t in 0.0..=1.0_f64) {
        for surface in surfaces() {
            let ([u, v], periods) = (surface.domain().map(part), surface.periods());
            let uv = DVec2::new(if periods[0].is_some() { u.at(s) } else { u.at(t) }, if periods[1].is_some() { v.at(s) } else { v.at(t) });
            let foot = surface.project(surface.point(uv), Some(uv));
            for d in 0..2 {
                if let Some(period) = periods[d] {
                    prop_assert!((foot.uv[d] - uv[d]).abs() <= 0.5 * period + 1e-9, "{}: {uv} {foot:?}", surface.kind());
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(specimens::cases(40))]

    // Far off a wavy surface two valleys may be all but equally near; that the other one is up to 1 % nearer may
    // remain unseen.
    #[test]
    fn no_sample_of_a_surface_is_nearer(point in any_point(), s in 0.0..=1.0_f64, t in 0.0..=1.0_f64) {
        for (index, surface) in surfaces().iter().enumerate() {
            let best = nearest(&surface_samples(surface, 60), point);
            let foot = surface.project(point, None);
            prop_assert!(foot.distance <= 1.01 * best + 1e-9, "{index} {}: {foot:?} but {best}", surface.kind());
            let [u, v] = surface.domain().map(part);
            let hinted = surface.project(point, Some(DVec2::new(u.at(s), v.at(t))));
            prop_assert!(hinted.distance <= 1.01 * best + 1e-9, "{index} {} hinted: {hinted:?} but {best}", surface.kind());
        }
    }
}

#[test]
fn what_is_near_enough_need_not_be_nearest() {
    // A sheet bent to a hairpin, 1 between its legs.
    let bend = [[0.0, 0.0], [4.0, 0.0], [8.0, 0.5], [4.0, 1.0], [0.0, 1.0]];
    let points = bend.iter().flat_map(|&[x, y]| [0.0, 3.0].map(|z| DVec3::new(x, y, z)));
    let knots = [vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0], vec![0.0, 0.0, 1.0, 1.0]];
    let sheet = trimloop_geom::NurbsSurface::new([2, 1], 5, 2, points.collect(), Vec::new(), knots);
    let surface = Surface::Nurbs(sheet.expect("a sheet"));
    let target = DVec3::new(0.5, 0.4, 1.5);
    let upper = Some(DVec2::new(2.9, 0.5));
    let near = |enough| surface.project_with_normal(target, upper, enough).0;
    assert!((near(0.7).distance - 0.6).abs() < 0.02, "{:?}", near(0.7));
    assert!((near(0.5).distance - 0.4).abs() < 0.02, "{:?}", near(0.5));
    assert_eq!(near(0.0).distance, surface.project(target, upper).distance);
}
