//! Fixtures on the graphics device.

mod evaluators;
mod trim;

use std::sync::OnceLock;

use trimloop_gpu::Gpu;

/// The device. Without one, tests that need it say so loudly and do nothing, unless `TRIMLOOP_REQUIRE_GPU` is set.
fn gpu() -> Option<&'static Gpu> {
    static DEVICE: OnceLock<Option<Gpu>> = OnceLock::new();
    let open = || match Gpu::headless() {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var_os("TRIMLOOP_REQUIRE_GPU").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("\n!!! SKIPPED, NOT TESTED: {error}\n");
            None
        }
    };
    DEVICE.get_or_init(open).as_ref()
}
