//! Colours, visibility and layers.

mod deck;

use deck::{MILLIMETRES, ORIGIN, cuboid, model, product};
use trimloop_brep::{Model, Rgba};

/// A colour's style: the assignment is `first`.
fn style(first: usize, color: &str) -> String {
    let [usage, side, fill, area, shade, color_id] = [1, 2, 3, 4, 5, 6].map(|i| first + i);
    format!(
        "#{first}=PRESENTATION_STYLE_ASSIGNMENT((#{usage}));#{usage}=SURFACE_STYLE_USAGE(.BOTH.,#{side});
         #{side}=SURFACE_SIDE_STYLE('',(#{fill}));#{fill}=SURFACE_STYLE_FILL_AREA(#{area});
         #{area}=FILL_AREA_STYLE('',(#{shade}));#{shade}=FILL_AREA_STYLE_COLOUR('',#{color_id});#{color_id}={color};"
    )
}

const RED: Rgba = Rgba::opaque(1.0, 0.0, 0.0);
const GREEN: Rgba = Rgba::opaque(0.0, 1.0, 0.0);
const BLUE: Rgba = Rgba::opaque(0.0, 0.0, 1.0);

/// A box (#300) as product definition #20, with styles red (#400), green (#410), blue (#420).
fn styled(data: &str) -> Model {
    model(&format!(
        "{MILLIMETRES}{ORIGIN}#5=SHAPE_REPRESENTATION('',(#300),#900);{}{}{}{}{}{data}",
        product(20, "box", 5),
        cuboid(300, [1.0; 3]),
        style(600, "COLOUR_RGB('',1.,0.,0.)"),
        style(610, "DRAUGHTING_PRE_DEFINED_COLOUR('green')"),
        style(620, "COLOUR_RGB('',0.,0.,1.)"),
    ))
}

fn colors(model: &Model) -> Vec<Option<Rgba>> {
    model.parts[0].faces.iter().map(|face| face.color).collect()
}

#[test]
fn nothing_is_coloured_by_itself() {
    assert_eq!(colors(&styled("")), [None; 6]);
}

#[test]
fn face_over_shell_over_solid_over_product() {
    let model = styled("#700=STYLED_ITEM('',(#620),#300);");
    assert_eq!(colors(&model), [Some(BLUE); 6]);
    let model = styled("#700=STYLED_ITEM('',(#620),#300);#701=STYLED_ITEM('',(#610),#301);");
    assert_eq!(colors(&model), [Some(GREEN); 6]);
    let model = styled(
        "#700=STYLED_ITEM('',(#620),#300);#701=STYLED_ITEM('',(#610),#301);#702=STYLED_ITEM('',(#600),#303);",
    );
    let mut wanted = [Some(GREEN); 6];
    wanted[1] = Some(RED);
    assert_eq!(colors(&model), wanted);
    let model = styled("#700=STYLED_ITEM('',(#600),#5);");
    assert_eq!((model.parts[0].color, colors(&model)), (Some(RED), vec![Some(RED); 6]));
}

#[test]
fn over_riding_style_stands_over_the_other_wherever_it_is_written() {
    let model = styled("#700=OVER_RIDING_STYLED_ITEM('',(#600),#300,#701);#701=STYLED_ITEM('',(#620),#300);");
    assert_eq!(colors(&model), [Some(RED); 6]);
}

#[test]
fn channels_up_to_255() {
    let model =
        styled(&format!("{}#700=STYLED_ITEM('',(#630),#300);", style(630, "COLOUR_RGB('',255.,0.,51.)")));
    assert_eq!(colors(&model)[0], Some(Rgba::opaque(1.0, 0.0, 0.2)));
}

