//! How fine a face's grid must be, and what it consists of.

use glam::DVec2;
use trimloop_gpu::{Cover, Wavelet};

use crate::surface_face::{Bounds, Spans, SurfaceFace};

/// A grid over a face's domain: lines along u and along v, as shares of the domain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Grid {
    pub lines: [Vec<f64>; 2],
}

/// What is drawn over vertices: cells of a grid (row-major, rows running over u), each by its lowest vertex, or triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Cells {
    /// Vertices along v; 0 where each three numbers are a triangle.
    pub columns: u32,
    /// Cells that are inside the face.
    pub whole: Vec<u32>,
    /// Cells that trim curves pass through.
    pub part: Vec<u32>,
}

/// Most cells along a direction.
pub(crate) const MOST_CELLS: usize = 512;
/// A cell is at most this many times as long as the surface may be off.
pub(crate) const LONGEST: f64 = 1000.0;

impl Grid {
    /// A grid whose triangles are within `off_mm` of the surface, and whose interpolated parameters belong to points
    /// within `off_mm` of theirs.
    pub fn new(face: &SurfaceFace, off_mm: f64) -> Self {
        Self { lines: lines(&face.bounds, off_mm) }
    }

    /// An even grid by size, distance and bend (Krishnamurthy et al. 2009, section 6.1), which knows nothing of spans.
    pub fn even(face: &SurfaceFace, off_mm: f64) -> Self {
        let bounds = &face.bounds;
        let lines = [0, 1].map(|d| {
            let most = bounds.along[d].second.iter().copied().fold(0.0, f64::max);
            let by_length = bounds.lengths[d] / (LONGEST * off_mm);
            let cells = (most / (8.0 * off_mm)).sqrt().max(by_length).ceil();
            let cells = (cells as usize).clamp(1, MOST_CELLS);
            (0..=cells).map(|k| k as f64 / cells as f64).collect()
        });
        Self { lines }
    }

    /// Doublings of each direction that make an even grid fine enough.
    pub fn doublings(face: &SurfaceFace, off_mm: f64) -> [u32; 2] {
        Self::even(face, off_mm).lines.map(|lines| (lines.len() - 1).next_power_of_two().trailing_zeros())
    }

    /// A level of a pyramid whose finest level has 2^doublings cells: what is left after `steps` down.
    pub fn level(wavelet: Wavelet, doublings: [u32; 2], steps: u32) -> Self {
        let line = |n: u32| -> Vec<f64> {
            let cells = 1u32 << (n - steps);
            let at = |k: u32| f64::from(k) / f64::from(cells);
            match wavelet {
                Wavelet::Lifting => (0..=cells).map(at).collect(),
                // 2^n points from border to border, and the middles of ever more of them.
                Wavelet::Haar => {
                    let (whole, each) = (f64::from((1u32 << n) - 1), f64::from(1u32 << steps));
                    (0..cells).map(|k| (f64::from(k) * each + 0.5 * (each - 1.0)) / whole).collect()
                }
            }
        };
        Self { lines: doublings.map(line) }
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.lines[0].len() * self.lines[1].len()
    }

    /// The cells that hold some of the face.
    pub fn cells(&self, face: &SurfaceFace) -> Cells {
        let columns = self.lines[1].len() as u32;
        let mut out = Cells { columns, ..Cells::default() };
        let is_whole = face.is_whole();
        for (i, u) in (0u32..).zip(self.lines[0].windows(2)) {
            for (j, v) in (0u32..).zip(self.lines[1].windows(2)) {
                let [low, high] =
                    [DVec2::new(u[0], v[0]), DVec2::new(u[1], v[1])].map(|s| face.parameters(s));
                let cover = if is_whole { Cover::Whole } else { face.table.cover(low, high) };
                match cover {
                    Cover::None => {}
                    Cover::Whole => out.whole.push(i * columns + j),
                    Cover::Part => out.part.push(i * columns + j),
                }
            }
        }
        out
    }
}

/// Cells along each direction, roughly, for triangles within `off_mm`.
pub(crate) fn cells(bounds: &Bounds, off_mm: f64) -> [f64; 2] {
    [0, 1].map(|d| {
        let own = &bounds.along[d];
        let spans = own.ends.windows(2).zip(&own.second);
        let by_bend: f64 = spans.map(|(e, s)| (e[1] - e[0]) * (s / (8.0 * off_mm)).sqrt()).sum();
        by_bend.max(bounds.lengths[d] / (LONGEST * off_mm))
    })
}

