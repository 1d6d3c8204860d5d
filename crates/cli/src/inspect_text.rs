//! What is in a file, for people.

use std::fmt::{self, Write};

use crate::inspect::{Counted, Inspection, NodeReport};
use crate::summary::counted;

/// Deeper levels of the tree are not indented further.
const DEEPEST_INDENT: usize = 40;
/// Entity types and colours are listed up to this number.
const LISTED: usize = 12;

/// The description, with a newline at its end.
pub fn of(inspection: &Inspection) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, inspection);
    text
}

fn write(out: &mut String, inspection: &Inspection) -> fmt::Result {
    let counts = &inspection.counts;
    writeln!(out, "{}", inspection.input)?;
    let format = format!("{} {}", inspection.format.to_uppercase(), inspection.schema);
    line(out, "format", &format!("{format}, {} bytes", inspection.bytes))?;
    line(out, "schema", &inspection.schema_identifiers.join(", "))?;
    line(out, "system", &inspection.originating_system)?;
    line(out, "translator", &inspection.preprocessor)?;
    line(out, "name", &inspection.name)?;
    line(out, "written", &inspection.time_stamp)?;
    line(out, "author", &inspection.authors.join(", "))?;
    line(out, "company", &inspection.organizations.join(", "))?;
    let units = [inspection.length_units.as_slice(), &inspection.angle_units].concat();
    line(out, "units", &units.join(", "))?;
    let contents = [
        (counts.parts, "part"),
        (counts.instances, "instance"),
        (counts.solids, "solid"),
        (counts.sheets, "sheet"),
        (counts.faces, "face"),
        (counts.edges, "edge"),
        (counts.free_curves, "free curve"),
    ];
    let contents = contents.iter().filter(|(count, _)| *count > 0);
    let contents: Vec<_> = contents.map(|(count, noun)| counted(*count, noun)).collect();
    line(out, "contents", &contents.join(", "))?;
    line(out, "surfaces", &list(&inspection.surfaces))?;
    line(out, "curves", &list(&inspection.curves))?;
    line(out, "colours", &list(&inspection.colors))?;
    line(out, "layers", &list(&inspection.layers))?;
    line(out, "entities", &list(&inspection.entities))?;
    write_tree(out, inspection)?;
    for diagnostic in &inspection.diagnostics {
        let entity = diagnostic.entity.as_deref().unwrap_or_default();
        writeln!(out, "  {} {} {entity}: {}", diagnostic.severity, diagnostic.code, diagnostic.message)?;
    }
    Ok(())
}

fn line(out: &mut String, label: &str, text: &str) -> fmt::Result {
    if text.is_empty() { Ok(()) } else { writeln!(out, "  {label:<11} {text}") }
}

/// `plane 12, cylinder 4`.
fn list(counted: &[Counted]) -> String {
    let mut items: Vec<_> =
        counted.iter().take(LISTED).map(|item| format!("{} {}", item.name, item.count)).collect();
    if counted.len() > LISTED {
        items.push(format!("{} more kinds", counted.len() - LISTED));
    }
    items.join(", ")
}

fn write_tree(out: &mut String, inspection: &Inspection) -> fmt::Result {
    writeln!(out, "  tree")?;
    let mut stack: Vec<_> = inspection.roots.iter().rev().map(|&root| (root, 0)).collect();
    while let Some((index, depth)) = stack.pop() {
        let node = &inspection.nodes[index];
        writeln!(out, "    {:1$}{2}", "", 2 * usize::min(depth, DEEPEST_INDENT), describe(node))?;
        stack.extend(node.children.iter().rev().map(|&child| (child, depth + 1)));
    }
    Ok(())
}

fn describe(node: &NodeReport) -> String {
    let mut text = node.name.clone();
    if let Some(instance) = node.instance.as_ref().filter(|name| **name != node.name) {
        text += &format!(" \"{instance}\"");
    }
    let contents = [(node.solids, "solid"), (node.sheets, "sheet"), (node.faces, "face")];
    let contents: Vec<_> =
        contents.iter().filter(|(count, _)| *count > 0).map(|(count, noun)| counted(*count, noun)).collect();
    if !contents.is_empty() {
        text += &format!(" ({})", contents.join(", "));
    }
    if node.hidden {
        text += " [hidden]";
    }
    text
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use trimloop_brep::{EntityRef, Model, Node};
    use trimloop_geom::DAffine3;

    use crate::inspect::Inspection;

    fn node(name: &str, children: Vec<usize>) -> Node {
        Node {
            name: name.into(),
            id: name.into(),
            instance_name: None,
            entity: EntityRef::None,
            transform: DAffine3::IDENTITY,
            part: None,
            children,
            color: None,
            hidden: name == "Cover",
        }
    }

    #[test]
    fn the_tree_is_indented_in_file_order() {
        let nodes = vec![
            node("Gearbox", vec![1, 3]),
            node("Shaft", vec![2]),
            node("Key", vec![]),
            node("Cover", vec![]),
        ];
        let model = Model { nodes, roots: vec![0], ..Model::default() };
        let text = super::of(&Inspection::new(Path::new("a.step"), &model));
        let tree = text.split_once("tree\n").expect("a tree").1;
        assert_eq!(tree, "    Gearbox\n      Shaft\n        Key\n      Cover [hidden]\n");
    }

    #[test]
    fn a_deep_tree_takes_neither_the_stack_nor_endless_blanks() {
        let levels = 100_000;
        let mut nodes: Vec<_> = (1..levels).map(|child| node("level", vec![child])).collect();
        nodes.push(node("level", vec![]));
        let model = Model { nodes, roots: vec![0], ..Model::default() };
        let text = super::of(&Inspection::new(Path::new("a.step"), &model));
        assert!(text.len() < levels * 100);
    }
}
