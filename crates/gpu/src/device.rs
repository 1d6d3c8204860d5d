//! The graphics device, without a window.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::trim_fan::CHANNELS;
use crate::{GpuError, shaders};

/// An open graphics device; cloning shares it.
///
/// Everything runs within the limits that WebGPU guarantees in every browser; buffers may be larger where the device allows.
#[derive(Clone, Debug)]
pub struct Gpu(Arc<Inner>);

#[derive(Debug)]
struct Inner {
    device: wgpu::Device,
    queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    lost: Arc<Mutex<Option<String>>>,
    pipelines: Mutex<HashMap<Key, Arc<wgpu::ComputePipeline>>>,
    trim_pipelines: OnceLock<[wgpu::RenderPipeline; CHANNELS]>,
}

/// Larger buffers are not asked for.
const LARGEST_BUFFER: u64 = 1 << 30;

/// A pass: the shader's name, its entry point and the values of its constants.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Key {
    pub shader: &'static str,
    pub entry: &'static str,
    /// Constants that pipelines override, by name.
    pub constants: Vec<(&'static str, u32)>,
    /// Constants that stand in the source text, by name (sizes of arrays cannot be overridden).
    pub literals: Vec<(&'static str, u32)>,
}

impl Key {
    pub fn new(shader: &'static str, entry: &'static str) -> Self {
        Self { shader, entry, constants: Vec::new(), literals: Vec::new() }
    }

    pub fn with(mut self, name: &'static str, value: u32) -> Self {
        self.constants.push((name, value));
        self
    }

    pub fn with_literal(mut self, name: &'static str, value: u32) -> Self {
        self.literals.push((name, value));
        self
    }
}

impl Gpu {
    /// Opens a real GPU, else a software renderer. `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` choose another one.
    ///
    /// # Errors
    /// Where there is none; the text says what to install.
    pub fn headless() -> Result<Self, GpuError> {
        pollster::block_on(Self::open())
    }

    /// As [`Gpu::headless`], for callers that must not block.
    ///
    /// # Errors
    /// Where there is none; the text says what to install.
    pub async fn open() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pick(&instance).await?;
        let info = adapter.get_info();
        let descriptor = Self::descriptor(&adapter);
        let no_device = |error: wgpu::RequestDeviceError| GpuError::NoDevice {
            adapter: info.name.clone(),
            reason: error.to_string(),
        };
        let (device, queue) = adapter.request_device(&descriptor).await.map_err(no_device)?;
        Ok(Self::of(device, queue, info))
    }

    /// What a device is asked for: the limits that every browser guarantees, room for large scenes and clocks on passes where
    /// the adapter has them.
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        let (least, own) = (wgpu::Limits::default(), adapter.limits());
        let required_limits = wgpu::Limits {
            max_storage_buffer_binding_size: own
                .max_storage_buffer_binding_size
                .clamp(least.max_storage_buffer_binding_size, LARGEST_BUFFER),
            max_buffer_size: own.max_buffer_size.clamp(least.max_buffer_size, LARGEST_BUFFER),
            ..least
        };
        let required_features = adapter.features() & wgpu::Features::TIMESTAMP_QUERY;
        wgpu::DeviceDescriptor {
            label: Some("trimloop"),
            required_limits,
            required_features,
            ..Default::default()
        }
    }

    /// A device that somebody else opened, for instance for a window, with the limits that WebGPU guarantees.
    pub fn of(device: wgpu::Device, queue: wgpu::Queue, info: wgpu::AdapterInfo) -> Self {
        let lost = Arc::new(Mutex::new(None));
        let told = lost.clone();
        device.set_device_lost_callback(move |reason, text| {
            let text = if text.is_empty() { format!("{reason:?}") } else { text };
            *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(text);
        });
        // What no scope catches is found by the next one; a panic is the default.
        device.on_uncaptured_error(Arc::new(|_| {}));
        let (pipelines, trim_pipelines) = Default::default();
        Self(Arc::new(Inner { device, queue, info, lost, pipelines, trim_pipelines }))
    }

    /// The adapter's name.
    pub fn name(&self) -> &str {
        &self.0.info.name
    }

    /// Whether the adapter is a program on the CPU.
    pub fn is_software(&self) -> bool {
        self.0.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The device, for passes of other crates.
    pub fn device(&self) -> &wgpu::Device {
        &self.0.device
    }

    /// The queue, for passes of other crates.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.0.queue
    }

    /// The largest buffer that a shader can be given, bytes.
    pub fn largest_binding(&self) -> u64 {
        self.0.device.limits().max_storage_buffer_binding_size
    }

    /// Does `work`, and turns what the device finds wrong with it into an error that names `request`.
    ///
    /// # Errors
    /// Out of memory, a lost device, or a refusal.
    pub fn scoped<T>(
        &self,
        request: &str,
        work: impl FnOnce() -> Result<T, GpuError>,
    ) -> Result<T, GpuError> {
        let device = &self.0.device;
        let scopes =
            [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal, wgpu::ErrorFilter::OutOfMemory]
                .map(|filter| device.push_error_scope(filter));
        let done = work();
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        let first = errors.reduce(|first, _| first);
        let request = || request.to_owned();
        if first.is_some() || done.is_err() {
            // The loss of the device may be what is behind it, and is told late.
            let _ = device.poll(wgpu::PollType::Poll);
        }
        let lost = self.0.lost.lock().unwrap_or_else(PoisonError::into_inner).clone();
        match (lost, first) {
            (Some(reason), _) => Err(GpuError::Lost { request: request(), reason }),
            (None, Some(wgpu::Error::OutOfMemory { .. })) => {
                Err(GpuError::OutOfMemory { request: request() })
            }
            (None, Some(error)) => Err(GpuError::Refused { request: request(), reason: error.to_string() }),
            (None, None) => done,
        }
    }

    /// Blocks until the device has done all that was submitted.
    ///
    /// # Errors
    /// Where the device is lost meanwhile.
    pub fn wait(&self, request: &str) -> Result<(), GpuError> {
        match self.0.device.poll(wgpu::PollType::wait_indefinitely()) {
            Ok(_) => Ok(()),
            Err(error) => Err(GpuError::Lost { request: request.to_owned(), reason: error.to_string() }),
        }
    }

    /// A buffer for shaders, with its content.
    pub(crate) fn upload<T: bytemuck::Pod>(&self, label: &str, content: &[T]) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        self.filled(label, bytemuck::cast_slice(content), 16, usage)
    }

    /// A buffer with its content, of `least` bytes at least, since nothing cannot be bound. On a lost device it stays empty,
    /// and the scope around it finds the error.
    pub fn filled(
        &self,
        label: &str,
        content: &[u8],
        least: usize,
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        let buffer = self.0.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: content.len().max(least).next_multiple_of(4) as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        if !content.is_empty() && !self.is_lost() {
            self.0.queue.write_buffer(&buffer, 0, content);
        }
        buffer
    }

    /// Whether the device is gone: nothing will be drawn any more.
    pub fn is_lost(&self) -> bool {
        self.0.lost.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }

    /// A buffer for shaders and vertices, without content.
    pub(crate) fn reserve(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        self.0.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes.max(16).next_multiple_of(16),
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        })
    }

    /// A buffer for shaders that is copied from and into.
    pub(crate) fn reserve_on_device(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        let copies = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        self.0.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes.max(16).next_multiple_of(16),
            usage: wgpu::BufferUsages::STORAGE | copies,
            mapped_at_creation: false,
        })
    }

    /// A buffer that textures are copied into.
    pub fn reserve_for_copies(&self, label: &str, bytes: u64) -> wgpu::Buffer {
        self.0.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// The content of a buffer, as soon as what was submitted is done.
    ///
    /// # Errors
    /// What the device refuses; the text names `request`.
    pub fn download<T: bytemuck::Pod>(
        &self,
        request: &str,
        buffer: &wgpu::Buffer,
        bytes: u64,
    ) -> Result<Vec<T>, GpuError> {
        if bytes == 0 {
            return Ok(Vec::new());
        }
        self.scoped(request, || {
            let staging = self.0.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("read back"),
                size: bytes,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let mut encoder = self.0.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, bytes);
            self.0.queue.submit([encoder.finish()]);
            let refused = |reason: String| GpuError::Refused { request: request.to_owned(), reason };
            let (sender, receiver) = std::sync::mpsc::channel();
            staging.slice(..).map_async(wgpu::MapMode::Read, move |mapped| {
                let _ = sender.send(mapped);
            });
            self.wait(request)?;
            match receiver.recv() {
                Ok(Ok(())) => {}
                Ok(Err(error)) => return Err(refused(error.to_string())),
                Err(error) => return Err(refused(error.to_string())),
            }
            let view = staging.get_mapped_range(..).map_err(|error| refused(error.to_string()))?;
            Ok(bytemuck::pod_collect_to_vec(&view))
        })
    }

    /// The pipeline of a pass, built at its first use.
    pub(crate) fn pipeline(&self, key: &Key) -> Arc<wgpu::ComputePipeline> {
        let mut pipelines = self.0.pipelines.lock().unwrap_or_else(PoisonError::into_inner);
        pipelines.entry(key.clone()).or_insert_with(|| Arc::new(self.build(key))).clone()
    }

    fn build(&self, key: &Key) -> wgpu::ComputePipeline {
        let mut source = shaders::source(key.shader).unwrap_or_default();
        for (name, value) in &key.literals {
            source = with_literal(&source, name, *value);
        }
        let module = self.0.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(key.shader),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let constants: Vec<(&str, f64)> = key.constants.iter().map(|&(n, v)| (n, f64::from(v))).collect();
        self.0.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(key.shader),
            layout: None,
            module: &module,
            entry_point: Some(key.entry),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                zero_initialize_workgroup_memory: false,
            },
            cache: None,
        })
    }

    /// A pass over `workgroups`; `buffers` are bindings 0, 1, ... of group 0.
    pub(crate) fn pass(&self, key: &Key, buffers: &[&wgpu::Buffer], workgroups: usize) -> Pass {
        self.bound(key, buffers, None, workgroups)
    }

    fn bound(
        &self,
        key: &Key,
        buffers: &[&wgpu::Buffer],
        last: Option<wgpu::BindGroupEntry<'_>>,
        workgroups: usize,
    ) -> Pass {
        let pipeline = self.pipeline(key);
        let entries: Vec<wgpu::BindGroupEntry<'_>> = buffers
            .iter()
            .enumerate()
            .map(|(k, b)| wgpu::BindGroupEntry { binding: k as u32, resource: b.as_entire_binding() })
            .chain(last)
            .collect();
        let group = self.0.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(key.shader),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Pass { pipeline, group, workgroups }
    }

    /// As [`Gpu::pass`], with a texture as the binding after the last buffer.
    pub(crate) fn pass_with_texture(
        &self,
        key: &Key,
        buffers: &[&wgpu::Buffer],
        texture: &wgpu::TextureView,
        workgroups: usize,
    ) -> Pass {
        let last = wgpu::BindGroupEntry {
            binding: buffers.len() as u32,
            resource: wgpu::BindingResource::TextureView(texture),
        };
        self.bound(key, buffers, Some(last), workgroups)
    }

    /// The pipelines that draw trim textures, built at their first use.
    pub(crate) fn trim_pipelines(
        &self,
        build: impl FnOnce(&Self) -> [wgpu::RenderPipeline; CHANNELS],
    ) -> &[wgpu::RenderPipeline; CHANNELS] {
        self.0.trim_pipelines.get_or_init(|| build(self))
    }

    /// Adds a pass that runs once to `encoder`; as [`Gpu::pass`].
    pub(crate) fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        key: &Key,
        buffers: &[&wgpu::Buffer],
        workgroups: usize,
    ) {
        self.pass(key, buffers, workgroups).encode(encoder);
    }
}

