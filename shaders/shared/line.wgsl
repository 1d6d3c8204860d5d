// One line of a grid (or one coordinate of a list's point): where it stands along its direction.
struct Line {
    // First of the control points that it depends on, along its direction.
    first: u32,
    // Number of its facet along its direction.
    span: u32,
    degree: u32,
    // Bezier: 1 where 1 - t is the smaller share. Indexed: first of its knots. De Boor: first of its knots.
    knots: u32,
    // Bezier: the smaller of t and 1 - t over the larger. Otherwise the parameter, normalized to [0, 1].
    t: f32,
    // Bezier: the larger of t and 1 - t.
    top: f32,
    // Bezier: top^max(degree - 2, 0).
    power: f32,
    // +1 where the domain's middle lies ahead, else -1.
    inward: f32,
    // First and second derivative of the backend's parameter with respect to the caller's.
    slope: f32,
    bend: f32,
    // Where it stands in the shape's domain, as a share.
    share: f32,
    unused: f32,
}

// The number of this invocation, where workgroups stand in rows.
fn flat_index(workgroup: vec3<u32>, across: u32, size: u32, local: u32) -> u32 {
    return (workgroup.y * across + workgroup.x) * size + local;
}
