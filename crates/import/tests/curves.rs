//! Every curve of ISO 10303-42, as a member of a geometric curve set.

mod deck;

use std::f64::consts::{FRAC_PI_2, TAU};

use deck::{codes, free_curve, near, part, shape};
use glam::DVec3;
use trimloop_geom::Curve;

const XY: &str = "#1=CARTESIAN_POINT('',(1.,0.,0.));#2=CARTESIAN_POINT('',(0.,2.,0.));";

fn point(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

#[test]
fn line_between_parameters() {
    let (curve, start, end) = free_curve(
        "#9",
        &format!(
            "{XY}#3=DIRECTION('',(0.,0.,2.));#4=VECTOR('',#3,5.);#5=LINE('',#1,#4);
             #6=TRIMMED_CURVE('',#5,(PARAMETER_VALUE(-1.)),(PARAMETER_VALUE(2.)),.T.,.PARAMETER.);
             #9=GEOMETRIC_CURVE_SET('',(#6));"
        ),
    );
    assert!(matches!(curve, Curve::Line { .. }));
    near(start, DVec3::new(1.0, 0.0, -5.0));
    near(end, DVec3::new(1.0, 0.0, 10.0));
}

#[test]
fn line_without_ends_is_left_out_and_reported() {
    let model = shape(
        "#9,#20",
        "#3=DIRECTION('',(0.,0.,2.));#4=VECTOR('',#3,5.);#5=LINE('',#800,#4);#9=GEOMETRIC_CURVE_SET('',(#5));
         #20=CIRCLE('',#801,1.);",
    );
    assert_eq!(model.parts[0].curves.len(), 1);
    assert_eq!(codes(&model), ["curve-unreadable"]);
}

#[test]
fn whole_circle_and_ellipse() {
    let part =
        part("#9", "#1=CIRCLE('',#801,2.);#2=ELLIPSE('',#801,3.,1.);#9=GEOMETRIC_CURVE_SET('',(#1,#2));");
    let [circle, ellipse] = [0, 1].map(|i| &part.curves[i]);
    assert_eq!(circle.range.length(), TAU);
    near(circle.curve.point(FRAC_PI_2), point(0.0, 2.0));
    near(ellipse.curve.point(FRAC_PI_2), point(0.0, 1.0));
}

#[test]
fn parabola_and_hyperbola_between_points() {
    let part = part(
        "#9",
        "#1=PARABOLA('',#801,0.5);#2=CARTESIAN_POINT('',(2.,-2.,0.));#3=CARTESIAN_POINT('',(2.,2.,0.));
         #4=TRIMMED_CURVE('',#1,(#2),(#3),.T.,.CARTESIAN.);
         #5=HYPERBOLA('',#801,1.,2.);
         #6=TRIMMED_CURVE('',#5,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);
         #9=GEOMETRIC_CURVE_SET('',(#4,#6));",
    );
    let [parabola, hyperbola] = [0, 1].map(|i| &part.curves[i]);
    near(parabola.curve.point(parabola.range.start), point(2.0, -2.0));
    near(parabola.curve.point(parabola.range.at(0.5)), DVec3::ZERO);
    near(hyperbola.curve.point(hyperbola.range.end), point(1f64.cosh(), 2.0 * 1f64.sinh()));
}

#[test]
fn polyline_without_doubled_points() {
    let (curve, start, end) =
        free_curve("#9", &format!("{XY}#3=POLYLINE('',(#1,#1,#2,#800));#9=GEOMETRIC_CURVE_SET('',(#3));"));
    let Curve::Polyline(polyline) = curve else { panic!() };
    assert_eq!(polyline.points.len(), 3);
    near(start, point(1.0, 0.0));
    near(end, DVec3::ZERO);
}

/// The quarter from (0, 1) on to (1, 0): against the circle, the short way; with it, the long way.
#[test]
fn sense_decides_which_way_round() {
    for (sense, quarters) in [("F", 1.0), ("T", 3.0)] {
        let part = part(
            "#9",
            &format!(
                "#1=CARTESIAN_POINT('',(0.,1.,0.));#2=CARTESIAN_POINT('',(1.,0.,0.));#3=CIRCLE('',#801,1.);
                 #4=TRIMMED_CURVE('',#3,(#1),(#2),.{sense}.,.CARTESIAN.);#9=GEOMETRIC_CURVE_SET('',(#4));"
            ),
        );
        assert!((part.curves[0].range.length() - quarters * FRAC_PI_2).abs() < 1e-12);
    }
}

#[test]
fn composite_of_an_arc_and_a_line_against_its_direction() {
    let (curve, start, end) = free_curve(
        "#9",
        "#1=CIRCLE('',#801,1.);
         #2=TRIMMED_CURVE('',#1,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.5707963267948966)),.T.,.PARAMETER.);
         #3=CARTESIAN_POINT('',(-5.,1.,0.));#4=CARTESIAN_POINT('',(0.,1.,0.));#5=POLYLINE('',(#3,#4));
         #6=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#2);#7=COMPOSITE_CURVE_SEGMENT(.DISCONTINUOUS.,.F.,#5);
         #8=COMPOSITE_CURVE('',(#6,#7),.F.);#9=GEOMETRIC_CURVE_SET('',(#8));",
    );
    assert!(matches!(curve, Curve::Composite(_)));
    near(start, point(1.0, 0.0));
    near(end, point(-5.0, 1.0));
}

/// ISO 10303-42 offsets along reference direction x tangent: inwards on a circle about +Z.
#[test]
fn offset_curve_goes_to_the_left_of_its_reference_direction() {
    let (curve, start, _) = free_curve(
        "#9",
        "#1=CIRCLE('',#801,5.);#2=DIRECTION('',(0.,0.,1.));#3=OFFSET_CURVE_3D('',#1,2.,.F.,#2);
         #9=GEOMETRIC_CURVE_SET('',(#3));",
    );
    assert!(matches!(curve, Curve::Offset(_)));
    near(start, point(3.0, 0.0));
}

#[test]
fn replica_is_moved_turned_and_scaled() {
    let (_, start, _) = free_curve(
        "#9",
        &format!(
            "{XY}#3=DIRECTION('',(0.,1.,0.));#4=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#3,$,#2,3.,$);
             #5=CIRCLE('',#801,1.);#6=CURVE_REPLICA('',#5,#4);#9=GEOMETRIC_CURVE_SET('',(#6));"
        ),
    );
    near(start, point(0.0, 5.0));
}

/// Control points of a cubic with four points: all forms are the same Bézier curve but the uniform one, which
/// starts at the mean of its first three points weighted 1 : 4 : 1.
#[test]
fn spline_forms() {
    let points = "#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(1.,2.,0.));
        #3=CARTESIAN_POINT('',(3.,2.,0.));#4=CARTESIAN_POINT('',(4.,0.,0.));";
    let common = "3,(#1,#2,#3,#4),.UNSPECIFIED.,.F.,.F.";
    for record in [
        format!("BEZIER_CURVE('',{common})"),
        format!("QUASI_UNIFORM_CURVE('',{common})"),
        format!("B_SPLINE_CURVE_WITH_KNOTS('',{common},(4,4),(0.,1.),.UNSPECIFIED.)"),
        format!(
            "(BOUNDED_CURVE()B_SPLINE_CURVE({common})B_SPLINE_CURVE_WITH_KNOTS((4,4),(0.,1.),.UNSPECIFIED.)CURVE()
             GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((1.,1.,1.,1.))REPRESENTATION_ITEM(''))"
        ),
        format!(
            "(BEZIER_CURVE()BOUNDED_CURVE()B_SPLINE_CURVE({common})CURVE()GEOMETRIC_REPRESENTATION_ITEM()
             RATIONAL_B_SPLINE_CURVE((2.,2.,2.,2.))REPRESENTATION_ITEM(''))"
        ),
    ] {
        let part = part("#9", &format!("{points}#5={record};#9=GEOMETRIC_CURVE_SET('',(#5));"));
        let free = &part.curves[0];
        near(free.curve.point(free.range.at(0.5)), point(2.0, 1.5));
        let Curve::Nurbs(spline) = &*free.curve else { panic!() };
        assert!(spline.weights().is_empty(), "equal weights are none: {record}");
    }
    let (_, start, _) =
        free_curve("#9", &format!("{points}#5=UNIFORM_CURVE('',{common});#9=GEOMETRIC_CURVE_SET('',(#5));"));
    near(start, DVec3::new(7.0 / 6.0, 10.0 / 6.0, 0.0));
}

