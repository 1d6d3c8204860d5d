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

/// Whether what follows the word `solid` is text with facets in it, or an end.
pub(super) fn looks_like_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(4096)];
    let text = String::from_utf8_lossy(start).to_ascii_lowercase();
    !start.contains(&0) && (text.contains("facet") || text.contains("endsolid"))
}

fn count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(80..HEADER)?.try_into().ok()?;
    Some(u32::from_le_bytes(count) as usize)
}

pub(super) fn read_binary(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let claimed = count(bytes).unwrap_or(0);
    let facets = bytes[HEADER.min(bytes.len())..].chunks_exact(FACET);
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
    Ok(millimetres("stl", triangles))
}

pub(super) fn read_text(bytes: &[u8]) -> Result<MeshFile, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut triangles = Triangles::default();
    let mut corners: Vec<DVec3> = Vec::new();
    let (mut ended, mut notes) = (false, Vec::new());
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_str() {
            "solid" => {
                let name = words.collect::<Vec<_>>().join(" ");
                let at = triangles.triangles.len();
                triangles.pieces.push(Piece { name, triangles: at..at });
            }
            "vertex" => {
                let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
                let [x, y, z] = numbers[..] else {
                    return Err(MeshError::unusable(format!(
                        "line {}: a vertex needs three numbers",
                        index + 1
                    )));
                };
                corners.push(DVec3::new(x, y, z));
            }
            "endloop" | "endfacet" if !corners.is_empty() => {
                let [a, b, c] = corners[..] else {
                    let line = index + 1;
                    return Err(MeshError::unusable(format!(
                        "line {line}: a facet has {} corners",
                        corners.len()
                    )));
                };
                push(&mut triangles, [a, b, c]);
                corners.clear();
            }
            "endsolid" => ended = true,
            _ => {}
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
