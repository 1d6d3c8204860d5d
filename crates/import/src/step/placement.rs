//! Placements as affine maps.

use glam::{DAffine3, DMat3, DVec3};
use trimloop_brep::Severity;

use super::fault::Outcome;
use super::keyword::Kind;
use super::reader::Reader;

impl Reader<'_> {
    /// The map of a `cartesian_transformation_operator_3d` (ISO 10303-42 §4.4.17), millimetres to millimetres:
    /// turn, mirror and uniform scale.
    pub fn transformation_operator(&self, index: usize) -> Outcome<DAffine3> {
        if self.table.kind(index) != Kind::CartesianTransformationOperator3d {
            return Err(self.unexpected(index, "transformation"));
        }
        // The operator inherits from two supertypes with texts of their own, which exporters write in different
        // numbers: read from the end.
        let all: Vec<_> = {
            let mut attributes = self.table.attributes(index);
            std::iter::from_fn(|| attributes.param()).take(16).collect()
        };
        let Some(first) = all.len().checked_sub(5) else {
            return Err(self.fault(index, "has too few attributes"));
        };
        let mut attributes = self.table.attributes(index).after(first);
        let axis1 = self.optional_direction(&mut attributes)?;
        let axis2 = self.optional_direction(&mut attributes)?;
        let origin = self.point(attributes.reference("local origin")?)?;
        let scale = attributes.optional_real().unwrap_or(1.0);
        let axis3 = self.optional_direction(&mut attributes)?;
        if scale <= 0.0 {
            return Err(self.fault(index, "its scale is not positive"));
        }
        Ok(DAffine3 { matrix3: base_axes(axis1, axis2, axis3) * scale, translation: origin })
    }

    /// The map from a placement's own coordinates to those around it.
    pub fn placement(&self, index: usize) -> Outcome<DAffine3> {
        match self.table.kind(index) {
            Kind::CartesianTransformationOperator3d => self.transformation_operator(index),
            _ => Ok(self.frame(index)?.to_affine()),
        }
    }

    /// The same; a placement that cannot be read is reported and counts as none.
    pub fn placement_or_identity(&mut self, index: usize) -> DAffine3 {
        self.placement(index).unwrap_or_else(|fault| {
            self.notes.push(fault.diagnostic("placement-unreadable"));
            DAffine3::IDENTITY
        })
    }

    /// Notes that a placement is missing.
    pub fn note_missing_placement(&mut self, index: usize) {
        let message = format!("#{} has no placement; it stays at the origin.", self.table.id(index));
        self.note(Severity::Warning, "placement-missing", index, message);
    }
}

/// ISO 10303-42 `base_axis` for three dimensions: axis 3 holds, axis 1 is made normal to it, axis 2 may mirror.
fn base_axes(axis1: Option<DVec3>, axis2: Option<DVec3>, axis3: Option<DVec3>) -> DMat3 {
    let z = axis3.and_then(DVec3::try_normalize).unwrap_or(DVec3::Z);
    let flat = |v: DVec3| (v - z * v.dot(z)).try_normalize();
    let x = axis1.and_then(flat).or_else(|| flat(DVec3::X)).unwrap_or(DVec3::Y);
    let y = z.cross(x);
    let mirrored = axis2.is_some_and(|axis2| axis2.dot(y) < 0.0);
    DMat3::from_cols(x, if mirrored { -y } else { y }, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_axes_are_the_worlds() {
        assert_eq!(base_axes(None, None, None), DMat3::IDENTITY);
    }

    #[test]
    fn second_axis_against_the_right_hand_mirrors() {
        let axes = base_axes(Some(DVec3::X), Some(-DVec3::Y), None);
        assert_eq!(axes.determinant(), -1.0);
    }
}
