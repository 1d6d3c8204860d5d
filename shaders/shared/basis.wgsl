// Tensor products of control points with basis functions: what passes read and write.

@group(0) @binding(0) var<storage, read> jobs: array<Job>;
@group(0) @binding(1) var<storage, read> tiles: array<Tile>;
@group(0) @binding(2) var<storage, read> lines: array<Line>;
@group(0) @binding(3) var<storage, read> basis: array<f32>;
@group(0) @binding(4) var<storage, read> control: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> facets: array<Facet>;
@group(0) @binding(6) var<storage, read_write> out: array<vec4<f32>>;

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
