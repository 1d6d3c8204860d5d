//! Surfaces that stand on their own: trimmed, bounded, composite ones and whole ones become faces.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use trimloop_brep::{BodyKind, Coedge, Diagnostic, Loop, Severity, Shell, ShellFace, VertexId};
use trimloop_geom::{Curve, Interval, Surface};

use super::context::Context;
use super::curve::{surface_parameter_scale, turn_end_to_end};
use super::fault::Outcome;
use super::keyword::Kind;
use super::look::Look;
use super::part_builder::PartBuilder;
use super::seeds::{EdgeCurve, EdgeSeed, FaceSeed, FaceSurface};

/// How near to a whole period a range must be to count as closed, as a share of it.
const CLOSED: f64 = 1e-9;

/// A rectangle of a surface's parameters, and whether the face looks the surface's way.
struct Patch {
    surface: Arc<Surface>,
    range: [Interval; 2],
    same_sense: bool,
}

impl<'t> PartBuilder<'t> {
    /// One sheet body of surfaces.
    pub fn lone_surfaces(&mut self, body: usize, surfaces: &[usize], look: Look, context: Context) {
        let name = self.table.attributes(body).text().into_owned();
        let mut faces = Vec::new();
        for &surface in surfaces {
            let look = self.looks.of(surface).over(look);
            self.surface_faces(surface, look, context, &mut faces);
        }
        let shell = Shell { entity: self.table.entity(body), closed: false, void: false, faces };
        self.add_body(body, name, BodyKind::Sheet, vec![shell]);
    }

    fn surface_faces(&mut self, index: usize, look: Look, context: Context, faces: &mut Vec<ShellFace>) {
        if self.table.kind(index) == Kind::RectangularCompositeSurface {
            for patch in self.composite_patches(index) {
                let mut attributes = self.table.attributes(patch);
                let Some(parent) = attributes.optional_reference() else { continue };
                attributes.skip(2);
                let (u_sense, v_sense) = (attributes.flag(), attributes.flag());
                let face = self.surface_face(parent, look, context, u_sense == v_sense);
                faces.extend(face);
            }
        } else {
            faces.extend(self.surface_face(index, look, context, true));
        }
    }

    fn composite_patches(&self, index: usize) -> Vec<usize> {
        let Ok(rows) = self.table.attributes(index).after(1).list("segments") else { return Vec::new() };
        let mut patches = Vec::new();
        for row in rows {
            if let trimloop_part21::Param::List(row) = row {
                patches.extend(row.filter_map(|param| match param {
                    trimloop_part21::Param::Reference(id) => self.table.find(id),
                    _ => None,
                }));
            }
        }
        patches.retain(|&patch| self.table.kind(patch) == Kind::SurfacePatch);
        patches
    }

    /// The face of one surface; `None` for one without bounds, which is reported.
    fn surface_face(
        &mut self,
        index: usize,
        look: Look,
        context: Context,
        same_sense: bool,
    ) -> Option<ShellFace> {
        let seed = FaceSeed {
            index,
            name: self.table.attributes(index).text().into_owned(),
            surface: Ok(FaceSurface::Flat),
            same_sense,
            loops: Vec::new(),
            color: look.surface,
            hidden: look.hidden,
        };
        let made = match self.table.kind(index) {
            Kind::CurveBoundedSurface => self.curve_bounded(index, seed.clone(), context),
            Kind::RectangularTrimmedSurface => self.rectangle(index, context).map(|patch| {
                let same_sense = seed.same_sense == patch.same_sense;
                let patch = Patch { same_sense, ..patch };
                let loops = self.patch_loops(&patch, index, context);
                FaceSeed { surface: Ok(FaceSurface::Ready(patch.surface)), same_sense, loops, ..seed.clone() }
            }),
            _ => {
                let mut reader = self.reader(context);
                reader.whole_surface = true;
                let surface = reader.surface(index);
                self.seeds.diagnostics.append(&mut reader.notes);
                if surface.as_ref().is_ok_and(|surface| !is_bounded(surface)) {
                    self.report_unbounded(index);
                    return None;
                }
                surface.map(|surface| FaceSeed {
                    surface: Ok(FaceSurface::Ready(surface.into())),
                    ..seed.clone()
                })
            }
        };
        let seed = made.unwrap_or_else(|fault| FaceSeed { surface: Err(fault), ..seed });
        self.seeds.faces.push(seed);
        Some(ShellFace { face: (self.seeds.faces.len() - 1) as u32, reversed: false })
    }

