// Interpolating lifting on 2^n + 1 samples, the prediction of the 5/3 wavelet: every other sample stays as it is, borders
// among them; the details are what the others differ from the middle of their neighbours.
fn transformed(place: Place) -> vec4<f32> {
    let half = (place.length + 1u) / 2u;
    if place.at < half {
        return value(place, 2u * place.at);
    }
    let k = 2u * (place.at - half) + 1u;
    return value(place, k) - 0.5 * (value(place, k - 1u) + value(place, k + 1u));
}
