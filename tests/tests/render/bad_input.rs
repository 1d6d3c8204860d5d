//! What cannot be drawn is told, and the rest is drawn.

use glam::DVec3;
use trimloop_brep::{EntityRef, Face, FaceGeometry};
use trimloop_mesh::Silent;
use trimloop_render::{Camera, CpuRenderer, Direction, Look, Projection, RenderError, Renderer, Section, Up};

use crate::{GPU, camera, model, renderer, scene};

#[test]
fn pictures_without_pixels_and_with_too_many_are_refused() {
    let Some(mut renderer) = renderer("cadquery/box.step") else { return };
    let camera = camera(renderer.scene(), Direction::ISO, [100, 100]);
    for size in [[0, 100], [100, 0], [40_000, 10]] {
        let error = renderer.picture(&camera, size, &Look::default()).expect_err("refused");
        assert!(matches!(error, RenderError::Size(..)), "{error}");
    }
    assert_eq!(renderer.pick(&camera, [100, 100], &Look::default(), [100, 5]).expect("no place"), None);
}

/// A device of its own, since it does not come back.
#[test]
fn a_lost_device_is_told_and_nothing_hangs() {
    if GPU.is_none() {
        return;
    }
    let gpu = trimloop_gpu::Gpu::headless().expect("there is one");
    let model = model("cadquery/bracket.step");
    let mut renderer = Renderer::new(&gpu, scene(&model)).expect("a renderer");
    let camera = camera(renderer.scene(), Direction::ISO, [200, 200]);
    renderer.picture(&camera, [200, 200], &Look::default()).expect("a picture");
    gpu.device().destroy();
    for look in [Look::default(), Look { screen_error_px: 0.1, ..Look::default() }] {
        let error = renderer.picture(&camera, [200, 200], &look).expect_err("lost");
        assert!(matches!(error, RenderError::Gpu(trimloop_gpu::GpuError::Lost { .. })), "{error:?}");
        assert!(renderer.pick(&camera, [200, 200], &look, [100, 100]).is_err());
    }
    assert!(matches!(
        Renderer::new(&gpu, scene(&model)).expect_err("lost"),
        RenderError::Gpu(trimloop_gpu::GpuError::Lost { .. })
    ));
}

/// Six million vertices and more, which a device with the least memory has no room for: it is drawn coarser, and told.
#[test]
fn too_little_memory_makes_a_picture_coarser() {
    let Some(mut renderer) = renderer("cadquery/torus.step") else { return };
    let size = [1280, 1024];
    let camera = camera(renderer.scene(), Direction::ISO, size);
    let look = Look { screen_error_px: 3e-4, ..Look::default() };
    let seen = renderer.seen(&camera, size, &look).expect("a picture");
    assert!(seen.pixels.iter().flatten().count() > 300_000);
    let drawn = renderer.statistics();
    assert!((look.screen_error_px..0.01).contains(&drawn.screen_error_px), "{drawn}");
    // The next one has all the room again.
    renderer.seen(&camera, size, &Look::default()).expect("a picture");
    assert_eq!(renderer.statistics().screen_error_px, 0.5);
}

#[test]
fn a_large_picture_can_be_stopped() {
    struct Stopped(std::sync::atomic::AtomicUsize);
    impl trimloop_mesh::Monitor for Stopped {
        fn face_done(&self) {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        }
        fn cancelled(&self) -> bool {
            self.0.load(std::sync::atomic::Ordering::Relaxed) >= 1
        }
    }
    let Some(mut renderer) = renderer("cadquery/box.step") else { return };
    let size = [4100, 2050];
    let camera = camera(renderer.scene(), Direction::ISO, size);
    assert_eq!(Renderer::steps(size, &Look::default()), 6);
    let stopped = Stopped(Default::default());
    let error = renderer.picture_watched(&camera, size, &Look::default(), &stopped).expect_err("stopped");
    assert!(matches!(error, RenderError::Cancelled(_)), "{error:?}");
    assert_eq!(stopped.0.into_inner(), 1);
}

#[test]
fn pictures_larger_than_a_tile_are_the_same() {
    let Some(mut renderer) = renderer("cadquery/bracket.step") else { return };
    let size = [2500, 1100];
    let camera = camera(renderer.scene(), Direction::ISO, size);
    let look = Look { samples: 1, ..Look::default() };
    let picture = renderer.picture(&camera, size, &look).expect("a picture");
    // The columns on both sides of the joint at 2048 differ no more than others do.
    let step = |x: u32| -> u64 {
        let change = |y: u32| {
            let (a, b) = (picture.pixel(x, y), picture.pixel(x + 1, y));
            (0..3).map(|c| u64::from(a[c].abs_diff(b[c]))).sum::<u64>()
        };
        (0..size[1]).map(change).sum()
    };
    let usual = (2000..2040).map(step).max().unwrap_or(0);
    assert!(step(2047) <= 2 * usual + 1000, "{} {usual}", step(2047));
}

