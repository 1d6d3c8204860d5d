//! How a node's transform is written.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf::json::scene::{Node, UnitQuaternion};

use crate::UpAxis;

/// glTF's unit is the metre.
const METRES_PER_MM: f64 = 0.001;

/// Deviations below this (relative) are lost in f32 anyway.
const F32_ROUNDING: f64 = 1e-7;

/// What turns the model's millimetres and axes into glTF's.
pub(crate) fn conversion(up: UpAxis) -> DAffine3 {
    let turn = match up {
        UpAxis::Y => DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2),
        UpAxis::Z => DQuat::IDENTITY,
    };
    DAffine3::from_scale_rotation_translation(DVec3::splat(METRES_PER_MM), turn, DVec3::ZERO)
}

/// Writes `transform` into `node`: translation, rotation and scale where it is a similarity, leaving out what is
/// identity; else the matrix. A transform that f32 cannot hold is left out.
pub(crate) fn place(node: &mut Node, transform: &DAffine3) {
    let matrix = DMat4::from(*transform).to_cols_array().map(|c| c as f32);
    if !matrix.iter().all(|c| c.is_finite()) {
        return;
    }
    let Some((scale, rotation)) = similarity(&transform.matrix3) else {
        node.matrix = Some(matrix);
        return;
    };
    let translation = transform.translation.as_vec3() + 0.0;
    if translation != glam::Vec3::ZERO {
        node.translation = Some(translation.to_array());
    }
    let turn = DVec3::new(rotation.x, rotation.y, rotation.z);
    if turn.length() > 1e-9 {
        node.rotation = Some(UnitQuaternion(rotation.to_array().map(|c| c as f32 + 0.0)));
    }
    if (scale - 1.0).abs() > F32_ROUNDING {
        node.scale = Some([scale as f32; 3]);
    }
}

/// Scale and rotation, if that is all that `matrix` does.
fn similarity(matrix: &DMat3) -> Option<(f64, DQuat)> {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let volume = matrix.determinant();
    if volume <= 0.0 {
        return None;
    }
    let scale = volume.cbrt();
    let even = [x, y, z].iter().all(|axis| (axis.length() - scale).abs() <= F32_ROUNDING * scale);
    let square = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|d| d.abs() <= F32_ROUNDING * scale * scale);
    let unit = DMat3::from_cols(x.normalize_or_zero(), y.normalize_or_zero(), z.normalize_or_zero());
    (even && square).then(|| (scale, DQuat::from_mat3(&unit).normalize()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix that a reader makes of a node.
    fn read(node: &Node) -> DAffine3 {
        if let Some(matrix) = node.matrix {
            return DAffine3::from_mat4(DMat4::from_cols_array(&matrix.map(f64::from)));
        }
        DAffine3::from_scale_rotation_translation(
            node.scale.map_or(DVec3::ONE, |s| DVec3::from_array(s.map(f64::from))),
            node.rotation.map_or(DQuat::IDENTITY, |q| DQuat::from_array(q.0.map(f64::from))),
            node.translation.map_or(DVec3::ZERO, |t| DVec3::from_array(t.map(f64::from))),
        )
    }

    fn placed(transform: &DAffine3) -> Node {
        let mut node = Node::default();
        place(&mut node, transform);
        assert!(read(&node).abs_diff_eq(*transform, 1e-6), "{transform:?} became {node:?}");
        node
    }

    #[test]
    fn identity_is_not_written() {
        let node = placed(&DAffine3::IDENTITY);
        assert!(node.matrix.is_none() && node.translation.is_none());
        assert!(node.rotation.is_none() && node.scale.is_none());
    }

    #[test]
    fn z_up_millimetres_become_y_up_metres() {
        let node = placed(&conversion(UpAxis::Y));
        let up = read(&node).transform_vector3(DVec3::Z * 1000.0);
        assert!(up.abs_diff_eq(DVec3::Y, 1e-6));
        assert!(read(&node).transform_vector3(DVec3::X * 1000.0).abs_diff_eq(DVec3::X, 1e-6));
        assert!(node.matrix.is_none());
        let flat = placed(&conversion(UpAxis::Z));
        assert_eq!(flat.scale, Some([0.001; 3]));
        assert!(flat.rotation.is_none());
    }

    #[test]
    fn a_similarity_is_written_as_its_parts() {
        let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 2.5);
        let node = placed(&DAffine3::from_scale_rotation_translation(DVec3::splat(2.0), turn, DVec3::X));
        assert!(node.matrix.is_none());
        let length = node.rotation.unwrap().0.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() < 1e-6);
    }

    #[test]
    fn mirrors_and_stretches_are_written_as_matrices() {
        assert!(placed(&DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0))).matrix.is_some());
        assert!(placed(&DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0))).matrix.is_some());
    }

    #[test]
    fn a_transform_beyond_f32_is_left_out() {
        let mut node = Node::default();
        place(&mut node, &DAffine3::from_translation(DVec3::splat(1e300)));
        assert!(node.translation.is_none() && node.matrix.is_none());
        place(&mut node, &DAffine3::from_scale(DVec3::NAN));
        assert!(node.scale.is_none() && node.matrix.is_none());
    }
}
