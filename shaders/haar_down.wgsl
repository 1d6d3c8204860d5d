// Haar (Tan et al. 2012, section 4.3): averages (a + b) / 2 in front, details (a - b) / 2 behind.
fn transformed(place: Place) -> vec4<f32> {
    let half = place.length / 2u;
    let k = place.at % half;
    let a = value(place, 2u * k);
    let b = value(place, 2u * k + 1u);
    if place.at < half {
        return 0.5 * (a + b);
    }
    return 0.5 * (a - b);
}
