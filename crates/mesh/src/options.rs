//! What the caller asks of a mesh.

/// The largest distance between a triangle and the exact surface, and between a chord and the exact edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinearDeflection {
    /// Millimetres.
    Absolute(f64),
    /// Share (0.001 = 0.1 %) of the diagonal of the part's bounding box.
    Relative(f64),
}

/// What the caller asks of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshOptions {
    /// Linear deflection.
    pub linear_deflection: LinearDeflection,
    /// The largest angle between the exact normals (tangents for curves) at a segment's ends, radians.
    pub angular_deflection_rad: f64,
    /// The most triangles a part may have before its faces are left above the bound (and reported as approximated).
    pub max_triangles: usize,
}

impl Default for MeshOptions {
    /// 0.1 % of the part's diagonal and 20 degrees, 20 million triangles.
    fn default() -> Self {
        Self {
            linear_deflection: LinearDeflection::Relative(0.001),
            angular_deflection_rad: 20f64.to_radians(),
            max_triangles: 20_000_000,
        }
    }
}
