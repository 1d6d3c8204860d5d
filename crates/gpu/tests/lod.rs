//! Grid sizes follow size, distance and curvature, and keep the chord's distance.

mod specimens;

use glam::Vec3;
use specimens::{gpu, specimens};
use trimloop_geom::DVec3;
use trimloop_gpu::{LodShape, LodView, Places, lod_cells};

fn view(distance: f32) -> LodView {
    LodView {
        eye: Vec3::new(0.0, 0.0, distance),
        pixel: 1e-3,
        chord_px: 0.25,
        cell_px: 1e9,
        fewest: 1.0,
        most: 4096.0,
        is_parallel: 0,
        unused: [0; 3],
    }
}

#[test]
fn chords_stay_within_a_quarter_of_a_pixel() {
    for (name, shape) in specimens() {
        // Control points say little of second derivatives where weights are wild, and nothing of kinks at knots.
        if ["wild weights", "bilinear", "degree 1 x 7", "repeated knots"].contains(&name) {
            continue;
        }
        let lod = LodShape::new(&shape, shape.origin()).expect("NURBS");
        for distance in [200.0, 2000.0] {
            let view = view(distance);
            let [rows, columns] = lod.cells(&view).map(|cells| cells as usize + 1);
            let [u, v] = shape.domain();
            let Places::Grid { us, .. } = Places::even(&shape, rows, columns) else { unreachable!() };
            let allowed = f64::from(view.chord_px * view.pixel) * f64::from(distance - lod.radius);
            let middle = v.at(0.4);
            for pair in us.windows(2) {
                let at = |u: f64| shape.derivatives(glam::DVec2::new(u, middle)).point;
                let chord: DVec3 = (at(pair[0]) + at(pair[1])) * 0.5;
                // Rational parametrizations put the middle of the parameter beside the chord's: along it, not across. A
                // whole turn in one cell has no chord.
                let off = at(0.5 * (pair[0] + pair[1])) - chord;
                let along = (at(pair[1]) - at(pair[0])).try_normalize();
                let across = along.map_or(off, |along| off.reject_from_normalized(along)).length();
                assert!(across <= allowed, "{name} {u:?} {across} {allowed}");
            }
        }
    }
}

#[test]
fn sizes_change_continuously_and_the_device_agrees() {
    let shapes = specimens();
    let lods: Vec<LodShape> =
        shapes.iter().filter_map(|(_, shape)| LodShape::new(shape, shape.origin())).collect();
    let mut before: Option<Vec<[u32; 2]>> = None;
    for step in 0..60 {
        let view = view(300.0 * 1.05f32.powi(step));
        let twin: Vec<[u32; 2]> = lods.iter().map(|lod| lod.cells(&view)).collect();
        if let Some(gpu) = gpu() {
            let cells = lod_cells(gpu, &lods, &view).expect("chosen");
            let apart = |a: &[u32; 2], b: &[u32; 2]| a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1]));
            assert!(cells.iter().zip(&twin).all(|(a, b)| apart(a, b) <= 1), "{cells:?} {twin:?}");
        }
        if let Some(before) = &before {
            for (now, before) in twin.iter().zip(before) {
                for d in 0..2 {
                    assert!(
                        now[d] <= before[d] && before[d] - now[d] <= 2 + before[d] / 10,
                        "{before:?} {now:?}"
                    );
                }
            }
        }
        before = Some(twin);
    }
}
