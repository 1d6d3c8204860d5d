//! Every surface of ISO 10303-42, as the geometry of a face or standing alone in a geometric set.

mod deck;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use deck::{codes, is_lost, near, part, shape, surface, whole_face};
use glam::{DVec2, DVec3};
use trimloop_geom::{Interval, Surface};

fn at(data: &str, u: f64, v: f64) -> DVec3 {
    surface(&whole_face(data)).point(DVec2::new(u, v))
}

#[test]
fn elementary_surfaces() {
    near(at("#1=PLANE('',#801);", 3.0, 4.0), DVec3::new(3.0, 4.0, 0.0));
    near(at("#1=CYLINDRICAL_SURFACE('',#801,2.);", FRAC_PI_2, 4.0), DVec3::new(0.0, 2.0, 4.0));
    near(at("#1=SPHERICAL_SURFACE('',#801,2.);", 0.3, FRAC_PI_2), DVec3::new(0.0, 0.0, 2.0));
    near(at("#1=TOROIDAL_SURFACE('',#801,5.,2.);", PI, FRAC_PI_2), DVec3::new(-5.0, 0.0, 2.0));
    let cone = "#1=CONICAL_SURFACE('',#801,2.,0.7853981633974483);";
    near(at(cone, 0.0, 3.0), DVec3::new(5.0, 0.0, 3.0));
}

#[test]
fn cone_without_an_angle_is_a_cylinder() {
    assert!(matches!(surface(&whole_face("#1=CONICAL_SURFACE('',#801,2.,0.);")), Surface::Cylinder { .. }));
}

/// Of a torus that crosses itself either the outer part (apple) or the inner one (lemon) is used; both end where
/// it meets its axis, at cos v = -R/r.
#[test]
fn apple_and_lemon() {
    let crossing = (-0.5f64).acos();
    for (outer, range) in
        [("T", Interval::new(-crossing, crossing)), ("F", Interval::new(crossing, TAU - crossing))]
    {
        let face = whole_face(&format!("#1=DEGENERATE_TOROIDAL_SURFACE('',#801,1.,2.,.{outer}.);"));
        let Surface::Torus { v_range: Some(v_range), .. } = surface(&face) else { panic!() };
        assert_eq!(*v_range, range);
        let end = surface(&face).point(DVec2::new(1.0, v_range.end));
        near(DVec3::new(end.x, end.y, 0.0), DVec3::ZERO);
    }
}

/// A lemon about a circle of negative radius is left towards its outside, as its parameters have it.
#[test]
fn a_lemon_of_negative_radius_looks_outwards() {
    let face = whole_face("#1=TOROIDAL_SURFACE('',#801,-1.,2.);");
    let crossing = 0.5f64.acos();
    let Surface::Torus { v_range: Some(range), .. } = surface(&face) else { panic!() };
    assert!((range.end - crossing).abs() < 1e-12 && (range.start + crossing).abs() < 1e-12);
    near(surface(&face).point(DVec2::new(0.0, 0.0)), DVec3::X);
    near(surface(&face).normal(DVec2::new(0.0, 0.0)).expect("a normal"), DVec3::X);
    let foot = surface(&face).project(DVec3::new(0.0, 3.0, 0.0), None);
    near(foot.point, DVec3::Y);
}

/// `TOROIDAL_SURFACE` does not say which part is meant where it crosses itself; the edges do.
#[test]
fn a_torus_that_crosses_itself_is_used_where_the_edges_lie() {
    let crossing = (-0.5f64).acos();
    for (v, range) in
        [(0.4f64, Interval::new(-crossing, crossing)), (PI, Interval::new(crossing, TAU - crossing))]
    {
        let (radius, height) = (1.0 + 2.0 * v.cos(), 2.0 * v.sin());
        let data = format!(
            "#1=TOROIDAL_SURFACE('',#801,1.,2.);#2=CARTESIAN_POINT('',(0.,0.,{height:?}));
             #3=AXIS2_PLACEMENT_3D('',#2,$,$);#4=CIRCLE('',#3,{:?});#5=CARTESIAN_POINT('',({:?},0.,{height:?}));
             #6=VERTEX_POINT('',#5);#7=EDGE_CURVE('',#6,#6,#4,.T.);#8=ORIENTED_EDGE('',*,*,#7,.T.);
             #9=EDGE_LOOP('',(#8));#10=FACE_OUTER_BOUND('',#9,.T.);#700=ADVANCED_FACE('',(#10),#1,.T.);
             #701=OPEN_SHELL('',(#700));#702=SHELL_BASED_SURFACE_MODEL('',(#701));",
            radius.abs(),
            radius.abs(),
        );
        let part = part("#702", &data);
        let Surface::Torus { v_range: Some(v_range), .. } = surface(&part.faces[0]) else { panic!() };
        assert!((v_range.start - range.start).abs() < 1e-12 && (v_range.end - range.end).abs() < 1e-12);
    }
}

