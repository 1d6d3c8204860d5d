// From homogeneous sums to what is asked for.

// Vectors per point: 1 point; 2 and unit normal; 4 and dS/du, dS/dv; 8 and d2S/du2, d2S/dudv, d2S/dv2, curvatures.
override STRIDE: u32 = 2u;

// Homogeneous value and derivatives.
struct Jet {
    a: vec4<f32>,
    au: vec4<f32>,
    av: vec4<f32>,
    auu: vec4<f32>,
    auv: vec4<f32>,
    avv: vec4<f32>,
}

// What a point of the output consists of.
struct Outcome {
    point: vec3<f32>,
    normal: vec3<f32>,
    du: vec3<f32>,
    dv: vec3<f32>,
    duu: vec3<f32>,
    duv: vec3<f32>,
    dvv: vec3<f32>,
    // Gaussian, mean, largest and smallest principal curvature; of a curve: its curvature first.
    curvatures: vec4<f32>,
}

// How far inwards, as a share of the facet, a derivative is taken where its own place gives none.
const NUDGE = 0.01;
// Shorter derivatives than this share of the facet's size give no direction.
const TINY = 3e-4;

// Piegl & Tiller A4.4, then the caller's parameters (chain rule), the normal and curvatures.
fn finish(jet: Jet, row: Line, column: Line, facet: Facet) -> Outcome {
    var out: Outcome;
    let inverse = 1.0 / jet.a.w;
    let s = jet.a.xyz * inverse;
    out.point = s + facet.origin;
    if STRIDE < 2u {
        return out;
    }
    let du = (jet.au.xyz - s * jet.au.w) * inverse;
    let dv = (jet.av.xyz - s * jet.av.w) * inverse;
    let duv = (jet.auv.xyz - dv * jet.au.w - du * jet.av.w - s * jet.auv.w) * inverse;
    if column.degree > 0u {
        out.normal = unit_normal(du, dv, duv, vec2<f32>(row.inward, column.inward), facet);
    }
    if STRIDE < 4u {
        return out;
    }
    out.du = du * row.slope;
    out.dv = dv * column.slope;
    if STRIDE < 8u {
        return out;
    }
    let duu = (jet.auu.xyz - du * (2.0 * jet.au.w) - s * jet.auu.w) * inverse;
    let dvv = (jet.avv.xyz - dv * (2.0 * jet.av.w) - s * jet.avv.w) * inverse;
    out.duu = duu * (row.slope * row.slope) + du * row.bend;
    out.duv = duv * (row.slope * column.slope);
    out.dvv = dvv * (column.slope * column.slope) + dv * column.bend;
    if column.degree > 0u {
        out.curvatures = surface_curvatures(du, dv, duu, duv, dvv, out.normal);
    } else {
        out.curvatures = vec4<f32>(curve_curvature(du, duu), 0.0, 0.0, 0.0);
    }
    return out;
}

// The cross product of the first derivatives; near a line that is one point, of what they become inside.
fn unit_normal(du: vec3<f32>, dv: vec3<f32>, duv: vec3<f32>, inward: vec2<f32>, facet: Facet) -> vec3<f32> {
    var a = du;
    var b = dv;
    let tiny = TINY * facet.size;
    if dot(a, a) < tiny * tiny {
        a = du + duv * (NUDGE * inward.y);
    }
    if dot(b, b) < tiny * tiny {
        b = dv + duv * (NUDGE * inward.x);
    }
    let la = length(a);
    let lb = length(b);
    if !(la > 0.0 && lb > 0.0) {
        return facet.normal;
    }
    let across = cross(a / la, b / lb);
    let l = length(across);
    // What is left of two parallel vectors is rounding.
    if l > 1e-4 {
        return across / l;
    }
    return facet.normal;
}

fn curve_curvature(d: vec3<f32>, dd: vec3<f32>) -> f32 {
    let l = length(d);
    if !(l > 0.0) {
        return 0.0;
    }
    return length(cross(d / l, dd / l)) / l;
}

// From the fundamental forms (do Carmo 3-3); zero where the first one has no inverse.
fn surface_curvatures(
    du: vec3<f32>,
    dv: vec3<f32>,
    duu: vec3<f32>,
    duv: vec3<f32>,
    dvv: vec3<f32>,
    normal: vec3<f32>,
) -> vec4<f32> {
    // With derivatives of unit length along both directions, numbers stay near 1.
    let lu = length(du);
    let lv = length(dv);
    if !(lu > 0.0 && lv > 0.0) {
        return vec4<f32>();
    }
    let f = dot(du / lu, dv / lv);
    let e2 = dot(duu / lu, normal) / lu;
    let f2 = dot(duv / lu, normal) / lv;
    let g2 = dot(dvv / lv, normal) / lv;
    let inverse = 1.0 - f * f;
    if !(inverse > 1e-9) {
        return vec4<f32>();
    }
    let gauss = (e2 * g2 - f2 * f2) / inverse;
    let mean = 0.5 * (e2 - 2.0 * f2 * f + g2) / inverse;
    let spread = sqrt(max(mean * mean - gauss, 0.0));
    return vec4<f32>(gauss, mean, mean + spread, mean - spread);
}
