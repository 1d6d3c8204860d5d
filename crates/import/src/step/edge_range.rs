//! Where an edge lies on its curve.

use glam::DVec3;
use trimloop_geom::{Curve, Interval};

/// An edge's place on its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EdgeRange {
    /// The part of the curve between the vertices.
    pub range: Interval,
    /// Whether the edge runs with the curve; differs from what the file says where that cannot be.
    pub same_sense: bool,
    /// The larger distance of the two vertices from the curve's ends.
    pub gap: f64,
}

/// The part of `curve` from `start` to `end`, run with the curve if `same_sense`. `closed` edges start and end at
/// one vertex and run once around. `tolerance` is how near to a spline's end a vertex may lie to be that end.
pub(crate) fn edge_range(
    curve: &Curve,
    start: DVec3,
    end: DVec3,
    closed: bool,
    same_sense: bool,
    tolerance: f64,
) -> EdgeRange {
    if let Curve::Line { origin, direction } = curve {
        return line_range(*origin, *direction, start, end, same_sense);
    }
    let (first, last) = if same_sense { (start, end) } else { (end, start) };
    let reach = if closed { tolerance } else { tolerance.min(0.25 * first.distance(last)) };
    let ends = Ends::of(curve);
    let (mut low, low_gap) = ends.snap(curve, first, End::Start, reach);
    let (mut high, high_gap) = ends.snap(curve, last, End::End, reach);
    let gap = low_gap.max(high_gap);
    if let Some(period) = period(curve) {
        let coincident = closed || first.distance(last) <= 1e-9 * (1.0 + first.length());
        high = unwrap_around(low, high, period, coincident);
        return EdgeRange { range: Interval::new(low, high), same_sense, gap };
    }
    if closed && ends.domain.is_finite() && (high - low).abs() < 0.5 * ends.domain.length() {
        // An open curve whose ends nearly meet: the vertex stands for both.
        (low, high) = (ends.domain.start, ends.domain.end);
    }
    if low <= high {
        EdgeRange { range: Interval::new(low, high), same_sense, gap }
    } else {
        EdgeRange { range: Interval::new(high, low), same_sense: !same_sense, gap }
    }
}

/// The period of a curve; also of one that runs straight around a closed surface.
fn period(curve: &Curve) -> Option<f64> {
    let Curve::OnSurface { surface, pcurve } = curve else { return curve.period() };
    let Curve::Line { direction, .. } = **pcurve else { return curve.period() };
    let around = |along: f64, across: f64, period: Option<f64>| {
        (across.abs() <= 1e-12 * along.abs()).then(|| period.map(|period| period / along.abs()))?
    };
    let [u, v] = surface.periods();
    around(direction.x, direction.y, u).or_else(|| around(direction.y, direction.x, v))
}

/// `high` moved by whole periods into the first turn after `low`.
fn unwrap_around(low: f64, high: f64, period: f64, coincident: bool) -> f64 {
    if coincident {
        return low + period;
    }
    let turn = (high - low).rem_euclid(period);
    low + if turn > 0.0 { turn } else { period }
}

fn line_range(origin: DVec3, direction: DVec3, start: DVec3, end: DVec3, same_sense: bool) -> EdgeRange {
    let scale = direction.length_squared().recip();
    let at = |point: DVec3| (point - origin).dot(direction) * scale;
    let off = |point: DVec3, t: f64| point.distance(origin + direction * t);
    let (t_start, t_end) = (at(start), at(end));
    let gap = off(start, t_start).max(off(end, t_end));
    // The vertices alone fix the direction along a line.
    let same_sense = if t_start == t_end { same_sense } else { t_start < t_end };
    EdgeRange { range: Interval::new(t_start.min(t_end), t_start.max(t_end)), same_sense, gap }
}

#[derive(Clone, Copy, PartialEq)]
enum End {
    Start,
    End,
}

/// The ends of a curve, where it has any.
struct Ends {
    domain: Interval,
    points: Option<[DVec3; 2]>,
}

impl Ends {
    fn of(curve: &Curve) -> Self {
        let domain = curve.domain();
        let conic = matches!(curve, Curve::Circle { .. } | Curve::Ellipse { .. });
        let points =
            (!conic && domain.is_finite()).then(|| [curve.point(domain.start), curve.point(domain.end)]);
        Self { domain, points }
    }

    /// Parameter of `point` and its distance: the curve's own end where it is within reach, the wanted one first.
    fn snap(&self, curve: &Curve, point: DVec3, wanted: End, reach: f64) -> (f64, f64) {
        if let Some([at_start, at_end]) = self.points {
            let (to_start, to_end) = (point.distance(at_start), point.distance(at_end));
            let start = (to_start <= reach).then_some((self.domain.start, to_start));
            let end = (to_end <= reach).then_some((self.domain.end, to_end));
            let found = if wanted == End::Start { start.or(end) } else { end.or(start) };
            if let Some(found) = found {
                return found;
            }
        }
        let foot = curve.project(point, None);
        (foot.t, foot.distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turn_runs_forward() {
        assert_eq!(unwrap_around(3.0, 1.0, 4.0, false), 5.0);
        assert_eq!(unwrap_around(1.0, 3.0, 4.0, false), 3.0);
        assert_eq!(unwrap_around(1.0, 1.0, 4.0, true), 5.0);
    }

    #[test]
    fn line_against_its_sense_is_turned() {
        let found = line_range(DVec3::ZERO, DVec3::X * 2.0, DVec3::X * 4.0, DVec3::ZERO, true);
        assert_eq!(found.range, Interval::new(0.0, 2.0));
        assert!(!found.same_sense);
    }

    #[test]
    fn vertex_beside_the_line_is_measured() {
        let found = line_range(DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.5, 0.0), DVec3::X, true);
        assert_eq!(found.gap, 0.5);
    }
}
