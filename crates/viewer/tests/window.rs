//! The window as a person uses it, without a display: files are opened, turned, picked and closed.

use std::path::PathBuf;
use std::time::Duration;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use trimloop_viewer::{App, ViewOptions};

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(format!("{}/../../fixtures/{name}", env!("CARGO_MANIFEST_DIR")))
}

/// A window over `files`, as soon as all of them are read. Without a graphics device, nothing is tested, loudly.
fn window(files: Vec<PathBuf>) -> Option<Harness<'static, App>> {
    if let Err(error) = trimloop_gpu::Gpu::headless() {
        assert!(std::env::var_os("TRIMLOOP_REQUIRE_GPU").is_none(), "{error}");
        eprintln!("SKIPPED, nothing was tested: {error}");
        return None;
    }
    let options = ViewOptions { files, ..ViewOptions::default() };
    let build = |context: &mut eframe::CreationContext<'_>| {
        App::new(&context.egui_ctx, context.wgpu_render_state.as_ref(), options).expect("a device")
    };
    let mut harness = Harness::builder().with_size([1000.0, 700.0]).wgpu().build_eframe(build);
    settle(&mut harness);
    Some(harness)
}

/// Until nothing is read any more, and some frames longer.
fn settle(harness: &mut Harness<'_, App>) {
    for _ in 0..600 {
        harness.step();
        if harness.state().is_idle() {
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(harness.state().is_idle());
    harness.run_steps(3);
}

fn fact(app: &App, name: &str) -> Option<String> {
    app.facts().into_iter().find(|(own, _)| own == name).map(|(_, value)| value)
}

/// The place in the middle of the model's view.
const MIDDLE: egui::Pos2 = egui::Pos2 { x: 650.0, y: 360.0 };

fn click(harness: &mut Harness<'_, App>, at: egui::Pos2) {
    harness.hover_at(at);
    harness.step();
    harness.drag_at(at);
    harness.step();
    harness.drop_at(at);
    harness.run_steps(3);
}

#[test]
fn a_click_tells_what_a_face_is() {
    let Some(mut harness) = window(vec![fixture("cadquery/sphere.step")]) else { return };
    assert_eq!(harness.state().open_files(), ["sphere.step"]);
    assert!(harness.state().facts().is_empty());
    click(&mut harness, MIDDLE);
    assert_eq!(fact(harness.state(), "surface").as_deref(), Some("sphere"));
    let radius = fact(harness.state(), "radius").expect("a radius");
    assert!(radius.ends_with(" mm"), "{radius}");
    harness.get_by_label("Copy as text");
    // Nothing is there in the corner.
    click(&mut harness, egui::Pos2::new(320.0, 680.0));
    assert!(harness.state().facts().is_empty());
}

#[test]
fn pictures_change_when_the_model_is_turned_and_cut() {
    let Some(mut harness) = window(vec![fixture("cadquery/bracket.step")]) else { return };
    let first = harness.render().expect("a picture");
    let model = |picture: &image::RgbaImage| {
        let inside = picture.enumerate_pixels().filter(|(x, y, _)| *x > 320 && *y > 40);
        inside.map(|(_, _, p)| p.0).collect::<Vec<_>>()
    };
    let colors: std::collections::BTreeSet<[u8; 4]> = model(&first).into_iter().collect();
    assert!(colors.len() > 100, "{} colours", colors.len());
    harness.key_press(egui::Key::Num1);
    harness.run_steps(3);
    let front = harness.render().expect("a picture");
    assert!(model(&first) != model(&front));
    harness.key_press(egui::Key::X);
    harness.run_steps(3);
    let cut = harness.render().expect("a picture");
    assert!(model(&front) != model(&cut));
    harness.key_press(egui::Key::X);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run_steps(3);
    let back = harness.render().expect("a picture");
    assert!(model(&first) == model(&back));
}

#[test]
fn broken_and_missing_files_leave_a_message_and_the_others() {
    let files = ["broken/empty.step", "cadquery/box.step", "there/is/none.step", "broken/noise.step"];
    let Some(mut harness) = window(files.map(fixture).to_vec()) else { return };
    assert_eq!(harness.state().open_files(), ["box.step"]);
    assert_eq!(harness.state().messages().len(), 3, "{:?}", harness.state().messages());
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::W);
    harness.run_steps(3);
    assert!(harness.state().open_files().is_empty());
    harness.get_by_label("Drop STEP or IGES files here, or press Ctrl+O");
}

#[test]
fn ten_files_at_once_and_the_help() {
    let names = [
        "box",
        "bottle",
        "bracket",
        "capsule",
        "cylinder",
        "sphere",
        "steinmetz",
        "thread",
        "torus",
        "gear_blank",
    ];
    let files = names.map(|name| fixture(&format!("cadquery/{name}.step")));
    let Some(mut harness) = window(files.to_vec()) else { return };
    assert_eq!(harness.state().open_files().len(), 10);
    harness.event(egui::Event::Text("?".to_owned()));
    harness.run_steps(3);
    harness.get_by_label("fit everything");
}

#[test]
fn a_file_that_is_written_again_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("part.step");
    std::fs::copy(fixture("cadquery/box.step"), &path).expect("copied");
    let Some(mut harness) = window(vec![path.clone()]) else { return };
    click(&mut harness, MIDDLE);
    assert_eq!(fact(harness.state(), "surface").as_deref(), Some("plane"));
    std::fs::copy(fixture("cadquery/sphere.step"), &path).expect("copied");
    let mut surface = None;
    for _ in 0..200 {
        std::thread::sleep(Duration::from_millis(50));
        harness.step();
        if harness.state().facts().is_empty() && harness.state().is_idle() {
            click(&mut harness, MIDDLE);
            surface = fact(harness.state(), "surface");
            if surface.as_deref() == Some("sphere") {
                break;
            }
        }
    }
    assert_eq!(surface.as_deref(), Some("sphere"));
    assert_eq!(harness.state().open_files(), ["part.step"]);
    std::fs::remove_file(&path).expect("removed");
    std::thread::sleep(Duration::from_millis(600));
    harness.run_steps(5);
    assert_eq!(harness.state().open_files(), ["part.step"]);
}
