//! The smallest distance of two items: best first over pairs of boxes, with a descent from what is nearest.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use trimloop_geom::{Curve, Interval};

use crate::bvh::gap;
use crate::descend::{Foot, descend};
use crate::element::Element;
use crate::sampled::Sampled;
use crate::simplex::{Nearest, Simplex, nearest};

/// A pair of places that may be the nearest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub points: [DVec3; 2],
    pub distance: f64,
    /// Whether both are on the exact shapes, and no step brings them nearer.
    pub is_exact: bool,
    /// On which elements.
    pub elements: [u32; 2],
}

/// Pairs of simplices that are looked at before giving up on anything better.
const MOST_PAIRS: usize = 20_000;

/// Starts nearer to each other than this share of the smaller item are the same.
const SAME_START: f64 = 0.02;

/// The smallest distance of two items, by at most `budget` descents; `None` where one has nothing.
///
/// Pairs of boxes are opened nearest first, down to pairs of simplices, from whose nearest places descents start. It
/// ends when what is left is farther apart than the best found, samples' slack taken off, or with the budget: then
/// what was left out is no nearer than the best by more than that slack.
pub(crate) fn search(a: &Sampled, b: &Sampled, budget: usize) -> Option<Candidate> {
    if a.tree.nodes.is_empty() || b.tree.nodes.is_empty() {
        return None;
    }
    let mut search = Search::new(a, b, budget);
    search.run();
    search.result()
}

/// What lies below this share of all coordinates is rounding.
const ROUNDING: f64 = 1e-14;

enum Work {
    Nodes([u32; 2]),
    Simplices([u32; 2], Nearest),
}

struct Entry {
    /// Distance of the boxes or simplices.
    distance: f64,
    /// How much there is in them: of what is equally near, the smallest first.
    count: u32,
    work: Work,
}

struct Search<'s, 'g> {
    a: &'s Sampled<'g>,
    b: &'s Sampled<'g>,
    slack: f64,
    /// Where descents started, and on what.
    starts: Vec<([u32; 2], [DVec3; 2])>,
    budget: usize,
    best: Option<Candidate>,
    /// The nearest samples, and how near the exact shapes must be because of them.
    samples: Option<Candidate>,
    bound: f64,
    same: f64,
    reach: f64,
    rounding: f64,
    heap: BinaryHeap<Entry>,
}

impl<'s, 'g> Search<'s, 'g> {
    fn new(a: &'s Sampled<'g>, b: &'s Sampled<'g>, budget: usize) -> Self {
        let bounds = [a.tree.bounds(), b.tree.bounds()];
        let sizes = bounds.map(|bounds| bounds.diagonal());
        let smaller = sizes.into_iter().filter(|&s| s > 0.0).fold(f64::INFINITY, f64::min);
        Self {
            a,
            b,
            slack: a.most_slack() + b.most_slack(),
            starts: Vec::new(),
            budget,
            best: None,
            samples: None,
            bound: f64::INFINITY,
            same: if smaller.is_finite() { SAME_START * smaller } else { 0.0 },
            reach: 0.25 * smaller,
            rounding: ROUNDING * a.extent().max(b.extent()),
            heap: BinaryHeap::new(),
        }
    }

    fn run(&mut self) {
        self.push_nodes([0, 0]);
        let mut pairs = 0;
        while let Some(entry) = self.heap.pop() {
            if self.is_settled(entry.distance - self.slack) {
                break;
            }
            match entry.work {
                Work::Nodes(nodes) => self.open(nodes),
                Work::Simplices(pair, nearest) => {
                    pairs += 1;
                    self.refine(pair, nearest);
                    if self.starts.len() >= self.budget || pairs >= MOST_PAIRS {
                        break;
                    }
                }
            }
        }
    }

    /// Whether nothing that is at least so far apart can be better than the best.
    fn is_settled(&self, distance: f64) -> bool {
        let best = self.best.map_or(f64::INFINITY, |best| best.distance);
        best <= self.rounding
            || distance >= best - self.rounding - 1e-13 * best
            || distance > self.bound + self.rounding
    }

    fn push_nodes(&mut self, nodes: [u32; 2]) {
        let (a, b) = (&self.a.tree.nodes[nodes[0] as usize], &self.b.tree.nodes[nodes[1] as usize]);
        let distance = gap(&a.bounds, &b.bounds);
        if !self.is_settled(distance - self.slack) {
            self.heap.push(Entry { distance, count: a.count + b.count, work: Work::Nodes(nodes) });
        }
    }

    /// Replaces a pair of boxes by what is in the larger one, or by their simplices.
    fn open(&mut self, [i, j]: [u32; 2]) {
        let (a, b) = (self.a.tree.nodes[i as usize], self.b.tree.nodes[j as usize]);
        let a_is_larger = a.bounds.diagonal() >= b.bounds.diagonal();
        match (a.below, b.below) {
            (Some(below), None) => below.into_iter().for_each(|k| self.push_nodes([k, j])),
            (Some(below), _) if a_is_larger => below.into_iter().for_each(|k| self.push_nodes([k, j])),
            (_, Some(below)) => below.into_iter().for_each(|k| self.push_nodes([i, k])),
            (None, None) => {
                for k in a.first..a.first + a.count {
                    (b.first..b.first + b.count).for_each(|l| self.push_simplices([k, l]));
                }
            }
        }
    }

