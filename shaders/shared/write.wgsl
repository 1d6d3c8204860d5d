// A point's outcome into `out`, STRIDE vectors per point; after the position the share along u, after the normal along v.
fn write(point: u32, found: Outcome, row: Line, column: Line) {
    let base_out = point * STRIDE;
    out[base_out] = vec4<f32>(found.point, row.share);
    if STRIDE >= 2u {
        out[base_out + 1u] = vec4<f32>(found.normal, column.share);
    }
    if STRIDE >= 4u {
        out[base_out + 2u] = vec4<f32>(found.du, 0.0);
        out[base_out + 3u] = vec4<f32>(found.dv, 0.0);
    }
    if STRIDE >= 8u {
        out[base_out + 4u] = vec4<f32>(found.duu, 0.0);
        out[base_out + 5u] = vec4<f32>(found.duv, 0.0);
        out[base_out + 6u] = vec4<f32>(found.dvv, 0.0);
        out[base_out + 7u] = found.curvatures;
    }
}