/// Lines so that bilinear cells, cut into triangles, are within `off_mm`: an eighth of the second derivatives times the
/// squared steps (Piegl & Tiller 5.4; Filip, Magedson, Markot 1986), span by span.
fn lines(bounds: &Bounds, off_mm: f64) -> [Vec<f64>; 2] {
    let densities = [0, 1].map(|d| -> Vec<f64> {
        let own = &bounds.along[d];
        let by_length = bounds.lengths[d] / (LONGEST * off_mm);
        // From crease to crease there is one cell at least.
        let density = |(k, second): (usize, &f64)| {
            (second / (8.0 * off_mm)).sqrt().max(by_length).max(1.0 / run_length(own, k))
        };
        own.second.iter().enumerate().map(density).collect()
    });
    // Both directions use up the whole of what is allowed, and a twist comes on top.
    let step = |d: usize, k: usize| 1.0 / densities[d][k];
    let mut most: f64 = 1.0;
    for i in 0..densities[0].len() {
        for j in 0..densities[1].len() {
            let (h, k) = (step(0, i), step(1, j));
            let [u, v] = &bounds.along;
            let mixed = u.mixed[i].min(v.mixed[j]);
            let off = (u.second[i] * h * h + 2.0 * mixed * h * k + v.second[j] * k * k) / 8.0;
            most = most.max(off / off_mm);
        }
    }
    let scale = most.sqrt();
    [0, 1].map(|d| spread(&bounds.along[d], &densities[d], scale))
}

/// The distance between the creases around a span.
fn run_length(own: &Spans, span: usize) -> f64 {
    let low = (0..span).rev().find(|&k| own.is_crease[k]).map_or(0.0, |k| own.ends[k + 1]);
    let high = (span..own.is_crease.len()).find(|&k| own.is_crease[k]).map_or(1.0, |k| own.ends[k + 1]);
    high - low
}

/// Lines at equal steps of the densities (cells per unit), and where they change much or the surface has a kink.
fn spread(own: &Spans, densities: &[f64], scale: f64) -> Vec<f64> {
    let is_stop = |k: usize| {
        let (a, b) = (densities[k], densities[k + 1]);
        own.is_crease[k] || a.max(b) > 2.0 * a.min(b)
    };
    let whole: f64 = own.ends.windows(2).zip(densities).map(|(e, d)| (e[1] - e[0]) * d * scale).sum();
    let scale = scale * (MOST_CELLS as f64 / whole).min(1.0);
    let mut out = vec![0.0];
    let mut first = 0;
    for last in 0..densities.len() {
        if last + 1 < densities.len() && !is_stop(last) {
            continue;
        }
        let spans = first..=last;
        let amount = |k: usize| (own.ends[k + 1] - own.ends[k]) * densities[k] * scale;
        let total: f64 = spans.clone().map(amount).sum();
        let cells = (total - 1e-9).ceil().max(1.0);
        let (mut done, mut k) = (0.0, first);
        for cell in 1..cells as usize {
            let wanted = total * cell as f64 / cells;
            while k < last && done + amount(k) < wanted {
                done += amount(k);
                k += 1;
            }
            out.push(own.ends[k] + (wanted - done) / (densities[k] * scale));
        }
        out.push(own.ends[last + 1]);
        first = last + 1;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spans(ends: &[f64], second: &[f64], mixed: f64, creases: &[bool]) -> Spans {
        Spans {
            ends: ends.to_vec(),
            second: second.to_vec(),
            mixed: vec![mixed; second.len()],
            is_crease: creases.to_vec(),
        }
    }

    #[test]
    fn a_twist_needs_cells_too() {
        let flat = spans(&[0.0, 1.0], &[0.0], 8.0, &[]);
        let bounds = Bounds { lengths: [1.0; 2], along: [flat.clone(), flat] };
        let [u, v] = lines(&bounds, 0.02).map(|lines| (lines.len() - 1) as f64);
        assert!(2.0 * 8.0 / (8.0 * u * v) <= 0.02);
        let flat = spans(&[0.0, 1.0], &[0.0], 0.0, &[]);
        let bounds = Bounds { lengths: [1.0; 2], along: [flat.clone(), flat] };
        assert_eq!(lines(&bounds, 0.1), [vec![0.0, 1.0], vec![0.0, 1.0]]);
    }

    #[test]
    fn lines_stand_where_the_surface_bends() {
        let own = spans(&[0.0, 0.5, 0.75, 1.0], &[0.0; 3], 0.0, &[false, false]);
        assert_eq!(spread(&own, &[2.0, 2.0, 2.0], 1.0), [0.0, 0.5, 1.0]);
        assert_eq!(spread(&own, &[1.0, 8.0, 8.0], 1.0), [0.0, 0.5, 0.625, 0.75, 0.875, 1.0]);
        let kinked = Spans { is_crease: vec![false, true], ..own };
        assert_eq!(spread(&kinked, &[1.0, 1.0, 1.0], 1.0), [0.0, 0.75, 1.0]);
    }
}
