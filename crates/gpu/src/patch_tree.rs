//! Rational bicubic patches that approximate a surface ever better (Guthe, Balázs, Klein 2005).

use glam::{DVec2, DVec3, DVec4, Vec3, Vec4};
use trimloop_geom::nurbs::{BezierGrid, BezierPatch};
use trimloop_geom::{Aabb, Interval};

use crate::Shape;
use crate::device::Key;
use crate::parameter::ParameterMap;
use crate::shape::Facet;
use crate::{Gpu, GpuError};

/// A binary tree of rational bicubic patches over a surface. The root, node 0, is the coarsest; a leaf is split when a
/// view asks for more than it gives, so the tree is as deep as what was looked at.
///
/// A patch takes points and derivatives of the homogeneous surface at its corners (Hermite), so it is the surface where
/// that has at most degree 3 in one piece, and neighbours of one level share the curve between them.
#[derive(Debug)]
pub struct PatchTree {
    /// What a traversal reads.
    nodes: Vec<PatchNode>,
    /// What is evaluated, by node.
    patches: Vec<Bicubic>,
    /// The Bézier patches of the surface, relative to the shape's origin.
    originals: BezierGrid,
    /// Ends of the originals along u, along v.
    breaks: [Vec<f64>; 2],
    maps: [ParameterMap; 2],
}

/// A node of a [`PatchTree`].
#[derive(Clone, Copy, Debug)]
pub struct PatchNode {
    link: Link,
    /// The largest distance between patch and surface at the same parameters, millimetres; infinite where the patch has
    /// no shape.
    pub error_mm: f64,
    /// What holds the patch and what it approximates; inside of its parent's.
    pub bounds: Aabb,
}

/// Where a node leads, in one word: bit 31 set in a leaf, bit 30 the direction of the split, below it the number of an
/// original (the one at the lower ends) or of the first of two children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Link(u32);

/// A rational bicubic patch over a part of a surface's domain.
#[derive(Clone, Debug)]
pub struct Bicubic {
    /// The part of the surface's domain, in the surface's own parameters.
    pub domain: [Interval; 2],
    /// Lengths of the second derivatives along u and along v and of the mixed one at most, with the domain stretched to the
    /// unit square, millimetres.
    pub bends: [f64; 3],
    /// Lengths along u and along v at most, millimetres.
    pub lengths: [f64; 2],
    /// The domain in the parameters of the NURBS form.
    form: [Interval; 2],
    /// 4 x 4 points `(w x, w y, w z, w)`, row-major, rows running over u, relative to the shape's origin.
    points: [DVec4; 16],
}

/// Homogeneous value and derivatives: none, u, v, uv.
type Corner = [DVec4; 4];

/// Places along a direction at which a patch is held against the surface: in every original, altogether.
const EACH: usize = 5;
const MOST: usize = 33;
/// Between samples, errors and derivatives exceed them by less than this share.
const BETWEEN: f64 = 1.15;
const LEAF: u32 = 1 << 31;
const ALONG_V: u32 = 1 << 30;

impl Link {
    fn leaf(original: usize, direction: usize) -> Self {
        Self(LEAF | (direction as u32 * ALONG_V) | original as u32)
    }

    fn inner(first_child: usize, direction: usize) -> Self {
        Self((direction as u32 * ALONG_V) | first_child as u32)
    }

    fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }

    /// 0 for u, 1 for v.
    fn direction(self) -> usize {
        usize::from(self.0 & ALONG_V != 0)
    }

    fn index(self) -> usize {
        (self.0 & (ALONG_V - 1)) as usize
    }
}

impl PatchNode {
    /// The first of its two children; `None` for a leaf.
    pub fn first_child(&self) -> Option<usize> {
        (!self.link.is_leaf()).then(|| self.link.index())
    }

    /// Of a leaf, the number of the surface's Bézier patch that it approximates (of several, of the one at the lower ends;
    /// row-major, rows running over u).
    pub fn original(&self) -> Option<usize> {
        self.link.is_leaf().then(|| self.link.index())
    }
}

impl PatchTree {
    /// The root alone; `None` for what has no NURBS form.
    pub fn new(shape: &Shape) -> Option<Self> {
        let net = shape.net.as_ref()?;
        let originals = net.bezier_grid()?;
        let breaks = [
            originals.patches.iter().step_by(originals.columns).map(|p| p.domain[0]).collect::<Vec<_>>(),
            originals.patches[..originals.columns].iter().map(|p| p.domain[1]).collect(),
        ]
        .map(|spans| [spans[0].start].into_iter().chain(spans.iter().map(|s| s.end)).collect());
        let mut tree =
            Self { nodes: Vec::new(), patches: Vec::new(), originals, breaks, maps: net.maps.clone() };
        tree.add(shape, shape.domain(), None);
        Some(tree)
    }

