//! The bound that is promised, measured from outside.

use trimloop_tests::deviation;

use crate::{DEFAULT, FINE, all_hold};

#[test]
fn exact_faces_are_within_the_deflection() {
    for known in [&DEFAULT, &FINE] {
        all_hold(known, |_, conversion| {
            let table = deviation::by_surface(&conversion.model, &conversion.meshes, 4);
            let outside = table.iter().filter(|(_, worst)| worst.distance_share > 1.0 + 1e-6);
            outside
                .map(|(kind, worst)| format!("{kind} at {:.3} of the deflection", worst.distance_share))
                .collect()
        });
    }
}

#[test]
fn vertices_have_the_exact_normals() {
    all_hold(&DEFAULT, |_, conversion| {
        let table = deviation::by_surface(&conversion.model, &conversion.meshes, 1);
        let wrong = table.iter().filter(|(_, worst)| worst.vertex_normal_rad > 1f64.to_radians());
        wrong
            .map(|(kind, worst)| format!("{kind} off by {:.3}°", worst.vertex_normal_rad.to_degrees()))
            .collect()
    });
}

#[test]
fn no_triangle_turns_its_back() {
    all_hold(&DEFAULT, |_, conversion| {
        let table = deviation::by_surface(&conversion.model, &conversion.meshes, 2);
        let wrong = table.iter().filter(|(_, worst)| worst.triangle_normal_rad > 90f64.to_radians());
        wrong
            .map(|(kind, worst)| format!("{kind} turned by {:.1}°", worst.triangle_normal_rad.to_degrees()))
            .collect()
    });
}
