// The last pass: transparent faces over opaque ones over the background, encoded as sRGB.

struct Ground {
    // Colours at the upper and at the lower border, linear, with opacity.
    top: vec4<f32>,
    bottom: vec4<f32>,
    // What share of the whole picture's height lies above this tile, and what share it covers.
    above: f32,
    share: f32,
    size: vec2<f32>,
}

@group(0) @binding(0) var<uniform> ground: Ground;
@group(0) @binding(1) var solid: texture_2d<f32>;
@group(0) @binding(2) var sums: texture_2d<f32>;
@group(0) @binding(3) var through: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let x = select(-1.0, 3.0, index == 1u);
    let y = select(-1.0, 3.0, index == 2u);
    return vec4<f32>(x, y, 0.0, 1.0);
}

fn encoded(x: f32) -> f32 {
    let c = clamp(x, 0.0, 1.0);
    if c <= 0.0031308 {
        return 12.92 * c;
    }
    return 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

// Straight alpha.
@fragment
fn paint(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = vec2<i32>(at.xy);
    let opaque = textureLoad(solid, texel, 0);
    let sum = textureLoad(sums, texel, 0);
    let clear = textureLoad(through, texel, 0).r;
    let down = ground.above + ground.share * at.y / ground.size.y;
    let back = mix(ground.top, ground.bottom, down);
    // Premultiplied from here on.
    var color = opaque + vec4<f32>(back.rgb * back.a, back.a) * (1.0 - opaque.a);
    let veil = sum.rgb / max(sum.a, 1e-6);
    color = vec4<f32>(veil * (1.0 - clear), 1.0 - clear) + color * clear;
    let straight = color.rgb / max(color.a, 1e-6);
    return vec4<f32>(encoded(straight.r), encoded(straight.g), encoded(straight.b), color.a);
}
