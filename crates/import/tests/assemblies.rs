//! Products, their uses in each other, and what else places shapes.

mod deck;

use deck::{MILLIMETRES, codes, cuboid, import, model, near, product};
use glam::{DAffine3, DVec3};
use trimloop_brep::{Model, Node};

/// A brick (product definition #20, representation #5) and an assembly (#30, #6), the brick's solid being #300.
fn brick_and_wall() -> String {
    format!(
        "{MILLIMETRES}#1=CARTESIAN_POINT('',(0.,0.,0.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
         #3=CARTESIAN_POINT('',(100.,0.,0.));#4=AXIS2_PLACEMENT_3D('',#3,$,$);
         #7=DIRECTION('',(1.,0.,0.));#8=CARTESIAN_POINT('',(0.,50.,0.));#9=AXIS2_PLACEMENT_3D('',#8,#7,$);
         #5=SHAPE_REPRESENTATION('brick',(#2,#300),#900);#6=SHAPE_REPRESENTATION('wall',(#4,#9),#900);{}{}{}",
        product(20, "brick", 5),
        product(30, "wall", 6),
        cuboid(300, [1.0, 2.0, 3.0])
    )
}

/// A use of product definition `child` in `parent`, placed by `transformation` between representations.
fn usage(
    first: usize,
    names: &str,
    [parent, child]: [usize; 2],
    transformation: &str,
    between: &str,
) -> String {
    let [shape, operator, relationship, placed] = [1, 2, 3, 4].map(|i| first + i);
    format!(
        "#{first}=NEXT_ASSEMBLY_USAGE_OCCURRENCE({names},#{parent},#{child},$);
         #{shape}=PRODUCT_DEFINITION_SHAPE('','',#{first});
         #{operator}=ITEM_DEFINED_TRANSFORMATION('','',{transformation});
         #{relationship}=(REPRESENTATION_RELATIONSHIP('','',{between})
           REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{operator})SHAPE_REPRESENTATION_RELATIONSHIP());
         #{placed}=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{relationship},#{shape});"
    )
}

fn children<'m>(model: &'m Model, node: &Node) -> Vec<&'m Node> {
    node.children.iter().map(|&child| &model.nodes[child]).collect()
}

fn root(model: &Model) -> &Node {
    assert_eq!(model.roots.len(), 1);
    &model.nodes[model.roots[0]]
}

#[test]
fn part_used_twice_is_one_part() {
    let model = model(&format!(
        "{}{}{}",
        brick_and_wall(),
        usage(40, "'1','one',''", [30, 20], "#2,#4", "#5,#6"),
        usage(50, "'2','two',''", [30, 20], "#2,#9", "#5,#6")
    ));
    assert_eq!((model.parts.len(), model.instance_counts()), (1, vec![2]));
    let wall = root(&model);
    assert_eq!((wall.name.as_str(), wall.id.as_str(), wall.part), ("wall", "wall id", None));
    let bricks = children(&model, wall);
    assert_eq!(
        bricks.iter().map(|brick| brick.instance_name.as_deref()).collect::<Vec<_>>(),
        [Some("one"), Some("two")]
    );
    assert!(bricks.iter().all(|brick| brick.name == "brick" && brick.part == Some(0)));
    near(bricks[0].transform.translation, DVec3::new(100.0, 0.0, 0.0));
    near(bricks[1].transform.transform_point3(DVec3::Z), DVec3::new(1.0, 50.0, 0.0));
    assert!(model.diagnostics.is_empty());
}

/// Which representation is whose says which way the transformation goes, not their order.
#[test]
fn order_of_the_representations_does_not_matter() {
    for (transformation, between) in
        [("#2,#4", "#5,#6"), ("#4,#2", "#6,#5"), ("#4,#2", "#5,#6"), ("#2,#4", "#6,#5")]
    {
        let model = model(&format!(
            "{}{}",
            brick_and_wall(),
            usage(40, "'1','',''", [30, 20], transformation, between)
        ));
        let brick = children(&model, root(&model))[0];
        near(brick.transform.translation, DVec3::new(100.0, 0.0, 0.0));
    }
}

