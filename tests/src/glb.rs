//! A GLB as any reader sees it, measured in millimetres and in the CAD file's own axes.

use std::collections::{BTreeMap, HashMap};

use glam::{DMat4, DVec3};
use gltf::mesh::Mode;

/// The content of a GLB.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// All nodes, parents first.
    pub nodes: Vec<SceneNode>,
    /// All meshes.
    pub meshes: Vec<Mesh>,
}

/// A node.
#[derive(Clone, Debug)]
pub struct SceneNode {
    /// 0 for a root.
    pub depth: usize,
    /// Its name.
    pub name: String,
    /// `extras.instance`.
    pub instance: Option<String>,
    /// Index into [`Scene::meshes`].
    pub mesh: Option<usize>,
    /// From the mesh to glTF's world (metres, +Y up).
    pub world: DMat4,
}

/// A mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Its name.
    pub name: String,
    /// The triangles, by colour.
    pub surfaces: Vec<Surface>,
    /// Points of the lines, metres.
    pub lines: Vec<[f32; 3]>,
}

/// Triangles of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// `#rrggbbaa` in sRGB, or `none`.
    pub color: String,
    /// Positions, metres.
    pub positions: Vec<[f32; 3]>,
    /// Normals.
    pub normals: Vec<[f32; 3]>,
    /// Indices into both.
    pub triangles: Vec<[u32; 3]>,
}

/// Figures of everything that is placed: millimetres, in the CAD file's axes (+Z up).
#[derive(Clone, Debug)]
pub struct Measure {
    /// Number of triangles.
    pub triangles: usize,
    /// Their area.
    pub area_mm2: f64,
    /// The volume under them.
    pub volume_mm3: f64,
    /// Their centroid.
    pub centroid_mm: DVec3,
    /// Lower and upper corner of the triangles, of the lines where there is no triangle.
    pub bbox_mm: [DVec3; 2],
    /// Their area by colour.
    pub colors: BTreeMap<String, f64>,
}

impl Scene {
    /// Reads a GLB.
    ///
    /// # Panics
    ///
    /// Where it is not a valid one.
    pub fn read(glb: &[u8]) -> Self {
        let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(glb).expect("a valid GLB");
        let meshes = document.meshes().map(|mesh| read_mesh(&mesh, blob.as_deref())).collect();
        let mut nodes = Vec::new();
        let roots = document.scenes().flat_map(|scene| scene.nodes().collect::<Vec<_>>());
        let mut stack: Vec<_> = roots.map(|node| (node, 0, DMat4::IDENTITY)).collect();
        stack.reverse();
        while let Some((node, depth, parent)) = stack.pop() {
            let world = parent * local(&node);
            let children: Vec<_> = node.children().map(|child| (child, depth + 1, world)).collect();
            stack.extend(children.into_iter().rev());
            nodes.push(SceneNode {
                depth,
                name: node.name().unwrap_or_default().to_string(),
                instance: instance(&node),
                mesh: node.mesh().map(|mesh| mesh.index()),
                world,
            });
        }
        Self { nodes, meshes }
    }

    /// The corners of every placed triangle, millimetres, in the CAD file's axes.
    pub fn triangles(&self) -> Vec<[DVec3; 3]> {
        let mut out = Vec::new();
        for node in &self.nodes {
            for surface in node.mesh.iter().flat_map(|&mesh| &self.meshes[mesh].surfaces) {
                let corner = |i: u32| file_axes_mm(&node.world, surface.positions[i as usize]);
                out.extend(surface.triangles.iter().map(|t| t.map(corner)));
            }
        }
        out
    }

    /// The figures of everything that is placed.
    pub fn measure(&self) -> Measure {
        let mut measure = Measure {
            triangles: 0,
            area_mm2: 0.0,
            volume_mm3: 0.0,
            centroid_mm: DVec3::ZERO,
            bbox_mm: [DVec3::INFINITY, DVec3::NEG_INFINITY],
            colors: BTreeMap::new(),
        };
        for node in &self.nodes {
            let Some(mesh) = node.mesh.map(|mesh| &self.meshes[mesh]) else { continue };
            mesh.surfaces.iter().for_each(|surface| measure.add(surface, &node.world));
        }
        if measure.triangles == 0 {
            for node in &self.nodes {
                let lines = node.mesh.iter().flat_map(|&mesh| &self.meshes[mesh].lines);
                lines.for_each(|&point| measure.hold(file_axes_mm(&node.world, point)));
            }
        }
        measure.centroid_mm /= measure.area_mm2;
        measure
    }
}

