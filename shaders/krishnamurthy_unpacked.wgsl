// Layout of section 5.1: every line has a row of its own with its parameter and 2 (degree + 1) knots.
alias Value = f32;
alias Count = u32;
alias Knot = f32;

fn parameter(row: u32) -> Value {
    return knots[row * (2u * WIDTH + 3u)];
}

fn knot(row: u32, m: u32) -> Value {
    return knots[row * (2u * WIDTH + 3u) + 1u + m];
}

fn degrees(row: u32) -> Count {
    return lines[row].degree;
}
