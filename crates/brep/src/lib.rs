//! The exact model: products, instances, bodies, faces, loops, edges, vertices, colours, names, units, and the
//! diagnostics every stage adds to. Millimetres and radians, right-handed, as the file orients it.

mod appearance;
mod diagnostic;
mod entity;
mod model;
mod part;

pub use appearance::Rgba;
pub use diagnostic::{Diagnostic, Diagnostics, Severity};
pub use entity::EntityRef;
pub use model::{Model, Node, Source};
pub use part::{
    Body, BodyKind, Coedge, Edge, EdgeId, Face, FaceGeometry, FaceId, Facets, FreeCurve, FreePoint, Loop,
    Part, Shell, ShellFace, Vertex, VertexId,
};
