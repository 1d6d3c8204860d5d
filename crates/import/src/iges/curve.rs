//! Curves (IGES 5.3 sections 4.3 to 4.23).

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DAffine3, DMat2, DVec2, DVec3};
use trimloop_geom::{
    CompositeCurve, CompositeSegment, Curve, Frame, Interval, NurbsCurve, OffsetCurve, Polyline,
};

use super::reader::{Fault, MAX_DEPTH, Outcome, Parameters, Reader};

/// A bounded curve, run from the range's start to its end.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub curve: Curve,
    pub range: Interval,
    /// The same over the same range in the parameters of a surface that the curve lies on, as far as is known.
    pub image: Option<Arc<Curve>>,
    /// What the file gives for it in the model, where that lies elsewhere and the image is what counts.
    pub told: Option<Arc<(Curve, Interval)>>,
}

/// Types of entities that are curves.
pub(crate) const CURVES: [i32; 8] = [100, 102, 104, 106, 110, 112, 126, 130];

impl Piece {
    /// A curve over a range.
    pub fn new(curve: Curve, range: Interval) -> Self {
        Self { curve, range, image: None, told: None }
    }

    /// The piece moved, as its surface is.
    pub fn placed(&self, map: &DAffine3) -> Self {
        let told = self.told.as_ref().map(|told| Arc::new((told.0.transformed(map), told.1)));
        Self { curve: self.curve.transformed(map), range: self.range, image: self.image.clone(), told }
    }

    /// The piece run the other way.
    pub fn reversed(&self) -> Self {
        let Self { curve, range, .. } = self;
        let back = Interval::new(-range.end, -range.start);
        let over = |frame: &Frame| Frame::new(frame.origin, -frame.z, frame.x);
        let (curve, range) = match curve {
            Curve::Line { origin, direction } => {
                (Curve::Line { origin: *origin, direction: -*direction }, back)
            }
            Curve::Circle { frame, radius } => (Curve::Circle { frame: over(frame), radius: *radius }, back),
            Curve::Ellipse { frame, major, minor } => {
                (Curve::Ellipse { frame: over(frame), major: *major, minor: *minor }, back)
            }
            _ => {
                let segment = CompositeSegment { curve: curve.clone(), range: *range, reversed: true };
                let curve = Curve::Composite(CompositeCurve { segments: vec![segment] });
                (curve, Interval::new(0.0, 1.0))
            }
        };
        Self::new(curve, range)
    }

    /// Its ends.
    pub fn ends(&self) -> [DVec3; 2] {
        [self.curve.point(self.range.start), self.curve.point(self.range.end)]
    }
}

