//! Distances, angles and axes that have a closed form.

mod fixture;

use std::f64::consts::{FRAC_PI_2, TAU};

use fixture::*;
use trimloop_geom::{Curve, DAffine3, DMat3, DVec3, Frame};

fn turned() -> DAffine3 {
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.7);
    DAffine3 { matrix3: turn, translation: DVec3::new(31.0, -12.0, 55.0) }
}

#[test]
fn opposite_sides_of_a_box() {
    let model = model("cadquery/box.step");
    let faces = faces(&model);
    let (left, right) = (facing(&faces, DVec3::NEG_X), facing(&faces, DVec3::X));
    let found = measure(left, right);
    assert!(found.is_exact && found.is_parallel);
    assert_near(found.distance_mm, 30.0);
    assert_near(found.angle_deg.unwrap(), 0.0);
    assert_near(found.parallel_distance_mm.unwrap(), 30.0);
    assert_at(found.points[0], DVec3::new(-15.0, 0.0, 0.0));
    assert_at(found.delta, DVec3::new(30.0, 0.0, 0.0));
}

#[test]
fn the_middle_of_an_overlap() {
    let model = model("cadquery/box.step");
    let (top, bottom) = (facing(&faces(&model), DVec3::Z), facing(&faces(&model), DVec3::NEG_Z));
    for (x, y) in [(25.0, 13.0), (-29.9, 0.0), (29.0, -19.0)] {
        let above = moved(bottom, DAffine3::from_translation(DVec3::new(x, y, 17.0)));
        let found = measure(top, above);
        assert_near(found.distance_mm, 7.0);
        assert_at(found.points[0], DVec3::new(x * 0.5, y * 0.5, 5.0));
    }
    // Touching all over counts as well.
    let on_top = moved(bottom, DAffine3::from_translation(DVec3::new(4.0, 2.0, 10.0)));
    let found = measure(top, on_top);
    assert_eq!(found.distance_mm, 0.0);
    assert_at(found.points[0], DVec3::new(2.0, 1.0, 5.0));
}

#[test]
fn sides_of_a_box_that_meet() {
    let model = model("cadquery/box.step");
    let faces = faces(&model);
    let found = measure(facing(&faces, DVec3::X), facing(&faces, DVec3::Z));
    assert_eq!(found.distance_mm, 0.0);
    assert_near(found.angle_deg.unwrap(), 90.0);
    assert_eq!(found.parallel_distance_mm, None);
    assert_at(found.points[0], DVec3::new(15.0, 0.0, 5.0));
}

#[test]
fn edges_and_corners_of_a_box() {
    let model = model("cadquery/box.step");
    let (edges, vertices) = (edges(&model), vertices(&model));
    let mut found: Vec<f64> = Vec::new();
    for a in &vertices {
        found.push(vertices.iter().map(|b| measure(*a, *b).distance_mm).fold(0.0, f64::max));
    }
    found.iter().for_each(|d| assert_near(*d, 1400f64.sqrt()));
    let along_x: Vec<_> =
        edges.iter().filter(|e| trimloop_measure::facts(**e).axis.unwrap().direction.x.abs() > 0.9).collect();
    assert_eq!(along_x.len(), 4);
    let farthest = along_x
        .iter()
        .map(|b| measure(*along_x[0], **b))
        .max_by(|a, b| a.distance_mm.total_cmp(&b.distance_mm));
    let farthest = farthest.unwrap();
    assert_near(farthest.distance_mm, 500f64.sqrt());
    assert_near(farthest.parallel_distance_mm.unwrap(), 500f64.sqrt());
    assert!(farthest.points[0].x.abs() < 1e-6);
}

#[test]
fn a_hole_and_the_sides_of_its_plate() {
    let model = model("cadquery/plate_with_hole.step");
    let faces = faces(&model);
    let hole = of_kind(&faces, "cylinder");
    let side = measure(hole, facing(&faces, DVec3::X));
    assert_near(side.distance_mm, 14.0);
    assert_near(side.parallel_distance_mm.unwrap(), 20.0);
    assert_near(side.angle_deg.unwrap(), 0.0);
    assert_at(side.points[0], DVec3::new(6.0, 0.0, 0.0));
    assert_at(side.points[1], DVec3::new(20.0, 0.0, 0.0));
    let top = facing(&faces, DVec3::Z);
    let rim = measure(hole, top);
    assert_eq!(rim.distance_mm, 0.0);
    assert_near(rim.angle_deg.unwrap(), 90.0);
}

#[test]
fn a_point_over_a_hole_is_nearest_to_its_rim() {
    let model = model("cadquery/plate_with_hole.step");
    let top = facing(&faces(&model), DVec3::Z);
    for (point, expected) in [
        (DVec3::new(1.0, 0.0, 12.5), 125f64.sqrt()),
        (DVec3::new(0.0, 0.0, 2.5), 6.0),
        (DVec3::new(10.0, 3.0, -4.0), 6.5),
        (DVec3::new(23.0, 19.0, 14.5), 13.0),
    ] {
        let part = vertex(point);
        let found = measure(first_vertex(&part), top);
        assert!(found.is_exact);
        assert_near(found.distance_mm, expected);
    }
}

