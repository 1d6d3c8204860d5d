//! Knot insertion, degree elevation, Bézier extraction, restriction and reversal keep the points; published examples.

mod specimens;

use proptest::prelude::*;
use specimens::{closed_spline, knots, sheet, spline, tube};
use trimloop_geom::{DVec2, DVec3, Direction, Interval, NurbsCurve, NurbsError, NurbsSurface};

fn curves() -> Vec<NurbsCurve> {
    let unclamped = NurbsCurve::new(
        3,
        (0..7).map(|i| DVec3::new(f64::from(i), specimens::noise(i as usize), 0.0)).collect(),
        vec![1.0, 2.0, 0.5, 1.0, 3.0, 1.0, 1.0],
        vec![-1.0, 0.0, 0.5, 1.0, 1.0, 2.0, 4.0, 5.0, 5.5, 7.0, 8.0],
    );
    vec![
        spline(1, 3, false),
        spline(2, 4, true),
        spline(3, 5, false),
        spline(5, 2, true),
        spline(9, 2, false),
        closed_spline(),
        unclamped.unwrap(),
    ]
}

fn sheets() -> Vec<NurbsSurface> {
    vec![sheet([3, 2], [3, 4], false), sheet([1, 4], [2, 2], true), sheet([5, 3], [1, 2], true), tube()]
}

fn assert_same_curve(a: &NurbsCurve, b: &NurbsCurve, range: Interval, what: &str) {
    for i in 0..=40 {
        let t = range.at(f64::from(i) / 40.0);
        let gap = a.point(t).distance(b.point(t));
        assert!(gap <= 1e-12 * (1.0 + a.size()), "{what}: {gap} at {t} of degree {}", a.degree());
    }
}

fn assert_same_surface(a: &NurbsSurface, b: &NurbsSurface, domain: [Interval; 2], what: &str) {
    for i in 0..=12 {
        for j in 0..=12 {
            let uv = DVec2::new(domain[0].at(f64::from(i) / 12.0), domain[1].at(f64::from(j) / 12.0));
            let gap = a.point(uv).distance(b.point(uv));
            assert!(gap <= 1e-12 * (1.0 + a.size()), "{what}: {gap} at {uv}");
        }
    }
}

/// Piegl & Tiller, example 5.1: p = 3, U = {0,0,0,0,1,2,3,4,5,5,5,5}, u = 5/2 inserted once: Q3, Q4, Q5 lie 5/6, 1/2 and
/// 1/6 of the way along their legs.
#[test]
fn published_knot_insertion() {
    let points: Vec<DVec3> = (0..8).map(|i| DVec3::new(f64::from(i), (i as f64).powi(2), 0.0)).collect();
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0];
    let curve = NurbsCurve::new(3, points.clone(), vec![], knots).unwrap();
    let refined = curve.with_knot(2.5, 1);
    assert_eq!(refined.knots(), [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 5.0, 5.0, 5.0]);
    for (index, share) in [(3, 5.0 / 6.0), (4, 0.5), (5, 1.0 / 6.0)] {
        let expected = points[index] * share + points[index - 1] * (1.0 - share);
        assert!(refined.points()[index].distance(expected) < 1e-14);
    }
    assert_eq!(refined.points()[..3], points[..3]);
    assert_eq!(refined.points()[6..], points[5..]);
}

