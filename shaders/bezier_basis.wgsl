// Bernstein polynomials and their first two derivatives, one invocation per line. Every product is of positive numbers,
// so that each value keeps its relative precision, whatever the weights it will meet.

@group(0) @binding(0) var<storage, read> lines: array<Line>;
@group(0) @binding(1) var<storage, read_write> basis: array<f32>;

// Largest order (degree + 1) of the batch.
override WIDTH: u32 = 4u;

// B_k of degree `degree`; `power` is the larger share to that degree.
fn bernstein(base: u32, degree: u32, ratio: f32, power: f32, is_backward: bool) {
    var value = power;
    for (var i = 0u; i <= degree; i++) {
        basis[base + select(i, degree - i, is_backward)] = value;
        value *= ratio * f32(degree - i) / f32(i + 1u);
    }
}

// From the values of degree - 1 in a row to the derivatives of those of `degree`, in place.
fn differentiate(base: u32, degree: u32) {
    var before = 0.0;
    for (var k = 0u; k < degree; k++) {
        let own = basis[base + k];
        basis[base + k] = f32(degree) * (before - own);
        before = own;
    }
    basis[base + degree] = f32(degree) * before;
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = flat_index(workgroup, workgroups.x, 64u, local);
    if index >= arrayLength(&lines) {
        return;
    }
    let line = lines[index];
    let n = line.degree;
    let base = index * 3u * WIDTH;
    let is_backward = line.knots == 1u;
    let first = line.power * select(1.0, line.top, n > 1u);
    bernstein(base, n, line.t, first * select(1.0, line.top, n > 0u), is_backward);
    if n == 0u {
        basis[base + WIDTH] = 0.0;
        basis[base + 2u * WIDTH] = 0.0;
        return;
    }
    bernstein(base + WIDTH, n - 1u, line.t, first, is_backward);
    differentiate(base + WIDTH, n);
    if n == 1u {
        basis[base + 2u * WIDTH] = 0.0;
        basis[base + 2u * WIDTH + 1u] = 0.0;
        return;
    }
    bernstein(base + 2u * WIDTH, n - 2u, line.t, line.power, is_backward);
    differentiate(base + 2u * WIDTH, n - 1u);
    differentiate(base + 2u * WIDTH, n);
}
