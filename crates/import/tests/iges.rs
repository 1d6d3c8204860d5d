//! IGES files: loose trimmed faces become a closed body.

use glam::DVec3;
use trimloop_brep::{BodyKind, EntityRef, FaceGeometry, Model, Severity};
use trimloop_iges::IgesFile;
use trimloop_import::import_iges;

/// A file in the making: entities with their directory fields.
#[derive(Default)]
struct Deck {
    directory: String,
    parameters: String,
    lines: usize,
    entities: usize,
}

impl Deck {
    /// Adds an entity; gives its pointer.
    fn add(&mut self, kind: u32, status: &str, color: i32, parameters: &str) -> usize {
        self.add_form(kind, 0, status, color, parameters)
    }

    /// Adds an entity of a form; gives its pointer.
    fn add_form(&mut self, kind: u32, form: u32, status: &str, color: i32, parameters: &str) -> usize {
        let entry = 2 * self.entities + 1;
        self.entities += 1;
        let text = format!("{kind},{parameters};");
        // No number crosses lines.
        let mut pieces = vec![String::new()];
        for value in text.split_inclusive(',') {
            if pieces.last().is_some_and(|line| line.len() + value.len() > 64) {
                pieces.push(String::new());
            }
            *pieces.last_mut().expect("a line") += value;
        }
        let (first, count) = (self.lines + 1, pieces.len());
        let one = format!("{kind:>8}{first:>8}{:>48}{status}", 0);
        let two = format!("{kind:>8}{:>8}{color:>8}{count:>8}{form:>8}", 0);
        self.directory += &format!("{one:<72}D{entry:>7}\n{two:<72}D{:>7}\n", entry + 1);
        for piece in pieces {
            self.lines += 1;
            self.parameters += &format!("{piece:<64}{entry:>8}P{:>7}\n", self.lines);
        }
        entry
    }

    /// The whole file, in inches.
    fn text(&self) -> String {
        let start = format!("{:<72}S      1\n", "made by a test");
        let global = format!("{:<72}G      1\n", "1H,,1H;,4Hcube,,,,,,,,,,1.,1,2HIN,1,0.01,,1.E-4;");
        let counts = format!("S      1G      1D{:>7}P{:>7}", 2 * self.entities, self.lines);
        format!("{start}{global}{}{}{counts:<72}T      1\n", self.directory, self.parameters)
    }
}

type Point = [f64; 3];

fn coordinates(points: &[Point]) -> String {
    points.iter().flatten().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",")
}

/// A bilinear patch trimmed by its own four sides, which no other face shares.
fn patch(deck: &mut Deck, [a, b, c, d]: [Point; 4], color: i32) -> usize {
    let surface = format!(
        "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},0.,1.,0.,1.",
        coordinates(&[a, b, d, c])
    );
    let surface = deck.add(128, "00010000", 0, &surface);
    let sides = [[a, b], [b, c], [c, d], [d, a]];
    let lines: Vec<String> =
        sides.iter().map(|side| deck.add(110, "00010000", 0, &coordinates(side)).to_string()).collect();
    let boundary = deck.add(102, "00010000", 0, &format!("4,{}", lines.join(",")));
    let boundary = deck.add(142, "00010000", 0, &format!("0,{surface},0,{boundary},2"));
    deck.add(144, "00000000", color, &format!("{surface},1,0,{boundary}"))
}

/// The sides of a cube of one inch.
fn cube(colors: [i32; 6]) -> Deck {
    let mut deck = Deck::default();
    for (side, color) in cube_sides().into_iter().zip(colors) {
        patch(&mut deck, side, color);
    }
    deck
}

fn cube_sides() -> [[Point; 4]; 6] {
    let corner = |k: usize| [k & 1, k >> 1 & 1, k >> 2].map(|bit| bit as f64);
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.map(|side| side.map(corner))
}

