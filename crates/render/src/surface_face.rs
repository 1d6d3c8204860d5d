//! A face that is evaluated on the device: its shape, and what its level of detail depends on.

use std::sync::OnceLock;

use glam::{DVec2, DVec3};
use trimloop_geom::{Aabb, Direction, Surface};
use trimloop_gpu::{FaceShape, Places, Shape, TrimTable};
use trimloop_trim::TrimDomain;
use trimloop_trim::curves::Cubic;

/// A face that is evaluated on the device.
#[derive(Debug)]
pub struct SurfaceFace {
    /// Its surface over the box of its trim loops.
    pub shape: Shape,
    /// Its trim loops as polygons.
    pub domain: TrimDomain,
    /// Its trim loops as cubics, as exact as single precision can use.
    pub chains: Vec<Vec<Cubic>>,
    /// Its trim loops as the device reads them.
    pub table: TrimTable,
    /// Where, as shares of the domain along u and along v, the surface has kinks: grids have lines there.
    pub(crate) creases: [Vec<f64>; 2],
    pub(crate) bounds: Bounds,
    box_mm: Aabb,
    is_whole: bool,
    inside: OnceLock<Vec<DVec3>>,
}

/// How large, and how far from straight, a surface is over the whole of its domain. Millimetres; derivatives are with
/// respect to shares of the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Bounds {
    /// Largest lengths along u and along v.
    pub lengths: [f64; 2],
    /// Largest second derivatives by u, by u and v, by v.
    pub second: [f64; 3],
}

/// Samples of a span along each direction, and of all spans together.
const SAMPLES: usize = 5;
const MOST_SAMPLES: usize = 65;
/// Between samples, second derivatives exceed them by less than this share.
const BETWEEN: f64 = 1.15;
/// A larger turn of a first derivative at a knot, radians, is a kink.
const KINK_RAD: f64 = 1e-3;

impl SurfaceFace {
    pub(crate) fn new(face: FaceShape, chains: Vec<Vec<Cubic>>, table: TrimTable) -> Option<Self> {
        let FaceShape { shape, domain, .. } = face;
        let lines = [Direction::U, Direction::V].map(|d| breaks(&shape, d));
        let creases = [0, 1].map(|d| creases(&shape, d, &lines[d]));
        let (bounds, box_mm) = measure(&shape, &lines);
        let is_finite = bounds.second.iter().chain(&bounds.lengths).all(|x| x.is_finite());
        let is_whole = is_whole(&shape, &chains);
        is_finite.then(|| Self {
            shape,
            domain,
            chains,
            table,
            creases,
            bounds,
            box_mm,
            is_whole,
            inside: OnceLock::new(),
        })
    }

    /// A sphere around it.
    pub(crate) fn sphere(&self) -> (DVec3, f64) {
        let bulge = self.bounds.second.iter().sum::<f64>() / 16.0;
        (self.box_mm.center(), 0.5 * self.box_mm.diagonal() + bulge.min(0.1 * self.box_mm.diagonal()))
    }

    /// Whether the face is the whole of its domain: nothing is trimmed.
    pub(crate) fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// The surface.
    pub fn surface(&self) -> Option<&Surface> {
        self.shape.as_surface()
    }

    /// The parameters at shares of the domain.
    pub fn parameters(&self, share: DVec2) -> DVec2 {
        let [u, v] = self.shape.domain();
        DVec2::new(u.at(share.x), v.at(share.y))
    }

    /// Some points of the face.
    pub(crate) fn places_inside(&self) -> &[DVec3] {
        self.inside.get_or_init(|| {
            let Places::Grid { us, vs } = Places::even(&self.shape, 9, 9) else { return Vec::new() };
            let all = us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v)));
            let inside = all.filter(|uv| self.domain.contains(*uv));
            inside.map(|uv| self.shape.derivatives(uv).point).filter(|p| p.is_finite()).collect()
        })
    }
}

