//! How long a window is kept busy while files are read: `cargo run --release --example responsive -- FILE...`
//!
//! Prints when the tree, the first picture and all of the model were there, the longest frames on the window's thread, and the
//! most memory that was used. A frame may wait for the device, which may be a program; what the thread itself worked is told
//! beside it (on Linux).

use std::path::PathBuf;
use std::time::{Duration, Instant};

use egui_kittest::Harness;
use trimloop_viewer::{App, ViewOptions};

fn main() {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let options = ViewOptions { files, ..ViewOptions::default() };
    let build = |context: &mut eframe::CreationContext<'_>| {
        let state = context.wgpu_render_state.as_ref();
        App::new(&context.egui_ctx, state, context.storage, options).unwrap_or_else(|error| panic!("{error}"))
    };
    let mut harness = Harness::builder().with_size([1280.0, 860.0]).wgpu().build_eframe(build);
    let start = Instant::now();
    let mut frames = Vec::new();
    let (mut tree, mut picture) = (None, None);
    let mut rest = 20;
    while rest > 0 {
        let (before, worked) = (Instant::now(), own_ms());
        harness.step();
        frames.push((before.elapsed(), before - start, own_ms() - worked));
        if tree.is_none() && !harness.state().open_files().is_empty() {
            tree = Some(start.elapsed());
        }
        if picture.is_none() && harness.state().has_picture() {
            picture = Some(start.elapsed());
        }
        if harness.state().is_idle() {
            rest -= 1;
        }
        std::thread::sleep(Duration::from_millis(16));
    }
    let ms = |duration: Duration| duration.as_secs_f64() * 1e3;
    let told = |at: Option<Duration>| at.map_or("never".to_owned(), |at| format!("{:.0} ms", ms(at)));
    println!("tree after {}, faces after {}, {} frames", told(tree), told(picture), frames.len());
    println!("all after {:.0} ms", ms(start.elapsed()) - 20.0 * 16.0);
    frames.sort_by_key(|frame| std::cmp::Reverse(frame.0));
    for (duration, at, worked) in frames.iter().take(8) {
        println!("a frame of {:6.1} ms at {:6.0} ms, {worked:6.1} ms of work", ms(*duration), ms(*at));
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    if let Some(line) = status.lines().find(|line| line.starts_with("VmHWM")) {
        println!("{line}");
    }
    harness.state().messages().iter().for_each(|message| println!("{message}"));
}

/// Milliseconds that this thread has been at work.
fn own_ms() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(0.0) * 1e-6
}
