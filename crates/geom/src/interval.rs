//! A closed parameter interval.

/// A closed parameter interval; either end may be infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub start: f64,
    /// The upper end; not less than `start`.
    pub end: f64,
}

impl Interval {
    /// The whole real line.
    pub const INFINITE: Self = Self { start: f64::NEG_INFINITY, end: f64::INFINITY };

    /// The interval between `start` and `end`.
    pub const fn new(start: f64, end: f64) -> Self {
        Self { start, end }
    }

    /// `end - start`.
    pub fn length(self) -> f64 {
        self.end - self.start
    }

    /// Whether nothing lies strictly between the ends (or an end is not a number).
    pub fn is_empty(self) -> bool {
        self.start.partial_cmp(&self.end) != Some(std::cmp::Ordering::Less)
    }

    /// Whether both ends are finite.
    pub fn is_finite(self) -> bool {
        self.start.is_finite() && self.end.is_finite()
    }

    /// The point of the interval nearest to `t`.
    pub fn clamp(self, t: f64) -> f64 {
        t.max(self.start).min(self.end)
    }

    /// Whether `t` lies in the interval, ends included.
    pub fn contains(self, t: f64) -> bool {
        self.start <= t && t <= self.end
    }

    /// The parameter at share `s` of a finite interval (0 = start, 1 = end).
    pub fn at(self, s: f64) -> f64 {
        self.start + (self.end - self.start) * s
    }
}