/// How many edges the only body of a deck has, a solid that closes.
fn edges_of_solid(deck: &Deck) -> usize {
    let model = model(deck);
    let [part] = &model.parts[..] else { panic!("{} parts", model.parts.len()) };
    let [body] = &part.bodies[..] else { panic!("{} bodies", part.bodies.len()) };
    assert_eq!((body.kind, body.shells[0].closed), (BodyKind::Solid, true));
    let coedges = part.faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges);
    coedges.map(|coedge| coedge.edge).collect::<std::collections::BTreeSet<u32>>().len()
}

/// Metres that are called millimetres: what is near is a matter of the part's size.
#[test]
fn sheets_of_a_tiny_part_are_not_sewn_across_a_tenth_of_it() {
    let mut deck = Deck::default();
    let size = 4e-3;
    for z in [0.0, 0.1 * size] {
        patch(&mut deck, [[0.0, 0.0, z], [size, 0.0, z], [size, size, z], [0.0, size, z]], 0);
    }
    let model = model(&deck);
    let faces = &model.parts[0].faces;
    let coedges = faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges);
    assert_eq!(coedges.map(|coedge| coedge.edge).collect::<std::collections::BTreeSet<u32>>().len(), 8);
}

/// Each face's boundary is one spline, which begins at a corner that no other face's boundary begins at.
#[test]
fn a_boundary_of_one_curve_is_cut_at_its_corners() {
    let mut deck = Deck::default();
    for (k, mut side) in cube_sides().into_iter().enumerate() {
        side.rotate_left(k % 4);
        let [a, b, c, d] = side;
        let surface = format!(
            "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},0.,1.,0.,1.",
            coordinates(&[a, b, d, c])
        );
        let surface = deck.add(128, "00010000", 0, &surface);
        let points = coordinates(&[a, b, c, d, a]);
        let spline = format!("4,1,0,1,1,0,0.,0.,1.,2.,3.,4.,4.,1.,1.,1.,1.,1.,{points},0.,4.,0.,0.,0.");
        let spline = deck.add(126, "00010000", 0, &spline);
        let boundary = deck.add(142, "00010000", 0, &format!("0,{surface},0,{spline},2"));
        deck.add(144, "00000000", 0, &format!("{surface},1,0,{boundary}"));
    }
    assert_eq!(edges_of_solid(&deck), 12);
}

#[test]
fn loose_faces_that_close_become_a_solid() {
    let file = IgesFile::parse(cube([0; 6]).text().as_bytes()).expect("a file");
    assert_eq!(file.errors(), []);
    let model = import_iges(&file).expect("a model");
    let [part] = &model.parts[..] else { panic!("{} parts", model.parts.len()) };
    let [body] = &part.bodies[..] else { panic!("{} bodies", part.bodies.len()) };
    assert_eq!((body.kind, body.shells[0].closed, part.faces.len()), (BodyKind::Solid, true, 6));
    assert!(part.curves.is_empty(), "the boundaries are no free curves");
    let used: std::collections::BTreeSet<u32> =
        part.faces.iter().flat_map(|face| &face.loops[0].coedges).map(|coedge| coedge.edge).collect();
    assert_eq!(used.len(), 12, "two faces share each edge");
    let far = part.vertices.iter().map(|vertex| vertex.point.max_element()).fold(0.0, f64::max);
    assert!((far - 25.4).abs() < 1e-12, "inches become millimetres: {far}");
}

#[test]
fn faces_keep_their_colours() {
    let file = IgesFile::parse(cube([2, 0, 4, 0, 0, 0]).text().as_bytes()).expect("a file");
    let model = import_iges(&file).expect("a model");
    let colors: Vec<_> = model.parts[0].faces.iter().map(|f| f.color.map(|c| [c.r, c.g, c.b])).collect();
    assert_eq!(colors[..3], [Some([1.0, 0.0, 0.0]), None, Some([0.0, 0.0, 1.0])]);
}

