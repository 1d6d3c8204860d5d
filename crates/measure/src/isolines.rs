//! Lines of constant parameter on which a minimum may lie although no edge is there: creases, and the sides of a surface
//! that is used whole.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use trimloop_geom::{Curve, Direction, Interval, Surface};

/// A line of constant parameter.
#[derive(Clone, Debug)]
pub(crate) struct Isoline {
    /// The line as a curve on the surface; its parameter is the one that is not constant.
    pub curve: Arc<Curve>,
    /// Over which it runs.
    pub range: Interval,
    /// Parameters of samples, both ends included.
    pub samples: Vec<f64>,
}

/// The most creases of one direction.
const MOST_CREASES: usize = 200;

/// Samples of each smooth span of a line.
const PER_SPAN: usize = 16;

/// The most samples of a line, about.
const MOST_SAMPLES: usize = 1024;

/// Normals that turn by more than this at once make a crease.
const CREASE_RAD: f64 = 1e-5;

/// The sides of the domain, where it is finite and does not close.
pub(crate) fn sides(surface: &Arc<Surface>) -> Vec<Isoline> {
    let (domain, periods) = (surface.domain(), surface.periods());
    if !domain.iter().all(|d| d.is_finite()) {
        return Vec::new();
    }
    let directions = [Direction::U, Direction::V].into_iter().filter(|d| periods[*d as usize].is_none());
    let ends = directions.flat_map(|d| [domain[d as usize].start, domain[d as usize].end].map(|at| (d, at)));
    ends.map(|(direction, at)| isoline(surface, direction, at, domain[1 - direction as usize])).collect()
}

/// The lines within a box of parameters at which the normal jumps.
pub(crate) fn creases(surface: &Arc<Surface>, within: [Interval; 2]) -> Vec<Isoline> {
    if !matches!(surface.kind(), "nurbs" | "extrusion" | "revolution" | "offset") {
        return Vec::new();
    }
    let mut out = Vec::new();
    for direction in [Direction::U, Direction::V] {
        let along = within[1 - direction as usize];
        let breaks = surface.breakpoints(direction, within[direction as usize]);
        let jumps = breaks.windows(3).filter(|w| is_crease(surface, direction, w, along));
        out.extend(jumps.take(MOST_CREASES).map(|w| isoline(surface, direction, w[1], along)));
    }
    out
}

/// Whether the normal jumps at the middle one of three parameters.
fn is_crease(surface: &Surface, direction: Direction, at: &[f64], along: Interval) -> bool {
    let step = 1e-7 * (at[2] - at[1]).min(at[1] - at[0]);
    [0.07, 0.31, 0.5, 0.73, 0.94].into_iter().any(|share| {
        let [before, after] = [at[1] - step, at[1] + step].map(|t| {
            let d = surface.first_derivatives(place(direction, t, along.at(share)));
            d.du.cross(d.dv).normalize_or_zero()
        });
        before.cross(after).length() > CREASE_RAD || before.dot(after) < 0.0
    })
}

fn place(direction: Direction, constant: f64, free: f64) -> DVec2 {
    match direction {
        Direction::U => DVec2::new(constant, free),
        Direction::V => DVec2::new(free, constant),
    }
}

fn isoline(surface: &Arc<Surface>, direction: Direction, at: f64, range: Interval) -> Isoline {
    let (free, way) = match direction {
        Direction::U => (Direction::V, DVec3::Y),
        Direction::V => (Direction::U, DVec3::X),
    };
    let pcurve = Curve::Line { origin: place(direction, at, 0.0).extend(0.0), direction: way };
    let curve = Arc::new(Curve::OnSurface { surface: surface.clone(), pcurve: Arc::new(pcurve) });
    let spans = surface.breakpoints(free, range);
    let parts = (MOST_SAMPLES / spans.len().max(1)).clamp(1, PER_SPAN);
    let mut samples: Vec<f64> = spans
        .windows(2)
        .flat_map(|w| (0..parts).map(|k| w[0] + (w[1] - w[0]) * (k as f64 / parts as f64)))
        .collect();
    samples.push(range.end);
    Isoline { curve, range, samples }
}

impl Isoline {
    /// The largest distance of the line from the chords of its samples, by their middles.
    pub fn sag(&self) -> f64 {
        let chords = self.samples.windows(2).map(|w| {
            let [a, b, middle] = [w[0], w[1], (w[0] + w[1]) * 0.5].map(|t| self.curve.point(t));
            let along = (b - a).normalize_or_zero();
            (middle - a - along * (middle - a).dot(along)).length()
        });
        chords.fold(0.0, f64::max)
    }

    /// The parameters of the surface at a parameter of the line.
    pub fn parameters(curve: &Curve, t: f64) -> Option<DVec2> {
        match curve {
            Curve::OnSurface { pcurve, .. } => Some(pcurve.point(t).truncate()),
            _ => None,
        }
    }
}
