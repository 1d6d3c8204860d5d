//! Every backend against f64, on shapes of every kind.

mod specimens;

use specimens::{gpu, sheet, specimens, whole};
use trimloop_geom::{Curve, DVec2, Frame, Interval};
use trimloop_gpu::{Backend, Evaluator, Places, Quantities, Request, Shape, Values};

/// Largest errors of a shape's values.
#[derive(Debug, Default)]
struct Errors {
    /// Distance over the shape's size.
    point: f64,
    /// Degrees.
    normal: f64,
    /// Length over the largest derivative of the same kind.
    first: f64,
    second: f64,
}

fn errors(shape: &Shape, places: &Places, values: &Values) -> Errors {
    let mut errors = Errors::default();
    let exact: Vec<_> = (0..places.len()).map(|k| shape.derivatives(places.uv(k))).collect();
    let largest = |of: fn(&trimloop_geom::Derivatives) -> f64| exact.iter().map(of).fold(1e-30, f64::max);
    let (du, dv) = (largest(|d| d.du.length()), largest(|d| d.dv.length()));
    let (duu, duv, dvv) =
        (largest(|d| d.duu.length()), largest(|d| d.duv.length()), largest(|d| d.dvv.length()));
    for (k, d) in exact.iter().enumerate() {
        errors.point = errors.point.max(values.point(k).distance(d.point) / shape.size());
        let normal = shape.normal(places.uv(k));
        let own = values.normal(k).expect("asked for");
        assert!(own.is_finite(), "normal {own} at {}", places.uv(k));
        // Away from singular points.
        let is_regular = d.du.length() > 1e-2 * du && d.dv.length() > 1e-2 * dv;
        if is_regular && normal.length() > 0.5 {
            assert!((own.length() - 1.0).abs() < 1e-5, "{own} at {}", places.uv(k));
            errors.normal = errors.normal.max(own.cross(normal).length().asin().to_degrees());
            assert!(own.dot(normal) > 0.9, "turned over: {own} for {normal} at {}", places.uv(k));
        }
        let own = values.derivatives(k).expect("asked for");
        errors.first = errors.first.max(own.du.distance(d.du) / du).max(own.dv.distance(d.dv) / dv);
        for (a, b, scale) in [(own.duu, d.duu, duu), (own.duv, d.duv, duv), (own.dvv, d.dvv, dvv)] {
            if scale > 1e-9 * shape.size() {
                errors.second = errors.second.max(a.distance(b) / scale);
            }
        }
    }
    errors
}

fn places_of(shape: &Shape) -> Vec<Places> {
    let [u, v] = shape.domain();
    let scattered = (0..300).map(|k| {
        let k = f64::from(k);
        DVec2::new(u.at((k * 0.754_877_666).fract()), v.at((k * 0.569_840_291).fract()))
    });
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(s, t)| DVec2::new(u.at(s), v.at(t)));
    vec![
        Places::even(shape, 33, 29),
        Places::even(shape, 2, 131),
        Places::List(scattered.chain(corners).collect()),
    ]
}

#[test]
fn all_backends_agree_with_f64() {
    let shapes = specimens();
    for backend in Backend::ALL {
        let evaluator = match (backend, gpu()) {
            (Backend::Cpu, _) => Evaluator::on_cpu(),
            (_, Some(gpu)) => Evaluator::on_gpu(gpu, backend),
            (_, None) => continue,
        };
        let mut requests = Vec::new();
        for (_, shape) in &shapes {
            requests.extend(places_of(shape).into_iter().map(|places| Request { shape, places }));
        }
        let all = evaluator.evaluate(&requests, Quantities::Second).expect("evaluated");
        for (k, (request, values)) in requests.iter().zip(&all).enumerate() {
            let name = shapes[k / 3].0;
            assert_eq!(values.len(), request.places.len());
            let found = errors(request.shape, &request.places, values);
            println!("{:24} {name:18} {found:?}", backend.name());
            let (point, normal) = match backend {
                Backend::Cpu => (1e-12, 1e-4),
                Backend::Bezier => (1e-6, 0.05),
                // Parameters in single precision, as published.
                _ => (5e-6, 0.1),
            };
            assert!(found.point <= point, "{} {name}: {found:?}", backend.name());
            assert!(found.normal <= normal, "{} {name}: {found:?}", backend.name());
        }
    }
}

