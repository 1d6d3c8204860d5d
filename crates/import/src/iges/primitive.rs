//! Primitive solids (IGES 5.3 sections 4.35 to 4.46): blocks, wedges, cylinders, cones, spheres, tori, ellipsoids, and
//! profiles that are revolved or extruded, as bodies with exact faces.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use trimloop_brep::{
    Body, BodyKind, Coedge, EntityRef, FaceGeometry, FaceId, Loop, Rgba, Shell, ShellFace, VertexId,
};
use trimloop_geom::{Curve, Frame, Interval, Surface};

use super::curve::Piece;
use super::face::chained;
use super::look::{levels_of, name_of};
use super::reader::{Fault, Outcome, Parameters, Reader};
use super::shape::ShapeBuilder;
use super::surface::{beside, elementary};

/// Types of entities that are primitive solids.
pub(crate) const PRIMITIVES: [i32; 9] = [150, 152, 154, 156, 158, 160, 162, 164, 168];

/// Collects the faces of one primitive.
struct Maker<'b, 'f> {
    builder: &'b mut ShapeBuilder<'f>,
    entity: EntityRef,
    entry: u32,
    color: Option<Rgba>,
    faces: Vec<FaceId>,
}

/// A use of an edge.
type Use = (u32, bool);

impl ShapeBuilder<'_> {
    /// Adds a primitive solid.
    pub fn add_primitive(&mut self, entry: u32, color: Option<Rgba>) {
        let first = self.part.faces.len() as FaceId;
        let entity = EntityRef::Iges(entry);
        let mut maker = Maker { builder: self, entity, entry, color, faces: Vec::new() };
        let made = maker.make();
        let faces = std::mem::take(&mut maker.faces);
        if let Err(fault) = made {
            self.face(entry, color, |_| Err(fault));
            return;
        }
        self.hide_blanked(entry, first);
        let faces = faces.into_iter().map(|face| ShellFace { face, reversed: false }).collect();
        // The shell is no entity of the file: which way its faces look is for the mesher to find.
        let shell = Shell { entity: EntityRef::None, closed: true, void: false, faces };
        let name = name_of(&self.reader, entry).unwrap_or_default();
        let layers = levels_of(&self.reader, entry);
        self.add_body(Body { name, entity, kind: BodyKind::Solid, shells: vec![shell], layers });
    }
}

impl ShapeBuilder<'_> {
    /// Counts a Boolean tree (type 180) as lost: solids are not combined here.
    pub fn add_boolean(&mut self, entry: u32, color: Option<Rgba>) {
        let fault =
            Fault::new(entry, "is a Boolean tree; solids are not combined, and its operands are left out");
        self.face(entry, color, |_| Err(fault));
    }
}

impl Maker<'_, '_> {
    fn make(&mut self) -> Outcome<()> {
        let reader = self.builder.reader;
        let mut parameters = reader.parameters(self.entry)?;
        let map = reader.placement(parameters.directory)?;
        let parameters = &mut parameters;
        match parameters.directory.entity_type {
            150 => {
                let size = positive(parameters)?;
                let place = map * placed(parameters)?;
                self.prism(&[[0.0, 0.0], [size.x, 0.0], [size.x, size.y], [0.0, size.y]], size.z, place);
            }
            152 => {
                let size = positive(parameters)?;
                let top = parameters.real()?;
                if !(0.0..=size.x).contains(&top) {
                    return Err(parameters.fault("has a small side that is no part of its large one"));
                }
                let place = map * placed(parameters)?;
                let mut outline = vec![[0.0, 0.0], [size.x, 0.0], [top, size.y], [0.0, size.y]];
                if top <= 1e-9 * size.x {
                    outline.remove(2);
                }
                self.prism(&outline, size.z, place);
            }
            154 => {
                let [height, radius] = [parameters.real()?, parameters.real()?];
                let place = map * axial(parameters)?;
                let profile = [[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]];
                self.turn(parameters, &profile, place)?;
            }
            156 => {
                let [height, base, top] = [parameters.real()?, parameters.real()?, parameters.real()?];
                let place = map * axial(parameters)?;
                let mut profile = vec![[0.0, 0.0], [base, 0.0], [top, height], [0.0, height]];
                if top == 0.0 {
                    profile.pop();
                }
                self.turn(parameters, &profile, place)?;
            }
            158 => {
                let radius = parameters.real()?;
                let frame = Frame { origin: location(parameters), ..Frame::WORLD };
                self.closed(parameters, Surface::Sphere { frame, radius }, radius > 0.0, map)?;
            }
            160 => {
                let [major, minor] = [parameters.real()?, parameters.real()?];
                let origin = location(parameters);
                let axis = direction(parameters, DVec3::Z)?;
                let frame = Frame::new(origin, axis, beside(axis));
                let torus = Surface::Torus { frame, major, minor, v_range: None };
                self.closed(parameters, torus, minor > 0.0 && major > minor, map)?;
            }
            168 => {
                let size = positive(parameters)?;
                let place = placed(parameters)? * DAffine3::from_scale(size);
                let ball = Surface::Sphere { frame: Frame::WORLD, radius: 1.0 };
                let ball = ball.to_nurbs(ball.domain()).map(Surface::Nurbs);
                let ball = ball.ok_or_else(|| parameters.fault("is no ellipsoid"))?;
                self.closed(parameters, ball, true, map * place)?;
            }
            162 => self.revolved(parameters, map)?,
            164 => self.extruded(parameters, map)?,
            _ => return Err(parameters.fault("is no primitive solid")),
        }
        Ok(())
    }

