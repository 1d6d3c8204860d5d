//! Files that want to do harm: nothing hangs, panics or takes more than its share.

mod deck;

use deck::{MILLIMETRES, ORIGIN, codes, cuboid, import, is_lost, model, shape};

/// A sphere beside a face on surface `#1`: the sphere is there, the face is lost.
fn costs_its_face(data: &str) {
    let model = shape(
        "#9",
        &format!(
            "#2=ADVANCED_FACE('',(),#1,.T.);#3=SPHERICAL_SURFACE('',#801,2.);#4=ADVANCED_FACE('',(),#3,.T.);
             #5=OPEN_SHELL('',(#2,#4));#9=SHELL_BASED_SURFACE_MODEL('',(#5));{data}"
        ),
    );
    assert_eq!(model.parts[0].faces.iter().map(is_lost).collect::<Vec<_>>(), [true, false], "{data}");
}

#[test]
fn surfaces_and_curves_built_on_themselves() {
    costs_its_face("#1=OFFSET_SURFACE('',#1,1.,.F.);");
    costs_its_face(
        "#1=RECTANGULAR_TRIMMED_SURFACE('',#20,0.,1.,0.,1.,.T.,.T.);#20=OFFSET_SURFACE('',#1,1.,.F.);",
    );
    costs_its_face(
        "#1=SURFACE_OF_LINEAR_EXTRUSION('',#20,#21);#20=TRIMMED_CURVE('',#20,(),(),.T.,.PARAMETER.);",
    );
    costs_its_face(
        "#1=SURFACE_OF_LINEAR_EXTRUSION('',#20,#21);#20=COMPOSITE_CURVE('',(#22,#22),.F.);
         #22=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#20);#21=VECTOR('',#23,1.);#23=DIRECTION('',(0.,0.,1.));",
    );
    costs_its_face(
        "#1=SURFACE_OF_REVOLUTION('',#20,#801);#20=PCURVE('',#1,#21);#21=DEFINITIONAL_REPRESENTATION('',(#20),$);",
    );
    costs_its_face("#1=PLANE('',#1);");
}

/// A composite of two uses of a composite of two uses ...: forty levels would be a million million segments.
#[test]
fn curves_that_fan_out() {
    let mut data = String::from(
        "#1=SURFACE_OF_LINEAR_EXTRUSION('',#100,#30);#30=VECTOR('',#31,1.);#31=DIRECTION('',(0.,0.,1.));",
    );
    for level in 0..20 {
        let first = 100 + 10 * level;
        let child = if level == 19 { 999 } else { first + 10 };
        data += &format!(
            "#{first}=COMPOSITE_CURVE('',(#{0},#{0},#{0}),.F.);#{0}=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#{child});",
            first + 1
        );
    }
    data += "#999=POLYLINE('',(#800,#998));#998=CARTESIAN_POINT('',(1.,0.,0.));";
    costs_its_face(&data);
}

#[test]
fn faces_edges_and_shells_wrapped_in_themselves() {
    let model = shape(
        "#9,#3,#100",
        &format!(
            "{}#1=ORIENTED_FACE('',*,#1,.F.);#2=ORIENTED_CLOSED_SHELL('',*,#2,.F.);#3=MANIFOLD_SOLID_BREP('',#2);
             #5=ORIENTED_EDGE('',*,*,#5,.T.);#6=EDGE_LOOP('',(#5));#7=FACE_BOUND('',#6,.T.);#10=PLANE('',#801);
             #8=ADVANCED_FACE('',(#7),#10,.T.);#11=OPEN_SHELL('',(#1,#8));#9=SHELL_BASED_SURFACE_MODEL('',(#11));",
            cuboid(100, [1.0; 3])
        ),
    );
    assert_eq!(codes(&model), ["face-unreadable", "shell-unreadable"]);
    assert_eq!(model.parts[0].faces.iter().filter(|face| is_lost(face)).count(), 2);
}

#[test]
fn units_in_terms_of_themselves() {
    let model = model(&format!(
        "#1=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#2))REPRESENTATION_CONTEXT('',''));
         #2=(CONVERSION_BASED_UNIT('CUBIT',#3)LENGTH_UNIT()NAMED_UNIT(*));#3=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.),#2);
         #4=SHAPE_REPRESENTATION('',(#100),#1);{}",
        cuboid(100, [1.0; 3])
    ));
    assert_eq!(codes(&model), ["length-unit-missing"]);
}

