//! How many cells each shape's grid needs in a view.

use glam::{DVec3, Vec3};

use crate::device::Key;
use crate::shape::{Net, Source};
use crate::{Gpu, GpuError, Shape};

/// What the level of detail depends on; as in `shaders/lod_factors.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LodShape {
    /// Centre of a sphere around the shape, relative to the scene's origin.
    pub center: Vec3,
    /// Its radius, millimetres.
    pub radius: f32,
    /// Largest lengths along u and along v, millimetres.
    pub lengths: [f32; 2],
    /// Largest second derivatives along u and along v with the domain stretched to the unit square, millimetres.
    pub bends: [f32; 2],
}

/// A view; as in `shaders/lod_factors.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct LodView {
    /// The eye, relative to the scene's origin.
    pub eye: Vec3,
    /// Size of a pixel at distance 1 (in a parallel view at any distance), millimetres.
    pub pixel: f32,
    /// Pixels that a chord may be away from the surface.
    pub chord_px: f32,
    /// Pixels that a cell may be long.
    pub cell_px: f32,
    /// Fewest cells along a direction.
    pub fewest: f32,
    /// Most cells along a direction.
    pub most: f32,
    /// 1 for a parallel view.
    pub is_parallel: u32,
    /// Nothing.
    pub unused: [u32; 3],
}

impl LodShape {
    /// What `shape` looks like from far away, measured from `scene_origin`. `None` without a NURBS form.
    ///
    /// Lengths and second derivatives are those of the control nets of its facets: they are never less than the
    /// surface's where it is polynomial, and close to them where weights are moderate. Kinks at knots are not seen: a
    /// grid over several facets needs lines there.
    pub fn new(shape: &Shape, scene_origin: DVec3) -> Option<Self> {
        let net = shape.net.as_ref()?;
        let center = (shape.origin() - scene_origin).as_vec3();
        let radius = (0.5 * shape.size()) as f32;
        let [u, v] = [0, 1].map(|d| measure(shape, net, d));
        let bends = if matches!(shape.source, Source::Curve(_)) { [u[1], 0.0] } else { [u[1], v[1]] };
        Some(Self { center, radius, lengths: [u[0], v[0]], bends })
    }

    /// The CPU twin: cells along u and along v in this view.
    pub fn cells(&self, view: &LodView) -> [u32; 2] {
        let away = view.eye.distance(self.center) - self.radius;
        let pixel = view.pixel * if view.is_parallel == 1 { 1.0 } else { away.max(0.1 * self.radius) };
        [0, 1].map(|d| {
            let by_chord = (self.bends[d] / (8.0 * view.chord_px * pixel)).sqrt();
            let by_size = self.lengths[d] / (view.cell_px * pixel);
            by_chord.max(by_size).clamp(view.fewest, view.most).ceil() as u32
        })
    }
}

/// The largest length of a row of control points along `d`, and the largest second derivative.
fn measure(shape: &Shape, net: &Net, d: usize) -> [f32; 2] {
    let bezier = shape.bezier(net);
    let [order_u, order_v] = net.degrees.map(|degree| degree + 1);
    let order = [order_u, order_v][d];
    let (rows, columns) = (bezier.control.len() / bezier.columns, bezier.columns);
    let facet_columns = bezier.breaks[1].len() - 1;
    let point = |i: usize, j: usize| {
        let p = bezier.control[i * columns + j];
        p.truncate() / p.w + bezier.facets[(i / order_u) * facet_columns + j / order_v].origin
    };
    let whole = net.domain(d).length();
    let (lines, count) = if d == 0 { (columns, rows) } else { (rows, columns) };
    let at = |line: usize, k: usize| if d == 0 { point(k, line) } else { point(line, k) };
    let mut most = [0.0f32; 2];
    for line in 0..lines {
        let length: f32 = (1..count).map(|k| at(line, k - 1).distance(at(line, k))).sum();
        most[0] = most[0].max(length);
        for (facet, span) in bezier.breaks[d].windows(2).enumerate() {
            let share = ((span[1] - span[0]) / whole) as f32;
            let degree = (order - 1) as f32;
            for k in facet * order + 2..(facet + 1) * order {
                let second = at(line, k) - 2.0 * at(line, k - 1) + at(line, k - 2);
                most[1] = most[1].max(degree * (degree - 1.0) * second.length() / (share * share));
            }
        }
    }
    most
}

/// Cells along u and along v of every shape in a view, chosen on the device.
///
/// # Errors
/// What the device refuses.
pub fn lod_cells(gpu: &Gpu, shapes: &[LodShape], view: &LodView) -> Result<Vec<[u32; 2]>, GpuError> {
    let request = format!("choose levels of detail of {} shapes", shapes.len());
    let bytes = 8 * shapes.len() as u64;
    let cells = gpu.scoped(&request, || {
        let cells = gpu.reserve("cells", bytes);
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let buffers = [&gpu.upload("view", &[*view]), &gpu.upload("shapes", shapes), &cells];
        gpu.dispatch(&mut encoder, &Key::new("lod_factors", "main"), &buffers, shapes.len().div_ceil(64));
        gpu.queue().submit([encoder.finish()]);
        Ok(cells)
    })?;
    gpu.download(&request, &cells, bytes)
}
