// Light of a studio: a key light over the left shoulder, a weaker one from the right, and a sky.

const KEY = vec3<f32>(-0.408, 0.571, 0.712);
const FILL = vec3<f32>(0.757, 0.108, 0.644);

// The colour of a place, linear; both sides are lit alike.
fn shade(color: vec3<f32>, normal: vec3<f32>, sight: vec3<f32>) -> vec3<f32> {
    var n = normal;
    let l = length(n);
    if l > 0.0 {
        n = n / l;
    } else {
        n = -sight;
    }
    if dot(n, sight) > 0.0 {
        n = -n;
    }
    let sky = 0.5 + 0.5 * dot(n, view.up);
    let key = max(dot(n, KEY), 0.0);
    let fill = max(dot(n, FILL), 0.0);
    let diffuse = 0.22 + 0.26 * sky + 0.62 * key + 0.20 * fill;
    let half_way = normalize(KEY - sight);
    let gloss = pow(max(dot(n, half_way), 0.0), 48.0);
    return color * diffuse + vec3<f32>(0.10 * gloss);
}
