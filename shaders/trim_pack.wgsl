// The channels of a trim texture as bits, 32 texels in a word, for passes that read them as buffers.

struct Size {
    columns: u32,
    rows: u32,
    channels: u32,
    unused: u32,
    // Where each channel's first word goes.
    first: vec4<u32>,
}

@group(0) @binding(0) var<storage, read> size: Size;
@group(0) @binding(1) var<storage, read_write> masks: array<u32>;
@group(0) @binding(2) var texels: texture_2d<f32>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let word = (workgroup.y * workgroups.x + workgroup.x) * 64u + local;
    let across = size.columns / 32u;
    if word >= across * size.rows {
        return;
    }
    let place = vec2<u32>(32u * (word % across), word / across);
    var words = vec4<u32>();
    for (var k = 0u; k < 32u; k++) {
        let texel = textureLoad(texels, place + vec2<u32>(k, 0u), 0);
        words |= select(vec4<u32>(), vec4<u32>(1u << k), texel > vec4<f32>(0.5));
    }
    for (var k = 0u; k < size.channels; k++) {
        masks[size.first[k] + word] = words[k];
    }
}