    /// A surface that closes on itself.
    fn closed(
        &mut self,
        parameters: &Parameters<'_>,
        surface: Surface,
        sound: bool,
        map: DAffine3,
    ) -> Outcome<()> {
        if !sound {
            return Err(parameters.fault("has a radius that cannot be"));
        }
        self.face(surface.transformed(&map).0, Vec::new());
        Ok(())
    }

    fn face(&mut self, surface: Surface, loops: Vec<Vec<Use>>) {
        let entity = self.entity;
        let loops = loops.into_iter().enumerate().map(|(k, uses)| Loop {
            entity,
            coedges: uses
                .into_iter()
                .map(|(edge, reversed)| Coedge { edge, reversed, pcurve: None })
                .collect(),
            vertex: None,
            outer: k == 0,
        });
        let loops = loops.collect();
        let surface = FaceGeometry::Surface(Arc::new(surface));
        let face = self.builder.face(self.entry, self.color, |_| Ok((surface, true, loops)));
        self.faces.push(face);
    }

    fn vertex(&mut self, point: DVec3) -> VertexId {
        self.builder.vertex(point, self.entity)
    }

    fn edge(&mut self, piece: Piece, start: VertexId, end: VertexId) -> u32 {
        self.builder.edge(self.entity, piece, start, end)
    }

    fn point(&self, vertex: VertexId) -> DVec3 {
        self.builder.part.vertices[vertex as usize].point
    }

    fn line(&mut self, start: VertexId, end: VertexId) -> u32 {
        let piece = segment(self.point(start), self.point(end));
        self.edge(piece, start, end)
    }

    /// A straight prism over an outline in the plane z = 0, placed.
    fn prism(&mut self, outline: &[[f64; 2]], height: f64, place: DAffine3) {
        let corners: Vec<DVec3> = outline.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        let n = corners.len();
        let pieces = (0..n).map(|k| {
            segment(place.transform_point3(corners[k]), place.transform_point3(corners[(k + 1) % n]))
        });
        self.sweep(pieces.collect(), place.transform_vector3(DVec3::Z * height));
    }

    /// Type 164.
    fn extruded(&mut self, parameters: &mut Parameters<'_>, map: DAffine3) -> Outcome<()> {
        let profile = parameters.pointer()?;
        let length = parameters.real()?;
        let along = direction(parameters, DVec3::Z)?;
        let pieces = self.profile(parameters, profile, map)?;
        let along = map.transform_vector3(along * length);
        if !(along.length() > 0.0) {
            return Err(parameters.fault("is extruded by nothing"));
        }
        if !ends_meet(&pieces) {
            return Err(parameters.fault("is extruded from a curve that is not closed"));
        }
        self.sweep(pieces, along);
        Ok(())
    }

    /// The pieces of a profile, end to end, each run in its own direction; placed.
    fn profile(&self, parameters: &Parameters<'_>, entry: u32, map: DAffine3) -> Outcome<Vec<Piece>> {
        // The profile is read in the solid's own units and then goes where the solid goes.
        let own = Reader { unit_mm: 1.0, ..self.builder.reader };
        let pieces: Vec<Piece> = chained(own.curve(entry)?).into_iter().flat_map(straightened).collect();
        if pieces.is_empty() {
            return Err(parameters.fault("has a profile of no length"));
        }
        let whole = pieces.len() == 1;
        // A closed curve on its own is taken in halves, so that no edge closes on itself.
        let parts = pieces.into_iter().flat_map(|piece| if whole { halves(piece) } else { vec![piece] });
        Ok(parts.map(|piece| piece.placed(&map)).collect())
    }