#[test]
fn spheres_in_turned_instances() {
    let model = model("cadquery/sphere.step");
    let sphere = faces(&model)[0];
    let found = measure(sphere, moved(sphere, turned()));
    let centres = turned().translation.length();
    assert!(found.is_exact);
    assert_near(found.distance_mm, centres - 20.0);
    assert_near(found.center_distance_mm.unwrap(), centres);
    assert_at(found.points[0], turned().translation * (10.0 / centres));
}

#[test]
fn a_sphere_over_a_box_is_nearest_at_its_pole() {
    let (ball, block) = (model("cadquery/sphere.step"), model("cadquery/box.step"));
    let sphere = moved(faces(&ball)[0], DAffine3::from_translation(DVec3::new(2.0, 3.0, 20.0)));
    let found = measure(sphere, facing(&faces(&block), DVec3::Z));
    assert_near(found.distance_mm, 5.0);
    assert_at(found.points[1], DVec3::new(2.0, 3.0, 5.0));
    let aside = moved(faces(&ball)[0], DAffine3::from_translation(DVec3::new(20.0, 3.0, 20.0)));
    let found = measure(aside, facing(&faces(&block), DVec3::Z));
    assert_near(found.distance_mm, 250f64.sqrt() - 10.0);
}

#[test]
fn a_sphere_through_a_face_crosses_it() {
    let (ball, block) = (model("cadquery/sphere.step"), model("cadquery/box.step"));
    let sphere = moved(faces(&ball)[0], DAffine3::from_translation(DVec3::new(2.0, 3.0, 11.0)));
    let found = measure(sphere, facing(&faces(&block), DVec3::Z));
    assert_eq!(found.distance_mm, 0.0);
    assert!(found.is_exact);
}

#[test]
fn a_torus_from_inside_and_outside() {
    let (ring, ball) = (model("cadquery/torus.step"), model("cadquery/sphere.step"));
    let torus = faces(&ring)[0];
    let centre = vertex(DVec3::ZERO);
    let found = measure(first_vertex(&centre), torus);
    assert_near(found.distance_mm, 15.0);
    assert_near(found.center_distance_mm.unwrap(), 0.0);
    assert_near(measure(faces(&ball)[0], torus).distance_mm, 5.0);
    let above = vertex(DVec3::new(20.0, 0.0, 17.0));
    assert_near(measure(first_vertex(&above), torus).distance_mm, 12.0);
    let far = measure(torus, moved(torus, turned()));
    assert_near(far.axis_distance_mm.unwrap(), {
        let axis = turned().matrix3.z_axis;
        turned().translation.dot(DVec3::Z.cross(axis).normalize()).abs()
    });
}

#[test]
fn a_cone_from_its_side() {
    let model = model("cadquery/frustum.step");
    let faces = faces(&model);
    let cone = of_kind(&faces, "cone");
    let slant = (20f64.powi(2) + 6f64.powi(2)).sqrt();
    let outwards = DVec3::new(20.0, 0.0, 6.0) / slant;
    let at = DVec3::new(7.0, 0.0, 10.0) + outwards * 3.0;
    let beside = vertex(at);
    let found = measure(first_vertex(&beside), cone);
    assert_near(found.distance_mm, 3.0);
    assert_at(found.points[1], DVec3::new(7.0, 0.0, 10.0));
    let facts = trimloop_measure::facts(cone);
    assert_near(facts.half_angle_deg.unwrap(), (0.3f64).atan().to_degrees());
    // The cone's unbounded side goes on: here its rim is nearest.
    let above = vertex(DVec3::new(0.0, 0.0, 23.0));
    assert_near(measure(first_vertex(&above), cone).distance_mm, 5.0);
}

#[test]
fn cylinders_of_one_axis() {
    let model = model("cadquery/cylinder.step");
    let outer = of_kind(&faces(&model), "cylinder");
    let inner = moved(outer, DAffine3::from_scale(DVec3::splat(0.5)));
    let found = measure(outer, inner);
    assert!(found.is_exact && found.is_parallel);
    assert_near(found.distance_mm, 5.0);
    assert_near(found.axis_distance_mm.unwrap(), 0.0);
    let beside = moved(outer, DAffine3::from_translation(DVec3::new(26.0, 0.0, 0.0)));
    let found = measure(outer, beside);
    assert_near(found.distance_mm, 6.0);
    assert_near(found.axis_distance_mm.unwrap(), 26.0);
    // Side by side all along: in the middle.
    assert_at(found.points[0], DVec3::new(10.0, 0.0, 15.0));
    let across =
        DAffine3::from_translation(DVec3::new(40.0, 15.0, 15.0)) * DAffine3::from_rotation_x(FRAC_PI_2);
    let found = measure(outer, moved(outer, across));
    assert_near(found.distance_mm, 20.0);
    assert_near(found.angle_deg.unwrap(), 90.0);
    assert_near(found.axis_distance_mm.unwrap(), 40.0);
}

