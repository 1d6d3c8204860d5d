//! AP242 tessellated geometry (ISO 10303-42:2014 §7): solids, shells, faces and surface sets of triangles.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use trimloop_brep::{BodyKind, Diagnostic, Facets, FreeCurve, Severity, Shell, ShellFace};
use trimloop_geom::{Curve, Interval, Polyline};
use trimloop_part21::Param;

use super::attributes::Attributes;
use super::context::Context;
use super::fault::{Fault, Outcome};
use super::keyword::Kind;
use super::look::Look;
use super::part_builder::PartBuilder;
use super::seeds::{FaceSeed, FaceSurface};

/// How deep tessellated items may be nested.
const MAX_DEPTH: usize = 16;

impl<'t> PartBuilder<'t> {
    /// A tessellated item: faces become a body, lines free curves, points nothing.
    pub fn tessellated(&mut self, index: usize, look: Look, context: Context) {
        if self.has_exact_twin(index) {
            let entity = self.table.entity(index);
            let message = format!("{entity} is a tessellation of an exact body that is read already.");
            self.seeds.diagnostics.push(Diagnostic::new(
                Severity::Info,
                "tessellation-left-out",
                entity,
                message,
            ));
            return;
        }
        let name = self.table.attributes(index).text().into_owned();
        let kind = self.tessellated_kind(index);
        // Points are shared within a body: faces meet in them, even where each lists its own.
        self.seeds.facet_point_of.clear();
        self.seeds.coordinates_of.clear();
        let mut faces = Vec::new();
        self.tessellated_faces(index, look, context, DAffine3::IDENTITY, 0, &mut faces);
        let body_kind = if kind == Kind::TessellatedSolid { BodyKind::Solid } else { BodyKind::Sheet };
        let closed = kind == Kind::TessellatedSolid;
        let shell = Shell { entity: self.table.entity(index), closed, void: false, faces };
        self.add_body(index, name, body_kind, vec![shell]);
    }

    /// Whether the item says that it stands for an exact body which this part has already.
    fn has_exact_twin(&self, index: usize) -> bool {
        let link = match self.tessellated_kind(index) {
            Kind::TessellatedSolid | Kind::TessellatedShell => {
                self.table.attributes(index).after(2).optional_reference()
            }
            _ => None,
        };
        let Some(link) = link else { return false };
        let twin = self.table.entity(link);
        self.seeds
            .bodies
            .iter()
            .any(|body| body.entity == twin || body.shells.iter().any(|s| s.entity == twin))
    }

    /// What a complex instance is beside being repositioned.
    fn tessellated_kind(&self, index: usize) -> Kind {
        let kind = self.table.kind(index);
        if kind != Kind::RepositionedTessellatedItem {
            return kind;
        }
        let instance = self.table.instance(index);
        let known = [Kind::TessellatedSolid, Kind::TessellatedShell, Kind::TessellatedGeometricSet];
        known.into_iter().find(|kind| instance.part(kind.keyword()).is_some()).unwrap_or(Kind::Other)
    }

    fn tessellated_faces(
        &mut self,
        index: usize,
        inherited: Look,
        context: Context,
        map: DAffine3,
        depth: usize,
        faces: &mut Vec<ShellFace>,
    ) {
        if self.annotations.hold(index) {
            return;
        }
        let look = self.looks.of(index).over(inherited);
        match self.tessellated_kind(index) {
            Kind::TessellatedSolid | Kind::TessellatedShell | Kind::TessellatedGeometricSet
                if depth < MAX_DEPTH =>
            {
                let map = map * self.reposition(index, context);
                for item in self.table.attributes(index).after(1).found_references() {
                    self.tessellated_faces(item, look, context, map, depth + 1, faces);
                }
            }
            Kind::TriangulatedFace
            | Kind::ComplexTriangulatedFace
            | Kind::TriangulatedSurfaceSet
            | Kind::ComplexTriangulatedSurfaceSet => {
                let made = self.facet_faces(index, look, context, map);
                faces.extend(made.into_iter().map(|face| ShellFace { face, reversed: false }));
            }
            Kind::TessellatedCurveSet if !look.hidden => {
                if let Err(fault) = self.line_strips(index, look, context, map) {
                    self.seeds.diagnostics.push(fault.warning("curve-unreadable"));
                }
            }
            _ => {}
        }
    }

