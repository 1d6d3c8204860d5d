//! Surfaces (IGES 5.3 sections 4.12 to 4.17, 4.25, 4.29, 4.39 to 4.45).

use std::f64::consts::TAU;

use glam::{DAffine3, DMat3, DVec2, DVec3, DVec4};
use trimloop_geom::{
    CompositeCurve, CompositeSegment, Curve, Direction, Frame, Interval, NurbsCurve, NurbsSurface, Surface,
};

use super::curve::{Piece, bezier_knots, joined};
use super::reader::{Fault, MAX_DEPTH, Outcome, Parameters, Reader};
use crate::seam::close_seams;

/// A surface, placed in the model, millimetres.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    pub surface: Surface,
    /// From the parameters that the file means to those of `surface`.
    pub parameters: DAffine3,
    /// The part of `surface` that the entity is, where that is not all of it.
    pub domain: Option<[Interval; 2]>,
    /// Whether the surface's normal is opposite to the one that the file means.
    pub reversed: bool,
}

/// Types of entities that are surfaces.
pub(crate) const SURFACES: [i32; 12] = [108, 114, 118, 120, 122, 128, 140, 190, 192, 194, 196, 198];

/// Surfaces that are revolved by as much as this less than a whole turn, or more, are closed.
const WHOLE_TURN_RAD: f64 = 3e-5;

impl Ground {
    fn whole(surface: Surface) -> Self {
        Self { surface, parameters: DAffine3::IDENTITY, domain: None, reversed: false }
    }

    /// The elementary surface that a revolution is, where it is one and nothing depends on its parameters, and whether
    /// its normal is on the file's side.
    pub fn simplified(&self) -> (Surface, bool) {
        let same_sense = !self.reversed;
        let Some(simple) = elementary(&self.surface) else { return (self.surface.clone(), same_sense) };
        let [u, v] = self.domain.unwrap_or_else(|| self.surface.domain());
        let uv = DVec2::new(u.at(0.31), v.at(0.47));
        let normals =
            self.surface.normal(uv).zip(simple.normal(simple.project(self.surface.point(uv), None).uv));
        let agree = normals.is_none_or(|(a, b)| a.dot(b) > 0.0);
        (simple, same_sense == agree)
    }

    /// All of the entity, and the parameters that it ends at: as a spline, where it can be one; `None` where it never
    /// ends.
    pub fn untrimmed(&self) -> Option<(Surface, [Interval; 2])> {
        let domain = self.domain.unwrap_or_else(|| self.surface.domain());
        if !domain.iter().all(|range| range.is_finite()) {
            return None;
        }
        match (&self.surface, self.domain) {
            (surface, Some(domain)) => {
                let spline = surface.to_nurbs(domain).map(|spline| (spline.domain(), Surface::Nurbs(spline)));
                Some(spline.map_or_else(|| (surface.clone(), domain), |(domain, spline)| (spline, domain)))
            }
            (surface, None) => Some((surface.clone(), domain)),
        }
    }
}

