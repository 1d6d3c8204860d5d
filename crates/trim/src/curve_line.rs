//! A curve by itself as a polyline, before anything is known of the surfaces beside it.

use glam::DVec3;
use trimloop_geom::{Curve, Interval};

use crate::Tolerance;
use crate::chord::{off_chord, sag, turns_by_more};

/// A point of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinePoint {
    /// The curve's parameter.
    pub t: f64,
    pub point: DVec3,
    /// How far the curve is from the chord that ends here.
    pub sag: f64,
}

/// A curve over a range, and what its polyline is to keep to.
pub(crate) struct CurveLine<'a> {
    pub curve: &'a Curve,
    pub range: Interval,
    /// Whether the polyline runs from the range's start to its end.
    pub same_sense: bool,
    /// The polyline's ends, in its own direction: exactly the vertices.
    pub ends: [DVec3; 2],
    pub closed: bool,
    /// Points that the polyline may not jump over, where it passes them: poles of the surfaces beside it.
    pub singular: Vec<DVec3>,
    /// Within this distance a point counts as one of them.
    pub snap: f64,
    pub tolerance: Tolerance,
}

/// So many points of a line at most are replaced by one chord.
const LONGEST_RUN: usize = 64;

/// How often a chord may be halved.
pub(crate) const MAX_DEPTH: u32 = 14;

