// Layout of section 5.2, index array: a line points into the knot vector that it shares with others.
alias Value = f32;
alias Count = u32;
alias Knot = f32;

fn parameter(row: u32) -> Value {
    return lines[row].t;
}

fn knot(row: u32, m: u32) -> Value {
    let line = lines[row];
    return knots[line.knots + min(m, 2u * line.degree + 1u)];
}

fn degrees(row: u32) -> Count {
    return lines[row].degree;
}