#[test]
fn a_face_that_cannot_be_read_costs_itself_alone() {
    let mut deck = cube([0; 6]);
    let lost = deck.add(144, "00000000", 0, "9999,1,0,1");
    let file = IgesFile::parse(deck.text().as_bytes()).expect("a file");
    let model = import_iges(&file).expect("a model");
    let faces = &model.parts[0].faces;
    assert_eq!(faces.iter().filter(|f| matches!(f.geometry, FaceGeometry::Surface(_))).count(), 6);
    assert_eq!(faces[6].entity, EntityRef::Iges(lost as u32));
    let [diagnostic] = &model.diagnostics[..] else { panic!("{:?}", model.diagnostics) };
    assert_eq!((diagnostic.severity, diagnostic.code), (Severity::Error, "face-unreadable"));
}

/// The model of a deck whose file has no errors.
fn model(deck: &Deck) -> Model {
    let text = deck.text();
    let file = IgesFile::parse(text.as_bytes()).expect("a file");
    assert_eq!(file.errors(), []);
    import_iges(&file).expect("a model")
}

/// The names of the tree's nodes and of their uses, indented by level.
fn tree(model: &Model) -> Vec<String> {
    let mut out = Vec::new();
    let mut stack: Vec<(usize, usize)> = model.roots.iter().map(|&root| (root, 0)).collect();
    while let Some((index, depth)) = stack.pop() {
        let node = &model.nodes[index];
        let instance = node.instance_name.as_ref().map(|name| format!(" ({name})")).unwrap_or_default();
        out.push(format!("{}{}{instance}", "  ".repeat(depth), node.name));
        stack.extend(node.children.iter().rev().map(|&child| (child, depth + 1)));
    }
    out
}

fn name(deck: &mut Deck, text: &str) -> usize {
    deck.add_form(406, 15, "00010000", 0, &format!("1,{}H{text}", text.len()))
}

#[test]
fn subfigures_are_placed_as_often_as_they_are_used() {
    let mut deck = Deck::default();
    let block = deck.add(150, "00010000", 0, "1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,0.,1.");
    let definition = deck.add(308, "00000200", 0, &format!("0,4Hbolt,1,{block}"));
    let left = name(&mut deck, "left");
    deck.add(408, "00000000", 0, &format!("{definition},0.,0.,0.,1.,0,1,{left}"));
    deck.add(408, "00000000", 0, &format!("{definition},5.,0.,0.,2."));
    let model = model(&deck);
    assert_eq!(tree(&model), ["cube", "  bolt (left)", "  bolt"]);
    assert_eq!((model.parts.len(), model.instance_counts()), (1, vec![2]));
    let placed: Vec<_> = model.nodes[1..].iter().map(|node| node.transform).collect();
    let corner = placed[1].transform_point3(DVec3::splat(25.4));
    assert!(corner.distance(DVec3::new(7.0, 2.0, 2.0) * 25.4) < 1e-9, "scaled, then moved: {corner}");
}

#[test]
fn a_subfigure_that_places_itself_is_shown_once() {
    let mut deck = Deck::default();
    let block = deck.add(150, "00010000", 0, "1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,0.,1.");
    let definition = 5;
    let inner = deck.add(408, "00010000", 0, &format!("{definition},0.,0.,0.,1."));
    assert_eq!(deck.add(308, "00000200", 0, &format!("0,4Hloop,2,{block},{inner}")), definition);
    deck.add(408, "00000000", 0, &format!("{definition},0.,0.,0.,1."));
    let model = model(&deck);
    assert_eq!(tree(&model), ["cube", "  loop"]);
    let cycles = model.diagnostics.iter().filter(|d| d.code == "assembly-cycle").count();
    assert_eq!(cycles, 1, "{:?}", model.diagnostics);
}