#[test]
fn a_line_and_a_circle() {
    let circle = edge(Curve::Circle { frame: Frame::WORLD, radius: 5.0 }, [0.0, TAU]);
    let beside = line(DVec3::new(8.0, -50.0, 4.0), DVec3::new(8.0, 50.0, 4.0));
    let found = measure(first_edge(&circle), first_edge(&beside));
    assert_near(found.distance_mm, 5.0);
    assert_at(found.points[0], DVec3::new(5.0, 0.0, 0.0));
    let through = line(DVec3::new(5.0, 0.0, -9.0), DVec3::new(5.0, 0.0, 7.0));
    assert_eq!(measure(first_edge(&circle), first_edge(&through)).distance_mm, 0.0);
    let short = line(DVec3::new(9.0, 3.0, 0.0), DVec3::new(12.0, 4.0, 2.0));
    assert_near(measure(first_edge(&circle), first_edge(&short)).distance_mm, 90f64.sqrt() - 5.0);
    let axis = line(DVec3::new(0.0, 0.0, -2.0), DVec3::new(0.0, 0.0, 4.0));
    let found = measure(first_edge(&circle), first_edge(&axis));
    assert_near(found.distance_mm, 5.0);
    assert_near(found.axis_distance_mm.unwrap(), 0.0);
}

#[test]
fn skew_edges_and_their_ends() {
    let a = line(DVec3::new(-10.0, 0.0, 0.0), DVec3::new(10.0, 0.0, 0.0));
    let b = line(DVec3::new(3.0, -10.0, 7.0), DVec3::new(3.0, 10.0, 7.0));
    let found = measure(first_edge(&a), first_edge(&b));
    assert_near(found.distance_mm, 7.0);
    assert_near(found.angle_deg.unwrap(), 90.0);
    assert_at(found.points[0], DVec3::new(3.0, 0.0, 0.0));
    let c = line(DVec3::new(3.0, 4.0, 7.0), DVec3::new(3.0, 10.0, 7.0));
    assert_near(measure(first_edge(&a), first_edge(&c)).distance_mm, 65f64.sqrt());
    let d = line(DVec3::new(4.0, 3.0, 4.0), DVec3::new(20.0, 3.0, 4.0));
    let found = measure(first_edge(&a), first_edge(&d));
    assert_near(found.distance_mm, 5.0);
    assert_near(found.parallel_distance_mm.unwrap(), 5.0);
    assert!((found.points[0].x - 7.0).abs() < 1e-6);
}

#[test]
fn solids_that_touch() {
    let model = model("cadquery/touching_solids.step");
    let faces = faces(&model);
    let pairs = faces.iter().flat_map(|a| faces.iter().map(move |b| (*a, *b)));
    let across = pairs.filter(|(a, b)| !std::ptr::eq(a.part, b.part) || a.feature != b.feature);
    let touching = across.filter(|(a, b)| measure(*a, *b).distance_mm == 0.0).count();
    assert!(touching >= 24, "{touching}");
}

/// What an affine map makes of a sphere reaches `|Mᵀ n| r` along a unit vector `n`.
#[test]
fn a_sphere_scaled_unevenly() {
    let (ball, block) = (model("cadquery/sphere.step"), model("cadquery/box.step"));
    let scale = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 0.5));
    let turn = DMat3::from_axis_angle(DVec3::new(0.3, -1.0, 0.4).normalize(), 1.1);
    for matrix3 in [scale, turn * scale, scale * turn] {
        let map = DAffine3 { matrix3, translation: DVec3::new(1.0, 2.0, 60.0) };
        let wide = moved(facing(&faces(&block), DVec3::Z), DAffine3::from_scale(DVec3::new(20.0, 20.0, 1.0)));
        let found = measure(moved(faces(&ball)[0], map), wide);
        assert!(found.is_exact);
        assert_near(found.distance_mm, 55.0 - (matrix3.transpose() * DVec3::Z).length() * 10.0);
        assert_eq!(found.center_distance_mm, None);
    }
}

#[test]
fn a_mirrored_instance() {
    let model = model("cadquery/plate_with_hole.step");
    let faces = faces(&model);
    let map = DAffine3::from_translation(DVec3::new(0.0, 0.0, 30.0))
        * DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let found = measure(facing(&faces, DVec3::Z), moved(facing(&faces, DVec3::NEG_Z), map));
    assert_near(found.distance_mm, 25.0);
    let normal = trimloop_measure::facts(moved(facing(&faces, DVec3::X), map)).normal.unwrap();
    assert_at(normal, DVec3::NEG_X);
}