    /// `tessellated_curve_set`: every strip a free polyline.
    fn line_strips(&mut self, index: usize, look: Look, context: Context, map: DAffine3) -> Outcome<()> {
        let mut attributes = self.table.attributes(index).after(1);
        let points = self.coordinates(attributes.reference("coordinates")?, context, map)?;
        for strip in corner_runs(&mut attributes)? {
            let mut corners = Vec::with_capacity(strip.len());
            for corner in strip {
                let point = corner.checked_sub(1).and_then(|corner| points.get(corner));
                let point =
                    point.ok_or_else(|| attributes.fault("a line refers to a point that does not exist"))?;
                corners.push(self.seeds.facet_points[*point as usize]);
            }
            corners.dedup();
            if corners.len() > 1 {
                let range = Interval::new(0.0, (corners.len() - 1) as f64);
                let curve = Curve::Polyline(Polyline { points: corners }).into();
                let entity = self.table.entity(index);
                self.seeds.free_curves.push(FreeCurve {
                    entity,
                    curve,
                    range,
                    color: look.curve.or(look.surface),
                });
            }
        }
        Ok(())
    }

    fn reposition(&mut self, index: usize, context: Context) -> DAffine3 {
        if self.table.kind(index) != Kind::RepositionedTessellatedItem {
            return DAffine3::IDENTITY;
        }
        let part = Attributes::of_part(self.table, index, "REPOSITIONED_TESSELLATED_ITEM");
        let Some(location) = part.and_then(|mut part| part.optional_reference()) else {
            return DAffine3::IDENTITY;
        };
        let mut reader = self.reader(context);
        let map = reader.placement_or_identity(location);
        self.seeds.diagnostics.append(&mut reader.notes);
        map
    }

    /// The face of a tessellated face; where some of its triangles cannot be read, one more that stands for those.
    fn facet_faces(&mut self, index: usize, look: Look, context: Context, map: DAffine3) -> Vec<u32> {
        let name = self.table.attributes(index).text().into_owned();
        let (surface, fault) = match self.facets(index, context, map) {
            Ok((facets, None)) => (Ok(FaceSurface::Facets(facets)), None),
            Ok((facets, Some(fault))) if facets.triangles.is_empty() => (Err(fault), None),
            Ok((facets, fault)) => (Ok(FaceSurface::Facets(facets)), fault),
            Err(fault) => (Err(fault), None),
        };
        let seed = |surface| FaceSeed {
            index,
            name: name.clone(),
            surface,
            same_sense: true,
            loops: Vec::new(),
            color: look.surface,
            hidden: look.hidden,
        };
        let first = self.seeds.faces.len() as u32;
        self.seeds.faces.push(seed(surface));
        self.seeds.faces.extend(fault.map(|fault| seed(Err(fault))));
        (first..self.seeds.faces.len() as u32).collect()
    }

    /// The triangles, and what was wrong with those that are missing.
    fn facets(&mut self, index: usize, context: Context, map: DAffine3) -> Outcome<(Facets, Option<Fault>)> {
        let kind = self.table.kind(index);
        let mut attributes = self.table.attributes(index).after(1);
        let points = self.coordinates(attributes.reference("coordinates")?, context, map)?;
        attributes.skip(1);
        let normals = triples(&mut attributes, "normals")?;
        if matches!(kind, Kind::TriangulatedFace | Kind::ComplexTriangulatedFace) {
            attributes.skip(1);
        }
        let point_of = attributes.counts("point indices")?;
        let triangles = if matches!(kind, Kind::TriangulatedFace | Kind::TriangulatedSurfaceSet) {
            corner_runs(&mut attributes)?.into_iter().filter_map(|run| run.try_into().ok()).collect()
        } else {
            let mut triangles: Vec<[usize; 3]> =
                corner_runs(&mut attributes)?.iter().flat_map(|s| strip(s)).collect();
            triangles.extend(corner_runs(&mut attributes)?.iter().flat_map(|f| fan(f)));
            triangles
        };
        let mut corners = Corners { points, point_of, normals, map };
        if !corners.normals_fit() {
            corners.normals.clear();
            let entity = self.table.entity(index);
            let message = format!("The normals of {entity} do not fit its points; they were left out.");
            self.seeds.diagnostics.push(Diagnostic::new(
                Severity::Warning,
                "normals-left-out",
                entity,
                message,
            ));
        }
        let facets = corners.facets(&triangles);
        let complete = corners.triangles_fit(&triangles);
        let fault = || attributes.fault("a triangle refers to a point that does not exist");
        Ok((facets, (!complete).then(fault)))
    }

