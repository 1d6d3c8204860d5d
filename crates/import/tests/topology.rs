//! Faces, loops, edges and vertices; solids and shells.

mod deck;

use std::f64::consts::TAU;

use deck::{codes, cuboid, ends, near, part, shape, surface};
use glam::DVec3;
use trimloop_brep::{BodyKind, Part};
use trimloop_geom::Surface;

/// Six times the volume that the faces' polygons enclose; needs straight edges and faces that look outwards.
fn six_volumes(part: &Part) -> f64 {
    let mut sum = 0.0;
    for used in part.bodies.iter().flat_map(|body| &body.shells).flat_map(|shell| &shell.faces) {
        let face = &part.faces[used.face as usize];
        for bound in &face.loops {
            let starts: Vec<DVec3> = bound
                .coedges
                .iter()
                .map(|coedge| {
                    let edge = &part.edges[coedge.edge as usize];
                    part.vertices[if coedge.reversed { edge.end } else { edge.start } as usize].point
                })
                .collect();
            for pair in starts[1..].windows(2) {
                let volume = starts[0].dot(pair[0].cross(pair[1]));
                sum += if used.reversed { -volume } else { volume };
            }
        }
    }
    sum
}

#[test]
fn box_shares_its_edges_and_vertices() {
    let part = part("#100", &cuboid(100, [2.0, 3.0, 4.0]));
    assert_eq!((part.faces.len(), part.edges.len(), part.vertices.len()), (6, 12, 8));
    assert_eq!(part.bodies[0].kind, BodyKind::Solid);
    assert!(part.bodies[0].shells[0].closed);
    assert_eq!(six_volumes(&part), 6.0 * 24.0);
    for edge in &part.edges {
        ends(&part, edge);
    }
    let mut uses = vec![[0, 0]; 12];
    for coedge in part.faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges) {
        uses[coedge.edge as usize][usize::from(coedge.reversed)] += 1;
    }
    assert_eq!(uses, [[1, 1]; 12]);
}

/// A bound with orientation `.F.` uses its loop backwards.
#[test]
fn bound_turns_its_loop() {
    let forward = cuboid(100, [2.0, 3.0, 4.0]);
    let turned = |line: &str| {
        if line.contains("FACE_OUTER_BOUND") { line.replace(".T.", ".F.") } else { line.to_owned() }
    };
    let backward: String = forward.lines().map(turned).collect();
    assert_eq!(six_volumes(&part("#100", &backward)), -six_volumes(&part("#100", &forward)));
}

#[test]
fn outer_bounds_are_marked() {
    let data = cuboid(100, [2.0, 3.0, 4.0]);
    let marks = |data: &str| -> Vec<bool> {
        part("#100", data).faces.iter().flat_map(|face| &face.loops).map(|bound| bound.outer).collect()
    };
    assert_eq!(marks(&data), [true; 6]);
    assert_eq!(marks(&data.replace("FACE_OUTER_BOUND", "FACE_BOUND")), [false; 6]);
}

#[test]
fn oriented_faces_and_shells_turn_what_they_use() {
    let part = part(
        "#10",
        &format!(
            "{}#10=MANIFOLD_SOLID_BREP('',#11);#11=ORIENTED_CLOSED_SHELL('',*,#12,.F.);
             #12=CLOSED_SHELL('',(#13,#103,#104,#105,#106,#107));#13=ORIENTED_FACE('',*,#102,.F.);",
            cuboid(100, [1.0, 1.0, 1.0])
        ),
    );
    let reversed: Vec<_> = part.bodies[0].shells[0].faces.iter().map(|face| face.reversed).collect();
    assert_eq!(reversed, [false, true, true, true, true, true]);
}

#[test]
fn voids_are_further_shells() {
    let part = part(
        "#10",
        &format!(
            "{}{}#10=BREP_WITH_VOIDS('hollow',#101,(#11));#11=ORIENTED_CLOSED_SHELL('',*,#301,.F.);",
            cuboid(100, [9.0, 9.0, 9.0]),
            cuboid(300, [1.0, 1.0, 1.0])
        ),
    );
    let body = &part.bodies[0];
    assert_eq!((body.name.as_str(), body.kind), ("hollow", BodyKind::Solid));
    assert_eq!(body.shells.iter().map(|shell| shell.void).collect::<Vec<_>>(), [false, true]);
    assert!(body.shells[1].faces.iter().all(|face| face.reversed));
}

#[test]
fn faceted_solid_with_voids_as_a_complex_instance() {
    let part = part(
        "#10",
        &format!(
            "{}{}#10=(BREP_WITH_VOIDS((#11))FACETED_BREP()GEOMETRIC_REPRESENTATION_ITEM()MANIFOLD_SOLID_BREP(#101)
               REPRESENTATION_ITEM('')SOLID_MODEL());#11=ORIENTED_CLOSED_SHELL('',*,#301,.F.);",
            cuboid(100, [9.0, 9.0, 9.0]),
            cuboid(300, [1.0, 1.0, 1.0])
        ),
    );
    assert_eq!(part.bodies[0].shells.len(), 2);
}

