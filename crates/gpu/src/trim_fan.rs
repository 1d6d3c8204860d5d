//! Trim textures by triangle fans and odd/even blending (Krishnamurthy et al. 2009, section 7.1).

use glam::{DVec2, Vec2};
use trimloop_trim::TrimDomain;
use trimloop_trim::curves::Cubic;

use crate::device::Key;
use crate::{Gpu, GpuError, shaders};

/// A face's inside as texels of its parameter plane: texel (i, j) is set where its centre is inside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrimTexture {
    /// Texels along u.
    pub columns: u32,
    /// Texels along v.
    pub rows: u32,
    /// 255 inside, 0 outside; row-major, row 0 at the lowest v.
    pub texels: Vec<u8>,
}

/// The loops of a face, normalized to a box of its parameter plane.
#[derive(Clone, Debug)]
pub struct TrimFans(Loops);

#[derive(Clone, Debug)]
enum Loops {
    /// Corners of polygons.
    Polygons(Vec<Vec<Vec2>>),
    /// Closed chains of curves, each as so many chords.
    Curves(Vec<Vec<(Curve, u32)>>),
}

/// Control points of a cubic.
type Curve = [Vec2; 4];

/// As in `shaders/cubic_curve.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct CurveJob {
    points: Curve,
    hub: Vec2,
    first: u32,
    count: u32,
}

/// A curve is at most this many chords.
const MOST_CHORDS: f64 = 1024.0;

/// Faces that share one texture, a channel each.
pub const CHANNELS: usize = 4;

impl TrimFans {
    /// The polygons of `domain` in the box from `low` to `high`.
    pub fn new(domain: &TrimDomain, low: DVec2, high: DVec2) -> Self {
        let unit = |uv: DVec2| ((uv - low) / (high - low)).as_vec2();
        Self(Loops::Polygons(domain.loops.iter().map(|l| l.uvs().map(unit).collect()).collect()))
    }

