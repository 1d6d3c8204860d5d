//! What single items are, against closed forms and the fixtures' references.

mod fixture;

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;
use std::sync::Arc;

use fixture::*;
use trimloop_geom::{
    CompositeCurve, CompositeSegment, Curve, DAffine3, DVec2, DVec3, Direction, Frame, Interval, NurbsCurve,
    Polyline,
};
use trimloop_measure::{Item, facts};

#[test]
fn a_box_in_numbers() {
    let model = model("cadquery/box.step");
    let face = facts(facing(&faces(&model), DVec3::Z));
    assert_eq!(face.kind, "plane");
    assert_near(face.area_mm2.unwrap(), 600.0);
    assert_near(face.length_mm.unwrap(), 100.0);
    let mut lengths: Vec<f64> = edges(&model).into_iter().map(|e| facts(e).length_mm.unwrap()).collect();
    lengths.sort_by(f64::total_cmp);
    for (found, expected) in lengths.iter().zip([10.0, 20.0, 30.0].into_iter().flat_map(|l| [l; 4])) {
        assert_near(*found, expected);
    }
    for item in edges(&model) {
        let edge = facts(item);
        let [start, end] = edge.ends.unwrap();
        assert_near((end - start).normalize().dot(edge.axis.unwrap().direction), 1.0);
        assert_eq!(edge.kind, "line");
    }
    let corner = facts(vertices(&model)[0]);
    assert_eq!(corner.kind, "vertex");
    assert_at(corner.position.unwrap().abs(), DVec3::new(15.0, 10.0, 5.0));
}

#[test]
fn normals_point_out_of_a_solid() {
    for name in ["cadquery/box.step", "cadquery/wedge.step", "cadquery/solid_inside_out.step"] {
        let model = model(name);
        let faces = faces(&model);
        let sum =
            faces.iter().map(|f| facts(*f)).map(|f| f.normal.unwrap() * f.area_mm2.unwrap()).sum::<DVec3>();
        assert!(sum.length() < 1e-6, "{name}: {sum}");
    }
}

#[test]
fn round_faces() {
    let cylinder = model("cadquery/cylinder.step");
    let side = facts(of_kind(&faces(&cylinder), "cylinder"));
    assert_near(side.radius_mm.unwrap(), 10.0);
    assert_near(side.area_mm2.unwrap(), 600.0 * PI);
    // Both rims; the seam is no boundary.
    assert_near(side.length_mm.unwrap(), 40.0 * PI);
    assert_near(side.axis.unwrap().direction.z.abs(), 1.0);

    let ball = model("cadquery/sphere.step");
    let sphere = facts(faces(&ball)[0]);
    assert_eq!((&*sphere.kind, sphere.length_mm), ("sphere", None));
    assert_near(sphere.area_mm2.unwrap(), 400.0 * PI);
    assert_at(sphere.position.unwrap(), DVec3::ZERO);

    let ring = model("cadquery/torus.step");
    let torus = facts(faces(&ring)[0]);
    assert_eq!((torus.radius_mm, torus.minor_radius_mm), (Some(20.0), Some(5.0)));
    assert_near(torus.area_mm2.unwrap(), 400.0 * PI * PI);

    let frustum = model("cadquery/frustum.step");
    let cone = facts(of_kind(&faces(&frustum), "cone"));
    assert_near(cone.area_mm2.unwrap(), PI * 14.0 * 436f64.sqrt());
    assert_at(cone.position.unwrap(), DVec3::new(0.0, 0.0, 100.0 / 3.0));
    let circles: Vec<_> = edges(&frustum).into_iter().map(facts).filter(|e| e.kind == "circle").collect();
    assert_eq!(circles.len(), 2);
    for circle in circles {
        assert_near(circle.arc_angle_deg.unwrap(), 360.0);
        assert_near(circle.length_mm.unwrap(), TAU * circle.radius_mm.unwrap());
    }
}

