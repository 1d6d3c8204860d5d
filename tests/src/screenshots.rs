//! What the viewer looks like: windows that are opened, driven and photographed, one after the other. The pictures stand in
//! the README and are what the tests compare with.

use std::path::{Path, PathBuf};

use trimloop_render::Picture;

use crate::fixture;
use crate::window::{Window, With, key};

/// A window to be photographed.
pub struct Scene {
    /// The picture's name.
    pub name: &'static str,
    /// Fixtures that are opened, and options.
    arguments: &'static [&'static str],
    /// What is done.
    drive: fn(&Window) -> anyhow::Result<()>,
}

/// Pixels of a window.
pub const SIZE: [u16; 2] = [1280, 860];
/// A place in the model's view, beside the model.
const ASIDE: [i16; 2] = [350, 840];

/// All of them.
pub const SCENES: [Scene; 9] = [
    Scene { name: "pick", arguments: &["cadquery/bracket.step"], drive: pick },
    Scene { name: "measure", arguments: &["cadquery/bracket.step"], drive: measure },
    Scene { name: "section", arguments: &["cadquery/hollow_ball.step"], drive: section },
    Scene { name: "explode", arguments: &["cadquery/assembly_nested.step"], drive: explode },
    Scene { name: "hide", arguments: &["cadquery/assembly_nested.step"], drive: hide },
    Scene { name: "kinds", arguments: &["cadquery/bottle.step"], drive: kinds },
    Scene { name: "curvature", arguments: &["cadquery/bracket.step"], drive: curvature },
    Scene {
        name: "deviation",
        arguments: &["cadquery/bracket.step", "--compare", "cadquery/bracket.stl"],
        drive: deviation,
    },
    Scene { name: "keys", arguments: &["cadquery/thread.step"], drive: keys },
];

impl Scene {
    /// Opens the window with `program`, drives it and photographs it.
    ///
    /// # Errors
    /// Where there is no window, or it does not come to rest.
    pub fn photograph(&self, program: &Path) -> anyhow::Result<Picture> {
        let place = |argument: &&str| match argument.starts_with("--") {
            true => PathBuf::from(argument),
            false => fixture::folder().join(argument),
        };
        let arguments = [PathBuf::from("view")].into_iter().chain(self.arguments.iter().map(place));
        let window = Window::open(program, arguments, SIZE)?;
        window.started()?;
        (self.drive)(&window)?;
        window.settled()
    }
}

fn pick(window: &Window) -> anyhow::Result<()> {
    window.click([880, 390], With::Nothing)?;
    window.settled()?;
    // Another face, hovered over.
    window.move_to([720, 520])
}

fn measure(window: &Window) -> anyhow::Result<()> {
    window.click([830, 352], With::Nothing)?;
    window.settled()?;
    window.click([505, 476], With::Shift)?;
    window.settled()?;
    window.move_to(ASIDE)
}

fn section(window: &Window) -> anyhow::Result<()> {
    window.press(b'x', With::Nothing)?;
    window.move_to(ASIDE)
}

fn explode(window: &Window) -> anyhow::Result<()> {
    window.click([193, 524], With::Nothing)?;
    window.settled()?;
    window.drag(1, [22, 602], [100, 602])?;
    window.settled()?;
    window.press(b'f', With::Nothing)?;
    window.move_to(ASIDE)
}

fn hide(window: &Window) -> anyhow::Result<()> {
    window.click([780, 440], With::Nothing)?;
    window.settled()?;
    window.press(b'h', With::Nothing)?;
    window.press(key::ESCAPE, With::Nothing)?;
    window.move_to(ASIDE)
}

fn kinds(window: &Window) -> anyhow::Result<()> {
    colors(window, 2)
}

fn curvature(window: &Window) -> anyhow::Result<()> {
    colors(window, 3)
}

/// Chooses what colours tell, in the menu.
fn colors(window: &Window, row: i16) -> anyhow::Result<()> {
    window.click([103, 12], With::Nothing)?;
    window.settled()?;
    window.click([130, 181 + 23 * row], With::Nothing)?;
    window.press(key::ESCAPE, With::Nothing)?;
    window.move_to(ASIDE)
}

fn deviation(window: &Window) -> anyhow::Result<()> {
    window.click([193, 524], With::Nothing)?;
    window.move_to(ASIDE)
}

fn keys(window: &Window) -> anyhow::Result<()> {
    window.press(b'/', With::Shift)?;
    window.move_to(ASIDE)
}
