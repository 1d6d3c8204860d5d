//! What sloppy files get wrong: mended where it can be, reported in any case.

mod deck;

use deck::{codes, cuboid, ends, is_lost, model, shape};
use trimloop_brep::{Model, Severity};

/// A box after some lines of it were changed.
fn changed(change: impl Fn(&str) -> String) -> Model {
    let lines: Vec<String> = cuboid(100, [10.0, 20.0, 30.0]).lines().map(change).collect();
    shape("#100", &lines.join("\n"))
}

/// All six faces are there, and every edge is used once in each direction.
fn is_closed(model: &Model) -> bool {
    let part = &model.parts[0];
    let mut uses = vec![[0, 0]; part.edges.len()];
    for coedge in part.faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges) {
        uses[coedge.edge as usize][usize::from(coedge.reversed)] += 1;
    }
    part.faces.len() == 6 && uses.iter().all(|uses| matches!(uses, [1, 1] | [0, 0]))
}

#[test]
fn nothing_to_mend_in_a_sound_box() {
    let model = changed(str::to_owned);
    assert!(model.diagnostics.is_empty() && is_closed(&model));
}

#[test]
fn lines_run_from_vertex_to_vertex_whatever_their_sense_says() {
    let model =
        changed(
            |line| if line.contains("EDGE_CURVE") { line.replace(".T.", ".F.") } else { line.to_owned() },
        );
    assert_eq!(codes(&model), ["edge-sense"]);
    assert!(is_closed(&model));
    for edge in &model.parts[0].edges {
        ends(&model.parts[0], edge);
    }
}

#[test]
fn edges_out_of_order_and_turned_are_put_in_order() {
    for what in ["order", "direction"] {
        let model = changed(|line| match line.split_once("EDGE_LOOP('',(") {
            Some((start, list)) if what == "order" => {
                let mut edges: Vec<_> = list.trim_end_matches("));").split(',').collect();
                edges.swap(1, 2);
                format!("{start}EDGE_LOOP('',({}));", edges.join(","))
            }
            _ if what == "direction" && line.contains("ORIENTED_EDGE") => line.replace(".F.", ".T."),
            _ => line.to_owned(),
        });
        assert_eq!(codes(&model), ["loop-reordered"], "{what}");
        assert!(model.parts[0].faces.iter().all(|face| face.loops[0].coedges.len() == 4));
        if what == "order" {
            assert!(is_closed(&model));
        }
    }
}

/// Every face as it would stand in a file of its own: nothing is shared but the places.
fn unshared(gap: f64) -> Model {
    let mut data = String::new();
    let mut faces = Vec::new();
    for i in 0..6 {
        let first = 1000 * (i + 1);
        let size = [10.0, 20.0, 30.0].map(|size| size + gap * i as f64);
        data += &cuboid(first, size);
        faces.push(format!("#{}", first + 2 + i));
    }
    shape("#1", &format!("{data}#1=MANIFOLD_SOLID_BREP('',#2);#2=CLOSED_SHELL('',({}));", faces.join(",")))
}

#[test]
fn faces_that_repeat_their_edges_are_sewn() {
    for gap in [0.0, 1e-4] {
        let model = unshared(gap);
        assert_eq!(codes(&model), ["edges-sewn"], "gap {gap}");
        assert!(is_closed(&model), "gap {gap}");
    }
}

#[test]
fn faces_far_apart_are_not_sewn() {
    let model = unshared(0.5);
    assert!(!is_closed(&model));
    assert!(model.diagnostics.is_empty());
}

/// Each edge has vertices of its own, up to a hundredth of a millimetre off.
#[test]
fn gaps_between_edges_are_closed() {
    let mut extra = String::new();
    let mut count = 0;
    let mut lines = Vec::new();
    for line in cuboid(100, [10.0, 20.0, 30.0]).lines() {
        let Some((start, end)) = line.split_once("EDGE_CURVE('',#") else {
            lines.push(line.to_owned());
            continue;
        };
        let (vertex, end) = end.split_once(',').expect("a vertex");
        let point = vertex.parse::<usize>().expect("a number") - 8;
        let at = point - 108;
        let place = |axis: usize, size: f64| if at >> axis & 1 == 0 { 0.0 } else { size };
        let [x, y, z] = [place(0, 10.0), place(1, 20.0), place(2, 30.0)];
        let own = 500 + 2 * count;
        count += 1;
        extra += &format!("#{own}=CARTESIAN_POINT('',({x:?},{y:?},{:?}));", z + 0.0005 * count as f64);
        extra += &format!("#{}=VERTEX_POINT('',#{own});", own + 1);
        lines.push(format!("{start}EDGE_CURVE('',#{},{end}", own + 1));
    }
    let model = shape("#100", &format!("{}{extra}", lines.join("\n")));
    assert!(is_closed(&model));
    assert!(codes(&model).contains(&"loop-gap-closed"));
    let part = &model.parts[0];
    for bound in part.faces.iter().flat_map(|face| &face.loops) {
        for (i, coedge) in bound.coedges.iter().enumerate() {
            let next = &bound.coedges[(i + 1) % 4];
            let end = |c: &trimloop_brep::Coedge, last: bool| {
                let edge = &part.edges[c.edge as usize];
                if c.reversed == last { edge.start } else { edge.end }
            };
            assert_eq!(end(coedge, true), end(next, false));
        }
    }
}

