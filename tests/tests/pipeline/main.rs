//! Whole files through all stages, held against what is known of them.

mod appearance;
mod deflection;
mod figures;
mod mask;
mod repeatable;
mod watertight;
mod wild;

use std::panic;
use std::sync::LazyLock;

use rayon::prelude::*;
use trimloop_mesh::MeshOptions;
use trimloop_tests::conversion::{Conversion, default_deflection, fine_deflection};
use trimloop_tests::fixture::{self, Fixture, Reference};

/// A fixture whose figures are known, and what became of it.
type Known = (Reference, Fixture, Result<Conversion, String>);

/// With the deflection that the command has without any option.
static DEFAULT: LazyLock<Vec<Known>> = LazyLock::new(|| convert(&default_deflection()));
/// With a tenth of it.
static FINE: LazyLock<Vec<Known>> = LazyLock::new(|| convert(&fine_deflection()));

#[test]
fn every_model_with_known_figures_is_converted() {
    let failures = DEFAULT.iter().chain(FINE.iter());
    let failures =
        failures.filter_map(|(_, fixture, conversion)| Some((&fixture.name, conversion.as_ref().err()?)));
    assert_eq!(failures.collect::<Vec<_>>(), []);
}

fn convert(options: &MeshOptions) -> Vec<Known> {
    fixture::all()
        .into_par_iter()
        .filter_map(|fixture| Some((fixture.reference()?, fixture)))
        .map(|(reference, fixture)| {
            // A panic costs one fixture, not the other tests.
            let conversion = panic::catch_unwind(|| Conversion::of(&fixture, options));
            let conversion = conversion.map_err(|_| "panicked".to_string());
            (reference, fixture, conversion.and_then(|c| c.map_err(|error| error.to_string())))
        })
        .collect()
}

/// Fails with every line that `check` has to say of any fixture, not only with the first.
#[track_caller]
fn all_hold(known: &[Known], mut check: impl FnMut(&Reference, &Conversion) -> Vec<String>) {
    let mut checked = 0;
    let mut lines = Vec::new();
    for (reference, fixture, conversion) in known {
        if let Ok(conversion) = conversion {
            checked += 1;
            let found = check(reference, conversion);
            lines.extend(found.iter().map(|line| format!("{}: {line}", fixture.name)));
        }
    }
    assert!(checked > 0, "no fixture with a reference was converted");
    assert!(lines.is_empty(), "{} findings in {checked} fixtures\n{}", lines.len(), lines.join("\n"));
}
