//! Whatever draws here: the device, or the CPU where there is none.

use trimloop_brep::Model;
use trimloop_gpu::Gpu;
use trimloop_mesh::Monitor;

use crate::{Camera, CpuRenderer, FrameStatistics, Look, Picture, Place, RenderError, Renderer, Scene};

/// Whatever draws here.
#[derive(Debug)]
pub enum Painter {
    /// Exact surfaces, on a graphics device.
    Device(Box<Renderer>),
    /// Triangles, on the CPU.
    Cpu(Box<CpuRenderer>),
}

impl Painter {
    /// Brings `scene`, which was made of `model`, to `gpu`, or without one to the CPU.
    ///
    /// # Errors
    /// What the device refuses, and where `monitor` stops it.
    pub fn new(
        gpu: Option<&Gpu>,
        model: &Model,
        scene: Scene,
        monitor: &dyn Monitor,
    ) -> Result<Self, RenderError> {
        match gpu {
            Some(gpu) => Ok(Self::Device(Box::new(Renderer::new(gpu, scene)?))),
            None => Ok(Self::Cpu(Box::new(CpuRenderer::new(model, scene, monitor)?))),
        }
    }

    /// What is drawn.
    pub fn scene(&self) -> &Scene {
        match self {
            Self::Device(renderer) => renderer.scene(),
            Self::Cpu(renderer) => renderer.scene(),
        }
    }

    /// A picture of `size` pixels; `monitor` is told of the steps of a large one ([`Renderer::steps`]).
    ///
    /// # Errors
    /// A size that cannot be, what the device refuses, and where `monitor` stops it.
    pub fn picture(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        monitor: &dyn Monitor,
    ) -> Result<Picture, RenderError> {
        match self {
            Self::Device(renderer) => renderer.picture_watched(camera, size, look, monitor),
            Self::Cpu(renderer) => renderer.picture(camera, size, look),
        }
    }

    /// What lies at a pixel.
    ///
    /// # Errors
    /// A size that cannot be, and what the device refuses.
    pub fn pick(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        look: &Look,
        at: [u32; 2],
    ) -> Result<Option<Place>, RenderError> {
        match self {
            Self::Device(renderer) => renderer.pick(camera, size, look, at),
            Self::Cpu(renderer) => renderer.pick(camera, size, look, at),
        }
    }

    /// What the last picture took on the device.
    pub fn statistics(&self) -> Option<FrameStatistics> {
        match self {
            Self::Device(renderer) => Some(renderer.statistics()),
            Self::Cpu(_) => None,
        }
    }
}
