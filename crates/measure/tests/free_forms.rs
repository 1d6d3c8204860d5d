//! Distances that have no closed form: against dense samples, and by what must hold at a minimum.

mod fixture;

use std::sync::Arc;

use fixture::*;
use trimloop_brep::{EntityRef, Face, FaceGeometry, Facets, Model, Part};
use trimloop_geom::{Aabb, Curve, DAffine3, DMat3, DVec2, DVec3, NurbsCurve, NurbsSurface, Surface};
use trimloop_measure::{Feature, Item, between};
use trimloop_mesh::{FaceMesh, LinearDeflection, MeshOptions, Silent, mesh_part};

#[test]
fn a_spline_hill_under_a_plane() {
    let (hill, block) = (model("cadquery/spline_hill.step"), model("cadquery/box.step"));
    let patch = of_kind(&faces(&hill), "B-spline surface");
    let map = DAffine3::from_translation(DVec3::new(15.0, 15.0, 20.0))
        * DAffine3::from_scale(DVec3::new(3.0, 3.0, 1.0));
    for tilt in [0.0, 0.1, -0.2] {
        let plane = moved(facing(&faces(&block), DVec3::NEG_Z), map * DAffine3::from_rotation_y(tilt));
        let found = measure(patch, plane);
        assert!(found.is_exact);
        let normal = plane.transform.transform_vector3(DVec3::Z);
        let normal =
            (plane.transform.matrix3.inverse().transpose() * DVec3::Z).normalize() * normal.z.signum();
        let origin = plane.transform.transform_point3(DVec3::new(0.0, 0.0, -5.0));
        let surface = surface_of(&patch);
        let [u, v] = surface.domain();
        let shares =
            (0..=400).flat_map(|i| (0..=400).map(move |j| (f64::from(i) / 400.0, f64::from(j) / 400.0)));
        let heights = shares
            .map(|(s, t)| surface.point(DVec2::new(u.at(s), v.at(t))))
            .map(|p| (origin - p).dot(normal));
        let brute = heights.fold(f64::INFINITY, f64::min);
        assert!(found.distance_mm <= brute + 1e-9 && brute - found.distance_mm < 1e-3, "{found:?} {brute}");
        // Inside of the patch the shortest way is square to both.
        assert!(found.delta.normalize().cross(normal).length() < 1e-7, "{found:?}");
    }
}

#[test]
fn a_spline_curve_and_its_bounding_plane() {
    let points =
        vec![DVec3::ZERO, DVec3::new(2.0, 1.0, 5.0), DVec3::new(4.0, -1.0, 7.0), DVec3::new(6.0, 0.0, 1.0)];
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let spline = NurbsCurve::new(3, points, Vec::new(), knots).unwrap();
    let highest = (0..=100_000).map(|k| spline.point(f64::from(k) / 1e5).z).fold(0.0, f64::max);
    let part = edge(Curve::Nurbs(spline), [0.0, 1.0]);
    let block = model("cadquery/box.step");
    let above =
        moved(facing(&faces(&block), DVec3::NEG_Z), DAffine3::from_translation(DVec3::new(0.0, 0.0, 25.0)));
    let found = measure(first_edge(&part), above);
    assert!((found.distance_mm - (20.0 - highest)).abs() < 1e-8);
}

/// The nearest corner of a polyline, where no derivative vanishes.
#[test]
fn a_corner_of_a_curve() {
    let points = vec![DVec3::new(-4.0, 0.0, 0.0), DVec3::new(0.0, 0.0, 3.0), DVec3::new(5.0, 1.0, 0.0)];
    let knots = vec![0.0, 0.0, 1.0, 2.0, 2.0];
    let part = edge(Curve::Nurbs(NurbsCurve::new(1, points, Vec::new(), knots).unwrap()), [0.0, 2.0]);
    let tip = vertex(DVec3::new(0.5, 0.0, 9.0));
    let found = measure(first_edge(&part), first_vertex(&tip));
    assert!(found.is_exact);
    assert_near(found.distance_mm, 36.25f64.sqrt());
}

/// A face that is the whole of a surface.
fn whole(geometry: FaceGeometry) -> Part {
    let face = Face {
        entity: EntityRef::None,
        name: String::new(),
        geometry,
        same_sense: true,
        loops: Vec::new(),
        color: None,
        hidden: false,
    };
    Part { faces: vec![face], ..Part::default() }
}

fn first_face(part: &Part) -> Item<'_> {
    Item { part, transform: DAffine3::IDENTITY, feature: Feature::Face(0) }
}

