//! What `render` draws has the outline of what `convert` writes, as any viewer of glTF shows it.

use glam::{DVec2, DVec3};
use trimloop_mesh::{LinearDeflection, MeshOptions};
use trimloop_render::{Camera, Direction, Look};
use trimloop_tests::{conversion::Conversion, fixture};

use crate::{camera, renderer};

const SIZE: [u32; 2] = [640, 512];

/// The pixels whose middles triangles cover.
fn covered(triangles: &[[DVec3; 3]], camera: &Camera) -> Vec<bool> {
    let [width, height] = SIZE.map(|n| n as usize);
    let mut out = vec![false; width * height];
    for triangle in triangles {
        let [Some(a), Some(b), Some(c)] = triangle.map(|p| camera.project(p, SIZE)) else { continue };
        let doubled = (b - a).perp_dot(c - a);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        for y in low.y.floor().max(0.0) as usize..(high.y.ceil().max(0.0) as usize).min(height) {
            for x in low.x.floor().max(0.0) as usize..(high.x.ceil().max(0.0) as usize).min(width) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let sides = [(a, b), (b, c), (c, a)].map(|(a, b)| (b - a).perp_dot(p - a) * doubled.signum());
                out[y * width + x] |= doubled != 0.0 && sides.into_iter().all(|side| side >= 0.0);
            }
        }
    }
    out
}

#[test]
fn pictures_have_the_outlines_of_converted_models() {
    for name in [
        "assembly_mirrored",
        "bottle",
        "bracket",
        "bspline_creased",
        "gear_blank",
        "plate_perforated",
        "spring_conical",
        "steinmetz",
        "thread",
        "torus_lemon",
    ] {
        let Some(mut renderer) = renderer(&format!("cadquery/{name}.step")) else { return };
        let options =
            MeshOptions { linear_deflection: LinearDeflection::Relative(1e-4), ..MeshOptions::default() };
        let conversion =
            Conversion::of(&fixture::named(&format!("cadquery/{name}")), &options).expect("a fixture");
        let triangles = conversion.scene().triangles();
        for direction in [Direction::ISO, Direction { azimuth_deg: 200.0, elevation_deg: -35.0 }] {
            let camera = camera(renderer.scene(), direction, SIZE);
            let seen = renderer.seen(&camera, SIZE, &Look::default()).expect("a picture");
            let wanted = covered(&triangles, &camera);
            let width = SIZE[0] as usize;
            let own: Vec<bool> = seen.pixels.iter().map(Option::is_some).collect();
            let has_near = |states: &[bool], k: usize, state: bool| {
                let (x, y) = (k % width, k / width);
                let rows = y.saturating_sub(1)..=(y + 1).min(SIZE[1] as usize - 1);
                let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
                rows.into_iter().any(|y| columns.clone().any(|x| states[y * width + x] == state))
            };
            // A pixel may differ beside the outline; what is thinner than a pixel may be missed by the triangles.
            let is_wrong = |k: &usize| {
                own[*k] != wanted[*k]
                    && !has_near(&wanted, *k, own[*k])
                    && !(own[*k] && has_near(&own, *k, false))
            };
            let other: Vec<usize> = (0..own.len()).filter(is_wrong).collect();
            assert!(other.is_empty(), "{name}: {} pixels, the first {}", other.len(), other[0]);
            assert!(wanted.iter().filter(|is_covered| **is_covered).count() > 30_000, "{name}");
        }
    }
}