#[test]
fn quarter_circle_as_a_rational_spline() {
    let part = part(
        "#9",
        "#1=CARTESIAN_POINT('',(1.,0.,0.));#2=CARTESIAN_POINT('',(1.,1.,0.));#3=CARTESIAN_POINT('',(0.,1.,0.));
         #4=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(#1,#2,#3),.CIRCULAR_ARC.,.F.,.F.)
           B_SPLINE_CURVE_WITH_KNOTS((3,3),(0.,1.),.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()
           RATIONAL_B_SPLINE_CURVE((1.,0.7071067811865476,1.))REPRESENTATION_ITEM(''));
         #9=GEOMETRIC_CURVE_SET('',(#4));",
    );
    let free = &part.curves[0];
    for i in 0..=10 {
        assert!((free.curve.point(free.range.at(f64::from(i) / 10.0)).length() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn curve_on_a_surface_by_its_pcurve_alone() {
    let (curve, start, end) = free_curve(
        "#9",
        "#1=CYLINDRICAL_SURFACE('',#801,2.);#2=CARTESIAN_POINT('',(0.,1.));#3=CARTESIAN_POINT('',(1.5707963267948966,4.));
         #4=POLYLINE('',(#2,#3));#5=DEFINITIONAL_REPRESENTATION('',(#4),#6);
         #6=(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('',''));
         #7=PCURVE('',#1,#5);#9=GEOMETRIC_CURVE_SET('',(#7));",
    );
    assert!(matches!(curve, Curve::OnSurface { .. }));
    near(start, DVec3::new(2.0, 0.0, 1.0));
    near(end, DVec3::new(0.0, 2.0, 4.0));
}

#[test]
fn surface_curve_is_its_curve_in_space_else_its_pcurve() {
    for (in_space, kind) in [("#3", "circle"), ("#77", "on-surface")] {
        let part = part(
            "#9",
            &format!(
                "#1=CYLINDRICAL_SURFACE('',#801,2.);#3=CIRCLE('',#801,2.);
                 #10=CARTESIAN_POINT('',(0.,0.));#11=CARTESIAN_POINT('',(3.,0.));#12=POLYLINE('',(#10,#11));
                 #13=DEFINITIONAL_REPRESENTATION('',(#12),$);#14=PCURVE('',#1,#13);
                 #15=SURFACE_CURVE('',{in_space},(#14),.CURVE_3D.);#9=GEOMETRIC_CURVE_SET('',(#15));"
            ),
        );
        assert_eq!(part.curves[0].curve.kind(), kind);
    }
}

/// As complex instances may write any entity: each supertype as a part of its own, in alphabetical order.
#[test]
fn circle_in_external_mapping() {
    let (curve, start, _) = free_curve(
        "#9",
        "#1=(CIRCLE(4.)CONIC(#801)CURVE()GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''));
         #9=GEOMETRIC_CURVE_SET('',(#1));",
    );
    assert!(matches!(curve, Curve::Circle { radius: 4.0, .. }));
    near(start, point(4.0, 0.0));
}

#[test]
fn wireframe_edges_become_free_curves() {
    let part = part(
        "#9",
        &format!(
            "{XY}#3=VERTEX_POINT('',#1);#4=VERTEX_POINT('',#2);#5=DIRECTION('',(-1.,2.,0.));#6=VECTOR('',#5,1.);
             #7=LINE('',#1,#6);#8=EDGE_CURVE('',#3,#4,#7,.T.);#10=CONNECTED_EDGE_SET('',(#8));
             #9=EDGE_BASED_WIREFRAME_MODEL('',(#10));"
        ),
    );
    let free = &part.curves[0];
    near(free.curve.point(free.range.start), point(1.0, 0.0));
    near(free.curve.point(free.range.end), point(0.0, 2.0));
}

#[test]
fn multiplicities_one_short_at_the_ends_are_mended() {
    let model = shape(
        "#9",
        "#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(1.,2.,0.));#3=CARTESIAN_POINT('',(3.,2.,0.));
         #4=CARTESIAN_POINT('',(4.,0.,0.));
         #5=B_SPLINE_CURVE_WITH_KNOTS('',3,(#1,#2,#3,#4),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.);
         #9=GEOMETRIC_CURVE_SET('',(#5));",
    );
    let free = &model.parts[0].curves[0];
    near(free.curve.point(free.range.at(0.5)), point(2.0, 1.5));
    assert_eq!(codes(&model), ["knot-multiplicities"]);
}
