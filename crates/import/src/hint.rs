//! Curves in a surface's parameters as hints of where the points of an edge lie on it.

use trimloop_geom::{Curve, Interval};

/// The curve over `from` as one over `to`, run the other way where it is `turned`; `None` for curves that cannot be
/// written so, which is no loss: they are hints.
pub(crate) fn over(curve: &Curve, from: Interval, to: Interval, turned: bool) -> Option<Curve> {
    if !(from.length() > 0.0 && to.length() > 0.0) {
        return None;
    }
    let moved = |t: f64| {
        let share = (t - from.start) / from.length();
        to.at(if turned { 1.0 - share } else { share })
    };
    if from == to && !turned {
        return Some(curve.clone());
    }
    match curve {
        Curve::Line { direction, .. } => {
            let rate = if turned { -from.length() / to.length() } else { from.length() / to.length() };
            let direction = *direction * rate;
            let start = curve.point(if turned { from.end } else { from.start });
            Some(Curve::Line { origin: start - direction * to.start, direction })
        }
        Curve::Nurbs(nurbs) => {
            let domain = nurbs.domain();
            let ends = [moved(domain.start), moved(domain.end)];
            let nurbs = if turned { nurbs.reversed() } else { nurbs.clone() };
            let range = Interval::new(ends[0].min(ends[1]), ends[0].max(ends[1]));
            nurbs.reparametrized(range).ok().map(Curve::Nurbs)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use trimloop_geom::NurbsCurve;

    use super::*;

    #[test]
    fn a_curve_keeps_its_points_over_another_range() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(2.0, 1.0, 0.0), DVec3::new(2.0, 3.0, 0.0)];
        let spline = NurbsCurve::new(2, points, Vec::new(), vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]).unwrap();
        let line = Curve::Line { origin: DVec3::ONE, direction: DVec3::new(2.0, -1.0, 0.0) };
        let (from, to) = (Interval::new(0.5, 1.75), Interval::new(-3.0, 9.0));
        for curve in [Curve::Nurbs(spline), line] {
            for turned in [false, true] {
                let moved = over(&curve, from, to, turned).unwrap();
                for share in [0.0, 0.2, 0.7, 1.0] {
                    let own = curve.point(from.at(if turned { 1.0 - share } else { share }));
                    assert!(moved.point(to.at(share)).distance(own) < 1e-12, "{curve:?} {turned}");
                }
            }
        }
    }
}
