//! Twin of `shaders/shared/finish.wgsl` and `shaders/shared/write.wgsl`.

use glam::{Vec3, Vec4, Vec4Swizzles};

use crate::Quantities;
use crate::batch::Line;
use crate::shape::Facet;

/// Homogeneous value and derivatives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Jet {
    pub a: Vec4,
    pub au: Vec4,
    pub av: Vec4,
    pub auu: Vec4,
    pub auv: Vec4,
    pub avv: Vec4,
}

const NUDGE: f32 = 0.01;
const TINY: f32 = 3e-4;

/// The vectors of a point of the output, from homogeneous sums.
pub(super) fn finish(
    jet: &Jet,
    row: &Line,
    column: &Line,
    facet: &Facet,
    quantities: Quantities,
    out: &mut [Vec4],
) {
    let inverse = 1.0 / jet.a.w;
    let s = jet.a.xyz() * inverse;
    out[0] = (s + facet.origin).extend(row.share);
    if quantities < Quantities::Normals {
        return;
    }
    let du = (jet.au.xyz() - s * jet.au.w) * inverse;
    let dv = (jet.av.xyz() - s * jet.av.w) * inverse;
    let duv = (jet.auv.xyz() - dv * jet.au.w - du * jet.av.w - s * jet.auv.w) * inverse;
    let is_surface = column.degree > 0;
    let inward = [row.inward, column.inward];
    let normal = if is_surface { unit_normal(du, dv, duv, inward, facet) } else { Vec3::ZERO };
    out[1] = normal.extend(column.share);
    if quantities < Quantities::First {
        return;
    }
    out[2] = (du * row.slope).extend(0.0);
    out[3] = (dv * column.slope).extend(0.0);
    if quantities < Quantities::Second {
        return;
    }
    let duu = (jet.auu.xyz() - du * (2.0 * jet.au.w) - s * jet.auu.w) * inverse;
    let dvv = (jet.avv.xyz() - dv * (2.0 * jet.av.w) - s * jet.avv.w) * inverse;
    out[4] = (duu * (row.slope * row.slope) + du * row.bend).extend(0.0);
    out[5] = (duv * (row.slope * column.slope)).extend(0.0);
    out[6] = (dvv * (column.slope * column.slope) + dv * column.bend).extend(0.0);
    out[7] = if is_surface {
        surface_curvatures([du, dv], [duu, duv, dvv], normal)
    } else {
        Vec4::new(curve_curvature(du, duu), 0.0, 0.0, 0.0)
    };
}

fn unit_normal(du: Vec3, dv: Vec3, duv: Vec3, inward: [f32; 2], facet: &Facet) -> Vec3 {
    let tiny = (TINY * facet.size) * (TINY * facet.size);
    let a = if du.length_squared() < tiny { du + duv * (NUDGE * inward[1]) } else { du };
    let b = if dv.length_squared() < tiny { dv + duv * (NUDGE * inward[0]) } else { dv };
    let (la, lb) = (a.length(), b.length());
    if !(la > 0.0 && lb > 0.0) {
        return facet.normal;
    }
    let across = (a / la).cross(b / lb);
    let l = across.length();
    if l > 1e-4 { across / l } else { facet.normal }
}

fn curve_curvature(d: Vec3, dd: Vec3) -> f32 {
    let l = d.length();
    if l > 0.0 { (d / l).cross(dd / l).length() / l } else { 0.0 }
}

fn surface_curvatures([du, dv]: [Vec3; 2], [duu, duv, dvv]: [Vec3; 3], normal: Vec3) -> Vec4 {
    let (lu, lv) = (du.length(), dv.length());
    if !(lu > 0.0 && lv > 0.0) {
        return Vec4::ZERO;
    }
    let f = (du / lu).dot(dv / lv);
    let e2 = (duu / lu).dot(normal) / lu;
    let f2 = (duv / lu).dot(normal) / lv;
    let g2 = (dvv / lv).dot(normal) / lv;
    let inverse = 1.0 - f * f;
    if !(inverse > 1e-9) {
        return Vec4::ZERO;
    }
    let gauss = (e2 * g2 - f2 * f2) / inverse;
    let mean = 0.5 * (e2 - 2.0 * f2 * f + g2) / inverse;
    let spread = (mean * mean - gauss).max(0.0).sqrt();
    Vec4::new(gauss, mean, mean + spread, mean - spread)
}