impl Reader<'_> {
    /// A surface in the model, millimetres.
    pub fn surface(&self, entry: u32) -> Outcome<Ground> {
        self.surface_within(entry, 0)
    }

    fn surface_within(&self, entry: u32, depth: usize) -> Outcome<Ground> {
        if depth > MAX_DEPTH {
            return Err(Fault::new(entry, "is a surface that refers to itself"));
        }
        let mut parameters = self.parameters(entry)?;
        let map = self.placement(parameters.directory)?;
        let mut ground = match parameters.directory.entity_type {
            108 => plane(&mut parameters)?,
            114 => Ground::whole(parametric_spline(&mut parameters)?),
            118 => self.ruled(&mut parameters)?,
            120 => self.revolution(&mut parameters)?,
            122 => self.tabulated_cylinder(&mut parameters)?,
            128 => Ground::whole(rational_spline(&mut parameters)?),
            140 => self.offset_surface(&mut parameters, depth)?,
            190..=198 => self.elementary(&mut parameters)?,
            _ => return Err(parameters.fault("is no surface that can be read")),
        };
        let (surface, turned) = ground.surface.transformed(&map);
        let unit = |axis: DVec2| ground.surface.transformed_uv(&map, axis);
        let scale = DVec3::new(unit(DVec2::X).x, unit(DVec2::Y).y, 1.0);
        ground.parameters = DAffine3::from_scale(scale) * ground.parameters;
        ground.surface = surface;
        ground.reversed ^= turned && map.matrix3.determinant() > 0.0;
        Ok(ground)
    }

    /// A curve in the units of the surface that it belongs to.
    fn unscaled_curve(&self, entry: u32, parameters: &Parameters<'_>) -> Outcome<Piece> {
        let unscaled = Reader { unit_mm: 1.0, ..*self };
        joined(unscaled.curve(entry)?, parameters)
    }

    /// Type 118: between curves whose parameters run alike.
    fn ruled(&self, parameters: &mut Parameters<'_>) -> Outcome<Ground> {
        let (first, second) = (parameters.pointer()?, parameters.pointer()?);
        let turned = parameters.integer()? == 1;
        let pieces = [self.unscaled_curve(first, parameters)?, self.unscaled_curve(second, parameters)?];
        // Arcs that turn alike are ruled alike, whatever their parameters.
        let alike = turn_alike(&pieces[0], &pieces[1]);
        let spline = |piece: &Piece| -> Outcome<NurbsCurve> {
            let followed = if alike { None } else { followed(piece) };
            let spline = followed.or_else(|| piece.curve.to_nurbs(piece.range));
            let spline = spline.and_then(|it| it.reparametrized(Interval::new(0.0, 1.0)).ok());
            spline.ok_or_else(|| parameters.fault("is ruled along a curve that is no spline"))
        };
        let (mut a, mut b) = (spline(&pieces[0])?, spline(&pieces[1])?);
        if turned {
            b = b.reversed();
        }
        let degree = a.degree().max(b.degree());
        a = a.elevated(degree - a.degree());
        b = b.elevated(degree - b.degree());
        let (missing_in_a, missing_in_b) = (missing(a.knots(), b.knots()), missing(b.knots(), a.knots()));
        (a, b) = (a.refined(&missing_in_a), b.refined(&missing_in_b));
        let points: Vec<DVec4> =
            a.homogeneous().into_iter().zip(b.homogeneous()).flat_map(|(a, b)| [a, b]).collect();
        let knots = [a.knots().to_vec(), vec![0.0, 0.0, 1.0, 1.0]];
        let rows = a.points().len();
        let surface = NurbsSurface::from_homogeneous([degree, 1], rows, 2, &points, knots);
        let surface = surface.map_err(|error| parameters.fault(format!("cannot be ruled: {error}")))?;
        Ok(Ground::whole(Surface::Nurbs(surface)))
    }

    /// Type 120: u is the generatrix's parameter, v the angle; ours are the other way round.
    fn revolution(&self, parameters: &mut Parameters<'_>) -> Outcome<Ground> {
        let (axis, generatrix) = (parameters.pointer()?, parameters.pointer()?);
        let (start, end) = (parameters.real()?, parameters.real()?);
        let axis = self.unscaled_curve(axis, parameters)?;
        let [origin, to] = axis.ends();
        let Piece { curve, range, .. } = self.unscaled_curve(generatrix, parameters)?;
        let axis = (to - origin).try_normalize();
        let axis = axis.ok_or_else(|| parameters.fault("is revolved about an axis of no length"))?;
        let mut parameters = DAffine3::from_mat3(DMat3::from_cols(DVec3::Y, DVec3::X, DVec3::Z));
        let (curve, range) = match curve {
            // The rest of a conic would cover the surface again.
            Curve::Circle { .. }
            | Curve::Ellipse { .. }
            | Curve::Parabola { .. }
            | Curve::Hyperbola { .. } => {
                let length = range.length();
                parameters = DAffine3::from_scale(DVec3::new(1.0, 1.0 / length, 1.0))
                    * DAffine3::from_translation(DVec3::Y * -range.start)
                    * parameters;
                let segment = CompositeSegment { curve, range, reversed: false };
                let whole = Curve::Composite(CompositeCurve { segments: vec![segment] });
                (whole, Interval::new(0.0, 1.0))
            }
            curve => (curve, range),
        };
        let angles = Interval::new(start.min(end), start.max(end));
        // A whole turn as written with a few digits.
        let is_whole = (angles.length() - TAU).abs() <= WHOLE_TURN_RAD;
        let angles = if is_whole { Interval::new(angles.start, angles.start + TAU) } else { angles };
        Ok(Ground {
            surface: Surface::Revolution { profile: curve.into(), origin, axis },
            parameters,
            domain: Some([angles, range]),
            reversed: true,
        })
    }

    /// Type 122: u runs from 0 to 1 along the directrix, v from 0 to 1 along the generatrix.
    fn tabulated_cylinder(&self, parameters: &mut Parameters<'_>) -> Outcome<Ground> {
        let directrix = parameters.pointer()?;
        let to = parameters.point()?;
        let Piece { curve, range, .. } = self.unscaled_curve(directrix, parameters)?;
        let direction = to - curve.point(range.start);
        if !(direction.length() > 0.0) {
            return Err(parameters.fault("is extruded by nothing"));
        }
        let scale = DAffine3::from_scale(DVec3::new(range.length(), 1.0, 1.0));
        Ok(Ground {
            surface: Surface::Extrusion { profile: curve.into(), direction },
            parameters: DAffine3::from_translation(DVec3::X * range.start) * scale,
            domain: Some([range, Interval::new(0.0, 1.0)]),
            reversed: false,
        })
    }

    /// Type 140.
    fn offset_surface(&self, parameters: &mut Parameters<'_>, depth: usize) -> Outcome<Ground> {
        let indicator = parameters.point()?;
        let distance = parameters.real()?;
        let basis = parameters.pointer()?;
        let unscaled = Reader { unit_mm: 1.0, ..*self };
        let mut ground = unscaled.surface_within(basis, depth + 1)?;
        let middle = match ground.domain.or_else(|| domain_of(&ground.surface)) {
            Some([u, v]) => ground.surface.normal(DVec2::new(u.at(0.5), v.at(0.5))),
            None => ground.surface.normal(DVec2::ZERO),
        };
        // The indicator says which side is meant; the basis' own normal may be on the other one.
        let turned = middle.is_some_and(|normal| normal.dot(indicator) < 0.0);
        let distance = if turned { -distance } else { distance };
        ground.surface = Surface::Offset { basis: ground.surface.into(), distance };
        Ok(ground)
    }

    /// Types 190 to 198.
    fn elementary(&self, parameters: &mut Parameters<'_>) -> Outcome<Ground> {
        let kind = parameters.directory.entity_type;
        let at = self.triple(parameters.pointer()?, &[116], "point")?;
        // Only form 1 goes on with the directions that fix the parameters.
        let is_parametrised = parameters.directory.form == 1;
        let radius_first = kind == 196;
        let mut radius = if radius_first { parameters.real()? } else { 0.0 };
        let direction = |parameters: &mut Parameters<'_>, or: DVec3| -> Outcome<DVec3> {
            match parameters.pointer()? {
                0 => Ok(or),
                entry => self.triple(entry, &[123], "direction"),
            }
        };
        let has_axis = kind != 196 || is_parametrised;
        let axis = if has_axis { direction(parameters, DVec3::Z)? } else { DVec3::Z };
        let mut second = 0.0;
        if matches!(kind, 192 | 194 | 198) {
            radius = parameters.real()?;
        }
        if matches!(kind, 194 | 198) {
            second = parameters.real()?;
        }
        let across = beside(axis);
        let across = if is_parametrised { direction(parameters, across)? } else { across };
        let frame = Frame::new(at, axis, across);
        let surface = match kind {
            190 => Surface::Plane { frame },
            192 => Surface::Cylinder { frame, radius },
            194 => Surface::Cone { frame, radius, half_angle_rad: second.to_radians() },
            196 => Surface::Sphere { frame, radius },
            198 => Surface::Torus { frame, major: radius, minor: second, v_range: None },
            _ => return Err(parameters.fault("is no surface that can be read")),
        };
        let sound = match kind {
            190 => true,
            194 => radius >= 0.0 && second > 0.0 && second < 90.0,
            198 => radius > 0.0 && second > 0.0,
            _ => radius > 0.0,
        };
        if !sound {
            return Err(parameters.fault("has a radius or an angle that cannot be"));
        }
        // Angles among the parameters are in degrees.
        let degree = 1f64.to_radians();
        let factors = match kind {
            190 => DVec3::ONE,
            192 | 194 => DVec3::new(degree, 1.0, 1.0),
            _ => DVec3::new(degree, degree, 1.0),
        };
        Ok(Ground { parameters: DAffine3::from_scale(factors), ..Ground::whole(surface) })
    }
}