impl CurveLine<'_> {
    /// Points whose chords keep the tolerance.
    pub fn points(&self) -> Vec<LinePoint> {
        let starts = self.start_parameters();
        let mut line: Vec<LinePoint> = Vec::with_capacity(starts.len() * 2);
        let last = starts.len() - 1;
        for (i, &t) in starts.iter().enumerate() {
            let point = match i {
                0 => self.ends[0],
                i if i == last => self.ends[1],
                _ => self.curve.point(t),
            };
            let mut next = LinePoint { t, point, sag: 0.0 };
            if let Some(&near) = line.last() {
                // Vertices may lie beside their curve.
                let beside = |t: f64, end: DVec3| self.curve.point(t).distance(end);
                let first = if i == 1 { beside(starts[0], self.ends[0]) } else { 0.0 };
                let gap = first.max(if i == last { beside(t, self.ends[1]) } else { 0.0 });
                next.sag = match self.sag_bound(&near, &next, gap) {
                    Some(sag) => sag,
                    None => self.halve(near, next, &mut line),
                };
            }
            line.push(next);
        }
        line
    }

    /// More than the curve can be from its chord, whose ends lie up to `gap` beside it, where the curve is a polynomial
    /// between them and that is enough to know that it keeps well within the tolerance.
    fn sag_bound(&self, a: &LinePoint, b: &LinePoint, gap: f64) -> Option<f64> {
        let Curve::Nurbs(nurbs) = self.curve else { return None };
        let step = (b.t - a.t).abs();
        let bend = nurbs.second_derivative_bound((a.t + b.t) * 0.5)? * step * step;
        let sag = bend / 8.0 + gap;
        // The curve's velocity is the chord's on average, and changes by no more than `bend` (both over the step).
        let slowest = a.point.distance(b.point) - 2.0 * gap - bend;
        let keeps =
            sag <= self.tolerance.linear_mm * 0.5 && bend <= slowest * self.tolerance.angular_rad * 0.5;
        keeps.then_some(sag)
    }

    /// Adds the points strictly between `a` and `b`, the middle one at least where a curve may swing to both sides.
    fn halve(&self, a: LinePoint, b: LinePoint, out: &mut Vec<LinePoint>) -> f64 {
        if self.closed || !self.is_general() {
            return self.fill(a, b, None, 0, out);
        }
        let t = (a.t + b.t) * 0.5;
        let mut middle = LinePoint { t, point: self.curve.point(t), sag: 0.0 };
        middle.sag = self.fill(a, middle, None, 0, out);
        out.push(middle);
        self.fill(middle, b, None, 0, out)
    }

    /// Whether the curve may bend one way and the other.
    fn is_general(&self) -> bool {
        !matches!(
            self.curve,
            Curve::Line { .. } | Curve::Circle { .. } | Curve::Ellipse { .. } | Curve::Polyline(_)
        )
    }

    /// Parameters that every polyline of this edge has, from the edge's start to its end.
    fn start_parameters(&self) -> Vec<f64> {
        let range = self.range;
        let mut out = Vec::new();
        let breaks = self.curve.breakpoints(range);
        for pair in breaks.windows(2) {
            let count = self.start_count(Interval::new(pair[0], pair[1]));
            let piece = Interval::new(pair[0], pair[1]);
            out.extend((0..count).map(|i| piece.at(i as f64 / count as f64)));
        }
        out.push(range.end);
        if out.len() == 1 {
            out.insert(0, range.start);
        }
        self.add_singular_points(&mut out);
        if !self.same_sense {
            out.reverse();
        }
        out
    }

    /// Equal steps that a smooth piece starts with; more follow where they are needed.
    fn start_count(&self, piece: Interval) -> usize {
        let turns = |radius: f64| {
            (piece.length() / self.tolerance.arc_step_rad(radius) - 1e-9).ceil().max(1.0) as usize
        };
        match self.curve {
            Curve::Line { .. } | Curve::Polyline(_) => 1,
            Curve::Circle { radius, .. } => turns(*radius),
            Curve::Ellipse { major, minor, .. } => turns(major.max(*minor)).max(4),
            Curve::Nurbs(nurbs) if nurbs.degree() == 1 => 1,
            _ if self.closed => 4,
            _ => 1,
        }
    }

    /// A polyline must not jump over a pole: it is where the parameters of the surface turn over.
    fn add_singular_points(&self, parameters: &mut Vec<f64>) {
        let Self { curve, range, .. } = self;
        for &point in &self.singular {
            let foot = curve.project(point, None);
            if foot.distance > self.snap {
                continue;
            }
            let t = match curve.period() {
                Some(period) => foot.t + ((range.start - foot.t) / period).ceil() * period,
                None => foot.t,
            };
            let margin = range.length() * 1e-6;
            if t > range.start + margin && t < range.end - margin {
                let at = parameters.partition_point(|&p| p < t);
                let gap = parameters.get(at).copied().unwrap_or(range.end) - parameters[at.saturating_sub(1)];
                let near = |p: Option<&f64>| p.is_some_and(|p| (p - t).abs() < gap * 1e-3);
                if near(parameters.get(at)) && at + 1 < parameters.len() {
                    parameters[at] = t;
                } else if near(parameters.get(at.wrapping_sub(1))) && at > 1 {
                    parameters[at - 1] = t;
                } else {
                    parameters.insert(at, t);
                }
            }
        }
    }

    /// What remains of a line when points are dropped that a curve of many short spans has for its knots' sake alone.
    pub fn thinned(&self, line: &[LinePoint]) -> Vec<usize> {
        if line.len() < 3
            || matches!(self.curve, Curve::Line { .. } | Curve::Circle { .. } | Curve::Ellipse { .. })
        {
            return (0..line.len()).collect();
        }
        let mut kept = vec![0];
        let mut at = 0;
        let last = line.len() - 1;
        let most = (last / if self.closed { 4 } else { 1 }).min(LONGEST_RUN);
        while at < last {
            let spans = |run: usize| at + run <= last && self.spans(&line[at..=at + run]);
            at += longest(most, spans);
            kept.push(at);
        }
        kept
    }

    /// Whether one chord may stand for all of `run`, with what lies between its points.
    fn spans(&self, run: &[LinePoint]) -> bool {
        let (Some(a), Some(b)) = (run.first(), run.last()) else { return false };
        let Some(along) = (b.point - a.point).try_normalize() else { return false };
        let inner = &run[1..run.len() - 1];
        let off = |p: &LinePoint| (p.point - a.point).reject_from_normalized(along).length();
        let near = |pair: &[LinePoint]| {
            let off = off(&pair[0]).max(off(&pair[1]));
            off <= self.tolerance.linear_mm * 0.5 && off + pair[1].sag <= self.tolerance.linear_mm
        };
        let straight = |pair: &[LinePoint]| {
            !turns_by_more(pair[1].point - pair[0].point, along, self.tolerance.angular_rad * 0.45)
        };
        !inner.iter().any(|p| self.is_singular(p.point))
            && run.windows(2).all(near)
            && run.windows(2).all(straight)
    }

    /// Whether a point is a singular one of a surface.
    fn is_singular(&self, point: DVec3) -> bool {
        self.singular.iter().any(|s| s.distance(point) <= self.snap)
    }

    /// Adds the points strictly between `a` and `b`. Gives how far the curve is from the chord that ends at `b`.
    /// `middle` is the curve's point halfway, where that is known.
    fn fill(
        &self,
        a: LinePoint,
        b: LinePoint,
        middle: Option<DVec3>,
        depth: u32,
        out: &mut Vec<LinePoint>,
    ) -> f64 {
        if depth >= MAX_DEPTH || !(a.t - b.t).abs().is_normal() {
            return 0.0;
        }
        let t = (a.t + b.t) * 0.5;
        let point = middle.unwrap_or_else(|| self.curve.point(t));
        let mut quarters = None;
        if let Some(sag) = self.accepted(&a, &b, point, &mut quarters) {
            return sag;
        }
        let mut middle = LinePoint { t, point, sag: 0.0 };
        middle.sag = self.fill(a, middle, quarters.map(|q| q[0]), depth + 1, out);
        out.push(middle);
        self.fill(middle, b, quarters.map(|q| q[1]), depth + 1, out)
    }

    /// How far the curve is from its chord; `None` where that is too much, or the curve turns too far. Gives the curve's
    /// points at the `quarters` where it has asked for them.
    fn accepted(
        &self,
        a: &LinePoint,
        b: &LinePoint,
        middle: DVec3,
        quarters: &mut Option<[DVec3; 2]>,
    ) -> Option<f64> {
        let chord = b.point - a.point;
        let length = (middle - a.point).length() + (b.point - middle).length();
        if length <= self.tolerance.shortest_chord_mm() {
            return Some(length);
        }
        // The chords of the two halves turn by half as much as the tangents at the ends do.
        let most = 0.5 * self.tolerance.angular_rad * 1.001;
        if !matches!(self.curve, Curve::Line { .. })
            && turns_by_more(middle - a.point, b.point - middle, most)
        {
            return None;
        }
        let sag = match self.curve {
            Curve::Line { .. } => 0.0,
            _ if self.is_general() => {
                let at = |share: f64| self.curve.point(a.t + (b.t - a.t) * share);
                let [first, last] = *quarters.insert([at(0.25), at(0.75)]);
                sag(a.point, chord, [first, middle, last])
            }
            _ => off_chord(a.point, chord, middle).length(),
        };
        (sag <= self.tolerance.linear_mm).then_some(sag)
    }
}