/// Whether the chains are one loop along the borders of the domain.
fn is_whole(shape: &Shape, chains: &[Vec<Cubic>]) -> bool {
    let [chain] = chains else { return false };
    let [u, v] = shape.domain();
    let share = |p: &DVec2| DVec2::new((p.x - u.start) / u.length(), (p.y - v.start) / v.length());
    let mut doubled_area = 0.0;
    for cubic in chain {
        let places = cubic.each_ref().map(share);
        let lies_on = |d: usize, at: f64| places.iter().all(|p| (p[d] - at).abs() < 1e-9);
        if ![0, 1].into_iter().any(|d| lies_on(d, 0.0) || lies_on(d, 1.0)) {
            return false;
        }
        doubled_area += places[0].perp_dot(places[3]);
    }
    (doubled_area.abs() - 2.0).abs() < 1e-6
}

/// Where the surface may not be smooth, as shares of the domain, ends included.
fn breaks(shape: &Shape, direction: Direction) -> Vec<f64> {
    let domain = shape.domain()[direction as usize];
    let inner = shape.as_surface().map_or_else(Vec::new, |s| s.breakpoints(direction, domain));
    let mut out: Vec<f64> = vec![0.0];
    let shares = inner.into_iter().map(|t| (t - domain.start) / domain.length());
    for share in shares.filter(|s| *s > 1e-7 && *s < 1.0 - 1e-7) {
        if share - out[out.len() - 1] > 1e-7 {
            out.push(share);
        }
    }
    out.push(1.0);
    out
}

/// The inner breaks at which the first derivative turns.
fn creases(shape: &Shape, d: usize, breaks: &[f64]) -> Vec<f64> {
    let domain = shape.domain();
    let derivative = |at: f64, across: f64| {
        let mut uv = DVec2::ZERO;
        uv[d] = domain[d].at(at);
        uv[1 - d] = domain[1 - d].at(across);
        let found = shape.derivatives(uv);
        if d == 0 { found.du } else { found.dv }
    };
    let is_crease = |at: &&f64| {
        [0.13, 0.5, 0.87].into_iter().any(|across| {
            let (before, after) = (derivative(**at - 1e-9, across), derivative(**at + 1e-9, across));
            before.cross(after).length() > KINK_RAD * before.length() * after.length()
                || before.dot(after) < 0.0
        })
    };
    breaks[1..breaks.len() - 1].iter().filter(is_crease).copied().collect()
}

fn measure(shape: &Shape, breaks: &[Vec<f64>; 2]) -> (Bounds, Aabb) {
    let domain = shape.domain();
    let lines = [0, 1].map(|d| {
        let spans = breaks[d].len() - 1;
        let each = (MOST_SAMPLES / spans).clamp(2, SAMPLES);
        let mut out: Vec<f64> = Vec::new();
        for pair in breaks[d].windows(2) {
            // Just inside the span, where derivatives are those of the span.
            let at = |k: usize| {
                let share = (k as f64 / (each - 1) as f64).clamp(1e-6, 1.0 - 1e-6);
                domain[d].at(pair[0] + (pair[1] - pair[0]) * share)
            };
            out.extend((0..each).map(at));
        }
        out
    });
    let found = shape.derivatives_grid(&lines[0], &lines[1]);
    let columns = lines[1].len();
    let scale = [domain[0].length(), domain[1].length()];
    let mut bounds = Bounds::default();
    for d in &found {
        let own = [d.duu * scale[0] * scale[0], d.duv * scale[0] * scale[1], d.dvv * scale[1] * scale[1]];
        for (most, own) in bounds.second.iter_mut().zip(own) {
            *most = most.max(own.length() * BETWEEN);
        }
    }
    let point = |i: usize, j: usize| found[i * columns + j].point;
    for j in 0..columns {
        let along: f64 = (1..lines[0].len()).map(|i| point(i - 1, j).distance(point(i, j))).sum();
        bounds.lengths[0] = bounds.lengths[0].max(along);
    }
    for i in 0..lines[0].len() {
        let along: f64 = (1..columns).map(|j| point(i, j - 1).distance(point(i, j))).sum();
        bounds.lengths[1] = bounds.lengths[1].max(along);
    }
    (bounds, Aabb::from_points(found.iter().map(|d| d.point).filter(|p| p.is_finite())))
}