    fn report_unbounded(&mut self, index: usize) {
        let entity = self.table.entity(index);
        let message = format!("Surface {entity} has no bounds; it is left out.");
        self.seeds.diagnostics.push(Diagnostic::new(Severity::Warning, "unbounded-surface", entity, message));
    }

    /// `rectangular_trimmed_surface`.
    fn rectangle(&mut self, index: usize, context: Context) -> Outcome<Patch> {
        let mut attributes = self.table.attributes(index).after(1);
        let basis = attributes.reference("basis surface")?;
        let mut reader = self.reader(context);
        let surface = Arc::new(reader.surface(basis)?);
        self.seeds.diagnostics.append(&mut reader.notes);
        let scale = surface_parameter_scale(&surface, context.units.length_mm, context.units.angle_rad);
        let mut bound = |what: &str, scale: f64| attributes.real(what).map(|value| value * scale);
        let u = [bound("u1", scale[0])?, bound("u2", scale[0])?];
        let v = [bound("v1", scale[1])?, bound("v2", scale[1])?];
        let (u_sense, v_sense) = (attributes.flag(), attributes.flag());
        let periods = surface.periods();
        let range = [ordered(u, u_sense, periods[0]), ordered(v, v_sense, periods[1])];
        if range.iter().any(|range| range.length() <= 0.0) {
            return Err(attributes.fault("is trimmed to nothing"));
        }
        Ok(Patch { surface, range, same_sense: u_sense == v_sense })
    }

    /// `curve_bounded_surface`: each boundary curve's segments become edges.
    fn curve_bounded(&mut self, index: usize, seed: FaceSeed, context: Context) -> Outcome<FaceSeed> {
        let mut attributes = self.table.attributes(index).after(1);
        let basis = attributes.reference("basis surface")?;
        let boundaries = attributes.references("boundaries")?;
        let implicit_outer = attributes.enumeration() == Some("T");
        let mut reader = self.reader(context);
        let surface = Arc::new(reader.surface(basis)?);
        let mut loops = Vec::new();
        if implicit_outer && is_bounded(&surface) {
            let patch = Patch { surface: surface.clone(), range: surface.domain(), same_sense: true };
            loops.extend(self.patch_loops(&patch, index, context));
        }
        for boundary in boundaries {
            loops.push(self.boundary_loop(boundary, context)?);
        }
        Ok(FaceSeed { surface: Ok(FaceSurface::Ready(surface)), loops, ..seed })
    }

    fn boundary_loop(&mut self, index: usize, context: Context) -> Outcome<Loop> {
        let mut reader = self.reader(context);
        let mut segments = Vec::new();
        for segment in self.table.attributes(index).after(1).references("segments")? {
            segments.push(reader.composite_segment(segment)?);
        }
        self.seeds.diagnostics.append(&mut reader.notes);
        turn_end_to_end(&mut segments);
        let starts: Vec<VertexId> = segments
            .iter()
            .map(|segment| self.seeds.vertex_at(segment.curve.point(segment.parameter(0.0))))
            .collect();
        let mut coedges = Vec::new();
        for (i, segment) in segments.into_iter().enumerate() {
            let (start, end) = (starts[i], starts[(i + 1) % starts.len()]);
            let curve = EdgeCurve::Ready(Arc::new(segment.curve), segment.range);
            let same_sense = !segment.reversed;
            let edge = EdgeSeed { index: None, start, end, curve, same_sense, units: context.units };
            coedges.push(Coedge { edge: self.seeds.add_edge(edge), reversed: false, pcurve: None });
        }
        let outer = self.table.kind(index) == Kind::OuterBoundaryCurve;
        Ok(Loop { entity: self.table.entity(index), coedges, vertex: None, outer })
    }

