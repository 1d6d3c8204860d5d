//! Trimmed NURBS on the GPU: evaluators of curves and surfaces of any degree.
//!
//! ```no_run
//! use trimloop_geom::{Frame, Interval, Surface};
//! use trimloop_gpu::{Backend, Evaluator, Gpu, Places, Quantities, Request, Shape};
//!
//! let gpu = Gpu::headless()?;
//! let sphere = Surface::Sphere { frame: Frame::WORLD, radius: 2.0 };
//! let shape = Shape::surface(&sphere, [Interval::new(0.0, 6.0), Interval::new(-1.0, 1.0)]).expect("finite");
//! let request = Request { shape: &shape, places: Places::even(&shape, 64, 32) };
//! let values = Evaluator::on_gpu(&gpu, Backend::Bezier).evaluate(&[request], Quantities::Normals)?;
//! assert!((values[0].point(0).length() - 2.0).abs() < 1e-6);
//! # Ok::<(), trimloop_gpu::GpuError>(())
//! ```

mod batch;
mod curve_tree;
mod deviation;
mod device;
mod error;
mod evaluate;
mod faces;
mod lod_factors;
mod parameter;
mod patch_tree;
mod request;
pub mod shaders;
mod shape;
mod trim_classify;
mod trim_fan;
mod twin;
mod wavelet;

pub use curve_tree::{CurveNode, CurveTree};
pub use deviation::Deviation;
pub use device::Gpu;
pub use error::GpuError;
pub use evaluate::{DeviceBatch, DevicePiece, DeviceValues, Evaluator, Prepared};
pub use faces::{FaceShape, FaceShapes};
pub use lod_factors::{LodShape, LodView, lod_cells};
pub use patch_tree::{Bicubic, PatchGrid, PatchNode, PatchRequest, PatchTree, evaluate_patches};
pub use request::{Backend, Places, Quantities, Request, Values};
pub use shape::Shape;
pub use trim_classify::{Cover, TrimHeader, TrimTable};
pub use trim_fan::{CHANNELS, TrimFans, TrimTexture, trim_masks, trim_textures};
pub use wavelet::{DevicePyramid, Pyramid, Wavelet};
