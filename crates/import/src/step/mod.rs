//! STEP entities to the exact model.

mod annotation;
mod assembly;
mod attributes;
mod body;
mod chain;
mod component;
mod context;
mod curve;
mod edge_range;
mod face;
mod fault;
mod find_vertices;
mod finish;
mod keyword;
mod layer;
mod lone_surface;
mod look;
mod part_builder;
mod pcurve_hints;
mod placement;
mod product;
mod reader;
mod representation;
mod seeds;
mod shape_links;
mod source;
mod spline;
mod straighten;
mod style;
mod surface;
mod table;
mod tessellated;
mod units;
mod wireframe;

use trimloop_brep::{Diagnostic, Diagnostics, EntityRef, Model, Node, Part, Severity};
use trimloop_part21::Exchange;

use self::annotation::Annotations;
use self::assembly::{PartPlan, Tree, TreeBuilder};
use self::component::Placements;
use self::context::Context;
use self::layer::Layers;
use self::part_builder::{PartBuilder, is_part_geometry, is_tessellated};
use self::product::Products;
use self::reader::Budget;
use self::representation::Representations;
use self::shape_links::ShapeLinks;
use self::style::Looks;
use self::table::Table;
use self::units::UnitTable;
use crate::ImportError;

/// The exact model of a parsed STEP file.
pub(crate) fn import(exchange: &Exchange) -> Result<Model, ImportError> {
    let table = Table::new(exchange);
    let file = File::new(&table);
    let mut tree = file.tree();
    if tree.plans.is_empty() {
        file.add_lone_items(&mut tree);
    }
    let parts = crate::parallel::map_each(&tree.plans, |plan| file.part(plan));
    let mut model = Model {
        source: source::source(&table, &file.units),
        nodes: tree.nodes,
        roots: tree.roots,
        ..Model::default()
    };
    model.diagnostics.extend(exchange.errors().iter().map(syntax_diagnostic));
    model.diagnostics.append(&mut file.unit_diagnostics());
    model.diagnostics.extend(file.products.diagnostics.iter().cloned());
    model.diagnostics.append(&mut tree.diagnostics);
    for (part, mut diagnostics) in parts {
        model.parts.push(part);
        model.diagnostics.append(&mut diagnostics);
    }
    if model.parts.iter().all(|part| part.faces.is_empty() && part.curves.is_empty()) {
        return Err(ImportError::Nothing(nothing(&table, &model.diagnostics)));
    }
    Ok(model)
}

fn syntax_diagnostic(error: &trimloop_part21::SyntaxError) -> Diagnostic {
    let entity = error.instance.map_or(EntityRef::None, EntityRef::Step);
    Diagnostic::new(Severity::Error, "syntax", entity, error.to_string())
}

/// Why there is nothing, with the first and the last error as hints (a file that was cut off shows in the last).
fn nothing(table: &Table<'_>, diagnostics: &Diagnostics) -> String {
    let mut text = match table.len() {
        0 => "the file holds no entities".to_owned(),
        count => format!("none of the file's {count} entities is geometry that can be shown"),
    };
    let mut errors = diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
    match (errors.next(), errors.next_back()) {
        (Some(first), Some(last)) => text += &format!(" ({}; {})", first.message, last.message),
        (Some(only), None) => text += &format!(" ({})", only.message),
        (None, _) => {}
    }
    text
}

/// What is known of the file before its parts are read.
struct File<'t> {
    table: &'t Table<'t>,
    budget: Budget,
    units: UnitTable,
    representations: Representations,
    products: Products,
    looks: Looks,
    layers: Layers,
    annotations: Annotations,
}

impl<'t> File<'t> {
    fn new(table: &'t Table<'t>) -> Self {
        let mut representations = Representations::new(table);
        let products = Products::new(table, &mut representations);
        Self {
            table,
            budget: Budget::for_entities(table.len()),
            units: UnitTable::new(table),
            looks: Looks::new(table, &products),
            products,
            representations,
            layers: Layers::new(table),
            annotations: Annotations::new(table),
        }
    }

