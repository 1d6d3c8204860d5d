// Every control row in u (Tan et al. 2012, section 3.3.2): one workgroup stays inside one knot span, so that nothing is
// searched for.

@group(0) @binding(4) var<storage, read> control: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> scratch: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let index = workgroup.y * workgroups.x + workgroup.x;
    if index >= arrayLength(&tiles) {
        return;
    }
    let tile = tiles[index];
    let job = jobs[tile.job];
    // Elements `start .. end`: `controls` columns for each line.
    for (var k = tile.start + local; k < tile.end; k += 64u) {
        let i = k / job.scratch_columns;
        let c = k % job.scratch_columns;
        let row = lines[job.first_row + i];
        let column = select(c, lines[job.first_column + i].first + c, job.is_list == 1u);
        for (var m = 0u; m <= row.degree; m++) {
            triangle[m] = control[job.control + (row.first + m) * job.control_columns + column];
        }
        let sums = de_boor(row.knots, row.degree, row.t);
        let goal = (job.scratch + k) * KINDS;
        scratch[goal] = sums.value;
        if KINDS > 1u {
            scratch[goal + 1u] = sums.first;
        }
        if KINDS > 2u {
            scratch[goal + 2u] = sums.second;
        }
    }
}
