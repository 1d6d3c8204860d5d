//! Faces that came one by one: surfaces and their boundaries (IGES 5.3 sections 4.12, 4.31 to 4.34).

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use trimloop_geom::{Curve, Direction, Interval, NurbsCurve, Surface};

use super::curve::Piece;
use super::plane_order::loops_in_plane;
use super::reader::{Fault, Outcome, Parameters, Reader};
use super::surface::Ground;
use crate::hint::over;
use crate::run::turned;

/// Reads faces; changes nothing, so that many can be read at once.
#[derive(Clone, Copy)]
pub(crate) struct FaceReader<'f> {
    pub reader: Reader<'f>,
    /// The accuracy that the file states.
    pub uncertainty_mm: f64,
}

/// A face that has been read, and whose edges have no place in a part yet.
#[derive(Clone, Debug)]
pub(crate) struct FaceDraft {
    pub surface: Arc<Surface>,
    pub same_sense: bool,
    pub bounds: Vec<BoundDraft>,
}

impl FaceDraft {
    /// The face moved.
    fn placed(mut self, map: &DAffine3) -> Self {
        let (surface, turned) = self.surface.transformed(map);
        self.surface = Arc::new(surface);
        self.same_sense ^= turned;
        let mirrored = map.matrix3.determinant() < 0.0;
        for bound in &mut self.bounds {
            bound.pieces.iter_mut().for_each(|(piece, turned)| {
                *piece = piece.placed(map);
                *turned ^= mirrored;
            });
            if mirrored {
                bound.pieces.reverse();
            }
        }
        self
    }
}

/// Curves end to end, and for each whether it is run backwards.
#[derive(Clone, Debug)]
pub(crate) struct BoundDraft {
    pub entry: u32,
    pub outer: bool,
    pub pieces: Vec<(Piece, bool)>,
}

impl BoundDraft {
    /// A loop of curves, each run in the direction that joins it to the one before.
    fn new(pieces: Vec<Piece>, entry: u32, outer: bool) -> Outcome<Self> {
        let pieces: Vec<Piece> = pieces.into_iter().filter(|piece| !is_point(piece)).collect();
        if pieces.is_empty() {
            return Err(Fault::new(entry, "is a boundary of no length"));
        }
        let turned = directions(&pieces);
        Ok(Self { entry, outer, pieces: cut_at_corners(pieces.into_iter().zip(turned)) })
    }

    /// The loops of a boundary on a surface: one, but where its curves in the parameter plane form others.
    fn loops(pieces: Vec<Piece>, entry: u32, outer: bool, surface: &Surface) -> Outcome<Vec<Self>> {
        let Some(loops) = loops_in_plane(&pieces, surface) else {
            return Self::new(pieces, entry, outer).map(|bound| vec![bound]);
        };
        let bound = |order: &Vec<(usize, bool)>| {
            let pieces = order.iter().map(|&(piece, turned)| (pieces[piece].clone(), turned));
            let pieces = cut_at_corners(pieces.filter(|(piece, _)| !is_point(piece)));
            Self { entry, outer, pieces }
        };
        Ok(loops.iter().map(bound).filter(|bound| !bound.pieces.is_empty()).collect())
    }

    /// The loop as it is, or run the other way where the normal that it runs around is not `same`.
    fn about(mut self, same: bool) -> Self {
        if !same {
            self.pieces.reverse();
            self.pieces.iter_mut().for_each(|(_, turned)| *turned ^= true);
        }
        self
    }
}