    fn tree(&self) -> Tree {
        let placements = Placements {
            table: self.table,
            representations: &self.representations,
            units: &self.units,
            budget: &self.budget,
        };
        let links = ShapeLinks::new(self.table, &self.products, &self.representations, &placements);
        TreeBuilder::new(self.table, &self.products, &self.representations, links, &self.looks).build()
    }

    /// Files without any representation: every solid and surface model becomes a part.
    fn add_lone_items(&self, tree: &mut Tree) {
        for index in (0..self.table.len()).filter(|&index| is_lone_model(self.table.kind(index))) {
            let name = self.table.attributes(index).text().into_owned();
            let id = self.table.entity(index).to_string();
            let name = if name.trim().is_empty() { id.clone() } else { name };
            let plan =
                PartPlan { entity: index, name, id, representations: Vec::new(), lone_items: vec![index] };
            tree.roots.push(tree.nodes.len());
            tree.nodes.push(lone_node(&plan, tree.plans.len(), self.table));
            tree.plans.push(plan);
        }
    }

    fn unit_diagnostics(&self) -> Diagnostics {
        let contexts = self.units.contexts_without_length.iter();
        let notes = contexts.map(|&context| {
            let entity = self.table.entity(context);
            let message =
                format!("{entity} gives no length unit that can be read; millimetres were assumed.");
            Diagnostic::new(Severity::Warning, "length-unit-missing", entity, message)
        });
        notes.collect()
    }

    fn part(&self, plan: &PartPlan) -> (Part, Diagnostics) {
        let mut builder =
            PartBuilder::new(self.table, &self.budget, &self.looks, &self.layers, &self.annotations);
        let mut uncertainty_mm: f64 = 0.0;
        let mut look = self.looks.of(plan.entity);
        // Exact bodies first: a tessellation that stands for one of them is then known to.
        for tessellated in [false, true] {
            for &index in &plan.representations {
                let Some(held) = self.representations.get(index) else { continue };
                let context = Context { units: self.representations.units(index, &self.units) };
                uncertainty_mm = uncertainty_mm.max(context.units.uncertainty_mm);
                look = look.over(self.looks.of(index));
                for &item in &held.items {
                    if is_tessellated(self.table.kind(item)) == tessellated {
                        builder.item(item, look, context);
                    }
                }
            }
        }
        for &item in &plan.lone_items {
            builder.item(item, look, Context { units: self.units.of_context(None) });
        }
        let (part, mut diagnostics) = finish::finish(self.table, &self.budget, builder.seeds);
        let mut part = Part {
            name: plan.name.clone(),
            id: plan.id.clone(),
            entity: self.table.entity(plan.entity),
            uncertainty_mm,
            color: look.surface,
            ..part
        };
        crate::sew::sew(&mut part, &mut diagnostics);
        (part, diagnostics)
    }
}

fn lone_node(plan: &PartPlan, part: usize, table: &Table<'_>) -> Node {
    Node {
        name: plan.name.clone(),
        id: plan.id.clone(),
        instance_name: None,
        entity: table.entity(plan.entity),
        transform: glam::DAffine3::IDENTITY,
        part: Some(part),
        children: Vec::new(),
        color: None,
        hidden: false,
    }
}

/// Whether an entity is a model in its own right, not a piece of one.
fn is_lone_model(kind: keyword::Kind) -> bool {
    use keyword::Kind;
    is_part_geometry(kind)
        && matches!(
            kind,
            Kind::ManifoldSolidBrep
                | Kind::FacetedBrep
                | Kind::BrepWithVoids
                | Kind::ShellBasedSurfaceModel
                | Kind::FaceBasedSurfaceModel
                | Kind::GeometricSet
                | Kind::GeometricCurveSet
                | Kind::TessellatedSolid
        )
}
