//! `cargo xtask`: what developers repeat.
fn main() {}
