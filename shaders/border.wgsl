// Fat borders (Guthe, Balázs, Klein 2005): a strip of the face's own colour along its boundary, narrower than a pixel,
// just behind it. It covers what is left open between two faces that end at the same edge.

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) @interpolate(flat) item: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let number = index / 6u;
    let block = blocks[number / 8u];
    let s = segment_at(block.y + number % 8u);
    let a = shifted(to_eye(block.x, vec4<f32>(s.a.xyz, 1.0)), view.border_shift);
    let b = shifted(to_eye(block.x, vec4<f32>(s.b.xyz, 1.0)), view.border_shift);
    let corner = strip_corner(a, b, index % 6u, view.border);
    var out: Corner;
    out.clip = corner.clip;
    out.place = corner.place;
    out.normal = to_eye(block.x, vec4<f32>(mix(s.normal_a.xyz, s.normal_b.xyz, corner.share), 0.0));
    out.uv = mix(vec2<f32>(s.a.w, s.normal_a.w), vec2<f32>(s.b.w, s.normal_b.w), corner.share);
    out.item = block.x;
    return out;
}

@fragment
fn paint(in: Corner) -> @location(0) vec4<f32> {
    let item = items[in.item];
    if is_cut_away(in.item, in.place) {
        discard;
    }
    return vec4<f32>(shade(item.color.rgb, in.normal, sight(in.place)), 1.0);
}

@fragment
fn identify(in: Corner) -> @location(0) vec4<u32> {
    if is_cut_away(in.item, in.place) {
        discard;
    }
    let item = items[in.item];
    return vec4<u32>(item.id, bitcast<u32>(in.uv.x), bitcast<u32>(in.uv.y), bitcast<u32>(in.clip.z));
}
