// Point by point, the tensor product over the control points at the span: Krishnamurthy et al. 2009, section 6 (with a
// loop where the fragment programs of the time needed a pass per control point), and lists over Bezier facets.

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
    for (var k = tile.start + local; k < tile.end; k += 64u) {
        let row_line = job.first_row + select(k / job.columns, k, job.is_list == 1u);
        let column_line = job.first_column + select(k % job.columns, k, job.is_list == 1u);
        let row = lines[row_line];
        let column = lines[column_line];
        var jet: Jet;
        for (var i = 0u; i <= row.degree; i++) {
            var a = vec4<f32>();
            var av = vec4<f32>();
            var avv = vec4<f32>();
            let first = job.control + (row.first + i) * job.control_columns + column.first;
            for (var j = 0u; j <= column.degree; j++) {
                let p = control[first + j];
                a += p * basis[basis_index(column_line, 0u, j)];
                if STRIDE >= 2u {
                    av += p * basis[basis_index(column_line, 1u, j)];
                }
                if STRIDE >= 8u {
                    avv += p * basis[basis_index(column_line, 2u, j)];
                }
            }
            let n = basis[basis_index(row_line, 0u, i)];
            jet.a += a * n;
            if STRIDE >= 2u {
                let dn = basis[basis_index(row_line, 1u, i)];
                jet.av += av * n;
                jet.au += a * dn;
                jet.auv += av * dn;
            }
            if STRIDE >= 8u {
                jet.avv += avv * n;
                jet.auu += a * basis[basis_index(row_line, 2u, i)];
            }
        }
        let facet = facets[job.facet + row.span * job.facet_columns + column.span];
        write(job.first_point + k, finish(jet, row, column, facet), row, column);
    }
}