/// People see the description where there is one, else the name, else the id; blanks are none.
#[test]
fn names_of_uses() {
    for (names, shown) in [
        ("'1','Next assembly relationship','LEFT WHEEL'", "LEFT WHEEL"),
        ("'1','wheel:1',''", "wheel:1"),
        ("'NAUO7',' ',' '", "NAUO7"),
        ("'7','',$", "7"),
    ] {
        let model = model(&format!("{}{}", brick_and_wall(), usage(40, names, [30, 20], "#2,#4", "#5,#6")));
        assert_eq!(children(&model, root(&model))[0].instance_name.as_deref(), Some(shown));
    }
}

#[test]
fn product_without_a_name_goes_by_its_id() {
    let data = brick_and_wall().replace("'brick',''", "'',''").replace("'wall',''", "'',''");
    let model = model(&format!("{data}{}", usage(40, "'1','',''", [30, 20], "#2,#4", "#5,#6")));
    assert_eq!((root(&model).name.as_str(), model.parts[0].name.as_str()), ("wall id", "brick id"));
}

#[test]
fn products_that_nothing_uses_are_roots() {
    let model = model(&brick_and_wall());
    assert_eq!(
        model.roots.iter().map(|&root| model.nodes[root].name.as_str()).collect::<Vec<_>>(),
        ["brick", "wall"]
    );
}

/// Materials and the like are products too.
#[test]
fn products_without_a_shape_are_left_out() {
    let model = model(&format!(
        "{}#60=PRODUCT_DEFINITION('','',#61,$);#61=PRODUCT_DEFINITION_FORMATION('','',#62);#62=PRODUCT('steel','steel','',());",
        brick_and_wall()
    ));
    assert_eq!(model.roots.len(), 2);
}

#[test]
fn shape_joined_by_a_relationship_belongs_to_the_product() {
    for between in ["#5,#6", "#6,#5"] {
        let model = model(&format!(
            "{MILLIMETRES}#1=CARTESIAN_POINT('',(0.,0.,0.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
             #5=SHAPE_REPRESENTATION('',(#2),#900);#6=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#2,#300),#900);
             #7=SHAPE_REPRESENTATION_RELATIONSHIP('','',{between});{}{}",
            product(20, "brick", 5),
            cuboid(300, [1.0, 2.0, 3.0])
        ));
        assert_eq!(
            (model.nodes.len(), model.parts[0].name.as_str(), model.parts[0].faces.len()),
            (1, "brick", 6)
        );
    }
}

#[test]
fn solids_of_one_product_are_one_part() {
    let model = model(&format!(
        "{MILLIMETRES}#5=SHAPE_REPRESENTATION('',(#300,#500),#900);{}{}{}",
        product(20, "pair", 5),
        cuboid(300, [1.0; 3]),
        cuboid(500, [2.0; 3])
    ));
    assert_eq!((model.parts.len(), model.parts[0].bodies.len()), (1, 2));
}

/// The usage has no shape of its own; a mapped item of the assembly places it.
#[test]
fn mapped_item_places_a_use_without_a_shape() {
    let data = brick_and_wall()
        .replace("#6=SHAPE_REPRESENTATION('wall',(#4,#9)", "#6=SHAPE_REPRESENTATION('wall',(#4,#81)");
    let model = model(&format!(
        "{data}#80=REPRESENTATION_MAP(#2,#5);#81=MAPPED_ITEM('',#80,#4);
         #40=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','one','',#30,#20,$);"
    ));
    let bricks = children(&model, root(&model));
    assert_eq!((bricks.len(), bricks[0].instance_name.as_deref()), (1, Some("one")));
    near(bricks[0].transform.translation, DVec3::new(100.0, 0.0, 0.0));
    assert!(model.diagnostics.is_empty());
}

