//! Every pixel shows what is within half a pixel of the exact model, and nothing is open.

use std::sync::Arc;

use trimloop_brep::{Face, FaceGeometry};
use trimloop_geom::Surface;
use trimloop_mesh::Silent;
use trimloop_render::{CpuRenderer, Direction, Lod, Look, Projection, Renderer, prove};

use crate::{GPU, camera, model, renderer, scene};

const SIZE: [u32; 2] = [1280, 1024];
const VIEWS: [Direction; 3] = [
    Direction::ISO,
    Direction { azimuth_deg: 10.0, elevation_deg: 5.0 },
    Direction { azimuth_deg: 200.0, elevation_deg: -60.0 },
];

const MODELS: [&str; 37] = [
    "cadquery/assembly_nested.step",
    "cadquery/assembly_mirrored.step",
    "cadquery/assembly_transparent.step",
    "cadquery/bare_bracket.step",
    "cadquery/bare_ellipsoid.step",
    "cadquery/bezier_rational_octant.step",
    "cadquery/bottle.step",
    "cadquery/bspline_collapsed_side.step",
    "cadquery/bspline_creased.step",
    "cadquery/bspline_degree_1.step",
    "cadquery/bspline_degree_9.step",
    "cadquery/bspline_periodic.step",
    "cadquery/bspline_rational.step",
    "cadquery/bspline_uneven_knots.step",
    "cadquery/cone_cut_in_hyperbola.step",
    "cadquery/cone_cut_through_apex.step",
    "cadquery/cylinder_with_slot_through_seam.step",
    "cadquery/far_from_origin.step",
    "cadquery/fillet_variable.step",
    "cadquery/gear_blank.step",
    "cadquery/hollow_ball.step",
    "cadquery/loft_to_point.step",
    "cadquery/micrometre.step",
    "cadquery/paraboloid.step",
    "cadquery/pipe_tee.step",
    "cadquery/plate_perforated.step",
    "cadquery/sheet_single_face.step",
    "cadquery/sphere_with_hole_through_poles.step",
    "cadquery/spring_conical.step",
    "cadquery/steinmetz.step",
    "cadquery/thread.step",
    "cadquery/torus_lemon.step",
    "cadquery/trimmed_surface.step",
    "freecad/thread.step",
    "tspline/hill.tspline",
    "tspline/ring.tspline",
    "tspline/wave.tspline",
];