impl Measure {
    fn hold(&mut self, point: DVec3) {
        let [low, high] = self.bbox_mm;
        self.bbox_mm = [low.min(point), high.max(point)];
    }

    fn add(&mut self, surface: &Surface, world: &DMat4) {
        let side = world.determinant().signum();
        let points: Vec<_> = surface.positions.iter().map(|&p| file_axes_mm(world, p)).collect();
        let origin = file_axes_mm(world, [0.0; 3]);
        let mut area = 0.0;
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.map(|i| points[i as usize]);
            let twice = (b - a).cross(c - a).length();
            area += twice / 2.0;
            self.centroid_mm += (a + b + c) / 3.0 * twice / 2.0;
            // From the mesh's own origin: far from the world's, the parts would cancel all digits.
            self.volume_mm3 += side * (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
            [a, b, c].into_iter().for_each(|point| self.hold(point));
        }
        self.triangles += surface.triangles.len();
        self.area_mm2 += area;
        *self.colors.entry(surface.color.clone()).or_default() += area;
    }
}

impl Mesh {
    /// Number of triangle edges, between equal positions, that are used more often in one direction than in the other.
    pub fn open_edges(&self) -> usize {
        let mut balance: HashMap<[[u32; 3]; 2], i64> = HashMap::new();
        for surface in &self.surfaces {
            // Equal as numbers: -0 is 0.
            let key = |i: u32| surface.positions[i as usize].map(|x| (x + 0.0).to_bits());
            for triangle in &surface.triangles {
                let [a, b, c] = triangle.map(key);
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    if from < to {
                        *balance.entry([from, to]).or_default() += 1;
                    } else if to < from {
                        *balance.entry([to, from]).or_default() -= 1;
                    }
                }
            }
        }
        balance.values().filter(|&&balance| balance != 0).count()
    }
}

fn local(node: &gltf::Node<'_>) -> DMat4 {
    let columns = node.transform().matrix();
    DMat4::from_cols_array_2d(&columns.map(|column| column.map(f64::from)))
}

/// From metres and +Y up to millimetres and +Z up.
fn file_axes_mm(world: &DMat4, point: [f32; 3]) -> DVec3 {
    let p = world.transform_point3(DVec3::from(point.map(f64::from))) * 1000.0;
    DVec3::new(p.x, -p.z, p.y)
}

fn instance(node: &gltf::Node<'_>) -> Option<String> {
    let extras = serde_json::from_str::<serde_json::Value>(node.extras().as_deref()?.get()).ok()?;
    Some(extras.get("instance")?.as_str()?.to_string())
}

fn read_mesh(mesh: &gltf::Mesh<'_>, blob: Option<&[u8]>) -> Mesh {
    let mut read =
        Mesh { name: mesh.name().unwrap_or_default().to_string(), surfaces: Vec::new(), lines: Vec::new() };
    for primitive in mesh.primitives() {
        let reader = primitive.reader(|_| blob);
        if primitive.mode() != Mode::Triangles {
            read.lines.extend(reader.read_positions().expect("positions"));
            continue;
        }
        let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
        read.surfaces.push(Surface {
            color: color(&primitive.material()),
            positions: reader.read_positions().expect("positions").collect(),
            normals: reader.read_normals().expect("normals").collect(),
            triangles: indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        });
    }
    read
}

fn color(material: &gltf::Material<'_>) -> String {
    if material.index().is_none() {
        return "none".to_string();
    }
    let [r, g, b, a] = material.pbr_metallic_roughness().base_color_factor().map(f64::from);
    let srgb = |c: f64| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    let [r, g, b, a] = [srgb(r), srgb(g), srgb(b), a].map(|c| (c * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}{a:02x}")
}