    fn push_simplices(&mut self, pair: [u32; 2]) {
        let (a, b) = self.simplices(pair);
        let found = nearest(a, b);
        let elements = [a.element, b.element];
        let slack = self.slack_of(elements);
        if self.is_settled(found.distance - slack) {
            return;
        }
        if found.distance + slack < self.bound {
            self.bound = found.distance + slack;
            let points = [a.at(found.weights[0]), b.at(found.weights[1])];
            self.samples = Some(Candidate { points, distance: found.distance, is_exact: false, elements });
        }
        self.heap.push(Entry { distance: found.distance, count: 0, work: Work::Simplices(pair, found) });
    }

    fn simplices(&self, [i, j]: [u32; 2]) -> (&'s Simplex, &'s Simplex) {
        (&self.a.tree.simplices[i as usize], &self.b.tree.simplices[j as usize])
    }

    fn slack_of(&self, [a, b]: [u32; 2]) -> f64 {
        self.a.slack[a as usize] + self.b.slack[b as usize]
    }

    /// Descends from the nearest places of two simplices, unless something like it was done before.
    fn refine(&mut self, pair: [u32; 2], nearest: Nearest) {
        let (a, b) = self.simplices(pair);
        let elements = [a.element, b.element];
        if self.is_settled(nearest.distance - self.slack_of(elements)) {
            return;
        }
        let points = [a.at(nearest.weights[0]), b.at(nearest.weights[1])];
        let is_known = |(known, from): &([u32; 2], [DVec3; 2])| {
            *known == elements && (0..2).all(|k| from[k].distance(points[k]) <= self.same)
        };
        if self.starts.iter().any(is_known) {
            return;
        }
        self.starts.push((elements, points));
        let parameters = [a.parameters_at(nearest.weights[0]), b.parameters_at(nearest.weights[1])];
        let of_a = parts(&self.a.elements[a.element as usize], parameters[0]);
        let of_b = parts(&self.b.elements[b.element as usize], parameters[1]);
        for (rank_a, (ea, pa)) in of_a.iter().enumerate() {
            for (rank_b, (eb, pb)) in of_b.iter().enumerate() {
                let foot = descend([ea, eb], [*pa, *pb], self.reach);
                // Sides and corners of a triangle hold all that is on them.
                let is_inside = (rank_a > 0 || self.a.contains(elements[0], foot.parameters[0]))
                    && (rank_b > 0 || self.b.contains(elements[1], foot.parameters[1]));
                self.offer(foot, elements, is_inside);
            }
        }
    }

    fn offer(&mut self, foot: Foot, elements: [u32; 2], is_inside: bool) {
        let is_better = self.best.is_none_or(|best| foot.distance < best.distance);
        if is_inside && is_better && foot.distance.is_finite() {
            let Foot { points, distance, converged, .. } = foot;
            // Where they touch without crossing, steps get ever smaller.
            let is_exact = converged || distance <= 10.0 * self.rounding;
            self.best = Some(Candidate { points, distance, is_exact, elements });
        }
    }

    /// The best; samples where they are nearer than all that came of them.
    fn result(self) -> Option<Candidate> {
        let is_whole = self.a.is_whole && self.b.is_whole;
        let best = self.best.map(|best| Candidate { is_exact: best.is_exact && is_whole, ..best });
        match (best, self.samples) {
            (Some(best), Some(samples)) => {
                // Vertices may lie off the exact shapes by what the file's own accuracy is.
                let size = self.a.tree.bounds().diagonal().max(self.b.tree.bounds().diagonal());
                let most = self.bound + 1e-4 * size;
                Some(if best.distance <= most { best } else { samples })
            }
            (best, samples) => best.or(samples),
        }
    }
}

/// The element and, for a triangle, its sides and corners, with places on them to start from.
fn parts(element: &Element, at: DVec2) -> Vec<(Element, DVec2)> {
    let mut out = vec![(element.clone(), at)];
    if let Element::Triangle { corner, sides } = element {
        let corners = [*corner, *corner + sides[0], *corner + sides[1]];
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            let curve = Arc::new(Curve::Line { origin: from, direction: to - from });
            let limits = Interval::new(0.0, 1.0);
            let share = [at.x, at.y, 1.0 - at.y][k].clamp(0.0, 1.0);
            let side = Element::Curve { curve, limits, map: DAffine3::IDENTITY };
            out.push((side, DVec2::new(share, 0.0)));
            out.push((Element::Point(from), DVec2::ZERO));
        }
    }
    out
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    /// The heap gives the greatest first: the nearest, and of those the smallest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.count.cmp(&self.count))
    }
}
