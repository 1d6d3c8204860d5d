// De Boor's algorithm in one pass (Tan, Zhao, Lu 2012, section 3.2). Equation 7 is misprinted there; it is
// alpha_j^l = (u - u_{j+l}) / (u_{j+k+1} - u_{j+l}).

@group(0) @binding(0) var<storage, read> jobs: array<Job>;
@group(0) @binding(1) var<storage, read> tiles: array<Tile>;
@group(0) @binding(2) var<storage, read> lines: array<Line>;
@group(0) @binding(3) var<storage, read> knots: array<f32>;

// Replaced in the text: sizes of arrays cannot be overridden.
const MAX_ORDER = 128u;
var<private> triangle: array<vec4<f32>, MAX_ORDER>;

// Orders of derivatives along u that are kept, plus one.
override KINDS: u32 = 2u;

struct Sums {
    value: vec4<f32>,
    first: vec4<f32>,
    second: vec4<f32>,
}

// Value and derivatives from the degree + 1 control points in `triangle`; `first` is the number of knot u_{i-k}.
fn de_boor(first: u32, degree: u32, t: f32) -> Sums {
    var sums: Sums;
    let p = degree;
    for (var l = 1u; l <= p; l++) {
        if KINDS > 2u && l + 1u == p {
            // Three points of degree 2 are left.
            let left = (triangle[1] - triangle[0]) / (knots[first + p + 1u] - knots[first + p - 1u]);
            let right = (triangle[2] - triangle[1]) / (knots[first + p + 2u] - knots[first + p]);
            let h = knots[first + p + 1u] - knots[first + p];
            sums.second = (right - left) * (f32(p * (p - 1u)) / h);
        }
        if KINDS > 1u && l == p {
            sums.first = (triangle[1] - triangle[0]) * (f32(p) / (knots[first + p + 1u] - knots[first + p]));
        }
        for (var j = 0u; j <= p - l; j++) {
            let low = knots[first + j + l];
            let alpha = (t - low) / (knots[first + j + p + 1u] - low);
            triangle[j] = triangle[j] * (1.0 - alpha) + triangle[j + 1u] * alpha;
        }
    }
    sums.value = triangle[0];
    return sums;
}