/// A pass with everything it reads and writes; it can run again and again.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pipeline: Arc<wgpu::ComputePipeline>,
    group: wgpu::BindGroup,
    workgroups: usize,
}

impl Pass {
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        if self.workgroups == 0 {
            return;
        }
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        // Rows of workgroups, since one row is limited; shaders leave out what is too many.
        let across = self.workgroups.min(WIDEST);
        pass.dispatch_workgroups(across as u32, self.workgroups.div_ceil(across) as u32, 1);
    }
}

const WIDEST: usize = 32_768;

/// The source with `const NAME = …u;` set to `value`.
fn with_literal(source: &str, name: &str, value: u32) -> String {
    let start = format!("const {name} = ");
    match source.split_once(&start) {
        Some((before, after)) => {
            let rest = after.split_once(';').map_or("", |(_, rest)| rest);
            format!("{before}{start}{value}u;{rest}")
        }
        None => source.to_owned(),
    }
}

/// A discrete GPU before an integrated one, any of them before a program on the CPU.
async fn pick(instance: &wgpu::Instance) -> Result<wgpu::Adapter, GpuError> {
    let wanted = std::env::var("WGPU_ADAPTER_NAME").ok().map(|name| name.to_lowercase());
    // OpenGL lacks what the shaders need.
    let backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::all()) & wgpu::Backends::PRIMARY;
    let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    let usable = |adapter: &wgpu::Adapter| {
        let name = adapter.get_info().name.to_lowercase();
        wgpu::Limits::default().check_limits(&adapter.limits())
            && wanted.as_ref().is_none_or(|wanted| name.contains(wanted))
    };
    let found = instance.enumerate_adapters(backends).await;
    let seen: Vec<String> = found.iter().map(|adapter| adapter.get_info().name).collect();
    let best = found.into_iter().filter(usable).min_by_key(rank);
    best.ok_or_else(|| {
        GpuError::NoAdapter(if seen.is_empty() {
            "there is no driver".to_owned()
        } else {
            format!("none of {} will do", seen.join(", "))
        })
    })
}
