// What all passes of a picture read: the view, what is drawn, and where its vertices are.

struct View {
    // From the eye's coordinates (x to the right, y up, z back) to clip space; depth is reversed.
    clip: mat4x4<f32>,
    // Pixels of the picture (of the tile that is drawn).
    size: vec2<f32>,
    // Size of a pixel at distance 1; in a parallel view at any distance.
    pixel: f32,
    is_parallel: u32,
    // Upwards in the eye's coordinates.
    up: vec3<f32>,
    // Half the width of borders, pixels.
    border: f32,
    // What is in front of any of these planes is cut away; all zero for none.
    sections: array<vec4<f32>, 3>,
    // Colour of edges, linear; half their width, pixels.
    edge: vec4<f32>,
    // The radius of curvature that is red; 0 for the items' own colours.
    tightest: vec4<f32>,
    edge_width: f32,
    // Pixels that borders lie behind, and edges before, what they belong to.
    border_shift: f32,
    edge_shift: f32,
    near: f32,
}

// A face at its place.
struct Item {
    // Rows of the matrix from the face's own coordinates to the eye's.
    rows: array<vec4<f32>, 3>,
    // Linear, with opacity.
    color: vec4<f32>,
    // Number of its trim table, or first word of its mask.
    trim: u32,
    // What picking returns, from 1 on.
    id: u32,
    // Bits 0 to 2: the section planes that cut nothing of it away, since it closes what they cut open. Bit 3: it stands out.
    flags: u32,
    // Texels of its mask along u, and along v in the upper half.
    mask: u32,
}

@group(1) @binding(0) var<uniform> view: View;
@group(1) @binding(1) var<storage, read> items: array<Item>;
// Vertices (or segments) come in blocks of 16 (or 8): the item, and the first one's place.
@group(1) @binding(2) var<storage, read> blocks: array<vec2<u32>>;
@group(1) @binding(3) var<storage, read> vertices: array<vec4<f32>>;

fn to_eye(item: u32, p: vec4<f32>) -> vec3<f32> {
    let rows = items[item].rows;
    return vec3<f32>(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
}

// Moved along the line of sight by some pixels, away from the eye.
fn shifted(p: vec3<f32>, pixels: f32) -> vec3<f32> {
    if view.is_parallel == 1u {
        return p - vec3<f32>(0.0, 0.0, pixels * view.pixel);
    }
    return p * (1.0 + pixels * view.pixel);
}

fn is_cut_away(item: u32, p: vec3<f32>) -> bool {
    let flags = items[item].flags;
    for (var k = 0u; k < 3u; k++) {
        if ((flags >> k) & 1u) == 0u && dot(view.sections[k], vec4<f32>(p, 1.0)) > 0.0 {
            return true;
        }
    }
    return false;
}

// From the eye to the place, unit length.
fn sight(p: vec3<f32>) -> vec3<f32> {
    if view.is_parallel == 1u {
        return vec3<f32>(0.0, 0.0, -1.0);
    }
    return normalize(p);
}
