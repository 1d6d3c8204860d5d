// Rational bicubic Bezier patches (Guthe, Balazs, Klein 2005, figure 3): along u first, which leaves a curve whose value is
// the position and whose derivative is dS/dv; then along v first for dS/du.

struct PatchJob {
    first_vertex: u32,
    rows: u32,
    columns: u32,
    first_row: u32,
    first_column: u32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}

@group(0) @binding(0) var<storage, read> jobs: array<PatchJob>;
// Each workgroup's job, and how many of its blocks of 64 vertices come before.
@group(0) @binding(1) var<storage, read> blocks: array<vec2<u32>>;
// Where a line stands in the patch; the share of the surface's domain.
@group(0) @binding(2) var<storage, read> lines: array<vec2<f32>>;
// 16 homogeneous points per job, rows running over u.
@group(0) @binding(3) var<storage, read> control: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> facets: array<Facet>;
@group(0) @binding(5) var<storage, read_write> vertices: array<vec4<f32>>;

fn weights(s: f32) -> vec4<f32> {
    let r = 1.0 - s;
    return vec4<f32>(r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s);
}

fn derivative_weights(s: f32) -> vec4<f32> {
    let r = 1.0 - s;
    return 3.0 * vec4<f32>(-r * r, r * (r - 2.0 * s), s * (2.0 * r - s), s * s);
}

// The row i of control points times weights along v.
fn along_v(first: u32, i: u32, w: vec4<f32>) -> vec4<f32> {
    let at = first + 4u * i;
    return control[at] * w.x + control[at + 1u] * w.y + control[at + 2u] * w.z + control[at + 3u] * w.w;
}

// The column j of control points times weights along u.
fn along_u(first: u32, j: u32, w: vec4<f32>) -> vec4<f32> {
    let at = first + j;
    return control[at] * w.x + control[at + 4u] * w.y + control[at + 8u] * w.z + control[at + 12u] * w.w;
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = workgroup.y * workgroups.x + workgroup.x;
    if number >= arrayLength(&blocks) {
        return;
    }
    let block = blocks[number];
    let job = jobs[block.x];
    let index = block.y * 64u + local;
    if index >= job.rows * job.columns {
        return;
    }
    let row = lines[job.first_row + index / job.columns];
    let column = lines[job.first_column + index % job.columns];
    let first = 16u * block.x;
    let facet = facets[block.x];
    let bu = weights(row.x);
    let bv = weights(column.x);
    let du = derivative_weights(row.x);
    let dv = derivative_weights(column.x);

    // Along u: a curve over v.
    let curve = mat4x4<f32>(
        along_u(first, 0u, bu),
        along_u(first, 1u, bu),
        along_u(first, 2u, bu),
        along_u(first, 3u, bu),
    );
    let a = curve * bv;
    let a_v = curve * dv;
    // Along v: a curve over u.
    let other = mat4x4<f32>(
        along_v(first, 0u, bv),
        along_v(first, 1u, bv),
        along_v(first, 2u, bv),
        along_v(first, 3u, bv),
    );
    let a_u = other * du;
    let a_uv = mat4x4<f32>(
        along_v(first, 0u, dv),
        along_v(first, 1u, dv),
        along_v(first, 2u, dv),
        along_v(first, 3u, dv),
    ) * du;

    let inverse = 1.0 / a.w;
    let s = a.xyz * inverse;
    let s_u = (a_u.xyz - s * a_u.w) * inverse;
    let s_v = (a_v.xyz - s * a_v.w) * inverse;
    let s_uv = (a_uv.xyz - s_v * a_u.w - s_u * a_v.w - s * a_uv.w) * inverse;
    let inward = select(vec2<f32>(-1.0), vec2<f32>(1.0), vec2<f32>(row.x, column.x) < vec2<f32>(0.5));
    let at = 2u * (job.first_vertex + index);
    vertices[at] = vec4<f32>(s, row.y);
    vertices[at + 1u] = vec4<f32>(unit_normal(s_u, s_v, s_uv, inward, facet), column.y);
}
