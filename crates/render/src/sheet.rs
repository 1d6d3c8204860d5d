//! Several pictures on one sheet.

use crate::Picture;

/// Pixels between pictures.
const GAP: u32 = 8;

/// Pictures of one size side by side, in as many rows as make the sheet about 4 : 3; what stays free is white.
pub fn contact_sheet(pictures: &[Picture]) -> Picture {
    let (width, height) = pictures.first().map_or((1, 1), |p| (p.width, p.height));
    let count = pictures.len().max(1) as f64;
    let wanted = (count * 4.0 / 3.0 * f64::from(height) / f64::from(width)).sqrt();
    let columns = (wanted.round().max(1.0) as u32).min(count as u32);
    let rows = (pictures.len() as u32).div_ceil(columns).max(1);
    let (whole_width, whole_height) = (columns * (width + GAP) + GAP, rows * (height + GAP) + GAP);
    let bytes = whole_width as usize * whole_height as usize * 4;
    let mut sheet = Picture { width: whole_width, height: whole_height, rgba: vec![255; bytes] };
    for (k, picture) in (0u32..).zip(pictures) {
        sheet.paste(picture, GAP + k % columns * (width + GAP), GAP + k / columns * (height + GAP));
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_place() {
        let one = |c: u8| Picture { width: 3, height: 2, rgba: vec![c; 24] };
        let sheet = contact_sheet(&[one(1), one(2), one(3)]);
        let seen: std::collections::BTreeSet<u8> = sheet.rgba.iter().copied().collect();
        assert_eq!(seen.into_iter().collect::<Vec<_>>(), [1, 2, 3, 255]);
        assert_eq!(sheet.rgba.iter().filter(|c| **c < 255).count(), 72);
    }
}
