//! Levels of detail: what comes down goes up again; Haar shrinks, lifting keeps points and borders.

mod specimens;

use specimens::{gpu, sheet, whole};
use trimloop_geom::{DVec2, DVec3};
use trimloop_gpu::{DevicePyramid, Evaluator, Places, Pyramid, Quantities, Request, Shape, Wavelet};

/// A pyramid of even steps over the shape, relative to its origin.
fn pyramid(shape: &Shape, wavelet: Wavelet, size: usize) -> Pyramid {
    let request = Request { shape, places: Places::even(shape, size, size) };
    let values = &Evaluator::on_cpu().evaluate(&[request], Quantities::Points).expect("evaluated")[0];
    let points =
        (0..values.len()).map(|k| (values.point(k) - shape.origin()).as_vec3().extend(1.0)).collect();
    Pyramid::new(wavelet, size, size, points).expect("full")
}

/// Largest distance of a level's points from the surface, and of its border from the surface's, over the size.
fn off(shape: &Shape, surface: &trimloop_geom::Surface, pyramid: &Pyramid) -> [f64; 2] {
    let [rows, columns] = pyramid.size();
    let [u, v] = shape.domain();
    let mut worst = [0.0f64; 2];
    for (k, point) in pyramid.points().iter().enumerate() {
        let point = point.truncate().as_dvec3() + shape.origin();
        let (i, j) = (k / columns, k % columns);
        let share = DVec2::new(i as f64 / (rows - 1) as f64, j as f64 / (columns - 1) as f64);
        let uv = DVec2::new(u.at(share.x), v.at(share.y));
        worst[0] = worst[0].max(surface.project(point, Some(uv)).distance / shape.size());
        if i == 0 {
            let border: Vec<DVec3> =
                (0..=400).map(|k| surface.point(DVec2::new(u.start, v.at(f64::from(k) / 400.0)))).collect();
            let nearest = border.windows(2).map(|pair| {
                let along = pair[1] - pair[0];
                let t = ((point - pair[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                point.distance(pair[0] + along * t)
            });
            worst[1] = worst[1].max(nearest.fold(f64::INFINITY, f64::min) / shape.size());
        }
    }
    worst
}

#[test]
fn levels_go_down_and_up_and_lifting_keeps_the_borders() {
    let surface = sheet([3, 3], 5, 2.0);
    let shape = whole(surface.clone());
    let surface = trimloop_geom::Surface::Nurbs(surface);
    for (wavelet, size) in [(Wavelet::Haar, 64), (Wavelet::Lifting, 65)] {
        let finest = pyramid(&shape, wavelet, size);
        let mut twin = finest.clone();
        let mut device = gpu().map(|gpu| DevicePyramid::new(gpu, &finest).expect("small"));
        let apart = |a: &[glam::Vec4], b: &[glam::Vec4]| {
            a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
        };
        println!("{:8} {:>7} {:>16} {:>16}", wavelet.name(), "points", "off the surface", "off the border");
        while twin.can_go_down() && twin.size()[0] > 4 {
            twin.step(true);
            if let Some(device) = &mut device {
                device.step(true).expect("down");
                assert_eq!((device.size(), device.level()), (twin.size(), twin.level()));
                let apart = apart(&device.points().expect("read"), &twin.points());
                assert!(apart < 1e-6 * shape.size() as f32, "twin {apart}");
            }
            let [surface_off, border_off] = off(&shape, &surface, &twin);
            println!("{:8} {:>7} {surface_off:>16.2e} {border_off:>16.2e}", "", twin.size()[0]);
            match wavelet {
                // Half of a cell of the level, 1 / (2 rows) of the length.
                Wavelet::Haar => assert!(border_off > 0.2 / twin.size()[0] as f64, "{border_off}"),
                Wavelet::Lifting => {
                    assert!(surface_off < 1e-6 && border_off < 2e-5, "{surface_off} {border_off}")
                }
            }
        }
        while twin.level() > 0 {
            twin.step(false);
            if let Some(device) = &mut device {
                device.step(false).expect("up");
            }
        }
        let tiny = 1e-6 * shape.size() as f32;
        assert!(apart(&twin.points(), &finest.points()) < tiny);
        if let Some(device) = device {
            assert!(apart(&device.points().expect("read"), &finest.points()) < tiny);
        }
    }
}

#[test]
fn sizes_that_cannot_be_halved_stay() {
    let shape = whole(sheet([3, 3], 5, 1.0));
    let mut odd = pyramid(&shape, Wavelet::Haar, 9);
    assert!(!odd.can_go_down());
    odd.step(true);
    assert_eq!(odd.level(), 0);
    assert!(Pyramid::new(Wavelet::Haar, 4, 4, vec![]).is_err());
}
