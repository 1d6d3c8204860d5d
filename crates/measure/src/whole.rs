//! Exact area, volume and centre of gravity of whole parts.

use glam::{DAffine3, DVec3};
use trimloop_brep::{BodyKind, Model, Node, Part};
use trimloop_compare::{Figures, Shape, figures, topology};
use trimloop_mesh::{LinearDeflection, MeshOptions, Monitor, mesh_part};

/// What a part is as a whole, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whole {
    /// Area of all faces, mm².
    pub area_mm2: f64,
    /// Volume, mm³; none where the part does not claim to be solid, or is not closed.
    pub volume_mm3: Option<f64>,
    /// Centre of gravity of the volume, or of the area where there is no volume.
    pub center: DVec3,
}

/// The triangles that are integrated over, coarse ones first: deflection as a share of the part's size, and degrees.
const LEVELS: [(f64, f64); 3] = [(1e-3, 15.0), (2e-4, 10.0), (4e-5, 6.0)];
/// Results of two levels that agree to this share are right.
const AGREEMENT: f64 = 1e-7;

/// Area, volume and centre of a part, placed in the world: integrals over its exact surfaces
/// ([`trimloop_compare::figures`]), over finer and finer triangles until two agree to 1e-7. `None` where nothing of it has
/// an area, or `monitor` stops it.
pub fn whole(part: &Part, transform: DAffine3, monitor: &dyn Monitor) -> Option<Whole> {
    let model = Model {
        parts: vec![part.clone()],
        nodes: vec![Node { transform, part: Some(0), ..Node::default() }],
        roots: vec![0],
        ..Model::default()
    };
    let (mut last, is_closed) = at(&model, LEVELS[0], monitor)?;
    for level in &LEVELS[1..] {
        let Some((next, _)) = at(&model, *level, monitor) else { break };
        let is_same = |a: f64, b: f64| (a - b).abs() <= AGREEMENT * b.abs();
        let is_done = is_same(last.area_mm2, next.area_mm2) && is_same(last.volume_mm3, next.volume_mm3);
        last = next;
        if is_done {
            break;
        }
    }
    let is_solid = !part.bodies.is_empty() && part.bodies.iter().all(|body| body.kind == BodyKind::Solid);
    let has_volume = is_solid && is_closed;
    let center = if has_volume { last.volume_centroid_mm } else { last.area_centroid_mm };
    (last.area_mm2 > 0.0).then(|| Whole {
        area_mm2: last.area_mm2,
        volume_mm3: has_volume.then_some(last.volume_mm3),
        center: DVec3::from(center),
    })
}

/// The integrals over one level of triangles, and whether they close.
fn at(model: &Model, (deflection, angle_deg): (f64, f64), monitor: &dyn Monitor) -> Option<(Figures, bool)> {
    let options = MeshOptions {
        linear_deflection: LinearDeflection::Relative(deflection),
        angular_deflection_rad: angle_deg.to_radians(),
        max_triangles: 2_000_000,
    };
    let mesh = mesh_part(&model.parts[0], &options, monitor).ok()?;
    let shape = Shape::of_model(model, &[mesh]);
    let found = topology(&shape.triangles);
    Some((figures(&shape), found.is_watertight()))
}
