//! Counts and measures of parts and of the whole model.

use glam::{DAffine3, DVec3};
use serde::Serialize;
use trimloop_brep::{BodyKind, Model, Part};
use trimloop_geom::Aabb;
use trimloop_gltf::{Written, WrittenPart};
use trimloop_mesh::{FaceStatus, PartMesh};

/// Counts and measures of some geometry. Faces count whether hidden or not; triangles and what is measured on them
/// are those that are shown, as in the output.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// Bodies that claim to be solid.
    pub solids: usize,
    /// All faces: the sum of the next four.
    pub faces: usize,
    /// Faces within the deflection.
    pub exact: usize,
    /// Faces above it, or made by a fallback.
    pub approximated: usize,
    /// Faces without triangles.
    pub lost: usize,
    /// Faces whose exact area is nothing.
    pub empty: usize,
    /// Triangles, as written: those that vanish in the output's precision are left out.
    pub triangles: usize,
    /// Their vertices, as written: a point with several normals or colours counts as often.
    pub vertices: usize,
    /// Area of the triangles.
    pub area_mm2: f64,
    /// Volume inside the closed shells of the solids.
    pub volume_mm3: f64,
    /// Shells whose triangles close.
    pub closed_shells: usize,
    /// Shells whose triangles do not.
    pub open_shells: usize,
    /// Triangle edges that are used by more than two triangles.
    pub non_manifold_edges: usize,
    /// Lower and upper corner of the triangles and the free curves.
    pub bbox_mm: Option<[[f64; 3]; 2]>,
}

/// The tally of a model.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Totals {
    /// Parts, each once.
    pub parts: usize,
    /// Uses of parts.
    pub instances: usize,
    /// Every instance.
    #[serde(flatten)]
    pub tally: Tally,
}

/// One use of a part.
struct Placement {
    part: usize,
    world: DAffine3,
    shown: bool,
}

/// The tally of every part, each once, as if shown.
pub fn of_parts(model: &Model, meshes: &[PartMesh], written: &Written) -> Vec<Tally> {
    let parts = model.parts.iter().zip(meshes).zip(&written.parts);
    parts.map(|((part, mesh), written)| of_part(part, mesh, written)).collect()
}

/// The tally of the whole model, every instance counted.
pub fn of_model(model: &Model, meshes: &[PartMesh], parts: &[Tally]) -> Totals {
    let placements = placements(model);
    let mut tally = Tally::default();
    for placement in &placements {
        tally.add(&parts[placement.part], placement);
    }
    tally.bbox_mm = corners(placed_bounds(model, meshes, parts, &placements));
    Totals { parts: model.parts.len(), instances: placements.len(), tally }
}

impl Tally {
    /// Adds a use of a part, all but the box.
    fn add(&mut self, part: &Self, placement: &Placement) {
        self.solids += part.solids;
        self.faces += part.faces;
        self.exact += part.exact;
        self.approximated += part.approximated;
        self.lost += part.lost;
        self.empty += part.empty;
        if !placement.shown {
            return;
        }
        let volume_scale = placement.world.matrix3.determinant().abs();
        self.triangles += part.triangles;
        self.vertices += part.vertices;
        self.area_mm2 += part.area_mm2 * volume_scale.cbrt().powi(2);
        self.volume_mm3 += part.volume_mm3 * volume_scale;
        self.closed_shells += part.closed_shells;
        self.open_shells += part.open_shells;
        self.non_manifold_edges += part.non_manifold_edges;
    }

    fn count(&mut self, status: &FaceStatus) {
        self.faces += 1;
        match status {
            FaceStatus::Exact => self.exact += 1,
            FaceStatus::Approximated(_) => self.approximated += 1,
            FaceStatus::Lost(_) => self.lost += 1,
            FaceStatus::Empty => self.empty += 1,
        }
    }
}

