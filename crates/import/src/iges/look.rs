//! Colours (IGES 5.3 sections 2.2.4.4.13 and 4.78) and names (section 4.102).

use trimloop_brep::Rgba;

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
