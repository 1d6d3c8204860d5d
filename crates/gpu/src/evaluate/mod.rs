//! Evaluation of many curves and surfaces at once.

mod bezier;
pub(crate) mod cpu;
mod krishnamurthy;
mod product;
mod tan;

use glam::Vec4;

use crate::batch::{Batch, Piece, batches};
use crate::device::Pass;
use crate::request::Data;
use crate::{Backend, Gpu, GpuError, Quantities, Request, Values};

/// Evaluates batches with one of the backends.
#[derive(Clone, Debug)]
pub struct Evaluator {
    backend: Backend,
    gpu: Option<Gpu>,
}

/// Requests whose tables lie on the device, with room for the results: evaluated as often as wished, nothing is sent.
#[derive(Debug)]
pub struct Prepared {
    gpu: Gpu,
    passes: Vec<Pass>,
    values: DeviceValues,
}

/// Results that stay on the device: one buffer per batch.
#[derive(Debug)]
pub struct DeviceValues {
    quantities: Quantities,
    batches: Vec<DeviceBatch>,
}

/// A buffer of results, [`Quantities::stride`] vectors of four `f32` per point, relative to the shapes' origins.
#[derive(Debug)]
pub struct DeviceBatch {
    /// The vectors; usable as vertices.
    pub buffer: wgpu::Buffer,
    /// The request, its first row (or point of its list), and its first point in the buffer.
    pub pieces: Vec<DevicePiece>,
}

/// A part of a request in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DevicePiece {
    /// Index of the request.
    pub request: usize,
    /// Its first row of the grid, or point of the list.
    pub first: usize,
    /// Its first point in the buffer.
    pub offset: usize,
    /// Number of points.
    pub points: usize,
}

impl Prepared {
    /// Adds the evaluation to `encoder`.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        self.passes.iter().for_each(|pass| pass.encode(encoder));
    }

    /// Starts the evaluation; it may not be done yet when this returns.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn run(&self) -> Result<(), GpuError> {
        self.gpu.scoped("evaluate what is prepared", || {
            let mut encoder = self.gpu.device().create_command_encoder(&Default::default());
            self.encode(&mut encoder);
            self.gpu.queue().submit([encoder.finish()]);
            Ok(())
        })
    }

    /// Where the results are, as soon as the evaluation has run.
    pub fn values(&self) -> &DeviceValues {
        &self.values
    }

    /// The same, without what evaluated them.
    pub fn into_values(self) -> DeviceValues {
        self.values
    }
}

impl DeviceValues {
    /// The buffers.
    pub fn batches(&self) -> &[DeviceBatch] {
        &self.batches
    }

    /// What was computed.
    pub fn quantities(&self) -> Quantities {
        self.quantities
    }
}

impl Evaluator {
    /// An evaluator on `gpu` ([`Backend::Cpu`] needs none).
    pub fn on_gpu(gpu: &Gpu, backend: Backend) -> Self {
        Self { backend, gpu: Some(gpu.clone()) }
    }

    /// The evaluator that needs no device: [`Backend::Cpu`].
    pub fn on_cpu() -> Self {
        Self::twin(Backend::Cpu)
    }

    /// The passes of `backend` as they stand in the shaders, in f32 on one core of the CPU: what a device ought to return.
    pub fn twin(backend: Backend) -> Self {
        Self { backend, gpu: None }
    }

    /// Its backend.
    pub fn backend(&self) -> Backend {
        self.backend
    }

