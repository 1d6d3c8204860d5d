//! The table of deviations: how far the triangles of the fixtures are from the exact surfaces.

use std::collections::BTreeMap;

use trimloop_tests::conversion::{Conversion, default_deflection, fine_deflection};
use trimloop_tests::deviation::{self, Deviation};
use trimloop_tests::fixture;

/// Steps along a triangle's sides: 45 samples each.
const DENSITY: usize = 8;

/// Prints the table for the default deflection and for the fine one, and where the worst of each kind is; of the
/// fixtures whose name contains one of `words`, or of all.
pub fn run(words: &[String]) {
    for (title, options) in
        [("0.1 %, 20 degrees", default_deflection()), ("0.01 %, 5 degrees", fine_deflection())]
    {
        let mut table: BTreeMap<_, (Deviation, String)> = BTreeMap::new();
        let chosen = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word));
        for fixture in fixture::all().into_iter().filter(|fixture| chosen(&fixture.name)) {
            // A broken fixture has no surfaces to be away from.
            let Ok(conversion) = Conversion::of(&fixture, &options) else { continue };
            for (kind, deviation) in deviation::by_surface(&conversion.model, &conversion.meshes, DENSITY) {
                let (worst, at) = table.entry(kind).or_default();
                if deviation.distance_share > worst.distance_share {
                    at.clone_from(&fixture.name);
                }
                *worst = worst.max(deviation);
            }
        }
        println!("{title}\n");
        print(&table);
    }
}

fn print(table: &BTreeMap<&str, (Deviation, String)>) {
    println!(
        "| surface | faces | samples | distance / deflection | at a vertex | shading | triangle | farthest in |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: | --- |");
    for (kind, (worst, at)) in table {
        let [vertex, shading, triangle] =
            [worst.vertex_normal_rad, worst.shading_normal_rad, worst.triangle_normal_rad]
                .map(f64::to_degrees);
        println!(
            "| {kind} | {} | {} | {:.3} | {vertex:.2}° | {shading:.2}° | {triangle:.2}° | {at} |",
            worst.faces, worst.samples, worst.distance_share
        );
    }
    println!();
}
