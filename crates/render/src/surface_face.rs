//! A face that is evaluated on the device: its shape, and what its level of detail depends on.

use std::sync::{Arc, OnceLock};

use glam::{DVec2, DVec3};
use trimloop_geom::{Aabb, Direction, Interval, Surface};
use trimloop_gpu::{Cover, FaceShape, Places, Shape, TrimTable};
use trimloop_trim::TrimDomain;
use trimloop_trim::curves::Cubic;

use crate::grid::cells;
use crate::hierarchy::Hierarchy;
use crate::skirt::Skirt;

/// A face that is evaluated on the device.
#[derive(Debug)]
pub struct SurfaceFace {
    /// Its surface over the box of its trim loops.
    pub shape: Shape,
    /// The whole face's trim loops as polygons.
    pub domain: Arc<TrimDomain>,
    /// Its trim loops as cubics, as exact as single precision can use. Of a part of a face, what lies outside of the part
    /// is moved closer and straight.
    pub chains: Vec<Vec<Cubic>>,
    /// Its trim loops as the device reads them.
    pub table: TrimTable,
    pub(crate) bounds: Bounds,
    box_mm: Aabb,
    is_whole: bool,
    /// The corners of its domain, as shares of the whole face's.
    pub(crate) window: [DVec2; 2],
    halves: OnceLock<[Option<Box<SurfaceFace>>; 2]>,
    hierarchy: OnceLock<Option<Hierarchy>>,
    /// Where the boundary is away from its edges, and how far at most, millimetres.
    pub(crate) skirts: Arc<Vec<Skirt>>,
    pub(crate) gap_mm: f64,
}

/// How large, and how far from straight, a surface is. Millimetres; derivatives are with respect to shares of the domain.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Bounds {
    /// Largest lengths along u and along v.
    pub lengths: [f64; 2],
    /// Along u and along v.
    pub along: [Spans; 2],
}

/// What a surface does between the places of one direction where it may not be smooth.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Spans {
    /// Ends of spans, from 0 to 1.
    pub ends: Vec<f64>,
    /// Per span the largest second derivative in this direction.
    pub second: Vec<f64>,
    /// Per span the largest mixed derivative.
    pub mixed: Vec<f64>,
    /// Per inner end whether the surface has a kink there.
    pub is_crease: Vec<bool>,
}

/// Samples of a span; lines across on which they lie.
const SAMPLES: usize = 5;
const ACROSS: usize = 33;
/// Between samples, second derivatives exceed them by less than this share.
const BETWEEN: f64 = 1.15;
/// A larger turn of a first derivative at a knot, radians, is a kink.
const KINK_RAD: f64 = 1e-3;

impl SurfaceFace {
    pub(crate) fn new(face: FaceShape, chains: Vec<Vec<Cubic>>, table: TrimTable) -> Option<Self> {
        let FaceShape { shape, domain, .. } = face;
        let is_whole = is_whole(&shape, &chains);
        Self::of(shape, Arc::new(domain), chains, table, is_whole, [DVec2::ZERO, DVec2::ONE])
    }

    fn of(
        shape: Shape,
        domain: Arc<TrimDomain>,
        chains: Vec<Vec<Cubic>>,
        table: TrimTable,
        is_whole: bool,
        window: [DVec2; 2],
    ) -> Option<Self> {
        let lines = [Direction::U, Direction::V].map(|d| breaks(&shape, d));
        let (bounds, box_mm) = Bounds::of(&shape, &lines);
        let is_finite = bounds.is_finite() && box_mm.diagonal().is_finite();
        let (halves, hierarchy) = Default::default();
        is_finite.then(|| Self {
            shape,
            domain,
            chains,
            table,
            bounds,
            box_mm,
            is_whole,
            window,
            halves,
            hierarchy,
            skirts: Arc::default(),
            gap_mm: 0.0,
        })
    }

