// Layout of section 5.2, packed: four lines share a row, one in each channel.
alias Value = vec4<f32>;
alias Count = vec4<u32>;
alias Knot = vec4<f32>;

fn parameter(row: u32) -> Value {
    return knots[row * (2u * WIDTH + 3u)];
}

fn knot(row: u32, m: u32) -> Value {
    return knots[row * (2u * WIDTH + 3u) + 1u + m];
}

fn degree_of(line: u32) -> u32 {
    return lines[min(line, arrayLength(&lines) - 1u)].degree;
}

fn degrees(row: u32) -> Count {
    let first = row * 4u;
    return vec4<u32>(degree_of(first), degree_of(first + 1u), degree_of(first + 2u), degree_of(first + 3u));
}
