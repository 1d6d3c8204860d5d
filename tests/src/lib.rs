//! What the workspace's own tests stand on: the fixtures with their references, an independent reader of the GLBs, and
//! an independent measure of how far triangles are from the exact surfaces.

pub mod fixture;