#[test]
fn what_a_scale_makes_of_round_faces() {
    let cylinder = model("cadquery/cylinder.step");
    let side = of_kind(&faces(&cylinder), "cylinder");
    let long = facts(moved(side, DAffine3::from_scale(DVec3::new(2.0, 2.0, 5.0))));
    assert_eq!(long.kind, "cylinder");
    assert_near(long.radius_mm.unwrap(), 20.0);
    assert_near(long.area_mm2.unwrap(), 6000.0 * PI);
    let flat = facts(moved(side, DAffine3::from_scale(DVec3::new(2.0, 1.0, 1.0))));
    assert_eq!(flat.kind, "elliptic cylinder");
    assert_near(flat.radius_mm.unwrap(), 20.0);
    assert_near(flat.minor_radius_mm.unwrap(), 10.0);
    let circle = edge(Curve::Circle { frame: Frame::WORLD, radius: 5.0 }, [0.0, TAU]);
    let wide = facts(moved(first_edge(&circle), DAffine3::from_scale(DVec3::new(3.0, 1.0, 1.0))));
    assert_eq!((&*wide.kind, wide.arc_angle_deg), ("ellipse", None));
    assert_near(wide.radius_mm.unwrap(), 15.0);
    // 4 a E(e), e² = 8/9 (complete elliptic integral, Abramowitz & Stegun 17.3).
    let e = (0..200_000)
        .map(|k| (k as f64 + 0.5) * FRAC_PI_2 / 2e5)
        .map(|t| (1.0 - 8.0 / 9.0 * t.sin().powi(2)).sqrt());
    assert_near(wide.length_mm.unwrap(), 60.0 * e.sum::<f64>() * FRAC_PI_2 / 2e5);
}

#[test]
fn lengths_of_curves() {
    let arc = edge(Curve::Circle { frame: Frame::WORLD, radius: 4.0 }, [0.5, 2.0]);
    let found = facts(first_edge(&arc));
    assert_near(found.length_mm.unwrap(), 6.0);
    assert_near(found.arc_angle_deg.unwrap(), 1.5f64.to_degrees());
    let parabola = edge(Curve::Parabola { frame: Frame::WORLD, focal: 0.5 }, [0.0, 1.0]);
    // y = t, x = t²/2: the integral of sqrt(1 + t²).
    assert_near(facts(first_edge(&parabola)).length_mm.unwrap(), (2f64.sqrt() + 1f64.asinh()) / 2.0);
    // A cusp: (t², t³), whose length over -1..1 is 2 (13 sqrt 13 - 8) / 27.
    let points = [-1.0, 1.0, -1.0, 1.0].iter().zip([1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0]);
    let points: Vec<DVec3> = points.map(|(y, x)| DVec3::new(x, *y, 0.0)).collect();
    let knots = vec![-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0];
    let cusp = NurbsCurve::new(3, points, Vec::new(), knots).unwrap();
    let cusp = edge(Curve::Nurbs(cusp), [-1.0, 1.0]);
    let expected = 2.0 * (13.0 * 13f64.sqrt() - 8.0) / 27.0;
    assert!((facts(first_edge(&cusp)).length_mm.unwrap() - expected).abs() < 1e-8);
    let corners = vec![DVec3::ZERO, DVec3::X * 3.0, DVec3::new(3.0, 4.0, 0.0)];
    let polyline = edge(Curve::Polyline(Polyline { points: corners }), [0.0, 2.0]);
    let found = facts(first_edge(&polyline));
    assert_eq!(found.kind, "polyline");
    assert_near(found.length_mm.unwrap(), 7.0);
}

#[test]
fn curves_that_are_lines() {
    let points = vec![DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), DVec3::new(3.0, 3.0, 0.0)];
    let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    let spline = Curve::Nurbs(NurbsCurve::new(2, points.clone(), Vec::new(), knots).unwrap());
    let found = facts(first_edge(&edge(spline.clone(), [0.0, 1.0])));
    assert_eq!(found.kind, "line");
    assert_near(found.length_mm.unwrap(), 18f64.sqrt());
    let segment = CompositeSegment { curve: spline, range: Interval::new(0.0, 1.0), reversed: false };
    let composite = Curve::Composite(CompositeCurve { segments: vec![segment] });
    assert_eq!(facts(first_edge(&edge(composite, [0.0, 1.0]))).kind, "line");
    assert_eq!(facts(first_edge(&edge(Curve::Polyline(Polyline { points }), [0.0, 2.0]))).kind, "line");
}

/// Faces whose areas OpenCASCADE integrates too coarsely: ours do not change with the triangles that they are taken over.
/// The patch of degree 5 is proved below; the cut sphere has `2 π r (r + d) = 909.311120`, d = sqrt 20.
const COARSE_REFERENCES: [&str; 5] = [
    "bspline_degree_5 #17",
    "sweep_along_spline #17",
    "sphere_cut_through_pole #17",
    "filled_surface #17",
    "loft_smooth #298",
];

