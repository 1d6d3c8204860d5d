//! The passes' pipelines, built at their first use.

use rustc_hash::FxHashMap;
use trimloop_gpu::{Gpu, shaders};

/// How the cells of faces are trimmed; as in `shaders/surface.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Trim {
    /// Not at all.
    None,
    /// By curves.
    Curves,
    /// By masks.
    Masks,
}

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Pass {
    /// Faces, opaque.
    Surface(Trim),
    /// Faces, transparent.
    Veil(Trim),
    /// What each pixel shows.
    Identify(Trim),
    /// Strips along boundaries.
    Border,
    /// What the strips show.
    IdentifyBorder,
    /// Edges that are seen.
    Edge,
    /// Edges behind faces.
    HiddenEdge,
    /// Free curves.
    Line,
}

pub(crate) const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
pub(crate) const THROUGH: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
pub(crate) const IDS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
pub(crate) const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The pipelines, and the layouts of what they read.
#[derive(Debug)]
pub(crate) struct Passes {
    pipelines: FxHashMap<(Pass, u32), wgpu::RenderPipeline>,
    compose: Option<wgpu::RenderPipeline>,
    /// Group 0: the trim tables.
    pub trims: wgpu::BindGroupLayout,
    /// Group 1: the view, the items, the blocks, the vertices.
    pub frame: wgpu::BindGroupLayout,
    layout: wgpu::PipelineLayout,
}

impl Passes {
    pub fn new(gpu: &Gpu) -> Self {
        let device = gpu.device();
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let entry = |binding: u32, visibility, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        };
        let storage = wgpu::BufferBindingType::Storage { read_only: true };
        let trims = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("trims"),
            entries: &[0, 1, 2, 3, 4, 5].map(|k| entry(k, wgpu::ShaderStages::FRAGMENT, storage)),
        });
        let frame = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[
                entry(0, both, wgpu::BufferBindingType::Uniform),
                entry(1, both, storage),
                entry(2, wgpu::ShaderStages::VERTEX, storage),
                entry(3, wgpu::ShaderStages::VERTEX, storage),
            ],
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("passes"),
            bind_group_layouts: &[Some(&trims), Some(&frame)],
            immediate_size: 0,
        });
        Self { pipelines: FxHashMap::default(), compose: None, trims, frame, layout }
    }

    /// The pipeline of a pass into targets with `samples` samples.
    pub fn get(&mut self, gpu: &Gpu, pass: Pass, samples: u32) -> wgpu::RenderPipeline {
        let layout = &self.layout;
        self.pipelines.entry((pass, samples)).or_insert_with(|| build(gpu, layout, pass, samples)).clone()
    }

    /// The pipeline that makes the picture.
    pub fn compose(&mut self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let device = gpu.device();
        let build = || {
            let module = module(gpu, "compose");
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("compose"),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("paint"),
                    compilation_options: Default::default(),
                    targets: &[Some(PICTURE.into())],
                }),
                primitive: Default::default(),
                depth_stencil: None,
                multisample: Default::default(),
                multiview_mask: None,
                cache: None,
            })
        };
        self.compose.get_or_insert_with(build).clone()
    }
}

fn module(gpu: &Gpu, name: &str) -> wgpu::ShaderModule {
    gpu.device().create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(shaders::source(name).unwrap_or_default().into()),
    })
}

fn build(gpu: &Gpu, layout: &wgpu::PipelineLayout, pass: Pass, samples: u32) -> wgpu::RenderPipeline {
    let (shader, entry) = match pass {
        Pass::Surface(_) => ("surface", "paint"),
        Pass::Veil(_) => ("surface", "veil"),
        Pass::Identify(_) => ("surface", "identify"),
        Pass::Border => ("border", "paint"),
        Pass::IdentifyBorder => ("border", "identify"),
        Pass::Edge | Pass::HiddenEdge | Pass::Line => ("edge", "paint"),
    };
    let module = module(gpu, shader);
    let constants: Vec<(&str, f64)> = match pass {
        Pass::Surface(trim) | Pass::Veil(trim) | Pass::Identify(trim) => {
            vec![("TRIM", f64::from(trim as u8)), ("SAMPLES", f64::from(samples))]
        }
        Pass::Border | Pass::IdentifyBorder => Vec::new(),
        Pass::Edge => vec![("IS_EDGE", 1.0), ("PERCENT", 100.0)],
        Pass::HiddenEdge => vec![("IS_EDGE", 1.0), ("PERCENT", 22.0)],
        Pass::Line => vec![("IS_EDGE", 0.0), ("PERCENT", 100.0)],
    };
    let options =
        wgpu::PipelineCompilationOptions { constants: &constants, zero_initialize_workgroup_memory: false };
    let target =
        |format, blend| Some(wgpu::ColorTargetState { format, blend, write_mask: Default::default() });
    let premultiplied = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;
    let add = component(wgpu::BlendFactor::One, wgpu::BlendFactor::One);
    let thin = component(wgpu::BlendFactor::Zero, wgpu::BlendFactor::OneMinusSrc);
    let targets = match pass {
        Pass::Surface(_) | Pass::Border => vec![target(COLOR, None)],
        Pass::Veil(_) => vec![
            target(COLOR, Some(wgpu::BlendState { color: add, alpha: add })),
            target(THROUGH, Some(wgpu::BlendState { color: thin, alpha: thin })),
        ],
        Pass::Identify(_) | Pass::IdentifyBorder => vec![target(IDS, None)],
        Pass::Edge | Pass::HiddenEdge | Pass::Line => vec![target(COLOR, Some(premultiplied))],
    };
    let is_solid = matches!(pass, Pass::Surface(_) | Pass::Border | Pass::Identify(_) | Pass::IdentifyBorder);
    let compare = match pass {
        Pass::HiddenEdge => wgpu::CompareFunction::Less,
        Pass::Border | Pass::IdentifyBorder => wgpu::CompareFunction::Greater,
        _ => wgpu::CompareFunction::GreaterEqual,
    };
    gpu.device().create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(shader),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                zero_initialize_workgroup_memory: false,
            },
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(entry),
            compilation_options: options,
            targets: &targets,
        }),
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(is_solid),
            depth_compare: Some(compare),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        multiview_mask: None,
        cache: None,
    })
}

fn component(src_factor: wgpu::BlendFactor, dst_factor: wgpu::BlendFactor) -> wgpu::BlendComponent {
    wgpu::BlendComponent { src_factor, dst_factor, operation: wgpu::BlendOperation::Add }
}
