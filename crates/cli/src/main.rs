//! The `trimloop` command.
fn main() {}
