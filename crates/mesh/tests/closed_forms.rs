//! Bodies whose area and volume are known in closed form, built edge by edge.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;
use trimloop_brep::{
    Body, BodyKind, Coedge, Edge, EntityRef, Face, FaceGeometry, Loop, Part, Shell, ShellFace, Vertex,
};
use trimloop_geom::{Curve, Direction, Frame, Interval, NurbsSurface, Surface};
use trimloop_mesh::{FaceStatus, LinearDeflection, MeshOptions, PartMesh, Silent, mesh_part};

/// Builds a part with one shell.
#[derive(Default)]
struct Builder {
    part: Part,
}

impl Builder {
    fn vertex(&mut self, point: DVec3) -> u32 {
        self.part.vertices.push(Vertex { entity: EntityRef::None, point });
        self.part.vertices.len() as u32 - 1
    }

    fn edge(&mut self, start: u32, end: u32, curve: Curve, range: Interval) -> u32 {
        let curve = Arc::new(curve);
        self.part.edges.push(Edge { entity: EntityRef::None, start, end, curve, range, same_sense: true });
        self.part.edges.len() as u32 - 1
    }

    /// A full circle about +Z.
    fn circle(&mut self, radius: f64, z: f64) -> u32 {
        let frame = Frame { origin: DVec3::Z * z, ..Frame::WORLD };
        let start = self.vertex(DVec3::new(radius, 0.0, z));
        self.edge(start, start, Curve::Circle { frame, radius }, Interval::new(0.0, TAU))
    }

    /// A face with single-edge loops.
    fn face(&mut self, surface: Surface, same_sense: bool, loops: &[&[(u32, bool)]]) {
        let coedge = |&(edge, reversed): &(u32, bool)| Coedge { edge, reversed, pcurve: None };
        let loops = loops
            .iter()
            .map(|l| Loop { coedges: l.iter().map(coedge).collect(), ..Loop::default() })
            .collect();
        self.part.faces.push(Face {
            entity: EntityRef::Step(self.part.faces.len() as u64),
            name: String::new(),
            geometry: FaceGeometry::Surface(Arc::new(surface)),
            same_sense,
            loops,
            color: None,
            hidden: false,
        });
    }

    fn mesh(self, solid: bool, deflection: f64) -> PartMesh {
        self.mesh_of(solid, deflection, MeshOptions::default().max_triangles)
    }

    fn mesh_of(mut self, solid: bool, deflection: f64, max_triangles: usize) -> PartMesh {
        let faces =
            (0..self.part.faces.len() as u32).map(|face| ShellFace { face, reversed: false }).collect();
        let shell = Shell { entity: EntityRef::Step(1000), closed: solid, void: false, faces };
        self.part.bodies.push(Body {
            name: String::new(),
            entity: EntityRef::None,
            kind: if solid { BodyKind::Solid } else { BodyKind::Sheet },
            shells: vec![shell],
            layers: Vec::new(),
        });
        let options = MeshOptions {
            linear_deflection: LinearDeflection::Absolute(deflection),
            angular_deflection_rad: 10f64.to_radians(),
            max_triangles,
        };
        mesh_part(&self.part, &options, &Silent).expect("not cancelled")
    }
}

fn area(mesh: &PartMesh) -> f64 {
    mesh.faces.iter().map(|f| f.area_mm2).sum()
}

fn assert_closed(mesh: &PartMesh, area_mm2: f64, volume_mm3: f64) {
    assert_eq!(mesh.shells[0].open_edges, 0, "open edges");
    for face in &mesh.faces {
        assert_eq!(face.status, FaceStatus::Exact);
    }
    assert!((area(mesh) / area_mm2 - 1.0).abs() < 5e-3, "area {} for {area_mm2}", area(mesh));
    let volume = mesh.shells[0].volume_mm3;
    assert!((volume / volume_mm3 - 1.0).abs() < 1e-2, "volume {volume} for {volume_mm3}");
    assert_balanced(mesh);
}

/// Every directed triangle edge has its opposite.
fn assert_balanced(mesh: &PartMesh) {
    let mut net = std::collections::HashMap::new();
    for face in &mesh.faces {
        for t in &face.triangles {
            let [a, b, c] = t.map(|i| face.vertices[i as usize].position);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                *net.entry((p.min(q), p.max(q))).or_insert(0) += if p < q { 1 } else { -1 };
            }
        }
    }
    assert!(net.values().all(|&n| n == 0), "{} unbalanced edges", net.values().filter(|&&n| n != 0).count());
}