/// Every face's area that the references give, of all fixtures that have them.
#[test]
fn areas_of_all_fixtures() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/cadquery");
    let mut compared = 0;
    let mut off = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let Some(stem) = name.strip_suffix(".reference.json") else { continue };
        let reference: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        let Some(areas) = reference["face_areas_mm2"].as_array().filter(|areas| areas.len() <= 40) else {
            continue;
        };
        let model = model(&format!("cadquery/{stem}.step"));
        for part in &model.parts {
            for (k, face) in part.faces.iter().enumerate() {
                let entity = face.entity.to_string();
                let mut of_face = areas.iter().filter(|a| a["entity"] == *entity);
                let (Some(area), None) = (of_face.next(), of_face.next()) else { continue };
                let expected = area["area_mm2"].as_f64().unwrap();
                let feature = trimloop_measure::Feature::Face(k as u32);
                let item = Item { part, transform: DAffine3::IDENTITY, feature };
                let found = facts(item).area_mm2.unwrap_or(0.0);
                compared += 1;
                let share = (found - expected).abs() / expected;
                let name = format!("{stem} {entity}");
                if share > 1e-6 && !COARSE_REFERENCES.contains(&&*name) {
                    off.push(format!("{name}: {found} for {expected}, {share:.1e}"));
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
    assert!(off.is_empty(), "{} of {compared}:\n{}", off.len(), off.join("\n"));
}

/// A patch without trims, by Gauss' product rule over each of many parts of its spans.
#[test]
fn the_area_of_a_spline_patch_by_another_rule() {
    let model = model("cadquery/bspline_degree_5.step");
    let patch = of_kind(&faces(&model), "B-spline surface");
    let surface = surface_of(&patch);
    let [us, vs] =
        [Direction::U, Direction::V].map(|d| parts(&surface.breakpoints(d, surface.domain()[d as usize])));
    let area = |u: &Interval, v: &Interval| {
        let rule = [-1.0, 0.0, 1.0]
            .map(|k: f64| (0.5 + k * 0.15f64.sqrt(), if k == 0.0 { 4.0 / 9.0 } else { 5.0 / 18.0 }));
        let mut sum = 0.0;
        for (x, wx) in rule {
            for (y, wy) in rule {
                let d = surface.derivatives(DVec2::new(u.at(x), v.at(y)));
                sum += d.du.cross(d.dv).length() * wx * wy;
            }
        }
        sum * u.length() * v.length()
    };
    let expected: f64 = us.iter().flat_map(|u| vs.iter().map(move |v| (u, v))).map(|(u, v)| area(u, v)).sum();
    assert!((facts(patch).area_mm2.unwrap() / expected - 1.0).abs() < 1e-9);
}

/// Each span in twenty.
fn parts(breaks: &[f64]) -> Vec<Interval> {
    let spans = breaks.windows(2).map(|w| Interval::new(w[0], w[1]));
    let part = |span: Interval, k: u32| {
        Interval::new(span.at(f64::from(k) / 20.0), span.at(f64::from(k + 1) / 20.0))
    };
    spans.flat_map(|span| (0..20).map(move |k| part(span, k))).collect()
}

#[test]
fn the_area_of_a_sphere_cut_through_its_pole() {
    let model = model("cadquery/sphere_cut_through_pole.step");
    let found = facts(of_kind(&faces(&model), "sphere")).area_mm2.unwrap();
    assert!((found / (20.0 * PI * (10.0 + 20f64.sqrt())) - 1.0).abs() < 1e-9, "{found}");
}

#[test]
fn what_has_no_geometry() {
    let mut model = model("cadquery/box.step");
    let part = &mut model.parts[0];
    part.faces[0].geometry = trimloop_brep::FaceGeometry::Unreadable("why".into());
    part.edges[0].curve = Arc::new(Curve::Line { origin: DVec3::NAN, direction: DVec3::X });
    let all = faces(&model);
    assert_eq!(facts(all[0]).kind, "unreadable");
    assert_eq!(trimloop_measure::between(all[0], all[1]), None);
    let none = Item { feature: trimloop_measure::Feature::Edge(999), ..all[0] };
    assert_eq!(facts(none).kind, "unreadable");
    assert_eq!(trimloop_measure::between(none, all[1]), None);
    // Numbers that make no sense do no harm.
    for item in edges(&model) {
        trimloop_measure::between(item, all[2]);
        facts(item);
    }
    let flat = moved(all[1], DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0)));
    trimloop_measure::between(flat, all[2]);
    facts(flat);
}