impl FaceReader<'_> {
    /// Types 143, 144, or a surface without any trimming.
    pub fn read(&self, entry: u32) -> Outcome<FaceDraft> {
        let draft = self.read_in_place(entry)?;
        let directory = self.reader.parameters(entry)?.directory;
        // A surface of its own has its matrix in it already; one that is trimmed is moved with its boundaries.
        if directory.transformation == 0 || !matches!(directory.entity_type, 143 | 144) {
            return Ok(draft);
        }
        Ok(draft.placed(&self.reader.placement_mm(directory)?))
    }

    fn read_in_place(&self, entry: u32) -> Outcome<FaceDraft> {
        let mut parameters = self.reader.parameters(entry)?;
        match parameters.directory.entity_type {
            144 => {
                let surface = parameters.pointer()?;
                let told = parameters.integer()? != 0;
                let inner = parameters.count(0)?;
                let outer = parameters.pointer()?;
                let mut boundaries = Vec::new();
                if told && outer != 0 {
                    boundaries.push(outer);
                }
                for _ in 0..inner {
                    boundaries.push(parameters.pointer()?);
                }
                let named = boundaries.len();
                boundaries.retain(|&boundary| !self.is_without_curves(boundary));
                let mut has_outer = told && outer != 0;
                if has_outer && boundaries.len() < named {
                    has_outer = self.encloses(surface, &boundaries)?;
                }
                self.trimmed(surface, &boundaries, has_outer)
            }
            143 => {
                parameters.integer()?;
                let surface = parameters.pointer()?;
                let boundaries = (0..parameters.count(1)?).map(|_| parameters.pointer());
                let boundaries = boundaries.collect::<Outcome<Vec<u32>>>()?;
                self.trimmed(surface, &boundaries, true)
            }
            108 => {
                let bound = self.plane_bound(entry)?;
                let bound = bound.ok_or_else(|| parameters.fault("is a plane without bounds"))?;
                let ground = self.reader.surface(entry)?;
                let surface = Arc::new(ground.surface);
                Ok(FaceDraft { surface, same_sense: !ground.reversed, bounds: vec![bound] })
            }
            _ => {
                let ground = self.reader.surface(entry)?;
                let (surface, domain) =
                    ground.untrimmed().ok_or_else(|| parameters.fault("never ends, and has no bounds"))?;
                let surface = Arc::new(surface);
                let bound = natural_bound(&surface, domain, entry);
                let bounds = bound.map(|bound| bound.about(!ground.reversed)).into_iter().collect();
                Ok(FaceDraft { surface, same_sense: !ground.reversed, bounds })
            }
        }
    }

    /// The curve that bounds a plane of type 108, where the entity is one and has one.
    fn plane_bound(&self, entry: u32) -> Outcome<Option<BoundDraft>> {
        let mut parameters = self.reader.parameters(entry)?;
        if parameters.directory.entity_type != 108 {
            return Ok(None);
        }
        parameters.reals(4)?;
        match parameters.pointer()? {
            0 => Ok(None),
            curve => BoundDraft::new(self.reader.curve(curve)?, curve, true).map(Some),
        }
    }

    fn trimmed(&self, surface: u32, boundaries: &[u32], has_outer: bool) -> Outcome<FaceDraft> {
        let ground = self.reader.surface(surface)?;
        let mut bounds = Vec::with_capacity(boundaries.len() + 1);
        let exact = if has_outer {
            Arc::new(ground.surface.clone())
        } else if let Some(bound) = self.plane_bound(surface)? {
            bounds.push(bound);
            Arc::new(ground.surface.clone())
        } else {
            let whole = ground.untrimmed();
            let (whole, domain) =
                whole.ok_or_else(|| Fault::new(surface, "never ends, and has no outer boundary"))?;
            let whole = Arc::new(whole);
            bounds.extend(natural_bound(&whole, domain, surface).map(|bound| bound.about(!ground.reversed)));
            whole
        };
        let has_pole = !exact.singularities().is_empty();
        let mut on_model = true;
        for (k, &boundary) in boundaries.iter().enumerate() {
            let pieces = self.boundary(boundary, &ground, &exact)?;
            on_model &= pieces.iter().all(|piece| !matches!(piece.curve, Curve::OnSurface { .. }));
            bounds.extend(BoundDraft::loops(pieces, boundary, has_outer && k == 0, &exact)?);
        }
        if has_pole {
            self.direct(&mut bounds, boundaries, &ground);
        }
        if has_outer && on_model {
            let (surface, same_sense) = ground.simplified();
            if !matches!(surface, Surface::Nurbs(_)) {
                let pieces = bounds.iter_mut().flat_map(|bound| &mut bound.pieces);
                pieces.for_each(|(piece, _)| piece.image = None);
            }
            return Ok(FaceDraft { surface: Arc::new(surface), same_sense, bounds });
        }
        Ok(FaceDraft { surface: exact, same_sense: !ground.reversed, bounds })
    }

    /// Whether the first of a surface's boundaries is the outer one, though the file calls it an inner one, and names as
    /// the outer one a boundary without curves, as OpenCASCADE does: it runs counter-clockwise, or the surface has no
    /// sides that could be the outer boundary.
    fn encloses(&self, surface: u32, boundaries: &[u32]) -> Outcome<bool> {
        let Some(&first) = boundaries.first() else { return Ok(false) };
        let mut area = 0.0;
        for entry in self.plane_curves(first)? {
            for piece in self.reader.parameter_curve(entry)? {
                let points = (0..=16).map(|k| piece.curve.point(piece.range.at(f64::from(k) / 16.0)));
                let points: Vec<DVec3> = points.collect();
                area += points.windows(2).map(|pair| pair[0].cross(pair[1]).z).sum::<f64>();
            }
        }
        Ok(area > 0.0 || self.reader.surface(surface)?.untrimmed().is_none())
    }

    /// Whether a boundary of type 142 names no curve.
    fn is_without_curves(&self, boundary: u32) -> bool {
        let named = || -> Outcome<bool> {
            let mut parameters = self.reader.parameters(boundary)?;
            let is_named = parameters.directory.entity_type != 142 || {
                parameters.integer()?;
                parameters.pointer()?;
                parameters.pointer()? != 0 || parameters.pointer()? != 0
            };
            Ok(is_named)
        };
        named().is_ok_and(|is_named| !is_named)
    }

    /// The curves of a boundary (types 141 and 142), in the model or else on the surface.
    fn boundary(&self, entry: u32, ground: &Ground, surface: &Arc<Surface>) -> Outcome<Vec<Piece>> {
        let mut parameters = self.reader.parameters(entry)?;
        match parameters.directory.entity_type {
            142 => {
                parameters.integer()?;
                parameters.pointer()?;
                let (in_plane, in_model) = (parameters.pointer()?, parameters.pointer()?);
                let prefers_plane = parameters.integer()? == 1;
                self.either(&parameters, in_model, &[in_plane], prefers_plane, ground, surface)
            }
            141 => {
                parameters.integer()?;
                let prefers_plane = parameters.integer()? == 2;
                parameters.pointer()?;
                let mut out = Vec::new();
                for _ in 0..parameters.count(3)? {
                    let in_model = parameters.pointer()?;
                    // Whether the curve is turned: the chain is put in order by its ends all the same.
                    parameters.integer()?;
                    let in_plane = (0..parameters.count(1)?).map(|_| parameters.pointer());
                    let in_plane = in_plane.collect::<Outcome<Vec<u32>>>()?;
                    let pieces =
                        self.either(&parameters, in_model, &in_plane, prefers_plane, ground, surface)?;
                    out.extend(pieces);
                }
                Ok(out)
            }
            _ => self.reader.curve(entry),
        }
    }

    /// Runs the boundaries of a surface with poles as their curves in the parameter plane mean them: round a pole there
    /// are two ways, and only the direction tells which one is meant. The one around the largest area is the outer one,
    /// whatever the file calls it.
    fn direct(&self, bounds: &mut [BoundDraft], boundaries: &[u32], ground: &Ground) {
        let areas: Option<Vec<f64>> =
            boundaries.iter().map(|&entry| self.plane_area(entry, ground)).collect();
        let Some(areas) = areas.filter(|areas| areas.len() == bounds.len()) else { return };
        let outer = (0..areas.len()).max_by(|&a, &b| areas[a].abs().total_cmp(&areas[b].abs()));
        for (k, bound) in bounds.iter_mut().enumerate() {
            let runs_right = (areas[k] > 0.0) == (Some(k) == outer);
            let turned = std::mem::take(&mut bound.pieces);
            let turned =
                BoundDraft { pieces: turned, ..bound.clone() }.about(runs_right).about(!ground.reversed);
            *bound = turned;
        }
    }

    /// The area within a boundary in the parameter plane, negative where it runs clockwise; nothing where it has no
    /// curves there.
    fn plane_area(&self, boundary: u32, ground: &Ground) -> Option<f64> {
        let entries = self.plane_curves(boundary).ok()?;
        let mut pieces = Vec::new();
        for entry in entries {
            pieces.extend(self.reader.parameter_curve(entry).ok()?);
        }
        let points: Vec<DVec3> = chained(pieces)
            .iter()
            .flat_map(|piece| (0..16).map(|k| piece.curve.point(piece.range.at(f64::from(k) / 16.0))))
            .map(|point| ground.parameters.transform_point3(point))
            .collect();
        let origin = *points.first()?;
        let pairs = points.iter().zip(points.iter().cycle().skip(1));
        let area: f64 = pairs.map(|(a, b)| (*a - origin).cross(*b - origin).z).sum();
        (area != 0.0).then_some(area)
    }

    /// The curves of a boundary (types 141 and 142) in the parameter plane.
    fn plane_curves(&self, entry: u32) -> Outcome<Vec<u32>> {
        let mut parameters = self.reader.parameters(entry)?;
        let mut out = Vec::new();
        match parameters.directory.entity_type {
            142 => {
                parameters.integer()?;
                parameters.pointer()?;
                out.push(parameters.pointer()?);
            }
            141 => {
                parameters.integer()?;
                parameters.integer()?;
                parameters.pointer()?;
                for _ in 0..parameters.count(3)? {
                    parameters.pointer()?;
                    parameters.integer()?;
                    for _ in 0..parameters.count(1)? {
                        out.push(parameters.pointer()?);
                    }
                }
            }
            _ => {}
        }
        out.retain(|&entry| entry != 0);
        Ok(out)
    }

    /// The model curve where it is there and lies on the surface, else the one in the parameter plane.
    fn either(
        &self,
        parameters: &Parameters<'_>,
        in_model: u32,
        in_plane: &[u32],
        prefers_plane: bool,
        ground: &Ground,
        surface: &Arc<Surface>,
    ) -> Outcome<Vec<Piece>> {
        let mut model = match in_model {
            0 => Err(parameters.fault("has no curve in the model")),
            entry => self.reader.curve(entry),
        };
        let images = self.images(in_plane, ground);
        // Where there is no choice there is nothing to be weighed.
        if images.as_ref().is_ok_and(Vec::is_empty) {
            return model;
        }
        if let (Ok(pieces), Ok(images)) = (&mut model, &images)
            && pieces.len() == images.len()
        {
            for (piece, image) in pieces.iter_mut().zip(images) {
                piece.image = image_of(piece, image, surface);
            }
        }
        let reach = self.uncertainty_mm.max(1e-3) * if prefers_plane { 10.0 } else { 100.0 };
        if let Ok(pieces) = &model
            && !prefers_plane
            && pieces
                .iter()
                .all(|piece| lies_on(&piece.curve, piece.range, piece.image.as_deref(), surface, reach))
        {
            return model;
        }
        let images = match images {
            Ok(images) => images,
            Err(fault) => return model.map_err(|_| fault),
        };
        let on_surface = |Piece { curve, range, .. }: Piece| {
            let pcurve = Arc::new(curve);
            let image = Some(pcurve.clone());
            Piece { image, ..Piece::new(Curve::OnSurface { surface: surface.clone(), pcurve }, range) }
        };
        let mut out: Vec<Piece> = images.into_iter().map(on_surface).collect();
        let Ok(pieces) = model else { return Ok(out) };
        // Where both say the same, the curve in the model is the one that neighbours have too.
        if prefers_plane && are_alike(&pieces, &out, reach) {
            return Ok(pieces);
        }
        if pieces.len() == out.len() {
            for (piece, told) in out.iter_mut().zip(pieces) {
                piece.told = Some(Arc::new((told.curve, told.range)));
            }
        }
        Ok(out)
    }

    /// Curves in the parameter plane, in the parameters that the surface has here.
    fn images(&self, in_plane: &[u32], ground: &Ground) -> Outcome<Vec<Piece>> {
        let mut out = Vec::new();
        for &entry in in_plane.iter().filter(|&&entry| entry != 0) {
            let pieces = self.reader.parameter_curve(entry)?;
            let map = &ground.parameters;
            out.extend(pieces.iter().map(|piece| Piece::new(piece.curve.transformed(map), piece.range)));
        }
        Ok(out)
    }
}