    /// Evaluates all requests; results in their order.
    ///
    /// Shapes without a NURBS form are evaluated on the CPU by every backend. Parameters outside a shape's domain count
    /// as its nearest end.
    ///
    /// # Errors
    /// What the device refuses; see [`GpuError`].
    pub fn evaluate(
        &self,
        requests: &[Request<'_>],
        quantities: Quantities,
    ) -> Result<Vec<Values>, GpuError> {
        if self.backend == Backend::Cpu {
            let all = requests.iter().map(|request| cpu::values(request, quantities, Vec::new()));
            return Ok(all.collect());
        }
        let stride = quantities.stride();
        let mut out: Vec<Option<Values>> = vec![None; requests.len()];
        for pieces in batches(requests, self.backend, quantities, self.limit()) {
            let batch = Batch::new(&pieces, self.backend);
            let vectors: Vec<Vec4> = match &self.gpu {
                Some(gpu) => {
                    let prepared = self.prepare_batch(gpu, &pieces, &batch, quantities)?;
                    prepared.run()?;
                    let bytes = (batch.points * stride * 16) as u64;
                    gpu.download(&self.describe(&pieces), &prepared.values.batches[0].buffer, bytes)?
                }
                None => self.twin_of(&batch, quantities),
            };
            for piece in placed(&pieces) {
                let range = piece.offset * stride..(piece.offset + piece.points) * stride;
                let origin = requests[piece.request].shape.origin();
                let data = Data::Single { origin, vectors: vectors[range].to_vec() };
                let values = Values { quantities, data };
                match &mut out[piece.request] {
                    Some(before) => before.append(values),
                    empty => *empty = Some(values),
                }
            }
        }
        let rest = |(values, request): (Option<Values>, &Request<'_>)| {
            values.unwrap_or_else(|| cpu::values(request, quantities, Vec::new()))
        };
        Ok(out.into_iter().zip(requests).map(rest).collect())
    }

    /// [`Evaluator::evaluate`] for those who evaluate often: `values` becomes the result, and [`Backend::Cpu`] writes
    /// its points where those before lay. (On a device, [`Evaluator::prepare`] does as much.)
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`]; `values` is empty then.
    pub fn evaluate_into(
        &self,
        requests: &[Request<'_>],
        quantities: Quantities,
        values: &mut Vec<Values>,
    ) -> Result<(), GpuError> {
        let mut old = std::mem::take(values).into_iter();
        *values = match self.backend {
            Backend::Cpu => {
                let mut room = || old.next().map_or_else(Vec::new, Values::into_room);
                requests.iter().map(|request| cpu::values(request, quantities, room())).collect()
            }
            _ => self.evaluate(requests, quantities)?,
        };
        Ok(())
    }

    /// Evaluates the requests whose shapes have a NURBS form and leaves the results on the device; the work may not be
    /// done yet when this returns.
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`]; also without a device.
    pub fn evaluate_on_device(
        &self,
        requests: &[Request<'_>],
        quantities: Quantities,
    ) -> Result<DeviceValues, GpuError> {
        let prepared = self.prepare(requests, quantities)?;
        prepared.run()?;
        Ok(prepared.into_values())
    }

    /// Sends the requests whose shapes have a NURBS form to the device and evaluates nothing yet.
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`]; also without a device.
    pub fn prepare(&self, requests: &[Request<'_>], quantities: Quantities) -> Result<Prepared, GpuError> {
        let gpu = self.gpu.as_ref().filter(|_| self.backend != Backend::Cpu);
        let gpu = gpu.ok_or_else(|| {
            GpuError::Request(format!("this evaluator (`{}`) has no device", self.backend.name()))
        })?;
        let values = DeviceValues { quantities, batches: Vec::new() };
        let mut all = Prepared { gpu: gpu.clone(), passes: Vec::new(), values };
        for pieces in batches(requests, self.backend, quantities, self.limit()) {
            let batch = Batch::new(&pieces, self.backend);
            let one = self.prepare_batch(gpu, &pieces, &batch, quantities)?;
            all.passes.extend(one.passes);
            all.values.batches.extend(one.values.batches);
        }
        Ok(all)
    }

    /// Bytes that a table may have.
    fn limit(&self) -> u64 {
        let portable = wgpu::Limits::default().max_storage_buffer_binding_size;
        self.gpu.as_ref().map_or(portable, Gpu::largest_binding)
    }

    fn twin_of(&self, batch: &Batch, quantities: Quantities) -> Vec<Vec4> {
        match self.backend {
            Backend::Bezier | Backend::Cpu => bezier::twin(batch, quantities),
            Backend::Tan => tan::twin(batch, quantities),
            layout => krishnamurthy::twin(batch, layout, quantities),
        }
    }

    fn describe(&self, pieces: &[Piece<'_>]) -> String {
        let points: usize = pieces.iter().map(Piece::points).sum();
        format!("evaluate {points} points in {} pieces with {}", pieces.len(), self.backend.name())
    }

    fn prepare_batch(
        &self,
        gpu: &Gpu,
        pieces: &[Piece<'_>],
        batch: &Batch,
        quantities: Quantities,
    ) -> Result<Prepared, GpuError> {
        let name = self.describe(pieces);
        let bytes = (batch.points * quantities.stride() * 16) as u64;
        let limit = self.limit();
        let largest = [
            ("results", bytes),
            ("control points", 16 * batch.control.len() as u64),
            ("basis functions", 12 * (batch.lines.len() * batch.width) as u64),
            ("lines", size_of_val(&batch.lines[..]) as u64),
        ];
        if let Some((what, bytes)) = largest.into_iter().find(|(_, bytes)| *bytes > limit) {
            let reason = format!("{bytes} bytes of {what} in one row, the device allows {limit}");
            return Err(GpuError::TooLarge { request: name, reason });
        }
        let (passes, buffer) = gpu.scoped(&name, || {
            let out = gpu.reserve("results", bytes);
            let passes = match self.backend {
                Backend::Bezier | Backend::Cpu => bezier::passes(gpu, batch, quantities, &out),
                Backend::Tan => tan::passes(gpu, batch, quantities, &out),
                layout => krishnamurthy::passes(gpu, batch, layout, quantities, &out),
            };
            Ok((passes, out))
        })?;
        let batches = vec![DeviceBatch { buffer, pieces: placed(pieces) }];
        Ok(Prepared { gpu: gpu.clone(), passes, values: DeviceValues { quantities, batches } })
    }
}

/// Where pieces lie in their batch's results.
fn placed(pieces: &[Piece<'_>]) -> Vec<DevicePiece> {
    let mut offset = 0;
    let place = |piece: &Piece<'_>| {
        let points = piece.points();
        offset += points;
        DevicePiece { request: piece.request, first: piece.range.start, offset: offset - points, points }
    };
    pieces.iter().map(place).collect()
}