fn assert_within(mesh: &PartMesh, distance: impl Fn(DVec3) -> f64, bound: f64) {
    for face in &mesh.faces {
        for t in &face.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[face.vertices[i as usize].position as usize]);
            for i in 0..=6 {
                for j in 0..=(6 - i) {
                    let (u, v) = (f64::from(i) / 6.0, f64::from(j) / 6.0);
                    let p = a * (1.0 - u - v) + b * u + c * v;
                    assert!(distance(p) <= bound, "{} off at {p}", distance(p));
                }
            }
        }
    }
}

fn sphere(radius: f64) -> Surface {
    Surface::Sphere { frame: Frame::WORLD, radius }
}

fn cylinder(radius: f64) -> Surface {
    Surface::Cylinder { frame: Frame::WORLD, radius }
}

fn plane(z: f64) -> Surface {
    Surface::Plane { frame: Frame { origin: DVec3::Z * z, ..Frame::WORLD } }
}

fn torus(major: f64, minor: f64) -> Surface {
    Surface::Torus { frame: Frame::WORLD, major, minor, v_range: None }
}

#[test]
fn a_whole_sphere_needs_no_bound() {
    let mut b = Builder::default();
    b.face(sphere(10.0), true, &[]);
    let mesh = b.mesh(true, 0.01);
    assert_closed(&mesh, 400.0 * PI, 4000.0 / 3.0 * PI);
    assert_within(&mesh, |p| (p.length() - 10.0).abs(), 0.01);
}

#[test]
fn a_whole_torus_needs_no_bound() {
    let mut b = Builder::default();
    b.face(torus(10.0, 3.0), true, &[]);
    let mesh = b.mesh(true, 0.01);
    assert_closed(&mesh, 4.0 * PI * PI * 30.0, 2.0 * PI * PI * 90.0);
    assert_within(&mesh, |p| ((p.truncate().length() - 10.0).hypot(p.z) - 3.0).abs(), 0.01);
}

#[test]
fn a_cylinder_without_a_seam_is_cut_open_and_closed_again() {
    let mut b = Builder::default();
    let (low, high) = (b.circle(5.0, 0.0), b.circle(5.0, 20.0));
    b.face(cylinder(5.0), true, &[&[(low, false)], &[(high, true)]]);
    b.face(plane(0.0), false, &[&[(low, true)]]);
    b.face(plane(20.0), true, &[&[(high, false)]]);
    let mesh = b.mesh(true, 0.01);
    assert_closed(&mesh, 2.0 * PI * 25.0 + TAU * 5.0 * 20.0, PI * 25.0 * 20.0);
}

#[test]
fn a_cylinder_with_a_seam_edge_closes_over_it() {
    let mut b = Builder::default();
    let (low, high) = (b.circle(5.0, 0.0), b.circle(5.0, 20.0));
    let line = Curve::Line { origin: DVec3::X * 5.0, direction: DVec3::Z };
    let seam = b.edge(0, 1, line, Interval::new(0.0, 20.0));
    b.face(cylinder(5.0), true, &[&[(low, false), (seam, false), (high, true), (seam, true)]]);
    b.face(plane(0.0), false, &[&[(low, true)]]);
    b.face(plane(20.0), true, &[&[(high, false)]]);
    assert_closed(&b.mesh(true, 0.01), 2.0 * PI * 25.0 + TAU * 5.0 * 20.0, PI * 25.0 * 20.0);
}

#[test]
fn a_cone_reaches_its_apex() {
    let mut b = Builder::default();
    let rim = b.circle(6.0, 0.0);
    // Radius 6 at z = 0, narrowing upwards to the apex at z = 8.
    let half_angle_rad = -(6f64 / 8.0).atan();
    b.face(Surface::Cone { frame: Frame::WORLD, radius: 6.0, half_angle_rad }, true, &[&[(rim, false)]]);
    b.face(plane(0.0), false, &[&[(rim, true)]]);
    assert_closed(&b.mesh(true, 0.01), PI * 36.0 + PI * 60.0, PI * 36.0 * 8.0 / 3.0);
}