    /// The boundary of a patch; none where it is the whole of a closed surface. Sides that are single points
    /// are left out, sides that coincide are one edge.
    fn patch_loops(&mut self, patch: &Patch, index: usize, context: Context) -> Vec<Loop> {
        let [u, v] = patch.range;
        let periods = patch.surface.periods();
        let closed =
            [0, 1].map(|i| periods[i].is_some_and(|p| patch.range[i].length() >= p * (1.0 - CLOSED)));
        let at = |u, v| patch.surface.point(DVec2::new(u, v));
        let tip = |point: &dyn Fn(f64) -> DVec3| {
            let first = point(0.0);
            (1..=4).all(|i| first.distance(point(f64::from(i) * 0.25)) <= 1e-9 * (1.0 + first.length()))
        };
        let tip_v = [v.start, v.end].map(|v| tip(&|s| at(u.at(s), v)));
        let tip_u = [u.start, u.end].map(|u| tip(&|s| at(u, v.at(s))));
        let whole_u = closed[0] || tip_u == [true, true];
        let whole_v = closed[1] || tip_v == [true, true];
        if (closed[0] && whole_v) || (closed[1] && whole_u) {
            return Vec::new();
        }
        let corner = |seeds: &mut super::seeds::Seeds, u, v| seeds.vertex_at(at(u, v));
        let a = corner(&mut self.seeds, u.start, v.start);
        let b = if closed[0] || tip_v[0] { a } else { corner(&mut self.seeds, u.end, v.start) };
        let d = if closed[1] || tip_u[0] { a } else { corner(&mut self.seeds, u.start, v.end) };
        let c = match (closed[0] || tip_v[1], closed[1] || tip_u[1]) {
            (true, _) => d,
            (_, true) => b,
            _ => corner(&mut self.seeds, u.end, v.end),
        };
        let mut side = |start, end, along_u: bool, constant: f64, range: Interval| {
            let (origin, direction) = if along_u {
                (DVec3::new(0.0, constant, 0.0), DVec3::X)
            } else {
                (DVec3::new(constant, 0.0, 0.0), DVec3::Y)
            };
            let pcurve = Arc::new(Curve::Line { origin, direction });
            let curve = Curve::OnSurface { surface: patch.surface.clone(), pcurve };
            let curve = EdgeCurve::Ready(Arc::new(curve), range);
            self.seeds.add_edge(EdgeSeed {
                index: None,
                start,
                end,
                curve,
                same_sense: true,
                units: context.units,
            })
        };
        let bottom = (!tip_v[0]).then(|| side(a, b, true, v.start, u));
        let right = (!tip_u[1]).then(|| side(b, c, false, u.end, v));
        let top = if closed[1] { bottom } else { (!tip_v[1]).then(|| side(d, c, true, v.end, u)) };
        let left = if closed[0] { right } else { (!tip_u[0]).then(|| side(a, d, false, u.start, v)) };
        let sides = [(bottom, false), (right, false), (top, true), (left, true)];
        let mut coedges: Vec<Coedge> = sides
            .into_iter()
            .filter_map(|(edge, reversed)| Some(Coedge { edge: edge?, reversed, pcurve: None }))
            .collect();
        if !patch.same_sense {
            coedges.reverse();
            coedges.iter_mut().for_each(|coedge| coedge.reversed ^= true);
        }
        vec![Loop { entity: self.table.entity(index), coedges, vertex: None, outer: true }]
    }
}

fn is_bounded(surface: &Surface) -> bool {
    surface.domain().iter().all(|range| range.is_finite())
}

/// The range from the first to the second parameter, in the given sense, around a closed direction.
fn ordered(ends: [f64; 2], sense: bool, period: Option<f64>) -> Interval {
    let [mut low, mut high] = if sense { ends } else { [ends[1], ends[0]] };
    match period {
        Some(period) => {
            while high <= low + CLOSED * period {
                high += period;
            }
        }
        None if low > high => std::mem::swap(&mut low, &mut high),
        None => {}
    }
    Interval::new(low, high)
}