/// Turned by a quarter, mirrored and doubled.
#[test]
fn mapped_item_with_an_operator() {
    let model = model(&format!(
        "{MILLIMETRES}#1=CARTESIAN_POINT('',(0.,0.,0.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
         #3=DIRECTION('',(0.,1.,0.));#4=DIRECTION('',(1.,0.,0.));#7=CARTESIAN_POINT('',(5.,0.,0.));
         #8=CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',$,#3,#4,#7,2.,$);#80=REPRESENTATION_MAP(#2,#5);
         #81=MAPPED_ITEM('left',#80,#2);#82=MAPPED_ITEM('right',#80,#8);#5=SHAPE_REPRESENTATION('',(#300),#900);
         #6=SHAPE_REPRESENTATION('',(#81,#82),#900);{}{}",
        product(30, "pair", 6),
        cuboid(300, [1.0, 1.0, 1.0])
    ));
    assert_eq!(model.instance_counts(), [2]);
    let [left, right] = children(&model, root(&model))[..] else { panic!() };
    assert_eq!(left.transform, DAffine3::IDENTITY);
    assert_eq!(left.name, "pair", "an unnamed representation goes by what it stands in");
    near(right.transform.transform_point3(DVec3::new(1.0, 10.0, 100.0)), DVec3::new(25.0, 2.0, 200.0));
    assert_eq!(right.transform.matrix3.determinant(), -8.0);
}

/// A representation that only maps another is no level of the tree.
/// Drawings map the shapes that they show; those stand nowhere for that.
#[test]
fn what_only_a_drawing_maps_is_still_a_root() {
    let model = model(&format!(
        "{}{}#60=REPRESENTATION_MAP(#4,#6);#61=MAPPED_ITEM('',#60,#62);#62=AXIS2_PLACEMENT_2D('',#63,$);
         #63=CARTESIAN_POINT('',(0.,0.));#64=PRESENTATION_VIEW('front',(#61),#900);
         #65=REPRESENTATION_MAP(#2,#5);#66=MAPPED_ITEM('',#65,#62);#67=PRESENTATION_VIEW('front',(#66),#900);",
        brick_and_wall(),
        usage(40, "'1','one',''", [30, 20], "#2,#4", "#5,#6")
    ));
    assert_eq!(root(&model).name, "wall");
    assert_eq!(children(&model, root(&model)).len(), 1);
}

#[test]
fn nothing_but_a_mapped_item_is_seen_through() {
    let model = model(&format!(
        "{MILLIMETRES}#1=CARTESIAN_POINT('',(0.,0.,0.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
         #3=CARTESIAN_POINT('',(7.,0.,0.));#4=AXIS2_PLACEMENT_3D('',#3,$,$);#80=REPRESENTATION_MAP(#2,#5);
         #81=MAPPED_ITEM('',#80,#4);#5=SHAPE_REPRESENTATION('',(#300),#900);#6=SHAPE_REPRESENTATION('',(#81),#900);{}{}",
        product(30, "moved", 6),
        cuboid(300, [1.0, 1.0, 1.0])
    ));
    assert_eq!(model.nodes.len(), 1);
    assert_eq!((root(&model).name.as_str(), model.parts[0].name.as_str()), ("moved", "moved"));
    near(root(&model).transform.translation, DVec3::new(7.0, 0.0, 0.0));
}

