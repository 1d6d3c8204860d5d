//! What is evaluated: a curve or a surface, made ready for the GPU once.

use std::sync::OnceLock;

use glam::{DVec2, DVec3, DVec4, Vec3, Vec4};
use trimloop_geom::nurbs::{BezierCurve, BezierGrid, BezierPatch};
use trimloop_geom::{Curve, Derivatives, Direction, Interval, NurbsCurve, NurbsSurface, Surface};

use crate::parameter::ParameterMap;

/// A curve or a surface over a finite domain, with a local origin.
///
/// A curve counts as a surface that does not depend on v.
#[derive(Debug)]
pub struct Shape {
    pub(crate) source: Source,
    domain: [Interval; 2],
    origin: DVec3,
    size: f64,
    pub(crate) net: Option<Net>,
    pub(crate) bezier: OnceLock<Bezier>,
}

#[derive(Clone, Debug)]
pub(crate) enum Source {
    Curve(Curve),
    Surface(Surface),
}

/// The control net of the exact NURBS form: clamped at both ends of the domain, relative to the shape's origin.
#[derive(Clone, Debug)]
pub(crate) struct Net {
    pub degrees: [usize; 2],
    /// Control points along u, along v.
    pub shape: [usize; 2],
    /// `(w x, w y, w z, w)`, row-major, rows running over u.
    pub points: Vec<DVec4>,
    /// Full knot vectors.
    pub knots: [Vec<f64>; 2],
    pub maps: [ParameterMap; 2],
}

/// The net in Bézier form.
#[derive(Clone, Debug)]
pub(crate) struct Bezier {
    /// Control points along v: the facets' one after the other.
    pub columns: usize,
    /// Control points, row-major, relative to the origin of their facet.
    pub control: Vec<Vec4>,
    /// Row-major over u.
    pub facets: Vec<Facet>,
    /// Ends of facets, in the NURBS form's parameters.
    pub breaks: [Vec<f64>; 2],
}

/// As in `shaders/shared/job.wgsl`.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Facet {
    pub origin: Vec3,
    pub size: f32,
    pub normal: Vec3,
    pub unused: f32,
}

/// Facets much longer than wide are cut, or rounding along them would drown what changes across.
const LONGEST: f64 = 32.0;
const MOST_CUTS: usize = 16;

impl Shape {
    /// A curve over `range`; `None` where that is empty or not finite.
    pub fn curve(curve: &Curve, range: Interval) -> Option<Self> {
        if !(range.is_finite() && range.length() > 0.0) {
            return None;
        }
        let form = curve.to_nurbs(range);
        let points = (0..=16).map(|k| curve.point(range.at(f64::from(k) / 16.0)));
        let (origin, size) = around(points.chain(form.iter().flat_map(|form| form.points().to_vec())));
        let net = form.and_then(|form| Net::of_curve(curve, &form, origin));
        let unit = Interval::new(0.0, 1.0);
        let source = Source::Curve(curve.clone());
        Some(Self { source, domain: [range, unit], origin, size, net, bezier: OnceLock::new() })
    }

    /// A surface over `domain`, for instance the box of a face's trim loops; `None` where that is empty or not finite.
    pub fn surface(surface: &Surface, domain: [Interval; 2]) -> Option<Self> {
        if !domain.iter().all(|d| d.is_finite() && d.length() > 0.0) {
            return None;
        }
        let form = surface.to_nurbs(domain);
        let steps = (0..=8).flat_map(|i| (0..=8).map(move |j| (i, j)));
        let at = |(i, j)| DVec2::new(domain[0].at(f64::from(i) / 8.0), domain[1].at(f64::from(j) / 8.0));
        let points = steps.map(|step| surface.point(at(step)));
        let (origin, size) = around(points.chain(form.iter().flat_map(|form| form.points().to_vec())));
        let net = form.and_then(|form| Net::of_surface(surface, &form, origin));
        let source = Source::Surface(surface.clone());
        Some(Self { source, domain, origin, size, net, bezier: OnceLock::new() })
    }

    /// The domain [u, v] (of a curve: its own, [0, 1]).
    pub fn domain(&self) -> [Interval; 2] {
        self.domain
    }

    /// What single-precision results are relative to.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The diagonal of the shape's box (of its control net, where it has one).
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Whether there is an exact NURBS form, which is what runs on the GPU. Others (offsets, sweeps of them) are
    /// evaluated on the CPU whatever the backend.
    pub fn is_nurbs(&self) -> bool {
        self.net.is_some()
    }

    /// The degrees of the NURBS form.
    pub fn degrees(&self) -> Option<[usize; 2]> {
        self.net.as_ref().map(|net| net.degrees)
    }

    /// Point and derivatives in f64.
    pub fn derivatives(&self, uv: DVec2) -> Derivatives {
        match &self.source {
            Source::Surface(surface) => surface.derivatives(uv),
            Source::Curve(curve) => {
                let [point, du, duu] = curve.derivatives(uv.x);
                Derivatives { point, du, duu, ..Derivatives::default() }
            }
        }
    }