    /// Closed chains of cubics in shares of the box, whose chords are within `off_mm` of them where the box is `lengths`
    /// millimetres long. The curves are evaluated on the device.
    pub fn of_curves(chains: &[Vec<Cubic>], lengths: DVec2, off_mm: f64) -> Self {
        let with_count = |cubic: &Cubic| {
            let [a, b, c, d] = cubic.map(|p| p * lengths);
            // A cubic's second derivative is at most 6 times its control points' second differences.
            let bend = 6.0 * (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
            let count = (bend / (8.0 * off_mm)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
            (cubic.map(|p| p.as_vec2()), count as u32)
        };
        Self(Loops::Curves(chains.iter().map(|chain| chain.iter().map(with_count).collect()).collect()))
    }

    /// Triangles of all fans, three corners each. The common point is a loop's first corner.
    fn triangles(&self) -> Vec<[Vec2; 3]> {
        match &self.0 {
            Loops::Polygons(loops) => {
                let fan = |l: &'_ Vec<Vec2>| -> Vec<[Vec2; 3]> {
                    l.windows(2).skip(1).map(|pair| [l[0], pair[0], pair[1]]).collect()
                };
                loops.iter().flat_map(fan).collect()
            }
            Loops::Curves(_) => self.curves().iter().flat_map(CurveJob::triangles).collect(),
        }
    }

    /// The curves of all loops, for the device.
    fn curves(&self) -> Vec<CurveJob> {
        let Loops::Curves(loops) = &self.0 else { return Vec::new() };
        let mut first = 0;
        let mut jobs = Vec::new();
        for chain in loops {
            let hub = chain.first().map_or(Vec2::ZERO, |(points, _)| points[0]);
            for (points, count) in chain {
                jobs.push(CurveJob { points: *points, hub, first, count: *count });
                first += count;
            }
        }
        jobs
    }

    /// The corners of all triangles on the device, and how many.
    fn corners(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> (wgpu::Buffer, u32) {
        if let Loops::Curves(_) = self.0 {
            let jobs = self.curves();
            let count = 3 * jobs.iter().map(|job| job.count).sum::<u32>();
            let buffer = gpu.reserve("trim fans", u64::from(count) * size_of::<Vec2>() as u64);
            let curves = gpu.upload("trim curves", &jobs);
            gpu.dispatch(encoder, &Key::new("cubic_curve", "main"), &[&curves, &buffer], jobs.len());
            return (buffer, count);
        }
        let corners: Vec<Vec2> = self.triangles().into_iter().flatten().collect();
        let bytes = bytemuck::cast_slice(&corners);
        let buffer = gpu.filled("trim fans", bytes, 8, wgpu::BufferUsages::VERTEX);
        (buffer, corners.len() as u32)
    }

    /// The CPU twin: every texel's centre against every triangle.
    pub fn texture(&self, columns: u32, rows: u32) -> TrimTexture {
        let mut texels = vec![0; (columns * rows) as usize];
        for triangle in self.triangles() {
            let corners = triangle.map(|p| (p * Vec2::new(columns as f32, rows as f32)).as_dvec2());
            toggle(&mut texels, columns, rows, corners);
        }
        TrimTexture { columns, rows, texels }
    }

    /// A side length that shows `texels_per_unit` along the longer of two lengths of the face, at most `most`: the size
    /// of a trim texture follows the level of detail.
    pub fn side(length: f64, texels_per_unit: f64, most: u32) -> u32 {
        let wanted = (length * texels_per_unit).ceil();
        if wanted.is_finite() { (wanted as u32).clamp(1, most.max(1)) } else { 1 }
    }
}

impl CurveJob {
    /// The CPU twin of `cubic_curve`.
    fn triangles(&self) -> Vec<[Vec2; 3]> {
        let [a, b, c, d] = self.points;
        let at = |k: u32| {
            let t = k as f32 / self.count as f32;
            let s = 1.0 - t;
            match k {
                0 => a,
                _ if k == self.count => d,
                _ => ((a * s + 3.0 * b * t) * s + 3.0 * c * t * t) * s + d * t * t * t,
            }
        };
        (0..self.count).map(|k| [self.hub, at(k), at(k + 1)]).collect()
    }
}

/// Toggles the texels whose centres lie in the triangle; a centre on a side belongs to one of its two triangles.
fn toggle(texels: &mut [u8], columns: u32, rows: u32, corners: [DVec2; 3]) {
    let lowest = corners.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let highest = corners.iter().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
    let first = (lowest - 0.5).ceil().max(0.0) as u32;
    for row in first..rows {
        let v = f64::from(row) + 0.5;
        if v >= highest {
            break;
        }
        let mut crossings: Vec<f64> = Vec::with_capacity(2);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            // Both triangles at a side see it in the same direction.
            let (a, b) = if (a.y, a.x) <= (b.y, b.x) { (a, b) } else { (b, a) };
            if (a.y > v) != (b.y > v) {
                crossings.push(a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x));
            }
        }
        if let [a, b] = crossings[..] {
            let from = (a.min(b) - 0.5).ceil().max(0.0) as u32;
            let to = (a.max(b) - 0.5).ceil().max(0.0) as u32;
            for column in from..to.min(columns) {
                texels[(row * columns + column) as usize] ^= 255;
            }
        }
    }
}

