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
mod resume;
mod section;
mod settings;
mod tree;
mod view_cube;
mod viewport;
mod watch;

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

pub use app::App;
pub use resume::Resume;

pub use navigation::{Navigation, Style};
use resume::State;

/// What the viewer starts with.
#[derive(Clone, Debug, Default)]
pub struct ViewOptions {
    /// What is opened.
    pub files: Vec<PathBuf>,
    /// Which axis points up.
    pub up: trimloop_render::Up,
    /// What the first file is held against.
    pub reference: Option<PathBuf>,
    /// Whether the graphics device is destroyed once the files are read; for tests.
    pub loses_device: bool,
    /// Where a window was that has lost its graphics device.
    pub resume: Option<Resume>,
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

/// How a window ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    /// Somebody closed it.
    Closed,
    /// Its graphics device was lost. A new process can open the same files and go on where this one was.
    Lost(Vec<PathBuf>, Resume),
}

/// Devices that may be lost one after the other.
const MOST_LOSSES: u32 = 5;

/// Opens a window and returns when it is closed, or when its graphics device is lost.
///
/// # Errors
/// Where there is no display, or no graphics device.
pub fn run(options: ViewOptions) -> Result<Ended, ViewError> {
    let state = Arc::new(Mutex::new(State::default()));
    let losses = options.resume.map_or(0, |resume| resume.losses);
    let told = hold_back_panics();
    // What draws the window panics where its device is gone.
    let shared = state.clone();
    let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| run_once(options, shared)));
    let last = state.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if last.is_lost() {
        if losses >= MOST_LOSSES {
            return Err(ViewError::Window("the graphics device is lost again and again".to_owned()));
        }
        return Ok(Ended::Lost(last.files, Resume { view: last.view, losses: losses + 1 }));
    }
    match done {
        Ok(done) => done.map(|()| Ended::Closed),
        Err(panic) => {
            if let Some(text) = told.lock().unwrap_or_else(PoisonError::into_inner).take() {
                eprintln!("{text}");
            }
            std::panic::resume_unwind(panic)
        }
    }
}

/// Panics of this thread are not told before it is known whether they only come of a lost device; the last one's text.
fn hold_back_panics() -> Arc<Mutex<Option<String>>> {
    let told = Arc::new(Mutex::new(None));
    let (usual, held, own) = (std::panic::take_hook(), told.clone(), std::thread::current().id());
    std::panic::set_hook(Box::new(move |panic| {
        if std::thread::current().id() == own {
            let text = format!("{panic}\n{}", std::backtrace::Backtrace::capture());
            *held.lock().unwrap_or_else(PoisonError::into_inner) = Some(text);
        } else {
            usual(panic);
        }
    }));
    told
}

fn run_once(options: ViewOptions, state: Arc<Mutex<State>>) -> Result<(), ViewError> {
    let native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_app_id("trimloop")
            .with_title("Trimloop")
            .with_inner_size([1280.0, 860.0])
            .with_drag_and_drop(true),
        wgpu_options: graphics(),
        ..Default::default()
    };
    let create = move |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let mut app =
            App::new(&context.egui_ctx, context.wgpu_render_state.as_ref(), context.storage, options)?;
        app.share(state);
        Ok(Box::new(app))
    };
    eframe::run_native("Trimloop", native, Box::new(create))
        .map_err(|error| ViewError::Window(error.to_string()))
}

/// The device is opened as the renderer likes it: with large buffers where there are any, and never by OpenGL, which lacks what
/// its shaders need.
fn graphics() -> egui_wgpu::WgpuConfiguration {
    let mut configuration = egui_wgpu::WgpuConfiguration::default();
    if let egui_wgpu::WgpuSetup::CreateNew(setup) = &mut configuration.wgpu_setup {
        setup.instance_descriptor.backends &= wgpu::Backends::PRIMARY;
        setup.device_descriptor = Arc::new(trimloop_gpu::Gpu::descriptor);
    }
    configuration
}