    /// The surface; none of a curve.
    pub fn as_surface(&self) -> Option<&Surface> {
        match &self.source {
            Source::Surface(surface) => Some(surface),
            Source::Curve(_) => None,
        }
    }

    /// Points and derivatives in f64 at every pair of parameters, row-major, rows running over u.
    pub fn derivatives_grid(&self, us: &[f64], vs: &[f64]) -> Vec<Derivatives> {
        match &self.source {
            Source::Surface(surface) => surface.derivatives_grid(us, vs),
            Source::Curve(_) => {
                let row = |&u: &f64| vs.iter().map(move |&v| self.derivatives(DVec2::new(u, v)));
                us.iter().flat_map(row).collect()
            }
        }
    }

    /// Unit normal in f64; zero for a curve, and where there is none.
    pub fn normal(&self, uv: DVec2) -> DVec3 {
        match &self.source {
            Source::Surface(surface) => surface.normal(uv).unwrap_or(DVec3::ZERO),
            Source::Curve(_) => DVec3::ZERO,
        }
    }

    /// Makes now what the first evaluation would make otherwise.
    pub fn make_ready(&self) {
        if let Some(net) = &self.net {
            self.bezier(net);
        }
    }

    pub(crate) fn bezier(&self, net: &Net) -> &Bezier {
        self.bezier.get_or_init(|| net.to_bezier(|uv| self.normal(uv)))
    }
}

/// The middle and the diagonal of the points' box.
fn around(points: impl Iterator<Item = DVec3>) -> (DVec3, f64) {
    let bounds = trimloop_geom::Aabb::from_points(points.filter(|p| p.is_finite()));
    let size = bounds.diagonal();
    if size.is_finite() { ((bounds.min + bounds.max) * 0.5, size) } else { (DVec3::ZERO, 0.0) }
}

fn local(points: &[DVec4], origin: DVec3) -> Vec<DVec4> {
    points.iter().map(|p| (p.truncate() - origin * p.w).extend(p.w)).collect()
}

impl Net {
    fn of_curve(curve: &Curve, form: &NurbsCurve, origin: DVec3) -> Option<Self> {
        let map = match curve {
            Curve::Line { .. } | Curve::Parabola { .. } | Curve::Polyline(_) | Curve::Nurbs(_) => {
                ParameterMap::default()
            }
            _ => fit(form, |t| curve.point(t))?,
        };
        Some(Self {
            degrees: [form.degree(), 0],
            shape: [form.points().len(), 1],
            points: local(&form.homogeneous(), origin),
            knots: [form.knots().to_vec(), vec![0.0, 1.0]],
            maps: [map, ParameterMap::default()],
        })
    }

    fn of_surface(surface: &Surface, form: &NurbsSurface, origin: DVec3) -> Option<Self> {
        let maps = match surface {
            Surface::Plane { .. } | Surface::Nurbs(_) => Default::default(),
            _ => {
                // Half-way between two knots the parameters agree.
                let middles = [Direction::U, Direction::V].map(|direction| {
                    let knots = form.distinct_knots(direction);
                    let k = (knots.len() - 1) / 2;
                    0.5 * (knots[k] + knots[k + 1])
                });
                let along_u = form.isocurve(Direction::V, middles[1]).ok()?;
                let along_v = form.isocurve(Direction::U, middles[0]).ok()?;
                [
                    fit(&along_u, |u| surface.point(DVec2::new(u, middles[1])))?,
                    fit(&along_v, |v| surface.point(DVec2::new(middles[0], v)))?,
                ]
            }
        };
        Some(Self {
            degrees: form.degrees(),
            shape: form.shape(),
            points: local(&form.homogeneous(), origin),
            knots: form.knots().map(<[f64]>::to_vec),
            maps,
        })
    }

    /// The ends of the domain along `d`.
    pub fn domain(&self, d: usize) -> Interval {
        let (knots, degree) = (&self.knots[d], self.degrees[d]);
        Interval::new(knots[degree], knots[knots.len() - 1 - degree])
    }

    fn to_bezier(&self, normal: impl Fn(DVec2) -> DVec3) -> Bezier {
        let origin_of = |p: DVec4| p.truncate() / p.w;
        let patches = self.patches();
        let breaks = [ends(patches.iter().map(|p| p.domain[0])), ends(patches.iter().map(|p| p.domain[1]))];
        let [order_u, order_v] = self.degrees.map(|degree| degree + 1);
        let (rows, columns) = (breaks[0].len() - 1, breaks[1].len() - 1);
        let width = columns * order_v;
        let mut control = vec![Vec4::ZERO; rows * order_u * width];
        let mut facets = Vec::with_capacity(patches.len());
        for (k, patch) in patches.iter().enumerate() {
            let (origin, size) = around(patch.points.iter().map(|&p| origin_of(p)));
            for (i, row) in local(&patch.points, origin).chunks(order_v).enumerate() {
                let at = ((k / columns) * order_u + i) * width + (k % columns) * order_v;
                control[at..at + order_v].iter_mut().zip(row).for_each(|(to, p)| *to = p.as_vec4());
            }
            let middle = DVec2::from(patch.domain.map(|d| d.at(0.5)));
            let (origin, normal) = (origin.as_vec3(), normal(middle).as_vec3());
            facets.push(Facet { origin, size: size as f32, normal, unused: 0.0 });
        }
        Bezier { columns: width, control, facets, breaks }
    }