#[test]
fn a_sphere_cap_holds_its_pole() {
    let mut b = Builder::default();
    let rim = b.circle(8.0, 6.0);
    b.face(sphere(10.0), true, &[&[(rim, false)]]);
    b.face(plane(6.0), false, &[&[(rim, true)]]);
    let h = 4.0;
    assert_closed(&b.mesh(true, 0.01), TAU * 10.0 * h + PI * 64.0, PI * h * h * (30.0 - h) / 3.0);
}

#[test]
fn a_sphere_below_a_circle_is_the_rest_of_it() {
    let mut b = Builder::default();
    let rim = b.circle(8.0, 6.0);
    b.face(sphere(10.0), true, &[&[(rim, true)]]);
    b.face(plane(6.0), true, &[&[(rim, false)]]);
    let h = 16.0;
    assert_closed(&b.mesh(true, 0.01), TAU * 10.0 * h + PI * 64.0, PI * h * h * (30.0 - h) / 3.0);
}

#[test]
fn a_sphere_with_a_hole_off_its_poles_is_the_complement() {
    let mut b = Builder::default();
    // A circle of radius 6 about +X at x = 8, clockwise seen from outside: the face is everything else.
    let frame = Frame::new(DVec3::X * 8.0, DVec3::X, DVec3::Y);
    let start = b.vertex(DVec3::new(8.0, 6.0, 0.0));
    let rim = b.edge(start, start, Curve::Circle { frame, radius: 6.0 }, Interval::new(0.0, TAU));
    b.face(sphere(10.0), true, &[&[(rim, true)]]);
    b.face(Surface::Plane { frame }, true, &[&[(rim, false)]]);
    let h = 18.0;
    assert_closed(&b.mesh(true, 0.01), TAU * 10.0 * h + PI * 36.0, PI * h * h * (30.0 - h) / 3.0);
}

#[test]
fn half_a_sphere_through_its_poles_by_one_circle() {
    let mut b = Builder::default();
    // The great circle in the plane y = 0, about +Y: the face lies on its +y side.
    let frame = Frame::new(DVec3::ZERO, -DVec3::Y, DVec3::X);
    let start = b.vertex(DVec3::X * 10.0);
    let rim = b.edge(start, start, Curve::Circle { frame, radius: 10.0 }, Interval::new(0.0, TAU));
    b.face(sphere(10.0), true, &[&[(rim, true)]]);
    b.face(Surface::Plane { frame }, true, &[&[(rim, false)]]);
    assert_closed(&b.mesh(true, 0.01), 300.0 * PI, 2000.0 / 3.0 * PI);
}

#[test]
fn an_octant_of_a_sphere_has_a_corner_at_the_pole() {
    let mut b = Builder::default();
    let corners = [DVec3::X, DVec3::Y, DVec3::Z].map(|p| b.vertex(p * 10.0));
    let arc = |b: &mut Builder, from: usize, to: usize| {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let frame = Frame::new(DVec3::ZERO, axes[from].cross(axes[to]), axes[from]);
        b.edge(
            corners[from],
            corners[to],
            Curve::Circle { frame, radius: 10.0 },
            Interval::new(0.0, PI / 2.0),
        )
    };
    let edges = [arc(&mut b, 0, 1), arc(&mut b, 1, 2), arc(&mut b, 2, 0)];
    b.face(sphere(10.0), true, &[&[(edges[0], false), (edges[1], false), (edges[2], false)]]);
    let mesh = b.mesh(false, 0.01);
    assert!((area(&mesh) / (50.0 * PI) - 1.0).abs() < 5e-3, "area {}", area(&mesh));
    assert_within(&mesh, |p| (p.length() - 10.0).abs(), 0.01);
}

