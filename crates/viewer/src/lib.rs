//! The viewer: opens STEP and IGES files in a window and draws their exact surfaces, sharp at every zoom.

mod app;
mod document;
mod loader;
mod navigation;
mod panels;
mod viewport;
mod watch;

use std::path::PathBuf;

pub use app::App;
pub use navigation::{Navigation, Style};

/// What the viewer starts with.
#[derive(Clone, Debug, Default)]
pub struct ViewOptions {
    /// What is opened.
    pub files: Vec<PathBuf>,
    /// Which axis points up.
    pub up: trimloop_render::Up,
}

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// There is no display, or no graphics device that can draw into a window.
    #[error(
        "no window can be opened: {0} (a display is needed, and a Vulkan driver; on Debian, mesa-vulkan-drivers draws \
         without a GPU)"
    )]
    Window(String),
}

/// Opens a window and returns when it is closed.
///
/// # Errors
/// Where there is no display, or no graphics device.
pub fn run(options: ViewOptions) -> Result<(), ViewError> {
    let native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_app_id("trimloop")
            .with_title("Trimloop")
            .with_inner_size([1280.0, 860.0])
            .with_drag_and_drop(true),
        ..Default::default()
    };
    let create = move |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        Ok(Box::new(App::new(&context.egui_ctx, context.wgpu_render_state.as_ref(), options)?))
    };
    eframe::run_native("Trimloop", native, Box::new(create))
        .map_err(|error| ViewError::Window(error.to_string()))
}
