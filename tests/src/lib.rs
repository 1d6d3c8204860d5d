//! What the workspace's own tests stand on: the fixtures with their references, whole conversions, an independent
//! reader of the GLBs, an independent measure of how far triangles are from the exact surfaces, and windows that are driven as
//! by a person.

pub mod conversion;
pub mod deviation;
pub mod fixture;
pub mod glb;
pub mod screenshots;
pub mod window;