#[test]
fn relationship_places_a_representation_that_is_no_product() {
    let model = model(&format!(
        "{MILLIMETRES}#1=CARTESIAN_POINT('',(0.,0.,0.));#2=AXIS2_PLACEMENT_3D('',#1,$,$);
         #3=CARTESIAN_POINT('',(7.,0.,0.));#4=AXIS2_PLACEMENT_3D('',#3,$,$);
         #5=SHAPE_REPRESENTATION('body',(#2,#300),#900);#6=SHAPE_REPRESENTATION('',(#4),#900);
         #70=ITEM_DEFINED_TRANSFORMATION('','',#2,#4);
         #71=(REPRESENTATION_RELATIONSHIP('','',#5,#6)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#70)
           SHAPE_REPRESENTATION_RELATIONSHIP());{}{}",
        product(30, "whole", 6),
        cuboid(300, [1.0, 1.0, 1.0])
    ));
    let body = children(&model, root(&model))[0];
    assert_eq!(body.name, "body");
    near(body.transform.translation, DVec3::new(7.0, 0.0, 0.0));
}

#[test]
fn use_that_nothing_places_stays_at_the_origin_and_is_reported() {
    let model =
        model(&format!("{}#40=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','one','',#30,#20,$);", brick_and_wall()));
    assert_eq!(children(&model, root(&model))[0].transform, DAffine3::IDENTITY);
    assert_eq!(codes(&model), ["placement-missing"]);
}

#[test]
fn use_of_a_missing_product_is_reported() {
    let model =
        model(&format!("{}#40=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','one','',#30,#77,$);", brick_and_wall()));
    assert_eq!(codes(&model), ["component-missing"]);
    assert!(model.diagnostics[0].message.contains("#77"));
}

#[test]
fn assembly_that_contains_itself_is_cut() {
    for (parent, child) in [(30, 30), (20, 30)] {
        let model = model(&format!(
            "{}{}{}",
            brick_and_wall(),
            usage(40, "'1','',''", [30, 20], "#2,#4", "#5,#6"),
            usage(50, "'2','',''", [parent, child], "#2,#4", "#5,#6")
        ));
        assert_eq!(codes(&model), ["assembly-cycle"]);
        assert_eq!(model.parts.len(), 1);
    }
}

/// Forty levels, each using the next twice, are a million million instances: as many are made as there is room for.
#[test]
fn doubling_assembly_is_cut() {
    let mut data = brick_and_wall();
    for level in 0..40 {
        let first = 10_000 + 100 * level;
        data += &product(first, "level", 6);
        let child = if level == 39 { 20 } else { first + 100 };
        for i in 1..=2 {
            data += &format!(
                "#{}=NEXT_ASSEMBLY_USAGE_OCCURRENCE('{i}','','',#{first},#{child},$);",
                first + 10 + i
            );
        }
    }
    let model = model(&data);
    assert!(codes(&model).contains(&"assembly-too-large"));
    assert!(model.nodes.len() < 150_000);
}

#[test]
fn chain_of_assemblies_is_cut_at_a_depth() {
    let mut data = brick_and_wall();
    for level in 0..400 {
        let first = 10_000 + 10 * level;
        data += &product(first, "level", 6);
        let child = if level == 399 { 20 } else { first + 10 };
        data += &format!("#{}=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#{first},#{child},$);", first + 8);
    }
    let model = model(&data);
    assert!(codes(&model).contains(&"assembly-too-deep"));
}

#[test]
fn representations_are_roots_where_there_are_no_products() {
    let model = model(&format!(
        "{MILLIMETRES}#5=SHAPE_REPRESENTATION('first',(#300),#900);#6=SHAPE_REPRESENTATION('',(#500),#900);{}{}",
        cuboid(300, [1.0; 3]),
        cuboid(500, [1.0; 3])
    ));
    assert_eq!(model.parts.iter().map(|part| part.name.as_str()).collect::<Vec<_>>(), ["first", "#6"]);
}

#[test]
fn file_without_geometry_says_so() {
    let error = import(&product(20, "nothing", 5)).expect_err("there is nothing").to_string();
    assert!(error.contains("none of the file's 5 entities"), "{error}");
    assert!(import("").expect_err("there is nothing").to_string().contains("no entities"));
}