    /// Its two halves, as faces of their own with their own origins; `None` for one that holds nothing of the face.
    pub(crate) fn halves(&self) -> &[Option<Box<Self>>; 2] {
        self.halves.get_or_init(|| {
            let [u, v] = cells(&self.bounds, NOMINAL * self.shape.size());
            let d = usize::from(v > u);
            [0, 1].map(|k| self.half(d, k).map(Box::new))
        })
    }

    fn half(&self, d: usize, k: usize) -> Option<Self> {
        let mut domain = self.shape.domain();
        let middle = domain[d].at(0.5);
        domain[d] = if k == 0 {
            Interval::new(domain[d].start, middle)
        } else {
            Interval::new(middle, domain[d].end)
        };
        let mut window = self.window;
        window[1 - k][d] = 0.5 * (self.window[0][d] + self.window[1][d]);
        let [u, v] = domain;
        let (low, high) = (DVec2::new(u.start, v.start), DVec2::new(u.end, v.end));
        let clip = Clip { low, extent: high - low };
        let chains: Vec<Vec<Cubic>> = self.chains.iter().map(|chain| clip.chain(chain)).collect();
        let table = TrimTable::within(&chains, TABLE_CELLS, low, high).ok()?;
        let is_whole = self.is_whole
            || match table.cover(low, high) {
                Cover::None => return None,
                cover => cover == Cover::Whole,
            };
        let shape = Shape::surface(self.surface()?, domain)?;
        if !shape.is_nurbs() {
            return None;
        }
        let mut half = Self::of(shape, self.domain.clone(), chains, table, is_whole, window)?;
        let near: Vec<Skirt> = self.skirts.iter().filter(|s| s.is_near(&half)).cloned().collect();
        if !near.is_empty() {
            half.skirts = Arc::new(near);
            half.gap_mm = self.gap_mm;
        }
        Some(half)
    }

    /// With skirts where the boundary is away from its edges.
    pub(crate) fn with_skirts(mut self, (skirts, gap_mm): (Vec<Skirt>, f64)) -> Self {
        self.skirts = Arc::new(skirts);
        self.gap_mm = gap_mm;
        self
    }

    /// Its trees of patches and trim curves, made at their first use; `None` where the surface has no NURBS form.
    pub(crate) fn hierarchy(&self) -> Option<&Hierarchy> {
        self.hierarchy.get_or_init(|| Hierarchy::new(self)).as_ref()
    }

    /// The part of the face that a path leads to: 1 is the whole, then a bit for each half.
    pub(crate) fn tile(&self, path: u64) -> Option<&Self> {
        let depth = 63 - path.max(1).leading_zeros();
        (0..depth).rev().try_fold(self, |face, bit| face.halves()[(path >> bit & 1) as usize].as_deref())
    }

    /// Shares of the whole face's domain.
    pub(crate) fn share_of_whole(&self, share: DVec2) -> DVec2 {
        self.window[0] + (self.window[1] - self.window[0]) * share
    }

    /// The cubics of the boundary that lie in the domain.
    pub(crate) fn border(&self) -> impl Iterator<Item = &Cubic> {
        let [u, v] = self.shape.domain();
        let (low, extent) = (DVec2::new(u.start, v.start), DVec2::new(u.length(), v.length()));
        self.chains.iter().flatten().filter(move |cubic| {
            let unit = cubic.map(|p| (p - low) / extent);
            let least = unit.iter().fold(DVec2::INFINITY, |a, b| a.min(*b));
            let most = unit.iter().fold(DVec2::NEG_INFINITY, |a, b| a.max(*b));
            least.cmple(DVec2::splat(1.0 + 1e-9)).all() && most.cmpge(DVec2::splat(-1e-9)).all()
        })
    }

    /// The sides that this part of a face shares with others, as far as they are inside the face.
    pub(crate) fn seams(&self) -> Vec<Cubic> {
        if self.window == [DVec2::ZERO, DVec2::ONE] {
            return Vec::new();
        }
        self.sides(DVec2::ZERO, DVec2::ONE, SEAM_PIECES)
    }