#[test]
fn extrusion_goes_as_far_as_its_vector_is_long() {
    let data = "#1=SURFACE_OF_LINEAR_EXTRUSION('',#2,#3);#2=CIRCLE('',#801,2.);#3=VECTOR('',#4,7.);
        #4=DIRECTION('',(0.,0.,3.));";
    near(at(data, 0.0, 1.0), DVec3::new(2.0, 0.0, 7.0));
}

#[test]
fn revolution_turns_by_u() {
    let data = "#1=SURFACE_OF_REVOLUTION('',#2,#3);#2=LINE('',#4,#5);#4=CARTESIAN_POINT('',(3.,0.,0.));
        #5=VECTOR('',#6,1.);#6=DIRECTION('',(0.,0.,1.));#3=AXIS1_PLACEMENT('',#800,#6);";
    near(at(data, FRAC_PI_2, 4.0), DVec3::new(0.0, 3.0, 4.0));
}

/// Nothing but the trims of its profile bounds such a face.
#[test]
fn face_without_bounds_ends_with_the_trimmed_profile() {
    let face = whole_face(
        "#1=SURFACE_OF_REVOLUTION('',#2,#3);#3=AXIS1_PLACEMENT('',#800,#4);#4=DIRECTION('',(1.,0.,0.));
         #2=TRIMMED_CURVE('',#5,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(3.141592653589793)),.T.,.PARAMETER.);
         #5=CIRCLE('',#801,2.);",
    );
    let [_, v] = surface(&face).domain();
    near(surface(&face).point(DVec2::new(0.0, v.start)), DVec3::new(2.0, 0.0, 0.0));
    near(surface(&face).point(DVec2::new(0.0, v.end)), DVec3::new(-2.0, 0.0, 0.0));
}

#[test]
fn offset_surface_and_replica() {
    near(
        at("#1=OFFSET_SURFACE('',#2,0.5,.F.);#2=SPHERICAL_SURFACE('',#801,2.);", 0.0, 0.0),
        DVec3::new(2.5, 0.0, 0.0),
    );
    let replica = "#1=SURFACE_REPLICA('',#2,#3);#2=CYLINDRICAL_SURFACE('',#801,2.);
        #3=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,$,$,#4,2.,$);#4=CARTESIAN_POINT('',(0.,0.,10.));";
    near(at(replica, 0.0, 0.0), DVec3::new(4.0, 0.0, 10.0));
}

