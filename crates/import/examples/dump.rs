//! Temporary.
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let m = trimloop_import::read(a[1].as_ref(), &Default::default()).unwrap();
    for p in &m.parts {
        for f in &p.faces {
            if a.len() > 2 && f.entity.to_string() != a[2] { continue; }
            println!("{} {:?}", f.entity, match &f.geometry { trimloop_brep::FaceGeometry::Surface(s) => s.kind(), _ => "?" });
            for l in &f.loops { println!(" loop outer {}", l.outer); for c in &l.coedges { let e = &p.edges[c.edge as usize]; println!("  e{} rev {} v{}->v{} {} {:?} {} -> {}", c.edge, c.reversed, e.start, e.end, e.curve.kind(), e.range, e.curve.point(e.range.start), e.curve.point(e.range.end)); } }
        }
    }
}