#[test]
fn a_face_that_cannot_be_understood_is_told_and_costs_no_other() {
    let Some(gpu) = GPU.as_ref() else { return };
    let mut model = model("cadquery/box.step");
    let lost: Face = Face {
        geometry: FaceGeometry::Unreadable("it makes no sense".into()),
        entity: EntityRef::Step(4711),
        ..model.parts[0].faces[0].clone()
    };
    model.parts[0].faces[0] = lost;
    let scene = scene(&model);
    assert!(scene.diagnostics.iter().any(|d| d.code == "face-lost" && d.entity == EntityRef::Step(4711)));
    let camera = camera(&scene, Direction::ISO, [200, 200]);
    let mut renderer = Renderer::new(gpu, scene).expect("a renderer");
    let seen = renderer.seen(&camera, [200, 200], &Look::default()).expect("a picture");
    assert!(seen.pixels.iter().flatten().count() > 5000);
}

#[test]
fn an_eye_inside_of_a_body_and_one_that_looks_away() {
    let Some(mut renderer) = renderer("cadquery/sphere.step") else { return };
    let size = [200, 150];
    let middle = renderer.scene().bounds().center();
    let mut camera = camera(renderer.scene(), Direction::ISO, size);
    let outside = camera;
    camera.eye = middle;
    let seen = renderer.seen(&camera, size, &Look::default()).expect("a picture");
    assert_eq!(seen.pixels.iter().flatten().count(), 200 * 150);
    let away = Camera { axes: outside.axes.map(|axis| -axis), ..outside };
    let seen = renderer.seen(&away, size, &Look::default()).expect("a picture");
    assert_eq!(seen.pixels.iter().flatten().count(), 0);
}

#[test]
fn nothing_to_look_at_has_no_camera() {
    let projection = Projection::Perspective { fov_y_rad: 0.5 };
    assert_eq!(Camera::fit(&[], Direction::ISO, Up::Z, projection, 1.0), None);
}

#[test]
fn the_processor_draws_what_the_device_draws() {
    let name = "cadquery/bracket.step";
    let Some(mut renderer) = renderer(name) else { return };
    let model = model(name);
    let cpu = CpuRenderer::new(&model, scene(&model), &Silent).expect("meshed");
    let size = [320, 240];
    let camera = camera(renderer.scene(), Direction::ISO, size);
    let a = renderer.picture(&camera, size, &Look::default()).expect("a picture");
    let b = cpu.picture(&camera, size, &Look::default()).expect("a picture");
    let off: u64 = a.rgba.iter().zip(&b.rgba).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    let mean = off as f64 / a.rgba.len() as f64;
    assert!(mean < 1.5, "{mean}");
}

#[test]
fn the_processor_closes_what_two_planes_cut_open() {
    let Some(gpu) = GPU.as_ref() else { return };
    let model = model("cadquery/hollow_ball.step");
    let cut = || {
        let mut scene = scene(&model);
        let middle = scene.bounds().center();
        let plane = |normal: DVec3| Section { normal, offset_mm: normal.dot(middle) };
        let planes = [plane(DVec3::X), plane(-DVec3::Z)];
        let sections = scene.cap(&model, &planes, &Silent).expect("capped");
        (scene, Look { sections, ..Look::default() })
    };
    let (own, look) = cut();
    let size = [320, 240];
    let camera = camera(&own, Direction::ISO, size);
    let a = Renderer::new(gpu, own).expect("a renderer").picture(&camera, size, &look).expect("a picture");
    let cpu = CpuRenderer::new(&model, cut().0, &Silent).expect("meshed");
    let b = cpu.picture(&camera, size, &look).expect("a picture");
    let off: u64 = a.rgba.iter().zip(&b.rgba).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    assert!(off as f64 / (a.rgba.len() as f64) < 1.5, "{off}");
    // Both show the inside, in the colour of cuts.
    let is_cut = |p: &[u8]| i32::from(p[0]) - i32::from(p[2]) > 30;
    let [first, second] = [&a, &b].map(|p| p.rgba.chunks_exact(4).filter(|p| is_cut(p)).count());
    assert!(first > 1000 && first.abs_diff(second) < first / 20, "{first} {second}");
}
