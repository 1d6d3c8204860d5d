//! Colours, names and the assembly tree.

use trimloop_tests::fixture::TreeReference;

use crate::{DEFAULT, all_hold};

#[test]
fn colours_cover_the_area_they_should() {
    all_hold(&DEFAULT, |reference, conversion| {
        let measure = conversion.scene().measure();
        let allowed = 0.01 * measure.area_mm2;
        let mut lines = Vec::new();
        for (color, area) in &reference.colours {
            let alike = measure.colors.iter().filter(|(found, _)| same_color(found, color));
            let found: f64 = alike.map(|(_, area)| area).sum();
            if (found - area).abs() > allowed {
                lines.push(format!("{color} on {found:.3} mm², not {area:.3} (has {:?})", measure.colors));
            }
        }
        lines
    });
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
        let mut expected = Vec::new();
        flatten(&reference.tree, 0, &mut expected);
        let nodes = conversion.scene().nodes;
        let found: Vec<_> = nodes.iter().map(|node| (node.depth, node.name.clone())).collect();
        if expected.is_empty() || expected == found {
            Vec::new()
        } else {
            vec![format!("{found:?}\n    not {expected:?}")]
        }
    });
}

#[test]
fn a_part_used_often_is_one_mesh() {
    all_hold(&DEFAULT, |reference, conversion| {
        let meshes = conversion.scene().meshes.len();
        let parts = reference.parts.len();
        if parts == 0 || parts == meshes {
            Vec::new()
        } else {
            vec![format!("{meshes} meshes for {parts} parts")]
        }
    });
}

fn flatten(tree: &[TreeReference], depth: usize, found: &mut Vec<(usize, String)>) {
    for node in tree {
        found.push((depth, node.name.clone()));
        flatten(&node.children, depth + 1, found);
    }
}