#[test]
fn edges_that_do_not_meet_are_reported() {
    let model = changed(|line| match line.split_once("EDGE_LOOP('',(") {
        Some((start, list)) => {
            format!("{start}EDGE_LOOP('',({}", &list[list.find(',').expect("a comma") + 1..])
        }
        None => line.to_owned(),
    });
    assert_eq!(codes(&model), ["loop-gap"]);
}

#[test]
fn vertex_beside_its_curve_is_reported() {
    let model = changed(|line| {
        if line.starts_with("#108=") {
            "#108=CARTESIAN_POINT('',(0.,0.,0.));#98=CARTESIAN_POINT('',(0.,0.05,0.));".to_owned()
        } else if line.starts_with("#116=") {
            "#116=VERTEX_POINT('',#98);".to_owned()
        } else {
            line.to_owned()
        }
    });
    assert_eq!(codes(&model), ["vertex-off-curve"]);
}

/// Two planes show where an edge ran whose curve is gone.
#[test]
fn edge_between_planes_is_straight_without_its_curve() {
    for broken in ["LINE('',#77,#78)", "CIRCLE('',#77,-1.)"] {
        let model = changed(|line| {
            if line.contains("=LINE('',#108,") && line.starts_with("#131=") {
                format!("#131={broken};")
            } else {
                line.to_owned()
            }
        });
        assert!(is_closed(&model), "{:?}", model.diagnostics);
        assert_eq!(codes(&model), ["edge-straightened"]);
    }
}

#[test]
fn face_listed_twice_counts_once() {
    let model = changed(|line| line.replace("CLOSED_SHELL('',(", "CLOSED_SHELL('',(#104,"));
    assert_eq!(model.parts[0].bodies[0].shells[0].faces.len(), 6);
    assert_eq!(codes(&model), ["face-repeated"]);
}

#[test]
fn missing_face_is_lost_and_named() {
    let model = changed(|line| line.replace("CLOSED_SHELL('',(#102,", "CLOSED_SHELL('',(#77,"));
    let part = &model.parts[0];
    assert_eq!(part.faces.iter().filter(|face| is_lost(face)).count(), 1);
    let error = &model.diagnostics[0];
    assert_eq!(
        (error.severity, error.code, error.entity.to_string().as_str()),
        (Severity::Error, "face-unreadable", "#77")
    );
}

#[test]
fn unreadable_face_names_the_entity_and_its_line() {
    let model = changed(|line| {
        if line.contains("PLANE(") {
            line.replacen("PLANE('',#", "PLANE('',#9999", 1)
        } else {
            line.to_owned()
        }
    });
    assert!(model.parts[0].faces.iter().all(is_lost));
    assert!(
        model
            .diagnostics
            .iter()
            .all(|error| error.message.contains("PLANE") && error.message.contains("line "))
    );
}

#[test]
fn zero_weights_are_lifted_and_negative_ones_refused() {
    let spline = |weights: &str| {
        shape(
            "#9",
            &format!(
                "#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(1.,2.,0.));#3=CARTESIAN_POINT('',(3.,2.,0.));
                 #4=(BEZIER_CURVE()BOUNDED_CURVE()B_SPLINE_CURVE(2,(#1,#2,#3),.UNSPECIFIED.,.F.,.F.)CURVE()
                   GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(({weights}))REPRESENTATION_ITEM(''));
                 #5=CIRCLE('',#801,1.);#9=GEOMETRIC_CURVE_SET('',(#4,#5));"
            ),
        )
    };
    assert_eq!(codes(&spline("1.,0.,1.")), ["zero-weight"]);
    assert_eq!(spline("1.,0.,1.").parts[0].curves.len(), 2);
    assert_eq!(codes(&spline("1.,-1.,1.")), ["curve-unreadable"]);
    assert_eq!(spline("-1.,-1.,-1.").parts[0].curves.len(), 2);
}

#[test]
fn lower_case_keywords_are_understood() {
    let data = cuboid(100, [1.0; 3]);
    let lower: String = data.replace("ADVANCED_FACE", "advanced_face").replace("LINE(", "line(");
    assert!(is_closed(&model(&lower)));
}
