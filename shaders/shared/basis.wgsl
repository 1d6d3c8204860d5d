// Values and derivatives of basis functions, WIDTH of them per line and order of derivative.

// Largest order (degree + 1) of the batch.
override WIDTH: u32 = 4u;
// 1 where four lines share a vec4.
override PACKED: u32 = 0u;

fn basis_index(line: u32, derivative: u32, k: u32) -> u32 {
    if PACKED == 1u {
        return (((line / 4u) * 3u + derivative) * WIDTH + k) * 4u + line % 4u;
    }
    return (line * 3u + derivative) * WIDTH + k;
}