impl Reader<'_> {
    /// Points that are no line, millimetres: a point (116), or copious data of the forms 1 to 3 (106).
    pub fn free_points(&self, entry: u32) -> Outcome<Vec<DVec3>> {
        let mut parameters = self.parameters(entry)?;
        let map = self.placement(parameters.directory)?;
        let points = match parameters.directory.entity_type {
            106 => listed_points(&mut parameters)?,
            _ => vec![parameters.point()?],
        };
        Ok(points.into_iter().map(|point| map.transform_point3(point)).collect())
    }

    /// A curve in the model, millimetres, as the pieces that it is put together from.
    pub fn curve(&self, entry: u32) -> Outcome<Vec<Piece>> {
        let mut out = Vec::new();
        self.add_pieces(entry, true, 0, &mut out)?;
        Ok(out)
    }

    /// A curve in a surface's parameter plane, as it is written.
    pub fn parameter_curve(&self, entry: u32) -> Outcome<Vec<Piece>> {
        let mut out = Vec::new();
        self.add_pieces(entry, false, 0, &mut out)?;
        Ok(out)
    }

    fn add_pieces(&self, entry: u32, in_model: bool, depth: usize, out: &mut Vec<Piece>) -> Outcome<()> {
        if depth > MAX_DEPTH {
            return Err(Fault::new(entry, "is a curve that refers to itself"));
        }
        let mut parameters = self.parameters(entry)?;
        let map = if in_model { self.placement(parameters.directory)? } else { DAffine3::IDENTITY };
        let piece = match parameters.directory.entity_type {
            102 => {
                let before = out.len();
                for _ in 0..parameters.count(1)? {
                    let part = parameters.pointer()?;
                    // Points and the like may stand between curves.
                    if self.file.get(part).is_none_or(|e| CURVES.contains(&e.directory.entity_type)) {
                        self.add_pieces(part, in_model, depth + 1, out)?;
                    }
                }
                if parameters.directory.transformation != 0 && in_model {
                    // The parts are in millimetres already: the composite's own placement is in units.
                    let unit = DAffine3::from_scale(DVec3::splat(self.unit_mm));
                    let own = map * unit.inverse();
                    out[before..].iter_mut().for_each(|piece| *piece = piece.placed(&own));
                }
                return Ok(());
            }
            100 => arc(&mut parameters)?,
            104 => conic(&mut parameters)?,
            106 => copious(&mut parameters)?,
            110 => line(&mut parameters)?,
            112 => parametric_spline(&mut parameters)?,
            126 => rational_spline(&mut parameters)?,
            130 => self.offset_curve(&mut parameters, depth)?,
            _ => return Err(parameters.fault("is no curve that can be read")),
        };
        out.push(piece.placed(&map));
        Ok(())
    }

    /// Type 130, at a constant distance.
    fn offset_curve(&self, parameters: &mut Parameters<'_>, depth: usize) -> Outcome<Piece> {
        let basis = parameters.pointer()?;
        let kind = parameters.integer()?;
        parameters.pointer()?;
        parameters.integer()?;
        parameters.integer()?;
        let distance = parameters.real()?;
        parameters.reals(3)?;
        let normal = parameters.point()?;
        let range = Interval::new(parameters.real()?, parameters.real()?);
        if kind != 1 {
            return Err(parameters.fault("is offset by a distance that varies, which cannot be read"));
        }
        let unscaled = Reader { unit_mm: 1.0, ..*self };
        let mut pieces = Vec::new();
        unscaled.add_pieces(basis, true, depth + 1, &mut pieces)?;
        let Piece { curve: basis, range: whole, .. } = joined(pieces, parameters)?;
        let range = if range.end > range.start { range } else { whole };
        // The offset is to the side that the normal crossed with the tangent points to.
        let curve = Curve::Offset(Box::new(OffsetCurve { basis, distance, ref_direction: -normal }));
        Ok(Piece::new(curve, range))
    }
}

/// Several pieces as one curve.
pub(crate) fn joined(mut pieces: Vec<Piece>, parameters: &Parameters<'_>) -> Outcome<Piece> {
    if pieces.len() == 1 {
        return Ok(pieces.remove(0));
    }
    if pieces.is_empty() {
        return Err(parameters.fault("has a curve without any part"));
    }
    let range = Interval::new(0.0, pieces.len() as f64);
    let segments = pieces.into_iter().map(|Piece { curve, range, .. }| CompositeSegment {
        curve,
        range,
        reversed: false,
    });
    Ok(Piece::new(Curve::Composite(CompositeCurve { segments: segments.collect() }), range))
}

/// Type 100: counter-clockwise about +z.
fn arc(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    let z = parameters.real()?;
    let mut flat = || -> Outcome<DVec3> { Ok(DVec3::new(parameters.real()?, parameters.real()?, z)) };
    let [center, start, end] = [flat()?, flat()?, flat()?];
    let radius = center.distance(start);
    if !(radius > 0.0) {
        return Err(parameters.fault("is an arc without a radius"));
    }
    let frame = Frame::new(center, DVec3::Z, start - center);
    let to_end = frame.local_point(end);
    let mut angle = to_end.y.atan2(to_end.x);
    if angle < 1e-9 || start.distance(end) <= 1e-9 * radius {
        angle += TAU;
    }
    Ok(Piece::new(Curve::Circle { frame, radius }, Interval::new(0.0, angle.min(TAU))))
}

/// Type 110.
fn line(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    let (start, end) = (parameters.point()?, parameters.point()?);
    let curve = Curve::Line { origin: start, direction: end - start };
    Ok(Piece::new(curve, Interval::new(0.0, 1.0)))
}

/// Type 106: the forms that are lines through points.
fn copious(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    let form = parameters.directory.form;
    if !matches!(form, 11..=13 | 63) {
        return Err(parameters.fault(format!("form {form} is no curve")));
    }
    let mut points = listed_points(parameters)?;
    if form == 63 && points.first() != points.last() {
        points.extend(points.first().copied());
    }
    if points.len() < 2 {
        return Err(parameters.fault("has fewer than two points"));
    }
    let polyline = Polyline { points };
    let range = polyline.domain();
    Ok(Piece::new(Curve::Polyline(polyline), range))
}