#[test]
fn a_tube_bend_is_a_torus_between_two_circles() {
    let mut b = Builder::default();
    let ring = |b: &mut Builder, turn: f64| {
        let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
        let frame = Frame::new(out * 10.0, out.cross(DVec3::Z), out);
        let start = b.vertex(out * 13.0);
        (b.edge(start, start, Curve::Circle { frame, radius: 3.0 }, Interval::new(0.0, TAU)), frame)
    };
    let (first, first_frame) = ring(&mut b, 0.0);
    let (second, second_frame) = ring(&mut b, PI / 2.0);
    // Both circles run towards higher v, which leaves lower u on the left.
    b.face(torus(10.0, 3.0), true, &[&[(first, true)], &[(second, false)]]);
    b.face(Surface::Plane { frame: first_frame }, true, &[&[(first, false)]]);
    b.face(Surface::Plane { frame: second_frame }, false, &[&[(second, true)]]);
    let mesh = b.mesh(true, 0.01);
    let whole = 4.0 * PI * PI * 30.0;
    assert!((area(&mesh) / (whole / 4.0 + 18.0 * PI) - 1.0).abs() < 5e-3, "area {}", area(&mesh));
    assert_eq!(mesh.shells[0].open_edges, 0);
    assert!((mesh.shells[0].volume_mm3 / (PI * PI * 90.0 / 2.0) - 1.0).abs() < 1e-2);
}

#[test]
fn a_face_that_looks_the_wrong_way_is_turned_and_reported() {
    let mut b = Builder::default();
    let (low, high) = (b.circle(5.0, 0.0), b.circle(5.0, 20.0));
    b.face(cylinder(5.0), true, &[&[(low, false)], &[(high, true)]]);
    b.face(plane(0.0), true, &[&[(low, true)]]);
    b.face(plane(20.0), true, &[&[(high, false)]]);
    let mesh = b.mesh(true, 0.01);
    assert_closed(&mesh, 2.0 * PI * 25.0 + TAU * 5.0 * 20.0, PI * 25.0 * 20.0);
    assert!(mesh.diagnostics.iter().any(|d| d.code == "face-orientation"));
}

#[test]
fn a_body_put_together_from_loose_faces_within_another_is_its_cavity() {
    let mut part = Part::default();
    let mut add = |radius: f64, center: DVec3, entity: EntityRef| {
        let frame = Frame { origin: center, ..Frame::WORLD };
        let face = part.faces.len() as u32;
        part.faces.push(Face {
            entity: EntityRef::Iges(2 * face + 1),
            name: String::new(),
            geometry: FaceGeometry::Surface(Arc::new(Surface::Sphere { frame, radius })),
            same_sense: true,
            loops: Vec::new(),
            color: None,
            hidden: false,
        });
        let faces = vec![ShellFace { face, reversed: false }];
        let shell = Shell { entity: EntityRef::None, closed: true, void: false, faces };
        let (name, layers) = (String::new(), Vec::new());
        part.bodies.push(Body { name, entity, kind: BodyKind::Solid, shells: vec![shell], layers });
    };
    add(10.0, DVec3::ZERO, EntityRef::None);
    add(6.0, DVec3::X, EntityRef::None);
    add(2.0, DVec3::X, EntityRef::None);
    add(1.0, DVec3::X * 30.0, EntityRef::None);
    // A solid that the file itself has is one, wherever it lies.
    add(1.0, DVec3::Z * 8.0, EntityRef::Iges(99));
    let options =
        MeshOptions { linear_deflection: LinearDeflection::Absolute(0.01), ..MeshOptions::default() };
    let mesh = mesh_part(&part, &options, &Silent).expect("not cancelled");
    let signs: Vec<f64> = mesh.shells.iter().map(|shell| shell.volume_mm3.signum()).collect();
    assert_eq!(signs, [1.0, -1.0, 1.0, 1.0, 1.0]);
    let total: f64 = mesh.shells.iter().map(|shell| shell.volume_mm3).sum();
    let exact = 4.0 / 3.0 * PI * (1000.0 - 216.0 + 8.0 + 1.0 + 1.0);
    assert!((total / exact - 1.0).abs() < 0.01, "{total}, not {exact}");
}