#[test]
fn numbers_that_are_none() {
    for number in
        ["1.E308", "-1.E308", "1.E400", "1.E31", "$", "*", "''", ".T.", "#800", "(1.)", "LENGTH_MEASURE()"]
    {
        costs_its_face(&format!("#1=SPHERICAL_SURFACE('',#801,{number});"));
        costs_its_face(&format!(
            "#1=PLANE('',#20);#20=AXIS2_PLACEMENT_3D('',#21,$,$);#21=CARTESIAN_POINT('',({number},0.,0.));"
        ));
    }
}

#[test]
fn counts_that_claim_gigabytes() {
    let points = "#20=CARTESIAN_POINT('',(0.,0.,0.));#21=CARTESIAN_POINT('',(1.,0.,0.));";
    for (degree, multiplicities) in [
        ("1", "(2,9223372036854775807)"),
        ("4000000000", "(2,2)"),
        ("1", "(9223372036854775807,9223372036854775807,2)"),
        ("1", "(2,0)"),
    ] {
        let model = shape(
            "#9",
            &format!(
                "{points}#1=B_SPLINE_CURVE_WITH_KNOTS('',{degree},(#20,#21),.UNSPECIFIED.,.F.,.F.,{multiplicities},(0.,1.),.U.);
                 #2=CIRCLE('',#801,1.);#9=GEOMETRIC_CURVE_SET('',(#1,#2));"
            ),
        );
        assert!(model.parts[0].curves.len() <= 2);
    }
}

/// A product's own map leads to itself, in a fan.
#[test]
fn mapped_items_in_circles() {
    let model = model(&format!(
        "{MILLIMETRES}{ORIGIN}#1=SHAPE_REPRESENTATION('',(#100,#3,#4),#900);#2=REPRESENTATION_MAP(#801,#5);
         #3=MAPPED_ITEM('',#2,#801);#4=MAPPED_ITEM('',#2,#801);#5=SHAPE_REPRESENTATION('',(#6,#7),#900);
         #8=REPRESENTATION_MAP(#801,#1);#6=MAPPED_ITEM('',#8,#801);#7=MAPPED_ITEM('',#8,#801);
         #20=PRODUCT_DEFINITION('',$,$,$);#21=PRODUCT_DEFINITION_SHAPE('','',#20);#22=SHAPE_DEFINITION_REPRESENTATION(#21,#1);{}",
        cuboid(100, [1.0; 3])
    ));
    assert!(codes(&model).contains(&"assembly-cycle"));
    assert!(model.nodes.len() < 10);
}

#[test]
fn cut_anywhere() {
    let data = format!(
        "{MILLIMETRES}{ORIGIN}#910=SHAPE_REPRESENTATION('shape',(#100),#900);{}",
        cuboid(100, [1.0; 3])
    );
    for end in (0..data.len()).step_by(7) {
        let _ = import(&data[..end]);
    }
}

/// Each entity of a box missing in turn: never a panic, and at least four faces stay unless it is the box itself.
#[test]
fn any_entity_missing() {
    let lines: Vec<String> = cuboid(100, [1.0; 3]).lines().map(str::to_owned).collect();
    for missing in 0..lines.len() {
        let data: Vec<&str> =
            lines.iter().enumerate().filter(|&(i, _)| i != missing).map(|(_, line)| line.as_str()).collect();
        let Ok(model) =
            import(&format!("{MILLIMETRES}#910=SHAPE_REPRESENTATION('',(#100),#900);{}", data.join("\n")))
        else {
            assert!(lines[missing].contains("CLOSED_SHELL") || lines[missing].contains("BREP"));
            continue;
        };
        let whole = model.parts[0].faces.iter().filter(|face| !is_lost(face)).count();
        let shared =
            ["CARTESIAN_POINT", "VERTEX_POINT", "DIRECTION"].iter().any(|word| lines[missing].contains(word));
        assert!(shared || whole >= 5, "{} leaves {whole} faces", lines[missing]);
    }
}
