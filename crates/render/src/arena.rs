//! Buffers that grow, and whose room is given out piece by piece.

use std::collections::BTreeMap;
use std::marker::PhantomData;

use trimloop_gpu::{Gpu, GpuError};

/// A buffer of `T`s on the device.
#[derive(Debug)]
pub(crate) struct Arena<T> {
    label: &'static str,
    buffer: wgpu::Buffer,
    usage: wgpu::BufferUsages,
    /// Elements.
    capacity: usize,
    /// Elements that were ever given out.
    end: usize,
    /// Elements that are given out now.
    used: usize,
    /// Length of each free gap by its start.
    gaps: BTreeMap<usize, usize>,
    holds: PhantomData<T>,
}

const FEWEST: usize = 1024;

/// What was given out at some time.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    end: usize,
    used: usize,
    gaps: BTreeMap<usize, usize>,
}

impl<T: bytemuck::Pod> Arena<T> {
    pub fn new(gpu: &Gpu, label: &'static str, usage: wgpu::BufferUsages) -> Self {
        let usage =
            usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let buffer = Self::create(gpu, label, usage, FEWEST);
        Self {
            label,
            buffer,
            usage,
            capacity: FEWEST,
            end: 0,
            used: 0,
            gaps: BTreeMap::new(),
            holds: PhantomData,
        }
    }

    fn create(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages, elements: usize) -> wgpu::Buffer {
        gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: (elements * size_of::<T>()).next_multiple_of(16) as u64,
            usage,
            mapped_at_creation: false,
        })
    }

    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Room for `count` elements: the first one's index.
    ///
    /// # Errors
    /// Where the device has no larger buffers.
    pub fn take(&mut self, gpu: &Gpu, count: usize) -> Result<usize, GpuError> {
        if count == 0 {
            return Ok(0);
        }
        let fitting = self.gaps.iter().find(|(_, length)| **length >= count).map(|(s, l)| (*s, *l));
        if let Some((start, length)) = fitting {
            self.gaps.remove(&start);
            if length > count {
                self.gaps.insert(start + count, length - count);
            }
            self.used += count;
            return Ok(start);
        }
        let start = self.end;
        self.grow(gpu, start + count)?;
        self.end = start + count;
        self.used += count;
        Ok(start)
    }

    /// What is given out now.
    pub fn mark(&self) -> Mark {
        Mark { end: self.end, used: self.used, gaps: self.gaps.clone() }
    }

    /// Takes back what was given out since.
    pub fn restore(&mut self, Mark { end, used, gaps }: Mark) {
        (self.end, self.used, self.gaps) = (end, used, gaps);
    }

    /// Gives room back.
    pub fn give_back(&mut self, start: usize, count: usize) {
        if count == 0 {
            return;
        }
        self.used -= count.min(self.used);
        let mut gap = (start, count);
        if let Some((&before, &length)) = self.gaps.range(..start).next_back()
            && before + length == start
        {
            self.gaps.remove(&before);
            gap = (before, length + count);
        }
        if let Some(after) = self.gaps.remove(&(start + count)) {
            gap.1 += after;
        }
        if gap.0 + gap.1 == self.end { self.end = gap.0 } else { _ = self.gaps.insert(gap.0, gap.1) }
    }

    /// Bytes of the buffer.
    pub fn bytes(&self) -> u64 {
        self.buffer.size()
    }

    /// Bytes of what is given out.
    pub fn used_bytes(&self) -> u64 {
        (self.used * size_of::<T>()) as u64
    }

    pub fn write(&self, gpu: &Gpu, start: usize, content: &[T]) {
        if !content.is_empty() {
            let offset = (start * size_of::<T>()) as u64;
            gpu.queue().write_buffer(&self.buffer, offset, bytemuck::cast_slice(content));
        }
    }

    /// Takes room for `content` and writes it there.
    pub fn add(&mut self, gpu: &Gpu, content: &[T]) -> Result<usize, GpuError> {
        let start = self.take(gpu, content.len())?;
        self.write(gpu, start, content);
        Ok(start)
    }

    fn grow(&mut self, gpu: &Gpu, needed: usize) -> Result<(), GpuError> {
        if needed <= self.capacity {
            return Ok(());
        }
        let most = gpu.largest_binding() as usize / size_of::<T>();
        if needed > most {
            let request = format!("room for {needed} {}", self.label);
            return Err(GpuError::OutOfMemory { request });
        }
        let capacity = needed.next_power_of_two().min(most);
        let larger = Self::create(gpu, self.label, self.usage, capacity);
        let mut encoder = gpu.device().create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&self.buffer, 0, &larger, 0, self.buffer.size());
        gpu.queue().submit([encoder.finish()]);
        self.buffer = larger;
        self.capacity = capacity;
        Ok(())
    }
}
