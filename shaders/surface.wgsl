// Faces: vertices that the evaluators left on the device, trimmed exactly in each fragment.

// How cells are trimmed: 0 not at all, 1 by curves, 2 by masks.
override TRIM: u32 = 1u;
override SAMPLES: u32 = 4u;

// Trim textures, 32 texels in a word, row by row.
@group(0) @binding(5) var<storage, read> masks: array<u32>;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Shares of the face's domain.
    @location(2) uv: vec2<f32>,
    @location(3) @interpolate(flat) item: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let block = blocks[index / 16u];
    let at = block.y + index % 16u;
    let a = vertices[2u * at];
    let b = vertices[2u * at + 1u];
    var out: Corner;
    out.place = to_eye(block.x, vec4<f32>(a.xyz, 1.0));
    out.normal = to_eye(block.x, vec4<f32>(b.xyz, 0.0));
    out.uv = vec2<f32>(a.w, b.w);
    out.item = block.x;
    out.clip = view.clip * vec4<f32>(out.place, 1.0);
    return out;
}

// Whether the face holds a place, by whatever trims it.
fn holds(item: u32, uv: vec2<f32>) -> bool {
    if TRIM == 1u {
        return is_inside(items[item].trim, uv);
    }
    let size = vec2<u32>(items[item].mask & 0xffffu, items[item].mask >> 16u);
    let texel = min(vec2<u32>(clamp(uv, vec2<f32>(), vec2<f32>(1.0)) * vec2<f32>(size)), size - 1u);
    let at = texel.y * size.x + texel.x;
    return ((masks[items[item].trim + at / 32u] >> (at % 32u)) & 1u) == 1u;
}

// Which samples of the pixel are inside the face. `uv` may change by `across` and `down` from pixel to pixel.
fn coverage(item: u32, uv: vec2<f32>, across: vec2<f32>, down: vec2<f32>) -> u32 {
    if TRIM == 0u {
        return 0xffffffffu;
    }
    if SAMPLES == 1u {
        return select(0u, 1u, holds(item, uv));
    }
    // The places that WebGPU gives to four samples.
    var places = array<vec2<f32>, 4>(
        vec2<f32>(-0.125, -0.375),
        vec2<f32>(0.375, -0.125),
        vec2<f32>(-0.375, 0.125),
        vec2<f32>(0.125, 0.375),
    );
    var mask = 0u;
    for (var k = 0u; k < 4u; k++) {
        if holds(item, uv + across * places[k].x + down * places[k].y) {
            mask |= 1u << k;
        }
    }
    return mask;
}

// The colour of a face at a place, linear.
fn tint(item: u32, place: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let own = items[item].color.rgb;
    // Derivatives are taken where all pixels are: what decides here is the same for all of them.
    if view.tightest.x == 0.0 {
        return own;
    }
    let n = normalize(normal);
    let bent = ramp(view.tightest.x * curvature(dpdx(place), dpdy(place), dpdx(n), dpdy(n)));
    return select(bent, own, items[item].flags != 0u);
}

// The larger principal curvature, from how place and unit normal change along two directions: the fundamental forms of any
// two tangents give it.
fn curvature(a: vec3<f32>, b: vec3<f32>, na: vec3<f32>, nb: vec3<f32>) -> f32 {
    let first = vec3<f32>(dot(a, a), dot(a, b), dot(b, b));
    let second = -vec3<f32>(dot(a, na), 0.5 * (dot(a, nb) + dot(b, na)), dot(b, nb));
    let area = max(first.x * first.z - first.y * first.y, 1e-30);
    let mean = (first.x * second.z - 2.0 * first.y * second.y + first.z * second.x) / (2.0 * area);
    let gauss = (second.x * second.z - second.y * second.y) / area;
    return abs(mean) + sqrt(max(mean * mean - gauss, 0.0));
}

// From blue over green to red, linear.
fn ramp(share: f32) -> vec3<f32> {
    let x = 4.0 * clamp(share, 0.0, 1.0);
    let rise = vec3<f32>(clamp(x - 2.0, 0.0, 1.0), clamp(x, 0.0, 1.0), 0.0);
    let fall = vec3<f32>(0.0, clamp(x - 3.0, 0.0, 1.0), clamp(x - 1.0, 0.0, 1.0));
    return 0.05 + 0.75 * (vec3<f32>(0.0, 0.0, 1.0) + rise - fall);
}

struct Painted {
    @location(0) color: vec4<f32>,
    @builtin(sample_mask) mask: u32,
}

@fragment
fn paint(in: Corner) -> Painted {
    let across = dpdx(in.uv);
    let down = dpdy(in.uv);
    let color = tint(in.item, in.place, in.normal);
    var out: Painted;
    out.mask = coverage(in.item, in.uv, across, down);
    if out.mask == 0u || is_cut_away(in.item, in.place) {
        discard;
    }
    out.color = vec4<f32>(shade(color, in.normal, sight(in.place)), 1.0);
    return out;
}

struct Veil {
    @location(0) sum: vec4<f32>,
    @location(1) through: f32,
    @builtin(sample_mask) mask: u32,
}

// Transparent faces in any order: weighted blending (McGuire & Bavoil 2013).
@fragment
fn veil(in: Corner) -> Veil {
    let across = dpdx(in.uv);
    let down = dpdy(in.uv);
    let color = tint(in.item, in.place, in.normal);
    var out: Veil;
    out.mask = coverage(in.item, in.uv, across, down);
    if out.mask == 0u || is_cut_away(in.item, in.place) {
        discard;
    }
    let alpha = items[in.item].color.a;
    // Depth is reversed: what is near weighs more.
    let weight = alpha * clamp(3e3 * pow(in.clip.z, 3.0), 1e-2, 3e3);
    out.sum = vec4<f32>(shade(color, in.normal, sight(in.place)), 1.0) * weight;
    out.through = alpha;
    return out;
}

// The item, (u, v) and the depth of every pixel.
@fragment
fn identify(in: Corner) -> @location(0) vec4<u32> {
    let item = items[in.item];
    if TRIM != 0u && !holds(in.item, in.uv) {
        discard;
    }
    if is_cut_away(in.item, in.place) {
        discard;
    }
    return vec4<u32>(item.id, bitcast<u32>(in.uv.x), bitcast<u32>(in.uv.y), bitcast<u32>(in.clip.z));
}
