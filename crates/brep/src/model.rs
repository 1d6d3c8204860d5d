//! The whole file: parts and the tree that places them.

use glam::DAffine3;

use crate::{Diagnostic, Diagnostics, EntityRef, Part, Rgba, Severity};

/// A file's content: each part once, and the instance tree that places them.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Where it comes from.
    pub source: Source,
    /// Each part once, however often it is placed.
    pub parts: Vec<Part>,
    /// The nodes of the instance tree; children come by index.
    pub nodes: Vec<Node>,
    /// Indices of the root nodes, in file order.
    pub roots: Vec<usize>,
    /// What reading and importing had to say.
    pub diagnostics: Diagnostics,
}

/// What the file says of itself.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// `step` or `iges`.
    pub format: &'static str,
    /// Short schema name for people: `AP203`, `AP214`, `AP242`, `IGES 5.3`, else what the file says.
    pub schema: String,
    /// The schema identifiers as written.
    pub schema_identifiers: Vec<String>,
    /// The CAD system that made the model.
    pub originating_system: String,
    /// The translator that wrote the file.
    pub preprocessor: String,
    /// Name in the header.
    pub name: String,
    /// Time stamp in the header.
    pub time_stamp: String,
    /// Author names.
    pub authors: Vec<String>,
    /// Organizations.
    pub organizations: Vec<String>,
    /// Length units met in the file, by name (`millimetre`, `inch`).
    pub length_units: Vec<String>,
    /// Plane angle units met in the file, by name (`radian`, `degree`).
    pub angle_units: Vec<String>,
    /// Entity counts by type name, most frequent first.
    pub entity_counts: Vec<(String, usize)>,
}

/// A node of the instance tree: one use of a product.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// The product's name as people see it, else its id.
    pub name: String,
    /// The product's id.
    pub id: String,
    /// The name of this use of it, where the file gives one.
    pub instance_name: Option<String>,
    /// The entity that places it (or the product definition for a root).
    pub entity: EntityRef,
    /// Placement in the parent, millimetres.
    pub transform: DAffine3,
    /// The geometry of this product, if it has any of its own.
    pub part: Option<usize>,
    /// Indices of the nodes below.
    pub children: Vec<usize>,
    /// A colour given to this use alone; it stands over the part's own colours.
    pub color: Option<Rgba>,
    /// Whether the file hides this use.
    pub hidden: bool,
}

impl Model {
    /// Shows every use and face that the file hides, and says so in a diagnostic.
    pub fn show_hidden(&mut self) {
        let mut shown = 0;
        let uses = self.nodes.iter_mut().map(|n| &mut n.hidden);
        let faces = self.parts.iter_mut().flat_map(|p| &mut p.faces).map(|f| &mut f.hidden);
        uses.chain(faces).for_each(|hidden| shown += usize::from(std::mem::take(hidden)));
        if shown > 0 {
            let message =
                format!("the file hides {shown} of its faces and instances; they are shown all the same");
            self.diagnostics.push(Diagnostic::new(Severity::Info, "hidden-shown", EntityRef::None, message));
        }
    }

    /// How often each part is placed below the roots (index as in `parts`).
    pub fn instance_counts(&self) -> Vec<usize> {
        let mut counts = vec![0; self.parts.len()];
        self.visit(|node, _| {
            if let Some(part) = node.part {
                counts[part] += 1;
            }
        });
        counts
    }

    /// Calls `f` for every placed node, parents first, with its transform into the world.
    ///
    /// The tree must be free of cycles, which `import` guarantees.
    pub fn visit(&self, mut f: impl FnMut(&Node, &DAffine3)) {
        let mut stack: Vec<(usize, DAffine3)> =
            self.roots.iter().rev().map(|&r| (r, DAffine3::IDENTITY)).collect();
        while let Some((index, parent)) = stack.pop() {
            let node = &self.nodes[index];
            let world = parent * node.transform;
            f(node, &world);
            stack.extend(node.children.iter().rev().map(|&c| (c, world)));
        }
    }
}