/// Two slopes that meet in a ridge at x = 0, z = 2, over -3..3 by 0..5; as a spline of no edges.
fn roof() -> Part {
    let points =
        [-3.0, 0.0, 3.0].iter().flat_map(|&x: &f64| [0.0, 5.0].map(|y| DVec3::new(x, y, 2.0 - x.abs())));
    let knots = [vec![0.0, 0.0, 1.0, 2.0, 2.0], vec![0.0, 0.0, 1.0, 1.0]];
    let surface = NurbsSurface::new([1, 1], 3, 2, points.collect(), Vec::new(), knots).unwrap();
    whole(FaceGeometry::Surface(Arc::new(Surface::Nurbs(surface))))
}

#[test]
fn creases_and_sides_without_edges() {
    let part = roof();
    for (point, expected) in [
        (DVec3::new(0.5, 2.0, 9.0), 49.25f64.sqrt()),
        (DVec3::new(0.0, 8.0, 6.0), 5.0),
        (DVec3::new(6.0, 2.0, -5.0), 5.0),
        (DVec3::new(-5.0, 7.0, -3.0), 12f64.sqrt()),
        (DVec3::new(2.0, 2.0, 4.0), 8f64.sqrt()),
        (DVec3::new(0.25, 2.0, 1.0), 0.75 / 2f64.sqrt()),
    ] {
        let tip = vertex(point);
        let found = measure(first_vertex(&tip), first_face(&part));
        assert!(found.is_exact);
        assert_near(found.distance_mm, expected);
    }
    let across = line(DVec3::new(-2.0, 1.0, 5.0), DVec3::new(2.0, 4.0, 5.0));
    let found = measure(first_edge(&across), first_face(&part));
    assert_near(found.distance_mm, 3.0);
    assert_at(found.points[1], DVec3::new(0.0, 2.5, 2.0));
}

fn faceted() -> Part {
    let facet_points =
        [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let facets = Facets { triangles: vec![[0, 1, 2], [0, 2, 3]], normals: Vec::new() };
    Part { facet_points, ..whole(FaceGeometry::Facets(facets)) }
}

#[test]
fn faces_of_triangles() {
    let part = faceted();
    let item = first_face(&part);
    let ball = model("cadquery/sphere.step");
    let sphere = |at: DVec3| moved(faces(&ball)[0], DAffine3::from_translation(at));
    assert_near(measure(item, sphere(DVec3::new(1.0, 3.0, 12.0))).distance_mm, 2.0);
    assert_near(measure(item, sphere(DVec3::new(16.0, 2.0, 5.0))).distance_mm, 3.0);
    assert_near(measure(item, sphere(DVec3::new(16.0, 13.0, 16.0))).distance_mm, 481f64.sqrt() - 10.0);
    assert_eq!(measure(item, sphere(DVec3::new(2.0, 2.0, 9.9))).distance_mm, 0.0);
    // All of it inside of the ball: a corner is nearest.
    assert_near(measure(item, sphere(DVec3::new(2.0, 2.0, 9.0))).distance_mm, 10.0 - 89f64.sqrt());
    let above = moved(item, DAffine3::from_translation(DVec3::new(1.0, 1.0, 6.0)));
    assert_near(measure(item, above).distance_mm, 6.0);
    let facts = trimloop_measure::facts(item);
    assert_eq!(facts.kind, "triangles");
    assert_near(facts.area_mm2.unwrap(), 16.0);
}

/// Where both are moved alike, nothing but the places changes.
#[test]
fn measures_go_with_the_items() {
    let model = model("cadquery/assembly_nested.step");
    let faces = faces(&model);
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 1.0, 3.0).normalize(), 2.1);
    let map = DAffine3 { matrix3: turn * 2.0, translation: DVec3::new(-7.0, 40.0, 11.0) };
    for pair in faces.windows(8).step_by(3).map(|w| (w[0], w[7])) {
        let here = measure(pair.0, pair.1);
        let there = measure(moved(pair.0, map), moved(pair.1, map));
        assert!((here.distance_mm * 2.0 - there.distance_mm).abs() < 1e-8, "{here:?} {there:?}");
        assert_eq!(here.angle_deg.is_some(), there.angle_deg.is_some());
        if let (Some(here), Some(there)) = (here.axis_distance_mm, there.axis_distance_mm) {
            assert!((here * 2.0 - there).abs() < 1e-7);
        }
    }
}

/// Numbers that look random and are the same every time (Knuth's MMIX constants).
struct Numbers(u64);

impl Numbers {
    /// From 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }

    fn one_of<'t, T>(&mut self, list: &'t [T]) -> &'t T {
        &list[((self.next() * list.len() as f64) as usize).min(list.len() - 1)]
    }

    /// Components from -0.5 to 0.5.
    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) - 0.5
    }
}

