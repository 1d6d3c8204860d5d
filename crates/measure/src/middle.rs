//! Where a whole set of places is nearest (parallel planes, cylinders of one axis), the middle of that set.

use glam::{DVec2, DVec3};
use trimloop_geom::{Curve, Surface};

use crate::element::Element;
use crate::sampled::Sampled;
use crate::search::{Candidate, search};
use crate::simplex::Simplex;

/// Places that are tried, all over each item.
const TRIES: usize = 96;

/// Descents for each of them.
const BUDGET: usize = 6;

/// The middle of the places that are as near as `best`; `best` where there is only one.
pub(crate) fn centred(a: &Sampled, b: &Sampled, best: Candidate) -> Candidate {
    // Areas first: faces that are side by side have edges that are as well.
    let start = by_samples(a, b, &best, 2);
    let slid = by_sliding(a, b, start.unwrap_or(best));
    slid.or(start).or_else(|| by_samples(a, b, &best, 1)).unwrap_or(best)
}

fn by_samples(a: &Sampled, b: &Sampled, best: &Candidate, dimensions: usize) -> Option<Candidate> {
    middle_of(a, b, best, dimensions, 0).or_else(|| {
        let mut found = middle_of(b, a, best, dimensions, 1)?;
        found.points.swap(0, 1);
        found.elements.swap(0, 1);
        Some(found)
    })
}

/// Halvings of a way that is sought the end of.
const HALVINGS: usize = 32;

/// The middle of the straight lines of nearest places, where there are any: along edges and rulings, and both ways of
/// planes, one after the other.
fn by_sliding(a: &Sampled, b: &Sampled, best: Candidate) -> Option<Candidate> {
    let size = a.tree.bounds().diagonal().min(b.tree.bounds().diagonal());
    if !best.is_exact || !(size > 0.0) {
        return None;
    }
    let reach = 1e-6 * size;
    let mut ways = directions(a, best.points[0], reach);
    ways.extend(directions(b, best.points[1], reach));
    let mut found = None;
    for (k, way) in ways.iter().enumerate() {
        let is_known = ways[..k].iter().any(|other| other.cross(*way).length() < 1e-9);
        if !is_known {
            found = slide(a, b, &found.unwrap_or(best), *way, size, reach).or(found);
        }
    }
    found
}

/// The middle of the nearest places along a line through the best; `None` where there are no others.
fn slide(a: &Sampled, b: &Sampled, best: &Candidate, way: DVec3, size: f64, reach: f64) -> Option<Candidate> {
    let [p, q] = best.points;
    let slack = 1e-3 * reach + 1e-9 * best.distance;
    let pair_at = |shift: DVec3| {
        let foot = search(&Sampled::of_point(p + shift), a, BUDGET)?;
        let found = search(&Sampled::of_point(foot.points[1]), b, BUDGET)?;
        let delta = found.points[1] - found.points[0];
        let is_same = foot.distance <= 1e-3 * reach && delta.distance(q - p) <= slack;
        is_same.then_some(found)
    };
    let end = |way: DVec3| {
        // Nothing slides at all in most directions, which ends here.
        if pair_at(way * (10.0 * reach)).is_none() {
            return 0.0;
        }
        let (mut low, mut high) = (0.0, size);
        for _ in 0..HALVINGS {
            let middle = (low + high) * 0.5;
            if pair_at(way * middle).is_some() { low = middle } else { high = middle }
        }
        low
    };
    let (ahead, behind) = (end(way), end(-way));
    if ahead + behind <= 10.0 * reach {
        return None;
    }
    let found = pair_at(way * ((ahead - behind) * 0.5))?;
    Some(Candidate { points: found.points, ..*best })
}

/// Directions in which straight lines of the item run through a point: those of its edges and its rulings.
fn directions(item: &Sampled, point: DVec3, reach: f64) -> Vec<DVec3> {
    let through = candidates(item, point, 1, reach);
    let of_edges = through.iter().filter_map(|&e| match &item.elements[e as usize] {
        Element::Curve { curve, map, .. } => match **curve {
            Curve::Line { direction, .. } => Some(map.transform_vector3(direction)),
            _ => None,
        },
        _ => None,
    });
    let of_surfaces = item.elements.iter().flat_map(|element| match element {
        Element::Surface { surface, map, .. } => match **surface {
            Surface::Plane { ref frame } => [frame.x, frame.y].map(|way| map.transform_vector3(way)),
            Surface::Cylinder { ref frame, .. } => [map.transform_vector3(frame.z), DVec3::ZERO],
            Surface::Extrusion { direction, .. } => [map.transform_vector3(direction), DVec3::ZERO],
            Surface::Cone { ref frame, radius, half_angle_rad } => {
                let apex = frame.origin - frame.z * (radius / half_angle_rad.tan());
                [point - map.transform_point3(apex), DVec3::ZERO]
            }
            _ => [DVec3::ZERO; 2],
        },
        _ => [DVec3::ZERO; 2],
    });
    of_edges.chain(of_surfaces).filter_map(DVec3::try_normalize).collect()
}

