//! `cargo xtask screenshots`: photographs the viewer for the README and for the tests.

use std::path::Path;

use trimloop_tests::screenshots::SCENES;

use crate::command::cargo;

/// Photographs those scenes whose name contains one of `words`; all of them without any.
pub fn run(root: &Path, words: &[String]) -> anyhow::Result<()> {
    cargo(root, ["build", "--package", "trimloop-cli", "--package", "xtask"])?;
    let program = root.join("target/debug/trimloop");
    let folder = root.join("docs/screenshots");
    std::fs::create_dir_all(&folder)?;
    for scene in SCENES.iter().filter(|s| words.is_empty() || words.iter().any(|w| s.name.contains(w))) {
        let path = folder.join(scene.name).with_extension("png");
        std::fs::write(&path, scene.photograph(&program)?.to_png()?)?;
        println!("{}", path.display());
    }
    Ok(())
}
