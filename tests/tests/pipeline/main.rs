//! Whole files through all stages, held against what is known of them.

mod appearance;
mod deflection;
mod figures;
mod repeatable;
mod watertight;

use std::sync::LazyLock;

use rayon::prelude::*;
use trimloop_mesh::MeshOptions;
use trimloop_tests::conversion::{Conversion, default_deflection, fine_deflection};
use trimloop_tests::fixture::{self, Reference};

/// A fixture whose figures are known, and what became of it.
type Known = (Reference, Conversion);

/// With the deflection that the command has without any option.
static DEFAULT: LazyLock<Vec<Known>> = LazyLock::new(|| convert(&default_deflection()));
/// With a tenth of it.
static FINE: LazyLock<Vec<Known>> = LazyLock::new(|| convert(&fine_deflection()));

fn convert(options: &MeshOptions) -> Vec<Known> {
    fixture::all()
        .into_par_iter()
        .filter_map(|fixture| Some((fixture.reference()?, fixture)))
        .map(|(reference, fixture)| {
            let conversion = Conversion::of(&fixture, options);
            (reference, conversion.unwrap_or_else(|error| panic!("{}: {error}", fixture.name)))
        })
        .collect()
}

/// Fails with every line that `check` has to say of any fixture, not only with the first.
#[track_caller]
fn all_hold(known: &[Known], mut check: impl FnMut(&Reference, &Conversion) -> Vec<String>) {
    assert!(!known.is_empty(), "there are no fixtures with references");
    let mut lines = Vec::new();
    for (reference, conversion) in known {
        let name = &conversion.fixture.name;
        lines.extend(check(reference, conversion).into_iter().map(|line| format!("{name}: {line}")));
    }
    assert!(lines.is_empty(), "{} of {} fixtures\n{}", lines.len(), known.len(), lines.join("\n"));
}
