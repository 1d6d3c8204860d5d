//! Products and their uses in each other.

use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{Diagnostic, Diagnostics, Severity};

use super::keyword::Kind;
use super::representation::Representations;
use super::table::Table;

/// A product definition: what people call a part or an assembly.
#[derive(Clone, Debug, Default)]
pub(crate) struct Product {
    /// The product's name as people see it, else its id.
    pub name: String,
    /// The product's id.
    pub id: String,
    /// The representations of its shape.
    pub representations: Vec<usize>,
    /// What it is assembled from.
    pub uses: Vec<Use>,
}

/// One use of a product in another.
#[derive(Clone, Debug)]
pub(crate) struct Use {
    /// The `next_assembly_usage_occurrence`.
    pub index: usize,
    /// The product definition that is used.
    pub child: usize,
    /// What people call this use: its description, else its name, else its id.
    pub name: Option<String>,
    /// The relationship between two representations that places it.
    pub relationship: Option<usize>,
    /// The `context_dependent_shape_representation`.
    pub placed_by: Option<usize>,
}

/// All product definitions, by entity.
pub(crate) struct Products {
    by_index: FxHashMap<usize, Product>,
    in_order: Vec<usize>,
    owner_of: FxHashMap<usize, usize>,
    used: FxHashSet<usize>,
    use_of: FxHashMap<usize, usize>,
    /// What was wrong with them.
    pub diagnostics: Diagnostics,
}

impl Products {
    /// Reads product definitions, their shapes, and their uses in each other.
    pub fn new(table: &Table<'_>, representations: &mut Representations) -> Self {
        let kinds = [Kind::ProductDefinition, Kind::ProductDefinitionWithAssociatedDocuments];
        let in_order: Vec<_> = table.of(&kinds).collect();
        let by_index = in_order.iter().map(|&index| (index, names(table, index))).collect();
        let mut products = Self {
            by_index,
            in_order,
            owner_of: FxHashMap::default(),
            used: FxHashSet::default(),
            use_of: FxHashMap::default(),
            diagnostics: Vec::new(),
        };
        let definitions = definitions(table);
        products.add_shapes(table, representations, &definitions);
        products.add_uses(table, &definitions, representations);
        products
    }

    /// The product definition, if the entity is one.
    pub fn get(&self, index: usize) -> Option<&Product> {
        self.by_index.get(&index)
    }

    /// All product definitions in file order.
    pub fn indices(&self) -> &[usize] {
        &self.in_order
    }

    /// Whose shape a representation is.
    pub fn owner_of(&self, representation: usize) -> Option<usize> {
        self.owner_of.get(&representation).copied()
    }

    /// The use of a product that a representation stands for: styles for that use alone name such a one.
    pub fn use_of(&self, representation: usize) -> Option<usize> {
        self.use_of.get(&representation).copied()
    }

    /// Whether some other product definition uses this one.
    pub fn is_used(&self, index: usize) -> bool {
        self.used.contains(&index)
    }

    fn add_shapes(
        &mut self,
        table: &Table<'_>,
        representations: &Representations,
        definitions: &FxHashMap<usize, usize>,
    ) {
        let mut direct = Vec::new();
        for index in table.of(&[Kind::ShapeDefinitionRepresentation, Kind::PropertyDefinitionRepresentation])
        {
            let mut attributes = table.attributes(index);
            let Some(shape) = attributes.optional_reference() else { continue };
            let Some(representation) = attributes.optional_reference() else { continue };
            let Some(&product) = definitions.get(&shape) else { continue };
            if table.kind(product) == Kind::NextAssemblyUsageOccurrence {
                self.use_of.insert(representation, product);
            }
            if !self.by_index.contains_key(&product) {
                continue;
            }
            if table.kind(shape) == Kind::ProductDefinitionShape
                && representations.get(representation).is_some()
            {
                self.owner_of.entry(representation).or_insert(product);
                direct.push((product, representation));
            }
        }
        for (product, representation) in direct {
            let owner_of = &self.owner_of;
            let foreign = |other| owner_of.get(&other).is_some_and(|&owner| owner != product);
            let joined = representations.joined_with(representation, foreign);
            for found in joined {
                self.owner_of.entry(found).or_insert(product);
                let own = &mut self.by_index.get_mut(&product).expect("checked above").representations;
                if !own.contains(&found) {
                    own.push(found);
                }
            }
        }
    }

