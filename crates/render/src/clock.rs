//! How long the device takes for the passes of a picture.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use trimloop_gpu::Gpu;

/// Passes whose time is taken, in their order.
pub(crate) const TIMED: [&str; 4] = ["emit", "solid", "transparent", "compose"];
const BYTES: u64 = 2 * TIMED.len() as u64 * wgpu::QUERY_SIZE as u64;

/// Time stamps before and after each pass.
#[derive(Debug)]
pub(crate) struct Clock {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read: wgpu::Buffer,
    pending: Option<Receiver<bool>>,
    /// Milliseconds of each of [`TIMED`].
    pub last_ms: [f64; TIMED.len()],
}

impl Clock {
    /// A clock, where the device has one.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        let device = gpu.device();
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        let set = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("clock"),
            ty: wgpu::QueryType::Timestamp,
            count: 2 * TIMED.len() as u32,
        });
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let read = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        Some(Self {
            set,
            resolved: buffer("clock", usage),
            read: buffer("clock, read", read),
            pending: None,
            last_ms: [0.0; TIMED.len()],
        })
    }

    /// Whether it can take times now: those of an earlier picture may be on their way.
    pub fn is_free(&self) -> bool {
        self.pending.is_none()
    }

    /// What a render pass is to note.
    pub fn of_render(&self, pass: usize) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: Some(2 * pass as u32),
            end_of_pass_write_index: Some(2 * pass as u32 + 1),
        }
    }

    /// What a compute pass is to note.
    pub fn of_compute(&self, pass: usize) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: Some(2 * pass as u32),
            end_of_pass_write_index: Some(2 * pass as u32 + 1),
        }
    }

    /// After all passes: brings the times to where they can be read.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.set, 0..2 * TIMED.len() as u32, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.read, 0, BYTES);
    }

    /// After the work has been submitted: asks for the times.
    pub fn ask(&mut self) {
        let (sender, pending) = channel();
        // Nobody listens where the picture is not wanted any more.
        self.read.map_async(wgpu::MapMode::Read, .., move |result| _ = sender.send(result.is_ok()));
        self.pending = Some(pending);
    }

    /// Takes over the times that have come.
    pub fn collect(&mut self, gpu: &Gpu) {
        let Some(pending) = &self.pending else { return };
        // Whether that failed shows in what comes.
        let _ = gpu.device().poll(wgpu::PollType::Poll);
        match pending.try_recv() {
            Err(TryRecvError::Empty) => return,
            Ok(true) => {
                if let Ok(bytes) = self.read.get_mapped_range(..) {
                    let ticks: Vec<u64> = bytes
                        .chunks_exact(8)
                        .map(|b| u64::from_ne_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]))
                        .collect();
                    let period_ms = f64::from(gpu.queue().get_timestamp_period()) * 1e-6;
                    for (to, pair) in self.last_ms.iter_mut().zip(ticks.chunks_exact(2)) {
                        *to = pair[1].saturating_sub(pair[0]) as f64 * period_ms;
                    }
                }
                self.read.unmap();
            }
            _ => {}
        }
        self.pending = None;
    }
}
