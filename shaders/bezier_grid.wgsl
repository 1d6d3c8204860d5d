// A tile of a grid over Bezier facets: the control points are reduced along u once per row into workgroup memory, then
// every point of the tile sums along v.

// Derivatives along u that are kept: 1 none, 2 the first, 3 the second too.
override KINDS: u32 = 2u;

const CAPACITY = 768u;
var<workgroup> reduced: array<vec4<f32>, CAPACITY>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = workgroup.y * workgroups.x + workgroup.x;
    let is_surplus = index >= arrayLength(&tiles);
    let tile = tiles[select(index, 0u, is_surplus)];
    let job = jobs[tile.job];
    // Rows `start .. end` of the grid, `lines` of its columns from `first_line` on, which need `controls` control points
    // along v from `first_control` on.
    let rows = select(tile.end - tile.start, 0u, is_surplus);
    for (var k = local; k < rows * tile.controls; k += 64u) {
        let line = job.first_row + tile.start + k / tile.controls;
        let row = lines[line];
        var sums = array<vec4<f32>, 3>();
        var at = job.control + row.first * job.control_columns + tile.first_control + k % tile.controls;
        let base = basis_index(line, 0u, 0u);
        for (var i = 0u; i <= row.degree; i++) {
            let p = control[at];
            sums[0] += p * basis[base + i];
            if KINDS > 1u {
                sums[1] += p * basis[base + WIDTH + i];
            }
            if KINDS > 2u {
                sums[2] += p * basis[base + 2u * WIDTH + i];
            }
            at += job.control_columns;
        }
        reduced[k * KINDS] = sums[0];
        if KINDS > 1u {
            reduced[k * KINDS + 1u] = sums[1];
        }
        if KINDS > 2u {
            reduced[k * KINDS + 2u] = sums[2];
        }
    }
    workgroupBarrier();
    for (var k = local; k < rows * tile.lines; k += 64u) {
        let r = k / tile.lines;
        let j = tile.first_line + k % tile.lines;
        let column = lines[job.first_column + j];
        let base = basis_index(job.first_column + j, 0u, 0u);
        var at = (r * tile.controls + column.first - tile.first_control) * KINDS;
        var jet: Jet;
        for (var i = 0u; i <= column.degree; i++) {
            let p = reduced[at];
            let n = basis[base + i];
            jet.a += p * n;
            if KINDS > 1u {
                let dn = basis[base + WIDTH + i];
                let pu = reduced[at + 1u];
                jet.av += p * dn;
                jet.au += pu * n;
                jet.auv += pu * dn;
                if KINDS > 2u {
                    jet.avv += p * basis[base + 2u * WIDTH + i];
                    jet.auu += reduced[at + 2u] * n;
                }
            }
            at += KINDS;
        }
        let row = lines[job.first_row + tile.start + r];
        let facet = facets[job.facet + row.span * job.facet_columns + column.span];
        let point = job.first_point + (tile.start + r) * job.columns + j;
        write(point, finish(jet, row, column, facet), row, column);
    }
}
