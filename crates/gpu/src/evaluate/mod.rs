//! Evaluation of many curves and surfaces at once.

mod bezier;
pub(crate) mod cpu;
mod krishnamurthy;
mod product;
mod tan;

use glam::Vec4;

use crate::batch::{Batch, Piece, batches};
use crate::request::Data;
use crate::{Backend, Gpu, GpuError, Quantities, Request, Values};

/// Evaluates batches with one of the backends.
#[derive(Clone, Debug)]
pub struct Evaluator {
    backend: Backend,
    gpu: Option<Gpu>,
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
        Self { backend: Backend::Cpu, gpu: None }
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
        let Some(gpu) = self.gpu.as_ref().filter(|_| self.backend != Backend::Cpu) else {
            return Ok(requests.iter().map(|request| cpu::values(request, quantities)).collect());
        };
        let mut out: Vec<Option<Values>> = vec![None; requests.len()];
        for pieces in batches(requests, self.backend, quantities, gpu.largest_binding()) {
            let batch = self.submit(gpu, &pieces, quantities)?;
            let name = self.describe(&pieces);
            let bytes = (pieces.iter().map(Piece::points).sum::<usize>() * quantities.stride() * 16) as u64;
            let vectors: Vec<Vec4> = gpu.download(&name, &batch.buffer, bytes)?;
            for piece in &batch.pieces {
                let range =
                    piece.offset * quantities.stride()..(piece.offset + piece.points) * quantities.stride();
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
            values.unwrap_or_else(|| cpu::values(request, quantities))
        };
        Ok(out.into_iter().zip(requests).map(rest).collect())
    }

    /// Evaluates the requests whose shapes have a NURBS form and leaves the results on the device; the work may not be
    /// done yet when this returns.
    ///
    /// # Errors
    /// As [`Evaluator::evaluate`]; also for [`Backend::Cpu`].
    pub fn evaluate_on_device(
        &self,
        requests: &[Request<'_>],
        quantities: Quantities,
    ) -> Result<DeviceValues, GpuError> {
        let gpu = self.gpu.as_ref().filter(|_| self.backend != Backend::Cpu);
        let gpu = gpu.ok_or_else(|| GpuError::Request("the backend `cpu` has no device".to_owned()))?;
        let batches = batches(requests, self.backend, quantities, gpu.largest_binding());
        let batches = batches.iter().map(|pieces| self.submit(gpu, pieces, quantities));
        Ok(DeviceValues { quantities, batches: batches.collect::<Result<_, _>>()? })
    }

    fn describe(&self, pieces: &[Piece<'_>]) -> String {
        let points: usize = pieces.iter().map(Piece::points).sum();
        format!("evaluate {points} points in {} pieces with {}", pieces.len(), self.backend.name())
    }

    fn submit(
        &self,
        gpu: &Gpu,
        pieces: &[Piece<'_>],
        quantities: Quantities,
    ) -> Result<DeviceBatch, GpuError> {
        let name = self.describe(pieces);
        let batch = Batch::new(pieces, self.backend);
        let bytes = (batch.points * quantities.stride() * 16) as u64;
        let limit = gpu.largest_binding();
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
        let buffer = gpu.scoped(&name, || {
            let out = gpu.reserve("results", bytes);
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            match self.backend {
                Backend::Bezier | Backend::Cpu => bezier::encode(gpu, &mut encoder, &batch, quantities, &out),
                Backend::Tan => tan::encode(gpu, &mut encoder, &batch, quantities, &out),
                layout => krishnamurthy::encode(gpu, &mut encoder, &batch, layout, quantities, &out),
            }
            gpu.queue().submit([encoder.finish()]);
            Ok(out)
        })?;
        let mut offset = 0;
        let mut placed = Vec::with_capacity(pieces.len());
        for piece in pieces {
            let points = piece.points();
            placed.push(DevicePiece { request: piece.request, first: piece.range.start, offset, points });
            offset += points;
        }
        Ok(DeviceBatch { buffer, pieces: placed })
    }
}
