//! Point in polygon for many points.

use glam::DVec2;

/// Polygons' sides, by the horizontal strips that they run through.
pub(crate) struct Strips {
    low: f64,
    per_strip: f64,
    strips: Vec<Vec<[DVec2; 2]>>,
}

/// Sides in strips, for each side: long ones run through many.
const MAX_SHARE: usize = 32;

/// Pairs of sides that are looked at to tell about how often they cross, and the steps in which pairs are taken: they
/// fill a square evenly (powers of the inverse of the root of x³ = x + 1).
const SAMPLED_PAIRS: f64 = 200_000.0;
const SPREAD: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053_3];

impl Strips {
    /// The sides of closed polygons.
    pub fn new(polygons: &[Vec<DVec2>]) -> Self {
        let sides = || polygons.iter().flat_map(|p| (0..p.len()).map(move |i| [p[i], p[(i + 1) % p.len()]]));
        let count = sides().count();
        let low = sides().map(|side| side[0].y).fold(f64::INFINITY, f64::min);
        let high = sides().map(|side| side[0].y).fold(f64::NEG_INFINITY, f64::max);
        // As many strips as there are sides, unless long sides would then fill too many of them.
        let rise: f64 = sides().map(|[a, b]| (b.y - a.y).abs()).sum::<f64>() / (high - low);
        let most = (count * MAX_SHARE) as f64 / rise.max(1.0);
        let strip_count = most.min(count as f64).max(1.0) as usize;
        let height = (high - low) / strip_count as f64;
        let per_strip = if height > 0.0 && height.is_finite() { height.recip() } else { 0.0 };
        let mut out = Self { low, per_strip, strips: vec![Vec::new(); strip_count] };
        for [a, b] in sides().filter(|[a, b]| a.y != b.y) {
            let (first, last) = (out.strip(a.y.min(b.y)), out.strip(a.y.max(b.y)));
            out.strips[first..=last].iter_mut().for_each(|strip| strip.push([a, b]));
        }
        out
    }

    /// How many sides a point is held against, where there are many.
    pub fn load(&self) -> usize {
        let sizes = || self.strips.iter().map(Vec::len);
        sizes().map(|size| size * size).sum::<usize>() / sizes().sum::<usize>().max(1)
    }

    /// Whether the sides cross each other more often than `limit`, as far as a sample of pairs tells; at once where
    /// that cannot be.
    pub fn crossings_above(&self, limit: usize) -> bool {
        let pairs = |strip: &[[DVec2; 2]]| strip.len() as f64 * (strip.len() as f64 - 1.0) / 2.0;
        let all: f64 = self.strips.iter().map(|strip| pairs(strip)).sum();
        if all <= limit as f64 {
            return false;
        }
        let (mut crossings, mut taken) = (0.0, 0);
        for (number, strip) in self.strips.iter().enumerate().filter(|(_, strip)| strip.len() > 1) {
            let count = (pairs(strip) / all * SAMPLED_PAIRS).ceil() as usize;
            let pair = |k: usize| {
                SPREAD.map(|step| strip[(((k as f64 + 0.5) * step).fract() * strip.len() as f64) as usize])
            };
            let is_here = |k: &usize| crossing(pair(*k)).is_some_and(|at| self.strip(at.y) == number);
            let found = (taken..taken + count).filter(is_here).count();
            crossings += pairs(strip) * found as f64 / count as f64;
            taken += count;
        }
        crossings > limit as f64
    }

    fn strip(&self, y: f64) -> usize {
        (((y - self.low) * self.per_strip).max(0.0) as usize).min(self.strips.len() - 1)
    }

    /// Whether an odd number of sides lies to the right of a point.
    pub fn contain(&self, p: DVec2) -> bool {
        let right_of = |[a, b]: &&[DVec2; 2]| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.strips[self.strip(p.y)].iter().filter(right_of).count() % 2 == 1
    }
}

/// Where two sides cross that have no end on each other.
fn crossing([[a, b], [c, d]]: [[DVec2; 2]; 2]) -> Option<DVec2> {
    let beside = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let [of_c, of_d] = [beside(a, b, c), beside(a, b, d)];
    let crosses = of_c * of_d < 0.0 && beside(c, d, a) * beside(c, d, b) < 0.0;
    crosses.then(|| c.lerp(d, of_c / (of_c - of_d)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_agree_with_the_polygons_themselves() {
        let ring = |radius: f64, count: usize| -> Vec<DVec2> {
            let at = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
            (0..count)
                .map(|k| DVec2::from_angle(at(k)) * radius * (1.0 + 0.3 * (5.0 * at(k)).sin()))
                .collect()
        };
        let polygons = [ring(1.0, 200), ring(0.4, 37), vec![DVec2::ZERO, DVec2::new(3.0, 0.0), DVec2::Y]];
        let strips = Strips::new(&polygons);
        for i in 0..60 {
            for j in 0..60 {
                let p = DVec2::new(i as f64, j as f64) * 0.061 - 1.5;
                let around =
                    |polygon: &&Vec<DVec2>| trimloop_trim::polygon::contains(polygon.iter().copied(), p);
                assert_eq!(strips.contain(p), polygons.iter().filter(around).count() % 2 == 1, "{p}");
            }
        }
        assert!(!Strips::new(&[]).contain(DVec2::ZERO));
    }

    #[test]
    fn crossings_are_told_from_a_sample() {
        // The star polygon {n/k} crosses itself n (k - 1) times.
        let (count, step) = (4001, 1500);
        let star: Vec<DVec2> = (0..count)
            .map(|k| DVec2::from_angle(std::f64::consts::TAU * (k * step % count) as f64 / count as f64))
            .collect();
        let crossings = count * (step - 1);
        let strips = Strips::new(&[star]);
        assert!(strips.crossings_above(crossings * 19 / 20));
        assert!(!strips.crossings_above(crossings * 21 / 20));
        // Just as many sides in every strip, and no crossings.
        let tooth = |k: u32| DVec2::new(f64::from(k), f64::from(k % 2));
        let comb: Vec<DVec2> = (0..4001).map(tooth).chain([DVec2::new(2000.0, -1.0)]).collect();
        assert!(!Strips::new(&[comb]).crossings_above(1000));
        assert!(!Strips::new(&[]).crossings_above(0));
    }
}
