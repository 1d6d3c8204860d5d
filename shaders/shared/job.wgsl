// One request of a batch: a shape and where it is evaluated.
struct Job {
    // Its first point in the output.
    first_point: u32,
    // Lines of the grid along u, along v; of a list: its points, 1.
    rows: u32,
    columns: u32,
    // Its first line along u, along v.
    first_row: u32,
    first_column: u32,
    // 1 where point i stands at line i of both directions.
    is_list: u32,
    // Its first control point; control points along v.
    control: u32,
    control_columns: u32,
    // Its first facet; facets along v.
    facet: u32,
    facet_columns: u32,
    // First element of what passes leave for each other; elements per line.
    scratch: u32,
    scratch_columns: u32,
}

// What a workgroup does: points (or elements) `start .. end` of a job. What `lines` and the rest mean depends on the pass.
struct Tile {
    job: u32,
    start: u32,
    end: u32,
    unused: u32,
    first_line: u32,
    lines: u32,
    first_control: u32,
    controls: u32,
}

// A part of a shape: control points are relative to its origin.
struct Facet {
    origin: vec3<f32>,
    // Diagonal of its box; what lengths of derivatives are held against.
    size: f32,
    // Unit normal where no better one can be told.
    normal: vec3<f32>,
    unused: f32,
}
