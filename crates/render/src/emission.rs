//! From the pieces that a view needs to draw calls, on the device: pieces outside of a tile are left out there, and the rest
//! is drawn indirectly.

use trimloop_gpu::{Gpu, GpuError, shaders};

use crate::clock::Clock;
use crate::frame::{Item, Lists};
use crate::look::MOST_SECTIONS;

/// A piece at its place; as in `shaders/emit.wgsl`.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Draw {
    pub center: [f32; 3],
    pub radius: f32,
    pub item: u32,
    pub first_vertex: u32,
    pub blocks: u32,
    pub columns: u32,
    pub first_cell: u32,
    pub whole: u32,
    pub part: u32,
    pub first_strip: u32,
    pub strips: u32,
    pub kind: u32,
    pub unused: [u32; 2],
}

/// The lists that strips are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Strips {
    Borders,
    Edges,
    Lines,
}

/// Lists of faces: opaque and whole, opaque and trimmed, transparent and whole, transparent and trimmed.
pub(crate) const RANGES: usize = 4;
const STRIP_LISTS: usize = 3;
const CLEAR: u32 = 4;
/// Amounts per draw: blocks, indices of each range, blocks of strips of each list.
const AMOUNTS: usize = 1 + RANGES + STRIP_LISTS;
const INDEXED_WORDS: u64 = 5;
const PLAIN_WORDS: u64 = 4;

impl Draw {
    pub fn kind(strips: Strips, is_clear: bool) -> u32 {
        strips as u32 + if is_clear { CLEAR } else { 0 }
    }

    /// What it adds to each list, at most.
    fn amounts(&self) -> [u64; AMOUNTS] {
        let per_cell = if self.columns > 0 { 6 } else { 1 };
        let mut own = [0; AMOUNTS];
        let range = 1 + if self.kind & CLEAR > 0 { 2 } else { 0 };
        own[0] = u64::from(self.blocks);
        own[range] = u64::from(self.whole) * per_cell;
        own[range + 1] = u64::from(self.part) * per_cell;
        own[1 + RANGES + (self.kind & 3) as usize] = u64::from(self.strips);
        own
    }
}

/// A tile; as in `shaders/emit.wgsl`.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Bounds {
    /// Planes around it in the eye's coordinates, normals inwards.
    pub planes: [[f32; 4]; 5],
    pub sections: [[f32; 4]; MOST_SECTIONS],
    pub count: u32,
    pub unused: [u32; 3],
}

/// The passes, built at their first use.
#[derive(Debug, Default)]
pub(crate) struct Emitter(Option<Pipelines>);

#[derive(Debug)]
struct Pipelines {
    layout: wgpu::BindGroupLayout,
    cull: wgpu::ComputePipeline,
    sum: wgpu::ComputePipeline,
    emit: wgpu::ComputePipeline,
}

/// The pieces of a picture on the device, and room for what tiles draw of them.
#[derive(Debug)]
pub(crate) struct Emission {
    pub items: wgpu::Buffer,
    pub blocks: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub strips: wgpu::Buffer,
    draws: wgpu::Buffer,
    amounts: wgpu::Buffer,
    pub arguments: wgpu::Buffer,
    count: usize,
    totals: [u64; AMOUNTS],
}