    /// The surface, relative to the shape's origin; none of a curve.
    fn surface(&self) -> Option<NurbsSurface> {
        let [rows, columns] = self.shape;
        let knots = self.knots.clone();
        let built = NurbsSurface::from_homogeneous(self.degrees, rows, columns, &self.points, knots);
        built.ok().filter(|_| self.degrees[1] > 0)
    }

    /// The Bézier patches, relative to the shape's origin; none of a curve.
    pub fn bezier_grid(&self) -> Option<BezierGrid> {
        self.surface().map(|surface| surface.bezier_patches())
    }

    /// The Bézier patches, long ones cut, relative to the shape's origin.
    fn patches(&self) -> Vec<BezierPatch> {
        if self.degrees[1] == 0 {
            let knots = self.knots[0].clone();
            let curve = NurbsCurve::from_homogeneous(self.degrees[0], &self.points, knots);
            let pieces = curve.map(|curve| curve.bezier_pieces()).unwrap_or_default().into_iter();
            let unit = Interval::new(0.0, 1.0);
            let patch = |piece: BezierCurve| BezierPatch {
                degrees: self.degrees,
                domain: [piece.range, unit],
                points: piece.points,
            };
            return pieces.map(patch).collect();
        }
        let Some(mut surface) = self.surface() else { return Vec::new() };
        let grid = surface.bezier_patches();
        for (d, direction) in [(0, Direction::U), (1, Direction::V)] {
            let new = cuts(&grid.patches, d);
            if !new.is_empty() {
                surface = surface.refined(direction, &new);
            }
        }
        surface.bezier_patches().patches
    }
}

/// Where facets are cut along `d` so that none is much longer than wide.
fn cuts(patches: &[BezierPatch], d: usize) -> Vec<f64> {
    let mut pieces: Vec<(Interval, usize)> = Vec::new();
    for patch in patches {
        let lengths = [0, 1].map(|d| control_length(patch, d));
        let ratio = lengths[d] / (lengths[1 - d] * LONGEST);
        if ratio > 1.0 && ratio.is_finite() {
            pieces.push((patch.domain[d], (ratio.ceil() as usize).min(MOST_CUTS)));
        }
    }
    pieces.sort_by(|a, b| a.0.start.total_cmp(&b.0.start).then(b.1.cmp(&a.1)));
    pieces.dedup_by(|a, b| a.0.start == b.0.start);
    let parts = pieces.into_iter();
    parts.flat_map(|(span, n)| (1..n).map(move |k| span.at(k as f64 / n as f64))).collect()
}

/// The longest way along `d` through a patch's control points.
fn control_length(patch: &BezierPatch, d: usize) -> f64 {
    let [rows, columns] = patch.degrees.map(|degree| degree + 1);
    let point = |i: usize, j: usize| {
        let p = patch.points[i * columns + j];
        p.truncate() / p.w
    };
    let line = |index: usize| {
        let steps = if d == 0 { rows } else { columns } - 1;
        let at = |k: usize| if d == 0 { point(k, index) } else { point(index, k) };
        (0..steps).map(|k| at(k).distance(at(k + 1))).sum::<f64>()
    };
    (0..if d == 0 { columns } else { rows }).map(line).fold(0.0, f64::max)
}

fn ends(domains: impl Iterator<Item = Interval>) -> Vec<f64> {
    let mut ends: Vec<f64> = domains.flat_map(|d| [d.start, d.end]).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    ends
}

/// The map under which `form` runs as `point` does; `None` where that is none of the known ones.
fn fit(form: &NurbsCurve, point: impl Fn(f64) -> DVec3) -> Option<ParameterMap> {
    let knots = form.distinct_knots();
    let curve = Curve::Nurbs(form.clone());
    let map = ParameterMap::fitted(&knots, |span| {
        let at = span.at(0.25);
        curve.project(point(at), Some(at)).t
    });
    let size = form.size();
    let fits = knots.windows(2).all(|pair| {
        [0.1, 0.6, 0.8].into_iter().all(|share| {
            let t = Interval::new(pair[0], pair[1]).at(share);
            form.point(map.at(t)[0]).distance(point(t)) <= 1e-9 * size
        })
    });
    fits.then_some(map)
}
