//! Reports that open in any browser: one file, pictures inside, nothing fetched from anywhere.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use tiny_skia::Pixmap;

use crate::comparison::{Comparison, FaceDistances, Side};
use crate::distance::Target;
use crate::picture::{View, heat, heat_map, shaded};
use crate::shape::Shape;
use crate::verdict::{Judgement, Verdict};

/// A picture with its caption.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What it shows.
    pub caption: String,
    /// PNG, base64.
    png: String,
}

/// How many pictures a comparison gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// One view, small: nothing is wrong.
    Brief,
    /// From both sides.
    Full,
}

/// Both shapes from the same views, and each in the colours of its distance to the other; `most_mm` is the end of the
/// scale.
pub fn pictures(a: &Shape, b: &Shape, most_mm: f64, detail: Detail) -> Vec<Picture> {
    let bounds = a.triangles.bounds().union(b.triangles.bounds());
    let (width, height) = if detail == Detail::Full { (400, 320) } else { (240, 190) };
    let views = View::pair(bounds, width, height);
    let views = if detail == Detail::Full { &views[..] } else { &views[..1] };
    let targets = [Target::new(a), Target::new(b)];
    let mut out = Vec::new();
    for (k, view) in views.iter().enumerate() {
        let side = if k == 0 { "" } else { ", from the other side" };
        let mut add = |caption: String, pixmap: Option<Pixmap>| {
            if let Some(png) = pixmap.and_then(|pixmap| pixmap.encode_png().ok()) {
                out.push(Picture { caption, png: STANDARD.encode(png) });
            }
        };
        add(format!("A{side}"), shaded(a, view, [120, 150, 190]));
        add(format!("B{side}"), shaded(b, view, [170, 170, 165]));
        add(format!("A, distance to B{side}"), heat_map(a, &targets[1], view, most_mm));
        add(format!("B, distance to A{side}"), heat_map(b, &targets[0], view, most_mm));
    }
    out
}

/// Text that is safe between tags and in attributes.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A whole page.
pub fn page(title: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width\">\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{body}\n\
         <footer>Made by trimloop {}</footer>\n</body>\n</html>\n",
        env!("CARGO_PKG_VERSION")
    )
}

