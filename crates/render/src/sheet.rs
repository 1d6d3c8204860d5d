//! Several pictures on one sheet, each with its name.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use crate::Picture;

/// Pixels between pictures; height of names and of the lines that they stand in.
const GAP: u32 = 8;
const TEXT_PX: f32 = 14.0;
const LINE: u32 = 20;
const INK: [u8; 3] = [0x2b, 0x2f, 0x36];

/// Pictures of one size with their names below, side by side, in as many rows as make the sheet about 4 : 3; what stays
/// free is white.
pub fn contact_sheet(pictures: &[(String, Picture)]) -> Picture {
    let (width, height) = pictures.first().map_or((1, 1), |(_, p)| (p.width, p.height));
    let (across, down) = (width + GAP, height + LINE + GAP);
    let count = pictures.len().max(1) as f64;
    let wanted = (count * 4.0 / 3.0 * f64::from(down) / f64::from(across)).sqrt();
    let columns = (wanted.round().max(1.0) as u32).min(count as u32);
    let rows = (pictures.len() as u32).div_ceil(columns).max(1);
    let (whole_width, whole_height) = (columns * across + GAP, rows * down + GAP);
    let bytes = whole_width as usize * whole_height as usize * 4;
    let mut sheet = Picture { width: whole_width, height: whole_height, rgba: vec![255; bytes] };
    for (k, (name, picture)) in (0u32..).zip(pictures) {
        let (column, row) = (GAP + k % columns * across, GAP + k / columns * down);
        sheet.paste(picture, column, row);
        write(&mut sheet, name, [column, row + height], width);
    }
    sheet
}

/// Writes a line of text from a place on; what is too long for `width` pixels ends in an ellipsis.
fn write(sheet: &mut Picture, text: &str, [column, row]: [u32; 2], width: u32) {
    let Ok(font) = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT) else { return };
    let glyphs = fitting(&font, text, width as f32);
    let top = row as f32 + 0.5 * (LINE as f32 - TEXT_PX);
    for glyph in glyphs {
        let Some(outline) = font.outline_glyph(glyph) else { continue };
        let bounds = outline.px_bounds();
        outline.draw(|x, y, coverage| {
            let (x, y) = (bounds.min.x as i64 + i64::from(x), (bounds.min.y + top) as i64 + i64::from(y));
            let (x, y) = (x + i64::from(column), y);
            let is_inside =
                (0..i64::from(sheet.width)).contains(&x) && (0..i64::from(sheet.height)).contains(&y);
            if is_inside {
                let at = (y as usize * sheet.width as usize + x as usize) * 4;
                for (c, ink) in sheet.rgba[at..at + 3].iter_mut().zip(INK) {
                    *c = (f32::from(*c) + (f32::from(ink) - f32::from(*c)) * coverage.clamp(0.0, 1.0)) as u8;
                }
            }
        });
    }
}

fn fitting(font: &FontRef<'_>, text: &str, width: f32) -> Vec<Glyph> {
    let (glyphs, end) = laid_out(font, text);
    if end <= width {
        return glyphs;
    }
    let mut kept: Vec<char> = text.chars().collect();
    while kept.pop().is_some() {
        let shorter: String = kept.iter().chain(&['…']).collect();
        let (glyphs, end) = laid_out(font, &shorter);
        if end <= width {
            return glyphs;
        }
    }
    Vec::new()
}

/// Glyphs on one line, and where it ends.
fn laid_out(font: &FontRef<'_>, text: &str) -> (Vec<Glyph>, f32) {
    let scaled = font.as_scaled(PxScale::from(TEXT_PX));
    let mut end = 0.0;
    let mut glyphs: Vec<Glyph> = Vec::new();
    for c in text.chars() {
        let mut glyph = scaled.scaled_glyph(c);
        if let Some(before) = glyphs.last() {
            end += scaled.kern(before.id, glyph.id);
        }
        glyph.position = point(end, scaled.ascent());
        end += scaled.h_advance(glyph.id);
        glyphs.push(glyph);
    }
    (glyphs, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_place() {
        let one = |c: u8| (String::new(), Picture { width: 3, height: 2, rgba: vec![c; 24] });
        let sheet = contact_sheet(&[one(1), one(2), one(3)]);
        let seen: std::collections::BTreeSet<u8> = sheet.rgba.iter().copied().collect();
        assert_eq!(seen.into_iter().collect::<Vec<_>>(), [1, 2, 3, 255]);
        assert_eq!(sheet.rgba.iter().filter(|c| **c < 255).count(), 72);
    }

    #[test]
    fn names_stand_below_and_stay_within_their_column() {
        let white = || Picture { width: 60, height: 10, rgba: vec![255; 2400] };
        let ink = |name: &str| {
            let sheet = contact_sheet(&[(name.to_owned(), white())]);
            let dark = (0..sheet.width * sheet.height).filter(|k| sheet.rgba[*k as usize * 4] < 128);
            dark.map(|k| [k % sheet.width, k / sheet.width]).collect::<Vec<_>>()
        };
        let short = ink("Hg");
        assert!(short.len() > 10 && short.iter().all(|[x, y]| *x < 40 && (18..38).contains(y)), "{short:?}");
        assert!(ink("a name that is much too long for it").iter().all(|[x, _]| *x < 8 + 61));
    }
}