impl Emission {
    /// # Errors
    /// More than a buffer of the device can hold.
    pub fn new(gpu: &Gpu, lists: &Lists) -> Result<Self, GpuError> {
        let mut totals = [0; AMOUNTS];
        for draw in &lists.draws {
            totals.iter_mut().zip(draw.amounts()).for_each(|(sum, own)| *sum += own);
        }
        let usage = wgpu::BufferUsages::STORAGE;
        let upload = |label: &str, bytes: &[u8], least: usize| gpu.filled(label, bytes, least, usage);
        let reserve = |label: &str, bytes: u64, extra: wgpu::BufferUsages| {
            if bytes > gpu.largest_binding() {
                let request = format!("room for the {label} of {} pieces", lists.draws.len());
                let reason = format!("{bytes} bytes, the device allows {}", gpu.largest_binding());
                return Err(GpuError::TooLarge { request, reason });
            }
            Ok(gpu.device().create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.max(16),
                usage: usage | extra,
                mapped_at_creation: false,
            }))
        };
        let none = wgpu::BufferUsages::empty();
        let [blocks, indices, strips] =
            [totals[..1].iter(), totals[1..=RANGES].iter(), totals[1 + RANGES..].iter()]
                .map(|own| own.sum::<u64>());
        let words = RANGES as u64 * INDEXED_WORDS + STRIP_LISTS as u64 * PLAIN_WORDS;
        Ok(Self {
            items: upload("items", bytemuck::cast_slice(&lists.items), size_of::<Item>()),
            draws: upload("draws", bytemuck::cast_slice(&lists.draws), size_of::<Draw>()),
            amounts: reserve("amounts", (lists.draws.len() * AMOUNTS * 4) as u64, none)?,
            arguments: reserve("arguments", words * 4, wgpu::BufferUsages::INDIRECT)?,
            blocks: reserve("blocks", blocks * 8, none)?,
            indices: reserve("indices", indices * 4, wgpu::BufferUsages::INDEX)?,
            strips: reserve("strips", strips * 8, none)?,
            count: lists.draws.len(),
            totals,
        })
    }

    /// Triangles of faces, before tiles leave any out.
    pub fn triangles(&self) -> u64 {
        self.totals[1..=RANGES].iter().sum::<u64>() / 3
    }

    /// Where a range's arguments lie; none where it is empty.
    pub fn range(&self, range: usize) -> Option<u64> {
        (self.totals[1 + range] > 0).then_some(range as u64 * INDEXED_WORDS * 4)
    }

    /// Where the arguments of a list of strips lie; none where it is empty.
    pub fn list(&self, strips: Strips) -> Option<u64> {
        let list = strips as u64;
        let at = (RANGES as u64 * INDEXED_WORDS + list * PLAIN_WORDS) * 4;
        (self.totals[1 + RANGES + list as usize] > 0).then_some(at)
    }
}

impl Emitter {
    /// Adds the passes that prepare a tile.
    pub fn encode(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        emission: &Emission,
        cells: &wgpu::Buffer,
        bounds: &Bounds,
        clock: Option<&Clock>,
    ) {
        let device = gpu.device();
        let pipelines = self.0.get_or_insert_with(|| Pipelines::new(gpu));
        let bounds = Bounds { count: emission.count as u32, ..*bounds };
        let tile = gpu.filled("tile", bytemuck::bytes_of(&bounds), 0, wgpu::BufferUsages::UNIFORM);
        let Emission { draws, amounts, arguments, blocks, indices, strips, count, .. } = emission;
        let buffers = [&tile, draws, cells, amounts, arguments, blocks, indices, strips];
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0u32..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("emit"),
            layout: &pipelines.layout,
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("emit"),
            timestamp_writes: clock.map(|clock| clock.of_compute(0)),
        });
        pass.set_bind_group(0, &group, &[]);
        let steps = [(&pipelines.cull, count.div_ceil(64)), (&pipelines.sum, 1), (&pipelines.emit, *count)];
        for (pipeline, workgroups) in steps {
            let across = workgroups.clamp(1, WIDEST);
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups(across as u32, workgroups.div_ceil(across) as u32, 1);
        }
    }
}

/// Workgroups in a row.
const WIDEST: usize = 32_768;

impl Pipelines {
    fn new(gpu: &Gpu) -> Self {
        let device = gpu.device();
        let entry = |binding: u32| {
            let ty = match binding {
                0 => wgpu::BufferBindingType::Uniform,
                _ => wgpu::BufferBindingType::Storage { read_only: binding < 3 },
            };
            wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
                count: None,
            }
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("emit"),
            entries: &std::array::from_fn::<_, 8, _>(|k| entry(k as u32)),
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("emit"),
            source: wgpu::ShaderSource::Wgsl(shaders::source("emit").unwrap_or_default().into()),
        });
        let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("emit"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = |name: &str| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&whole),
                module: &module,
                entry_point: Some(name),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let [cull, sum, emit] = ["cull", "sum", "emit"].map(pipeline);
        Self { layout, cull, sum, emit }
    }
}