/// Draws up to [`CHANNELS`] faces into the channels of one texture.
///
/// # Errors
/// What the device refuses; more faces than channels; a size that is zero or beyond the device's limit.
pub fn trim_textures(
    gpu: &Gpu,
    faces: &[TrimFans],
    columns: u32,
    rows: u32,
) -> Result<Vec<TrimTexture>, GpuError> {
    let request = checked(gpu, faces.len(), columns, rows)?;
    let padded = (columns * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.scoped(&request, || {
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let texture = draw(gpu, &mut encoder, faces, [columns, rows]);
        let buffer = gpu.reserve_for_copies("trim texture", u64::from(padded) * u64::from(rows));
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        gpu.queue().submit([encoder.finish()]);
        Ok(buffer)
    })?;
    let bytes: Vec<u8> = gpu.download(&request, &buffer, u64::from(padded) * u64::from(rows))?;
    let channel = |channel: usize| {
        let row = |row: &[u8]| -> Vec<u8> {
            row[..columns as usize * 4].iter().skip(channel).step_by(4).copied().collect()
        };
        let texels = bytes.chunks(padded as usize).flat_map(row).collect();
        TrimTexture { columns, rows, texels }
    };
    Ok((0..faces.len()).map(channel).collect())
}

/// Draws up to [`CHANNELS`] faces and leaves them on the device: each channel's texels as bits, row-major, 32 in a word, from the
/// word `firsts[k]` of `masks` on.
///
/// # Errors
/// As [`trim_textures`]; columns that are not whole words.
pub fn trim_masks(
    gpu: &Gpu,
    faces: &[TrimFans],
    [columns, rows]: [u32; 2],
    firsts: &[u32],
    masks: &wgpu::Buffer,
) -> Result<(), GpuError> {
    let request = checked(gpu, faces.len(), columns, rows)?;
    if !columns.is_multiple_of(32) || firsts.len() != faces.len() {
        return Err(GpuError::Request(format!("{request}: {columns} columns for {} places", firsts.len())));
    }
    let mut size = [columns, rows, faces.len() as u32, 0, 0, 0, 0, 0];
    size[4..4 + firsts.len()].copy_from_slice(firsts);
    gpu.scoped(&request, || {
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        let texture = draw(gpu, &mut encoder, faces, [columns, rows]);
        let view = texture.create_view(&Default::default());
        let key = Key::new("trim_pack", "main");
        let words = (columns / 32) as usize * rows as usize;
        let size = gpu.upload("size", &size);
        gpu.pass_with_texture(&key, &[&size, masks], &view, words.div_ceil(64)).encode(&mut encoder);
        gpu.queue().submit([encoder.finish()]);
        Ok(())
    })
}

/// What is asked for, in words, where it is possible.
fn checked(gpu: &Gpu, faces: usize, columns: u32, rows: u32) -> Result<String, GpuError> {
    let request = format!("draw {faces} trim textures of {columns} x {rows}");
    let most = gpu.device().limits().max_texture_dimension_2d;
    if faces > CHANNELS {
        return Err(GpuError::Request(format!("a texture has {CHANNELS} channels, not {faces}")));
    }
    if columns == 0 || rows == 0 || columns > most || rows > most {
        let reason = format!("a texture has between 1 and {most} texels in each direction");
        return Err(GpuError::TooLarge { request, reason });
    }
    Ok(request)
}

fn draw(
    gpu: &Gpu,
    encoder: &mut wgpu::CommandEncoder,
    faces: &[TrimFans],
    [width, height]: [u32; 2],
) -> wgpu::Texture {
    let texture = gpu.device().create_texture(&wgpu::TextureDescriptor {
        label: Some("trim texture"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let corners: Vec<(wgpu::Buffer, u32)> = faces.iter().map(|face| face.corners(gpu, encoder)).collect();
    let view = texture.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("trim_fan"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    for (pipeline, (buffer, count)) in gpu.trim_pipelines(pipelines).iter().zip(&corners) {
        if *count > 0 {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(0..*count, 0..1);
        }
    }
    drop(pass);
    texture
}

/// One per channel.
fn pipelines(gpu: &Gpu) -> [wgpu::RenderPipeline; CHANNELS] {
    let module = gpu.device().create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("trim_fan"),
        source: wgpu::ShaderSource::Wgsl(shaders::source("trim_fan").unwrap_or_default().into()),
    });
    let masks =
        [wgpu::ColorWrites::RED, wgpu::ColorWrites::GREEN, wgpu::ColorWrites::BLUE, wgpu::ColorWrites::ALPHA];
    masks.map(|mask| pipeline(gpu, &module, mask))
}

fn pipeline(gpu: &Gpu, module: &wgpu::ShaderModule, mask: wgpu::ColorWrites) -> wgpu::RenderPipeline {
    let toggle = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::OneMinusDst,
        dst_factor: wgpu::BlendFactor::Zero,
        operation: wgpu::BlendOperation::Add,
    };
    // The alpha channel has no factor of its own for colours' "one minus destination".
    let toggle_alpha = wgpu::BlendComponent { src_factor: wgpu::BlendFactor::OneMinusDstAlpha, ..toggle };
    gpu.device().create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("trim_fan"),
        layout: None,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("corner"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x2],
            })],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("toggle"),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: wgpu::TextureFormat::Rgba8Unorm,
                blend: Some(wgpu::BlendState { color: toggle, alpha: toggle_alpha }),
                write_mask: mask,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_with_a_hole_covers_its_ring() {
        let square = |low: f32, high: f32| {
            vec![Vec2::splat(low), Vec2::new(high, low), Vec2::splat(high), Vec2::new(low, high)]
        };
        let fans = TrimFans(Loops::Polygons(vec![square(0.0, 1.0), square(0.25, 0.75)]));
        let texture = fans.texture(8, 8);
        let inside = texture.texels.iter().filter(|texel| **texel == 255).count();
        assert_eq!((inside, texture.texels[0], texture.texels[8 * 4 + 4]), (48, 255, 0));
    }

    #[test]
    fn sizes_follow_the_level_of_detail() {
        assert_eq!(TrimFans::side(10.0, 25.6, 1024), 256);
        assert_eq!(TrimFans::side(1e9, 25.6, 1024), 1024);
        assert_eq!(TrimFans::side(f64::NAN, 1.0, 1024), 1);
    }
}
