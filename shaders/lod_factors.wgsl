// Grid sizes of each shape for a view, continuous and independent along u and v (Krishnamurthy et al. 2009, section 6.1:
// size and distance), and as fine as curvature asks (second derivatives bound a chord's distance: Piegl & Tiller 5.4).

struct LodShape {
    center: vec3<f32>,
    radius: f32,
    // Largest lengths along u, along v; bounds of the second derivatives over the unit square.
    lengths: vec2<f32>,
    bends: vec2<f32>,
}

struct LodView {
    eye: vec3<f32>,
    // Size of a pixel at distance 1; in a parallel view at any distance.
    pixel: f32,
    // Pixels that a chord may be away from the surface; pixels that a cell may be long.
    chord_px: f32,
    cell_px: f32,
    // Fewest and most cells along a direction.
    fewest: f32,
    most: f32,
    is_parallel: u32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}

@group(0) @binding(0) var<storage, read> view: LodView;
@group(0) @binding(1) var<storage, read> shapes: array<LodShape>;
@group(0) @binding(2) var<storage, read_write> cells: array<vec2<u32>>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = (workgroup.y * workgroups.x + workgroup.x) * 64u + local;
    if index >= arrayLength(&shapes) {
        return;
    }
    let shape = shapes[index];
    let away = distance(view.eye, shape.center) - shape.radius;
    // Inside a shape's sphere its nearest place counts as a tenth of its radius away.
    let pixel = view.pixel * select(max(away, 0.1 * shape.radius), 1.0, view.is_parallel == 1u);
    let by_chord = sqrt(shape.bends / (8.0 * view.chord_px * pixel));
    let by_size = shape.lengths / (view.cell_px * pixel);
    let wanted = clamp(max(by_chord, by_size), vec2<f32>(view.fewest), vec2<f32>(view.most));
    cells[index] = vec2<u32>(ceil(wanted));
}
