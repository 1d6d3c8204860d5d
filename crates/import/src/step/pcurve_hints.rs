//! The file's own curves in the parameters of faces' surfaces.

use std::sync::Arc;

use trimloop_geom::{Curve, Surface};

use super::fault::Outcome;
use super::keyword::Kind;
use super::reader::{Budget, Reader};
use super::seeds::{EdgeCurve, FaceSeed, FaceSurface, Seeds};
use super::table::Table;
use crate::parallel::map;

/// For each face the pcurves of its coedges, loop after loop; empty for a face that has none.
pub(crate) type Hints = Vec<Vec<Option<Arc<Curve>>>>;

/// Reads pcurves for the faces whose surfaces cannot be inverted in closed form; the others need no hint.
pub(crate) fn hints(
    table: &Table<'_>,
    budget: &Budget,
    seeds: &Seeds,
    surfaces: &[Outcome<Arc<Surface>>],
) -> Hints {
    let any = seeds.curves.iter().any(|&(index, _)| is_surface_curve(table.kind(index)));
    if !any {
        return vec![Vec::new(); seeds.faces.len()];
    }
    map(&seeds.faces, |face| of_face(table, budget, seeds, surfaces, face).unwrap_or_default())
}

fn of_face(
    table: &Table<'_>,
    budget: &Budget,
    seeds: &Seeds,
    surfaces: &[Outcome<Arc<Surface>>],
    face: &FaceSeed,
) -> Option<Vec<Option<Arc<Curve>>>> {
    let Ok(FaceSurface::Slot(slot)) = &face.surface else { return None };
    let surface = surfaces[*slot].as_ref().ok()?;
    if !matches!(
        **surface,
        Surface::Nurbs(_) | Surface::Extrusion { .. } | Surface::Revolution { .. } | Surface::Offset { .. }
    ) {
        return None;
    }
    let (surface_index, ..) = seeds.surfaces[*slot];
    let coedges = face.loops.iter().flat_map(|bound| &bound.coedges);
    let found = coedges.map(|coedge| {
        let edge = &seeds.edges[coedge.edge as usize];
        let EdgeCurve::Slot(curve) = edge.curve else { return None };
        let (curve, units) = seeds.curves[curve];
        let pcurve = pcurve_on(table, curve, surface_index, coedge.reversed)?;
        Reader::new(table, budget, units).pcurve(pcurve, surface).ok().map(Arc::new)
    });
    Some(found.collect())
}

/// The pcurve of a surface curve that lies on the given surface. A seam has two: the first is for the use in the
/// edge's own direction.
fn pcurve_on(table: &Table<'_>, curve: usize, surface: usize, reversed: bool) -> Option<usize> {
    if !is_surface_curve(table.kind(curve)) {
        return None;
    }
    let associated = table.attributes(curve).after(2).found_references();
    let mut on_surface = associated.into_iter().filter(|&pcurve| {
        matches!(table.kind(pcurve), Kind::Pcurve | Kind::BoundedPcurve)
            && table.attributes(pcurve).after(1).optional_reference() == Some(surface)
    });
    let first = on_surface.next();
    if reversed { on_surface.next().or(first) } else { first }
}

fn is_surface_curve(kind: Kind) -> bool {
    matches!(kind, Kind::SurfaceCurve | Kind::SeamCurve | Kind::IntersectionCurve | Kind::BoundedSurfaceCurve)
}
