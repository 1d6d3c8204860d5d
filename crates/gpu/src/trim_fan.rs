//! Trim textures by triangle fans and odd/even blending (Krishnamurthy et al. 2009, section 7.1).

use glam::{DVec2, Vec2};
use trimloop_trim::TrimDomain;
use wgpu::util::DeviceExt;

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
pub struct TrimFans {
    loops: Vec<Vec<Vec2>>,
}

/// Faces that share one texture, a channel each.
pub const CHANNELS: usize = 4;

impl TrimFans {
    /// The polygons of `domain` in the box from `low` to `high`.
    pub fn new(domain: &TrimDomain, low: DVec2, high: DVec2) -> Self {
        let unit = |uv: DVec2| ((uv - low) / (high - low)).as_vec2();
        Self { loops: domain.loops.iter().map(|l| l.uvs().map(unit).collect()).collect() }
    }

    /// Triangles of all fans, three corners each. The common point is a loop's first corner.
    fn triangles(&self) -> impl Iterator<Item = [Vec2; 3]> + '_ {
        self.loops.iter().flat_map(|l| l.windows(2).skip(1).map(move |pair| [l[0], pair[0], pair[1]]))
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
    let request = format!("draw {} trim textures of {columns} x {rows}", faces.len());
    let most = gpu.device().limits().max_texture_dimension_2d;
    if faces.len() > CHANNELS {
        return Err(GpuError::Request(format!("a texture has {CHANNELS} channels, not {}", faces.len())));
    }
    if columns == 0 || rows == 0 || columns > most || rows > most {
        let reason = format!("a texture has between 1 and {most} texels in each direction");
        return Err(GpuError::TooLarge { request, reason });
    }
    let padded = (columns * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.scoped(&request, || {
        let texture = gpu.device().create_texture(&wgpu::TextureDescriptor {
            label: Some("trim texture"),
            size: wgpu::Extent3d { width: columns, height: rows, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        draw(gpu, &mut encoder, faces, &texture);
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

fn draw(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, faces: &[TrimFans], texture: &wgpu::Texture) {
    let source = shaders::source("trim_fan").unwrap_or_default();
    let module = gpu.device().create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("trim_fan"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let view = texture.create_view(&Default::default());
    let masks =
        [wgpu::ColorWrites::RED, wgpu::ColorWrites::GREEN, wgpu::ColorWrites::BLUE, wgpu::ColorWrites::ALPHA];
    let pipelines: Vec<wgpu::RenderPipeline> =
        masks[..faces.len()].iter().map(|&mask| pipeline(gpu, &module, mask)).collect();
    let corners: Vec<(wgpu::Buffer, u32)> = faces
        .iter()
        .map(|face| {
            let corners: Vec<Vec2> = face.triangles().flatten().collect();
            let bytes = bytemuck::cast_slice(&corners);
            let buffer = gpu.device().create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("trim fans"),
                contents: if bytes.is_empty() { &[0; 8] } else { bytes },
                usage: wgpu::BufferUsages::VERTEX,
            });
            (buffer, corners.len() as u32)
        })
        .collect();
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
    for (pipeline, (buffer, count)) in pipelines.iter().zip(&corners) {
        pass.set_pipeline(pipeline);
        pass.set_vertex_buffer(0, buffer.slice(..));
        pass.draw(0..*count, 0..1);
    }
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
        let fans = TrimFans { loops: vec![square(0.0, 1.0), square(0.25, 0.75)] };
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