    /// A node.
    pub fn node(&self, index: usize) -> &PatchNode {
        &self.nodes[index]
    }

    /// A node's patch.
    pub fn patch(&self, index: usize) -> &Bicubic {
        &self.patches[index]
    }

    /// Nodes so far.
    #[expect(clippy::len_without_is_empty, reason = "there is always a root")]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Gives a leaf two children, halves along the direction in which it bends more; where several originals lie along that,
    /// the split is between two of them. Returns the first child.
    pub fn split(&mut self, shape: &Shape, index: usize) -> usize {
        let PatchNode { link, bounds, .. } = self.nodes[index];
        if !link.is_leaf() {
            return link.index();
        }
        let d = link.direction();
        let domain = self.patches[index].domain;
        let middle = domain[d].at(0.5);
        let inner = self.breaks_within(d, domain[d]);
        let at = inner
            .into_iter()
            .min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs()))
            .unwrap_or(middle);
        let first = self.nodes.len();
        for half in [Interval::new(domain[d].start, at), Interval::new(at, domain[d].end)] {
            let mut own = domain;
            own[d] = half;
            self.add(shape, own, Some(bounds));
        }
        self.nodes[index].link = Link::inner(first, d);
        first
    }

    /// Ends of originals strictly inside an interval.
    fn breaks_within(&self, d: usize, interval: Interval) -> Vec<f64> {
        let slack = 1e-9 * interval.length();
        let is_inside = |t: &f64| *t > interval.start + slack && *t < interval.end - slack;
        self.breaks[d].iter().copied().filter(is_inside).collect()
    }

    fn add(&mut self, shape: &Shape, domain: [Interval; 2], parent: Option<Aabb>) {
        let form = [0, 1].map(|d| {
            let [start, end] = [domain[d].start, domain[d].end].map(|t| self.maps[d].at(t)[0]);
            Interval::new(start, end)
        });
        let points = self.hermite(form);
        let mut patch = Bicubic { domain, bends: [0.0; 3], lengths: [0.0; 2], form, points };
        let lines = [0, 1].map(|d| self.samples(d, domain[d]));
        let exact = shape.derivatives_grid(&lines[0], &lines[1]);
        let columns = lines[1].len();
        let has_shape = points.iter().all(|p| p.w > 0.0 && p.is_finite());
        let mut error: f64 = if has_shape { 0.0 } else { f64::INFINITY };
        let at = |i: usize, j: usize| exact[i * columns + j].point - shape.origin();
        // How far lines are from straight tells which direction to split.
        let mut bows = [0.0_f64; 2];
        for (i, &u) in lines[0].iter().enumerate() {
            for (j, &v) in lines[1].iter().enumerate() {
                let jet = patch.jet(&self.maps, DVec2::new(u, v));
                error = worse(error, jet[0].distance(at(i, j)));
                for (k, derivative) in jet[1..].iter().enumerate() {
                    patch.bends[k] = worse(patch.bends[k], derivative.length() * BETWEEN);
                }
                let [s, t] = [(0, u), (1, v)].map(|(d, t)| (t - domain[d].start) / domain[d].length());
                let chord_u = at(0, j).lerp(at(lines[0].len() - 1, j), s);
                let chord_v = at(i, 0).lerp(at(i, columns - 1), t);
                bows[0] = worse(bows[0], at(i, j).distance(chord_u));
                bows[1] = worse(bows[1], at(i, j).distance(chord_v));
            }
        }
        let length = |steps: &mut dyn Iterator<Item = f64>| steps.sum::<f64>();
        let along_u = |j| length(&mut (1..lines[0].len()).map(|i| at(i - 1, j).distance(at(i, j))));
        let along_v = |i| length(&mut (1..columns).map(|j| at(i, j - 1).distance(at(i, j))));
        patch.lengths =
            [(0..columns).map(along_u).fold(0.0, worse), (0..lines[0].len()).map(along_v).fold(0.0, worse)];
        let is_single = (0..2).all(|d| self.breaks_within(d, domain[d]).is_empty());
        let degrees = self.originals.patches[0].degrees;
        if has_shape && is_single && degrees.iter().all(|degree| *degree <= 3) {
            error = 0.0;
        }
        let error_mm = if error.is_finite() { error * BETWEEN } else { f64::INFINITY };
        let hull = points.iter().filter(|p| p.w > 0.0).map(|p| p.truncate() / p.w);
        let samples = exact.iter().map(|d| d.point - shape.origin());
        let inside: Vec<DVec3> = if has_shape { hull.collect() } else { samples.collect() };
        let around = Aabb::from_points(inside.into_iter().filter(|p| p.is_finite()));
        let pad = DVec3::splat(if error_mm.is_finite() { error_mm } else { 0.1 * around.diagonal() });
        let mut bounds =
            Aabb { min: around.min - pad + shape.origin(), max: around.max + pad + shape.origin() };
        if let Some(parent) = parent {
            bounds = Aabb { min: bounds.min.max(parent.min), max: bounds.max.min(parent.max) };
        }
        let direction = match bows[0].total_cmp(&bows[1]) {
            std::cmp::Ordering::Equal => usize::from(patch.lengths[1] > patch.lengths[0]),
            order => usize::from(order.is_lt()),
        };
        let [i, j] = [0, 1].map(|d| self.span(d, form[d].start, false));
        let original = i * self.originals.columns + j;
        self.nodes.push(PatchNode { link: Link::leaf(original, direction), error_mm, bounds });
        self.patches.push(patch);
    }

    /// Places at which a patch over `interval` is held against the surface.
    fn samples(&self, d: usize, interval: Interval) -> Vec<f64> {
        let mut ends = vec![interval.start];
        ends.extend(self.breaks_within(d, interval));
        ends.push(interval.end);
        let spans = ends.len() - 1;
        let each = (MOST / spans).clamp(1, EACH);
        let stride = (spans * each).div_ceil(MOST);
        let all = ends.windows(2).flat_map(|pair| {
            (0..each).map(move |k| pair[0] + (pair[1] - pair[0]) * (k as f64 + 0.5) / each as f64)
        });
        let inner = all.step_by(stride);
        [interval.start].into_iter().chain(inner).chain([interval.end]).collect()
    }

    /// The number of the original along `d` that holds `t`; of two that meet there, the lower one or the upper one.
    fn span(&self, d: usize, t: f64, is_lower: bool) -> usize {
        let breaks = &self.breaks[d];
        let slack = 1e-9 * (breaks[breaks.len() - 1] - breaks[0]) * if is_lower { -1.0 } else { 1.0 };
        let above = breaks.partition_point(|end| *end <= t + slack);
        above.saturating_sub(1).min(breaks.len() - 2)
    }

    /// The bicubic patch that has the surface's points, first and mixed derivatives at its corners, all homogeneous.
    fn hermite(&self, form: [Interval; 2]) -> [DVec4; 16] {
        let [u, v] = form;
        let corner = |is_end: [bool; 2]| -> Corner {
            let [i, j] = [0, 1].map(|d| {
                let t = if is_end[d] { form[d].end } else { form[d].start };
                (self.span(d, t, is_end[d]), t)
            });
            let patch = &self.originals.patches[i.0 * self.originals.columns + j.0];
            let [value, du, dv, duv] = corner_of(patch, [i.1, j.1]);
            let (lu, lv) = (u.length(), v.length());
            [value, du * lu, dv * lv, duv * (lu * lv)]
        };
        let mut out = [DVec4::ZERO; 16];
        for is_end in [[false, false], [false, true], [true, false], [true, true]] {
            let [p, du, dv, duv] = corner(is_end);
            let [a, b] = is_end.map(|is_end| if is_end { -1.0 / 3.0 } else { 1.0 / 3.0 });
            let [i, j] = is_end.map(|is_end| if is_end { 3 } else { 0 });
            let [k, l] = is_end.map(|is_end| if is_end { 2 } else { 1 });
            out[4 * i + j] = p;
            out[4 * k + j] = p + du * a;
            out[4 * i + l] = p + dv * b;
            out[4 * k + l] = p + du * a + dv * b + duv * (a * b);
        }
        out
    }
}