/// The points of copious data; vectors that go with them are left out.
fn listed_points(parameters: &mut Parameters<'_>) -> Outcome<Vec<DVec3>> {
    let kind = parameters.integer()?;
    let count = parameters.count(2)?;
    match kind {
        1 => {
            let z = parameters.real()?;
            let flat = parameters.reals(2 * count)?;
            Ok(flat.chunks_exact(2).map(|p| DVec3::new(p[0], p[1], z)).collect())
        }
        2 => parameters.points(count),
        3 => Ok(parameters.reals(6 * count)?.chunks_exact(6).map(DVec3::from_slice).collect()),
        _ => Err(parameters.fault(format!("has points of the unknown kind {kind}"))),
    }
}

/// Type 126.
fn rational_spline(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    let last = parameters.count(4)?;
    let degree = parameters.count(1)?;
    parameters.reals(4)?;
    let knots = parameters.reals(last + degree + 2)?;
    let weights = parameters.reals(last + 1)?;
    let points = parameters.points(last + 1)?;
    let range = parameters.optional_real().zip(parameters.optional_real());
    let curve = NurbsCurve::new(degree, points, weights, knots);
    let curve = curve.map_err(|error| parameters.fault(format!("is no B-spline: {error}")))?;
    let domain = curve.domain();
    let told = range.map(|(start, end)| Interval::new(domain.clamp(start), domain.clamp(end)));
    let range = told.filter(|range| range.length() > 1e-12 * domain.length()).unwrap_or(domain);
    Ok(Piece::new(Curve::Nurbs(curve), range))
}

/// Type 112: polynomials of degree three end to end.
fn parametric_spline(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    parameters.integer()?;
    parameters.integer()?;
    parameters.integer()?;
    let count = parameters.count(13)?;
    let breaks = parameters.reals(count + 1)?;
    let mut points = Vec::with_capacity(3 * count + 1);
    for pair in breaks.windows(2) {
        let coefficients = parameters.reals(12)?;
        let at =
            |power: usize| DVec3::new(coefficients[power], coefficients[4 + power], coefficients[8 + power]);
        let step = pair[1] - pair[0];
        let [a, b, c, d] = [at(0), at(1) * step, at(2) * step * step, at(3) * step.powi(3)];
        // The power form as Bezier points.
        let bezier = [a, a + b / 3.0, a + b * (2.0 / 3.0) + c / 3.0, a + b + c + d];
        points.extend(if points.is_empty() { &bezier[..] } else { &bezier[1..] });
    }
    let knots = bezier_knots(&breaks);
    let curve = NurbsCurve::new(3, points, Vec::new(), knots);
    let curve = curve.map_err(|error| parameters.fault(format!("is no spline: {error}")))?;
    let range = curve.domain();
    Ok(Piece::new(Curve::Nurbs(curve), range))
}

/// The knots of cubic Bezier pieces between `breaks`.
pub(crate) fn bezier_knots(breaks: &[f64]) -> Vec<f64> {
    let ends = breaks.first().into_iter().chain(breaks.last());
    let mut knots: Vec<f64> = breaks.iter().flat_map(|&at| [at; 3]).chain(ends.copied()).collect();
    knots.sort_by(f64::total_cmp);
    knots
}

/// Type 104: `A x^2 + B x y + C y^2 + D x + E y + F = 0` in the plane z = ZT, from one point to another.
fn conic(parameters: &mut Parameters<'_>) -> Outcome<Piece> {
    let [a, b, c, d, e, f] = parameters.reals(6)?[..] else { return Err(parameters.fault("is cut short")) };
    let z = parameters.real()?;
    let mut flat = || -> Outcome<DVec2> { Ok(DVec2::new(parameters.real()?, parameters.real()?)) };
    let [start, end] = [flat()?, flat()?];
    let quadratic = DMat2::from_cols(DVec2::new(a, b / 2.0), DVec2::new(b / 2.0, c));
    let curve = conic_curve(quadratic, DVec2::new(d, e), f, start, z)
        .ok_or_else(|| parameters.fault("is a conic without any point"))?;
    let foot = |p: DVec2| curve.project(p.extend(z), None).t;
    let (from, to) = (foot(start), foot(end));
    if let Some(period) = curve.period() {
        let turn = (to - from).rem_euclid(period);
        let turn = if turn < 1e-9 { period } else { turn };
        return Ok(Piece::new(curve, Interval::new(from, from + turn)));
    }
    if from <= to {
        return Ok(Piece::new(curve, Interval::new(from, to)));
    }
    // Run the other way, by turning the frame over.
    let curve = turned_over(curve);
    Ok(Piece::new(curve, Interval::new(-from, -to)))
}