fn domain_of(surface: &Surface) -> Option<[Interval; 2]> {
    match surface {
        Surface::Nurbs(nurbs) => Some(nurbs.domain()),
        _ => None,
    }
}

/// The cylinder, cone or plane that a line makes when it is revolved, the sphere or torus that an arc makes.
pub(crate) fn elementary(surface: &Surface) -> Option<Surface> {
    let Surface::Revolution { profile, origin, axis } = surface else { return None };
    if let Some((frame, radius)) = circular(profile) {
        return round(frame, radius, *origin, *axis);
    }
    let (start, direction) = straight(profile)?;
    let out = |p: DVec3| p - *axis * p.dot(*axis);
    let along = direction.try_normalize()?;
    let (height, across) = (along.dot(*axis), out(along));
    let from = out(start - *origin);
    let size = from.length() + direction.length();
    let frame = |z: DVec3, at: DVec3| Frame::new(*origin + *axis * (at - *origin).dot(*axis), z, from);
    if across.length() <= 1e-12 {
        return (from.length() > 1e-9 * size)
            .then(|| Surface::Cylinder { frame: frame(*axis, start), radius: from.length() });
    }
    // Only a line that meets the axis makes a cone or a plane.
    let meets = from.cross(across.normalize()).length() <= 1e-9 * size;
    if !meets || from.length() <= 1e-9 * size {
        return None;
    }
    if height.abs() <= 1e-12 {
        return Some(Surface::Plane { frame: frame(*axis, start) });
    }
    let widens = across.dot(from).signum() * height.signum();
    let half_angle_rad = across.length().atan2(height.abs());
    Some(Surface::Cone { frame: frame(*axis * widens, start), radius: from.length(), half_angle_rad })
}

