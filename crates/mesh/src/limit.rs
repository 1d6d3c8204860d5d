//! How many points a face may take.

use trimloop_geom::{Direction, Interval, Surface};
use trimloop_trim::TrimDomain;

/// The most sites of a face, by what its surface can ask for.
///
/// A polynomial that stays about where the part is bends by no more than a multiple of the part's size over each of its
/// spans, and turns a few times at most; a direction then asks for steps in proportion to the root of the size in
/// deflections, or to the turn in angular deflections. Surfaces that ask for more have control points far from
/// everything else, as in damaged files: the work for them is bounded by the length of the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SiteLimit {
    /// No face has more, whatever its surface.
    pub most: usize,
    /// The part's size, in linear deflections.
    pub size_in_deflections: f64,
    /// A whole turn, in angular deflections.
    pub turn_in_deflections: f64,
}

/// Sites for each span of a surface that its bends and its turns may ask for, in squares of the steps that a bend by the
/// part's size or a whole turn asks for. (Half a sphere as large as the part asks for 1.2 and 0.5.)
const BENDS: f64 = 8.0;
const TURNS: f64 = 8.0;

/// Sites that any face may have.
const LEAST: f64 = 50_000.0;

/// Sites for each corner of the boundary.
const PER_CORNER: f64 = 16.0;

impl SiteLimit {
    /// The most sites for a surface over a domain.
    pub fn of(&self, surface: &Surface, domain: &TrimDomain) -> usize {
        let (low, high) = domain.uv_bounds();
        let spans = |direction, start: f64, end: f64| {
            let range = Interval::new(start, end);
            surface.breakpoints(direction, range).len().saturating_sub(1).max(1) as f64
        };
        let spans = spans(Direction::U, low.x, high.x) * spans(Direction::V, low.y, high.y);
        let corners: usize = domain.loops.iter().map(|l| l.vertices.len()).sum();
        let per_span = BENDS * self.size_in_deflections + TURNS * self.turn_in_deflections.powi(2);
        let sites = LEAST + spans * per_span + corners as f64 * PER_CORNER;
        (sites as usize).min(self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};
    use trimloop_geom::NurbsSurface;
    use trimloop_trim::{TrimLoop, TrimVertex};

    #[test]
    fn faces_may_have_as_many_sites_as_their_surfaces_have_spans() {
        let limit = SiteLimit { most: 1_000_000, size_in_deflections: 1000.0, turn_in_deflections: 18.0 };
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array);
        let vertices = corners.iter().zip(0..).map(|(&uv, point)| TrimVertex { uv, point }).collect();
        let loops = vec![TrimLoop { vertices, turned: false }];
        let domain = TrimDomain { loops, own_points: Vec::new(), own_base: 4, diagnostics: Vec::new() };
        let sites = |spans: usize| {
            let at = |k: usize| DVec3::new((k % (spans + 1)) as f64, (k / (spans + 1)) as f64, 0.0);
            let points = (0..(spans + 1).pow(2)).map(at).collect();
            let ends = std::iter::once(0).chain(0..=spans).chain([spans]);
            let knots: Vec<f64> = ends.map(|k| k as f64 / spans as f64).collect();
            let both = [knots.clone(), knots];
            let sheet = NurbsSurface::new([1, 1], spans + 1, spans + 1, points, Vec::new(), both);
            limit.of(&Surface::Nurbs(sheet.expect("a sheet")), &domain)
        };
        let per_span = 8000 + 8 * 18 * 18;
        assert_eq!([1, 2, 5].map(sites), [1, 4, 25].map(|spans| 50_064 + spans * per_span));
        assert_eq!(sites(100), limit.most);
    }
}
