//! The textures that a tile is drawn into.

use trimloop_gpu::Gpu;

use crate::passes::{COLOR, DEPTH, IDS, PICTURE, THROUGH};

/// The textures of a tile's passes.
#[derive(Debug)]
pub(crate) struct Targets {
    pub size: [u32; 2],
    pub samples: u32,
    /// What is drawn into, with all its samples, and what it is resolved to.
    pub color: Target,
    pub sums: Target,
    pub through: Target,
    pub depth: wgpu::TextureView,
    pub picture: wgpu::Texture,
}

/// A texture with samples and the one that it is resolved to, if it has several.
#[derive(Debug)]
pub(crate) struct Target {
    pub view: wgpu::TextureView,
    pub resolved: Option<wgpu::TextureView>,
}

impl Target {
    fn new(gpu: &Gpu, label: &str, size: [u32; 2], samples: u32, format: wgpu::TextureFormat) -> Self {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let view = |samples| view_of(&texture(gpu, label, size, samples, format, usage));
        let resolved = (samples > 1).then(|| view(1));
        Self { view: view(samples), resolved }
    }

    /// What later passes read.
    pub fn read(&self) -> &wgpu::TextureView {
        self.resolved.as_ref().unwrap_or(&self.view)
    }

    /// To be drawn into, on `clear`.
    pub fn attachment(&self, clear: [f64; 4]) -> Option<wgpu::RenderPassColorAttachment<'_>> {
        attachment(&self.view, self.resolved.as_ref(), clear)
    }
}

/// A texture to be drawn into, on `clear`, and the one that it is resolved to.
pub(crate) fn attachment<'v>(
    view: &'v wgpu::TextureView,
    resolve_target: Option<&'v wgpu::TextureView>,
    [r, g, b, a]: [f64; 4],
) -> Option<wgpu::RenderPassColorAttachment<'v>> {
    let load = wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a });
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target, ops })
}

impl Targets {
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let readable = attachment | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            size,
            samples,
            color: Target::new(gpu, "color", size, samples, COLOR),
            sums: Target::new(gpu, "sums", size, samples, COLOR),
            through: Target::new(gpu, "through", size, samples, THROUGH),
            depth: view_of(&texture(gpu, "depth", size, samples, DEPTH, attachment)),
            picture: texture(gpu, "picture", size, 1, PICTURE, readable),
        }
    }
}

/// The textures of the pass that identifies pixels.
#[derive(Debug)]
pub(crate) struct IdTargets {
    pub ids: wgpu::Texture,
    pub depth: wgpu::TextureView,
}

impl IdTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Self {
            ids: texture(gpu, "ids", size, 1, IDS, attachment | wgpu::TextureUsages::COPY_SRC),
            depth: view_of(&texture(gpu, "depth", size, 1, DEPTH, attachment)),
        }
    }
}

/// Depth is reversed: nothing is nearer than 0.
pub(crate) fn depth_attachment(
    view: &wgpu::TextureView,
    is_first: bool,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    let load = if is_first { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

pub(crate) fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&Default::default())
}

fn texture(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device().create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
