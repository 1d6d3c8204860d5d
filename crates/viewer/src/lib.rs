//! The viewer: opens STEP and IGES files in a window and draws their exact surfaces, sharp at every zoom.

mod app;
mod deviation;
mod display;
mod document;
mod export;
mod job;
mod loader;
mod measure;
mod navigation;
mod panels;
mod pick;
mod section;
mod settings;
mod tree;
mod view_cube;
mod viewport;
mod watch;

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

pub use app::{App, Resume};
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

/// Devices that are lost one after the other, before the viewer gives up.
const MOST_LOSSES: usize = 5;

/// Opens a window and returns when it is closed. A window whose graphics device is lost is followed by another one with the
/// same files and the same view.
///
/// # Errors
/// Where there is no display, or no graphics device.
pub fn run(options: ViewOptions) -> Result<(), ViewError> {
    let handed: Arc<Mutex<Option<Resume>>> = Arc::default();
    let mut from = None;
    for _ in 0..=MOST_LOSSES {
        run_once(options.clone(), from.take(), handed.clone())?;
        from = handed.lock().unwrap_or_else(PoisonError::into_inner).take();
        if from.is_none() {
            return Ok(());
        }
    }
    Err(ViewError::Window("the graphics device is lost again and again".to_owned()))
}

fn run_once(
    mut options: ViewOptions,
    from: Option<Resume>,
    handed: Arc<Mutex<Option<Resume>>>,
) -> Result<(), ViewError> {
    let native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_app_id("trimloop")
            .with_title("Trimloop")
            .with_inner_size([1280.0, 860.0])
            .with_drag_and_drop(true),
        wgpu_options: graphics(),
        ..Default::default()
    };
    if from.is_some() {
        options.files.clear();
    }
    let create = move |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let state = context.wgpu_render_state.as_ref();
        let mut app = App::new(&context.egui_ctx, state, context.storage, options)?;
        app.resume(from, handed);
        Ok(Box::new(app))
    };
    eframe::run_native("Trimloop", native, Box::new(create))
        .map_err(|error| ViewError::Window(error.to_string()))
}

/// The device is opened as the renderer likes it: with large buffers where there are any.
fn graphics() -> egui_wgpu::WgpuConfiguration {
    let mut configuration = egui_wgpu::WgpuConfiguration::default();
    if let egui_wgpu::WgpuSetup::CreateNew(setup) = &mut configuration.wgpu_setup {
        setup.device_descriptor = Arc::new(trimloop_gpu::Gpu::descriptor);
    }
    configuration
}