/// The larger one; what is no number is larger than anything.
fn worse(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Homogeneous value and derivatives of a patch at parameters of its spline.
fn corner_of(patch: &BezierPatch, at: [f64; 2]) -> Corner {
    let [s, t] = [0, 1].map(|d| (at[d] - patch.domain[d].start) / patch.domain[d].length());
    let columns = patch.degrees[1] + 1;
    let rows: Vec<[DVec4; 2]> =
        patch.points.chunks(columns).map(|row| value_and_slope(row.to_vec(), t)).collect();
    let across = |k: usize| value_and_slope(rows.iter().map(|row| row[k]).collect(), s);
    let ([value, du], [dv, duv]) = (across(0), across(1));
    let [lu, lv] = patch.domain.map(|d| d.length());
    [value, du / lu, dv / lv, duv / (lu * lv)]
}

/// A Bézier curve's value and derivative at a share of it, by corner cutting.
fn value_and_slope(mut points: Vec<DVec4>, s: f64) -> [DVec4; 2] {
    let degree = points.len() - 1;
    let mut slope = DVec4::ZERO;
    for level in (1..=degree).rev() {
        if level == 1 {
            slope = (points[1] - points[0]) * degree as f64;
        }
        for i in 0..level {
            points[i] = points[i] * (1.0 - s) + points[i + 1] * s;
        }
    }
    [points[0], slope]
}

/// Bernstein polynomials of degree 3 and their first two derivatives.
fn bernstein(s: f64) -> [[f64; 4]; 3] {
    let r = 1.0 - s;
    [
        [r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s],
        [-3.0 * r * r, 3.0 * r * (r - 2.0 * s), 3.0 * s * (2.0 * r - s), 3.0 * s * s],
        [6.0 * r, 6.0 * (s - 2.0 * r), 6.0 * (r - 2.0 * s), 6.0 * s],
    ]
}

impl Bicubic {
    /// The point at parameters of the surface, relative to the shape's origin, and the second derivatives along u and
    /// along v and the mixed one, with the domain stretched to the unit square.
    fn jet(&self, maps: &[ParameterMap; 2], uv: DVec2) -> [DVec3; 4] {
        let local = |d: usize, t: f64| {
            let [at, slope, bend] = maps[d].at(t);
            let (own, form) = (self.domain[d].length(), self.form[d]);
            let scale = 1.0 / form.length();
            [(at - form.start) * scale, slope * own * scale, bend * own * own * scale]
        };
        let ([s, s1, s2], [t, t1, t2]) = (local(0, uv.x), local(1, uv.y));
        let (bu, bv) = (bernstein(s), bernstein(t));
        let sum = |k: usize, l: usize| -> DVec4 {
            let row = |i: usize| (0..4).map(|j| self.points[4 * i + j] * bv[l][j]).sum::<DVec4>() * bu[k][i];
            (0..4).map(row).sum()
        };
        let a = sum(0, 0);
        let (au, av) = (sum(1, 0) * s1, sum(0, 1) * t1);
        let auu = sum(2, 0) * (s1 * s1) + sum(1, 0) * s2;
        let avv = sum(0, 2) * (t1 * t1) + sum(0, 1) * t2;
        let auv = sum(1, 1) * (s1 * t1);
        // Piegl & Tiller A4.4.
        let p = a.truncate() / a.w;
        let du = (au.truncate() - p * au.w) / a.w;
        let dv = (av.truncate() - p * av.w) / a.w;
        let duu = (auu.truncate() - 2.0 * au.w * du - p * auu.w) / a.w;
        let dvv = (avv.truncate() - 2.0 * av.w * dv - p * avv.w) / a.w;
        let duv = (auv.truncate() - au.w * dv - av.w * du - p * auv.w) / a.w;
        [p, duu, dvv, duv]
    }

    /// Cells along u and along v that make triangles within `off_mm` of the patch (Piegl & Tiller 5.4; Filip, Magedson,
    /// Markot 1986), each at most `longest_mm` long.
    pub fn cells(&self, off_mm: f64, longest_mm: f64) -> [usize; 2] {
        let [duu, dvv, duv] = self.bends;
        let densities = [(duu, 0), (dvv, 1)]
            .map(|(b, d)| (b / (8.0 * off_mm)).sqrt().max(self.lengths[d] / longest_mm).max(1.0));
        let [h, k] = densities.map(|n| 1.0 / n);
        let off = (duu * h * h + 2.0 * duv * h * k + dvv * k * k) / 8.0;
        let scale = (off / off_mm).max(1.0).sqrt();
        densities.map(|n| {
            let cells = (n * scale - 1e-9).ceil();
            if cells.is_finite() { cells as usize } else { 1 }
        })
    }
}

/// A grid of points of a patch.
#[derive(Clone, Copy, Debug)]
pub struct PatchGrid<'a> {
    /// The surface.
    pub shape: &'a Shape,
    /// What holds the patch.
    pub tree: &'a PatchTree,
    /// The patch.
    pub node: usize,
    /// Cells along u, along v: lines are even in the surface's own parameters.
    pub cells: [usize; 2],
}

