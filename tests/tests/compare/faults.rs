//! Faults are planted, and must be found and placed.

use glam::DVec3;
use trimloop_compare::{Shape, Verdict};
use trimloop_tests::fixture;

use crate::{exported, held, of_patch, patch_at, shape};

/// A mesh that other programs export is the same shape.
#[test]
fn a_shape_is_the_same_as_its_own_mesh() {
    for name in ["cadquery/bracket", "cadquery/torus", "cadquery/assembly_nested", "hand/text_numbers"] {
        let cad = shape(&fixture::named(name), 2e-4);
        let (found, judgement) = held(&cad, &Shape::of_mesh(exported(&cad)));
        assert_eq!(judgement.verdict, Verdict::Same, "{name}: {:?}", judgement.reasons);
        // Corners lie on the exact surface, triangles are no farther from it than they were made to be.
        assert!(found.b_corners_to_a.max_mm < 1e-6, "{name}: {}", found.b_corners_to_a.max_mm);
        assert!(found.a_to_b.max_mm <= cad.deviation_mm * 1.05 + 1e-9, "{name}: {}", found.a_to_b.max_mm);
        assert!(found.b_to_a.max_mm <= cad.deviation_mm * 1.05 + 1e-9, "{name}: {}", found.b_to_a.max_mm);
    }
}

#[test]
fn a_hole_that_has_moved() {
    let cad = shape(&fixture::named("cadquery/plate_with_hole"), 2e-4);
    let hole = cad.patches.iter().find(|patch| patch.kind == "cylinder").expect("a hole").name.clone();
    let mut mesh = cad.triangles.clone();
    let mut moved: Vec<u32> = of_patch(&cad, &hole).flat_map(|t| mesh.triangles[t]).collect();
    moved.sort_unstable();
    moved.dedup();
    moved.iter().for_each(|&point| mesh.points[point as usize].x += 0.2);
    let (found, judgement) = held(&cad, &Shape::of_mesh(mesh.welded()));
    // A fifth of a millimetre is within the usual gate of this plate: the figures show it all the same.
    let worst =
        found.faces.iter().max_by(|a, b| a.distances.max_mm.total_cmp(&b.distances.max_mm)).expect("faces");
    assert_eq!(worst.name, hole);
    assert!((worst.distances.max_mm - 0.2).abs() < 0.02, "{}", worst.distances.max_mm);
    let others = found.faces.iter().filter(|face| face.name != hole);
    // Those around it lose a strip of their area.
    assert!(others.map(|face| face.distances.rms_mm).fold(0.0, f64::max) < 0.1 * worst.distances.rms_mm);
    let gates =
        trimloop_compare::Gates { max_distance: trimloop_compare::Reach::Mm(0.1), ..Default::default() };
    let judged = trimloop_compare::judge(&found, &gates);
    assert_eq!(judged.verdict, Verdict::Different);
    assert!(judged.reasons.iter().any(|reason| reason.starts_with(&hole)), "{:?}", judged.reasons);
    assert_eq!(judgement.verdict, Verdict::Same);
}

#[test]
fn a_missing_face_makes_the_reference_suspect() {
    let cad = shape(&fixture::named("cadquery/bracket"), 2e-4);
    let name = cad.patches[3].name.clone();
    let missing: Vec<usize> = of_patch(&cad, &name).collect();
    let mut mesh = cad.triangles.clone();
    let mut index = 0;
    mesh.triangles.retain(|_| {
        index += 1;
        !missing.contains(&(index - 1))
    });
    mesh.pieces.clear();
    let (_, judgement) = held(&cad, &Shape::of_mesh(mesh.welded()));
    assert_eq!(judgement.verdict, Verdict::ReferenceSuspect, "{judgement:?}");
    assert!(
        judgement.reasons[0].contains("misses 1 of") && judgement.reasons[0].contains(&name),
        "{judgement:?}"
    );
}

