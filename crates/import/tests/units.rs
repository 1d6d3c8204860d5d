//! Lengths and angles are in the units of the representation that they belong to.

mod deck;

use deck::{INCHES, MILLIMETRES, codes, cuboid, model, near, part, product, surface, whole_face};
use glam::DVec3;
use trimloop_geom::{Curve, Surface};

/// A context whose length unit is `#1` of `units`, and a point set's only curve in it, from the origin to x = 2.
fn length_of_two(units: &str) -> f64 {
    let model = model(&format!(
        "#10=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1))REPRESENTATION_CONTEXT('',''));
         #11=CARTESIAN_POINT('',(0.,0.,0.));#12=CARTESIAN_POINT('',(2.,0.,0.));#13=POLYLINE('',(#11,#12));
         #14=GEOMETRIC_CURVE_SET('',(#13));#15=SHAPE_REPRESENTATION('',(#14),#10);{units}"
    ));
    let curve = &model.parts[0].curves[0];
    curve.curve.point(curve.range.end).x
}

#[test]
fn si_units_with_prefixes() {
    for (prefix, millimetres) in [("$", 2000.0), (".MILLI.", 2.0), (".CENTI.", 20.0), (".MICRO.", 0.002)] {
        let unit = format!("#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({prefix},.METRE.));");
        assert!((length_of_two(&unit) / millimetres - 1.0).abs() < 1e-12, "{prefix}");
    }
}

#[test]
fn simple_si_unit() {
    assert_eq!(length_of_two("#1=SI_UNIT(*,.CENTI.,.METRE.);"), 20.0);
}

#[test]
fn unit_in_terms_of_another_that_is_in_terms_of_a_third() {
    let foot = "#1=(CONVERSION_BASED_UNIT('FOOT',#2)LENGTH_UNIT()NAMED_UNIT(*));
        #2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(12.),#3);
        #3=(CONVERSION_BASED_UNIT('INCH',#4)LENGTH_UNIT()NAMED_UNIT(*));
        #4=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.54),#5);
        #5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));";
    assert!((length_of_two(foot) - 2.0 * 304.8).abs() < 1e-9);
}

#[test]
fn inch_whose_factor_is_missing_is_known_by_name() {
    assert_eq!(length_of_two("#1=(CONVERSION_BASED_UNIT('INCH',#77)LENGTH_UNIT()NAMED_UNIT(*));"), 50.8);
}

#[test]
fn context_without_length_unit_is_reported() {
    let model = model(&format!(
        "#1=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT(())REPRESENTATION_CONTEXT('',''));
         #2=SHAPE_REPRESENTATION('',(#100),#1);{}",
        cuboid(100, [1.0, 1.0, 1.0])
    ));
    assert_eq!(codes(&model), ["length-unit-missing"]);
    let points = model.parts[0].vertices.iter().map(|vertex| vertex.point);
    near(points.reduce(DVec3::max).expect("eight"), DVec3::ONE);
}

#[test]
fn uncertainty_is_in_millimetres() {
    let model =
        model(&format!("{INCHES}#1=SHAPE_REPRESENTATION('',(#100),#950);{}", cuboid(100, [1.0, 1.0, 1.0])));
    assert!((model.parts[0].uncertainty_mm - 0.0254).abs() < 1e-12);
}

#[test]
fn units_are_named_in_the_source() {
    let model =
        model(&format!("{INCHES}#1=SHAPE_REPRESENTATION('',(#100),#950);{}", cuboid(100, [1.0, 1.0, 1.0])));
    assert_eq!(model.source.length_units, ["inch"]);
    assert_eq!(model.source.angle_units, ["degree"]);
}

