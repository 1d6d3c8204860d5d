//! Styles: which entity has which colour, and what is hidden.

use rustc_hash::FxHashMap;
use trimloop_brep::Rgba;

use super::body::is_face;
use super::keyword::Kind;
use super::look::Look;
use super::product::Products;
use super::table::Table;

/// The looks that the file gives to single entities.
#[derive(Debug, Default)]
pub(crate) struct Looks {
    by_entity: FxHashMap<usize, Look>,
}

impl Looks {
    /// Reads every style; over-riding ones stand over those they over-ride.
    pub fn new(table: &Table<'_>, products: &Products) -> Self {
        let mut styles = Styles { table, products, known: FxHashMap::default() };
        let mut looks = Self::default();
        for index in table.of(&[Kind::StyledItem]) {
            looks.add(&mut styles, index);
        }
        for index in table.of(&[Kind::OverRidingStyledItem, Kind::ContextDependentOverRidingStyledItem]) {
            looks.add(&mut styles, index);
        }
        looks.hide(table);
        looks
    }

    /// What the file says of an entity itself.
    pub fn of(&self, index: usize) -> Look {
        self.by_entity.get(&index).copied().unwrap_or_default()
    }

    /// Adds the styles of one styled item: to its item, or to the use of a product that they are limited to.
    fn add(&mut self, styles: &mut Styles<'_>, index: usize) {
        let table = styles.table;
        let mut attributes = table.attributes(index).after(1);
        let assigned = attributes.found_references();
        let Some(item) = attributes.optional_reference() else { return };
        let limited_to = if table.kind(index) == Kind::ContextDependentOverRidingStyledItem {
            // A colour for a single face in a single use has no place in the model: the face keeps its own.
            if is_face(table.kind(item)) {
                return;
            }
            attributes.skip(1);
            attributes.found_references().into_iter().find_map(|context| styles.usage(context))
        } else {
            None
        };
        for style in assigned {
            let (look, context) = styles.assignment(style);
            let target = self.by_entity.entry(limited_to.or(context).unwrap_or(item)).or_default();
            *target = look.over(*target);
        }
    }

    /// `invisibility` of styled items, layers and representations.
    fn hide(&mut self, table: &Table<'_>) {
        for index in table.of(&[Kind::Invisibility]) {
            for target in table.attributes(index).found_references() {
                match table.kind(target) {
                    Kind::StyledItem
                    | Kind::OverRidingStyledItem
                    | Kind::ContextDependentOverRidingStyledItem => {
                        if let Some(item) = table.attributes(target).after(2).optional_reference() {
                            self.by_entity.entry(item).or_default().hidden = true;
                        }
                    }
                    Kind::PresentationLayerAssignment => {
                        for item in table.attributes(target).after(2).found_references() {
                            self.by_entity.entry(styled_item_target(table, item)).or_default().hidden = true;
                        }
                    }
                    _ => self.by_entity.entry(target).or_default().hidden = true,
                }
            }
        }
    }
}

/// The item of a styled item; any other entity itself.
pub(crate) fn styled_item_target(table: &Table<'_>, index: usize) -> usize {
    match table.kind(index) {
        Kind::StyledItem | Kind::OverRidingStyledItem | Kind::ContextDependentOverRidingStyledItem => {
            table.attributes(index).after(2).optional_reference().unwrap_or(index)
        }
        _ => index,
    }
}

/// Reads style assignments, each once.
struct Styles<'t> {
    table: &'t Table<'t>,
    products: &'t Products,
    known: FxHashMap<usize, (Look, Option<usize>)>,
}

