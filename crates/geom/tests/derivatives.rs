//! Derivatives against central differences, and normals against derivatives, for every kind.

mod specimens;

use specimens::{curves, part, surfaces};
use trimloop_geom::{DVec2, DVec3, Interval, Surface};

fn assert_near(got: DVec3, expected: DVec3, tolerance: f64, what: &str) {
    let scale = 1.0 + expected.length();
    assert!(got.distance(expected) <= tolerance * scale, "{what}: {got} is not {expected}");
}

fn inner(interval: Interval, s: f64) -> f64 {
    part(interval).at(s)
}

#[test]
fn curve_derivatives_are_the_limits_of_differences() {
    for curve in curves() {
        for s in [0.03, 0.21, 0.47, 0.613, 0.89, 0.97] {
            let t = inner(curve.domain(), s);
            let h = 1e-5 * part(curve.domain()).length();
            let [p, d, dd] = curve.derivatives(t);
            let what = format!("{} at {t}", curve.kind());
            assert_eq!(p, curve.point(t), "{what}");
            let first = (curve.point(t + h) - curve.point(t - h)) / (2.0 * h);
            assert_near(d, first, 1e-6, &what);
            let second = (curve.derivatives(t + h)[1] - curve.derivatives(t - h)[1]) / (2.0 * h);
            assert_near(dd, second, 1e-4, &what);
        }
    }
}

#[test]
fn surface_derivatives_are_the_limits_of_differences() {
    for surface in surfaces() {
        let domain = surface.domain();
        for (s, t) in [(0.07, 0.31), (0.53, 0.41), (0.87, 0.93), (0.29, 0.13)] {
            let uv = DVec2::new(inner(domain[0], s), inner(domain[1], t));
            let at = surface.derivatives(uv);
            let what = format!("{} at {uv}", surface.kind());
            assert_near(surface.point(uv), at.point, 1e-13, &what);
            let h = 1e-5;
            let step = [
                DVec2::new(h * part(domain[0]).length(), 0.0),
                DVec2::new(0.0, h * part(domain[1]).length()),
            ];
            let slope = |f: &dyn Fn(DVec2) -> DVec3, d: usize| {
                (f(uv + step[d]) - f(uv - step[d])) / (2.0 * step[d].length())
            };
            assert_near(at.du, slope(&|q| surface.point(q), 0), 1e-6, &what);
            assert_near(at.dv, slope(&|q| surface.point(q), 1), 1e-6, &what);
            let first = surface.first_derivatives(uv);
            assert_near(first.du, at.du, 1e-13, &what);
            assert_near(first.dv, at.dv, 1e-13, &what);
            assert_near(at.duu, slope(&|q| surface.derivatives(q).du, 0), 1e-4, &what);
            assert_near(at.duv, slope(&|q| surface.derivatives(q).du, 1), 1e-4, &what);
            assert_near(at.dvv, slope(&|q| surface.derivatives(q).dv, 1), 1e-4, &what);
        }
    }
}

#[test]
fn normals_are_the_unit_cross_product() {
    for surface in surfaces() {
        let domain = surface.domain();
        for (s, t) in [(0.07, 0.31), (0.53, 0.41), (0.87, 0.93), (0.29, 0.13)] {
            let uv = DVec2::new(inner(domain[0], s), inner(domain[1], t));
            let at = surface.derivatives(uv);
            let normal = surface.normal(uv).unwrap();
            assert_near(normal, at.du.cross(at.dv).normalize(), 1e-9, surface.kind());
        }
    }
}

#[test]
fn normals_at_singular_points_are_limits_from_inside() {
    let mut singular = 0;
    for surface in surfaces() {
        let domain = surface.domain();
        for pole in surface.singularities() {
            let d = pole.constant as usize;
            let length = part(domain[d]).length();
            let inwards = if domain[d].is_finite() && pole.at > domain[d].at(0.5) { -1e-6 } else { 1e-6 };
            let inwards = if let Surface::Cone { half_angle_rad, .. } = surface {
                inwards * half_angle_rad.signum()
            } else {
                inwards
            };
            for s in [0.1, 0.45, 0.8] {
                let mut uv = DVec2::ZERO;
                uv[d] = pole.at;
                uv[1 - d] = part(domain[1 - d]).at(s);
                assert_near(surface.point(uv), pole.point, 1e-8, surface.kind());
                let normal = surface.normal(uv).unwrap();
                uv[d] += inwards * length;
                assert_near(normal, surface.normal(uv).unwrap(), 1e-4, surface.kind());
                singular += 1;
            }
        }
    }
    assert_eq!(singular, 3 * 11, "poles among the specimens");
}

#[test]
fn closed_parameters_wrap() {
    for surface in surfaces() {
        let (domain, periods) = (surface.domain(), surface.periods());
        let uv = DVec2::new(inner(domain[0], 0.31), inner(domain[1], 0.62));
        for d in 0..2 {
            let Some(period) = periods[d] else { continue };
            for turns in [-3.0, 1.0, 2.0] {
                let mut moved = uv;
                moved[d] += turns * period;
                assert_near(surface.point(moved), surface.point(uv), 1e-12, surface.kind());
            }
        }
    }
    for curve in curves() {
        let Some(period) = curve.period() else { continue };
        let t = inner(curve.domain(), 0.3);
        assert_near(curve.point(t - 2.0 * period), curve.point(t), 1e-12, curve.kind());
    }
}

#[test]
fn grids_hold_the_points() {
    for surface in surfaces() {
        let [u, v] = surface.domain().map(part);
        let us: Vec<f64> = (0..5).map(|i| u.at(f64::from(i) / 4.0)).collect();
        let vs: Vec<f64> = (0..4).map(|i| v.at(f64::from(i) / 3.0)).collect();
        let grid = surface.grid(&us, &vs);
        assert_eq!(grid.len(), 20);
        for (i, &u) in us.iter().enumerate() {
            for (j, &v) in vs.iter().enumerate() {
                assert_near(grid[i * 4 + j], surface.point(DVec2::new(u, v)), 1e-13, surface.kind());
            }
        }
    }
}
