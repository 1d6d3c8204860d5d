//! How two items lie to each other.

use glam::DVec3;

use crate::Item;
use crate::carrier::{Axis, Carrier};
use crate::middle::centred;
use crate::sampled::{Ground, Sampled};
use crate::search::search;

/// Measures between two items: world coordinates, millimetres, degrees.
///
/// Angles, parallels and distances of axes are those of the unbounded shapes: a face on a plane counts by its normal,
/// an edge on a line by its direction, and what turns about an axis (cylinder, cone, torus, circle, ellipse) by that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// The smallest distance of the two, as far as faces and edges reach; 0 where they touch or cross.
    pub distance_mm: f64,
    /// Where it is reached, on the first and on the second. Where that is so all over a line or an area, the middle of
    /// it.
    pub points: [DVec3; 2],
    /// Whether both points are on the exact shapes and no step brings them nearer; else the distance is from samples, or
    /// an item has parts that could not be used.
    pub is_exact: bool,
    /// From the first point to the second.
    pub delta: DVec3,
    /// From 0 to 90: the smaller angle of two planes (that of their normals), of two lines or axes; between a line or
    /// axis and a plane, 90 where it is square to it.
    pub angle_deg: Option<f64>,
    /// Whether that angle is 0 to within 1e-6 degrees.
    pub is_parallel: bool,
    /// The distance of two parallel planes, of a plane and a parallel line or axis, of two parallel lines or axes, all
    /// unbounded.
    pub parallel_distance_mm: Option<f64>,
    /// The smallest distance of two unbounded axes, or of an axis and an unbounded line.
    pub axis_distance_mm: Option<f64>,
    /// From centre to centre, of circles, ellipses, spheres and tori; a vertex counts as a centre beside one of them.
    pub center_distance_mm: Option<f64>,
}

/// Parallel is what is at no larger angle.
const PARALLEL_DEG: f64 = 1e-6;

/// Descents for one pair of items.
const BUDGET: usize = 160;

/// What is this near, as a share of the coordinates, touches.
const TOUCH: f64 = 1e-13;

/// How two items lie to each other; `None` where one has no geometry.
pub fn between(a: Item, b: Item) -> Option<Between> {
    let carriers = [Carrier::of(&a)?, Carrier::of(&b)?];
    let grounds = [Ground::new(&a), Ground::new(&b)];
    let first = Sampled::new(&grounds[0], &a.transform)?;
    let second = Sampled::new(&grounds[1], &b.transform)?;
    let best = centred(&first, &second, search(&first, &second, BUDGET)?);
    let extent = first.extent().max(second.extent());
    let is_touching = best.distance <= TOUCH * extent;
    let relation = Relation::new(&carriers);
    Some(Between {
        distance_mm: if is_touching { 0.0 } else { best.distance },
        points: best.points,
        is_exact: best.is_exact,
        delta: best.points[1] - best.points[0],
        angle_deg: relation.angle_deg,
        is_parallel: relation.is_parallel,
        parallel_distance_mm: relation.parallel_distance_mm,
        axis_distance_mm: axis_distance(&carriers),
        center_distance_mm: center_distance(&carriers),
    })
}

/// What is known of two directions.
#[derive(Default)]
struct Relation {
    angle_deg: Option<f64>,
    is_parallel: bool,
    parallel_distance_mm: Option<f64>,
}

/// What has a direction.
#[derive(Clone, Copy)]
enum Straight {
    Line(Axis),
    Plane(Axis),
}

impl Straight {
    fn of(carrier: &Carrier) -> Option<Self> {
        match *carrier {
            Carrier::Line(axis) => Some(Self::Line(axis)),
            Carrier::Plane { origin, normal } => Some(Self::Plane(Axis { origin, direction: normal })),
            _ => carrier.axis().map(Self::Line),
        }
    }
}

impl Relation {
    fn new([a, b]: &[Carrier; 2]) -> Self {
        let (Some(a), Some(b)) = (Straight::of(a), Straight::of(b)) else { return Self::default() };
        let (angle, distance) = match (a, b) {
            (Straight::Plane(p), Straight::Plane(q)) => {
                (acute_deg(&p, &q), (q.origin - p.origin).dot(p.direction))
            }
            (Straight::Line(p), Straight::Line(q)) => (acute_deg(&p, &q), parallel_lines(&p, &q)),
            (Straight::Plane(plane), Straight::Line(line))
            | (Straight::Line(line), Straight::Plane(plane)) => {
                (slope_deg(&line, &plane), (line.origin - plane.origin).dot(plane.direction))
            }
        };
        let is_parallel = angle <= PARALLEL_DEG;
        let distance = distance.abs();
        Self { angle_deg: Some(angle), is_parallel, parallel_distance_mm: is_parallel.then_some(distance) }
    }
}

/// The smaller angle of two directions; by sine and cosine, so that small ones and right ones are alike exact.
fn acute_deg(a: &Axis, b: &Axis) -> f64 {
    a.direction.cross(b.direction).length().atan2(a.direction.dot(b.direction).abs()).to_degrees()
}

/// The angle of a line with a plane.
fn slope_deg(line: &Axis, plane: &Axis) -> f64 {
    let (line, normal) = (line.direction, plane.direction);
    line.dot(normal).abs().atan2(line.cross(normal).length()).to_degrees()
}

fn parallel_lines(a: &Axis, b: &Axis) -> f64 {
    (b.origin - a.origin).reject_from_normalized(a.direction).length()
}

/// The smallest distance of two unbounded lines, at least one of which is an axis.
fn axis_distance(carriers: &[Carrier; 2]) -> Option<f64> {
    if carriers.iter().all(|c| c.axis().is_none()) {
        return None;
    }
    let [a, b] = [0, 1].map(|k| match carriers[k] {
        Carrier::Line(line) => Some(line),
        ref other => other.axis(),
    });
    let (a, b) = (a?, b?);
    let square = a.direction.cross(b.direction);
    if acute_deg(&a, &b) <= PARALLEL_DEG {
        return Some(parallel_lines(&a, &b));
    }
    square.try_normalize().map(|square| (b.origin - a.origin).dot(square).abs())
}

fn center_distance(carriers: &[Carrier; 2]) -> Option<f64> {
    if carriers.iter().all(|c| c.center().is_none()) {
        return None;
    }
    let [a, b] = [0, 1].map(|k| match carriers[k] {
        Carrier::Point(point) => Some(point),
        ref other => other.center(),
    });
    Some(a?.distance(b?))
}
