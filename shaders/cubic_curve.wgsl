// Cubic Bezier curves in the parameter plane (Guthe, Balazs, Klein 2005) as fans of triangles around a point of their loop,
// for `trim_fan`.

struct Curve {
    // Control points 0 and 1, 2 and 3; shares of the domain.
    a: vec4<f32>,
    b: vec4<f32>,
    // The point that all triangles of the loop share.
    hub: vec2<f32>,
    // The first of its triangles, and how many.
    first: u32,
    count: u32,
}

@group(0) @binding(0) var<storage, read> curves: array<Curve>;
// Three per triangle.
@group(0) @binding(1) var<storage, read_write> corners: array<vec2<f32>>;

// Neighbours meet: ends are control points.
fn at(curve: Curve, k: u32) -> vec2<f32> {
    if k == 0u {
        return curve.a.xy;
    }
    if k == curve.count {
        return curve.b.zw;
    }
    let t = f32(k) / f32(curve.count);
    let s = 1.0 - t;
    return ((curve.a.xy * s + 3.0 * curve.a.zw * t) * s + 3.0 * curve.b.xy * t * t) * s + curve.b.zw * t * t * t;
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = workgroup.y * workgroups.x + workgroup.x;
    if number >= arrayLength(&curves) {
        return;
    }
    let curve = curves[number];
    for (var k = local; k < curve.count; k += 64u) {
        let corner = 3u * (curve.first + k);
        corners[corner] = curve.hub;
        corners[corner + 1u] = at(curve, k);
        corners[corner + 2u] = at(curve, k + 1u);
    }
}
