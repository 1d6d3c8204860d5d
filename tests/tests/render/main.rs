//! Pictures: held against the exact surfaces, against dense triangles, and against those of earlier versions.

mod bad_input;
mod pictures;
mod proof;
mod silhouette;

use std::sync::LazyLock;

use trimloop_brep::Model;
use trimloop_gpu::Gpu;
use trimloop_import::ImportOptions;
use trimloop_mesh::Silent;
use trimloop_render::{Camera, Direction, Projection, Renderer, Scene, Up};

/// The device; without one, tests say loudly that they are skipped, and fail where there must be one.
static GPU: LazyLock<Option<Gpu>> = LazyLock::new(|| match Gpu::headless() {
    Ok(gpu) => Some(gpu),
    Err(error) if std::env::var_os("TRIMLOOP_REQUIRE_GPU").is_some() => panic!("{error}"),
    Err(error) => {
        eprintln!("SKIPPED, nothing was tested: {error}");
        None
    }
});

fn model(name: &str) -> Model {
    let path = format!("{}/../fixtures/{name}", env!("CARGO_MANIFEST_DIR"));
    let mut model = trimloop_import::read(path.as_ref(), &ImportOptions::default()).expect("a fixture");
    model.show_hidden();
    model
}

fn scene(model: &Model) -> Scene {
    Scene::new(model, &Silent).expect("nobody stops it")
}

fn renderer(name: &str) -> Option<Renderer> {
    let gpu = GPU.as_ref()?;
    Some(Renderer::new(gpu, scene(&model(name))).expect("a renderer"))
}

fn camera(scene: &Scene, direction: Direction, [width, height]: [u32; 2]) -> Camera {
    let projection = Projection::Perspective { fov_y_rad: 0.5 };
    let aspect = f64::from(width) / f64::from(height);
    Camera::fit(&scene.outline(), direction, Up::Z, projection, aspect).expect("a face")
}