/// The circle of a curve that is an arc.
fn circular(curve: &Curve) -> Option<(Frame, f64)> {
    match curve {
        Curve::Circle { frame, radius } => Some((*frame, *radius)),
        Curve::Composite(composite) => match &composite.segments[..] {
            [segment] => circular(&segment.curve),
            _ => None,
        },
        _ => None,
    }
}

/// What a circle makes when it is revolved about an axis in its plane, if it does not cross itself.
fn round(circle: Frame, radius: f64, origin: DVec3, axis: DVec3) -> Option<Surface> {
    let to_center = circle.origin - origin;
    let size = radius + to_center.length();
    let flat = circle.z.dot(axis).abs() <= 1e-9 && to_center.dot(circle.z).abs() <= 1e-9 * size;
    let foot = origin + axis * to_center.dot(axis);
    let out = circle.origin - foot;
    if !flat {
        None
    } else if out.length() <= 1e-9 * size {
        let frame = Frame::new(circle.origin, axis, circle.z.cross(axis));
        Some(Surface::Sphere { frame, radius })
    } else if out.length() > radius * (1.0 + 1e-9) {
        let frame = Frame::new(foot, axis, out);
        Some(Surface::Torus { frame, major: out.length(), minor: radius, v_range: None })
    } else {
        None
    }
}

/// A point and the direction of a curve that is straight.
fn straight(curve: &Curve) -> Option<(DVec3, DVec3)> {
    match curve {
        Curve::Line { origin, direction } => Some((*origin, *direction)),
        Curve::Nurbs(nurbs) => {
            let (first, last) = (*nurbs.points().first()?, *nurbs.points().last()?);
            let along = (last - first).try_normalize()?;
            let off = |p: &DVec3| (*p - first).reject_from_normalized(along).length();
            let near = 1e-12 * first.distance(last).max(first.length());
            nurbs.points().iter().all(|p| off(p) <= near).then_some((first, last - first))
        }
        Curve::Polyline(polyline) if polyline.points.len() == 2 => {
            Some((polyline.points[0], polyline.points[1] - polyline.points[0]))
        }
        _ => None,
    }
}

/// Whether two pieces are arcs over the same angle.
fn turn_alike(a: &Piece, b: &Piece) -> bool {
    let is_arc = |piece: &Piece| matches!(piece.curve, Curve::Circle { .. } | Curve::Ellipse { .. });
    is_arc(a) && is_arc(b) && (a.range.length() - b.range.length()).abs() <= 1e-12
}