fn turned_over(curve: Curve) -> Curve {
    let over = |frame: Frame| Frame::new(frame.origin, -frame.z, frame.x);
    match curve {
        Curve::Parabola { frame, focal } => Curve::Parabola { frame: over(frame), focal },
        Curve::Hyperbola { frame, major, minor } => Curve::Hyperbola { frame: over(frame), major, minor },
        other => other,
    }
}

fn conic_curve(quadratic: DMat2, linear: DVec2, constant: f64, start: DVec2, z: f64) -> Option<Curve> {
    let (values, axes) = eigen(quadratic);
    let size = values[0].abs().max(values[1].abs());
    if !(size > 0.0) {
        return None;
    }
    let frame = |center: DVec2, x: DVec2| Frame::new(center.extend(z), DVec3::Z, x.extend(0.0));
    if values[0].abs() <= 1e-9 * size || values[1].abs() <= 1e-9 * size {
        // A parabola: curved along one axis, open along the other.
        let k = usize::from(values[0].abs() <= 1e-9 * size);
        let (curved, open) = (axes[k], axes[1 - k]);
        let (slope, along) = (linear.dot(curved), linear.dot(open));
        if along.abs() <= 1e-12 * size {
            return None;
        }
        let offset = -slope / (2.0 * values[k]);
        let height = -(values[k] * offset * offset + slope * offset + constant) / along;
        let vertex = curved * offset + open * height;
        let focal = -along / (4.0 * values[k]);
        return Some(Curve::Parabola { frame: frame(vertex, open * focal.signum()), focal: focal.abs() });
    }
    let center = -0.5 * (quadratic.inverse() * linear);
    let level = -(constant + 0.5 * linear.dot(center));
    let squares = [level / values[0], level / values[1]];
    match (squares[0] > 0.0, squares[1] > 0.0) {
        (true, true) => {
            let k = usize::from(squares[1] > squares[0]);
            let (major, minor) = (squares[k].sqrt(), squares[1 - k].sqrt());
            Some(Curve::Ellipse { frame: frame(center, axes[k]), major, minor })
        }
        (false, false) => None,
        (first, _) => {
            let k = usize::from(!first);
            let side = (start - center).dot(axes[k]).signum();
            let (major, minor) = (squares[k].sqrt(), (-squares[1 - k]).sqrt());
            Some(Curve::Hyperbola { frame: frame(center, axes[k] * side), major, minor })
        }
    }
}

/// Eigenvalues of a symmetric matrix and its unit eigenvectors.
fn eigen(m: DMat2) -> ([f64; 2], [DVec2; 2]) {
    let angle = 0.5 * (2.0 * m.x_axis.y).atan2(m.x_axis.x - m.y_axis.y);
    let first = DVec2::from_angle(angle);
    let second = first.perp();
    ([first.dot(m * first), second.dot(m * second)], [first, second])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(quadratic: [f64; 3], linear: [f64; 2], constant: f64, start: DVec2) -> Curve {
        let [a, b, c] = quadratic;
        let matrix = DMat2::from_cols(DVec2::new(a, b / 2.0), DVec2::new(b / 2.0, c));
        conic_curve(matrix, linear.into(), constant, start, 0.0).expect("a conic")
    }

    #[test]
    fn conics_satisfy_their_equations() {
        let cases = [
            ([4.0, 0.0, 9.0], [8.0, -18.0], -23.0),
            ([1.0, 1.0, 2.0], [0.5, -1.0], -3.0),
            ([1.0, 0.0, -4.0], [2.0, 3.0], -7.0),
            ([0.0, 3.0, 0.0], [1.0, 0.0], -2.0),
            ([1.0, 0.0, 0.0], [0.0, -4.0], 2.0),
            ([1.0, 2.0, 1.0], [3.0, -1.0], 0.5),
        ];
        for (quadratic, linear, constant) in cases {
            let curve = at(quadratic, linear, constant, DVec2::new(9.0, 8.0));
            for t in [-1.0, -0.3, 0.2, 1.1] {
                let p = curve.point(t);
                let value = quadratic[0] * p.x * p.x
                    + quadratic[1] * p.x * p.y
                    + quadratic[2] * p.y * p.y
                    + linear[0] * p.x
                    + linear[1] * p.y
                    + constant;
                assert!(value.abs() < 1e-9, "{curve:?} at {t}: {value}");
            }
        }
    }
}
