//! STL: triangles and nothing else, as text or binary (little-endian).

use glam::DVec3;

use super::{MeshError, MeshFile, millimetres};
use crate::triangles::{Piece, Triangles};

/// Header and count; then 50 bytes a triangle: normal, three corners, two bytes that some use for colours.
const HEADER: usize = 84;
const FACET: usize = 50;

/// Whether a file is as long as its count of triangles says; a few bytes more are forgiven.
pub(super) fn has_length_of_binary(bytes: &[u8]) -> bool {
    let Some(count) = count(bytes) else { return false };
    let wanted = count.saturating_mul(FACET).saturating_add(HEADER);
    bytes.len() >= wanted && bytes.len() - wanted < FACET && !(count == 0 && looks_like_text(bytes))
}

/// Whether a file is text with facets in it, or at least says that it is a solid and ends.
pub(super) fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 16)];
    let text = String::from_utf8_lossy(start).to_ascii_lowercase();
    let words = |wanted: &str| text.split_ascii_whitespace().any(|word| word == wanted);
    !start.contains(&0) && (words("facet") && words("vertex") || words("solid") && words("endsolid"))
}

fn count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?.try_into().ok()?;
    Some(u32::from_le_bytes(count) as usize)
}

pub(super) fn read_binary(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let mut claimed = count(bytes).unwrap_or(0);
    let facets = bytes[HEADER.min(bytes.len())..].chunks_exact(FACET);
    let mut notes = Vec::new();
    if facets.len() > claimed && facets.remainder().is_empty() {
        notes.push(format!("The file claims {claimed} triangles and holds {}: all are read.", facets.len()));
        claimed = facets.len();
    }
    if facets.len() < claimed {
        return Err(MeshError::unusable(format!(
            "it claims {claimed} triangles and has bytes for {} of them only",
            facets.len()
        )));
    }
    let mut triangles = Triangles::default();
    for facet in facets.take(claimed) {
        let number = |at: usize| {
            f64::from(f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]))
        };
        let corner = |at: usize| DVec3::new(number(at), number(at + 4), number(at + 8));
        push(&mut triangles, [corner(12), corner(24), corner(36)]);
    }
    triangles.pieces = vec![Piece { name: String::new(), triangles: 0..claimed }];
    Ok(MeshFile { notes, ..millimetres("stl", triangles) })
}

/// Words and numbers; how they are spread over lines does not matter.
pub(super) fn read_text(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let line_of = |word: &str| {
        let before = &text.as_bytes()[..word.as_ptr() as usize - text.as_ptr() as usize];
        let ends = before.iter().filter(|b| **b == b'\n').count();
        1 + if ends > 0 { ends } else { before.iter().filter(|b| **b == b'\r').count() }
    };
    let mut triangles = Triangles::default();
    let mut corners: Vec<DVec3> = Vec::new();
    let (mut ended, mut notes) = (false, Vec::new());
    let mut words = text.split_ascii_whitespace().peekable();
    while let Some(word) = words.next() {
        let is = |name: &str| word.eq_ignore_ascii_case(name);
        if is("solid") || is("endsolid") {
            ended = is("endsolid");
            let goes_on =
                |word: &&str| !["facet", "solid", "endsolid"].iter().any(|w| w.eq_ignore_ascii_case(word));
            let name: Vec<&str> = std::iter::from_fn(|| words.next_if(goes_on)).collect();
            if !ended {
                let at = triangles.triangles.len();
                triangles.pieces.push(Piece { name: name.join(" "), triangles: at..at });
            }
        } else if is("vertex") {
            let mut number = || words.next().and_then(|word| word.parse::<f64>().ok());
            let (Some(x), Some(y), Some(z)) = (number(), number(), number()) else {
                return Err(MeshError::unusable(format!(
                    "line {}: a vertex needs three numbers",
                    line_of(word)
                )));
            };
            corners.push(DVec3::new(x, y, z));
        } else if (is("endloop") || is("endfacet")) && !corners.is_empty() {
            let [a, b, c] = corners[..] else {
                let (line, count) = (line_of(word), corners.len());
                return Err(MeshError::unusable(format!("line {line}: a facet has {count} corners")));
            };
            push(&mut triangles, [a, b, c]);
            corners.clear();
        }
        let end = triangles.triangles.len();
        if let Some(piece) = triangles.pieces.last_mut() {
            piece.triangles.end = end;
        }
    }
    if !ended || !corners.is_empty() {
        notes.push("The file ends in the middle: `endsolid` is missing.".to_owned());
    }
    Ok(MeshFile { notes, ..millimetres("stl", triangles) })
}

fn push(triangles: &mut Triangles, corners: [DVec3; 3]) {
    let first = triangles.points.len() as u32;
    triangles.points.extend(corners);
    triangles.triangles.push([first, first + 1, first + 2]);
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str =
        "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet";

    #[test]
    fn lines_do_not_matter() {
        for between in [" ", "\n", "\r\n", "\r", "\t"] {
            let text = format!("solid a part {FACET} endsolid a part").replace(' ', between);
            let file = read_text(text.as_bytes()).expect("a mesh");
            assert_eq!((file.triangles.triangles.len(), file.notes.len()), (1, 0), "{between:?}");
            assert!(looks_like_text(text.as_bytes()));
        }
        assert_eq!(read_text(format!("solid a {FACET}").as_bytes()).expect("a mesh").notes.len(), 1);
    }

    #[test]
    fn mistakes_name_their_line() {
        let text = format!("solid\n{FACET}\nfacet\nouter loop\nvertex 1 2\nendloop");
        let error = read_text(text.as_bytes()).expect_err("two numbers").to_string();
        assert!(error.contains("line 5"), "{error}");
    }

    #[test]
    fn the_length_tells_binary_from_text() {
        let mut binary = b"solid facet vertex".to_vec();
        binary.resize(80, b' ');
        binary.extend(1u32.to_le_bytes());
        binary.resize(134, 1);
        assert!(has_length_of_binary(&binary));
        assert!(!has_length_of_binary(&binary[..120]));
    }
}
