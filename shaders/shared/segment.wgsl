// Segments as strips that are some pixels wide on the screen.

struct Segment {
    // The ends, and u there.
    a: vec4<f32>,
    b: vec4<f32>,
    // The normals there, and v.
    normal_a: vec4<f32>,
    normal_b: vec4<f32>,
}

fn segment_at(at: u32) -> Segment {
    return Segment(vertices[4u * at], vertices[4u * at + 1u], vertices[4u * at + 2u], vertices[4u * at + 3u]);
}

struct Strip {
    clip: vec4<f32>,
    place: vec3<f32>,
    // Share of the way from a to b.
    share: f32,
    // Pixels from the middle line.
    off: f32,
}

// Corner 0 .. 5 of the two triangles of a strip. Both ends are drawn out by half the width.
fn strip_corner(from_eye: vec3<f32>, to_eye: vec3<f32>, corner: u32, half_width: f32) -> Strip {
    var a = from_eye;
    var b = to_eye;
    var out: Strip;
    out.clip = vec4<f32>(0.0, 0.0, 0.0, 1.0);
    // What is behind the eye has no place on the screen.
    if view.is_parallel == 0u {
        let behind = -view.near;
        if a.z > behind && b.z > behind {
            return out;
        }
        if a.z > behind {
            a = mix(b, a, (b.z - behind) / (b.z - a.z));
        } else if b.z > behind {
            b = mix(a, b, (a.z - behind) / (a.z - b.z));
        }
    }
    let clip_a = view.clip * vec4<f32>(a, 1.0);
    let clip_b = view.clip * vec4<f32>(b, 1.0);
    let half = 0.5 * view.size;
    let pixels = (clip_b.xy / clip_b.w - clip_a.xy / clip_a.w) * half;
    let l = length(pixels);
    let along = select(vec2<f32>(1.0, 0.0), pixels / l, l > 1e-6);
    let across = vec2<f32>(-along.y, along.x);
    let at_end = corner == 1u || corner == 2u || corner == 4u;
    let is_left = corner == 2u || corner == 4u || corner == 5u;
    let side = select(-1.0, 1.0, is_left);
    let way = select(-1.0, 1.0, at_end);
    out.clip = select(clip_a, clip_b, at_end);
    let moved = (across * side + along * way) * half_width / half * out.clip.w;
    out.clip = vec4<f32>(out.clip.xy + moved, out.clip.zw);
    out.place = select(a, b, at_end);
    out.share = select(0.0, 1.0, at_end);
    out.off = side * half_width;
    return out;
}