/// The loop leads through the apex; run the wrong way, it would go round the other half.
#[test]
fn a_half_cone_is_the_same_half_whichever_way_its_loop_runs() {
    let (radius, height) = (3.0, 4.0);
    for backwards in [false, true] {
        let mut builder = Builder::default();
        let points = [DVec3::ZERO, DVec3::new(radius, 0.0, height), DVec3::new(-radius, 0.0, height)];
        let [apex, first, last] = points.map(|point| builder.vertex(point));
        let line = |from: usize, to: usize| Curve::Line {
            origin: points[from],
            direction: points[to] - points[from],
        };
        let unit = Interval::new(0.0, 1.0);
        let down = builder.edge(apex, first, line(0, 1), unit);
        let frame = Frame { origin: DVec3::Z * height, ..Frame::WORLD };
        let round = builder.edge(first, last, Curve::Circle { frame, radius }, Interval::new(0.0, PI));
        let up = builder.edge(last, apex, line(2, 0), unit);
        let cone =
            Surface::Cone { frame: Frame::WORLD, radius: 0.0, half_angle_rad: (radius / height).atan() };
        let mut bound = [(down, backwards), (round, backwards), (up, backwards)];
        if backwards {
            bound.reverse();
        }
        builder.face(cone, true, &[&bound]);
        let mesh = builder.mesh(false, 0.001);
        assert_eq!(mesh.faces[0].status, FaceStatus::Exact);
        let expected = 0.5 * PI * radius * radius.hypot(height);
        assert!((area(&mesh) / expected - 1.0).abs() < 1e-2, "{} for {expected}", area(&mesh));
    }
}

