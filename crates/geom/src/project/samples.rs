//! A grid of surface points from which global searches start.

use glam::{DVec2, DVec3};

use crate::nurbs::sample_parameters;
use crate::{Aabb, Direction, Interval, NurbsSurface};

/// Points over a surface's domain, with boxes around blocks of them.
#[derive(Clone, Debug)]
pub(crate) struct SampleGrid {
    us: Vec<f64>,
    vs: Vec<f64>,
    /// Row-major over `us`.
    points: Vec<DVec3>,
    /// Parameters among `us` and `vs` across which the tangent may jump.
    kinks: [Vec<f64>; 2],
    /// How far from each sample the surface goes before another one is nearer, about.
    radii: Vec<f64>,
    /// The largest radius of each block.
    reach: Vec<f64>,
    /// The boxes of `BLOCK` x `BLOCK` points, row-major.
    boxes: Vec<Aabb>,
}

/// A sampled local minimum of the distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub distance: f64,
    pub uv: DVec2,
    pub radius: f64,
}

const BLOCK: usize = 8;
/// How many samples a surface may have.
const CAP: usize = 1 << 16;
/// How many local minima a search starts from.
pub(super) const STARTS: usize = 12;

impl SampleGrid {
    /// A few points per knot span of a spline surface.
    pub fn of_nurbs(surface: &NurbsSurface) -> Self {
        let spans = [Direction::U, Direction::V].map(|d| surface.distinct_knots(d));
        let rational = !surface.weights().is_empty();
        let mut steps =
            surface.degrees().map(|degree| (degree + 2 + if rational { degree / 2 } else { 0 }).clamp(4, 16));
        let count = |steps: [usize; 2]| (spans[0].len() * steps[0]).saturating_mul(spans[1].len() * steps[1]);
        while count(steps) > CAP && steps != [1, 1] {
            steps = steps.map(|s| (s - 1).max(1));
        }
        let mut caps = [usize::MAX; 2];
        if count(steps) > CAP {
            let shrink = (count(steps) as f64 / CAP as f64).sqrt();
            caps = [0, 1].map(|d| ((spans[d].len() as f64 / shrink) as usize).max(2));
        }
        let [us, vs] = [0, 1].map(|d| sample_parameters(&spans[d], steps[d], caps[d]));
        let points = surface.grid(&us, &vs);
        let kinks = [creases(surface, Direction::U, &vs), creases(surface, Direction::V, &us)];
        Self { kinks, ..Self::new(us, vs, points) }
    }

    /// The grid of `points`, row-major over `us`.
    pub fn new(us: Vec<f64>, vs: Vec<f64>, points: Vec<DVec3>) -> Self {
        let mut grid =
            Self { us, vs, points, kinks: Default::default(), radii: vec![], reach: vec![], boxes: vec![] };
        let blocks = grid.us.len().div_ceil(BLOCK) * grid.blocks_across();
        grid.boxes = vec![Aabb::EMPTY; blocks];
        grid.reach = vec![0.0; blocks];
        for index in 0..grid.points.len() {
            let point = grid.points[index];
            let spread = grid.neighbours(index).map(|k| grid.points[k].distance(point)).fold(0.0, f64::max);
            let block = grid.block_of(index);
            grid.radii.push(0.75 * spread);
            grid.boxes[block] = grid.boxes[block].with(point);
            grid.reach[block] = grid.reach[block].max(0.75 * spread);
        }
        grid
    }

    fn blocks_across(&self) -> usize {
        self.vs.len().div_ceil(BLOCK)
    }

    fn block_of(&self, index: usize) -> usize {
        let (i, j) = (index / self.vs.len(), index % self.vs.len());
        i / BLOCK * self.blocks_across() + j / BLOCK
    }

    fn block(&self, block: usize) -> impl Iterator<Item = usize> {
        let (row, column) = (block / self.blocks_across(), block % self.blocks_across());
        let columns = self.vs.len();
        let across = column * BLOCK..(column * BLOCK + BLOCK).min(columns);
        let rows = row * BLOCK..(row * BLOCK + BLOCK).min(self.us.len());
        rows.flat_map(move |i| across.clone().map(move |j| i * columns + j))
    }

