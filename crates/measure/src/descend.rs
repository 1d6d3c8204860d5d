//! The minimum of the distance of two elements, from a place near it.

use glam::{DVec2, DVec3};

use crate::element::{Element, Jet};

/// Where a descent ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Parameters on each of both.
    pub parameters: [DVec2; 2],
    /// The points there.
    pub points: [DVec3; 2],
    /// How far those are apart.
    pub distance: f64,
    /// Whether no further step would change anything.
    pub converged: bool,
}

const MAX_STEPS: usize = 80;

/// Damping never gets less than this share of the tangents' own squares, so that whole sets of nearest points
/// (parallel planes, circles of one axis) do no harm; it costs next to nothing of Newton's speed.
const LEAST_DAMPING: f64 = 1e-11;

/// Descends from a pair of parameters to a minimum of the squared distance, by Newton's method with Levenberg's damping
/// (Nocedal & Wright 10.3), parameters held within the elements' limits by leaving out those that press against
/// them. Parameters are measured in what they move the point, so that their units do not matter. Steps are no longer
/// than `reach`, in the world.
pub(crate) fn descend(elements: [&Element; 2], start: [DVec2; 2], reach: f64) -> Foot {
    let problem = Problem { elements, reach };
    let mut at = problem.clamped([start[0].x, start[0].y, start[1].x, start[1].y]);
    let mut jets = problem.jets(&at);
    let mut value = square(&jets);
    let mut damping = 1e-4;
    let mut converged = false;
    for _ in 0..MAX_STEPS {
        let Some(step) = problem.step(&at, &jets, damping) else {
            converged = true;
            break;
        };
        let next = problem.clamped(std::array::from_fn(|k| at[k] + step.by[k]));
        let next_jets = problem.jets(&next);
        let next_value = square(&next_jets);
        // What rounding does to the squared distance.
        let rounding = f64::EPSILON * extent(&jets);
        let noise = 8.0 * f64::EPSILON * value + 4.0 * rounding * (value.sqrt() + 4.0 * rounding);
        let is_last = step.gain <= noise;
        if next_value <= value {
            (at, jets, value) = (next, next_jets, next_value);
            damping = (damping * 0.1_f64).max(LEAST_DAMPING);
        } else if !is_last {
            damping = (damping * 8.0).max(1e-8);
            converged = damping > 1e12;
        }
        if is_last || value == 0.0 || converged {
            converged = true;
            break;
        }
    }
    Foot {
        parameters: [DVec2::new(at[0], at[1]), DVec2::new(at[2], at[3])],
        points: jets.map(|jet| jet.point),
        distance: value.sqrt(),
        converged,
    }
}

fn square(jets: &[Jet; 2]) -> f64 {
    let value = jets[0].point.distance_squared(jets[1].point);
    if value.is_finite() { value } else { f64::INFINITY }
}

fn extent(jets: &[Jet; 2]) -> f64 {
    jets[0].point.abs().max(jets[1].point.abs()).max_element()
}

struct Problem<'a> {
    elements: [&'a Element; 2],
    reach: f64,
}

/// A step, and by how much the squared distance is to fall.
struct Step {
    by: [f64; 4],
    gain: f64,
}

impl Problem<'_> {
    fn jets(&self, at: &[f64; 4]) -> [Jet; 2] {
        [self.elements[0].jet(DVec2::new(at[0], at[1])), self.elements[1].jet(DVec2::new(at[2], at[3]))]
    }

    fn clamped(&self, at: [f64; 4]) -> [f64; 4] {
        std::array::from_fn(|k| self.elements[k / 2].limits()[k % 2].clamp(at[k]))
    }

    /// The damped Newton step; none where no parameter can move the points, or none is left.
    fn step(&self, at: &[f64; 4], jets: &[Jet; 2], damping: f64) -> Option<Step> {
        let off = jets[0].point - jets[1].point;
        let tangents: [DVec3; 4] =
            std::array::from_fn(|k| if k < 2 { jets[0].first[k] } else { -jets[1].first[k - 2] });
        let free = self.free(at, off, &tangents);
        if free.is_empty() {
            return None;
        }
        let scale: [f64; 4] = std::array::from_fn(|k| tangents[k].length());
        let n = free.len();
        let mut hessian = [[0.0; 4]; 4];
        let mut slope = [0.0; 4];
        for (i, &k) in free.iter().enumerate() {
            slope[i] = tangents[k].dot(off) / scale[k];
            for (j, &l) in free.iter().enumerate() {
                let bend = if k / 2 == l / 2 {
                    let sign = if k < 2 { 1.0 } else { -1.0 };
                    jets[k / 2].second[k % 2 + l % 2].dot(off) * sign
                } else {
                    0.0
                };
                hessian[i][j] = (tangents[k].dot(tangents[l]) + bend) / (scale[k] * scale[l]);
            }
        }
        let solution = solve_damped(&hessian, &slope, n, damping)?;
        let length = solution[..n].iter().map(|s| s * s).sum::<f64>().sqrt();
        let shorten = if length > self.reach { self.reach / length } else { 1.0 };
        let mut by = [0.0; 4];
        let mut gain = 0.0;
        for (i, &k) in free.iter().enumerate() {
            by[k] = -solution[i] * shorten / scale[k];
            gain += slope[i] * solution[i] * shorten;
        }
        by.iter().all(|b| b.is_finite()).then_some(Step { by, gain })
    }

    /// The parameters that move their point, and do not press against a limit.
    fn free(&self, at: &[f64; 4], off: DVec3, tangents: &[DVec3; 4]) -> Vec<usize> {
        let moves = |k: usize| {
            let limits = self.elements[k / 2].limits()[k % 2];
            let slope = tangents[k].dot(off);
            let is_stuck = (at[k] <= limits.start && slope > 0.0) || (at[k] >= limits.end && slope < 0.0);
            // At a pole one parameter has no say.
            k % 2 < self.elements[k / 2].dimensions()
                && tangents[k].length_squared() > 1e-30
                && limits.start < limits.end
                && !is_stuck
        };
        (0..4).filter(|&k| moves(k)).collect()
    }
}

/// Solves `(H + damping I) x = g`, damping more until the matrix is positive definite (Cholesky's method).
fn solve_damped(hessian: &[[f64; 4]; 4], slope: &[f64; 4], n: usize, damping: f64) -> Option<[f64; 4]> {
    let most = (0..n).map(|i| hessian[i][i].abs()).fold(1.0, f64::max);
    let mut damping = damping;
    for _ in 0..60 {
        if let Some(found) = cholesky(hessian, slope, n, damping) {
            return Some(found);
        }
        damping = (damping * 4.0).max(1e-6 * most);
        if !damping.is_finite() {
            return None;
        }
    }
    None
}

fn cholesky(hessian: &[[f64; 4]; 4], slope: &[f64; 4], n: usize, damping: f64) -> Option<[f64; 4]> {
    let mut lower = [[0.0; 4]; 4];
    for i in 0..n {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            if i == j {
                let pivot = hessian[i][i] + damping - sum;
                if !(pivot > 0.5 * LEAST_DAMPING) {
                    return None;
                }
                lower[i][i] = pivot.sqrt();
            } else {
                lower[i][j] = (hessian[i][j] - sum) / lower[j][j];
            }
        }
    }
    let mut x = [0.0; 4];
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| lower[i][k] * x[k]).sum();
        x[i] = (slope[i] - sum) / lower[i][i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| lower[k][i] * x[k]).sum();
        x[i] = (x[i] - sum) / lower[i][i];
    }
    Some(x)
}