/// The largest number that `holds`, up to `most`, by doubling and halving: of larger ones than one that does not hold, none
/// does. One holds always.
fn longest(most: usize, holds: impl Fn(usize) -> bool) -> usize {
    let mut good = 1;
    while good * 2 <= most && holds(good * 2) {
        good *= 2;
    }
    let mut step = good / 2;
    if good * 2 > most {
        step = (most - good).next_power_of_two();
    }
    while step > 0 {
        if good + step <= most && holds(good + step) {
            good += step;
        }
        step /= 2;
    }
    good
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use trimloop_geom::{Frame, NurbsCurve};

    /// A cubic through a helix' points, of many short spans.
    fn helix(spans: usize) -> Curve {
        let at = |k: f64| {
            let angle = TAU * k / spans as f64;
            DVec3::new(10.0 * angle.cos(), 10.0 * angle.sin(), k / spans as f64)
        };
        let mut knots = vec![0.0; 3];
        knots.extend((0..=spans).map(|k| k as f64));
        knots.extend([spans as f64; 3]);
        let mut points = vec![at(0.0), at(1.0 / 3.0)];
        points.extend((1..spans).map(|k| at(k as f64)));
        points.extend([at(spans as f64 - 1.0 / 3.0), at(spans as f64)]);
        Curve::Nurbs(NurbsCurve::new(3, points, Vec::new(), knots).expect("a curve"))
    }

    fn polyline(curve: &Curve, range: Interval, tolerance: Tolerance) -> Vec<LinePoint> {
        let ends = [curve.point(range.start), curve.point(range.end)];
        let (same_sense, closed, singular, snap) = (true, false, Vec::new(), 0.0);
        let line = CurveLine { curve, range, same_sense, ends, closed, singular, snap, tolerance };
        let points = line.points();
        line.thinned(&points).into_iter().map(|k| points[k]).collect()
    }

    #[test]
    fn many_short_spans_become_few_chords_that_keep_the_tolerance() {
        let tolerance = Tolerance { linear_mm: 0.01, angular_rad: 0.2 };
        let (curve, range) = (helix(500), Interval::new(0.0, 500.0));
        let line = polyline(&curve, range, tolerance);
        // An arc of this radius and both bounds takes 70 chords.
        assert!((70..150).contains(&line.len()), "{} points", line.len());
        for pair in line.windows(2) {
            let chord = pair[1].point - pair[0].point;
            let within = Interval::new(pair[0].t, pair[1].t);
            let offs = (0..=50).map(|k| {
                let point = curve.point(within.at(f64::from(k) / 50.0));
                off_chord(pair[0].point, chord, point).length()
            });
            let most = offs.fold(0.0, f64::max);
            assert!(most <= tolerance.linear_mm, "{most} at {}", pair[0].t);
            let [first, last] = [pair[0].t, pair[1].t].map(|t| curve.derivatives(t)[1]);
            assert!(first.angle_between(last) <= tolerance.angular_rad);
        }
    }

    #[test]
    fn a_straight_spline_is_one_chord_and_an_s_is_more() {
        let tolerance = Tolerance { linear_mm: 0.01, angular_rad: 0.2 };
        let spline = |heights: [f64; 4]| {
            let points = (0..4).map(|k| DVec3::new(f64::from(k), heights[k as usize], 0.0)).collect();
            let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
            Curve::Nurbs(NurbsCurve::new(3, points, Vec::new(), knots).expect("a curve"))
        };
        let count = |heights| polyline(&spline(heights), Interval::new(0.0, 1.0), tolerance).len();
        assert_eq!(count([0.0, 1.0, 2.0, 3.0]), 2);
        // Its middle lies on the chord.
        assert!(count([0.0, 1.0, -1.0, 0.0]) > 8);
    }

    #[test]
    fn a_vertex_beside_its_curve_leaves_the_rest_of_the_curve_alone() {
        let points = (0..4).map(|k| DVec3::X * f64::from(k) * 10.0).collect();
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let curve = Curve::Nurbs(NurbsCurve::new(3, points, Vec::new(), knots).expect("a curve"));
        let line = CurveLine {
            curve: &curve,
            range: Interval::new(0.0, 1.0),
            same_sense: true,
            ends: [DVec3::Y, DVec3::X * 30.0],
            closed: false,
            singular: Vec::new(),
            snap: 0.0,
            tolerance: Tolerance { linear_mm: 0.1, angular_rad: 0.5 },
        };
        let points = line.points();
        let kept: Vec<DVec3> = line.thinned(&points).into_iter().map(|k| points[k].point).collect();
        // The chord that ends at the vertex is short, and the next ones are on the curve.
        assert!(kept[1].x < 5.0 && kept[1].y == 0.0, "{kept:?}");
    }

    #[test]
    fn points_that_must_not_be_jumped_over_stay() {
        let (curve, range) = (helix(300), Interval::new(0.0, 300.0));
        let pole = curve.point(123.4);
        let line = CurveLine {
            curve: &curve,
            range,
            same_sense: false,
            ends: [curve.point(300.0), curve.point(0.0)],
            closed: false,
            singular: vec![pole],
            snap: 1e-9,
            tolerance: Tolerance { linear_mm: 1.0, angular_rad: 1.0 },
        };
        let points = line.points();
        let kept: Vec<DVec3> = line.thinned(&points).into_iter().map(|k| points[k].point).collect();
        assert!(kept.len() < 30 && kept.iter().any(|p| p.distance(pole) <= 1e-9));
        assert_eq!((kept[0], kept[kept.len() - 1]), (line.ends[0], line.ends[1]));
    }

    #[test]
    fn circles_are_cut_evenly() {
        let circle = Curve::Circle { frame: Frame::WORLD, radius: 5.0 };
        let tolerance = Tolerance { linear_mm: 1.0, angular_rad: TAU / 12.0 };
        assert_eq!(polyline(&circle, Interval::new(0.0, TAU / 2.0), tolerance).len(), 7);
    }

    #[test]
    fn the_longest_run_is_found() {
        for most in 1..70 {
            for limit in 1..70 {
                assert_eq!(longest(most, |n| n <= limit), limit.min(most), "{limit} of {most}");
            }
        }
    }
}