/// A curve in the parameter plane over the range of the curve in the model that it stands for, if it runs with it.
fn image_of(piece: &Piece, image: &Piece, surface: &Surface) -> Option<Arc<Curve>> {
    let there = |share: f64| surface.point(image.curve.point(image.range.at(share)).truncate());
    let here = |share: f64| piece.curve.point(piece.range.at(share));
    let runs_against = |from: f64, to: f64| {
        let ([start, end], [first, last]) = ([from, to].map(here), [from, to].map(there));
        start.distance(first) > start.distance(last) && end.distance(last) > end.distance(first)
    };
    // What closes on itself begins where it ends.
    let turned = runs_against(0.0, 1.0) || is_closed(piece) && runs_against(0.25, 0.75);
    over(&image.curve, image.range, piece.range, turned).map(Arc::new)
}

/// The sides of a surface's domain as a loop, so that they can be sewn; none where it closes both ways.
fn natural_bound(surface: &Arc<Surface>, domain: [Interval; 2], entry: u32) -> Option<BoundDraft> {
    let closed = |k: usize| surface.periods()[k].is_some_and(|p| domain[k].length() >= p * (1.0 - 1e-9));
    let is_ball = matches!(**surface, Surface::Sphere { .. });
    if closed(0) && closed(1) || is_ball {
        return None;
    }
    let [u, v] = domain;
    let at = |u: f64, v: f64| DVec3::new(u, v, 0.0);
    let side = |constant: Direction, at_value: f64, turned: bool| {
        let (origin, direction, range) = match constant {
            Direction::U => (at(at_value, 0.0), DVec3::Y, v),
            Direction::V => (at(0.0, at_value), DVec3::X, u),
        };
        let pcurve = Arc::new(Curve::Line { origin, direction });
        let image = Some(pcurve.clone());
        if let Surface::Nurbs(nurbs) = &**surface {
            let curve = nurbs.isocurve(constant, at_value).ok()?;
            let range = curve.domain();
            return Some((Piece { image, ..Piece::new(Curve::Nurbs(curve), range) }, turned));
        }
        let curve = Curve::OnSurface { surface: surface.clone(), pcurve };
        Some((Piece { image, ..Piece::new(curve, range) }, turned))
    };
    let sides = [
        side(Direction::V, v.start, false)?,
        side(Direction::U, u.end, false)?,
        side(Direction::V, v.end, true)?,
        side(Direction::U, u.start, true)?,
    ];
    let pieces = cut_at_corners(sides.into_iter().filter(|(piece, _)| !is_point(piece)));
    (!pieces.is_empty()).then_some(BoundDraft { entry, outer: true, pieces })
}