    /// The solid between a closed planar profile and the same moved by `along`.
    fn sweep(&mut self, pieces: Vec<Piece>, along: DVec3) {
        let n = pieces.len();
        let starts: Vec<DVec3> = pieces.iter().map(|piece| piece.ends()[0]).collect();
        let low: Vec<VertexId> = starts.iter().map(|&p| self.vertex(p)).collect();
        let high: Vec<VertexId> = starts.iter().map(|&p| self.vertex(p + along)).collect();
        let up: Vec<u32> = (0..n).map(|k| self.line(low[k], high[k])).collect();
        let lift = DAffine3::from_translation(along);
        let mut rims = [Vec::with_capacity(n), Vec::with_capacity(n)];
        let plane = plane_through(&pieces, along);
        for (k, piece) in pieces.into_iter().enumerate() {
            let next = (k + 1) % n;
            let surface = wall(&piece, along);
            let floor = self.edge(piece.clone(), low[k], low[next]);
            let lid = self.edge(piece.placed(&lift), high[k], high[next]);
            self.face(surface, vec![vec![(floor, false), (up[next], false), (lid, true), (up[k], true)]]);
            rims[0].push((floor, false));
            rims[1].push((lid, false));
        }
        let [floor, lid] = rims;
        let upper = Frame { origin: plane.origin + along, ..plane };
        self.face(Surface::Plane { frame: plane }, vec![floor]);
        self.face(Surface::Plane { frame: upper }, vec![lid]);
    }

    /// A polygon in the plane y = 0 that begins and ends on the z axis, turned about it; placed.
    fn turn(&mut self, parameters: &Parameters<'_>, profile: &[[f64; 2]], place: DAffine3) -> Outcome<()> {
        let sound = profile.iter().all(|p| p[0] >= 0.0 && p[1] >= 0.0)
            && profile.iter().any(|p| p[0] > 0.0)
            && profile.last().is_some_and(|p| p[1] > 0.0);
        if !sound {
            return Err(parameters.fault("has a radius or a height that cannot be"));
        }
        let points: Vec<DVec3> =
            profile.iter().map(|p| place.transform_point3(DVec3::new(p[0], 0.0, p[1]))).collect();
        let pieces = points.windows(2).map(|pair| segment(pair[0], pair[1]));
        let axis = place.transform_vector3(DVec3::Z).normalize();
        let turn = Turn { origin: place.translation, axis, angle: TAU };
        self.revolve(pieces.filter(|piece| !turn.holds(piece)).collect(), turn, false);
        Ok(())
    }

    /// Type 162.
    fn revolved(&mut self, parameters: &mut Parameters<'_>, map: DAffine3) -> Outcome<()> {
        let profile = parameters.pointer()?;
        let share = parameters.optional_real().unwrap_or(1.0);
        let origin = location(parameters);
        let axis = direction(parameters, DVec3::Z)?;
        if !(share > 0.0 && share <= 1.0) {
            return Err(parameters.fault("is turned by no part of a full turn"));
        }
        let mut pieces = self.profile(parameters, profile, map)?;
        let hand = map.matrix3.determinant().signum();
        let turn = Turn {
            origin: map.transform_point3(origin),
            axis: (map.transform_vector3(axis) * hand).normalize(),
            angle: TAU * share,
        };
        let mut closed = ends_meet(&pieces);
        if !closed && parameters.directory.form == 1 {
            // The curve is closed by the line between its ends.
            let chord = segment(pieces[pieces.len() - 1].ends()[1], pieces[0].ends()[0]);
            pieces.push(chord);
            closed = true;
        }
        if !closed {
            // The area is bounded by the axis and by perpendiculars from the curve's ends.
            let first = pieces[0].ends()[0];
            let last = pieces[pieces.len() - 1].ends()[1];
            pieces.insert(0, segment(turn.foot(first), first));
            pieces.push(segment(last, turn.foot(last)));
        }
        pieces.retain(|piece| !turn.holds(piece) && piece.ends()[0].distance(piece.ends()[1]) > 1e-9);
        if pieces.is_empty() {
            return Err(parameters.fault("is turned from a curve that lies on the axis"));
        }
        self.revolve(pieces, turn, closed);
        Ok(())
    }

