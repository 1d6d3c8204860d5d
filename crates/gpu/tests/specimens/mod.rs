//! Shapes that evaluation must cope with, and the device that tests run on.
#![allow(dead_code, reason = "each test uses some of it")]

use std::sync::OnceLock;

use trimloop_geom::{DVec3, Frame, Interval, NurbsSurface, Surface};
use trimloop_gpu::{Gpu, Shape};

/// The device. Without one, tests that need it say so loudly and do nothing, unless `TRIMLOOP_REQUIRE_GPU` is set.
pub fn gpu() -> Option<&'static Gpu> {
    static DEVICE: OnceLock<Option<Gpu>> = OnceLock::new();
    let open = || match Gpu::headless() {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("TRIMLOOP_REQUIRE_GPU").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("\n!!! SKIPPED, NOT TESTED: {error}\n");
            None
        }
    };
    DEVICE.get_or_init(open).as_ref()
}

/// Numbers between 0 and 1 that look like chance, the same every time.
pub fn noise(k: usize) -> f64 {
    let x = (k as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x1234_5678_9abc_def1);
    let x = (x ^ (x >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((x ^ (x >> 29)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A wavy sheet of `spans` x `spans` spans, 100 long, with weights between 1/`spread` and `spread`.
pub fn sheet(degrees: [usize; 2], spans: usize, spread: f64) -> NurbsSurface {
    let knots = degrees.map(|degree| {
        let inner = (1..spans).map(|i| i as f64 / spans as f64);
        [vec![0.0; degree + 1], inner.collect(), vec![1.0; degree + 1]].concat()
    });
    sheet_over(degrees, knots, spread)
}

/// A wavy sheet over these knots.
pub fn sheet_over(degrees: [usize; 2], knots: [Vec<f64>; 2], spread: f64) -> NurbsSurface {
    let [rows, columns] = [0, 1].map(|d| knots[d].len() - degrees[d] - 1);
    let point = |k: usize| {
        let (i, j) = (k / columns, k % columns);
        let (x, y) = (i as f64 / (rows - 1) as f64, j as f64 / (columns - 1) as f64);
        DVec3::new(100.0 * x, 100.0 * y, 20.0 * (5.0 * x).sin() * (4.0 * y).cos() + noise(k))
    };
    let points = (0..rows * columns).map(point).collect();
    let weights = if spread > 1.0 {
        (0..rows * columns).map(|k| spread.powf(2.0 * noise(k + 7777) - 1.0)).collect()
    } else {
        Vec::new()
    };
    NurbsSurface::new(degrees, rows, columns, points, weights, knots).expect("valid")
}

/// A surface over all of its domain.
pub fn whole(surface: NurbsSurface) -> Shape {
    let domain = surface.domain();
    Shape::surface(&Surface::Nurbs(surface), domain).expect("finite")
}

/// Name, shape.
pub fn specimens() -> Vec<(&'static str, Shape)> {
    let far = Frame { origin: DVec3::new(1e5, -2e5, 3e4), ..Frame::WORLD };
    let turn = Interval::new(0.0, std::f64::consts::TAU);
    let of = |surface: Surface, u: Interval, v: Interval| Shape::surface(&surface, [u, v]).expect("finite");
    let pole = std::f64::consts::FRAC_PI_2;
    let repeated = vec![0.0, 0.0, 0.0, 0.0, 0.2, 0.2, 0.2, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0];
    let unclamped: Vec<f64> = (0..14).map(f64::from).collect();
    vec![
        ("bicubic", whole(sheet([3, 3], 9, 1.0))),
        ("bicubic rational", whole(sheet([3, 3], 9, 3.0))),
        ("wild weights", whole(sheet([3, 3], 4, 1e3))),
        ("bilinear", whole(sheet([1, 1], 3, 1.0))),
        ("degree 1 x 7", whole(sheet([1, 7], 5, 2.0))),
        ("degree 9", whole(sheet([9, 9], 3, 2.0))),
        ("many spans", whole(sheet([2, 3], 60, 1.0))),
        ("repeated knots", whole(sheet_over([3, 3], [repeated.clone(), repeated], 2.0))),
        ("not clamped", whole(sheet_over([3, 3], [unclamped.clone(), unclamped], 2.0))),
        ("plane", of(Surface::Plane { frame: far }, Interval::new(-3.0, 7.0), Interval::new(1.0, 2.0))),
        ("cylinder", of(Surface::Cylinder { frame: far, radius: 5.0 }, turn, Interval::new(0.0, 40.0))),
        ("thin cylinder", of(Surface::Cylinder { frame: far, radius: 0.05 }, turn, Interval::new(0.0, 40.0))),
        (
            "cone to its apex",
            of(
                Surface::Cone { frame: far, radius: 5.0, half_angle_rad: 0.5 },
                Interval::new(0.3, 4.0),
                Interval::new(-5.0 / 0.5f64.tan(), 10.0),
            ),
        ),
        ("sphere", of(Surface::Sphere { frame: far, radius: 5.0 }, turn, Interval::new(-pole, pole))),
        ("torus", of(Surface::Torus { frame: far, major: 9.0, minor: 2.0, v_range: None }, turn, turn)),
    ]
}