impl Styles<'_> {
    /// The one use of a product that the context of a style stands for, if it does.
    fn usage(&self, context: usize) -> Option<usize> {
        match self.table.kind(context) {
            Kind::ContextDependentShapeRepresentation | Kind::NextAssemblyUsageOccurrence => Some(context),
            _ => self.products.use_of(context),
        }
    }

    /// A `presentation_style_assignment`, and the use of a product that it is limited to.
    fn assignment(&mut self, index: usize) -> (Look, Option<usize>) {
        if let Some(&known) = self.known.get(&index) {
            return known;
        }
        let mut look = Look::default();
        let mut context = None;
        if matches!(
            self.table.kind(index),
            Kind::PresentationStyleAssignment | Kind::PresentationStyleByContext
        ) {
            let mut attributes = self.table.attributes(index);
            for style in attributes.found_references() {
                self.add_style(style, &mut look);
            }
            if self.table.kind(index) == Kind::PresentationStyleByContext {
                context = attributes.optional_reference().and_then(|context| self.usage(context));
            }
        } else {
            self.add_style(index, &mut look);
        }
        self.known.insert(index, (look, context));
        (look, context)
    }

    fn add_style(&self, index: usize, look: &mut Look) {
        match self.table.kind(index) {
            Kind::SurfaceStyleUsage => {
                let mut attributes = self.table.attributes(index);
                let behind = attributes.enumeration() == Some("NEGATIVE");
                let color = attributes.optional_reference().and_then(|side| self.side_style(side));
                look.surface = if behind { look.surface.or(color) } else { color.or(look.surface) };
            }
            Kind::CurveStyle => {
                let color = self.table.attributes(index).after(3).optional_reference();
                look.curve = color.and_then(|color| self.color(color)).or(look.curve);
            }
            Kind::FillAreaStyle => look.surface = self.fill_area(index).or(look.surface),
            _ => {}
        }
    }

    /// `surface_side_style`: the fill area's colour; a rendering's colour and transparency stand over it.
    fn side_style(&self, index: usize) -> Option<Rgba> {
        if self.table.kind(index) != Kind::SurfaceSideStyle {
            return None;
        }
        let mut color = None;
        let mut opacity = None;
        for element in self.table.attributes(index).after(1).found_references() {
            let mut attributes = self.table.attributes(element);
            match self.table.kind(element) {
                Kind::SurfaceStyleFillArea => {
                    color = attributes.optional_reference().and_then(|area| self.fill_area(area)).or(color);
                }
                Kind::SurfaceStyleRendering | Kind::SurfaceStyleRenderingWithProperties => {
                    attributes.skip(1);
                    color = attributes.optional_reference().and_then(|color| self.color(color)).or(color);
                    for property in attributes.found_references() {
                        opacity = self.opacity(property).or(opacity);
                    }
                }
                Kind::SurfaceStyleTransparent => opacity = self.opacity(element).or(opacity),
                _ => {}
            }
        }
        color.map(|color| Rgba { a: opacity.unwrap_or(1.0), ..color })
    }

    fn opacity(&self, index: usize) -> Option<f32> {
        if self.table.kind(index) != Kind::SurfaceStyleTransparent {
            return None;
        }
        let transparency = self.table.attributes(index).optional_real()?;
        Some(1.0 - transparency.clamp(0.0, 1.0) as f32)
    }

    fn fill_area(&self, index: usize) -> Option<Rgba> {
        if self.table.kind(index) != Kind::FillAreaStyle {
            return None;
        }
        let styles = self.table.attributes(index).after(1).found_references();
        styles.into_iter().find_map(|style| {
            let is_color = self.table.kind(style) == Kind::FillAreaStyleColour;
            let color = is_color.then(|| self.table.attributes(style).after(1).optional_reference())??;
            self.color(color)
        })
    }

    fn color(&self, index: usize) -> Option<Rgba> {
        let mut attributes = self.table.attributes(index);
        match self.table.kind(index) {
            Kind::ColourRgb => {
                attributes.skip(1);
                let channels =
                    [attributes.optional_real()?, attributes.optional_real()?, attributes.optional_real()?];
                // Some systems write channels of 0 to 255.
                let scale = if channels.iter().any(|&channel| channel > 1.5) { 255.0 } else { 1.0 };
                let [r, g, b] = channels.map(|channel| (channel / scale).clamp(0.0, 1.0) as f32);
                Some(Rgba::opaque(r, g, b))
            }
            Kind::DraughtingPreDefinedColour | Kind::PreDefinedColour => named_color(&attributes.text()),
            _ => None,
        }
    }
}

/// The colours of `draughting_pre_defined_colour` (ISO 10303-101).
fn named_color(name: &str) -> Option<Rgba> {
    let (r, g, b) = match name.trim().to_ascii_lowercase().as_str() {
        "red" => (1.0, 0.0, 0.0),
        "green" => (0.0, 1.0, 0.0),
        "blue" => (0.0, 0.0, 1.0),
        "yellow" => (1.0, 1.0, 0.0),
        "magenta" => (1.0, 0.0, 1.0),
        "cyan" => (0.0, 1.0, 1.0),
        "black" => (0.0, 0.0, 0.0),
        "white" => (1.0, 1.0, 1.0),
        _ => return None,
    };
    Some(Rgba::opaque(r, g, b))
}
