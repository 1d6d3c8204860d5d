// The inverse: details added to the middle of their neighbours.
fn transformed(place: Place) -> vec4<f32> {
    let half = (place.length + 1u) / 2u;
    let k = place.at / 2u;
    if place.at % 2u == 0u {
        return value(place, k);
    }
    return value(place, half + k) + 0.5 * (value(place, k) + value(place, k + 1u));
}
