//! Colours (IGES 5.3 sections 2.2.4.4.13 and 4.78), names (section 4.102 form 15) and levels (form 1 and 3).

use trimloop_brep::Rgba;
use trimloop_iges::Value;

use super::layout::Layout;
use super::reader::Reader;

/// The colour of an entity, where it has one.
pub(crate) fn color_of(reader: &Reader<'_>, entry: u32) -> Option<Rgba> {
    let directory = reader.file.get(entry)?.directory;
    match directory.color {
        0 => None,
        number @ 1..=8 => Some(standard(number)),
        pointer => {
            let mut parameters = reader.parameters(pointer.unsigned_abs()).ok()?;
            parameters.expect(&[314], "colour").ok()?;
            let mut part = || Some((parameters.optional_real()? / 100.0).clamp(0.0, 1.0) as f32);
            Some(Rgba::opaque(part()?, part()?, part()?))
        }
    }
}

fn standard(number: i32) -> Rgba {
    let [r, g, b] = match number {
        2 => [1.0, 0.0, 0.0],
        3 => [0.0, 1.0, 0.0],
        4 => [0.0, 0.0, 1.0],
        5 => [1.0, 1.0, 0.0],
        6 => [1.0, 0.0, 1.0],
        7 => [0.0, 1.0, 1.0],
        8 => [1.0, 1.0, 1.0],
        _ => [0.0, 0.0, 0.0],
    };
    Rgba::opaque(r, g, b)
}

/// The name that a property gives an entity (type 406 form 15).
pub(crate) fn property_name(reader: &Reader<'_>, entry: u32) -> Option<String> {
    let entity = reader.file.get(entry)?;
    let properties = Layout::of(&entity).properties;
    properties.into_iter().find_map(|property| text_of(reader, property, 15, 2))
}

/// The name of an entity: its property's, else its label.
pub(crate) fn name_of(reader: &Reader<'_>, entry: u32) -> Option<String> {
    let label = || Some(reader.file.get(entry)?.directory.label.clone()).filter(|label| !label.is_empty());
    property_name(reader, entry).or_else(label)
}

/// A string among the parameters of a property of this form.
fn text_of(reader: &Reader<'_>, entry: u32, form: i32, place: usize) -> Option<String> {
    let entity = reader.file.get(entry)?;
    if (entity.directory.entity_type, entity.directory.form) != (406, form) {
        return None;
    }
    let text = entity.values().nth(place)?.text()?.trim().to_owned();
    Some(text).filter(|text| !text.is_empty())
}

/// The levels that an entity lies on, as layer names: a level's number, or the name that the level itself has.
pub(crate) fn levels_of(reader: &Reader<'_>, entry: u32) -> Vec<String> {
    let Some(entity) = reader.file.get(entry) else { return Vec::new() };
    let level = entity.directory.level;
    if level > 0 {
        return vec![level.to_string()];
    }
    let Some(list) = reader.file.get(level.unsigned_abs()).filter(|_| level < 0) else { return Vec::new() };
    if (list.directory.entity_type, list.directory.form) != (406, 1) {
        return Vec::new();
    }
    list.values().skip(2).filter_map(|value| Value::integer(&value)).map(|level| level.to_string()).collect()
}
