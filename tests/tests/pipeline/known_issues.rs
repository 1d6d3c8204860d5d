//! Fixtures that are still converted wrongly, and why: shown with every run, until they are mended and taken off.

/// (fixture, what is wrong)
pub const KNOWN_ISSUES: [(&str, &str); 0] = [];

/// Why this fixture is known to be wrong, if it is.
pub fn of(fixture: &str) -> Option<&'static str> {
    KNOWN_ISSUES.iter().find(|(name, _)| *name == fixture).map(|(_, why)| *why)
}

#[test]
fn every_known_issue_names_a_fixture() {
    let names: Vec<String> = trimloop_tests::fixture::all().into_iter().map(|f| f.name).collect();
    for (name, _) in KNOWN_ISSUES {
        assert!(names.iter().any(|n| n == name), "{name} is no fixture");
    }
}
