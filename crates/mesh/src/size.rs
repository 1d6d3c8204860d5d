//! How large a part is.

use rayon::prelude::*;
use trimloop_brep::{Edge, FaceGeometry, Part};
use trimloop_geom::{Aabb, Curve, Interval, Surface};

/// The diagonal of the part's box, from its edges (and the surfaces of faces that have none).
pub(crate) fn size_mm(part: &Part) -> f64 {
    let mut bounds =
        Aabb::from_points(part.vertices.iter().map(|v| v.point).chain(part.facet_points.iter().copied()));
    // The box of a curve on a spline surface takes work: most of them lie well inside of what the others span.
    let (on_surface, others): (Vec<&Edge>, Vec<&Edge>) =
        part.edges.iter().partition(|edge| matches!(*edge.curve, Curve::OnSurface { .. }));
    let of_edge = |edge: &&Edge| edge.curve.bounds(edge.range);
    bounds = bounds.union(others.par_iter().map(of_edge).reduce(|| Aabb::EMPTY, Aabb::union));
    let known = bounds;
    let is_inside =
        |edge: &Edge| net_bounds(&edge.curve, edge.range).is_some_and(|bounds| known.contains(bounds));
    let beyond = on_surface.par_iter().filter(|edge| !is_inside(edge)).map(of_edge);
    bounds = bounds.union(beyond.reduce(|| Aabb::EMPTY, Aabb::union));
    for face in part.faces.iter().filter(|f| f.loops.iter().all(|l| l.coedges.is_empty())) {
        if let FaceGeometry::Surface(surface) = &face.geometry {
            let domain = surface.domain();
            if domain.iter().all(|d| d.is_finite()) {
                bounds = bounds.union(surface.bounds(domain));
            }
        }
    }
    let of_curves = part.curves.par_iter().map(|curve| curve.curve.bounds(curve.range));
    bounds = bounds.union(of_curves.reduce(|| Aabb::EMPTY, Aabb::union));
    bounds = bounds.union(Aabb::from_points(part.points.iter().map(|point| point.point)));
    let size = bounds.diagonal();
    if size.is_finite() && size > 0.0 { size } else { 1.0 }
}

/// More than the part's size: what control points span; infinite where even that is not to be had at once.
pub(crate) fn most_mm(part: &Part) -> f64 {
    let points = part.vertices.iter().map(|v| v.point).chain(part.facet_points.iter().copied());
    let mut bounds = Aabb::from_points(points.chain(part.points.iter().map(|point| point.point)));
    let net = |curve: &Curve, range: Interval| match curve {
        Curve::Nurbs(nurbs) => Aabb::from_points(nurbs.points().iter().copied()),
        _ => net_bounds(curve, range).unwrap_or_else(|| curve.bounds(range)),
    };
    for edge in &part.edges {
        bounds = bounds.union(net(&edge.curve, edge.range));
    }
    for free in &part.curves {
        bounds = bounds.union(net(&free.curve, free.range));
    }
    for face in part.faces.iter().filter(|f| f.loops.iter().all(|l| l.coedges.is_empty())) {
        match &face.geometry {
            FaceGeometry::Surface(surface) => match &**surface {
                Surface::Nurbs(nurbs) => {
                    bounds = bounds.union(Aabb::from_points(nurbs.points().iter().copied()));
                }
                _ => return f64::INFINITY,
            },
            FaceGeometry::Facets(_) | FaceGeometry::Unreadable(_) => {}
        }
    }
    bounds.diagonal()
}

/// A box around a curve that runs over a spline surface, found at once.
fn net_bounds(curve: &Curve, range: Interval) -> Option<Aabb> {
    let Curve::OnSurface { surface, pcurve } = curve else { return None };
    let Surface::Nurbs(nurbs) = &**surface else { return None };
    let Aabb { min, max } = pcurve.bounds(range);
    Some(nurbs.net_bounds([Interval::new(min.x, max.x), Interval::new(min.y, max.y)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;
    use std::sync::Arc;
    use trimloop_brep::{EntityRef, FreeCurve, Vertex};
    use trimloop_geom::{DVec3, Frame, NurbsCurve};

    #[test]
    fn what_control_points_span_is_no_less_than_the_size() {
        let spline = NurbsCurve::new(
            2,
            vec![DVec3::ZERO, DVec3::new(5.0, 40.0, 0.0), DVec3::X * 10.0],
            Vec::new(),
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
        );
        let entity = EntityRef::None;
        let edge = |curve: Curve, range| Edge {
            entity,
            start: 0,
            end: 0,
            curve: Arc::new(curve),
            range,
            same_sense: true,
        };
        let circle = Curve::Circle { frame: Frame::WORLD, radius: 3.0 };
        let mut part = Part {
            vertices: vec![Vertex { entity, point: DVec3::X * 3.0 }],
            edges: vec![edge(circle, Interval::new(0.0, TAU))],
            ..Part::default()
        };
        assert_eq!(most_mm(&part), size_mm(&part));
        part.edges.push(edge(Curve::Nurbs(spline.expect("a curve")), Interval::new(0.0, 0.3)));
        assert!(most_mm(&part) > 1.1 * size_mm(&part));
        let line = Curve::Line { origin: DVec3::ZERO, direction: DVec3::Y };
        let (curve, range) = (Arc::new(line), Interval::new(0.0, 500.0));
        part.curves.push(FreeCurve { entity, curve, range, color: None });
        assert!(most_mm(&part) >= size_mm(&part) && size_mm(&part) > 500.0);
    }
}