const STYLE: &str = "
:root{color-scheme:light dark;--line:#8884;--soft:#8881}
body{font:15px/1.45 system-ui,sans-serif;max-width:1180px;margin:1.5rem auto;padding:0 1rem}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin:2rem 0 .5rem;border-top:1px solid var(--line);padding-top:1rem}
table{border-collapse:collapse;margin:.5rem 0}th,td{padding:.2rem .6rem;text-align:left;border-bottom:1px solid var(--line)}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}
.badge{display:inline-block;padding:.05rem .5rem;border-radius:.6rem;color:#fff;font-size:.85rem}
.good{background:#2a8a4a}.bad{background:#b8322a}.odd{background:#b07a10}.known{background:#5a6a8a}
figure{display:inline-block;margin:.3rem;vertical-align:top}figure img{background:#f4f4f2;border:1px solid var(--line);display:block}
figcaption{font-size:.8rem;opacity:.8}
.scale{display:inline-block;width:240px;height:12px;vertical-align:middle;margin:0 .5rem}
.miss{color:#c33}footer{margin:3rem 0 1rem;font-size:.8rem;opacity:.7}code{background:var(--soft);padding:0 .2rem}
";

/// The mark of a verdict.
pub fn badge(verdict: Verdict) -> String {
    let class = match verdict {
        Verdict::Same => "good",
        Verdict::Different => "bad",
        Verdict::ReferenceSuspect => "odd",
    };
    format!("<span class=\"badge {class}\">{}</span>", verdict.as_str())
}

/// Figures and pictures of a comparison.
pub fn comparison(found: &Comparison, judgement: &Judgement, pictures: &[Picture], most_mm: f64) -> String {
    let mut out = String::new();
    let mut put = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    if !judgement.reasons.is_empty() {
        let items = judgement.reasons.iter().map(|reason| format!("<li>{}</li>", escape(reason)));
        put(format!("<ul>{}</ul>", items.collect::<String>()));
    }
    put(gates(judgement));
    put(distances(found));
    put(figures(&found.a, &found.b));
    put(faces(&found.faces, most_mm));
    if !pictures.is_empty() {
        put(format!(
            "<p>0 <span class=\"scale\" style=\"background:{}\"></span> {most_mm:.4} mm and more</p>",
            gradient()
        ));
        for Picture { caption, png } in pictures {
            let caption = escape(caption);
            put(format!(
                "<figure><img alt=\"{caption}\" src=\"data:image/png;base64,{png}\"><figcaption>{caption}</figcaption></figure>"
            ));
        }
    }
    out
}

fn gradient() -> String {
    let stops = (0..=8).map(|k| {
        let [r, g, b] = heat(f64::from(k) / 8.0);
        format!("rgb({r},{g},{b})")
    });
    format!("linear-gradient(90deg,{})", stops.collect::<Vec<_>>().join(","))
}

fn gates(judgement: &Judgement) -> String {
    let mut out =
        String::from("<table><tr><th>gate</th><th class=n>found</th><th class=n>allowed</th><th></th></tr>");
    for gate in &judgement.gates {
        let show = |value: f64| match gate.unit {
            "share" => format!("{:.4} %", value * 100.0),
            "mm" => format!("{value:.5} mm"),
            unit => format!("{value} {unit}"),
        };
        let mark = if gate.kept { "kept" } else { "<b class=miss>missed</b>" };
        let _ = write!(
            out,
            "<tr><td>{}</td><td class=n>{}</td><td class=n>{}</td><td>{mark}</td></tr>",
            gate.name,
            show(gate.found),
            show(gate.allowed)
        );
    }
    out + "</table>"
}

fn distances(found: &Comparison) -> String {
    let mut out = String::from(
        "<table><tr><th>distance, mm</th><th class=n>max</th><th class=n>99.9 %</th><th class=n>rms</th><th class=n>mean</th>\
         <th>largest at</th></tr>",
    );
    let rows =
        [("A to B", &found.a_to_b), ("B to A", &found.b_to_a), ("corners of B to A", &found.b_corners_to_a)];
    for (name, d) in rows {
        let [x, y, z] = d.at_mm;
        let _ = write!(
            out,
            "<tr><td>{name}</td><td class=n>{:.5}</td><td class=n>{:.5}</td><td class=n>{:.5}</td><td class=n>{:.5}</td>\
             <td class=n>{x:.2}, {y:.2}, {z:.2}</td></tr>",
            d.max_mm, d.p999_mm, d.rms_mm, d.mean_mm
        );
    }
    out + "</table>"
}

fn figures(a: &Side, b: &Side) -> String {
    let mut out =
        String::from("<table><tr><th></th><th class=n>A</th><th class=n>B</th><th class=n>B / A</th></tr>");
    for (name, a, b) in figure_rows(a, b) {
        let share = if a == b || a.is_nan() || b.is_nan() {
            "=".to_owned()
        } else if a != 0.0 {
            format!("{:+.4} %", (b / a - 1.0) * 100.0)
        } else {
            String::new()
        };
        let _ = write!(
            out,
            "<tr><td>{name}</td><td class=n>{}</td><td class=n>{}</td><td class=n>{share}</td></tr>",
            number(a),
            number(b)
        );
    }
    out + "</table>"
}

/// What both sides measure, row by row: name, A's, B's.
pub fn figure_rows(a: &Side, b: &Side) -> Vec<(&'static str, f64, f64)> {
    let count = |value: usize| value as f64;
    // What does not close has no inside.
    let inside = |side: &Side, value: f64| if side.topology.is_watertight() { value } else { f64::NAN };
    let (fa, fb, ta, tb) = (&a.figures, &b.figures, &a.topology, &b.topology);
    vec![
        ("area, mm²", fa.area_mm2, fb.area_mm2),
        ("volume, mm³", inside(a, fa.volume_mm3), inside(b, fb.volume_mm3)),
        ("moment 1, mm⁵", inside(a, fa.volume_moments_mm5[0]), inside(b, fb.volume_moments_mm5[0])),
        ("moment 2, mm⁵", inside(a, fa.volume_moments_mm5[1]), inside(b, fb.volume_moments_mm5[1])),
        ("moment 3, mm⁵", inside(a, fa.volume_moments_mm5[2]), inside(b, fb.volume_moments_mm5[2])),
        ("triangles", count(ta.triangles), count(tb.triangles)),
        ("components", count(ta.components), count(tb.components)),
        ("closed components", count(ta.closed_components), count(tb.closed_components)),
        ("tunnels", count(ta.genus), count(tb.genus)),
        ("open edges", count(ta.open_edges), count(tb.open_edges)),
        ("holes", count(ta.holes), count(tb.holes)),
        ("non-manifold edges", count(ta.non_manifold_edges), count(tb.non_manifold_edges)),
        ("flipped edges", count(ta.flipped_edges), count(tb.flipped_edges)),
        ("folded edges", count(ta.folded_edges), count(tb.folded_edges)),
        ("degenerate triangles", count(ta.degenerate_triangles), count(tb.degenerate_triangles)),
    ]
}

/// A number as people like it: whole ones whole, others with six digits.
pub fn number(value: f64) -> String {
    if value.is_nan() {
        return "\u{2013}".to_owned();
    }
    if value.fract() == 0.0 && value.abs() < 1e9 {
        return format!("{value:.0}");
    }
    let digits = (5 - value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    if value.abs() >= 1e9 || value.abs() < 1e-4 {
        format!("{value:.5e}")
    } else {
        format!("{value:.digits$}")
    }
}

fn faces(faces: &[FaceDistances], most_mm: f64) -> String {
    let off = |face: &FaceDistances| face.distances.max_mm.max(face.back_max_mm);
    let mut worst: Vec<&FaceDistances> =
        faces.iter().filter(|f| off(f) > 0.25 * most_mm || f.turned > 0.5).collect();
    worst.sort_by(|a, b| off(b).total_cmp(&off(a)));
    if worst.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "<table><tr><th>faces farthest off</th><th>part</th><th class=n>area, mm²</th><th class=n>max, mm</th><th class=n>rms, mm</th>\
         <th class=n>covered</th></tr>",
    );
    for face in worst.iter().take(12) {
        let _ = write!(
            out,
            "<tr><td>{} ({})</td><td>{}</td><td class=n>{}</td><td class=n>{:.5}</td><td class=n>{:.5}</td><td class=n>{:.1} %</td></tr>",
            escape(&face.name),
            escape(&face.surface),
            escape(&face.part),
            number(face.area_mm2),
            off(face),
            face.distances.rms_mm,
            face.covered * 100.0
        );
    }
    out + "</table>"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_six_digits() {
        assert_eq!(number(12.0), "12");
        assert_eq!(number(1234.56789), "1234.57");
        assert_eq!(number(0.00123456789), "0.00123457");
        assert_eq!(number(-1.5e12), "-1.50000e12");
    }

    #[test]
    fn names_cannot_break_out_of_the_page() {
        assert!(!page("<script>", "").contains("<script>"));
    }
}
