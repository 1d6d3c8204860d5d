//! f64 on all cores: grids as products of cached basis values, vectorized along v.

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use trimloop_geom::{Derivatives, Surface};

use super::product::Product;
use crate::request::Data;
use crate::shape::Source;
use crate::{Places, Quantities, Request, Shape, Values};

/// Points of a task.
const TASK: usize = 16_384;

/// `room` is used again for the points.
pub(crate) fn values(request: &Request<'_>, quantities: Quantities, room: Vec<DVec3>) -> Values {
    let Request { shape, places } = request;
    let mut out = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    if quantities == Quantities::Points {
        out.0 = points(shape, places, room);
    } else {
        let all = jets(shape, places);
        let is_curve = matches!(shape.source, Source::Curve(_));
        out.0 = all.iter().map(|(d, _)| d.point).collect();
        out.1 = all.iter().map(|(_, normal)| *normal).collect();
        if quantities >= Quantities::First {
            out.2 = all.iter().map(|(d, _)| *d).collect();
        }
        if quantities >= Quantities::Second {
            out.3 = all.iter().map(|(d, normal)| curvatures(d, *normal, is_curve)).collect();
        }
    }
    let (points, normals, derivatives, curvatures) = out;
    Values { quantities, data: Data::Double { points, normals, derivatives, curvatures } }
}

fn points(shape: &Shape, places: &Places, mut room: Vec<DVec3>) -> Vec<DVec3> {
    let domain = shape.domain();
    match (&shape.source, places) {
        (Source::Surface(surface), Places::Grid { us, vs }) => {
            let us: Vec<f64> = us.iter().map(|&u| domain[0].clamp(u)).collect();
            let vs: Vec<f64> = vs.iter().map(|&v| domain[1].clamp(v)).collect();
            if let (Surface::Nurbs(_), Some(net)) = (surface, &shape.net) {
                Product::new(net, shape.origin(), &vs).rows(&us, &mut room);
                return room;
            }
            let rows = (TASK / vs.len().max(1)).max(1);
            let blocks: Vec<Vec<DVec3>> = us.par_chunks(rows).map(|us| surface.grid(us, &vs)).collect();
            blocks.concat()
        }
        _ => (0..places.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|k| shape.derivatives(clamped(shape, places.uv(k))).point)
            .collect(),
    }
}

/// Derivatives and unit normals.
fn jets(shape: &Shape, places: &Places) -> Vec<(Derivatives, DVec3)> {
    let with_normal = |uv: DVec2, d: Derivatives| {
        let normal = d.du.cross(d.dv);
        // Where they are far from vanishing, the first derivatives say it all.
        let is_plain = normal.length_squared() > 1e-6 * d.du.length_squared() * d.dv.length_squared();
        let is_surface = matches!(shape.source, Source::Surface(_));
        let scale = shape.size() * 1e-3;
        let far = is_surface && is_plain && d.du.length() > scale && d.dv.length() > scale;
        (d, if far { normal.normalize() } else { shape.normal(uv) })
    };
    if let (Source::Surface(surface @ Surface::Nurbs(_)), Places::Grid { us, vs }) = (&shape.source, places) {
        let rows = (TASK / vs.len().max(1)).max(1);
        let block = |us: &[f64]| -> Vec<(Derivatives, DVec3)> {
            let found = surface.derivatives_grid(us, vs).into_iter().enumerate();
            found.map(|(k, d)| with_normal(DVec2::new(us[k / vs.len()], vs[k % vs.len()]), d)).collect()
        };
        let blocks: Vec<Vec<_>> = us.par_chunks(rows).map(block).collect();
        return blocks.concat();
    }
    let one = |k: usize| {
        let uv = clamped(shape, places.uv(k));
        with_normal(uv, shape.derivatives(uv))
    };
    (0..places.len()).into_par_iter().with_min_len(256).map(one).collect()
}

fn clamped(shape: &Shape, uv: DVec2) -> DVec2 {
    let [u, v] = shape.domain();
    DVec2::new(u.clamp(uv.x), v.clamp(uv.y))
}

/// Gaussian, mean, largest and smallest principal curvature (do Carmo 3-3); of a curve its curvature.
fn curvatures(d: &Derivatives, normal: DVec3, is_curve: bool) -> [f64; 4] {
    if is_curve {
        let speed = d.du.length();
        let curvature = d.du.cross(d.duu).length() / (speed * speed * speed);
        return [if curvature.is_finite() { curvature } else { 0.0 }, 0.0, 0.0, 0.0];
    }
    let (e, f, g) = (d.du.length_squared(), d.du.dot(d.dv), d.dv.length_squared());
    let (l, m, n) = (d.duu.dot(normal), d.duv.dot(normal), d.dvv.dot(normal));
    let inverse = e * g - f * f;
    if !(inverse > 1e-9 * e * g) {
        return [0.0; 4];
    }
    let gauss = (l * n - m * m) / inverse;
    let mean = 0.5 * (l * g - 2.0 * m * f + n * e) / inverse;
    let spread = (mean * mean - gauss).max(0.0).sqrt();
    [gauss, mean, mean + spread, mean - spread]
}