    /// The solid that pieces end to end make when they are turned; those that do not close begin and end on the axis.
    fn revolve(&mut self, pieces: Vec<Piece>, turn: Turn, closed: bool) {
        let n = pieces.len();
        let full = turn.angle >= TAU * (1.0 - 1e-12);
        let mut points: Vec<DVec3> = pieces.iter().map(|piece| piece.ends()[0]).collect();
        if !closed {
            points.push(pieces[n - 1].ends()[1]);
        }
        let away = DAffine3::from_axis_angle(turn.axis, turn.angle);
        let away = DAffine3::from_translation(turn.origin) * away * DAffine3::from_translation(-turn.origin);
        let near: Vec<VertexId> = points.iter().map(|&p| self.vertex(p)).collect();
        let far: Vec<VertexId> = (0..points.len())
            .map(|k| {
                if full || turn.on_axis(points[k]) {
                    near[k]
                } else {
                    self.vertex(away.transform_point3(points[k]))
                }
            })
            .collect();
        let rims: Vec<Option<u32>> = (0..points.len())
            .map(|k| turn.circle(points[k]).map(|piece| self.edge(piece, near[k], far[k])))
            .collect();
        let mut sides = [Vec::with_capacity(n), Vec::with_capacity(n)];
        let surfaces: Vec<Surface> = pieces.iter().map(|piece| turn.surface(piece)).collect();
        let cap = (!full).then(|| plane_through(&pieces, turn.axis.cross(points[n / 2] - turn.origin)));
        for (k, piece) in pieces.into_iter().enumerate() {
            let next = (k + 1) % points.len();
            let from = self.edge(piece.clone(), near[k], near[next]);
            let to = if full { from } else { self.edge(piece.placed(&away), far[k], far[next]) };
            sides[0].push((from, false));
            sides[1].push((to, false));
            let rim = |k: usize, reversed: bool| rims[k].map(|edge| (edge, reversed));
            let is_disc = full && matches!(surfaces[k], Surface::Plane { .. });
            let loops = if is_disc {
                [rim(k, false), rim(next, true)].into_iter().flatten().map(|rim| vec![rim]).collect()
            } else {
                let around = [rim(k, false), Some((to, false)), rim(next, true), Some((from, true))];
                vec![around.into_iter().flatten().collect()]
            };
            self.face(surfaces[k].clone(), loops);
        }
        let Some(frame) = cap else { return };
        if !closed {
            let along = self.line(near[n], near[0]);
            sides.iter_mut().for_each(|side| side.push((along, false)));
        }
        let turned = Surface::Plane { frame }.transformed(&away).0;
        let [first, second] = sides;
        self.face(Surface::Plane { frame }, vec![first]);
        self.face(turned, vec![second]);
    }
}

/// A turn about an axis.
#[derive(Clone, Copy)]
struct Turn {
    origin: DVec3,
    axis: DVec3,
    angle: f64,
}

impl Turn {
    fn foot(&self, p: DVec3) -> DVec3 {
        self.origin + self.axis * (p - self.origin).dot(self.axis)
    }

    fn on_axis(&self, p: DVec3) -> bool {
        p.distance(self.foot(p)) <= 1e-9 * (1.0 + (p - self.origin).length())
    }

    /// Whether a piece lies on the axis.
    fn holds(&self, piece: &Piece) -> bool {
        [0.0, 0.37, 1.0].into_iter().all(|share| self.on_axis(piece.curve.point(piece.range.at(share))))
    }

    /// The way of a point; none where it lies on the axis.
    fn circle(&self, p: DVec3) -> Option<Piece> {
        let center = self.foot(p);
        let frame = Frame::new(center, self.axis, p - center);
        let curve = Curve::Circle { frame, radius: p.distance(center) };
        (!self.on_axis(p)).then(|| Piece::new(curve, Interval::new(0.0, self.angle)))
    }

    fn surface(&self, piece: &Piece) -> Surface {
        let of = |piece: &Piece| Surface::Revolution {
            profile: piece.curve.clone().into(),
            origin: self.origin,
            axis: self.axis,
        };
        // What a line makes shows where it does not start on the axis.
        let runs_away = self.on_axis(piece.ends()[0]);
        let surface = of(&if runs_away { backwards(piece) } else { piece.clone() });
        elementary(&surface).unwrap_or_else(|| of(piece))
    }
}

