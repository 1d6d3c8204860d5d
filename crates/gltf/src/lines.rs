//! Curves to the points and segments of one primitive.

/// The points and segments of one primitive.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Lines {
    /// Stored coordinates, one per vertex.
    pub(crate) points: Vec<[f32; 3]>,
    /// Two per segment.
    pub(crate) indices: Vec<u32>,
}

impl Lines {
    /// Adds a strip; points that coincide as stored, or that are not usable, are passed over.
    pub(crate) fn add(&mut self, strip: impl IntoIterator<Item = [f32; 3]>) {
        let start = self.points.len();
        for point in strip {
            let repeated = self.points.len() > start && self.points.last() == Some(&point);
            if !repeated && point.iter().all(|c| c.is_finite()) {
                self.points.push(point);
            }
        }
        if self.points.len() - start < 2 {
            self.points.truncate(start);
        }
        let segments = start + 1..self.points.len();
        self.indices.extend(segments.flat_map(|i| [i as u32 - 1, i as u32]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_become_segments_of_their_own() {
        let mut lines = Lines::default();
        lines.add([[0.0; 3], [1.0; 3], [2.0; 3]]);
        lines.add([[5.0; 3], [6.0; 3]]);
        assert_eq!(lines.indices, [0, 1, 1, 2, 3, 4]);
    }

    #[test]
    fn what_has_no_length_is_not_drawn() {
        let mut lines = Lines::default();
        lines.add([[1.0; 3]]);
        lines.add([[1.0; 3], [1.0; 3], [f32::NAN; 3]]);
        lines.add([]);
        assert_eq!(lines, Lines::default());
        lines.add([[0.0; 3], [0.0; 3], [f32::NAN; 3], [1.0; 3]]);
        assert_eq!(lines.indices, [0, 1]);
    }
}
