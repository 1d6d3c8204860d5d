//! Colours, names and the assembly tree.

use std::iter::Peekable;

use trimloop_tests::fixture::TreeReference;

use crate::{DEFAULT, all_hold};

#[test]
fn colours_cover_the_area_they_should() {
    all_hold(&DEFAULT, |reference, conversion| {
        let measure = conversion.scene().measure();
        let allowed = 0.01 * measure.area_mm2;
        let mut lines = Vec::new();
        for color in reference.colours.keys() {
            // White and none look the same on a sheet.
            let meant = reference
                .colours
                .iter()
                .filter(|(other, _)| *other == color || is_white_or_none(other) && is_white_or_none(color));
            let area: f64 = meant.map(|(_, area)| area).sum();
            let alike = measure.colors.iter().filter(|(found, _)| same_color(found, color));
            let found: f64 = alike.map(|(_, area)| area).sum();
            if (found - area).abs() > allowed {
                lines.push(format!("{color} on {found:.3} mm², not {area:.3} (has {:?})", measure.colors));
            }
        }
        lines
    });
}

fn is_white_or_none(color: &str) -> bool {
    color == "none" || color == "#ffffffff"
}

/// Equal but for a level of rounding in each channel; a sheet without colour is white in the output, as it needs a
/// material to be seen from both sides.
fn same_color(found: &str, expected: &str) -> bool {
    let channels = |color: &str| u32::from_str_radix(color.strip_prefix('#')?, 16).ok().map(u32::to_be_bytes);
    match (channels(found), channels(expected)) {
        (Some(found), Some(expected)) => found.iter().zip(expected).all(|(f, e)| f.abs_diff(e) <= 1),
        (Some(found), None) => found == [255; 4],
        (None, Some(_)) => false,
        (None, None) => true,
    }
}

#[test]
fn the_node_tree_is_the_assembly_tree() {
    all_hold(&DEFAULT, |reference, conversion| {
        let nodes = conversion.scene().nodes;
        let names: Box<dyn Iterator<Item = _>> =
            Box::new(nodes.iter().map(|node| (node.depth, node.name.as_str())));
        let mut found = names.peekable();
        let mut lines = Vec::new();
        compare(&reference.tree, 0, &mut found, &mut lines);
        if !reference.tree.is_empty() {
            lines.extend(found.map(|(depth, name)| format!("{name:?} at level {depth} is too much")));
        }
        lines
    });
}

#[test]
fn no_two_meshes_are_alike() {
    all_hold(&DEFAULT, |_, conversion| {
        let meshes = conversion.scene().meshes;
        let twice = |(i, mesh)| meshes[..i].contains(mesh).then(|| format!("{:?} is there twice", mesh.name));
        meshes.iter().enumerate().filter_map(twice).collect()
    });
}

type Found<'a> = Peekable<Box<dyn Iterator<Item = (usize, &'a str)> + 'a>>;

/// Takes what is found in the place of `expected`. Below a product without sub-products there may be copies of a piece
/// of its geometry (`MAPPED_ITEM`).
fn compare(expected: &[TreeReference], depth: usize, found: &mut Found<'_>, lines: &mut Vec<String>) {
    for node in expected {
        match found.next() {
            Some(next) if next == (depth, node.name.as_str()) => {}
            other => lines.push(format!("{other:?}, not {:?} at level {depth}", node.name)),
        }
        compare(&node.children, depth + 1, found, lines);
        while node.children.is_empty() && found.next_if(|(below, _)| *below > depth).is_some() {}
    }
}
