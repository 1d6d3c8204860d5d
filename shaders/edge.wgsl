// Edges and free curves as lines that are some pixels wide, smooth at their sides.

// 1 for edges in the view's edge colour, 0 for lines in their item's own.
override IS_EDGE: u32 = 1u;
// What is left of the line's opacity.
override PERCENT: u32 = 100u;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) @interpolate(linear) off: f32,
    @location(2) @interpolate(flat) item: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let number = index / 6u;
    let block = blocks[number / 8u];
    let s = segment_at(block.y + number % 8u);
    let a = shifted(to_eye(block.x, vec4<f32>(s.a.xyz, 1.0)), -view.edge_shift);
    let b = shifted(to_eye(block.x, vec4<f32>(s.b.xyz, 1.0)), -view.edge_shift);
    // Half a pixel more on both sides, for the smooth transition.
    let corner = strip_corner(a, b, index % 6u, view.edge_width + 0.5);
    var out: Corner;
    out.clip = corner.clip;
    out.place = corner.place;
    out.off = corner.off;
    out.item = block.x;
    return out;
}

@fragment
fn paint(in: Corner) -> @location(0) vec4<f32> {
    if is_cut_away(in.item, in.place) {
        discard;
    }
    var color = items[in.item].color;
    if IS_EDGE == 1u {
        color = view.edge;
    }
    let opacity = color.a * clamp(view.edge_width + 0.5 - abs(in.off), 0.0, 1.0) * f32(PERCENT) * 0.01;
    return vec4<f32>(color.rgb * opacity, opacity);
}