#[test]
fn twins_return_what_the_device_does() {
    let Some(gpu) = gpu() else { return };
    let shapes = specimens();
    let mut requests = Vec::new();
    for (_, shape) in &shapes {
        requests.extend(places_of(shape).into_iter().map(|places| Request { shape, places }));
    }
    for backend in Backend::ALL.into_iter().filter(|backend| *backend != Backend::Cpu) {
        let run =
            |evaluator: Evaluator| evaluator.evaluate(&requests, Quantities::Second).expect("evaluated");
        let (device, twin) = (run(Evaluator::on_gpu(gpu, backend)), run(Evaluator::twin(backend)));
        let [mut point, mut first, mut second] = [0.0f64; 3];
        for ((request, a), b) in requests.iter().zip(&device).zip(&twin) {
            let pairs =
                || (0..a.len()).map(|k| (a.derivatives(k).expect("asked"), b.derivatives(k).expect("asked")));
            let largest = |of: fn(&trimloop_geom::Derivatives) -> f64| {
                pairs().map(|(a, _)| of(&a)).fold(1e-30, f64::max)
            };
            let du = largest(|d| d.du.length().max(d.dv.length()));
            let duu = largest(|d| d.duu.length().max(d.duv.length()).max(d.dvv.length())).max(du);
            for (a, b) in pairs() {
                point = point.max(a.point.distance(b.point) / request.shape.size());
                first = first.max(a.du.distance(b.du).max(a.dv.distance(b.dv)) / du);
                let bends = [(a.duu, b.duu), (a.duv, b.duv), (a.dvv, b.dvv)].map(|(a, b)| a.distance(b));
                second = second.max(bends.into_iter().fold(0.0, f64::max) / duu);
            }
        }
        println!("{:24} {point:.1e} {first:.1e} {second:.1e}", backend.name());
        // Devices may fuse products with sums.
        assert!(point < 5e-7 && first < 2e-5 && second < 2e-4, "{}", backend.name());
    }
}

#[test]
fn curves_of_every_kind() {
    let frame = Frame::WORLD;
    let curves = [
        (Curve::Line { origin: frame.origin, direction: frame.x }, Interval::new(-2.0, 9.0)),
        (Curve::Circle { frame, radius: 4.0 }, Interval::new(0.2, 5.0)),
        (Curve::Ellipse { frame, major: 4.0, minor: 1.0 }, Interval::new(-1.0, 5.0)),
        (Curve::Parabola { frame, focal: 2.0 }, Interval::new(-1.0, 5.0)),
        (Curve::Hyperbola { frame, major: 2.0, minor: 1.0 }, Interval::new(-1.0, 2.0)),
    ];
    for backend in Backend::ALL {
        let evaluator = match (backend, gpu()) {
            (Backend::Cpu, _) => Evaluator::on_cpu(),
            (_, Some(gpu)) => Evaluator::on_gpu(gpu, backend),
            (_, None) => continue,
        };
        for (curve, range) in &curves {
            let shape = Shape::curve(curve, *range).expect("finite");
            assert!(shape.is_nurbs());
            let places = Places::even(&shape, 50, 1);
            let request = Request { shape: &shape, places: places.clone() };
            let values = &evaluator.evaluate(&[request], Quantities::Second).expect("evaluated")[0];
            for k in 0..50 {
                let exact = curve.derivatives(places.uv(k).x);
                let own = values.derivatives(k).expect("asked for");
                assert!(values.point(k).distance(exact[0]) < 2e-6 * shape.size(), "{}", backend.name());
                assert!(own.du.distance(exact[1]) < 1e-4 * exact[1].length());
                assert!(own.duu.distance(exact[2]) < 3e-4 * (exact[1].length() + exact[2].length()));
                let curvature = exact[1].cross(exact[2]).length() / exact[1].length().powi(3);
                let [own, ..] = values.curvatures(k).expect("asked for");
                assert!((own - curvature).abs() < 1e-3 * (curvature + 0.01), "{own} {curvature}");
            }
        }
    }
}

#[test]
fn curvatures_of_a_torus_are_those_of_its_closed_form() {
    let Some(gpu) = gpu() else { return };
    let surface =
        trimloop_geom::Surface::Torus { frame: Frame::WORLD, major: 9.0, minor: 2.0, v_range: None };
    let turn = Interval::new(0.0, std::f64::consts::TAU);
    let shape = Shape::surface(&surface, [turn, turn]).expect("finite");
    for evaluator in [Evaluator::on_cpu(), Evaluator::on_gpu(gpu, Backend::Bezier)] {
        let places = Places::even(&shape, 21, 19);
        let request = Request { shape: &shape, places: places.clone() };
        let values = &evaluator.evaluate(&[request], Quantities::Second).expect("evaluated")[0];
        for k in 0..places.len() {
            let v = places.uv(k).y;
            let across = v.cos() / (9.0 + 2.0 * v.cos());
            let [gauss, mean, most, least] = values.curvatures(k).expect("asked for");
            // The normal points outwards, the surface bends away from it.
            let (expected_most, expected_least) = ((-across).max(-0.5), (-across).min(-0.5));
            assert!((gauss - across * 0.5).abs() < 1e-4 && (mean + 0.5 * (across + 0.5)).abs() < 1e-4);
            assert!((most - expected_most).abs() < 2e-3 && (least - expected_least).abs() < 2e-3);
        }
    }
}

