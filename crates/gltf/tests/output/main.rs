//! What the written files say, read back: the tree, the meshes, the encodings, the containers.

mod encodings;
mod files;
mod meshes;
mod models;
mod reading;
mod tree;