/// A tetrahedron of polygons: faces without surfaces get their planes from the polygons, edges are shared by the
/// points they join.
#[test]
fn polygons_share_edges_by_their_points() {
    let part = part(
        "#9",
        "#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(1.,0.,0.));#3=CARTESIAN_POINT('',(0.,1.,0.));
         #4=CARTESIAN_POINT('',(0.,0.,1.));
         #11=POLY_LOOP('',(#1,#3,#2));#12=POLY_LOOP('',(#1,#2,#4));#13=POLY_LOOP('',(#1,#4,#3));#14=POLY_LOOP('',(#2,#3,#4));
         #21=FACE_BOUND('',#11,.T.);#22=FACE_BOUND('',#12,.T.);#23=FACE_BOUND('',#13,.T.);#24=FACE_BOUND('',#14,.T.);
         #31=FACE('',(#21));#32=FACE('',(#22));#33=FACE('',(#23));#34=FACE('',(#24));
         #8=CLOSED_SHELL('',(#31,#32,#33,#34));#9=FACETED_BREP('',#8);",
    );
    assert_eq!((part.faces.len(), part.edges.len(), part.vertices.len()), (4, 6, 4));
    assert!((six_volumes(&part) - 1.0).abs() < 1e-12);
    let Surface::Plane { frame } = surface(&part.faces[3]) else { panic!() };
    near(frame.z, DVec3::ONE.normalize());
}

#[test]
fn vertex_loop_is_a_vertex() {
    let part = part(
        "#9",
        "#1=SPHERICAL_SURFACE('',#801,2.);#2=CARTESIAN_POINT('',(0.,0.,2.));#3=VERTEX_POINT('',#2);
         #4=VERTEX_LOOP('',#3);#5=FACE_BOUND('',#4,.T.);#6=ADVANCED_FACE('',(#5),#1,.T.);#7=CLOSED_SHELL('',(#6));
         #9=MANIFOLD_SOLID_BREP('',#7);",
    );
    let bound = &part.faces[0].loops[0];
    assert!(bound.coedges.is_empty());
    near(part.vertices[bound.vertex.expect("a vertex") as usize].point, DVec3::new(0.0, 0.0, 2.0));
}

/// An edge on a circle of radius 1 between two of its points, given in quarters, in a face of its own.
fn arc(from: usize, to: usize, sense: &str) -> Part {
    let data = format!(
        "#10=CARTESIAN_POINT('',(1.,0.,0.));#11=CARTESIAN_POINT('',(0.,1.,0.));#12=CARTESIAN_POINT('',(-1.,0.,0.));
         #13=CARTESIAN_POINT('',(0.,-1.,0.));#20=VERTEX_POINT('',#10);#21=VERTEX_POINT('',#11);
         #22=VERTEX_POINT('',#12);#23=VERTEX_POINT('',#13);#1=CIRCLE('',#801,1.);
         #2=EDGE_CURVE('',#{},#{},#1,.{sense}.);#3=ORIENTED_EDGE('',*,*,#2,.T.);#4=EDGE_LOOP('',(#3));
         #5=FACE_BOUND('',#4,.T.);#6=PLANE('',#801);#7=ADVANCED_FACE('',(#5),#6,.T.);#8=OPEN_SHELL('',(#7));
         #9=SHELL_BASED_SURFACE_MODEL('',(#8));",
        20 + from,
        20 + to
    );
    part("#9", &data)
}

#[test]
fn arcs_run_from_their_first_vertex_to_their_second() {
    for (from, to, sense, quarters) in [
        (0, 1, "T", 1.0),
        (1, 0, "T", 3.0),
        (0, 1, "F", 3.0),
        (1, 0, "F", 1.0),
        (3, 0, "T", 1.0),
        (2, 1, "T", 3.0),
    ] {
        let part = arc(from, to, sense);
        let edge = &part.edges[0];
        assert!((edge.range.length() - quarters * TAU / 4.0).abs() < 1e-12, "{from} {to} {sense}: {edge:?}");
        assert_eq!(edge.same_sense, sense == "T");
        ends(&part, edge);
    }
}

#[test]
fn closed_edge_is_a_whole_turn_from_its_vertex() {
    for sense in ["T", "F"] {
        let part = arc(1, 1, sense);
        let edge = &part.edges[0];
        assert_eq!(edge.range.length(), TAU);
        near(edge.curve.point(edge.range.start), DVec3::Y);
    }
}