/// A grid of points of a patch, as the device evaluates it.
#[derive(Clone, Debug)]
pub struct PatchRequest {
    /// Relative to the grid's origin.
    control: [Vec4; 16],
    /// Where lines stand in the patch, and their shares of the surface's domain.
    lines: [Vec<[f32; 2]>; 2],
    facet: Facet,
    first_vertex: usize,
}

/// As in `shaders/bicubic_patch.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct PatchJob {
    first_vertex: u32,
    rows: u32,
    columns: u32,
    first_row: u32,
    first_column: u32,
    unused: [u32; 3],
}

/// Vertices that a workgroup evaluates.
const BLOCK: u32 = 64;

impl PatchGrid<'_> {
    /// Shares of the surface's domain at which its lines stand, along `d`.
    pub fn shares(&self, d: usize) -> Vec<f64> {
        let (own, whole) = (self.tree.patch(self.node).domain[d], self.shape.domain()[d]);
        let share = |t: f64| (t - whole.start) / whole.length();
        let n = self.cells[d];
        (0..=n).map(|k| share(if k == n { own.end } else { own.at(k as f64 / n as f64) })).collect()
    }

    fn lines(&self, d: usize) -> Vec<[f32; 2]> {
        let patch = self.tree.patch(self.node);
        let n = self.cells[d];
        let place = |k: usize| {
            let at = self.tree.maps[d].at(patch.domain[d].at(k as f64 / n as f64))[0];
            match k {
                0 => 0.0,
                _ if k == n => 1.0,
                _ => (at - patch.form[d].start) / patch.form[d].length(),
            }
        };
        (0..=n).zip(self.shares(d)).map(|(k, share)| [place(k) as f32, share as f32]).collect()
    }

    /// The request for positions relative to `origin`, the first of which becomes vertex `first_vertex`.
    pub fn request(&self, origin: DVec3, first_vertex: usize) -> PatchRequest {
        let patch = self.tree.patch(self.node);
        let shift = origin - self.shape.origin();
        let control = patch.points.map(|p| (p.truncate() - shift * p.w).extend(p.w).as_vec4());
        let normal = self.shape.normal(DVec2::from(patch.domain.map(|d| d.at(0.5)))).as_vec3();
        let size = self.tree.node(self.node).bounds.diagonal() as f32;
        let facet = Facet { origin: Vec3::ZERO, size, normal, unused: 0.0 };
        PatchRequest { control, lines: [0, 1].map(|d| self.lines(d)), facet, first_vertex }
    }
}