#[test]
fn batches_that_exceed_the_limits_are_cut_up() {
    let Some(gpu) = gpu() else { return };
    let shape = whole(sheet([3, 3], 9, 2.0));
    // 1.5 M points of 8 vectors are 192 MB; a binding holds 128 MiB.
    let places = Places::even(&shape, 1500, 1000);
    let request = || Request { shape: &shape, places: places.clone() };
    let evaluator = Evaluator::on_gpu(gpu, Backend::Bezier);
    let values = evaluator.evaluate(&[request(), request()], Quantities::Second).expect("evaluated");
    for values in &values {
        assert_eq!(values.len(), 1_500_000);
        for k in (0..values.len()).step_by(99_991) {
            let exact = shape.derivatives(places.uv(k)).point;
            assert!(values.point(k).distance(exact) < 1e-6 * shape.size());
        }
    }
}

#[test]
fn one_row_too_long_is_an_error_that_names_it() {
    let Some(gpu) = gpu() else { return };
    let shape = whole(sheet([3, 3], 2, 1.0));
    let places = Places::even(&shape, 1, 2_000_000);
    let evaluator = Evaluator::on_gpu(gpu, Backend::Bezier);
    let error =
        evaluator.evaluate(&[Request { shape: &shape, places }], Quantities::Second).expect_err("too much");
    assert!(error.to_string().contains("evaluate 2000000 points"), "{error}");
}

/// The error at high degrees, as a table: Bernstein polynomials keep their precision, knots in single precision do not.
#[test]
fn degrees_up_to_a_hundred() {
    let Some(gpu) = gpu() else { return };
    println!("{:24} {:>12} {:>12} {:>12} {:>12}", "distance / size at", "10", "20", "50", "100");
    let shapes = [10, 20, 50, 100].map(|degree| whole(sheet([degree, degree], 2, 2.0)));
    for backend in Backend::ALL {
        let evaluator = Evaluator::on_gpu(gpu, backend);
        let requests: Vec<Request<'_>> =
            shapes.iter().map(|shape| Request { shape, places: Places::even(shape, 23, 19) }).collect();
        let all = evaluator.evaluate(&requests, Quantities::Points).expect("evaluated");
        let off = |(request, values): (&Request<'_>, &Values)| {
            let exact = |k: usize| request.shape.derivatives(request.places.uv(k)).point;
            let distances = (0..values.len()).map(|k| values.point(k).distance(exact(k)));
            distances.fold(0.0, f64::max) / request.shape.size()
        };
        let found: Vec<f64> = requests.iter().zip(&all).map(off).collect();
        let row: Vec<String> = found.iter().map(|off| format!("{off:>12.2e}")).collect();
        println!("{:24} {}", backend.name(), row.join(" "));
        for (off, degree) in found.iter().zip([10, 20, 50, 100]) {
            assert!(*off <= 1e-6, "{} at degree {degree}: {off}", backend.name());
        }
    }
}

#[test]
fn long_lists_are_cut_up() {
    let Some(gpu) = gpu() else { return };
    let shape = whole(sheet([3, 3], 9, 2.0));
    // Two lines of 48 bytes for each of 1.5 M points are 144 MB; a binding holds 128 MiB.
    let list: Vec<DVec2> =
        (0..1_500_000).map(|k| DVec2::new(f64::from(k) * 0.618, f64::from(k) * 0.754).fract()).collect();
    let places = Places::List(list);
    for backend in [Backend::Bezier, Backend::KrishnamurthyPacked] {
        let request = Request { shape: &shape, places: places.clone() };
        let values =
            &Evaluator::on_gpu(gpu, backend).evaluate(&[request], Quantities::Points).expect("evaluated")[0];
        assert_eq!(values.len(), places.len());
        for k in (0..values.len()).step_by(99_991) {
            let exact = shape.derivatives(places.uv(k)).point;
            assert!(values.point(k).distance(exact) < 1e-6 * shape.size(), "{}", backend.name());
        }
    }
}
