//! Area, volume and centre of whole parts, against closed forms.

mod fixture;

use std::f64::consts::PI;

use fixture::model;
use trimloop_brep::BodyKind;
use trimloop_geom::{DAffine3, DVec3};
use trimloop_measure::{Whole, whole};
use trimloop_mesh::Silent;

fn of(name: &str, transform: DAffine3) -> Whole {
    whole(&model(name).parts[0], transform, &Silent).expect("an area")
}

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

#[test]
fn solids_have_the_volumes_of_their_formulas() {
    let forms = [
        ("cadquery/box.step", 2200.0, 6000.0),
        ("cadquery/sphere.step", 4.0 * PI * 100.0, 4.0 / 3.0 * PI * 1000.0),
        ("cadquery/hollow_ball.step", 4.0 * PI * (100.0 + 64.0), 4.0 / 3.0 * PI * (1000.0 - 512.0)),
        ("cadquery/torus.step", 4.0 * PI * PI * 20.0 * 5.0, 2.0 * PI * PI * 20.0 * 25.0),
    ];
    for (name, area, volume) in forms {
        let found = of(name, DAffine3::IDENTITY);
        let own = found.volume_mm3.expect("a solid");
        assert!(is_near(found.area_mm2, area) && is_near(own, volume), "{name}: {found:?}");
        assert!(found.center.length() < 1e-7, "{name}: {found:?}");
    }
}

#[test]
fn places_turn_move_and_scale() {
    let place = DAffine3::from_translation(DVec3::new(100.0, -20.0, 7.0))
        * DAffine3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7)
        * DAffine3::from_scale(DVec3::splat(2.0));
    let found = of("cadquery/box.step", place);
    assert!(is_near(found.volume_mm3.expect("a solid"), 48_000.0) && is_near(found.area_mm2, 8800.0));
    assert!(found.center.distance(DVec3::new(100.0, -20.0, 7.0)) < 1e-9);
    // Seen in a mirror, it is as large.
    let mirrored = of("cadquery/box.step", DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)));
    assert!(is_near(mirrored.volume_mm3.expect("a solid"), 6000.0));
}

#[test]
fn what_is_no_closed_solid_has_no_volume() {
    let mut sheet = model("cadquery/box.step");
    sheet.parts[0].bodies[0].kind = BodyKind::Sheet;
    let found = whole(&sheet.parts[0], DAffine3::IDENTITY, &Silent).expect("an area");
    assert_eq!(found.volume_mm3, None);
    assert!(is_near(found.area_mm2, 2200.0));
    let mut open = model("cadquery/box.step");
    open.parts[0].faces[0].loops.clear();
    open.parts[0].faces[0].hidden = true;
    let found = whole(&open.parts[0], DAffine3::IDENTITY, &Silent).expect("an area");
    assert_eq!(found.volume_mm3, None, "{found:?}");
    let mut nothing = model("cadquery/box.step");
    nothing.parts[0].faces.clear();
    nothing.parts[0].bodies.clear();
    assert_eq!(whole(&nothing.parts[0], DAffine3::IDENTITY, &Silent), None);
}
