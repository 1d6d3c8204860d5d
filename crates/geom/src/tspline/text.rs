//! T-meshes as text.
//!
//! ```text
//! tspline 1
//! u 0 0 0 0 1 2 2 2 2          knots of the lines of constant u
//! v 0 0 0 0 1 1 1 1            knots of the lines of constant v
//! p 2 2  0.0 0.0 0.0  1.0      a vertex: its lines, x y z in millimetres, its weight (1 where it is left out)
//! e 2 2  3 2                   an edge: the lines of its ends (without any, neighbours on a line are joined)
//! ```
//!
//! `#` starts a comment. Lines are numbered from 0; see [`TMesh`] for which of them vertices stand on.

use std::fmt::Write;

use glam::DVec3;

use super::{MeshEdge, MeshVertex, TMesh, TSpline, TSplineError};

/// Why a text is no T-spline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TextError {
    /// A line makes no sense.
    #[error("line {line}: {wanted}")]
    Line {
        /// Its number, from 1 on.
        line: usize,
        /// What ought to stand there.
        wanted: &'static str,
    },
    /// The mesh makes no sense.
    #[error(transparent)]
    Mesh(#[from] TSplineError),
}

impl TSpline {
    /// Whether a text begins as that of a T-spline does.
    pub fn looks_like(head: &[u8]) -> bool {
        head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start().starts_with(b"tspline ")
    }

    /// Reads a T-spline.
    ///
    /// # Errors
    /// What is wrong, with its line.
    pub fn parse(text: &str) -> Result<Self, TextError> {
        let mut mesh = TMesh::default();
        let mut has_begun = false;
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split('#').next().unwrap_or_default();
            let mut words = line.trim_start_matches('\u{feff}').split_whitespace();
            let Some(word) = words.next() else { continue };
            let wrong = |wanted| TextError::Line { line: number, wanted };
            let words: Vec<&str> = words.collect();
            if !has_begun {
                if word != "tspline" || words != ["1"] {
                    return Err(wrong("the text begins with `tspline 1`"));
                }
                has_begun = true;
                continue;
            }
            let numbers: Option<Vec<f64>> = words.iter().map(|word| word.parse().ok()).collect();
            let lines = |from: usize| -> Option<[usize; 2]> {
                Some([words.get(from)?.parse().ok()?, words.get(from + 1)?.parse().ok()?])
            };
            match word {
                "u" | "v" => {
                    let knots = &mut mesh.knots[usize::from(word == "v")];
                    knots.extend(numbers.ok_or_else(|| wrong("knots are numbers"))?);
                }
                "p" => {
                    let wanted = "a vertex is two lines, x y z, and a weight: `p 2 2  0.0 0.0 0.0  1.0`";
                    let (Some(lines), Some(n)) = (lines(0), numbers) else { return Err(wrong(wanted)) };
                    let (5 | 6) = n.len() else { return Err(wrong(wanted)) };
                    let weight = n.get(5).copied().unwrap_or(1.0);
                    mesh.vertices.push(MeshVertex { lines, position: DVec3::new(n[2], n[3], n[4]), weight });
                }
                "e" => {
                    let wanted = "an edge is the lines of both its ends: `e 2 2  3 2`";
                    let (Some(from), Some(to), 4) = (lines(0), lines(2), words.len()) else {
                        return Err(wrong(wanted));
                    };
                    mesh.edges.push(MeshEdge { from, to });
                }
                _ => return Err(wrong("a line begins with u, v, p, e or #")),
            }
        }
        if !has_begun {
            return Err(TextError::Line { line: 1, wanted: "the text begins with `tspline 1`" });
        }
        Ok(Self::new(mesh)?)
    }

    /// The text that [`TSpline::parse`] reads, number for number.
    pub fn to_text(&self) -> String {
        let mut out = "tspline 1\n".to_owned();
        // Writing to a string cannot fail.
        for (name, knots) in ['u', 'v'].into_iter().zip(&self.mesh().knots) {
            let _ =
                writeln!(out, "{name} {}", knots.iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
        }
        for MeshVertex { lines: [i, j], position, weight } in &self.mesh().vertices {
            let _ = writeln!(out, "p {i} {j}  {} {} {}  {weight}", position.x, position.y, position.z);
        }
        for MeshEdge { from, to } in &self.mesh().edges {
            let _ = writeln!(out, "e {} {}  {} {}", from[0], from[1], to[0], to[1]);
        }
        out
    }
}