/// One part of the models, so that the parts run beside each other.
fn models_hold(first: usize) {
    let mut wrong = Vec::new();
    for name in MODELS.iter().skip(first).step_by(2) {
        let Some(mut renderer) = renderer(name) else { return };
        let model = model(name);
        let reference = CpuRenderer::with_deflection(&model, scene(&model), 1e-4, &Silent).expect("meshed");
        for (k, direction) in VIEWS.into_iter().enumerate() {
            let camera = camera(renderer.scene(), direction, SIZE);
            let proof =
                prove(&mut renderer, Some(&reference), &camera, SIZE, &Look::default()).expect("a picture");
            if !proof.holds() || proof.unproved > 0 || proof.covered == 0 {
                wrong.push(format!("{name} from {k}: {proof:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_first_half_of_the_models() {
    models_hold(0);
}

#[test]
fn the_second_half_of_the_models() {
    models_hold(1);
}

#[test]
fn close_to_a_thousandth_of_a_face() {
    for name in ["cadquery/bare_bracket.step", "cadquery/spline_hill.step", "cadquery/steinmetz.step"] {
        let Some(mut renderer) = renderer(name) else { return };
        for zoom in [30.0, 1000.0, 30_000.0] {
            let mut camera = camera(renderer.scene(), Direction::ISO, SIZE);
            camera.projection = Projection::Perspective { fov_y_rad: 2.0 * ((0.25f64).tan() / zoom).atan() };
            let proof = prove(&mut renderer, None, &camera, SIZE, &Look::default()).expect("a picture");
            assert!(proof.holds() && proof.covered > 0, "{name} at {zoom}: {proof:?}");
        }
    }
}

/// What the published strategies promise where they can: smooth surfaces, and cracks only where masks are.
#[test]
fn every_strategy_draws_smooth_models_within_half_a_pixel() {
    for name in ["cadquery/bare_bracket.step", "cadquery/torus.step", "cadquery/plate_perforated.step"] {
        let Some(mut renderer) = renderer(name) else { return };
        let model = model(name);
        let reference = CpuRenderer::with_deflection(&model, scene(&model), 1e-4, &Silent).expect("meshed");
        for lod in Lod::ALL {
            let camera = camera(renderer.scene(), Direction::ISO, SIZE);
            let look = Look { lod, ..Look::default() };
            let proof = prove(&mut renderer, Some(&reference), &camera, SIZE, &look).expect("a picture");
            let most = if lod == Lod::Grid { 100 } else { 0 };
            assert!(
                proof.off == 0 && proof.spills == 0 && proof.covered > 300_000,
                "{name} {lod:?} {proof:?}"
            );
            assert!(proof.cracks <= most, "{name} {lod:?} {proof:?}");
        }
    }
}

/// Degrees above 3, kinks, uneven knots, poles and T-junctions as trees of bicubic patches.
#[test]
fn hierarchies_draw_every_kind_of_surface_within_half_a_pixel() {
    for name in [
        "cadquery/bspline_collapsed_side.step",
        "cadquery/bspline_creased.step",
        "cadquery/bspline_degree_1.step",
        "cadquery/bspline_degree_9.step",
        "cadquery/bspline_uneven_knots.step",
        "cadquery/cone_cut_in_hyperbola.step",
        "cadquery/hollow_ball.step",
        "cadquery/thread.step",
        "tspline/ring.tspline",
    ] {
        let Some(mut renderer) = renderer(name) else { return };
        let model = model(name);
        let reference = CpuRenderer::with_deflection(&model, scene(&model), 1e-4, &Silent).expect("meshed");
        let camera = camera(renderer.scene(), Direction::ISO, SIZE);
        let look = Look { lod: Lod::BezierHierarchy, ..Look::default() };
        let proof = prove(&mut renderer, Some(&reference), &camera, SIZE, &look).expect("a picture");
        assert!(proof.holds() && proof.covered > 200_000, "{name}: {proof:?}");
        // What a view split is there for the next one.
        let near = renderer.statistics().evaluated;
        prove(&mut renderer, None, &camera, SIZE, &look).expect("a picture");
        assert!(near > 0 && renderer.statistics().evaluated == 0, "{name}");
    }
}

/// A face that floats above its edges, as sloppy files have them: nothing shows between it and its neighbours.
#[test]
fn a_gap_between_a_face_and_its_edges_is_closed() {
    let Some(gpu) = GPU.as_ref() else { return };
    let mut model = model("cadquery/box.step");
    let size = scene(&model).bounds().diagonal();
    let is_top = |face: &&mut Face| match &face.geometry {
        FaceGeometry::Surface(surface) => {
            matches!(&**surface, Surface::Plane { frame } if frame.z.z.abs() > 0.9 && frame.origin.z > 0.0)
        }
        _ => false,
    };
    let top = model.parts[0].faces.iter_mut().find(is_top).expect("a face on top");
    if let FaceGeometry::Surface(surface) = &mut top.geometry
        && let Surface::Plane { frame } = Arc::make_mut(surface)
    {
        frame.origin.z += 0.01 * size;
    }
    let reference = CpuRenderer::with_deflection(&model, scene(&model), 1e-4, &Silent).expect("meshed");
    for lod in [Lod::Adaptive, Lod::BezierHierarchy] {
        let mut renderer = Renderer::new(gpu, scene(&model)).expect("a renderer");
        for direction in VIEWS {
            let camera = camera(renderer.scene(), direction, SIZE);
            let look = Look { lod, ..Look::default() };
            let proof = prove(&mut renderer, Some(&reference), &camera, SIZE, &look).expect("a picture");
            assert!(proof.holds() && proof.covered > 100_000, "{lod:?} {proof:?}");
            // What closes the gap belongs to points that are away from it.
            assert!(proof.bridged > 0 && proof.bridged < proof.covered / 20, "{lod:?} {proof:?}");
        }
    }
}

/// A level that is stepped down to and up again is the one that was evaluated.
#[test]
fn wavelets_go_down_and_up_without_evaluating_again() {
    let Some(mut renderer) = renderer("cadquery/torus.step") else { return };
    let look = Look { lod: Lod::Wavelet, ..Look::default() };
    let near = camera(renderer.scene(), Direction::ISO, SIZE);
    let small = [160, 128];
    let seen = renderer.seen(&near, SIZE, &look).expect("a picture");
    assert!(renderer.statistics().evaluated > 0);
    let proof = prove(&mut renderer, None, &near, small, &look).expect("a picture");
    assert!(proof.holds() && proof.covered > 5000, "{proof:?}");
    assert_eq!(renderer.statistics().evaluated, 0);
    let again = renderer.seen(&near, SIZE, &look).expect("a picture");
    assert_eq!(renderer.statistics().evaluated, 0);
    assert!(seen.pixels == again.pixels);
}