#[test]
fn groups_and_names_are_nodes_and_a_body_stays_whole() {
    let mut deck = Deck::default();
    let corner = |k: usize| [(k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64];
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces: Vec<usize> = sides.map(|side| patch(&mut deck, side.map(corner), 0)).into();
    let list = |faces: &[usize]| faces.iter().map(usize::to_string).collect::<Vec<_>>().join(",");
    let block = deck.add(150, "00000000", 0, "1.,1.,1.,9.,0.,0.,1.,0.,0.,0.,0.,1.");
    // The cube's faces stand in two groups of one group.
    let parts = [&faces[..2], &faces[2..]]
        .map(|part| deck.add_form(402, 7, "00000000", 0, &format!("{},{}", part.len(), list(part))));
    let label = name(&mut deck, "housing");
    deck.add_form(402, 7, "00000000", 0, &format!("3,{},{block},0,1,{label}", list(&parts)));
    let model = model(&deck);
    assert_eq!(tree(&model), ["cube", "  housing"]);
    let [part] = &model.parts[..] else { panic!("{} parts", model.parts.len()) };
    assert_eq!(part.name, "housing");
    let kinds: Vec<BodyKind> = part.bodies.iter().map(|body| body.kind).collect();
    assert_eq!(kinds, [BodyKind::Solid, BodyKind::Solid]);
}

#[test]
fn what_stays_open_is_reported_with_its_gap() {
    let mut deck = Deck::default();
    patch(&mut deck, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], 0);
    patch(&mut deck, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 0.0]], 0);
    // A hundredth of an inch away from both.
    patch(&mut deck, [[0.0, 1.01, 0.0], [1.0, 1.01, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]], 0);
    let model = model(&deck);
    let [diagnostic] = &model.diagnostics[..] else { panic!("{:?}", model.diagnostics) };
    assert_eq!((diagnostic.severity, diagnostic.code), (Severity::Warning, "open-edges"));
    assert!(diagnostic.message.contains("6 edges of the 2 faces"), "{}", diagnostic.message);
    assert!(diagnostic.message.contains("0.254 mm off"), "{}", diagnostic.message);
}

/// Where curves of one boundary end a twentieth of a millimetre apart, each still lies on its neighbour's.
#[test]
fn edges_are_sewn_by_where_their_curves_end() {
    let mut deck = Deck::default();
    // In inches: 0.002 are 0.05 mm.
    let [p, b, late, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.002, 0.0, 0.0], [2.0, 0.0, 0.0]];
    let mut face = |lines: &[[Point; 2]]| {
        let plane = deck.add(108, "00010000", 0, "0.,0.,1.,0.,0,0.,0.,0.,0.");
        let lines: Vec<String> =
            lines.iter().map(|l| deck.add(110, "00010000", 0, &coordinates(l)).to_string()).collect();
        let chain = deck.add(102, "00010000", 0, &format!("{},{}", lines.len(), lines.join(",")));
        let boundary = deck.add(142, "00010000", 0, &format!("0,{plane},0,{chain},2"));
        deck.add(144, "00000000", 0, &format!("{plane},1,0,{boundary}"));
    };
    let up = |[x, _, z]: Point| [x, 1.0, z];
    let down = |[x, _, z]: Point| [x, -1.0, z];
    face(&[[p, late], [b, c], [c, up(c)], [up(c), up(p)], [up(p), p]]);
    face(&[[late, p], [p, down(p)], [down(p), down(late)], [down(late), late]]);
    face(&[[c, b], [late, down(late)], [down(late), down(c)], [down(c), c]]);
    let model = model(&deck);
    let part = &model.parts[0];
    let mut uses = vec![0; part.edges.len()];
    let coedges = part.faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges);
    coedges.for_each(|coedge| uses[coedge.edge as usize] += 1);
    assert_eq!(uses.iter().filter(|&&count| count == 2).count(), 3, "{uses:?}");
    let counts: Vec<usize> = part.faces.iter().map(|face| face.loops[0].coedges.len()).collect();
    assert_eq!(counts, [5, 4, 4], "nothing is cut");
}