/// A face, points all over it (none farther off than the deflection), and how far apart they are.
struct Samples<'a> {
    item: Item<'a>,
    points: Vec<DVec3>,
    apart: f64,
}

/// The samples of all faces of a model that is a single part.
fn samples(model: &Model) -> Vec<Samples<'_>> {
    let options = MeshOptions {
        linear_deflection: LinearDeflection::Absolute(DEFLECTION_MM),
        ..MeshOptions::default()
    };
    let items = faces(model);
    let mesh = mesh_part(items[0].part, &options, &Silent).unwrap();
    items.into_iter().zip(&mesh.faces).map(|(item, face)| samples_of(item, &mesh.positions, face)).collect()
}

fn samples_of<'a>(item: Item<'a>, positions: &[DVec3], face: &FaceMesh) -> Samples<'a> {
    let n = ((1000.0 / face.triangles.len().max(1) as f64).sqrt().ceil() as u32).max(1);
    let (mut points, mut apart) = (Vec::new(), 0.0_f64);
    for t in &face.triangles {
        let corners = t
            .map(|i| item.transform.transform_point3(positions[face.vertices[i as usize].position as usize]));
        apart =
            (0..3).map(|k| corners[k].distance(corners[(k + 1) % 3]) / f64::from(n)).fold(apart, f64::max);
        let shares = (0..=n)
            .flat_map(|i| (0..=n - i).map(move |j| [i, j, n - i - j].map(|k| f64::from(k) / f64::from(n))));
        points.extend(shares.map(|[a, b, c]| corners[0] * a + corners[1] * b + corners[2] * c));
    }
    Samples { item, points, apart }
}

const DEFLECTION_MM: f64 = 0.05;

#[test]
fn no_samples_are_nearer() {
    let names = [
        "torus_with_hole",
        "spline_hill_drilled",
        "offset_surface",
        "sphere_cap_off_axis",
        "loft_airfoil",
        "thread",
        "cone_cut_in_hyperbola",
        "sweep_along_spline",
        "spline_revolved_partly",
        "bspline_rational",
        "pipe_tee",
        "plate_perforated",
        "bare_torus",
        "twisted_bar",
        "viviani",
        "hyperboloid_of_one_sheet",
    ];
    let models = names.map(|name| model(&format!("cadquery/{name}.step")));
    let samples: Vec<Samples> = models.iter().flat_map(samples).collect();
    let mut numbers = Numbers(1);
    for _ in 0..100 {
        let (a, b) = (numbers.one_of(&samples), numbers.one_of(&samples));
        let bounds = [a, b].map(|face| Aabb::from_points(face.points.iter().copied()));
        let size = bounds[0].diagonal() + bounds[1].diagonal();
        let turn = DMat3::from_axis_angle(numbers.vector().normalize(), numbers.next() * 3.0);
        let translation = bounds[0].center() + numbers.vector() * size - turn * bounds[1].center();
        let map = DAffine3 { matrix3: turn, translation };
        let points_b: Vec<DVec3> = b.points.iter().map(|p| map.transform_point3(*p)).collect();
        let pairs = a.points.iter().flat_map(|p| points_b.iter().map(move |q| p.distance_squared(*q)));
        let nearest = pairs.fold(f64::INFINITY, f64::min).sqrt();
        let found = between(a.item, moved(b.item, map)).unwrap();
        let names = [a, b].map(|face| format!("{} {:?}", face.item.part.name, face.item.feature));
        assert!(found.is_exact, "{names:?}");
        assert!(
            found.distance_mm <= nearest + 2.0 * DEFLECTION_MM,
            "{names:?}: {found:?}, samples {nearest}"
        );
        let slack = 2.0 * DEFLECTION_MM + a.apart + b.apart;
        assert!(nearest <= found.distance_mm + slack, "{names:?}: {found:?}, samples {nearest}");
    }
}

/// The ends of a line, on and beside the curved face that it goes through.
#[test]
fn edges_through_and_beside_faces() {
    let ball = model("cadquery/sphere.step");
    let sphere = faces(&ball)[0];
    let through = line(DVec3::new(-30.0, 1.0, 2.0), DVec3::new(30.0, 2.0, 3.0));
    assert_eq!(measure(sphere, first_edge(&through)).distance_mm, 0.0);
    let inside = line(DVec3::new(-3.0, 0.0, 0.0), DVec3::new(4.0, 0.0, 0.0));
    assert_near(measure(sphere, first_edge(&inside)).distance_mm, 6.0);
    let curve = Curve::Line { origin: DVec3::new(12.0, -9.0, 0.0), direction: DVec3::Y };
    let beside = edge(curve, [0.0, 30.0]);
    assert_near(measure(sphere, first_edge(&beside)).distance_mm, 2.0);
}
