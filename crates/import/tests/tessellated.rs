//! AP242 tessellated geometry.

mod deck;

use deck::{codes, cuboid, is_lost, near, part, shape};
use glam::DVec3;
use trimloop_brep::{BodyKind, Face, FaceGeometry, Facets};

const SQUARE: &str = "#1=COORDINATES_LIST('',4,((0.,0.,0.),(1.,0.,0.),(1.,1.,0.),(0.,1.,0.)));";

fn facets(face: &Face) -> &Facets {
    match &face.geometry {
        FaceGeometry::Facets(facets) => facets,
        other => panic!("no facets but {other:?}"),
    }
}

#[test]
fn triangles_strips_and_fans() {
    for (record, triangles) in [
        ("TRIANGULATED_FACE('',#1,4,((0.,0.,1.)),$,(),((1,2,3),(1,3,4)))", vec![[0, 1, 2], [0, 2, 3]]),
        ("TRIANGULATED_SURFACE_SET('',#1,4,(),(),((1,2,3)))", vec![[0, 1, 2]]),
        ("COMPLEX_TRIANGULATED_FACE('',#1,4,(),$,(),((1,2,4,3)),())", vec![[0, 1, 3], [3, 1, 2]]),
        ("COMPLEX_TRIANGULATED_FACE('',#1,4,(),$,(),(),((1,2,3,4)))", vec![[0, 1, 2], [0, 2, 3]]),
        ("COMPLEX_TRIANGULATED_SURFACE_SET('',#1,4,(),(4,3,2),((1,2,3)),())", vec![[3, 2, 1]]),
    ] {
        let part = part("#9", &format!("{SQUARE}#2={record};#9=TESSELLATED_SHELL('',(#2),$);"));
        assert_eq!(facets(&part.faces[0]).triangles, triangles, "{record}");
    }
}

#[test]
fn normals_one_for_all_or_one_for_each() {
    for (normals, tilted) in
        [("((0.,0.,2.))", false), ("((0.,0.,1.),(0.,0.,1.),(0.,0.,1.),(3.,0.,4.))", true)]
    {
        let part = part(
            "#9",
            &format!(
                "{SQUARE}#2=TRIANGULATED_FACE('',#1,4,{normals},$,(),((1,3,4)));#9=TESSELLATED_SHELL('',(#2),$);"
            ),
        );
        let normals = &facets(&part.faces[0]).normals;
        near(normals[0][0], DVec3::Z);
        near(normals[0][2], if tilted { DVec3::new(0.6, 0.0, 0.8) } else { DVec3::Z });
    }
}

#[test]
fn normals_that_do_not_fit_are_left_out() {
    let model = shape(
        "#9",
        &format!(
            "{SQUARE}#2=TRIANGULATED_FACE('',#1,4,((0.,0.,1.),(0.,0.,1.)),$,(),((1,3,4)));#9=TESSELLATED_SHELL('',(#2),$);"
        ),
    );
    assert_eq!(codes(&model), ["normals-left-out"]);
    assert!(facets(&model.parts[0].faces[0]).normals.is_empty());
}

/// Faces meet in the points at the same place, even where each lists its own.
#[test]
fn faces_of_a_solid_share_points() {
    let part = part(
        "#9",
        &format!(
            "{SQUARE}#2=COORDINATES_LIST('',3,((1.,1.,0.),(0.,1.,-0.),(0.,1.,5.)));
             #3=TRIANGULATED_FACE('',#1,4,(),$,(),((1,2,3)));#4=TRIANGULATED_FACE('',#2,3,(),$,(),((1,2,3)));
             #9=TESSELLATED_SOLID('',(#3,#4),$);"
        ),
    );
    assert_eq!(part.bodies[0].kind, BodyKind::Solid);
    assert_eq!(facets(&part.faces[1]).triangles, [[2, 3, 4]]);
    assert_eq!(part.facet_points.len(), 5);
}

#[test]
fn repositioned_items_are_moved() {
    let part = part(
        "#9",
        &format!(
            "{SQUARE}#2=TRIANGULATED_FACE('',#1,4,(),$,(),((1,2,3)));#3=CARTESIAN_POINT('',(0.,0.,7.));
             #4=AXIS2_PLACEMENT_3D('',#3,$,$);
             #9=(GEOMETRIC_REPRESENTATION_ITEM()REPOSITIONED_TESSELLATED_ITEM(#4)REPRESENTATION_ITEM('moved')
               TESSELLATED_GEOMETRIC_SET((#2))TESSELLATED_ITEM());"
        ),
    );
    assert_eq!(part.bodies[0].name, "moved");
    near(part.facet_points[0], DVec3::new(0.0, 0.0, 7.0));
}

#[test]
fn line_strips_are_free_curves_and_points_are_nothing() {
    let part = part(
        "#9",
        &format!(
            "{SQUARE}#2=TESSELLATED_CURVE_SET('',#1,((1,2,3,4,1),(1,3)));#3=TESSELLATED_POINT_SET('',#1,(1,2));
             #9=TESSELLATED_GEOMETRIC_SET('',(#2,#3));"
        ),
    );
    assert!(part.faces.is_empty());
    assert_eq!(part.curves.iter().map(|curve| curve.range.end).collect::<Vec<_>>(), [4.0, 1.0]);
}

/// Dimensions and notes are drawn beside the shape.
#[test]
fn annotations_are_no_part_of_the_shape() {
    let part = part(
        "#9,#100",
        &format!(
            "{SQUARE}{}#2=TESSELLATED_CURVE_SET('',#1,((1,2,3)));#9=TESSELLATED_GEOMETRIC_SET('',(#2));
             #3=TESSELLATED_ANNOTATION_OCCURRENCE('',(),#9);",
            cuboid(100, [1.0; 3])
        ),
    );
    assert!(part.curves.is_empty());
}

#[test]
fn tessellation_of_an_exact_solid_is_left_out() {
    let model = shape(
        "#9,#100",
        &format!(
            "{SQUARE}{}#2=TRIANGULATED_FACE('',#1,4,(),$,(),((1,2,3)));#9=TESSELLATED_SOLID('',(#2),#100);",
            cuboid(100, [1.0; 3])
        ),
    );
    assert_eq!(model.parts[0].faces.len(), 6);
    assert_eq!(codes(&model), ["tessellation-left-out"]);
}

#[test]
fn triangles_that_refer_to_nothing_are_lost_and_the_others_kept() {
    for bad in ["(1,2,5)", "(0,1,2)", "(1,2,999999999)"] {
        let part = part(
            "#9",
            &format!(
                "{SQUARE}#2=TRIANGULATED_FACE('',#1,4,(),$,(),((1,2,3),{bad}));#9=TESSELLATED_SHELL('',(#2),$);"
            ),
        );
        assert_eq!(facets(&part.faces[0]).triangles, [[0, 1, 2]]);
        assert!(is_lost(&part.faces[1]));
    }
}
