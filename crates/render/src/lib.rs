//! Draws exact models: trimmed NURBS are evaluated on the GPU for each view and trimmed in each fragment, so that they
//! are sharp at every zoom.
//!
//! ```no_run
//! use trimloop_render::{Camera, Direction, Look, Projection, Renderer, Scene, Up};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let model = trimloop_import::read("part.step".as_ref(), &trimloop_import::ImportOptions::default())?;
//! let scene = Scene::new(&model, &trimloop_mesh::Silent)?;
//! let mut renderer = Renderer::new(&trimloop_gpu::Gpu::headless()?, scene)?;
//! let view = Projection::Perspective { fov_y_rad: 0.6 };
//! let camera = Camera::fit(&renderer.scene().outline(), Direction::ISO, Up::Z, view, 4.0 / 3.0).expect("a face");
//! let picture = renderer.picture(&camera, [1280, 960], &Look::default())?;
//! std::fs::write("part.png", picture.to_png()?)?;
//! # Ok(())
//! # }
//! ```

mod arena;
mod border;
mod camera;
mod cap;
mod clock;
mod cpu;
mod emission;
mod error;
mod frame;
mod grid;
mod hierarchy;
mod lod;
mod look;
mod names;
mod painter;
mod passes;
mod picture;
mod place;
mod proof;
mod renderer;
mod scene;
mod sheet;
mod skirt;
mod stage;
mod surface_face;
mod targets;

pub use camera::{Camera, Direction, Projection, Up};
pub use cap::Cutter;
pub use cpu::CpuRenderer;
pub use error::RenderError;
pub use lod::Lod;
pub use look::{Background, EdgeStyle, Look, MOST_SECTIONS, Paint, Section};
pub use names::Names;
pub use painter::Painter;
pub use picture::{Difference, Pick, Picture, Seen};
pub use place::Place;
pub use proof::{Proof, prove};
pub use renderer::{FrameStatistics, Identified, Pending, Renderer};
pub use scene::{FaceKind, Highlight, Instance, Scene, SceneFace, ScenePart, Triangles};
pub use sheet::contact_sheet;
pub use surface_face::SurfaceFace;