#[test]
fn spline_surface_rows_run_over_u() {
    let points = "#11=CARTESIAN_POINT('',(0.,0.,0.));#12=CARTESIAN_POINT('',(0.,1.,0.));
        #13=CARTESIAN_POINT('',(5.,0.,0.));#14=CARTESIAN_POINT('',(5.,1.,4.));";
    let common = "1,1,((#11,#12),(#13,#14)),.UNSPECIFIED.,.F.,.F.,.F.";
    for record in [
        format!("B_SPLINE_SURFACE_WITH_KNOTS('',{common},(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)"),
        format!("BEZIER_SURFACE('',{common})"),
        format!("QUASI_UNIFORM_SURFACE('',{common})"),
        format!(
            "(BOUNDED_SURFACE()B_SPLINE_SURFACE({common})
             B_SPLINE_SURFACE_WITH_KNOTS((2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()
             RATIONAL_B_SPLINE_SURFACE(((1.,1.),(1.,1.)))REPRESENTATION_ITEM('')SURFACE())"
        ),
    ] {
        let data = format!("#1={record};{points}");
        near(at(&data, 1.0, 0.0), DVec3::new(5.0, 0.0, 0.0));
        near(at(&data, 0.5, 1.0), DVec3::new(2.5, 1.0, 2.0));
    }
}

#[test]
fn trimmed_surface_of_a_face_is_its_basis() {
    let face = whole_face(
        "#1=RECTANGULAR_TRIMMED_SURFACE('',#2,0.,1.,0.,1.,.T.,.T.);#2=CYLINDRICAL_SURFACE('',#801,2.);",
    );
    assert!(matches!(surface(&face), Surface::Cylinder { .. }));
}

/// A lone trimmed plane: four edges that meet in four vertices, counter-clockwise about the face's normal.
#[test]
fn trimmed_plane_on_its_own() {
    let part = part(
        "#9",
        "#1=PLANE('',#801);#2=RECTANGULAR_TRIMMED_SURFACE('',#1,1.,4.,2.,3.,.T.,.T.);#9=GEOMETRIC_SET('',(#2));",
    );
    let face = &part.faces[0];
    let corners = corners(&part, 0);
    assert_eq!(corners.len(), 4);
    let area: DVec3 = (0..4).map(|i| corners[i].cross(corners[(i + 1) % 4])).sum::<DVec3>() * 0.5;
    near(area, DVec3::new(0.0, 0.0, 3.0));
    assert!(face.same_sense);
}

/// With one sense reversed the face looks the other way, and its loop runs the other way too.
#[test]
fn reversed_sense_turns_the_face() {
    let part = part(
        "#9",
        "#1=PLANE('',#801);#2=RECTANGULAR_TRIMMED_SURFACE('',#1,4.,1.,2.,3.,.F.,.T.);#9=GEOMETRIC_SET('',(#2));",
    );
    let corners = corners(&part, 0);
    let area: DVec3 = (0..4).map(|i| corners[i].cross(corners[(i + 1) % 4])).sum::<DVec3>() * 0.5;
    near(area, DVec3::new(0.0, 0.0, -3.0));
    assert!(!part.faces[0].same_sense);
}

/// Trimmed all around, the two sides in u are one edge, used in both directions.
#[test]
fn trimmed_tube_has_a_seam() {
    let part = part(
        "#9",
        "#1=CYLINDRICAL_SURFACE('',#801,2.);#9=GEOMETRIC_SET('',(#2));
         #2=RECTANGULAR_TRIMMED_SURFACE('',#1,0.,6.283185307179586,0.,5.,.T.,.T.);",
    );
    assert_eq!((part.edges.len(), part.vertices.len()), (3, 2));
    let mut uses: Vec<_> =
        part.faces[0].loops[0].coedges.iter().map(|coedge| (coedge.edge, coedge.reversed)).collect();
    uses.sort_unstable();
    assert_eq!(uses, [(0, false), (1, false), (1, true), (2, true)]);
}

#[test]
fn trimmed_whole_sphere_needs_no_loop() {
    let part = part(
        "#9",
        "#1=SPHERICAL_SURFACE('',#801,2.);#9=GEOMETRIC_SET('',(#2));
         #2=RECTANGULAR_TRIMMED_SURFACE('',#1,0.,6.283185307179586,-1.5707963267948966,1.5707963267948966,.T.,.T.);",
    );
    assert!(part.faces[0].loops.is_empty());
}

#[test]
fn surface_within_curves() {
    let part = part(
        "#9",
        "#1=PLANE('',#801);#2=CIRCLE('',#801,5.);#3=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#2);
         #4=OUTER_BOUNDARY_CURVE('',(#3),.F.);#5=CIRCLE('',#801,1.);
         #6=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#5);#7=BOUNDARY_CURVE('',(#6),.F.);
         #8=CURVE_BOUNDED_SURFACE('',#1,(#4,#7),.F.);#9=GEOMETRIC_SET('',(#8));",
    );
    let loops = &part.faces[0].loops;
    assert_eq!(loops.iter().map(|bound| bound.outer).collect::<Vec<_>>(), [true, false]);
    let edge = &part.edges[loops[0].coedges[0].edge as usize];
    assert_eq!((edge.start == edge.end, edge.range.length()), (true, TAU));
}

/// A trimmed curve against its circle that names its ends in the order in which it runs: the other segments tell.
#[test]
fn segments_of_a_boundary_run_as_they_meet() {
    let part = part(
        "#9",
        "#1=PLANE('',#801);#2=CIRCLE('',#801,5.);
         #3=TRIMMED_CURVE('',#2,(PARAMETER_VALUE(3.141592653589793)),(PARAMETER_VALUE(0.)),.F.,.PARAMETER.);
         #4=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#3);
         #10=CARTESIAN_POINT('',(-5.,0.,0.));#11=CARTESIAN_POINT('',(-5.,-3.,0.));
         #12=CARTESIAN_POINT('',(5.,-3.,0.));#13=CARTESIAN_POINT('',(5.,0.,0.));
         #14=POLYLINE('',(#10,#11));#15=POLYLINE('',(#12,#11));#16=POLYLINE('',(#12,#13));
         #17=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#14);#18=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#15);
         #19=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#16);
         #7=OUTER_BOUNDARY_CURVE('',(#17,#4,#19,#18),.F.);
         #8=CURVE_BOUNDED_SURFACE('',#1,(#7),.F.);#9=GEOMETRIC_SET('',(#8));",
    );
    let coedges = &part.faces[0].loops[0].coedges;
    for (k, coedge) in coedges.iter().enumerate() {
        let ends = |coedge: &trimloop_brep::Coedge| {
            let edge = &part.edges[coedge.edge as usize];
            let ends = [edge.range.start, edge.range.end].map(|t| edge.curve.point(t));
            if edge.same_sense != coedge.reversed { ends } else { [ends[1], ends[0]] }
        };
        near(ends(coedge)[1], ends(&coedges[(k + 1) % coedges.len()])[0]);
    }
}

#[test]
fn patches_of_a_composite_surface_become_faces() {
    let part = part(
        "#9",
        "#1=PLANE('',#801);#2=RECTANGULAR_TRIMMED_SURFACE('',#1,0.,1.,0.,1.,.T.,.T.);
         #3=RECTANGULAR_TRIMMED_SURFACE('',#1,1.,2.,0.,1.,.T.,.T.);
         #4=SURFACE_PATCH(#2,.CONTINUOUS.,.CONTINUOUS.,.T.,.T.);#5=SURFACE_PATCH(#3,.CONTINUOUS.,.CONTINUOUS.,.T.,.T.);
         #6=RECTANGULAR_COMPOSITE_SURFACE('',((#4),(#5)));#9=GEOMETRIC_SET('',(#6));",
    );
    assert_eq!(part.faces.len(), 2);
    assert_eq!(part.bodies.len(), 1);
}

#[test]
fn lone_surface_without_bounds_is_left_out_and_reported() {
    let model =
        shape("#9", "#1=PLANE('',#801);#2=SPHERICAL_SURFACE('',#801,2.);#9=GEOMETRIC_SET('',(#1,#2));");
    assert_eq!(model.parts[0].faces.len(), 1);
    assert_eq!(codes(&model), ["unbounded-surface"]);
}

#[test]
fn impossible_surfaces_lose_their_face_alone() {
    for record in [
        "SPHERICAL_SURFACE('',#801,-2.)",
        "CYLINDRICAL_SURFACE('',#801,0.)",
        "CONICAL_SURFACE('',#801,2.,90.)",
        "TOROIDAL_SURFACE('',#801,1.E308,1.)",
        "SPHERICAL_SURFACE('',$,2.)",
        "SURFACE_OF_LINEAR_EXTRUSION('',#1,#1)",
        "FANCY_SURFACE('',#801,2.)",
    ] {
        let model = shape(
            "#9",
            &format!(
                "#1={record};#2=ADVANCED_FACE('',(),#1,.T.);#3=SPHERICAL_SURFACE('',#801,2.);
                 #4=ADVANCED_FACE('',(),#3,.T.);#5=OPEN_SHELL('',(#2,#4));#9=SHELL_BASED_SURFACE_MODEL('',(#5));"
            ),
        );
        let lost: Vec<_> = model.parts[0].faces.iter().map(is_lost).collect();
        assert_eq!(lost, [true, false], "{record}");
        assert!(codes(&model).contains(&"face-unreadable"), "{record}");
    }
}

/// The points where a face's coedges start.
fn corners(part: &trimloop_brep::Part, face: usize) -> Vec<DVec3> {
    let coedges = &part.faces[face].loops[0].coedges;
    let start = |coedge: &trimloop_brep::Coedge| {
        let edge = &part.edges[coedge.edge as usize];
        part.vertices[if coedge.reversed { edge.end } else { edge.start } as usize].point
    };
    coedges.iter().map(start).collect()
}
