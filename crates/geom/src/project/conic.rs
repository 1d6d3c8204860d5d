//! Nearest points on conics, in the conic's own plane and frame.

/// The angle of the ellipse's point `(major cos t, minor sin t)` nearest to (x, y), in (-π, π].
///
/// In the point's own quadrant the derivative of the squared distance changes its sign exactly once (Eberly, *Distance
/// from a Point to an Ellipse*), so the root is bracketed and safe for any axes.
pub(super) fn ellipse(major: f64, minor: f64, x: f64, y: f64) -> f64 {
    let (a, b) = (major.abs(), minor.abs());
    let (px, py) = (x.abs(), y.abs());
    let slope = |t: f64| {
        let (sin, cos) = t.sin_cos();
        let value = (b * b - a * a) * sin * cos + px * a * sin - py * b * cos;
        let derivative = (b * b - a * a) * (cos * cos - sin * sin) + px * a * cos + py * b * sin;
        (value, derivative)
    };
    let t = root(slope, 0.0, std::f64::consts::FRAC_PI_2);
    let sin = t.sin().copysign(y * minor.signum());
    let cos = t.cos().copysign(x * major.signum());
    sin.atan2(cos)
}

/// The parameter of the parabola's point `focal (t², 2t)` nearest to (x, y).
///
/// The foot solves t³ + (2 - x / focal) t = y / focal; the nearest one is the largest root on the side of y, to which
/// Newton steps from above descend monotonically.
pub(super) fn parabola(focal: f64, x: f64, y: f64) -> f64 {
    let (p, q) = (2.0 - x / focal, (y / focal).abs());
    let bound = 1.0 + q.cbrt().max(p.abs().sqrt()) * 2.0;
    let cubic = |t: f64| (t * (t * t + p) - q, 3.0 * t * t + p);
    let t = descend_to_root(cubic, bound);
    let t = if t > 0.0 { t } else { 0.0 };
    if (y / focal) < 0.0 { -t } else { t }
}

/// The parameter of the hyperbola's point `(major cosh t, minor sinh t)` nearest to (x, y).
///
/// On the side of y the derivative of the squared distance (here divided by cosh t) changes its sign exactly once.
pub(super) fn hyperbola(major: f64, minor: f64, x: f64, y: f64) -> f64 {
    let squares = major * major + minor * minor;
    let (along, across) = (x * major, (y * minor).abs());
    let slope = |t: f64| {
        let sech2 = 1.0 / (t.cosh() * t.cosh());
        (squares * t.sinh() - along * t.tanh() - across, squares * t.cosh() - along * sech2)
    };
    let t = root(slope, 0.0, ((along.abs() + across) / squares).asinh());
    if y * minor < 0.0 { -t } else { t }
}

/// The root of a function that is negative (or zero) just above `low` and positive at `high`: Newton inside a
/// shrinking bracket.
fn root(f: impl Fn(f64) -> (f64, f64), mut low: f64, mut high: f64) -> f64 {
    let mut t = 0.5 * (low + high);
    for _ in 0..100 {
        let (value, derivative) = f(t);
        if value > 0.0 {
            high = t;
        } else {
            low = t;
        }
        let newton = t - value / derivative;
        let next =
            if derivative > 0.0 && low <= newton && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - t).abs() <= 1e-16 * (1.0 + t) || high - low <= 1e-16 * t {
            return next;
        }
        t = next;
    }
    t
}

/// The largest root of a function that is convex and rising from there up to `start`, where it is not negative.
fn descend_to_root(f: impl Fn(f64) -> (f64, f64), start: f64) -> f64 {
    let mut t = start;
    for _ in 0..200 {
        let (value, derivative) = f(t);
        if derivative.is_nan() || derivative <= 0.0 {
            break;
        }
        let next = t - value / derivative;
        if next < 0.0 || next >= t || next.is_nan() {
            return next.max(0.0).min(t);
        }
        if t - next <= 1e-16 * t {
            return next;
        }
        t = next;
    }
    t
}
