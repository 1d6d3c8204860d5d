// From the pieces that a view needs to what is drawn: `cull` leaves out what lies outside of the tile, `sum` makes room for
// the rest, `emit` writes it there and the arguments of the draw calls. The order is that of the pieces, always.

// A piece at its place.
struct Draw {
    // A sphere around it, in the eye's coordinates.
    center: vec3<f32>,
    radius: f32,
    item: u32,
    first_vertex: u32,
    // Blocks of vertices.
    blocks: u32,
    // Vertices along v; 0 where numbers are those of vertices, not of cells.
    columns: u32,
    // Its first cell, how many are inside the face, and how many trim curves pass through.
    first_cell: u32,
    whole: u32,
    part: u32,
    // Blocks of segments.
    first_strip: u32,
    strips: u32,
    // The list of strips (0 borders, 1 edges, 2 lines); 4 more where it is transparent.
    kind: u32,
    unused_0: u32,
    unused_1: u32,
}

struct Tile {
    // Planes around the tile in the eye's coordinates, normals inwards.
    planes: array<vec4<f32>, 5>,
    // What is in front of any of these is cut away, except what closes the cut.
    sections: array<vec4<f32>, 3>,
    count: u32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}

@group(0) @binding(0) var<uniform> tile: Tile;
@group(0) @binding(1) var<storage, read> draws: array<Draw>;
@group(0) @binding(2) var<storage, read> cells: array<u32>;
// AMOUNTS per draw: blocks, indices (opaque whole, opaque trimmed, transparent whole, transparent trimmed), blocks of
// strips (borders, edges, lines). First how many, then how many before.
@group(0) @binding(3) var<storage, read_write> amounts: array<u32>;
// Four indexed draws of five words, three draws of four words.
@group(0) @binding(4) var<storage, read_write> arguments: array<u32, 32>;
@group(0) @binding(5) var<storage, read_write> blocks: array<vec2<u32>>;
@group(0) @binding(6) var<storage, read_write> indices: array<u32>;
@group(0) @binding(7) var<storage, read_write> strips: array<vec2<u32>>;

const AMOUNTS = 8u;
// Vertices of a block; vertices that draw a block of segments.
const BLOCK = 16u;
const STRIP = 48u;
// Segments of a block.
const SEGMENTS = 8u;

fn is_seen(draw: Draw) -> bool {
    for (var k = 0u; k < 5u; k++) {
        if dot(tile.planes[k], vec4<f32>(draw.center, 1.0)) < -draw.radius {
            return false;
        }
    }
    for (var k = 0u; k < 3u; k++) {
        if dot(tile.sections[k], vec4<f32>(draw.center, 1.0)) > draw.radius {
            return false;
        }
    }
    return true;
}

// Indices per cell.
fn per_cell(draw: Draw) -> u32 {
    return select(1u, 6u, draw.columns > 0u);
}

@compute @workgroup_size(64)
fn cull(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = (workgroup.y * workgroups.x + workgroup.x) * 64u + local;
    if number >= tile.count {
        return;
    }
    let draw = draws[number];
    var own = array<u32, 8>();
    if is_seen(draw) {
        let range = 1u + (draw.kind >> 2u) * 2u;
        own[0] = draw.blocks;
        own[range] = draw.whole * per_cell(draw);
        own[range + 1u] = draw.part * per_cell(draw);
        own[5u + (draw.kind & 3u)] = draw.strips;
    }
    for (var k = 0u; k < AMOUNTS; k++) {
        amounts[number * AMOUNTS + k] = own[k];
    }
}

const THREADS = 128u;
var<workgroup> sums: array<array<u32, 8>, 128>;

@compute @workgroup_size(128)
fn sum(@builtin(local_invocation_index) local: u32) {
    let each = (tile.count + THREADS - 1u) / THREADS;
    let first = min(local * each, tile.count);
    let end = min(first + each, tile.count);
    var own = array<u32, 8>();
    for (var number = first; number < end; number++) {
        for (var k = 0u; k < AMOUNTS; k++) {
            own[k] += amounts[number * AMOUNTS + k];
        }
    }
    sums[local] = own;
    workgroupBarrier();
    // Each amount's sums before, and of all, by a thread of its own.
    if local < AMOUNTS {
        var before = 0u;
        for (var k = 0u; k < THREADS; k++) {
            let count = sums[k][local];
            sums[k][local] = before;
            before += count;
        }
        let total = before;
        if local >= 1u && local <= 4u {
            let at = (local - 1u) * 5u;
            arguments[at] = total;
            arguments[at + 1u] = 1u;
            arguments[at + 3u] = 0u;
            arguments[at + 4u] = 0u;
        }
        if local >= 5u {
            let at = 20u + (local - 5u) * 4u;
            arguments[at] = total * STRIP;
            arguments[at + 1u] = 1u;
            arguments[at + 3u] = 0u;
        }
    }
    workgroupBarrier();
    storageBarrier();
    // Draws begin where the one before ends.
    if local == 0u {
        var index = 0u;
        for (var k = 0u; k < 4u; k++) {
            arguments[k * 5u + 2u] = index;
            index += arguments[k * 5u];
        }
        var vertex = 0u;
        for (var k = 0u; k < 3u; k++) {
            arguments[20u + k * 4u + 2u] = vertex;
            vertex += arguments[20u + k * 4u];
        }
    }
    var before = sums[local];
    for (var number = first; number < end; number++) {
        for (var k = 0u; k < AMOUNTS; k++) {
            let count = amounts[number * AMOUNTS + k];
            amounts[number * AMOUNTS + k] = before[k];
            before[k] += count;
        }
    }
}

fn write_cells(draw: Draw, first_cell: u32, count: u32, to: u32, base: u32, local: u32) {
    for (var k = local; k < count; k += 64u) {
        let a = base + cells[first_cell + k];
        if draw.columns == 0u {
            indices[to + k] = a;
            continue;
        }
        let b = a + draw.columns;
        let at = to + 6u * k;
        indices[at] = a;
        indices[at + 1u] = b;
        indices[at + 2u] = b + 1u;
        indices[at + 3u] = a;
        indices[at + 4u] = b + 1u;
        indices[at + 5u] = a + 1u;
    }
}

@compute @workgroup_size(64)
fn emit(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let number = workgroup.y * workgroups.x + workgroup.x;
    if number >= tile.count {
        return;
    }
    let draw = draws[number];
    if !is_seen(draw) {
        return;
    }
    let own = number * AMOUNTS;
    let block = amounts[own];
    for (var k = local; k < draw.blocks; k += 64u) {
        blocks[block + k] = vec2<u32>(draw.item, draw.first_vertex + k * BLOCK);
    }
    let range = (draw.kind >> 2u) * 2u;
    let whole = arguments[range * 5u + 2u] + amounts[own + 1u + range];
    let part = arguments[range * 5u + 7u] + amounts[own + 2u + range];
    write_cells(draw, draw.first_cell, draw.whole, whole, block * BLOCK, local);
    write_cells(draw, draw.first_cell + draw.whole, draw.part, part, block * BLOCK, local);
    let list = draw.kind & 3u;
    let strip = arguments[20u + list * 4u + 2u] / STRIP + amounts[own + 5u + list];
    for (var k = local; k < draw.strips; k += 64u) {
        strips[strip + k] = vec2<u32>(draw.item, draw.first_strip + k * SEGMENTS);
    }
}
