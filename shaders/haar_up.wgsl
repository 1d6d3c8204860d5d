// The inverse: average + detail, average - detail.
fn transformed(place: Place) -> vec4<f32> {
    let half = place.length / 2u;
    let average = value(place, place.at / 2u);
    let detail = value(place, half + place.at / 2u);
    if place.at % 2u == 0u {
        return average + detail;
    }
    return average - detail;
}