/// Whether a curve lies within `reach` of a surface, by a few of its points. `image` is the curve in the surface's
/// parameters, where that is known.
pub(super) fn lies_on(
    curve: &Curve,
    range: Interval,
    image: Option<&Curve>,
    surface: &Surface,
    reach: f64,
) -> bool {
    let mut hint = None;
    [0.0, 0.31, 0.72, 1.0].into_iter().all(|share| {
        let t = range.at(share);
        let point = curve.point(t);
        let image = image.map(|image| image.point(t).truncate());
        if image.is_some_and(|uv| surface.point(uv).distance(point) <= reach) {
            return true;
        }
        let foot = surface.project(point, image.or(hint));
        hint = Some(foot.uv);
        foot.distance <= reach
    })
}

/// Whether two chains run over the same points.
fn are_alike(a: &[Piece], b: &[Piece], reach: f64) -> bool {
    let at = |piece: &Piece, share: f64| piece.curve.point(piece.range.at(share));
    let near = |a: &Piece, b: &Piece| {
        let apart = |turned: bool| {
            let shares = [0.0, 0.5, 1.0].into_iter();
            shares
                .map(move |s| at(a, s).distance(at(b, if turned { 1.0 - s } else { s })))
                .fold(0.0, f64::max)
        };
        let middle = || b.curve.project(at(a, 0.5), None).distance;
        let ends = |turned: bool| {
            at(a, 0.0)
                .distance(at(b, f64::from(u8::from(turned))))
                .max(at(a, 1.0).distance(at(b, f64::from(u8::from(!turned)))))
        };
        apart(false).min(apart(true)) <= reach || (ends(false).min(ends(true)) <= reach && middle() <= reach)
    };
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| near(a, b))
}