/// A spline surface that is said to end a hair behind one of its knots ends at the knot.
#[test]
fn a_stated_range_ends_at_the_knot_that_it_means() {
    let mut deck = Deck::default();
    let points: Vec<Point> = (0..6).map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0]).collect();
    let spline = |end: &str| {
        let head = "1,2,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,2.,2.,1.,1.,1.,1.,1.,1.";
        format!("{head},{},0.,1.,0.,{end}", coordinates(&points))
    };
    deck.add(128, "00000000", 0, &spline("1.0000000001"));
    deck.add(128, "00000000", 0, &spline("1.01"));
    let ends = |face: &trimloop_brep::Face| {
        let FaceGeometry::Surface(surface) = &face.geometry else { panic!("a surface") };
        let trimloop_geom::Surface::Nurbs(nurbs) = &**surface else { panic!("a spline") };
        nurbs.distinct_knots(trimloop_geom::Direction::V)
    };
    let model = model(&deck);
    let found: Vec<_> = model.parts.iter().flat_map(|part| &part.faces).map(ends).collect();
    assert_eq!(found, [vec![0.0, 1.0], vec![0.0, 1.0, 1.01]]);
}

#[test]
fn one_long_edge_meets_two_short_ones() {
    let mut deck = Deck::default();
    patch(&mut deck, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]], 0);
    patch(&mut deck, [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]], 0);
    patch(&mut deck, [[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 0.0], [1.0, 2.0, 0.0]], 0);
    let model = model(&deck);
    let part = &model.parts[0];
    assert_eq!(part.bodies.len(), 1, "they hang together");
    let mut uses = vec![0; part.edges.len()];
    let coedges = part.faces.iter().flat_map(|face| &face.loops).flat_map(|bound| &bound.coedges);
    coedges.for_each(|coedge| uses[coedge.edge as usize] += 1);
    assert_eq!(uses.iter().filter(|&&count| count == 2).count(), 3);
    assert_eq!(part.faces[0].loops[0].coedges.len(), 5, "the long side is cut in two");
}

#[test]
fn points_and_curves_are_free_where_nothing_uses_them() {
    let mut deck = Deck::default();
    deck.add(116, "00000000", 2, "1.,2.,3.,0");
    deck.add(116, "00010000", 0, "9.,9.,9.,0");
    deck.add(116, "01000000", 0, "9.,9.,9.,0");
    deck.add(110, "00000000", 4, "0.,0.,0.,1.,0.,0.");
    deck.add(110, "01000000", 0, "0.,0.,0.,9.,0.,0.");
    let model = model(&deck);
    let part = &model.parts[0];
    assert_eq!((part.points.len(), part.curves.len()), (1, 1));
    assert!(part.points[0].point.distance(DVec3::new(25.4, 50.8, 76.2)) < 1e-12);
    assert_eq!(part.points[0].color.map(|c| [c.r, c.g, c.b]), Some([1.0, 0.0, 0.0]));
}

#[test]
fn the_curve_that_a_face_prefers_is_the_one_that_counts() {
    // A square in the plane of a patch of 10 by 10: in parameters from 0.2 to 0.4, in the model somewhere else.
    let area = |preference: u32| {
        let mut deck = Deck::default();
        let corners = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [10.0, 10.0, 0.0]];
        let surface = format!(
            "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},0.,1.,0.,1.",
            coordinates(&corners)
        );
        let surface = deck.add(128, "00010000", 0, &surface);
        let square = |deck: &mut Deck, low: f64, high: f64, status: &str| {
            let p = [[low, low, 0.0], [high, low, 0.0], [high, high, 0.0], [low, high, 0.0]];
            let sides = [[p[0], p[1]], [p[1], p[2]], [p[2], p[3]], [p[3], p[0]]];
            let lines = sides.map(|side| deck.add(110, status, 0, &coordinates(&side)).to_string());
            deck.add(102, status, 0, &format!("4,{}", lines.join(",")))
        };
        let in_plane = square(&mut deck, 0.2, 0.4, "00010500");
        let in_model = square(&mut deck, 5.0, 9.0, "00010000");
        let boundary = format!("0,{surface},{in_plane},{in_model},{preference}");
        let boundary = deck.add(142, "00010000", 0, &boundary);
        deck.add(144, "00000000", 0, &format!("{surface},1,0,{boundary}"));
        let model = model(&deck);
        let part = &model.parts[0];
        let xs = part.vertices.iter().map(|vertex| vertex.point.x / 25.4);
        xs.fold(0.0, f64::max)
    };
    assert!((area(1) - 4.0).abs() < 1e-9, "the curve in parameters");
    assert!((area(2) - 9.0).abs() < 1e-9, "the curve in the model");
}

