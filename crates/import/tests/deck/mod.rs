//! Small STEP files for tests. Entities from #900 on are the deck's own.
#![allow(dead_code, reason = "each test file uses its own part of the deck")]

use glam::DVec3;
use trimloop_brep::{Edge, Face, FaceGeometry, Model, Part};
use trimloop_geom::{Curve, Surface};
use trimloop_import::{ImportError, import_step};
use trimloop_part21::Exchange;

/// Millimetres and radians, with an uncertainty of 0.001 mm.
pub const MILLIMETRES: &str = "
#900=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#903))
  GLOBAL_UNIT_ASSIGNED_CONTEXT((#901,#902))REPRESENTATION_CONTEXT('',''));
#901=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#902=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#903=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.001),#901,'','');
";

/// Inches and degrees.
pub const INCHES: &str = "
#950=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#956))
  GLOBAL_UNIT_ASSIGNED_CONTEXT((#951,#954))REPRESENTATION_CONTEXT('',''));
#951=(CONVERSION_BASED_UNIT('INCH',#952)LENGTH_UNIT()NAMED_UNIT(#960));
#952=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#953);
#953=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#954=(CONVERSION_BASED_UNIT('DEGREE',#955)NAMED_UNIT(#960)PLANE_ANGLE_UNIT());
#955=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.0174532925199433),#957);
#956=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.001),#951,'','');
#957=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#960=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);
";

/// The origin with the world's axes as #801, and its point as #800.
pub const ORIGIN: &str = "#800=CARTESIAN_POINT('',(0.,0.,0.));#801=AXIS2_PLACEMENT_3D('',#800,$,$);";

/// What the import makes of a DATA section.
pub fn import(data: &str) -> Result<Model, ImportError> {
    let text = format!(
        "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('','',(''),(''),'','','');\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;DATA;\n{data}\nENDSEC;END-ISO-10303-21;"
    );
    import_step(&Exchange::parse(text.into_bytes()).expect("an exchange file"))
}

/// The model of a DATA section that holds one.
pub fn model(data: &str) -> Model {
    import(data).unwrap_or_else(|error| panic!("{error}"))
}

/// The part of a representation of `items`, in millimetres, with [`ORIGIN`] there to be referred to.
pub fn part(items: &str, data: &str) -> Part {
    let model = shape(items, data);
    assert_eq!(model.parts.len(), 1);
    model.parts.into_iter().next().expect("counted")
}

/// The model of the same.
pub fn shape(items: &str, data: &str) -> Model {
    model(&format!("{MILLIMETRES}{ORIGIN}#910=SHAPE_REPRESENTATION('shape',({items}),#900);\n{data}"))
}

/// The only free curve, where it starts and where it ends.
pub fn free_curve(items: &str, data: &str) -> (Curve, DVec3, DVec3) {
    let part = part(items, data);
    assert_eq!(part.curves.len(), 1, "{:?}", part.curves);
    let free = &part.curves[0];
    ((*free.curve).clone(), free.curve.point(free.range.start), free.curve.point(free.range.end))
}

/// A face without bounds on surface `#1` of `data`.
pub fn whole_face(data: &str) -> Face {
    let data = format!("#700=ADVANCED_FACE('',(),#1,.T.);#701=OPEN_SHELL('',(#700));{data}");
    let part = part("#702", &format!("#702=SHELL_BASED_SURFACE_MODEL('',(#701));{data}"));
    part.faces.into_iter().next().expect("a face")
}

/// The surface of a face that has one.
pub fn surface(face: &Face) -> &Surface {
    match &face.geometry {
        FaceGeometry::Surface(surface) => surface,
        other => panic!("no surface but {other:?}"),
    }
}

/// Whether a face is lost.
pub fn is_lost(face: &Face) -> bool {
    matches!(face.geometry, FaceGeometry::Unreadable(_))
}

/// The codes of all diagnostics, each once, in alphabetical order.
pub fn codes(model: &Model) -> Vec<&'static str> {
    let mut codes: Vec<_> = model.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// Where an edge starts and ends by its curve; panics where these are not its vertices.
pub fn ends(part: &Part, edge: &Edge) -> [DVec3; 2] {
    let [low, high] = [edge.range.start, edge.range.end].map(|t| edge.curve.point(t));
    let ends = if edge.same_sense { [low, high] } else { [high, low] };
    for (vertex, end) in [edge.start, edge.end].into_iter().zip(ends) {
        near(part.vertices[vertex as usize].point, end);
    }
    ends
}

/// Asserts that two points are the same to nine digits.
#[track_caller]
pub fn near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) <= 1e-9 * (1.0 + b.length()), "{a} is not {b}");
}

/// A solid box from the origin to `size`, made of planes and lines, as entities `first` to about `first + 160`:
/// the solid is `first`, its shell `first + 1`, its faces `first + 2` to `first + 7` (x = 0, x = size, y = 0, ...).
pub fn cuboid(first: usize, size: [f64; 3]) -> String {
    let mut text = String::new();
    let mut next = first + 8;
    let mut add = |record: String| {
        text += &format!("#{next}={record};\n");
        next += 1;
        next - 1
    };
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { 0.0 } else { size[axis] });
    let triple = |v: [f64; 3]| format!("({:?},{:?},{:?})", v[0], v[1], v[2]);
    let points = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| add(format!("CARTESIAN_POINT('',{})", triple(corner(i)))));
    let vertices = points.map(|point| add(format!("VERTEX_POINT('',#{point})")));
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let forward = units.map(|unit| add(format!("DIRECTION('',{})", triple(unit))));
    let backward = units.map(|unit| add(format!("DIRECTION('',{})", triple(unit.map(|x| 0.0 - x)))));
    let mut edges = std::collections::HashMap::new();
    for from in 0..8usize {
        for axis in (0..3).filter(|axis| from >> axis & 1 == 0) {
            let to = from | 1 << axis;
            let vector = add(format!("VECTOR('',#{},1.)", forward[axis]));
            let line = add(format!("LINE('',#{},#{vector})", points[from]));
            let edge = add(format!("EDGE_CURVE('',#{},#{},#{line},.T.)", vertices[from], vertices[to]));
            edges.insert((from, to), edge);
        }
    }
    let mut faces = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in 0..2 {
            let base = side << axis;
            let mut ring = [base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v];
            if side == 0 {
                ring.reverse();
            }
            let oriented: Vec<String> = (0..4)
                .map(|i| {
                    let (from, to) = (ring[i], ring[(i + 1) % 4]);
                    let (key, sense) = if from < to { ((from, to), "T") } else { ((to, from), "F") };
                    format!("#{}", add(format!("ORIENTED_EDGE('',*,*,#{},.{sense}.)", edges[&key])))
                })
                .collect();
            let bound = add(format!("EDGE_LOOP('',({}))", oriented.join(",")));
            let bound = add(format!("FACE_OUTER_BOUND('',#{bound},.T.)"));
            let normal = if side == 0 { backward[axis] } else { forward[axis] };
            let frame = add(format!("AXIS2_PLACEMENT_3D('',#{},#{normal},#{})", points[base], forward[u]));
            let plane = add(format!("PLANE('',#{frame})"));
            faces.push(format!("ADVANCED_FACE('',(#{bound}),#{plane},.T.)"));
        }
    }
    let list: Vec<String> = (2..8).map(|i| format!("#{}", first + i)).collect();
    text += &format!("#{first}=MANIFOLD_SOLID_BREP('',#{});\n", first + 1);
    text += &format!("#{}=CLOSED_SHELL('',({}));\n", first + 1, list.join(","));
    for (i, face) in faces.into_iter().enumerate() {
        text += &format!("#{}={face};\n", first + 2 + i);
    }
    text
}

/// A product whose shape is a representation: the product definition is `first`, the definition of its shape
/// `first + 1`.
pub fn product(first: usize, name: &str, representation: usize) -> String {
    let [shape, formation, product, link] = [1, 2, 3, 4].map(|i| first + i);
    format!(
        "#{first}=PRODUCT_DEFINITION('',$,#{formation},$);\n\
         #{shape}=PRODUCT_DEFINITION_SHAPE('','',#{first});\n\
         #{formation}=PRODUCT_DEFINITION_FORMATION('','',#{product});\n\
         #{product}=PRODUCT('{name} id','{name}','',());\n\
         #{link}=SHAPE_DEFINITION_REPRESENTATION(#{shape},#{representation});\n"
    )
}
