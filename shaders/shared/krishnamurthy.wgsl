// Basis functions by order (Krishnamurthy et al. 2009, section 4): each pass makes the functions of one degree from those
// of the degree before, and the last two leave derivatives as well. A pass reads one buffer and writes another.
//
// The layouts differ in what a Value is (one line, or four), and where its knots lie: `knot(row, m)` is the m-th of the
// 2 (degree + 1) knots around the span, `parameter(row)` the place, `degrees(row)` the degree.

struct Pass {
    // Degree of the functions that are made; 0 takes over the first row.
    degree: u32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}

@group(0) @binding(0) var<storage, read> lines: array<Line>;
@group(0) @binding(1) var<storage, read> knots: array<Knot>;
@group(0) @binding(2) var<storage, read> pass_: Pass;
@group(0) @binding(3) var<storage, read> before: array<Value>;
@group(0) @binding(4) var<storage, read_write> after: array<Value>;
@group(0) @binding(5) var<storage, read_write> basis: array<Value>;

// Largest order (degree + 1) of the batch.
override WIDTH: u32 = 4u;

// 0/0 is 0.
fn ratio(a: Value, b: Value) -> Value {
    let is_zero = b == Value();
    return select(a / select(b, Value(1.0), is_zero), Value(), is_zero);
}

// The derivative of the i-th function of degree `q`, from two functions of degree q - 1 (Piegl & Tiller eq. 2.7).
fn slope(row: u32, i: u32, q: Value, step: u32, own: Value, next: Value) -> Value {
    let left = ratio(own, knot(row, i + step) - knot(row, i));
    let right = ratio(next, knot(row, i + step + 1u) - knot(row, i + 1u));
    return q * (left - right);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = flat_index(workgroup, workgroups.x, 64u, local);
    let row = index / WIDTH;
    let i = index % WIDTH;
    let stride = WIDTH + 2u;
    if row * stride >= arrayLength(&before) {
        return;
    }
    let q = pass_.degree;
    let p = degrees(row);
    let at = row * stride + i;
    let own = before[at];
    let next = before[at + 1u];
    var value = own;
    if q > 0u {
        let t = parameter(row);
        let left = ratio(t - knot(row, i), knot(row, i + q) - knot(row, i));
        let right = ratio(knot(row, i + q + 1u) - t, knot(row, i + q + 1u) - knot(row, i + 1u));
        value = select(own, left * own + right * next, Count(q) <= p);
    }
    after[at] = value;
    let goal = row * 3u * WIDTH + i;
    let is_last = Count(q) == p;
    basis[goal] = select(basis[goal], value, is_last);
    if q > 0u {
        basis[goal + WIDTH] = select(basis[goal + WIDTH], slope(row, i, Value(p), q, own, next), is_last);
    }
    // What is read here has degree p - 2: two steps lead to the second derivative.
    let lower = Value(f32(q));
    let first = slope(row, i, lower, q, own, next);
    let second = slope(row, i + 1u, lower, q, next, before[at + 2u]);
    let bend = slope(row, i, Value(p), q + 1u, first, second);
    basis[goal + 2u * WIDTH] = select(basis[goal + 2u * WIDTH], bend, Count(q + 1u) == p);
}
