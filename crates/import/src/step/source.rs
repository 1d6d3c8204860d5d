//! What the file says of itself.

use trimloop_brep::Source;
use trimloop_part21::Header;

use super::table::Table;
use super::units::UnitTable;

/// Header, schema, units and entity counts.
pub(crate) fn source(table: &Table<'_>, units: &UnitTable) -> Source {
    let header = table.exchange().header();
    let given = |texts: &[String]| texts.iter().filter(|text| !text.trim().is_empty()).cloned().collect();
    Source {
        format: "step",
        schema: short_schema(header),
        schema_identifiers: header.schemas.clone(),
        originating_system: header.originating_system.clone(),
        preprocessor: header.preprocessor_version.clone(),
        name: header.name.clone(),
        time_stamp: header.time_stamp.clone(),
        authors: given(&header.author),
        organizations: given(&header.organization),
        length_units: units.length_names.clone(),
        angle_units: units.angle_names.clone(),
        entity_counts: table.counts().to_vec(),
    }
}

/// The application protocol behind a schema identifier; the identifier itself where it is none of the known.
fn short_schema(header: &Header) -> String {
    let Some(identifier) = header.schemas.first() else { return String::new() };
    let upper = identifier.to_ascii_uppercase();
    let known = [
        ("AP242", "AP242"),
        ("AUTOMOTIVE_DESIGN", "AP214"),
        ("AP214", "AP214"),
        ("CONFIG_CONTROL_DESIGN", "AP203"),
        ("AP203", "AP203"),
        ("AP209", "AP209"),
        ("AP210", "AP210"),
        ("AP238", "AP238"),
        ("INTEGRATED_CNC_SCHEMA", "AP238"),
    ];
    let found = known.iter().find(|(part, _)| upper.contains(part));
    let bare = || identifier.split('{').next().unwrap_or_default().trim().to_owned();
    found.map_or_else(bare, |(_, name)| (*name).to_owned())
}