#[test]
fn a_boolean_tree_is_lost_and_not_in_silence() {
    let mut deck = cube([0; 6]);
    let block = deck.add(150, "00010000", 0, "1.,1.,1.,9.,0.,0.,1.,0.,0.,0.,0.,1.");
    let ball = deck.add(158, "00010000", 0, "1.,9.,0.,0.");
    let tree = deck.add(180, "00000000", 0, &format!("3,-{block},-{ball},1"));
    let model = model(&deck);
    let lost: Vec<_> = model.parts.iter().flat_map(|part| &part.faces).collect();
    let lost: Vec<_> =
        lost.iter().filter(|face| matches!(face.geometry, FaceGeometry::Unreadable(_))).collect();
    assert_eq!(lost.len(), 1, "its operands are not shown by themselves");
    assert_eq!(lost[0].entity, EntityRef::Iges(tree as u32));
}

/// A trimmed surface that has no outer boundary of its own, over a plane that has one.
#[test]
fn a_bounded_plane_bounds_what_is_cut_out_of_it() {
    let mut deck = Deck::default();
    let rim = deck.add(100, "00010000", 0, "0.,0.,0.,10.,0.,10.,0.");
    let plane = deck.add_form(108, 1, "00010000", 0, &format!("0.,0.,1.,0.,{rim},0.,0.,0."));
    let ring = deck.add(100, "00010000", 0, "0.,0.,0.,2.,0.,2.,0.");
    let hole = deck.add(142, "00010000", 0, &format!("0,{plane},0,{ring},2"));
    deck.add(144, "00000000", 0, &format!("{plane},1,1,0,{hole}"));
    let model = model(&deck);
    let [face] = &model.parts[0].faces[..] else { panic!("{:?}", model.parts[0].faces) };
    assert_eq!(face.loops.iter().map(|bound| bound.outer).collect::<Vec<_>>(), [true, false]);
}

/// A scale by which all would lie at infinity is none.
#[test]
fn a_scale_that_cannot_be_is_taken_for_one() {
    let text = cube([0; 6]).text();
    for scale in ["1.E-300", "1.E300", "-3.", "0."] {
        let text = text.replace(",1.,1,2HIN", &format!(",{scale},1,2HIN"));
        let file = IgesFile::parse(text.as_bytes()).expect("a file");
        let model = import_iges(&file).expect("a model");
        let far = model.parts[0].vertices.iter().map(|vertex| vertex.point.max_element());
        assert!((far.fold(0.0, f64::max) - 25.4).abs() < 1e-12, "{scale}");
        let told = model.diagnostics.iter().any(|d| d.message.contains("scale of model space"));
        assert_eq!(told, scale.contains('E'), "{scale}");
    }
}

/// Six digits of two pi: the tube closes.
#[test]
fn a_turn_of_six_digits_is_a_whole_one() {
    let mut deck = Deck::default();
    let axis = deck.add(110, "00010000", 0, "0.,0.,0.,0.,0.,1.");
    let line = deck.add(110, "00010000", 0, "2.,0.,0.,2.,0.,3.");
    deck.add(120, "00000000", 0, &format!("{axis},{line},0.,6.28318"));
    let model = model(&deck);
    let FaceGeometry::Surface(surface) = &model.parts[0].faces[0].geometry else { panic!("a surface") };
    assert!(surface.periods()[0].is_some());
    let used: Vec<u32> =
        model.parts[0].faces[0].loops.iter().flat_map(|l| &l.coedges).map(|c| c.edge).collect();
    assert_eq!(used.len(), 4, "two rings and the seam twice");
    assert_eq!(used.iter().collect::<std::collections::BTreeSet<_>>().len(), 3);
}