fn segment(start: DVec3, end: DVec3) -> Piece {
    let curve = Curve::Line { origin: start, direction: end - start };
    Piece::new(curve, Interval::new(0.0, 1.0))
}

/// A straight piece from its end to its start; others as they are.
fn backwards(piece: &Piece) -> Piece {
    let [start, end] = piece.ends();
    if matches!(piece.curve, Curve::Line { .. }) { segment(end, start) } else { piece.clone() }
}

/// The lines of a polyline, one by one; other pieces as they are.
fn straightened(piece: Piece) -> Vec<Piece> {
    match &piece.curve {
        Curve::Polyline(polyline) if piece.range == polyline.domain() => {
            polyline.points.windows(2).map(|pair| segment(pair[0], pair[1])).collect()
        }
        _ => vec![piece],
    }
}

fn halves(piece: Piece) -> Vec<Piece> {
    let [start, end] = piece.ends();
    if start.distance(end) > 1e-9 * (1.0 + start.length()) {
        return vec![piece];
    }
    let middle = piece.range.at(0.5);
    let Piece { curve, range, .. } = piece;
    vec![
        Piece::new(curve.clone(), Interval::new(range.start, middle)),
        Piece::new(curve, Interval::new(middle, range.end)),
    ]
}

/// Whether the last piece ends where the first one starts.
fn ends_meet(pieces: &[Piece]) -> bool {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return false };
    let (start, end) = (first.ends()[0], last.ends()[1]);
    start.distance(end) <= 1e-6 * (1.0 + start.length())
}

/// The plane of a flat profile: its normal from the area it spans, or across `or` where it spans none.
fn plane_through(pieces: &[Piece], or: DVec3) -> Frame {
    let origin = pieces[0].ends()[0];
    let samples = pieces.iter().flat_map(|piece| {
        [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| piece.curve.point(piece.range.at(share)) - origin)
    });
    let samples: Vec<DVec3> = samples.collect();
    let area: DVec3 = samples.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
    let normal = area.try_normalize().unwrap_or(or);
    Frame::new(origin, normal, beside(normal))
}

/// The wall over a piece: a plane or a cylinder where it is one.
fn wall(piece: &Piece, along: DVec3) -> Surface {
    let [start, end] = piece.ends();
    match &piece.curve {
        Curve::Line { .. } => {
            let frame = Frame::new(start, (end - start).cross(along), end - start);
            Surface::Plane { frame }
        }
        Curve::Circle { frame, radius } if frame.z.cross(along).length() <= 1e-12 * along.length() => {
            Surface::Cylinder { frame: *frame, radius: *radius }
        }
        curve => Surface::Extrusion { profile: curve.clone().into(), direction: along },
    }
}

/// Three lengths that must be more than nothing.
fn positive(parameters: &mut Parameters<'_>) -> Outcome<DVec3> {
    let size = parameters.point()?;
    if size.min_element() > 0.0 { Ok(size) } else { Err(parameters.fault("has a length that cannot be")) }
}

/// A point; what is left out of it is 0.
fn location(parameters: &mut Parameters<'_>) -> DVec3 {
    let mut coordinate = || parameters.optional_real().unwrap_or(0.0);
    DVec3::new(coordinate(), coordinate(), coordinate())
}

/// A direction; `or` where none of its components is given.
fn direction(parameters: &mut Parameters<'_>, or: DVec3) -> Outcome<DVec3> {
    let mut component = || parameters.optional_real();
    let given = [component(), component(), component()];
    if given.iter().all(Option::is_none) {
        return Ok(or);
    }
    let direction = DVec3::from(given.map(Option::unwrap_or_default));
    direction.try_normalize().ok_or_else(|| parameters.fault("has a direction of no length"))
}

/// The place of a corner or a centre, with the directions of the local x and z axes.
fn placed(parameters: &mut Parameters<'_>) -> Outcome<DAffine3> {
    let origin = location(parameters);
    let x = direction(parameters, DVec3::X)?;
    let z = direction(parameters, DVec3::Z)?;
    let frame = Frame::new(origin, z, x);
    Ok(DAffine3 { matrix3: DMat3::from_cols(frame.x, frame.y, frame.z), translation: origin })
}

/// The place of a base's centre, with the direction of the axis.
fn axial(parameters: &mut Parameters<'_>) -> Outcome<DAffine3> {
    let origin = location(parameters);
    let z = direction(parameters, DVec3::Z)?;
    Ok(Frame::new(origin, z, beside(z)).to_affine())
}
