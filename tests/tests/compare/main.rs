//! Comparisons, held against what is known: closed forms and integrals, planted faults, the exporters' own meshes.

mod faults;
mod figures;

use glam::DVec3;
use trimloop_compare::{CompareOptions, Comparison, Gates, Judgement, Shape, Triangles, compare, judge};
use trimloop_import::ImportOptions;
use trimloop_mesh::{LinearDeflection, MeshOptions, Silent};
use trimloop_tests::fixture::Fixture;

/// A fixture as one side of a comparison, meshed within `share` of a part's diagonal.
fn shape(fixture: &Fixture, share: f64) -> Shape {
    let model = trimloop_import::read(&fixture.path, &ImportOptions::default()).expect("a readable fixture");
    let options = MeshOptions {
        linear_deflection: LinearDeflection::Relative(share),
        angular_deflection_rad: 10f64.to_radians(),
        ..MeshOptions::default()
    };
    let mesh = |part| trimloop_mesh::mesh_part(part, &options, &Silent).expect("nobody cancels");
    let meshes: Vec<_> = model.parts.iter().map(mesh).collect();
    Shape::of_model(&model, &meshes)
}

/// The triangles of a shape as another program would export them: without any exact surface.
fn exported(shape: &Shape) -> Triangles {
    Triangles { pieces: Vec::new(), ..shape.triangles.clone() }.welded()
}

/// Holds two shapes against each other, with the gates that the command has.
fn held(a: &Shape, b: &Shape) -> (Comparison, Judgement) {
    let gates = Gates::default();
    let near_mm = gates.max_distance.mm(a.triangles.bounds().diagonal());
    let found =
        compare(a, b, CompareOptions { samples: 20_000, near_mm }, &|_| true).expect("nobody stops it");
    let judgement = judge(&found, &gates);
    (found, judgement)
}

/// The triangles of one patch.
fn of_patch<'s>(shape: &'s Shape, name: &str) -> impl Iterator<Item = usize> + use<'s> {
    let patch =
        shape.patches.iter().position(|patch| patch.name == name).expect("a face of that name") as u32;
    (0..shape.patch_of.len()).filter(move |&triangle| shape.patch_of[triangle] == patch)
}

/// The name of the patch nearest to a place.
fn patch_at(shape: &Shape, place: DVec3) -> String {
    let hit = trimloop_compare::Bvh::new(&shape.triangles).nearest(place, f64::INFINITY).expect("a triangle");
    shape.patch(hit.triangle).name.clone()
}
