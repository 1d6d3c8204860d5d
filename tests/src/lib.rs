//! What the workspace's own tests stand on: the fixtures with their references, whole conversions, an independent
//! reader of the GLBs, and an independent measure of how far triangles are from the exact surfaces.

pub mod conversion;
pub mod deviation;
pub mod fixture;
pub mod glb;