/// Whether a piece ends where it begins.
fn is_closed(piece: &Piece) -> bool {
    let [start, end] = piece.ends();
    start.distance(end) <= 1e-6 * piece.curve.point(piece.range.at(0.5)).distance(start)
}

/// Whether a piece is all at one point.
fn is_point(piece: &Piece) -> bool {
    let at = |share: f64| piece.curve.point(piece.range.at(share));
    let start = at(0.0);
    [0.37, 0.71, 1.0].into_iter().all(|share| at(share).distance(start) <= 1e-9 * (1.0 + start.length()))
}

/// Pieces end to end, each run in its own direction: those that run against it are turned over.
pub(crate) fn chained(pieces: Vec<Piece>) -> Vec<Piece> {
    let pieces: Vec<Piece> = pieces.into_iter().filter(|piece| !is_point(piece)).collect();
    let turned = directions(&pieces);
    pieces
        .into_iter()
        .zip(turned)
        .map(|(piece, turned)| if turned { piece.reversed() } else { piece })
        .collect()
}

/// Per piece whether the loop runs it backwards.
fn directions(pieces: &[Piece]) -> Vec<bool> {
    let runs: Vec<[DVec3; 3]> =
        pieces.iter().map(|piece| [0.0, 0.5, 1.0].map(|at| piece.curve.point(piece.range.at(at)))).collect();
    turned(&runs)
}

