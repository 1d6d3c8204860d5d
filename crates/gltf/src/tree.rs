//! The visible uses of products: the nodes that the output has.

use trimloop_brep::{Model, Node, Rgba};

use crate::paint::Tint;

/// One visible use of a product.
pub(crate) struct Use<'a> {
    /// The model's node.
    pub(crate) node: &'a Node,
    /// Indices of the uses below.
    pub(crate) children: Vec<usize>,
    /// What it does to its part's colours.
    pub(crate) tint: Tint,
}

/// The visible uses, parents first, and the indices of the roots.
///
/// A use's own colour stands over its part's; that of a use above it only colours what has no colour otherwise.
pub(crate) fn visible(model: &Model) -> (Vec<Use<'_>>, Vec<usize>) {
    let mut uses: Vec<Use<'_>> = Vec::new();
    let mut roots = Vec::new();
    let mut stack: Vec<(usize, Option<usize>, Option<Rgba>)> =
        model.roots.iter().rev().map(|&root| (root, None, None)).collect();
    while let Some((index, parent, above)) = stack.pop() {
        let Some(node) = model.nodes.get(index).filter(|node| !node.hidden) else { continue };
        let own = uses.len();
        match parent {
            Some(parent) => uses[parent].children.push(own),
            None => roots.push(own),
        }
        uses.push(Use { node, children: Vec::new(), tint: tint(node.color, above) });
        let below = node.color.or(above);
        stack.extend(node.children.iter().rev().map(|&child| (child, Some(own), below)));
    }
    (uses, roots)
}

fn tint(own: Option<Rgba>, above: Option<Rgba>) -> Tint {
    match (own, above) {
        (Some(own), _) => Tint::Over(own.into()),
        (None, Some(above)) => Tint::Under(above.into()),
        (None, None) => Tint::None,
    }
}