    /// Where the points of a `coordinates_list` lie among the part's own.
    fn coordinates(&mut self, index: usize, context: Context, map: DAffine3) -> Outcome<Arc<[u32]>> {
        let identity = map == DAffine3::IDENTITY;
        if identity && let Some(known) = self.seeds.coordinates_of.get(&index) {
            return Ok(known.clone());
        }
        if self.table.kind(index) != Kind::CoordinatesList {
            return Err(self.reader(context).unexpected(index, "list of coordinates"));
        }
        let mut attributes = self.table.attributes(index).after(2);
        let points = triples(&mut attributes, "coordinates")?;
        if self.seeds.facet_points.len() + points.len() > u32::MAX as usize {
            return Err(Fault::new(self.table.id(index), "has too many points"));
        }
        let scale = context.units.length_mm;
        let placed = points.iter().map(|&point| self.seeds.facet_point(map.transform_point3(point * scale)));
        let placed: Arc<[u32]> = placed.collect();
        if identity {
            self.seeds.coordinates_of.insert(index, placed.clone());
        }
        Ok(placed)
    }
}

/// What a face's triangles refer to.
struct Corners {
    points: Arc<[u32]>,
    point_of: Vec<usize>,
    normals: Vec<DVec3>,
    map: DAffine3,
}

impl Corners {
    /// Whether there is one normal for all points or one for each, or none.
    fn normals_fit(&self) -> bool {
        let points = if self.point_of.is_empty() { self.points.len() } else { self.point_of.len() };
        self.normals.len() <= 1 || self.normals.len() >= points
    }

    /// Whether every triangle's corners exist. Corners count from 1.
    fn triangles_fit(&self, triangles: &[[usize; 3]]) -> bool {
        triangles.iter().flatten().all(|&corner| self.point(corner).is_some())
    }

    /// Triangles over the part's points, without those that refer to nothing or have two corners in one.
    fn facets(&self, triangles: &[[usize; 3]]) -> Facets {
        let mut facets = Facets::default();
        for corners in triangles {
            let [Some(a), Some(b), Some(c)] = corners.map(|corner| self.point(corner)) else { continue };
            if a == b || b == c || c == a {
                continue;
            }
            facets.triangles.push([a, b, c]);
            if !self.normals.is_empty() {
                facets.normals.push(corners.map(|corner| self.normal(corner)));
            }
        }
        if facets.normals.iter().flatten().any(|&normal| normal == DVec3::ZERO) {
            facets.normals.clear();
        }
        facets
    }

    fn point(&self, corner: usize) -> Option<u32> {
        let local = if self.point_of.is_empty() {
            corner.checked_sub(1)?
        } else {
            self.point_of.get(corner.checked_sub(1)?)?.checked_sub(1)?
        };
        self.points.get(local).copied()
    }

    /// The normal of a corner: one for all, or one for each; zero where it is unusable.
    fn normal(&self, corner: usize) -> DVec3 {
        let place = if self.normals.len() == 1 { 0 } else { corner.saturating_sub(1) };
        let normal = self.normals.get(place).copied().unwrap_or_default();
        self.map.transform_vector3(normal).normalize_or_zero()
    }
}

/// A list of lists of three numbers.
fn triples(attributes: &mut Attributes<'_>, what: &str) -> Outcome<Vec<DVec3>> {
    let mut values = Vec::new();
    for param in attributes.list(what)? {
        let Param::List(mut triple) = param else {
            return Err(attributes.fault(format!("{what} holds what is no triple")));
        };
        let mut next = || attributes.number(triple.next(), what);
        values.push(DVec3::new(next()?, next()?, next()?));
    }
    Ok(values)
}

/// A list of lists of point numbers.
fn corner_runs(attributes: &mut Attributes<'_>) -> Outcome<Vec<Vec<usize>>> {
    let mut runs = Vec::new();
    for param in attributes.list("triangles")? {
        let Param::List(run) = param else {
            return Err(attributes.fault("a triangle is not a list"));
        };
        let run: Option<Vec<usize>> = run
            .map(|corner| match corner {
                Param::Integer(value) => usize::try_from(value).ok(),
                _ => None,
            })
            .collect();
        runs.push(run.ok_or_else(|| attributes.fault("a triangle's corner is not a number"))?);
    }
    Ok(runs)
}

/// The triangles of a strip, every second one turned so that all face the same way.
fn strip(corners: &[usize]) -> Vec<[usize; 3]> {
    let windows = corners.windows(3).enumerate();
    windows.map(|(i, c)| if i % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] }).collect()
}

/// The triangles of a fan about its first corner.
fn fan(corners: &[usize]) -> Vec<[usize; 3]> {
    let Some((&first, rest)) = corners.split_first() else { return Vec::new() };
    rest.windows(2).map(|c| [first, c[0], c[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strip_triangles_face_the_same_way() {
        assert_eq!(strip(&[1, 2, 3, 4]), [[1, 2, 3], [3, 2, 4]]);
    }

    #[test]
    fn fan_turns_about_its_first_corner() {
        assert_eq!(fan(&[7, 1, 2, 3]), [[7, 1, 2], [7, 2, 3]]);
    }
}