    fn add_uses(
        &mut self,
        table: &Table<'_>,
        definitions: &FxHashMap<usize, usize>,
        representations: &mut Representations,
    ) {
        let placements = placements(table, definitions);
        for (_, relationship) in placements.values() {
            representations.claim(*relationship);
        }
        representations.sort_attachments();
        for index in table.of(&[Kind::NextAssemblyUsageOccurrence, Kind::AssemblyComponentUsage]) {
            let mut attributes = table.attributes(index);
            let (id, name, description) = (attributes.text(), attributes.text(), attributes.text());
            let (parent, child) = (attributes.optional_reference(), attributes.optional_reference());
            let known = |end: Option<usize>| end.filter(|end| self.by_index.contains_key(end));
            let (Some(parent), Some(child)) = (known(parent), known(child)) else {
                self.diagnostics.push(dangling(table, index));
                continue;
            };
            let assembly = &self.by_index[&parent];
            // Some systems write a fixed phrase as the name; where there is a description, it is what people see.
            let shown = [description, name, id].into_iter().find(|text| !text.trim().is_empty());
            let name = shown.map(|text| text.trim().to_owned());
            let (placed_by, relationship) = match placements.get(&index) {
                Some(&(by, relationship)) => (Some(by), Some(relationship)),
                None => {
                    let ends = (
                        assembly.representations.as_slice(),
                        self.by_index[&child].representations.as_slice(),
                    );
                    (None, representations.claim_between(ends.0, ends.1))
                }
            };
            let usage = Use { index, child, name, relationship, placed_by };
            self.by_index.get_mut(&parent).expect("found above").uses.push(usage);
            if child != parent {
                self.used.insert(child);
            }
        }
    }
}

/// Reports a use of a product that is not there.
fn dangling(table: &Table<'_>, index: usize) -> Diagnostic {
    let entity = table.entity(index);
    let references = table.instance(index).references();
    let missing: Vec<_> =
        references.filter(|&id| table.find(id).is_none()).map(|id| format!("#{id}")).collect();
    let missing = if missing.is_empty() { "one that is none".to_owned() } else { missing.join(", ") };
    let message =
        format!("Component {entity} is left out: it refers to a product that is missing ({missing}).");
    Diagnostic::new(Severity::Error, "component-missing", entity, message)
}

/// What each `product_definition_shape` or other property defines.
fn definitions(table: &Table<'_>) -> FxHashMap<usize, usize> {
    let properties = table.of(&[Kind::ProductDefinitionShape, Kind::PropertyDefinition]);
    properties
        .filter_map(|index| Some((index, table.attributes(index).after(2).optional_reference()?)))
        .collect()
}

/// For each use its `context_dependent_shape_representation` and the relationship in it.
fn placements(table: &Table<'_>, definitions: &FxHashMap<usize, usize>) -> FxHashMap<usize, (usize, usize)> {
    let mut placements = FxHashMap::default();
    for index in table.of(&[Kind::ContextDependentShapeRepresentation]) {
        let mut attributes = table.attributes(index);
        let (relationship, shape) = (attributes.optional_reference(), attributes.optional_reference());
        let usage = shape.and_then(|shape| definitions.get(&shape));
        if let (Some(relationship), Some(&usage)) = (relationship, usage) {
            placements.entry(usage).or_insert((index, relationship));
        }
    }
    placements
}

/// Name and id of a product definition's product.
fn names(table: &Table<'_>, index: usize) -> Product {
    let mut attributes = table.attributes(index);
    let own_id = attributes.text().into_owned();
    attributes.skip(1);
    let product = attributes
        .optional_reference()
        .and_then(|formation| table.attributes(formation).after(2).optional_reference())
        .filter(|&product| table.kind(product) == Kind::Product);
    let (id, name) = match product {
        Some(product) => {
            let mut attributes = table.attributes(product);
            (attributes.text().into_owned(), attributes.text().into_owned())
        }
        None => (String::new(), String::new()),
    };
    let id = if id.is_empty() { own_id } else { id };
    let name = if name.trim().is_empty() { id.clone() } else { name };
    Product { name, id, ..Product::default() }
}
