//! Collecting what a part is made of.

use trimloop_brep::{Diagnostic, FreeCurve, Severity};

use super::annotation::Annotations;
use super::body::{is_face, is_shell};
use super::context::Context;
use super::keyword::Kind;
use super::layer::Layers;
use super::look::Look;
use super::reader::{Budget, Reader};
use super::seeds::Seeds;
use super::style::Looks;
use super::table::Table;

/// Collects the topology of one part from the items of its representations.
pub(crate) struct PartBuilder<'t> {
    pub table: &'t Table<'t>,
    pub budget: &'t Budget,
    pub looks: &'t Looks,
    pub layers: &'t Layers,
    pub annotations: &'t Annotations,
    pub seeds: Seeds,
}

impl<'t> PartBuilder<'t> {
    /// A builder with nothing collected.
    pub fn new(
        table: &'t Table<'t>,
        budget: &'t Budget,
        looks: &'t Looks,
        layers: &'t Layers,
        annotations: &'t Annotations,
    ) -> Self {
        Self { table, budget, looks, layers, annotations, seeds: Seeds::default() }
    }

    /// A reader of geometry in this context.
    pub fn reader(&self, context: Context) -> Reader<'t> {
        Reader::new(self.table, self.budget, context.units)
    }

    /// Collects one representation item: a solid, a surface model, a set of curves, ...
    pub fn item(&mut self, index: usize, inherited: Look, context: Context) {
        if self.annotations.hold(index) {
            return;
        }
        let look = self.looks.of(index).over(inherited);
        match self.table.kind(index) {
            Kind::ManifoldSolidBrep | Kind::FacetedBrep | Kind::BrepWithVoids => {
                self.solid(index, look, context)
            }
            Kind::ShellBasedSurfaceModel | Kind::FaceBasedSurfaceModel => {
                self.surface_model(index, look, context)
            }
            Kind::GeometricSet | Kind::GeometricCurveSet => self.geometric_set(index, look, context),
            Kind::EdgeBasedWireframeModel | Kind::ShellBasedWireframeModel => {
                self.wireframe(index, look, context)
            }
            kind if is_shell(kind) || is_face(kind) => self.lone_sheet(index, look, context),
            kind if is_tessellated(kind) => self.tessellated(index, look, context),
            kind if is_surface(kind) => self.lone_surfaces(index, &[index], look, context),
            kind if is_curve(kind) => self.free_curve(index, look, context),
            Kind::Other => self.unsupported(index),
            _ => {}
        }
    }

    /// `geometric_set` and `geometric_curve_set`: surfaces become one sheet body, curves free curves.
    fn geometric_set(&mut self, index: usize, look: Look, context: Context) {
        let elements = self.table.attributes(index).after(1).found_references();
        let (surfaces, others): (Vec<_>, Vec<_>) =
            elements.into_iter().partition(|&element| is_surface(self.table.kind(element)));
        if !surfaces.is_empty() {
            self.lone_surfaces(index, &surfaces, look, context);
        }
        for element in others {
            if is_curve(self.table.kind(element)) {
                self.free_curve(element, look, context);
            }
        }
    }

    /// A curve that bounds no face.
    pub fn free_curve(&mut self, index: usize, inherited: Look, context: Context) {
        let look = self.looks.of(index).over(inherited);
        if look.hidden {
            return;
        }
        let mut reader = self.reader(context);
        let segment = reader.segment(index);
        self.seeds.diagnostics.append(&mut reader.notes);
        match segment {
            Ok(segment) => self.seeds.free_curves.push(FreeCurve {
                entity: self.table.entity(index),
                curve: segment.curve.into(),
                range: segment.range,
                color: look.curve.or(look.surface),
            }),
            Err(fault) => self.seeds.diagnostics.push(fault.warning("curve-unreadable")),
        }
    }

    fn unsupported(&mut self, index: usize) {
        let keyword = self.table.instance(index).keyword();
        if is_unsupported_geometry(keyword) {
            let message = format!("#{} is a {keyword}, which cannot be read.", self.table.id(index));
            let entity = self.table.entity(index);
            self.seeds.diagnostics.push(Diagnostic::new(
                Severity::Error,
                "unsupported-geometry",
                entity,
                message,
            ));
        }
    }
}

/// Whether a keyword that has no meaning here names geometry that others would show.
fn is_unsupported_geometry(keyword: &str) -> bool {
    ["SOLID", "BLOCK", "WEDGE", "CONE", "CYLINDER", "SPHERE", "TORUS", "BREP", "MODEL", "SURFACE", "VOLUME"]
        .iter()
        .any(|word| keyword.ends_with(word))
        || matches!(keyword, "BOOLEAN_RESULT" | "HALF_SPACE_SOLID" | "BOXED_HALF_SPACE")
}

/// Whether an entity is a curve.
pub(crate) fn is_curve(kind: Kind) -> bool {
    let code = kind as u8;
    (Kind::Line as u8..=Kind::BSplineCurve as u8).contains(&code)
        && !matches!(kind, Kind::CompositeCurveSegment | Kind::ReparametrisedCompositeCurveSegment)
}

/// Whether an entity is a surface.
pub(crate) fn is_surface(kind: Kind) -> bool {
    let code = kind as u8;
    (Kind::Plane as u8..=Kind::BSplineSurface as u8).contains(&code) && kind != Kind::SurfacePatch
}

/// Whether an entity is tessellated geometry.
pub(crate) fn is_tessellated(kind: Kind) -> bool {
    let code = kind as u8;
    (Kind::RepositionedTessellatedItem as u8..=Kind::TessellatedPointSet as u8).contains(&code)
}

/// Whether a representation item is geometry that a part can be made of.
pub(crate) fn is_part_geometry(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::ManifoldSolidBrep
            | Kind::FacetedBrep
            | Kind::BrepWithVoids
            | Kind::ShellBasedSurfaceModel
            | Kind::FaceBasedSurfaceModel
            | Kind::GeometricSet
            | Kind::GeometricCurveSet
            | Kind::EdgeBasedWireframeModel
            | Kind::ShellBasedWireframeModel
    ) || is_shell(kind)
        || is_face(kind)
        || is_tessellated(kind)
        || is_surface(kind)
        || is_curve(kind)
}