/// Piegl & Tiller, example 4.1: weights {1,4,1,1,1}, knots {0,0,0,1,2,3,3,3}, points (0,0) (1,1) (3,2) (4,1) (5,-1):
/// C(1) = (7/5, 6/5).
#[test]
fn published_rational_point() {
    let points = [(0.0, 0.0), (1.0, 1.0), (3.0, 2.0), (4.0, 1.0), (5.0, -1.0)];
    let points = points.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let knots = vec![0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
    let curve = NurbsCurve::new(2, points, vec![1.0, 4.0, 1.0, 1.0, 1.0], knots).unwrap();
    assert!(curve.point(1.0).distance(DVec3::new(1.4, 1.2, 0.0)) < 1e-15);
}

/// A Bézier curve's elevated points are known in closed form (Piegl & Tiller eq. 5.36).
#[test]
fn elevation_of_a_bezier_curve_is_the_closed_form() {
    let curve = spline(3, 1, false);
    let (raised, own) = (curve.elevated(1), curve.points());
    assert_eq!(raised.degree(), 4);
    for i in 0..=4 {
        let share = i as f64 / 4.0;
        let previous = if i == 0 { DVec3::ZERO } else { own[i - 1] };
        let next = if i == 4 { DVec3::ZERO } else { own[i] };
        assert!(raised.points()[i].distance(previous * share + next * (1.0 - share)) < 1e-14);
    }
}

#[test]
fn elevation_keeps_curves() {
    for curve in curves() {
        for times in 1..=3 {
            let raised = curve.elevated(times);
            assert_eq!(raised.degree(), curve.degree() + times);
            assert_same_curve(&curve, &raised, curve.domain(), "elevated");
        }
    }
}

#[test]
fn bezier_pieces_are_the_curve() {
    for curve in curves() {
        let pieces = curve.bezier_pieces();
        assert_eq!(pieces.len(), curve.distinct_knots().len() - 1);
        for piece in pieces {
            for s in [0.0, 0.3, 0.8, 1.0] {
                assert!(piece.point(s).distance(curve.point(piece.range.at(s))) < 1e-12 * curve.size());
            }
        }
    }
}

#[test]
fn reversed_curves_run_backwards() {
    for curve in curves() {
        let (back, domain) = (curve.reversed(), curve.domain());
        for s in [0.0, 0.2, 0.7, 1.0] {
            assert!(
                back.point(domain.at(s)).distance(curve.point(domain.at(1.0 - s))) < 1e-12 * curve.size()
            );
        }
    }
}

#[test]
fn a_closed_curve_is_cut_across_its_seam() {
    let curve = closed_spline();
    let domain = curve.domain();
    let across = Interval::new(domain.at(0.7), domain.at(1.4));
    let part = curve.restricted(across).unwrap();
    assert_eq!(part.domain(), across);
    assert_same_curve(&part, &curve, across, "across the seam");
    let before = Interval::new(domain.at(-1.6), domain.at(-0.6));
    assert_same_curve(&curve.restricted(before).unwrap(), &curve, before, "a whole period before");
}

#[test]
fn a_closed_surface_is_cut_across_its_seam() {
    let surface = tube();
    let [u, v] = surface.domain();
    let part = [Interval::new(u.at(0.6), u.at(1.3)), Interval::new(v.at(0.1), v.at(0.9))];
    let cut = surface.restricted(part).unwrap();
    assert_eq!(cut.domain(), part);
    assert_same_surface(&cut, &surface, part, "across the seam");
}

#[test]
fn a_jump_in_a_curve_stays() {
    let knots = vec![0.0, 0.0, 1.0, 1.0, 2.0, 2.0];
    let points = [0.0, 1.0, 5.0, 6.0].map(|x| DVec3::new(x, 0.0, 0.0)).to_vec();
    let curve = NurbsCurve::new(1, points, vec![], knots).unwrap();
    for same in
        [curve.refined(&[0.5, 1.0, 1.5]), curve.elevated(2), curve.restricted(curve.domain()).unwrap()]
    {
        assert_same_curve(&curve, &same, curve.domain(), "with a jump");
        assert_eq!(same.point(1.0 - 1e-12).x.round(), 1.0);
        assert_eq!(same.point(1.0).x, 5.0);
    }
}

#[test]
fn surfaces_are_kept() {
    for surface in sheets() {
        let domain = surface.domain();
        for direction in [Direction::U, Direction::V] {
            let d = direction as usize;
            let new = [0.1, 0.1, 0.35, 0.9].map(|s| domain[d].at(s));
            assert_same_surface(&surface, &surface.refined(direction, &new), domain, "refined");
            let raised = surface.elevated(direction, 2);
            assert_eq!(raised.degrees()[d], surface.degrees()[d] + 2);
            assert_same_surface(&surface, &raised, domain, "elevated");
            assert_same_surface(
                &surface,
                &surface.reversed(direction).reversed(direction),
                domain,
                "reversed twice",
            );
        }
        let part = domain.map(|d| Interval::new(d.at(0.13), d.at(0.78)));
        assert_same_surface(&surface, &surface.restricted(part).unwrap(), part, "restricted");
    }
}

#[test]
fn bezier_patches_are_the_surface() {
    for surface in sheets() {
        let grid = surface.bezier_patches();
        assert_eq!(grid.patches.len(), grid.rows * grid.columns);
        for patch in grid.patches {
            for (s, t) in [(0.0, 0.0), (0.3, 0.6), (1.0, 0.5), (1.0, 1.0)] {
                let uv = DVec2::new(patch.domain[0].at(s), patch.domain[1].at(t));
                assert!(patch.point(s, t).distance(surface.point(uv)) < 1e-12 * surface.size());
            }
        }
    }
}

#[test]
fn isocurves_and_transposes_lie_on_the_surface() {
    for surface in sheets() {
        let [u, v] = surface.domain();
        let turned = surface.transposed();
        for s in [0.0, 0.37, 1.0] {
            let along_v = surface.isocurve(Direction::U, u.at(s)).unwrap();
            let along_u = surface.isocurve(Direction::V, v.at(s)).unwrap();
            for t in [0.0, 0.5, 0.9, 1.0] {
                let point = surface.point(DVec2::new(u.at(s), v.at(t)));
                assert!(along_v.point(v.at(t)).distance(point) < 1e-12 * surface.size());
                assert!(turned.point(DVec2::new(v.at(t), u.at(s))).distance(point) < 1e-12 * surface.size());
                let point = surface.point(DVec2::new(u.at(t), v.at(s)));
                assert!(along_u.point(u.at(t)).distance(point) < 1e-12 * surface.size());
            }
        }
    }
}

#[test]
fn closed_directions_and_point_sides_are_found() {
    let surface = tube();
    assert_eq!(surface.periods()[1], None);
    assert!(surface.periods()[0].is_some());
    let poles = surface.singularities();
    assert_eq!(poles.len(), 1);
    assert_eq!((poles[0].constant, poles[0].at), (Direction::V, surface.domain()[1].start));
    assert_eq!(sheet([3, 3], [2, 2], false).periods(), [None, None]);
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let points = |n: usize| (0..n).map(|i| DVec3::splat(i as f64)).collect::<Vec<_>>();
    let says = |result: Result<NurbsCurve, NurbsError>, words: &str| {
        let text = result.err().map(|e| e.to_string()).unwrap_or_default();
        assert!(text.contains(words), "{text:?} does not say {words:?}");
    };
    says(NurbsCurve::new(0, points(4), vec![], knots(3, 1)), "degree 0");
    says(NurbsCurve::new(usize::MAX, points(4), vec![], knots(3, 1)), "degree 18446744073709551615");
    says(NurbsCurve::new(3, points(3), vec![], knots(3, 1)), "3 control points");
    says(NurbsCurve::new(3, points(4), vec![], vec![0.0; 7]), "7 knots");
    says(NurbsCurve::new(3, points(4), vec![], vec![1.0; 8]), "no usable length");
    says(NurbsCurve::new(1, points(2), vec![], vec![0.0, 0.0, f64::NAN, 1.0]), "knot 2 is NaN");
    says(
        NurbsCurve::new(1, points(2), vec![], vec![0.0, 0.0, -1.0, 1.0]),
        "decrease from 0 to -1 at index 2",
    );
    says(NurbsCurve::new(1, points(2), vec![1.0], knots(1, 1)), "1 weights for 2");
    says(NurbsCurve::new(1, points(2), vec![1.0, -2.0], knots(1, 1)), "weight 1 is -2");
    says(NurbsCurve::new(1, vec![DVec3::NAN, DVec3::ZERO], vec![], knots(1, 1)), "control point 0");
    let surface = NurbsSurface::new([1, 1], usize::MAX, 2, points(4), vec![], [knots(1, 1), knots(1, 1)]);
    assert!(surface.unwrap_err().to_string().contains("do not fill"));
    // Rounding in a knot vector is made level.
    let level = NurbsCurve::new(1, points(3), vec![], vec![0.0, 0.0, 0.5, 0.5 - 1e-12, 1.0]);
    assert!(level.is_ok());
}

proptest! {
    #![proptest_config(specimens::cases(100))]

    #[test]
    fn any_knots_may_be_inserted(shares in prop::collection::vec(0.0..=1.0_f64, 1..12)) {
        for curve in curves() {
            let new: Vec<f64> = shares.iter().map(|&s| curve.domain().at(s)).collect();
            assert_same_curve(&curve, &curve.refined(&new), curve.domain(), "refined");
        }
    }

    #[test]
    fn any_part_may_be_cut_out(a in 0.0..1.0_f64, b in 0.0..1.0_f64) {
        prop_assume!((a - b).abs() > 1e-6);
        for curve in curves() {
            let range = Interval::new(curve.domain().at(a.min(b)), curve.domain().at(a.max(b)));
            let part = curve.restricted(range).unwrap();
            prop_assert_eq!(part.domain(), range);
            assert_same_curve(&part, &curve, range, "restricted");
        }
    }
}