/// A sheet whose derivative across its border all but vanishes there and points this way and that: the normals turn along
/// a strip of a millionth of a millimetre, which no refinement can settle.
#[test]
fn normals_that_flutter_along_a_border_are_not_followed() {
    const SPANS: usize = 8;
    let rows = [0.0, 1e-9, 10.0, 20.0];
    let points = rows.iter().enumerate().flat_map(|(row, &x)| {
        (0..=SPANS).map(move |k| {
            let turn = if row == 1 { 2.4 * k as f64 } else { 0.0 };
            DVec3::new(x * turn.cos(), 5.0 * k as f64, x * turn.sin())
        })
    });
    let knots = std::iter::once(0).chain(0..=SPANS).chain([SPANS]).map(|k| k as f64).collect();
    let across = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let sheet = NurbsSurface::new([3, 1], 4, SPANS + 1, points.collect(), Vec::new(), [across, knots]);
    let length = 5.0 * SPANS as f64;
    let mut builder = Builder::default();
    let corners =
        [[0.0, 0.0], [20.0, 0.0], [20.0, length], [0.0, length]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let vertices = corners.map(|corner| builder.vertex(corner));
    let sides: Vec<(u32, bool)> = (0..4)
        .map(|k| {
            let (from, to) = (k, (k + 1) % 4);
            let line = Curve::Line { origin: corners[from], direction: corners[to] - corners[from] };
            (builder.edge(vertices[from], vertices[to], line, Interval::new(0.0, 1.0)), false)
        })
        .collect();
    builder.face(Surface::Nurbs(sheet.expect("a sheet")), true, &[&sides]);
    let mesh = builder.mesh(false, 0.01);
    assert_eq!(mesh.faces[0].status, FaceStatus::Exact);
    assert!((area(&mesh) / (20.0 * length) - 1.0).abs() < 1e-6, "{}", area(&mesh));
    assert!(mesh.faces[0].triangles.len() < 1000, "{}", mesh.faces[0].triangles.len());
}

/// A ruled sheet whose last knots differ in their last digits only: what lies between them is a hair's breadth, in which
/// control points give derivatives that are nothing but noise.
#[test]
fn knots_that_differ_in_their_last_digits_do_not_count_as_curvature() {
    const DEGREE: usize = 10;
    let ends = [2.794261401, 23.763765849, 25.267563695, 26.114756964];
    let times = [DEGREE + 1, DEGREE - 1, DEGREE - 1, DEGREE + 1];
    let knots: Vec<f64> = ends.iter().zip(times).flat_map(|(&k, n)| std::iter::repeat_n(k, n)).collect();
    let columns = knots.len() - DEGREE - 1;
    let row = |radius: f64, z: f64| {
        let knots = &knots;
        (0..columns).map(move |k| {
            let angle = 0.1 * knots[k + 1..=k + DEGREE].iter().sum::<f64>() / DEGREE as f64;
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        })
    };
    let points = row(8.0, 0.0).chain(row(7.0, 3.0)).collect();
    let across = vec![0.0, 0.0, 22.473302294, 22.473302294];
    let sheet = NurbsSurface::new([1, DEGREE], 2, columns, points, Vec::new(), [across, knots.clone()]);
    let sheet = sheet.expect("a sheet");
    let area_of = |end: f64| {
        let part = sheet
            .restricted([Interval::new(0.0, 22.473302294), Interval::new(ends[0], end)])
            .expect("a part");
        let mut builder = Builder::default();
        let [u, v] = part.domain();
        let corners = [(u.start, v.start), (u.end, v.start), (u.end, v.end), (u.start, v.end)]
            .map(|(u, v)| builder.vertex(part.point(glam::DVec2::new(u, v))));
        let isocurve = |constant, at| part.isocurve(constant, at).expect("a side");
        let sides = [
            (isocurve(Direction::V, v.start), [0, 1], false),
            (isocurve(Direction::U, u.end), [1, 2], false),
            (isocurve(Direction::V, v.end), [3, 2], true),
            (isocurve(Direction::U, u.start), [0, 3], true),
        ];
        let sides = sides.map(|(curve, [from, to], reversed)| {
            let range = curve.domain();
            (builder.edge(corners[from], corners[to], Curve::Nurbs(curve), range), reversed)
        });
        builder.face(Surface::Nurbs(part), true, &[&sides]);
        let mesh = builder.mesh(false, 0.01);
        assert_eq!(mesh.faces[0].status, FaceStatus::Exact);
        area(&mesh)
    };
    let (at_knot, beside) = (area_of(ends[2]), area_of(ends[2] + 1e-9));
    assert!((beside / at_knot - 1.0).abs() < 1e-3, "{beside} beside {at_knot}");
}

/// A polygon that runs out to a point and back over itself, past its own corner.
#[test]
fn a_spike_of_no_width_adds_no_area() {
    let mut builder = Builder::default();
    let points =
        [[0.0, 0.0], [0.0, -4.0], [1.0, -4.0], [1.0, 0.0], [5.0, 0.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let vertices = points.map(|point| builder.vertex(point));
    let sides: Vec<(u32, bool)> = (0..points.len())
        .map(|k| {
            let (from, to) = (k, (k + 1) % points.len());
            let line = Curve::Line { origin: points[from], direction: points[to] - points[from] };
            (builder.edge(vertices[from], vertices[to], line, Interval::new(0.0, 1.0)), false)
        })
        .collect();
    builder.face(Surface::Plane { frame: Frame::WORLD }, true, &[&sides]);
    let mesh = builder.mesh(false, 0.01);
    assert!((area(&mesh) - 4.0).abs() < 1e-12, "{}", area(&mesh));
    assert_eq!(mesh.faces[0].status, FaceStatus::Exact);
}

/// With too few triangles for the bound, the distance that is left is told, not only those that were accepted.
#[test]
fn what_is_left_above_the_bound_is_told() {
    let mut builder = Builder::default();
    builder.face(sphere(100.0), true, &[]);
    let mesh = builder.mesh_of(true, 1e-3, 4000);
    assert!(matches!(mesh.faces[0].status, FaceStatus::Approximated(_)), "{:?}", mesh.faces[0].status);
    assert!(mesh.faces[0].max_deviation_mm > 0.01, "{}", mesh.faces[0].max_deviation_mm);
}

/// A strip that winds round a cylinder sixteen thousand times is no face that anything could be made of.
#[test]
fn a_boundary_that_winds_for_ever_is_spanned_by_plain_triangles() {
    let mut builder = Builder::default();
    let surface = Arc::new(cylinder(1.0));
    let corners =
        [[0.0, 0.0], [1e5, 100.0], [1e5, 100.5], [0.0, 0.5]].map(|[u, v]: [f64; 2]| DVec3::new(u, v, 0.0));
    let vertices = corners.map(|uv| builder.vertex(surface.point(uv.truncate())));
    let sides = [0, 1, 2, 3].map(|k| {
        let (from, to) = (k, (k + 1) % 4);
        let line = Curve::Line { origin: corners[from], direction: corners[to] - corners[from] };
        let curve = Curve::OnSurface { surface: surface.clone(), pcurve: Arc::new(line) };
        (builder.edge(vertices[from], vertices[to], curve, Interval::new(0.0, 1.0)), false)
    });
    builder.face(cylinder(1.0), true, &[&sides]);
    let mesh = builder.mesh(false, 0.1);
    let FaceStatus::Approximated(reason) = &mesh.faces[0].status else { panic!("not exact") };
    assert!(reason.contains("thousands of times"), "{reason}");
}