/// A tube whose rim runs out and back over itself: the two ways are two places on the tube, and stay two edges.
#[test]
fn sides_that_lie_on_each_other_elsewhere_on_a_surface_stay_two() {
    let mut deck = Deck::default();
    let rim = [[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
    let row = |z: f64| rim.map(|[x, y]| [x, y, z]);
    let points: Vec<Point> = row(0.0).into_iter().chain(row(3.0)).collect();
    let knots = "0.,0.,1.,2.,3.,4.,5.,6.,6.,0.,0.,1.,1.";
    let weights = ["1."; 14].join(",");
    let points = coordinates(&points);
    deck.add(128, "00000000", 0, &format!("6,1,1,1,1,0,1,0,0,{knots},{weights},{points},0.,6.,0.,1."));
    let model = model(&deck);
    let coedges = &model.parts[0].faces[0].loops[0].coedges;
    let edges: std::collections::BTreeSet<u32> = coedges.iter().map(|coedge| coedge.edge).collect();
    assert_eq!(coedges.len() - edges.len(), 1, "only the seam is one edge used twice");
}

/// A plane without a reference direction has the axes that OpenCASCADE gives it.
#[test]
fn planes_lie_along_the_coordinate_planes() {
    for (normal, x) in [("0.,0.,1.", DVec3::X), ("0.,0.,-1.", DVec3::NEG_X), ("1.,0.,0.", DVec3::Z)] {
        let mut deck = Deck::default();
        let rim = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [0.5, 0.0, 0.0], [0.0, 0.0, 0.0]];
        let rim = deck.add_form(106, 12, "00010000", 0, &format!("2,4,{}", coordinates(&rim)));
        deck.add_form(108, 1, "00000000", 0, &format!("{normal},0.,{rim},0.,0.,0.,0."));
        let model = model(&deck);
        let FaceGeometry::Surface(surface) = &model.parts[0].faces[0].geometry else { panic!("a plane") };
        let trimloop_geom::Surface::Plane { frame } = &**surface else { panic!("{surface:?}") };
        assert!((frame.x - x).length() < 1e-12, "{normal}: {}", frame.x);
    }
}

/// A cylinder whose mantle is damaged: its rims in parameters do not lie in the planes that its rims in the model close,
/// and a plane keeps a rim that lies in it.
#[test]
fn a_plane_is_not_sewn_to_a_rim_beside_it() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/iges_opencascade/cylinder_faces.igs");
    let whole = std::fs::read_to_string(path).expect("a fixture");
    let farthest_off = |text: &str| {
        let file = IgesFile::parse(text.as_bytes()).expect("a file");
        let model = import_iges(&file).expect("a model");
        let part = &model.parts[0];
        let mut off: f64 = 0.0;
        for face in &part.faces {
            let FaceGeometry::Surface(surface) = &face.geometry else { panic!("a surface") };
            let trimloop_geom::Surface::Plane { frame } = &**surface else { continue };
            for coedge in face.loops.iter().flat_map(|bound| &bound.coedges) {
                let edge = &part.edges[coedge.edge as usize];
                let at = |k: u32| edge.curve.point(edge.range.at(f64::from(k) / 16.0));
                off = (0..16).map(|k| (at(k) - frame.origin).dot(frame.z).abs()).fold(off, f64::max);
            }
        }
        off
    };
    assert!(farthest_off(&whole) < 1e-9);
    let generatrix = "110,10.,0.,-30.,10.,0.,0.;";
    assert!(whole.contains(generatrix));
    assert!(farthest_off(&whole.replace(generatrix, "110,12.,0.,-25.,12.,0.,-5.;")) < 1e-9);
}