/// Evaluates patches into `vertices`, two vectors each: the point and its share along u, the unit normal and the share
/// along v.
///
/// # Errors
/// What the device refuses.
pub fn evaluate_patches(
    gpu: &Gpu,
    requests: &[PatchRequest],
    vertices: &wgpu::Buffer,
) -> Result<(), GpuError> {
    if requests.is_empty() {
        return Ok(());
    }
    let (mut jobs, mut blocks) = (Vec::new(), Vec::new());
    let mut lines: Vec<[f32; 2]> = Vec::new();
    for (job, request) in (0u32..).zip(requests) {
        let [rows, columns] = [0, 1].map(|d| request.lines[d].len() as u32);
        let first_row = lines.len() as u32;
        let first_column = first_row + rows;
        lines.extend(request.lines.iter().flatten().copied());
        blocks.extend((0..(rows * columns).div_ceil(BLOCK)).map(|k| [job, k]));
        let first_vertex = request.first_vertex as u32;
        jobs.push(PatchJob { first_vertex, rows, columns, first_row, first_column, unused: [0; 3] });
    }
    let control: Vec<Vec4> = requests.iter().flat_map(|r| r.control).collect();
    let facets: Vec<Facet> = requests.iter().map(|r| r.facet).collect();
    gpu.scoped(&format!("evaluate {} bicubic patches", requests.len()), || {
        let buffers = [
            gpu.upload("jobs", &jobs),
            gpu.upload("blocks", &blocks),
            gpu.upload("lines", &lines),
            gpu.upload("control", &control),
            gpu.upload("facets", &facets),
        ];
        let [jobs, blocks_buffer, lines, control, facets] = &buffers;
        let key = Key::new("bicubic_patch", "main");
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let bound = [jobs, blocks_buffer, lines, control, facets, vertices];
        gpu.dispatch(&mut encoder, &key, &bound, blocks.len());
        gpu.queue().submit([encoder.finish()]);
        Ok(())
    })
}