/// Radius and size are inches, the half angle degrees, and so is the trim of an arc.
#[test]
fn angles_in_degrees() {
    let model = model(&format!(
        "{INCHES}#1=CARTESIAN_POINT('',(0.,0.,1.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
         #3=CONICAL_SURFACE('',#2,2.,30.);#4=ADVANCED_FACE('',(),#3,.T.);#5=OPEN_SHELL('',(#4));
         #6=SHELL_BASED_SURFACE_MODEL('',(#5));
         #7=CIRCLE('',#2,1.);#8=TRIMMED_CURVE('',#7,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(90.)),.T.,.PARAMETER.);
         #9=GEOMETRIC_CURVE_SET('',(#8));#10=SHAPE_REPRESENTATION('',(#6,#9),#950);"
    ));
    let part = &model.parts[0];
    let Surface::Cone { frame, radius, half_angle_rad } = surface(&part.faces[0]) else { panic!() };
    near(frame.origin, DVec3::new(0.0, 0.0, 25.4));
    assert!((radius - 50.8).abs() < 1e-12 && (half_angle_rad - 30f64.to_radians()).abs() < 1e-12);
    let arc = &part.curves[0];
    near(arc.curve.point(arc.range.end), DVec3::new(0.0, 25.4, 25.4));
}

#[test]
fn half_angle_that_cannot_be_radians_is_taken_for_degrees() {
    let face = whole_face("#1=CONICAL_SURFACE('',#801,2.,45.);");
    let Surface::Cone { half_angle_rad, .. } = surface(&face) else { panic!() };
    assert!((half_angle_rad - 45f64.to_radians()).abs() < 1e-12);
}

/// Where parameters and points of a trim disagree, the points hold: the parameters here are degrees in a file that
/// declares radians.
#[test]
fn trim_points_stand_over_parameters_in_the_wrong_unit() {
    let part = part(
        "#5",
        "#1=CIRCLE('',#801,10.);#2=CARTESIAN_POINT('',(10.,0.,0.));#3=CARTESIAN_POINT('',(0.,10.,0.));
         #4=TRIMMED_CURVE('',#1,(#2,PARAMETER_VALUE(0.)),(#3,PARAMETER_VALUE(90.)),.T.,.PARAMETER.);
         #5=GEOMETRIC_CURVE_SET('',(#4));",
    );
    let arc = &part.curves[0];
    assert!((arc.range.length() - 90f64.to_radians()).abs() < 1e-12);
    assert!(matches!(*arc.curve, Curve::Circle { .. }));
}

/// An inch part in a millimetre assembly: its placement in the assembly is in millimetres, the placement in
/// itself that goes there in inches.
#[test]
fn placement_is_read_in_the_units_of_each_side() {
    let model = model(&format!(
        "{MILLIMETRES}{INCHES}
         #1=CARTESIAN_POINT('',(1.,0.,0.));#2=AXIS2_PLACEMENT_3D('in the part',#1,$,$);
         #3=CARTESIAN_POINT('',(100.,0.,0.));#4=AXIS2_PLACEMENT_3D('in the assembly',#3,$,$);
         #5=SHAPE_REPRESENTATION('part',(#2,#300),#950);#6=SHAPE_REPRESENTATION('assembly',(#4),#900);
         #10=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','use','',#30,#20,$);
         #11=PRODUCT_DEFINITION_SHAPE('','',#10);#12=ITEM_DEFINED_TRANSFORMATION('','',#2,#4);
         #13=(REPRESENTATION_RELATIONSHIP('','',#5,#6)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#12)
           SHAPE_REPRESENTATION_RELATIONSHIP());
         #14=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#13,#11);{}{}{}",
        product(20, "part", 5),
        product(30, "assembly", 6),
        cuboid(300, [2.0, 2.0, 2.0])
    ));
    let part = &model.parts[0];
    let largest = part.vertices.iter().map(|vertex| vertex.point).reduce(DVec3::max).expect("eight");
    near(largest, DVec3::splat(50.8));
    let placed = &model.nodes[model.nodes[model.roots[0]].children[0]];
    near(placed.transform.translation, DVec3::new(100.0 - 25.4, 0.0, 0.0));
}