/// The vertices lie inside the spline, and the edge is the part between them.
#[test]
fn edge_over_a_part_of_a_spline() {
    let data = "#10=CARTESIAN_POINT('',(0.,0.,0.));#11=CARTESIAN_POINT('',(10.,0.,0.));
        #12=CARTESIAN_POINT('',(2.,0.,0.));#13=CARTESIAN_POINT('',(7.,0.,0.));#20=VERTEX_POINT('',#12);
        #21=VERTEX_POINT('',#13);
        #1=B_SPLINE_CURVE_WITH_KNOTS('',1,(#10,#11),.UNSPECIFIED.,.F.,.F.,(2,2),(0.,1.),.UNSPECIFIED.);
        #2=EDGE_CURVE('',#20,#21,#1,.T.);#3=ORIENTED_EDGE('',*,*,#2,.T.);#4=EDGE_LOOP('',(#3));
        #5=FACE_BOUND('',#4,.T.);#6=PLANE('',#801);#7=ADVANCED_FACE('',(#5),#6,.T.);#8=OPEN_SHELL('',(#7));
        #9=SHELL_BASED_SURFACE_MODEL('',(#8));";
    let part = part("#9", data);
    assert!((part.edges[0].range.start - 0.2).abs() < 1e-9 && (part.edges[0].range.end - 0.7).abs() < 1e-9);
}

/// The edge's own curve in the parameters of a spline surface comes along as a hint.
#[test]
fn pcurve_on_a_spline_surface_is_a_hint() {
    let part = part(
        "#9",
        "#11=CARTESIAN_POINT('',(0.,0.,0.));#12=CARTESIAN_POINT('',(0.,1.,0.));#13=CARTESIAN_POINT('',(5.,0.,0.));
         #14=CARTESIAN_POINT('',(5.,1.,0.));#1=BEZIER_SURFACE('',1,1,((#11,#12),(#13,#14)),.UNSPECIFIED.,.F.,.F.,.F.);
         #20=DIRECTION('',(1.,0.,0.));#21=VECTOR('',#20,5.);#22=LINE('',#11,#21);
         #23=CARTESIAN_POINT('',(0.,0.));#24=DIRECTION('',(1.,0.));#25=VECTOR('',#24,1.);#26=LINE('',#23,#25);
         #27=DEFINITIONAL_REPRESENTATION('',(#26),$);#28=PCURVE('',#1,#27);#29=SURFACE_CURVE('',#22,(#28),.PCURVE_S1.);
         #30=VERTEX_POINT('',#11);#31=VERTEX_POINT('',#13);#2=EDGE_CURVE('',#30,#31,#29,.T.);
         #3=ORIENTED_EDGE('',*,*,#2,.T.);#4=EDGE_LOOP('',(#3));#5=FACE_BOUND('',#4,.T.);
         #7=ADVANCED_FACE('',(#5),#1,.T.);#8=OPEN_SHELL('',(#7));#9=SHELL_BASED_SURFACE_MODEL('',(#8));",
    );
    let coedge = &part.faces[0].loops[0].coedges[0];
    let edge = &part.edges[coedge.edge as usize];
    let hint = coedge.pcurve.as_ref().expect("a hint");
    for share in [0.0, 0.3, 1.0] {
        let t = edge.range.at(share);
        near(surface(&part.faces[0]).point(hint.point(t).truncate()), edge.curve.point(t));
    }
}

#[test]
fn shells_and_faces_may_stand_alone() {
    let part = part("#101,#302", &format!("{}{}", cuboid(100, [1.0; 3]), cuboid(300, [1.0; 3])));
    assert_eq!(part.bodies.iter().map(|body| body.kind).collect::<Vec<_>>(), [BodyKind::Sheet; 2]);
    assert_eq!(part.faces.len(), 7);
}

#[test]
fn models_of_connected_face_sets() {
    let part = part(
        "#9",
        &format!(
            "{}#8=CONNECTED_FACE_SET('',(#102,#103));#9=FACE_BASED_SURFACE_MODEL('',(#8));",
            cuboid(100, [1.0; 3])
        ),
    );
    assert_eq!(
        (part.bodies[0].kind, part.bodies[0].shells[0].closed, part.faces.len()),
        (BodyKind::Sheet, false, 2)
    );
}

#[test]
fn solids_that_are_not_boundaries_are_reported() {
    let model = shape("#100,#9", &format!("{}#9=BLOCK('',#801,1.,2.,3.);", cuboid(100, [1.0; 3])));
    assert_eq!(codes(&model), ["unsupported-geometry"]);
}

#[test]
fn files_without_representations_have_a_part_for_each_solid() {
    let model = deck::model(&format!("{}{}", cuboid(300, [1.0; 3]), cuboid(100, [1.0; 3])));
    assert_eq!(model.parts.iter().map(|part| part.entity.to_string()).collect::<Vec<_>>(), ["#300", "#100"]);
    assert_eq!(model.roots, [0, 1]);
}