/// Spans in a turn of an arc: the spline is then within 2e-9 of the radius.
const SPANS_PER_TURN: f64 = 200.0;

/// A spline that follows an arc with the arc's own parameter, which no rational one does: cubics that have its points and
/// tangents (Hermite). Nothing for curves that are splines in their own parameter.
fn followed(piece: &Piece) -> Option<NurbsCurve> {
    let spans = match piece.curve {
        Curve::Circle { .. } | Curve::Ellipse { .. } => piece.range.length() / TAU * SPANS_PER_TURN,
        Curve::Hyperbola { .. } => piece.range.length() * SPANS_PER_TURN / 4.0,
        _ => return None,
    };
    let spans = spans.ceil().clamp(1.0, 10_000.0) as usize;
    let breaks: Vec<f64> = (0..=spans).map(|k| piece.range.at(k as f64 / spans as f64)).collect();
    let third = piece.range.length() / spans as f64 / 3.0;
    let mut points = Vec::with_capacity(3 * spans + 1);
    for (k, &t) in breaks.iter().enumerate() {
        let [point, tangent, _] = piece.curve.derivatives(t);
        if k > 0 {
            points.push(point - tangent * third);
        }
        points.push(point);
        if k < spans {
            points.push(point + tangent * third);
        }
    }
    NurbsCurve::new(3, points, Vec::new(), bezier_knots(&breaks)).ok()
}

/// The knots of `other` that `knots` lacks, as often as it lacks them.
fn missing(knots: &[f64], other: &[f64]) -> Vec<f64> {
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9;
    let count = |knots: &[f64], at: f64| knots.iter().filter(|&&knot| near(knot, at)).count();
    let mut out = Vec::new();
    for &at in other {
        let lacking = count(other, at).saturating_sub(count(knots, at));
        if count(&out, at) < lacking {
            out.push(at);
        }
    }
    out
}

/// Type 108: `A x + B y + C z = D`.
fn plane(parameters: &mut Parameters<'_>) -> Outcome<Ground> {
    let normal = parameters.point()?;
    let distance = parameters.real()?;
    let length = normal.length_squared();
    if !(length > 0.0) {
        return Err(parameters.fault("is a plane without a normal"));
    }
    let frame = Frame::new(normal * (distance / length), normal, beside(normal));
    Ok(Ground::whole(Surface::Plane { frame }))
}

/// A direction at right angles to an axis for which the file names no reference direction: in the coordinate plane that
/// is nearest to the axis, as OpenCASCADE takes it. What depends on it, seams and the diagonals of rectangles, is then
/// where its users know it.
pub(crate) fn beside(axis: DVec3) -> DVec3 {
    let DVec3 { x, y, z } = axis;
    let size = axis.abs();
    if size.y <= size.x && size.y <= size.z {
        if size.x > size.z { DVec3::new(-z, 0.0, x) } else { DVec3::new(z, 0.0, -x) }
    } else if size.x <= size.y && size.x <= size.z {
        if size.y > size.z { DVec3::new(0.0, -z, y) } else { DVec3::new(0.0, z, -y) }
    } else if size.x > size.y {
        DVec3::new(-y, x, 0.0)
    } else {
        DVec3::new(y, -x, 0.0)
    }
}

/// Type 128: the first index of weights and points runs along u and changes first.
fn rational_spline(parameters: &mut Parameters<'_>) -> Outcome<Surface> {
    let [rows, columns] = [parameters.count(1)? + 1, parameters.count(1)? + 1];
    let degrees = [parameters.count(0)?, parameters.count(0)?];
    parameters.reals(5)?;
    let knots = [parameters.reals(rows + degrees[0] + 1)?, parameters.reals(columns + degrees[1] + 1)?];
    let size = rows.saturating_mul(columns);
    let weights = parameters.reals(size)?;
    let points = parameters.points(size)?;
    let row_major = |k: usize| (k % columns) * rows + k / columns;
    let weights: Vec<f64> = (0..size).map(|k| weights[row_major(k)]).collect();
    let mut points: Vec<DVec3> = (0..size).map(|k| points[row_major(k)]).collect();
    close_seams(degrees, [rows, columns], &mut points, &weights, &knots);
    let surface = NurbsSurface::new(degrees, rows, columns, points, weights, knots);
    let surface = surface.map_err(|error| parameters.fault(format!("is no B-spline: {error}")))?;
    let told = parameters.reals(4).ok();
    let domain = surface.domain();
    let restricted = told.and_then(|told| {
        let [u, v] = [Direction::U, Direction::V].map(|direction| surface.distinct_knots(direction));
        let part = [told_range(told[0], told[1], &u), told_range(told[2], told[3], &v)];
        let inside = (0..2).all(|k| {
            let slack = 1e-9 * domain[k].length();
            part[k].start >= domain[k].start - slack
                && part[k].end <= domain[k].end + slack
                && part[k].length() > 1e-6 * domain[k].length()
        });
        let smaller = (0..2).any(|k| part[k].length() < (1.0 - 1e-9) * domain[k].length());
        (inside && smaller).then(|| surface.restricted(part).ok()).flatten()
    });
    Ok(Surface::Nurbs(restricted.unwrap_or(surface)))
}

