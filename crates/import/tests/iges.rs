//! IGES files: loose trimmed faces become a closed body.

use trimloop_brep::{BodyKind, EntityRef, FaceGeometry, Severity};
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
        let two = format!("{kind:>8}{:>8}{color:>8}{count:>8}{:>8}", 0, 0);
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
    let corner = |k: usize| [(k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64];
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    for (side, color) in sides.into_iter().zip(colors) {
        patch(&mut deck, side.map(corner), color);
    }
    deck
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
