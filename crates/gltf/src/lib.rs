//! Triangles to glTF 2.0: the only place with metres, Y-up and f32.
//!
//! One glTF mesh per part, shared by the nodes that place it; the nodes are the assembly tree. Each root node turns
//! millimetres into metres and the file's axes into glTF's; everything below stays in millimetres.
//!
//! ```
//! use trimloop_brep::Model;
//! use trimloop_gltf::{GltfOptions, write_glb};
//!
//! let mut glb = Vec::new();
//! let written = write_glb(&Model::default(), &[], &GltfOptions::default(), &mut glb)?;
//! assert_eq!(&glb[..4], b"glTF");
//! assert_eq!(written.bytes, glb.len() as u64);
//! # Ok::<(), trimloop_gltf::GltfError>(())
//! ```

mod compression;
mod container;
mod document;
mod grid;
mod lines;
mod options;
mod paint;
mod placement;
mod shape;
mod stream;
mod tree;
mod weld;
mod written;

pub use container::{write_glb, write_gltf};
pub use options::{GltfOptions, UpAxis};
pub use written::{GltfError, Written, WrittenPart};
