// Exact classification of the points of a list; a mask is the list of its texels' centres.

@group(0) @binding(5) var<storage, read> points: array<vec2<f32>>;
@group(0) @binding(6) var<storage, read_write> found: array<u32>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = (workgroup.y * workgroups.x + workgroup.x) * 64u + local;
    if index < arrayLength(&points) {
        found[index] = select(0u, 1u, is_inside(0u, points[index]));
    }
}
