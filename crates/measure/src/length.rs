//! Exact lengths of curves.

use glam::DAffine3;
use trimloop_brep::{Edge, Face, Part};
use trimloop_geom::{Curve, Interval};

/// Relative error that the length of an edge is sought to.
pub(crate) const RELATIVE_ERROR: f64 = 1e-10;

/// Points and weights of Gauss' and Legendre's rule of ten points over -1..1, positive half (Abramowitz & Stegun 25.4.30).
const RULE: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_05),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Halvings for one edge. Cusps, at which the speed is not smooth, take some forty.
const MOST_HALVINGS: usize = 5000;

/// The length of an edge in the world.
pub(crate) fn edge_length(edge: &Edge, map: &DAffine3) -> f64 {
    let Edge { curve, range, .. } = edge;
    match &**curve {
        Curve::Line { direction, .. } => map.transform_vector3(*direction).length() * range.length().abs(),
        curve => {
            let speed = |t: f64| map.transform_vector3(curve.derivatives(t)[1]).length();
            let spans = curve.breakpoints(*range);
            let spans: Vec<Interval> = spans.windows(2).map(|w| Interval::new(w[0], w[1])).collect();
            let whole: Vec<f64> = spans.iter().map(|span| gauss(&speed, *span)).collect();
            let tolerance = 0.1 * RELATIVE_ERROR * whole.iter().sum::<f64>();
            let mut budget = MOST_HALVINGS;
            let pairs = spans.iter().zip(&whole);
            pairs.map(|(span, &once)| halved(&speed, *span, once, tolerance, &mut budget)).sum()
        }
    }
}

/// The length of a face's boundary in the world; seams, which the face meets from both sides, are no boundary.
pub(crate) fn perimeter(part: &Part, face: &Face, map: &DAffine3) -> f64 {
    let mut edges: Vec<u32> = face.loops.iter().flat_map(|l| &l.coedges).map(|c| c.edge).collect();
    edges.sort_unstable();
    let used_once = edges.chunk_by(|a, b| a == b).filter(|run| run.len() == 1);
    used_once.filter_map(|run| part.edges.get(run[0] as usize)).map(|edge| edge_length(edge, map)).sum()
}

/// The integral, halving until both halves agree with the whole to a share of the tolerance, or the budget of halvings
/// is spent.
fn halved(speed: &impl Fn(f64) -> f64, span: Interval, once: f64, tolerance: f64, budget: &mut usize) -> f64 {
    let middle = span.at(0.5);
    let halves = [Interval::new(span.start, middle), Interval::new(middle, span.end)];
    let sums = halves.map(|half| gauss(speed, half));
    let twice = sums[0] + sums[1];
    let can_halve = *budget > 0 && span.start < middle && middle < span.end;
    if !can_halve || !((twice - once).abs() > tolerance) {
        return twice;
    }
    *budget -= 1;
    let [a, b] = [0, 1].map(|k| halved(speed, halves[k], sums[k], tolerance * 0.5, budget));
    a + b
}

fn gauss(speed: &impl Fn(f64) -> f64, span: Interval) -> f64 {
    let (middle, half) = (span.at(0.5), span.length() * 0.5);
    RULE.iter().map(|&(x, w)| w * (speed(middle - half * x) + speed(middle + half * x))).sum::<f64>() * half
}
