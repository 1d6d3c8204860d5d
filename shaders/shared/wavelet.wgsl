// One step of a two-dimensional wavelet transform along one direction. In a grid of rows x columns the first region_rows
// x region_columns are what the level consists of; a step down leaves the coarse half in front and details behind it.

struct Step {
    rows: u32,
    columns: u32,
    region_rows: u32,
    region_columns: u32,
    // 0 along a row, 1 along a column.
    direction: u32,
    // Vectors per point.
    width: u32,
    unused_1: u32,
    unused_2: u32,
}

@group(0) @binding(0) var<storage, read> step_: Step;
@group(0) @binding(1) var<storage, read> before: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> after: array<vec4<f32>>;

// An element of the region: its place along the direction, the region's length along it, and how to reach others.
struct Place {
    is_inside: bool,
    at: u32,
    length: u32,
    base: u32,
    stride: u32,
}

fn place_of(index: u32) -> Place {
    let across = step_.columns * step_.width;
    let row = index / across;
    let column = index % across / step_.width;
    let vector = index % step_.width;
    let is_inside = row < step_.region_rows && column < step_.region_columns;
    if step_.direction == 0u {
        return Place(is_inside, column, step_.region_columns, row * across + vector, step_.width);
    }
    return Place(is_inside, row, step_.region_rows, index % across, across);
}

fn value(place: Place, k: u32) -> vec4<f32> {
    return before[place.base + k * place.stride];
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = (workgroup.y * workgroups.x + workgroup.x) * 64u + local;
    if index >= step_.rows * step_.columns * step_.width {
        return;
    }
    let place = place_of(index);
    if place.is_inside {
        after[index] = transformed(place);
    } else {
        after[index] = before[index];
    }
}
