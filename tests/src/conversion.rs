//! A file taken through all stages, by the libraries alone.

use trimloop_brep::Model;
use trimloop_gltf::{GltfOptions, Written};
use trimloop_import::{ImportError, ImportOptions};
use trimloop_mesh::{LinearDeflection, MeshOptions, PartMesh, Silent};

use crate::fixture::Fixture;
use crate::glb::Scene;

/// A fixture and what became of it.
#[derive(Clone, Debug)]
pub struct Conversion {
    /// The fixture.
    pub fixture: Fixture,
    /// The exact model.
    pub model: Model,
    /// The triangles of each part.
    pub meshes: Vec<PartMesh>,
    /// What the writer says it wrote.
    pub written: Written,
    /// What it wrote.
    pub glb: Vec<u8>,
}

/// 0.1 % and 20 degrees, as without any option.
pub fn default_deflection() -> MeshOptions {
    MeshOptions::default()
}

/// 0.01 % and 5 degrees.
pub fn fine_deflection() -> MeshOptions {
    MeshOptions {
        linear_deflection: LinearDeflection::Relative(1e-4),
        angular_deflection_rad: 5f64.to_radians(),
        ..MeshOptions::default()
    }
}

impl Conversion {
    /// Reads, imports, meshes and writes `fixture`.
    ///
    /// # Panics
    ///
    /// Where meshing or writing fails, which they do not on their own.
    pub fn of(fixture: &Fixture, options: &MeshOptions) -> Result<Self, ImportError> {
        let model = trimloop_import::read(&fixture.path, &ImportOptions::default())?;
        let mesh = |part| trimloop_mesh::mesh_part(part, options, &Silent).expect("nobody cancels");
        let meshes: Vec<_> = model.parts.iter().map(mesh).collect();
        let mut glb = Vec::new();
        let written = trimloop_gltf::write_glb(&model, &meshes, &GltfOptions::default(), &mut glb)
            .expect("memory takes everything");
        Ok(Self { fixture: fixture.clone(), model, meshes, written, glb })
    }

    /// What a reader of the GLB sees.
    pub fn scene(&self) -> Scene {
        Scene::read(&self.glb)
    }
}