#[test]
fn a_face_that_is_turned_over() {
    let cad = shape(&fixture::named("cadquery/bracket"), 2e-4);
    let name = cad.patches[2].name.clone();
    let turned: Vec<usize> = of_patch(&cad, &name).collect();
    let mut mesh = exported(&cad);
    turned.iter().for_each(|&t| mesh.triangles[t].swap(0, 1));
    let (found, judgement) = held(&cad, &Shape::of_mesh(mesh));
    assert_eq!(judgement.verdict, Verdict::Different);
    assert!(found.b.topology.flipped_edges > 0);
    assert!(
        judgement.reasons.iter().any(|r| r.contains("turned over") && r.contains(&name)),
        "{judgement:?}"
    );
}

#[test]
fn a_part_of_an_assembly_that_is_too_large() {
    let cad = shape(&fixture::named("cadquery/assembly_flat"), 2e-4);
    let part = cad.patches[0].part.clone();
    let mut mesh = cad.triangles.clone();
    let own: Vec<usize> =
        (0..cad.patch_of.len()).filter(|&t| cad.patches[cad.patch_of[t] as usize].part == part).collect();
    let mut points: Vec<u32> = own.iter().flat_map(|&t| mesh.triangles[t]).collect();
    points.sort_unstable();
    points.dedup();
    let center = points.iter().map(|&p| mesh.points[p as usize]).sum::<DVec3>() / points.len() as f64;
    for &p in &points {
        let point = &mut mesh.points[p as usize];
        *point = center + (*point - center) * 1.1;
    }
    let (found, judgement) = held(&cad, &Shape::of_mesh(mesh.welded()));
    assert_eq!(judgement.verdict, Verdict::Different);
    let worst =
        found.parts.iter().max_by(|a, b| a.distances.max_mm.total_cmp(&b.distances.max_mm)).expect("parts");
    assert_eq!(worst.name, part);
}

/// A fillet that the reference does not have: the model has changed since.
#[test]
fn an_extra_fillet() {
    let filleted = shape(&fixture::named("cadquery/box_filleted"), 2e-4);
    let plain = shape(&fixture::named("cadquery/box"), 2e-4);
    // The two are not of one size: the plain one is stretched to it.
    let (own, other) = (filleted.triangles.bounds(), plain.triangles.bounds());
    let mut mesh = exported(&plain);
    for point in &mut mesh.points {
        *point = own.min + (*point - other.min) * (own.max - own.min) / (other.max - other.min);
    }
    let (found, judgement) = held(&filleted, &Shape::of_mesh(mesh));
    assert_eq!(judgement.verdict, Verdict::Different, "{judgement:?}");
    let at = DVec3::from_array(found.b_to_a.at_mm);
    let nearest =
        filleted.patches.iter().find(|patch| patch.name == patch_at(&filleted, at)).expect("a face");
    assert!(matches!(nearest.kind, "sphere" | "cylinder" | "nurbs"), "{}", nearest.kind);
}

#[test]
fn a_coarse_mesh_is_not_the_models_fault() {
    let cad = shape(&fixture::named("cadquery/torus"), 2e-4);
    let coarse = shape(&fixture::named("cadquery/torus"), 2e-2);
    let (found, _) = held(&cad, &Shape::of_mesh(exported(&coarse)));
    assert!(found.b_corners_to_a.max_mm < 1e-6);
    let gates =
        trimloop_compare::Gates { max_distance: trimloop_compare::Reach::Mm(0.05), ..Default::default() };
    let judgement = trimloop_compare::judge(&found, &gates);
    assert_eq!(judgement.verdict, Verdict::ReferenceSuspect, "{judgement:?}");
}

#[test]
fn a_mirror_image() {
    let cad = shape(&fixture::named("cadquery/bracket"), 2e-4);
    let mut reported = 0;
    for (axis, name) in [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")] {
        let flip = glam::DAffine3::from_scale(DVec3::ONE - axis * 2.0);
        let mirrored = Shape::of_mesh(exported(&cad).transformed(&flip));
        let (_, judgement) = held(&cad, &mirrored);
        // The bracket is symmetric in one plane: there its mirror image is itself.
        if judgement.verdict != Verdict::Same {
            assert!(judgement.reasons[0].contains(&format!("mirror image of A in {name}")), "{judgement:?}");
            reported += 1;
        }
    }
    assert!(reported >= 2);
}