fn of_part(part: &Part, mesh: &PartMesh, written: &WrittenPart) -> Tally {
    let WrittenPart { triangles, vertices, .. } = *written;
    let mut tally = Tally { solids: solids(part), triangles, vertices, ..Tally::default() };
    for (face, face_mesh) in part.faces.iter().zip(&mesh.faces) {
        tally.count(&face_mesh.status);
        if !face.hidden {
            tally.area_mm2 += face_mesh.area_mm2;
        }
    }
    for shell in &mesh.shells {
        let of_body = part.bodies.get(shell.body).and_then(|body| body.shells.get(shell.shell));
        let is_hidden = of_body.is_some_and(|shell| {
            !shell.faces.is_empty() && shell.faces.iter().all(|used| part.faces[used.face as usize].hidden)
        });
        if is_hidden {
            continue;
        }
        let closed = shell.open_edges == 0;
        *(if closed { &mut tally.closed_shells } else { &mut tally.open_shells }) += 1;
        tally.non_manifold_edges += shell.non_manifold_edges;
        if closed && part.bodies.get(shell.body).is_some_and(|body| body.kind == BodyKind::Solid) {
            tally.volume_mm3 += shell.volume_mm3;
        }
    }
    tally.bbox_mm = corners(Aabb::from_points(shown_points(part, mesh)));
    tally
}

fn solids(part: &Part) -> usize {
    part.bodies.iter().filter(|body| body.kind == BodyKind::Solid).count()
}

/// The points of the triangles that are shown, each once, and of the free curves.
fn shown_points(part: &Part, mesh: &PartMesh) -> Vec<DVec3> {
    let mut used = vec![false; mesh.positions.len()];
    for (face, face_mesh) in part.faces.iter().zip(&mesh.faces) {
        if !face.hidden && !face_mesh.triangles.is_empty() {
            for vertex in &face_mesh.vertices {
                used[vertex.position as usize] = true;
            }
        }
    }
    let points: Vec<_> = mesh.positions.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p).collect();
    if points.is_empty() {
        mesh.curves.iter().flat_map(|c| c.points.iter().copied()).collect()
    } else {
        points
    }
}

/// Every use of a part; what lies below a hidden node is hidden.
fn placements(model: &Model) -> Vec<Placement> {
    let mut found = Vec::new();
    let mut stack: Vec<_> = model.roots.iter().rev().map(|&root| (root, DAffine3::IDENTITY, true)).collect();
    while let Some((index, parent, parent_shown)) = stack.pop() {
        let node = &model.nodes[index];
        let (world, shown) = (parent * node.transform, parent_shown && !node.hidden);
        found.extend(node.part.map(|part| Placement { part, world, shown }));
        stack.extend(node.children.iter().rev().map(|&child| (child, world, shown)));
    }
    found
}

/// The exact box of all that is shown. Points are looked at only where the box's corners, turned, stand out of what
/// is already known.
fn placed_bounds(model: &Model, meshes: &[PartMesh], parts: &[Tally], placements: &[Placement]) -> Aabb {
    let mut points: Vec<Option<Vec<DVec3>>> = vec![None; parts.len()];
    let mut bounds = Aabb::EMPTY;
    for placement in placements.iter().filter(|p| p.shown) {
        let index = placement.part;
        let Some([min, max]) = parts[index].bbox_mm else { continue };
        let loose = Aabb { min: min.into(), max: max.into() }.transformed(&placement.world);
        if bounds.union(loose) == bounds {
            continue;
        }
        let points = points[index].get_or_insert_with(|| shown_points(&model.parts[index], &meshes[index]));
        bounds = points.iter().fold(bounds, |b, &p| b.with(placement.world.transform_point3(p)));
    }
    bounds
}

