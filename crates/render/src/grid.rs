//! How fine a face's grid must be, and what it consists of.

use glam::DVec2;
use trimloop_gpu::Cover;

use crate::surface_face::{Bounds, SurfaceFace};

/// A grid over a face's domain: lines along u and along v, as shares of the domain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    pub lines: [Vec<f64>; 2],
}

/// Triangles over a grid's vertices (row-major, rows running over u).
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Triangulated {
    /// Cells that are inside the face: three indices per triangle.
    pub whole: Vec<u32>,
    /// Cells that trim curves pass through.
    pub part: Vec<u32>,
}

/// Most cells along a direction.
pub(crate) const MOST_CELLS: usize = 512;
/// A cell is at most this many times as long as the surface may be off.
const LONGEST: f64 = 400.0;

impl Grid {
    /// A grid whose triangles are within `off_mm` of the surface, and whose interpolated parameters belong to points
    /// within `off_mm` of theirs.
    pub fn new(face: &SurfaceFace, off_mm: f64) -> Self {
        let cells = cells(&face.bounds, off_mm);
        Self { lines: [0, 1].map(|d| lines(&face.creases[d], cells[d])) }
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.lines[0].len() * self.lines[1].len()
    }

    /// The cells that hold some of the face.
    pub fn triangulate(&self, face: &SurfaceFace) -> Triangulated {
        let mut out = Triangulated::default();
        let columns = self.lines[1].len() as u32;
        let is_whole = face.is_whole();
        for (i, u) in (0u32..).zip(self.lines[0].windows(2)) {
            for (j, v) in (0u32..).zip(self.lines[1].windows(2)) {
                let [low, high] =
                    [DVec2::new(u[0], v[0]), DVec2::new(u[1], v[1])].map(|s| face.parameters(s));
                let cover = if is_whole { Cover::Whole } else { face.table.cover(low, high) };
                let list = match cover {
                    Cover::None => continue,
                    Cover::Whole => &mut out.whole,
                    Cover::Part => &mut out.part,
                };
                let a = i * columns + j;
                list.extend([a, a + columns, a + columns + 1, a, a + columns + 1, a + 1]);
            }
        }
        out
    }
}

/// Cells along u and along v so that bilinear patches, cut into triangles, are within `off_mm`: an eighth of the second
/// derivatives times the squared steps (Piegl & Tiller 5.4; Filip, Magedson, Markot 1986).
fn cells(bounds: &Bounds, off_mm: f64) -> [usize; 2] {
    let [uu, uv, vv] = bounds.second;
    let mut n = [uu, vv].map(|second| (second / (8.0 * off_mm)).sqrt().max(1.0));
    let off = |n: [f64; 2]| (uu / (n[0] * n[0]) + 2.0 * uv / (n[0] * n[1]) + vv / (n[1] * n[1])) / 8.0;
    let excess = off(n) / off_mm;
    if excess > 1.0 {
        n = n.map(|n| n * excess.sqrt());
    }
    [0, 1].map(|d| {
        let by_length = bounds.lengths[d] / (LONGEST * off_mm);
        (n[d].max(by_length).ceil() as usize).clamp(1, MOST_CELLS)
    })
}

/// Even lines between the creases, `cells` in all or a few more.
fn lines(creases: &[f64], cells: usize) -> Vec<f64> {
    let mut ends = vec![0.0];
    ends.extend_from_slice(creases);
    ends.push(1.0);
    let mut out = vec![0.0];
    for pair in ends.windows(2) {
        let length = pair[1] - pair[0];
        let count = ((length * cells as f64) - 1e-9).ceil().max(1.0) as usize;
        out.extend((1..count).map(|k| pair[0] + length * k as f64 / count as f64));
        out.push(pair[1]);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_twist_needs_cells_too() {
        let bounds = Bounds { lengths: [1.0; 2], second: [0.0, 8.0, 0.0] };
        let [u, v] = cells(&bounds, 0.02);
        assert!(2.0 * 8.0 / (8.0 * (u * v) as f64) <= 0.02);
        assert_eq!(cells(&Bounds { lengths: [1.0; 2], second: [0.0; 3] }, 0.1), [1, 1]);
    }

    #[test]
    fn creases_are_lines() {
        assert_eq!(lines(&[0.5], 1), [0.0, 0.5, 1.0]);
        assert_eq!(lines(&[], 4), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(lines(&[0.25], 4), [0.0, 0.25, 0.5, 0.75, 1.0]);
    }
}