/// A range that a file states, with its ends at knots that they differ from in the last digits only.
fn told_range(start: f64, end: f64, knots: &[f64]) -> Interval {
    let slack = 1e-9 * (knots[knots.len() - 1] - knots[0]);
    let at = |told: f64| knots.iter().copied().find(|knot| (knot - told).abs() <= slack).unwrap_or(told);
    Interval::new(at(start), at(end))
}

/// Type 114: bicubic patches in power form.
fn parametric_spline(parameters: &mut Parameters<'_>) -> Outcome<Surface> {
    parameters.integer()?;
    parameters.integer()?;
    let counts = [parameters.count(1)?, parameters.count(1)?];
    let breaks = [parameters.reals(counts[0] + 1)?, parameters.reals(counts[1] + 1)?];
    let shape = [3 * counts[0] + 1, 3 * counts[1] + 1];
    if counts.contains(&0) || counts[0].saturating_mul(counts[1]) > 1 << 22 {
        return Err(parameters.fault("has no patches, or more than can be read"));
    }
    let mut points = vec![DVec3::ZERO; shape[0] * shape[1]];
    for i in 0..counts[0] {
        // A row of patches ends with one that means nothing.
        for j in 0..=counts[1] {
            let is_last = i + 1 == counts[0] && j == counts[1];
            let coefficients = match parameters.reals(48) {
                Err(_) if is_last => break,
                read => read?,
            };
            if j == counts[1] {
                continue;
            }
            let steps = [breaks[0][i + 1] - breaks[0][i], breaks[1][j + 1] - breaks[1][j]];
            for (k, point) in bezier_patch(&coefficients, steps).into_iter().enumerate() {
                points[(3 * i + k / 4) * shape[1] + 3 * j + k % 4] = point;
            }
        }
    }
    let knots = [bezier_knots(&breaks[0]), bezier_knots(&breaks[1])];
    close_seams([3, 3], shape, &mut points, &[], &knots);
    let surface = NurbsSurface::new([3, 3], shape[0], shape[1], points, Vec::new(), knots);
    surface.map(Surface::Nurbs).map_err(|error| parameters.fault(format!("is no spline: {error}")))
}

/// The 4 x 4 Bezier points (u along rows) of a patch whose coefficient of s^i t^j is number i + 4 j per coordinate.
fn bezier_patch(coefficients: &[f64], steps: [f64; 2]) -> [DVec3; 16] {
    /// Bezier point k is the sum of these times the power coefficients.
    const FROM_POWER: [[f64; 4]; 4] = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0 / 3.0, 0.0, 0.0],
        [1.0, 2.0 / 3.0, 1.0 / 3.0, 0.0],
        [1.0, 1.0, 1.0, 1.0],
    ];
    let mut out = [DVec3::ZERO; 16];
    for (k, point) in out.iter_mut().enumerate() {
        for (i, u_share) in FROM_POWER[k / 4].into_iter().enumerate() {
            for (j, v_share) in FROM_POWER[k % 4].into_iter().enumerate() {
                let at = i + 4 * j;
                let power = DVec3::new(coefficients[at], coefficients[16 + at], coefficients[32 + at]);
                let step = steps[0].powi(i as i32) * steps[1].powi(j as i32);
                *point += power * (u_share * v_share * step);
            }
        }
    }
    out
}
