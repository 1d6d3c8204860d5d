// Is a point of the unit square inside a face? A grid of cells tells at once away from the boundary; elsewhere a ray
// towards +u counts the curves that it crosses among those of the point's band of v.

struct TrimHeader {
    // Cells along u, along v; bands.
    columns: u32,
    rows: u32,
    bands: u32,
    // Where its tables begin in those of all: words of cells, bands, entries, curves.
    first_word: u32,
    first_band: u32,
    first_entry: u32,
    first_curve: u32,
    unused: u32,
}

@group(0) @binding(0) var<storage, read> headers: array<TrimHeader>;
// 0 outside, 1 inside, 2 mixed; four bits each, eight in a word, row-major over v.
@group(0) @binding(1) var<storage, read> cells: array<u32>;
// First entry of each band in `entries`; one more than there are bands.
@group(0) @binding(2) var<storage, read> bands: array<u32>;
// Numbers of curves.
@group(0) @binding(3) var<storage, read> entries: array<u32>;
// Two vectors per curve, its four control points; u and v run one way along it.
@group(0) @binding(4) var<storage, read> curves: array<vec4<f32>>;

fn cubic(p: vec4<f32>, t: f32) -> f32 {
    let s = 1.0 - t;
    return ((p.x * s + 3.0 * p.y * t) * s + 3.0 * p.z * t * t) * s + p.w * t * t * t;
}

// Whether a ray from uv towards +u crosses the curve.
fn crosses(curve: u32, uv: vec2<f32>) -> bool {
    let first = curves[2u * curve];
    let second = curves[2u * curve + 1u];
    if (first.y > uv.y) == (second.w > uv.y) {
        return false;
    }
    if uv.x < min(first.x, second.z) {
        return true;
    }
    if uv.x >= max(first.x, second.z) {
        return false;
    }
    // The place on the curve at this v, by halving (v runs one way).
    let v = vec4<f32>(first.y, first.w, second.y, second.w) - uv.y;
    let u = vec4<f32>(first.x, first.z, second.x, second.z);
    var low = 0.0;
    var high = 1.0;
    let rises = v.w > v.x;
    for (var k = 0u; k < 24u; k++) {
        let middle = 0.5 * (low + high);
        if (cubic(v, middle) > 0.0) == rises {
            high = middle;
        } else {
            low = middle;
        }
        // Both ends of what is left on one side of the point.
        let a = cubic(u, low);
        let b = cubic(u, high);
        if min(a, b) > uv.x {
            return true;
        }
        if max(a, b) < uv.x {
            return false;
        }
    }
    return cubic(u, 0.5 * (low + high)) > uv.x;
}

fn is_inside(face: u32, uv: vec2<f32>) -> bool {
    let header = headers[face];
    if uv.x < 0.0 || uv.y < 0.0 || uv.x > 1.0 || uv.y > 1.0 {
        return false;
    }
    let column = min(u32(uv.x * f32(header.columns)), header.columns - 1u);
    let row = min(u32(uv.y * f32(header.rows)), header.rows - 1u);
    let cell = row * header.columns + column;
    let state = (cells[header.first_word + cell / 8u] >> (4u * (cell % 8u))) & 15u;
    if state < 2u {
        return state == 1u;
    }
    let band = min(u32(uv.y * f32(header.bands)), header.bands - 1u);
    var inside = false;
    let at = header.first_band + band;
    for (var k = bands[at]; k < bands[at + 1u]; k++) {
        inside = inside != crosses(header.first_curve + entries[header.first_entry + k], uv);
    }
    return inside;
}