/// The middle of the places of `from` on elements of `dimensions` parameters that are as far from `to` as the best;
/// `None` where there are not two.
fn middle_of(
    from: &Sampled,
    to: &Sampled,
    best: &Candidate,
    dimensions: usize,
    side: usize,
) -> Option<Candidate> {
    let size = from.tree.bounds().diagonal().min(to.tree.bounds().diagonal());
    let slack = 1e-9 * best.distance + 1e-10 * size;
    let elements = candidates(from, best.points[side], dimensions, 1e-6 * size);
    let is_tied = |found: &Candidate| found.is_exact && (found.distance - best.distance).abs() <= slack;
    for element in elements {
        let mut tied: Vec<(Candidate, f64)> = Vec::new();
        for (point, weight) in places(from, element) {
            let Some(found) = search(&Sampled::of_point(point), to, BUDGET) else { continue };
            if is_tied(&found) {
                tied.push((found, weight));
            }
        }
        let weight: f64 = tied.iter().map(|(_, weight)| weight).sum();
        if tied.len() < 2 || !(weight > 0.0) {
            continue;
        }
        let mean = tied.iter().map(|(found, w)| found.points[0] * (w / weight)).sum::<DVec3>();
        let at_mean = search(&Sampled::of_point(mean), from, BUDGET)
            .and_then(|foot| search(&Sampled::of_point(foot.points[1]), to, BUDGET))
            .filter(is_tied);
        let away = |found: &Candidate| found.points[0].distance_squared(mean);
        let nearest = tied.iter().map(|(found, _)| *found).min_by(|x, y| away(x).total_cmp(&away(y)));
        let found = at_mean.or(nearest)?;
        return Some(Candidate { distance: best.distance, is_exact: best.is_exact, ..found });
    }
    None
}

/// The surface, or the curves through a point.
fn candidates(item: &Sampled, point: DVec3, dimensions: usize, reach: f64) -> Vec<u32> {
    let own = |element: u32| item.elements[element as usize].dimensions() == dimensions;
    if dimensions == 2 {
        let is_surface = |e: &u32| matches!(item.elements[*e as usize], Element::Surface { .. });
        return (0..item.elements.len() as u32).filter(is_surface).take(1).collect();
    }
    let mut found: Vec<u32> = item
        .tree
        .simplices
        .iter()
        .filter(|s| own(s.element))
        .filter(|s| {
            let at = Simplex::point(point, 0);
            crate::simplex::nearest(s, &at).distance <= reach + item.slack[s.element as usize]
        })
        .map(|s| s.element)
        .collect();
    found.sort_unstable();
    found.dedup();
    found.truncate(8);
    found
}

/// Places all over an element, inside the item, each with what it counts for.
fn places(item: &Sampled, element: u32) -> Vec<(DVec3, f64)> {
    let own: Vec<&Simplex> = item.tree.simplices.iter().filter(|s| s.element == element).collect();
    if own.is_empty() {
        return Vec::new();
    }
    let stride = own.len().div_ceil(TRIES);
    let parts = (TRIES / own.len()).max(1);
    let mut out = Vec::new();
    for simplex in own.into_iter().step_by(stride) {
        let shares = shares(simplex.count, parts);
        let weight = simplex.measure() / shares.len() as f64;
        for share in shares {
            let at: DVec2 = simplex.parameters_at(share);
            if item.contains(element, at) {
                out.push((item.elements[element as usize].point(at), weight));
            }
        }
    }
    out
}

/// Weights of the middles of at most `parts` equal parts of a segment or triangle.
fn shares(count: u8, parts: usize) -> Vec<[f64; 3]> {
    if count == 2 {
        let share = |k: usize| (k as f64 + 0.5) / parts as f64;
        return (0..parts).map(share).map(|s| [1.0 - s, s, 0.0]).collect();
    }
    // n rows give n² small triangles, in pairs that point up and down.
    let n = (parts as f64).sqrt().floor().max(1.0) as usize;
    let mut out = Vec::new();
    let third = 1.0 / (3.0 * n as f64);
    for i in 0..n {
        for j in 0..n - i {
            let mut add = |x: f64, y: f64| out.push([1.0 - x - y, x, y]);
            let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
            add(x + third, y + third);
            if i + j + 1 < n {
                add(x + 2.0 * third, y + 2.0 * third);
            }
        }
    }
    out
}
