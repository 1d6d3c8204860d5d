// Trim textures (Krishnamurthy et al. 2009, section 7.1; Woo et al.): each loop as a fan of triangles around one point,
// drawn in white over black with blending that toggles (source factor one minus destination, destination factor zero), so
// that what is covered an odd number of times ends up white. The write mask picks one of the four channels.

@vertex
fn corner(@location(0) uv: vec2<f32>) -> @builtin(position) vec4<f32> {
    // The unit square fills the texture, row 0 at the lowest v.
    return vec4<f32>(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, 0.0, 1.0);
}

@fragment
fn toggle() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}