    /// The sides of a box of shares, in pieces, as far as they are inside the face.
    pub(crate) fn sides(&self, low: DVec2, high: DVec2, pieces: u32) -> Vec<Cubic> {
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let pieces = (0..4).flat_map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            let at = move |n: u32| a.lerp(b, f64::from(n) / f64::from(pieces));
            (0..pieces).map(move |n| [at(n), at(n + 1)])
        });
        let is_inside = |[a, b]: &[DVec2; 2]| self.is_whole || self.table.cover(*a, *b) == Cover::Whole;
        let inside = pieces.map(|ends| ends.map(|share| self.parameters(share))).filter(is_inside);
        inside.map(|[a, b]| [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b]).collect()
    }

    /// A sphere around it.
    pub(crate) fn sphere(&self) -> (DVec3, f64) {
        (self.box_mm.center(), 0.55 * self.box_mm.diagonal())
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

    /// Shares of the domain at parameters.
    pub(crate) fn share(&self, uv: DVec2) -> DVec2 {
        let [u, v] = self.shape.domain();
        (uv - DVec2::new(u.start, v.start)) / DVec2::new(u.length(), v.length())
    }

    /// Points of the face: its polygons' corners, and some inside.
    pub(crate) fn outline(&self) -> Vec<DVec3> {
        let Places::Grid { us, vs } = Places::even(&self.shape, 9, 9) else { return Vec::new() };
        let all = us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v)));
        let inside = all.filter(|uv| self.domain.contains(*uv));
        let corners = self.domain.loops.iter().flat_map(|l| l.uvs());
        let points = inside.chain(corners).map(|uv| self.shape.derivatives(uv).point);
        points.filter(|p| p.is_finite()).collect()
    }
}

/// The share of its size at which a face's directions are compared, to halve the one that needs more cells.
const NOMINAL: f64 = 1e-6;
/// Cells of the trim tables of parts of faces; pieces of the sides between them.
const TABLE_CELLS: u32 = 128;
const SEAM_PIECES: u32 = 64;

/// A part of the parameter plane that curves are cut to.
struct Clip {
    low: DVec2,
    extent: DVec2,
}

impl Clip {
    /// Pieces of a chain: as it is inside, straight outside, nowhere farther than the part is wide.
    fn chain(&self, chain: &[Cubic]) -> Vec<Cubic> {
        let mut out = Vec::with_capacity(chain.len());
        chain.iter().for_each(|cubic| self.cut(cubic, 60, &mut out));
        out
    }