#[test]
fn transparency_of_a_rendering() {
    let model = styled(
        "#700=STYLED_ITEM('',(#701),#300);#701=PRESENTATION_STYLE_ASSIGNMENT((#702));
         #702=SURFACE_STYLE_USAGE(.BOTH.,#703);#703=SURFACE_SIDE_STYLE('',(#704));
         #704=SURFACE_STYLE_RENDERING_WITH_PROPERTIES($,#705,(#706));#705=COLOUR_RGB('',1.,0.,0.);
         #706=SURFACE_STYLE_TRANSPARENT(0.75);",
    );
    assert_eq!(colors(&model)[0], Some(Rgba { a: 0.25, ..RED }));
}

#[test]
fn free_curves_have_the_colour_of_their_curve_style() {
    let model = styled(
        "#700=STYLED_ITEM('',(#701),#703);#701=PRESENTATION_STYLE_ASSIGNMENT((#702));
         #702=CURVE_STYLE('',$,$,#626);#703=CIRCLE('',#801,1.);#704=GEOMETRIC_CURVE_SET('',(#703));
         #705=SHAPE_REPRESENTATION('',(#704),#900);#706=SHAPE_REPRESENTATION_RELATIONSHIP('','',#5,#705);",
    );
    assert_eq!(model.parts[0].curves[0].color, Some(BLUE));
}

#[test]
fn invisible_faces_and_layers() {
    let hidden = |model: &Model| model.parts[0].faces.iter().filter(|face| face.hidden).count();
    let model = styled("#700=STYLED_ITEM('',(#600),#304);#701=INVISIBILITY((#700));");
    assert_eq!(hidden(&model), 1);
    let model =
        styled("#700=PRESENTATION_LAYER_ASSIGNMENT('reference','',(#300));#701=INVISIBILITY((#700));");
    assert_eq!(hidden(&model), 6);
    assert_eq!(model.parts[0].bodies[0].layers, ["reference"]);
}

/// Two uses of one box, one of them red: as CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM, as a style limited to the use,
/// and as OpenCASCADE writes it, limited to a representation that stands for the use.
#[test]
fn colour_of_one_use_alone() {
    for looks in [
        "#700=CONTEXT_DEPENDENT_OVER_RIDING_STYLED_ITEM('',(#600),#300,#701,(#44));#701=STYLED_ITEM('',(),#300);",
        "#700=STYLED_ITEM('',(#701),#300);#701=PRESENTATION_STYLE_BY_CONTEXT((#601),#44);",
        "#700=STYLED_ITEM('',(#701),#300);#701=PRESENTATION_STYLE_BY_CONTEXT((#601),#702);
         #702=SHAPE_REPRESENTATION('',(#801),#900);#703=SHAPE_DEFINITION_REPRESENTATION(#41,#702);",
    ] {
        let model = styled(&format!(
            "{looks}{}#6=SHAPE_REPRESENTATION('',(#801),#900);#42=ITEM_DEFINED_TRANSFORMATION('','',#801,#801);
             #40=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','one','',#30,#20,$);#41=PRODUCT_DEFINITION_SHAPE('','',#40);
             #43=(REPRESENTATION_RELATIONSHIP('','',#5,#6)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#42)
               SHAPE_REPRESENTATION_RELATIONSHIP());#44=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#43,#41);
             #50=NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','two','',#30,#20,$);#51=PRODUCT_DEFINITION_SHAPE('','',#50);
             #54=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#43,#51);",
            product(30, "two boxes", 6)
        ));
        let uses: Vec<_> =
            model.nodes.iter().filter(|node| node.part.is_some()).map(|node| node.color).collect();
        assert_eq!(uses, [Some(RED), None], "{looks}");
        assert_eq!(colors(&model), [None; 6]);
    }
}

#[test]
fn styles_that_refer_to_themselves_are_no_trouble() {
    let model = styled(
        "#700=STYLED_ITEM('',(#701),#300);#701=PRESENTATION_STYLE_ASSIGNMENT((#701,#700,#702));
         #702=SURFACE_STYLE_USAGE(.BOTH.,#702);#703=INVISIBILITY((#703));",
    );
    assert_eq!(colors(&model), [None; 6]);
}
