//! What a suite came to when somebody last looked at it and said that it is good.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::comparison::Comparison;
use crate::verdict::{Judgement, Verdict};

/// What every case of a suite came to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Baseline {
    /// Of this format: 1.
    pub version: u32,
    /// By the name of the case.
    pub cases: BTreeMap<String, Blessed>,
}

/// What a case came to, now and before.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Blessed {
    /// The latest last.
    pub history: Vec<Outcome>,
}

/// What a case came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The version of trimloop that found it.
    pub trimloop: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The largest distance, either way.
    pub max_mm: f64,
    /// The larger root of the mean square of both ways.
    pub rms_mm: f64,
    /// The model's exact area.
    pub area_mm2: f64,
    /// The model's exact volume.
    pub volume_mm3: f64,
    /// The reference's area.
    pub reference_area_mm2: f64,
    /// The reference's volume.
    pub reference_volume_mm3: f64,
}

/// So many are kept of each case.
const KEPT: usize = 20;

impl Outcome {
    /// What a comparison came to.
    pub fn new(found: &Comparison, judgement: &Judgement) -> Self {
        Self {
            trimloop: env!("CARGO_PKG_VERSION").to_owned(),
            verdict: judgement.verdict,
            max_mm: rounded(found.a_to_b.max_mm.max(found.b_to_a.max_mm)),
            rms_mm: rounded(found.a_to_b.rms_mm.max(found.b_to_a.rms_mm)),
            area_mm2: rounded(found.a.figures.area_mm2),
            volume_mm3: rounded(found.a.figures.volume_mm3),
            reference_area_mm2: rounded(found.b.figures.area_mm2),
            reference_volume_mm3: rounded(found.b.figures.volume_mm3),
        }
    }

    /// Whether both say the same, to five digits (or a nanometre).
    pub fn is_like(&self, other: &Self) -> bool {
        let like = |a: f64, b: f64| (a - b).abs() <= (1e-5 * a.abs().max(b.abs())).max(1e-6);
        self.verdict == other.verdict
            && like(self.max_mm, other.max_mm)
            && like(self.rms_mm, other.rms_mm)
            && like(self.area_mm2, other.area_mm2)
            && like(self.volume_mm3, other.volume_mm3)
            && like(self.reference_area_mm2, other.reference_area_mm2)
            && like(self.reference_volume_mm3, other.reference_volume_mm3)
    }
}

/// Nine digits: what is beyond differs from machine to machine.
fn rounded(value: f64) -> f64 {
    if !value.is_finite() {
        return 0.0;
    }
    format!("{value:.8e}").parse().unwrap_or(value)
}

impl Baseline {
    /// Reads a baseline; one that is not there yet is empty.
    ///
    /// # Errors
    ///
    /// Where the file is there and cannot be understood.
    pub fn read(path: &Path) -> Result<Self, String> {
        match std::fs::read_to_string(path) {
            Ok(text) => match serde_json::from_str::<Self>(&text) {
                Ok(baseline) if baseline.version > 1 => {
                    Err(format!("`{}` is of version {}, 1 is known", path.display(), baseline.version))
                }
                Ok(baseline) => Ok(baseline),
                Err(error) => Err(format!("`{}`: {error}", path.display())),
            },
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                Ok(Self { version: 1, ..Self::default() })
            }
            Err(error) => Err(format!("cannot read `{}`: {error}", path.display())),
        }
    }

    /// What a case came to last.
    pub fn last(&self, case: &str) -> Option<&Outcome> {
        self.cases.get(case)?.history.last()
    }

    /// Takes an outcome as good.
    pub fn bless(&mut self, case: &str, outcome: Outcome) {
        let history = &mut self.cases.entry(case.to_owned()).or_default().history;
        if history.last().is_some_and(|last| last.is_like(&outcome)) {
            return;
        }
        history.push(outcome);
        let surplus = history.len().saturating_sub(KEPT);
        history.drain(..surplus);
    }

    /// As the file has it.
    pub fn to_json(&self) -> String {
        // Maps with strings as keys and numbers cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(max_mm: f64) -> Outcome {
        Outcome {
            trimloop: "0".into(),
            verdict: Verdict::Same,
            max_mm,
            rms_mm: 0.1,
            area_mm2: 1.0,
            volume_mm3: 1.0,
            reference_area_mm2: 1.0,
            reference_volume_mm3: 1.0,
        }
    }

    #[test]
    fn history_grows_by_what_changes() {
        let mut baseline = Baseline::default();
        for max_mm in [0.5, 0.5, 0.500_000_1, 0.6] {
            baseline.bless("a", outcome(max_mm));
        }
        assert_eq!(baseline.cases["a"].history.len(), 2);
        let again: Baseline = serde_json::from_str(&baseline.to_json()).expect("the same");
        assert_eq!(again, baseline);
    }
}