    fn cut(&self, cubic: &Cubic, depth: u32, out: &mut Vec<Cubic>) {
        let unit = cubic.map(|p| (p - self.low) / self.extent);
        let least = unit.iter().fold(DVec2::INFINITY, |a, b| a.min(*b));
        let most = unit.iter().fold(DVec2::NEG_INFINITY, |a, b| a.max(*b));
        let margin = DVec2::splat(0.05);
        if least.cmpgt(DVec2::ONE + margin).any() || most.cmplt(-margin).any() {
            let [a, b] = [unit[0], unit[3]].map(|p| p.clamp(DVec2::splat(-1.0), DVec2::splat(2.0)));
            let [a, b] = [a, b].map(|p| self.low + self.extent * p);
            if a != b {
                out.push([a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b]);
            }
        } else if depth > 0 && (most - least).max_element() > 4.0 {
            let [a, b, c, d] = *cubic;
            let (p, q, r) = (a.lerp(b, 0.5), b.lerp(c, 0.5), c.lerp(d, 0.5));
            let (s, t) = (p.lerp(q, 0.5), q.lerp(r, 0.5));
            let middle = s.lerp(t, 0.5);
            self.cut(&[a, p, s, middle], depth - 1, out);
            self.cut(&[middle, t, r, d], depth - 1, out);
        } else {
            out.push(*cubic);
        }
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

impl Bounds {
    fn of(shape: &Shape, breaks: &[Vec<f64>; 2]) -> (Self, Aabb) {
        let [u, v] = [0, 1].map(|d| Spans::measure(shape, breaks, d));
        let box_mm = u.2.union(v.2);
        (Self { lengths: [u.1, v.1], along: [u.0, v.0] }, box_mm)
    }

    fn is_finite(&self) -> bool {
        let all = self.along.iter().flat_map(|s| s.second.iter().chain(&s.mixed));
        all.chain(&self.lengths).all(|x| x.is_finite())
    }
}

impl Spans {
    /// The spans along `d`, the largest length along it, and a box of what was seen.
    fn measure(shape: &Shape, breaks: &[Vec<f64>; 2], d: usize) -> (Self, f64, Aabb) {
        let domain = shape.domain();
        let ends = &breaks[d];
        let each = (128 / (ends.len() - 1)).clamp(2, SAMPLES);
        // Just inside the span, where derivatives are those of the span.
        let inside = |k: usize, each: usize| (k as f64 / (each - 1) as f64).clamp(1e-6, 1.0 - 1e-6);
        let along: Vec<f64> = ends
            .windows(2)
            .flat_map(|pair| (0..each).map(move |k| pair[0] + (pair[1] - pair[0]) * inside(k, each)))
            .map(|share| domain[d].at(share))
            .collect();
        let across = across(&breaks[1 - d]).into_iter().map(|share| domain[1 - d].at(share)).collect();
        let lines = if d == 0 { [&along, &across] } else { [&across, &along] };
        let found = shape.derivatives_grid(lines[0], lines[1]);
        let at = |k: usize, line: usize| {
            if d == 0 { &found[k * across.len() + line] } else { &found[line * along.len() + k] }
        };
        let scale = domain.map(|d| d.length());
        let most = |of: &dyn Fn(usize, usize) -> DVec3| -> Vec<f64> {
            let span = |span: usize| {
                let all =
                    (span * each..(span + 1) * each).flat_map(|k| (0..across.len()).map(move |l| (k, l)));
                all.map(|(k, line)| of(k, line).length())
                    .fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
            };
            (0..ends.len() - 1).map(|k| span(k) * BETWEEN).collect()
        };
        let second = most(&|k, line| {
            let found = at(k, line);
            (if d == 0 { found.duu } else { found.dvv }) * scale[d] * scale[d]
        });
        let mixed = most(&|k, line| at(k, line).duv * scale[0] * scale[1]);
        let length = |line: usize| {
            (1..along.len()).map(|k| at(k - 1, line).point.distance(at(k, line).point)).sum::<f64>()
        };
        let length = (0..across.len()).map(length).fold(0.0, f64::max);
        let is_crease = ends[1..ends.len() - 1].iter().map(|end| is_crease(shape, d, *end)).collect();
        let box_mm = Aabb::from_points(found.iter().map(|d| d.point).filter(|p| p.is_finite()));
        (Self { ends: ends.clone(), second, mixed, is_crease }, length, box_mm)
    }
}

/// Lines across: several in every span where there are few spans, else one in some of them.
fn across(breaks: &[f64]) -> Vec<f64> {
    let spans = breaks.len() - 1;
    let each = (ACROSS / spans).clamp(1, SAMPLES);
    let stride = (spans * each).div_ceil(ACROSS);
    let all = breaks.windows(2).flat_map(|pair| {
        let share = |k: usize| match each {
            1 => 0.5,
            _ => (k as f64 / (each - 1) as f64).clamp(1e-6, 1.0 - 1e-6),
        };
        (0..each).map(move |k| pair[0] + (pair[1] - pair[0]) * share(k))
    });
    all.step_by(stride).collect()
}

/// Whether the first derivative turns at an inner break.
fn is_crease(shape: &Shape, d: usize, at: f64) -> bool {
    let domain = shape.domain();
    let derivative = |at: f64, across: f64| {
        let mut uv = DVec2::ZERO;
        uv[d] = domain[d].at(at);
        uv[1 - d] = domain[1 - d].at(across);
        let found = shape.derivatives(uv);
        if d == 0 { found.du } else { found.dv }
    };
    [0.13, 0.5, 0.87].into_iter().any(|across| {
        let (before, after) = (derivative(at - 1e-9, across), derivative(at + 1e-9, across));
        before.cross(after).length() > KINK_RAD * before.length() * after.length() || before.dot(after) < 0.0
    })
}
