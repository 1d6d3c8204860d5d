// The same in v over what `tan_rows` left (Tan et al. 2012, section 3.3.3).

@group(0) @binding(4) var<storage, read> scratch: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> facets: array<Facet>;
@group(0) @binding(6) var<storage, read_write> out: array<vec4<f32>>;

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
    let is_list = job.is_list == 1u;
    // Rows `start .. end`, `lines` columns from `first_line` on, all in one span.
    for (var k = local; k < (tile.end - tile.start) * tile.lines; k += 64u) {
        let i = tile.start + k / tile.lines;
        let j = select(tile.first_line + k % tile.lines, i, is_list);
        let row = lines[job.first_row + i];
        let column = lines[job.first_column + j];
        let base = (job.scratch + i * job.scratch_columns + select(column.first, 0u, is_list)) * KINDS;
        var jet: Jet;
        for (var kind = 0u; kind < KINDS; kind++) {
            for (var m = 0u; m <= column.degree; m++) {
                triangle[m] = scratch[base + m * KINDS + kind];
            }
            let sums = de_boor(column.knots, column.degree, column.t);
            if kind == 0u {
                jet.a = sums.value;
                jet.av = sums.first;
                jet.avv = sums.second;
            } else if kind == 1u {
                jet.au = sums.value;
                jet.auv = sums.first;
            } else {
                jet.auu = sums.value;
            }
        }
        let facet = facets[job.facet + row.span * job.facet_columns + column.span];
        let point = job.first_point + select(i * job.columns + j, i, is_list);
        write(point, finish(jet, row, column, facet), row, column);
    }
}