    /// The sample itself and those around it, up to nine in all.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> {
        let columns = self.vs.len();
        let (i, j) = (index / columns, index % columns);
        let rows = i.saturating_sub(1)..=(i + 1).min(self.us.len() - 1);
        let across = j.saturating_sub(1)..=(j + 1).min(columns - 1);
        rows.flat_map(move |k| across.clone().map(move |l| k * columns + l))
    }

    /// The best few samples that are no further than their neighbours along u and along v (the diagonal ones would hide
    /// slanting valleys) and near which the surface may come nearer
    /// than `bound`, best first. `margin` is how far the surface that is searched lies off the sampled one.
    pub fn local_minima(&self, target: DVec3, mut bound: f64, margin: f64) -> [Option<Start>; STARTS] {
        let mut best = [None; STARTS];
        if bound.is_infinite() {
            bound = self.near(target) + margin;
        }
        for block in 0..self.boxes.len() {
            if self.away2(block, target) >= square(bound + margin + self.reach[block]) {
                continue;
            }
            for index in self.block(block) {
                let distance2 = self.points[index].distance_squared(target);
                let reach = bound + margin + self.radii[index];
                if distance2 < square(reach) && self.is_minimum(target, index) {
                    let distance = distance2.sqrt();
                    let uv = DVec2::new(self.us[index / self.vs.len()], self.vs[index % self.vs.len()]);
                    keep(&mut best, Start { distance, uv, radius: self.radii[index] });
                    bound = bound.min(distance + margin);
                }
            }
        }
        best
    }

    /// The squared distance of `target` from a block's box.
    fn away2(&self, block: usize, target: DVec3) -> f64 {
        let bounds = &self.boxes[block];
        target.clamp(bounds.min, bounds.max).distance_squared(target)
    }

    /// The distance of some sample that is as near as a first look can tell: the nearest one of the nearest block.
    fn near(&self, target: DVec3) -> f64 {
        let blocks = (0..self.boxes.len()).map(|block| (self.away2(block, target), block));
        let nearest = blocks.min_by(|a, b| a.0.total_cmp(&b.0));
        let samples = nearest.into_iter().flat_map(|(_, block)| self.block(block));
        samples.map(|index| self.points[index].distance_squared(target)).fold(f64::INFINITY, f64::min).sqrt()
    }

    fn is_minimum(&self, target: DVec3, index: usize) -> bool {
        // Of equals (a pole's samples) only the first counts.
        let here = self.points[index].distance_squared(target);
        let columns = self.vs.len();
        let beside = |k: &usize| k / columns == index / columns || k % columns == index % columns;
        self.neighbours(index).filter(beside).all(|k| {
            let there = self.points[k].distance_squared(target);
            here < there || (here == there && k >= index)
        })
    }

    /// The part of the parameter plane around `uv` between the creases next to it, if there are any at all.
    ///
    /// Its upper ends lie a hair before the crease, where the derivatives are still those of this side.
    pub fn smooth_cell(&self, uv: DVec2, limits: [Interval; 2]) -> Option<[Interval; 2]> {
        if self.kinks.iter().all(Vec::is_empty) {
            return None;
        }
        let along = |d: usize, parameters: &[f64]| {
            let kinks = &self.kinks[d];
            let above = kinks.partition_point(|&k| k <= uv[d]);
            let hair = 1e-12 * (parameters[parameters.len() - 1] - parameters[0]);
            let low = above.checked_sub(1).map_or(limits[d].start, |i| kinks[i]);
            let high = kinks.get(above).map_or(limits[d].end, |k| k - hair);
            Interval::new(low, high)
        };
        Some([along(0, &self.us), along(1, &self.vs)])
    }

    /// How far the samples around a sample's `uv` are from it, along u and v.
    pub fn spacing(&self, uv: DVec2) -> DVec2 {
        let along = |t: f64, parameters: &[f64]| {
            let i = parameters.partition_point(|&x| x < t);
            let (low, high) = (i.saturating_sub(1), (i + 1).min(parameters.len() - 1));
            (t - parameters[low]).max(parameters[high] - t)
        };
        DVec2::new(along(uv.x, &self.us), along(uv.y, &self.vs))
    }

    /// Whether `uv` lies in one of the cells around the sample `start`, none of which ends in a crease there.
    pub fn is_beside(&self, start: &Start, uv: DVec2) -> bool {
        let near = |t: f64, at: f64, parameters: &[f64], kinks: &[f64]| {
            let i = parameters.partition_point(|&x| x < at);
            let (low, high) = (i.saturating_sub(1), (i + 1).min(parameters.len() - 1));
            parameters[low] <= t && t <= parameters[high] && !kinks.contains(&at)
        };
        near(uv.x, start.uv.x, &self.us, &self.kinks[0]) && near(uv.y, start.uv.y, &self.vs, &self.kinks[1])
    }

    /// Where to descend from for a sample: the sample itself, or, on a crease, the middles of the ways to its
    /// neighbours on either side.
    pub fn approaches(&self, uv: DVec2) -> Vec<DVec2> {
        let along = |t: f64, kinks: &[f64], parameters: &[f64]| match kinks.contains(&t) {
            false => vec![t],
            true => {
                let i = parameters.partition_point(|&x| x < t);
                let sides = [i.saturating_sub(1), (i + 1).min(parameters.len() - 1)];
                sides.map(|k| 0.5 * (t + parameters[k])).to_vec()
            }
        };
        let us = along(uv.x, &self.kinks[0], &self.us);
        let vs = along(uv.y, &self.kinks[1], &self.vs);
        us.iter().flat_map(|&u| vs.iter().map(move |&v| DVec2::new(u, v))).collect()
    }
}

/// The values of one parameter at which the tangent along it jumps, somewhere among the values `across` of the other:
/// knots that come `degree` times or more often, the seam of a closed surface included.
fn creases(surface: &NurbsSurface, direction: Direction, across: &[f64]) -> Vec<f64> {
    let d = direction as usize;
    let (knots, degree, domain) = (surface.knots()[d], surface.degrees()[d], surface.domain()[d]);
    let closed = surface.periods()[d].is_some();
    let inside = |k: f64| domain.start < k && k < domain.end;
    let mut found: Vec<f64> = knots
        .windows(degree)
        .filter(|w| w[0] == w[degree - 1] && (closed || inside(w[0])))
        .map(|w| w[0])
        .collect();
    found.dedup();
    let hair = 1e-9 * domain.length();
    let tangent = |t: f64, other: f64| {
        let uv = if d == 0 { DVec2::new(t, other) } else { DVec2::new(other, t) };
        let s = surface.first_derivatives(uv);
        if d == 0 { s.du } else { s.dv }
    };
    found.retain(|&k| {
        across.iter().step_by((across.len() / 64).max(1)).any(|&other| {
            let (before, after) = (tangent(k - hair, other), tangent(k + hair, other));
            before.distance(after) > 1e-5 * before.length().max(after.length())
        })
    });
    found
}

fn square(x: f64) -> f64 {
    x * x
}

fn keep(best: &mut [Option<Start>; STARTS], mut start: Start) {
    for slot in best {
        match slot {
            Some(kept) if kept.distance <= start.distance => {}
            Some(kept) => std::mem::swap(kept, &mut start),
            None => {
                *slot = Some(start);
                return;
            }
        }
    }
}