/// Turns sharper than this are corners, where faces beside this one may begin and end.
const CORNER_RAD: f64 = 0.35;

/// The pieces of a loop, cut where their curves have corners.
fn cut_at_corners(pieces: impl Iterator<Item = (Piece, bool)>) -> Vec<(Piece, bool)> {
    let mut out = Vec::new();
    for (piece, turned) in pieces {
        let corners = corners(&piece.curve, piece.range);
        if corners.is_empty() {
            out.push((piece, turned));
            continue;
        }
        let ends: Vec<f64> =
            [piece.range.start].into_iter().chain(corners).chain([piece.range.end]).collect();
        let part = |pair: &[f64]| (Piece { range: Interval::new(pair[0], pair[1]), ..piece.clone() }, turned);
        let from = out.len();
        out.extend(ends.windows(2).map(part));
        if turned {
            out[from..].reverse();
        }
    }
    out
}

/// Where in a range a curve turns sharply.
fn corners(curve: &Curve, range: Interval) -> Vec<f64> {
    let may_turn = match curve {
        Curve::Nurbs(nurbs) => has_sharp_knots(nurbs, range),
        Curve::OnSurface { pcurve, .. } => match &**pcurve {
            Curve::Nurbs(nurbs) => has_sharp_knots(nurbs, range),
            other => matches!(other, Curve::Polyline(_) | Curve::Composite(_)),
        },
        Curve::Polyline(_) | Curve::Composite(_) => true,
        _ => false,
    };
    if !may_turn {
        return Vec::new();
    }
    let breaks = curve.breakpoints(range);
    let is_corner = |at: &[f64]| {
        let step = 1e-3 * (at[1] - at[0]).min(at[2] - at[1]);
        let [before, here, after] = [at[1] - step, at[1], at[1] + step].map(|t| curve.point(t));
        (here - before).angle_between(after - here) > CORNER_RAD
    };
    breaks.windows(3).filter(|at| is_corner(at)).map(|at| at[1]).collect()
}

/// Whether a spline has knots inside a range at which it need not be smooth.
fn has_sharp_knots(nurbs: &NurbsCurve, range: Interval) -> bool {
    let inside = nurbs.knots().windows(nurbs.degree()).filter(|at| range.start < at[0] && at[0] < range.end);
    inside.into_iter().any(|at| at[0] == at[at.len() - 1])
}