fn corners(bounds: Aabb) -> Option<[[f64; 3]; 2]> {
    (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()])
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, DVec3};
    use trimloop_brep::{Body, BodyKind, EntityRef, Face, FaceGeometry, Facets, Model, Node, Part};
    use trimloop_gltf::{Written, WrittenPart};
    use trimloop_mesh::{FaceMesh, FaceStatus, FaceVertex, PartMesh, ShellTopology};

    use super::{of_model, of_parts};

    /// A triangle of area 2 mm² that claims to be a solid of 5 mm³.
    fn triangle() -> (Part, PartMesh) {
        let face = Face {
            entity: EntityRef::Step(14),
            name: String::new(),
            geometry: FaceGeometry::Facets(Facets::default()),
            same_sense: true,
            loops: Vec::new(),
            color: None,
            hidden: false,
        };
        let body = Body {
            name: String::new(),
            entity: EntityRef::None,
            kind: BodyKind::Solid,
            shells: Vec::new(),
            layers: Vec::new(),
        };
        let vertex = |position| FaceVertex { position, normal: DVec3::Z, uv: glam::DVec2::ZERO };
        let mesh = PartMesh {
            positions: vec![DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0, DVec3::splat(99.0)],
            faces: vec![FaceMesh {
                status: FaceStatus::Exact,
                vertices: vec![vertex(0), vertex(1), vertex(2)],
                triangles: vec![[0, 1, 2]],
                area_mm2: 2.0,
                max_deviation_mm: 0.0,
            }],
            shells: vec![ShellTopology { volume_mm3: 5.0, ..ShellTopology::default() }],
            ..PartMesh::default()
        };
        (Part { faces: vec![face], bodies: vec![body], ..Part::default() }, mesh)
    }

    /// What the output holds of that triangle.
    fn written() -> Written {
        Written { bytes: 0, parts: vec![WrittenPart { instances: 1, triangles: 1, vertices: 3 }] }
    }

    fn node(transform: DAffine3, hidden: bool) -> Node {
        Node {
            name: String::new(),
            id: String::new(),
            instance_name: None,
            entity: EntityRef::None,
            transform,
            part: Some(0),
            children: Vec::new(),
            color: None,
            hidden,
        }
    }

    #[test]
    fn instances_count_with_their_scale_and_their_mirror_image() {
        let (part, mesh) = triangle();
        let twice_as_large = DAffine3::from_scale(DVec3::new(-2.0, 2.0, 2.0));
        let nodes = vec![node(DAffine3::IDENTITY, false), node(twice_as_large, false)];
        let model = Model { parts: vec![part], nodes, roots: vec![0, 1], ..Model::default() };
        let meshes = [mesh];
        let parts = of_parts(&model, &meshes, &written());
        let totals = of_model(&model, &meshes, &parts);
        assert_eq!((parts[0].vertices, parts[0].area_mm2, parts[0].volume_mm3), (3, 2.0, 5.0));
        assert_eq!((totals.parts, totals.instances, totals.tally.triangles), (1, 2, 2));
        assert!((totals.tally.area_mm2 - (2.0 + 8.0)).abs() < 1e-12);
        assert!((totals.tally.volume_mm3 - (5.0 + 40.0)).abs() < 1e-12);
        assert_eq!(totals.tally.bbox_mm, Some([[-4.0, 0.0, 0.0], [2.0, 4.0, 0.0]]));
    }

    #[test]
    fn what_is_hidden_has_faces_but_no_triangles() {
        let (part, mesh) = triangle();
        let mut assembly = node(DAffine3::IDENTITY, true);
        (assembly.part, assembly.children) = (None, vec![1]);
        let nodes = vec![assembly, node(DAffine3::IDENTITY, false)];
        let model = Model { parts: vec![part], nodes, roots: vec![0], ..Model::default() };
        let meshes = [mesh];
        let totals = of_model(&model, &meshes, &of_parts(&model, &meshes, &written()));
        assert_eq!((totals.tally.faces, totals.tally.triangles, totals.tally.bbox_mm), (1, 0, None));
    }
}
