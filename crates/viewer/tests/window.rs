//! The window as a person uses it, without a display: files are opened, turned, picked and closed.

use std::path::PathBuf;
use std::time::Duration;

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec3;
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
        App::new(&context.egui_ctx, context.wgpu_render_state.as_ref(), context.storage, options)
            .expect("a device")
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

/// Until it is known what the picture shows, which is found out when the view has been at rest for a moment.
fn rest(harness: &mut Harness<'_, App>) {
    std::thread::sleep(Duration::from_millis(100));
    settle(harness);
}

fn fact(app: &App, name: &str) -> Option<String> {
    app.facts().into_iter().find(|(own, _)| own == name).map(|(_, value)| value)
}

/// Presses a key and waits for what comes of it.
fn press(harness: &mut Harness<'_, App>, key: egui::Key) {
    harness.key_press(key);
    harness.run_steps(3);
    settle(harness);
}

/// The pixels of the model's view.
fn pixels(harness: &mut Harness<'_, App>) -> Vec<[u8; 4]> {
    let picture = harness.render().expect("a picture");
    let inside = picture.enumerate_pixels().filter(|(x, y, _)| *x > 335 && *y > 40);
    inside.map(|(_, _, p)| p.0).collect()
}

/// Clicks where a place of the model is drawn.
fn click_on(harness: &mut Harness<'_, App>, place: [f64; 3], is_added: bool) {
    let at = harness.state().place_of(DVec3::from(place)).expect("in the picture");
    let modifiers = if is_added { egui::Modifiers::SHIFT } else { egui::Modifiers::NONE };
    harness.hover_at(at);
    harness.step();
    harness.event_modifiers(egui::Event::PointerMoved(at), modifiers);
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        harness
            .event_modifiers(egui::Event::PointerButton { pos: at, button, pressed, modifiers }, modifiers);
        harness.step();
    }
    harness.run_steps(2);
    settle(harness);
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
    settle(harness);
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
    click(&mut harness, egui::Pos2::new(345.0, 680.0));
    assert!(harness.state().facts().is_empty());
}

#[test]
fn pictures_change_when_the_model_is_turned_and_cut() {
    let Some(mut harness) = window(vec![fixture("cadquery/bracket.step")]) else { return };
    let first = harness.render().expect("a picture");
    let model = |picture: &image::RgbaImage| {
        let inside = picture.enumerate_pixels().filter(|(x, y, _)| *x > 335 && *y > 40);
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
    // A second plane, across another axis, cuts off more.
    harness.get_by_label("2").click();
    harness.run_steps(2);
    press(&mut harness, egui::Key::X);
    let both = harness.render().expect("a picture");
    assert!(model(&cut) != model(&both));
    press(&mut harness, egui::Key::X);
    harness.get_by_label("1 on").click();
    harness.run_steps(2);
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

/// A number at the beginning of a fact.
fn value(app: &App, name: &str) -> f64 {
    let text = fact(app, name).unwrap_or_else(|| panic!("{name} in {:?}", app.facts()));
    let digits: String = text.chars().take_while(|c| c.is_ascii_digit() || "-.".contains(*c)).collect();
    digits.parse().unwrap_or_else(|_| panic!("{name}: {text}"))
}

#[test]
fn vertices_edges_and_faces_are_picked_and_measured() {
    let Some(mut harness) = window(vec![fixture("cadquery/box.step")]) else { return };
    let size = box_of(&harness);
    let [x, y, z] = [size[1].x, size[0].y, size[1].z];
    let middle = 0.5 * (size[0] + size[1]);
    // The upper face, an edge of it, a corner of it: the eye is in front of them, to the right.
    click_on(&mut harness, [middle.x, middle.y, z], false);
    assert_eq!(fact(harness.state(), "surface").as_deref(), Some("plane"));
    let extent = size[1] - size[0];
    assert!((value(harness.state(), "area") - extent.x * extent.y).abs() < 1e-5);
    click_on(&mut harness, [middle.x, y, z], false);
    assert_eq!(fact(harness.state(), "kind").as_deref(), Some("line"));
    assert!((value(harness.state(), "length") - extent.x).abs() < 1e-5);
    click_on(&mut harness, [x, y, z], false);
    assert!(fact(harness.state(), "vertex").is_some(), "{:?}", harness.state().facts());
    // From that corner to the edge on the other side.
    click_on(&mut harness, [middle.x, size[1].y, z], true);
    assert!((value(harness.state(), "distance") - extent.y).abs() < 1e-5);
    // Two faces at a right angle.
    click_on(&mut harness, [middle.x, middle.y, z], false);
    click_on(&mut harness, [middle.x, y, middle.z], true);
    assert!((value(harness.state(), "angle") - 90.0).abs() < 1e-9);
    assert_eq!(value(harness.state(), "distance"), 0.0);
    // A measure survives the section and stays when it is kept.
    press(&mut harness, egui::Key::M);
    press(&mut harness, egui::Key::X);
    assert!((value(harness.state(), "angle") - 90.0).abs() < 1e-9);
    press(&mut harness, egui::Key::Escape);
    assert!(harness.state().facts().is_empty());
    harness.get_by_label("Section").click();
    harness.run_steps(2);
    harness.get_by_label("through the selection");
    harness.get_by_label("Selection").click();
    harness.run_steps(2);
    harness.get_by_label("0 mm");
}

/// The box of the box: its corners as the file's facts have them.
fn box_of(harness: &Harness<'_, App>) -> [DVec3; 2] {
    let model =
        trimloop_import::read(&fixture("cadquery/box.step"), &trimloop_import::ImportOptions::default())
            .expect("a model");
    assert_eq!(harness.state().open_files(), ["box.step"]);
    let points = || model.parts[0].vertices.iter().map(|v| v.point);
    [points().reduce(DVec3::min).expect("points"), points().reduce(DVec3::max).expect("points")]
}

#[test]
fn every_display_looks_different_and_comes_back() {
    let Some(mut harness) = window(vec![fixture("cadquery/bracket.step")]) else { return };
    harness.hover_at(egui::Pos2::new(10.0, 690.0));
    let first = pixels(&mut harness);
    let mut seen = vec![first.clone()];
    for _ in 0..4 {
        press(&mut harness, egui::Key::E);
        let own = pixels(&mut harness);
        assert!(!seen.contains(&own), "mode {}", seen.len());
        seen.push(own);
    }
    press(&mut harness, egui::Key::E);
    assert!(first == pixels(&mut harness));
    harness.get_by_label("Appearance").click();
    harness.run_steps(2);
    for colors in ["by part", "by kind of surface", "by curvature"] {
        harness.get_by_label("colours").click();
        harness.run_steps(3);
        harness.get_by_label(colors).click();
        harness.run_steps(3);
        settle(&mut harness);
        harness.hover_at(egui::Pos2::new(10.0, 690.0));
        harness.run_steps(2);
        let own = pixels(&mut harness);
        assert!(!seen.contains(&own), "{colors}");
        seen.push(own);
    }
}

/// An assembly of the fixtures.
const ASSEMBLY: &str = "cadquery/assembly_flat.step";

#[test]
fn parts_are_found_hidden_isolated_and_taken_apart() {
    let Some(mut harness) = window(vec![fixture(ASSEMBLY)]) else { return };
    harness.hover_at(egui::Pos2::new(10.0, 690.0));
    harness.run_steps(2);
    let whole = pixels(&mut harness);
    click(&mut harness, MIDDLE);
    let part = fact(harness.state(), "part").expect("a part");
    press(&mut harness, egui::Key::I);
    press(&mut harness, egui::Key::Escape);
    let alone = pixels(&mut harness);
    assert!(whole != alone, "{part}");
    press(&mut harness, egui::Key::A);
    harness.hover_at(egui::Pos2::new(10.0, 690.0));
    harness.run_steps(2);
    assert!(whole == pixels(&mut harness));
    click(&mut harness, MIDDLE);
    press(&mut harness, egui::Key::H);
    press(&mut harness, egui::Key::Escape);
    assert!(whole != pixels(&mut harness));
    press(&mut harness, egui::Key::A);
}

#[test]
fn what_is_shown_is_exported_compared_and_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let Some(mut harness) = window(vec![fixture("cadquery/bracket.step")]) else { return };
    let glb = folder.path().join("bracket.glb");
    harness.state_mut().export_to(glb.clone());
    settle(&mut harness);
    assert!(harness.state().messages().is_empty(), "{:?}", harness.state().messages());
    assert!(harness.state().notes()[0].contains("no face lost"), "{:?}", harness.state().notes());
    let file = gltf::Gltf::open(&glb).expect("a valid file");
    assert_eq!(file.meshes().count(), 1);
    // It is as far from the exact model as it was allowed to be: 0.1 % of the size.
    let before = pixels(&mut harness);
    harness.state_mut().compare_with(glb.clone());
    settle(&mut harness);
    harness.run_steps(3);
    assert!(harness.state().messages().is_empty(), "{:?}", harness.state().messages());
    assert!(before != pixels(&mut harness));
    harness.state_mut().compare_with(fixture("broken/noise.step"));
    settle(&mut harness);
    assert_eq!(harness.state().messages().len(), 1);
    let png = folder.path().join("bracket.png");
    harness.state_mut().picture_to(&png, [320, 240]);
    let picture = image::open(&png).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (320, 240));
    harness.state_mut().picture_to(&folder.path().join("no/such/folder.png"), [320, 240]);
    assert_eq!(harness.state().messages().len(), 2);
    harness.state_mut().export_to(folder.path().join("no/such/folder.glb"));
    settle(&mut harness);
    assert_eq!(harness.state().messages().len(), 3);
    // Nothing half-written stays behind.
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 2);
}

#[test]
fn the_cube_touchpads_and_wheels_turn_and_zoom() {
    let Some(mut harness) = window(vec![fixture("cadquery/box.step")]) else { return };
    let first = harness.state().view();
    let wheel = |source, unit, delta| egui::Event::MouseWheel {
        unit,
        delta,
        phase: egui::TouchPhase::Move,
        source,
        modifiers: egui::Modifiers::NONE,
    };
    harness.hover_at(MIDDLE);
    harness.step();
    harness.event(wheel(
        egui::MouseWheelSource::Trackpad,
        egui::MouseWheelUnit::Point,
        egui::Vec2::new(40.0, 0.0),
    ));
    harness.run_steps(10);
    let turned = harness.state().view();
    assert!(turned.direction != first.direction && turned.distance_mm == first.distance_mm);
    harness.event(wheel(
        egui::MouseWheelSource::Wheel,
        egui::MouseWheelUnit::Line,
        egui::Vec2::new(0.0, 1.0),
    ));
    harness.run_steps(10);
    let nearer = harness.state().view();
    assert!(nearer.direction == turned.direction && nearer.distance_mm < turned.distance_mm);
    // The upper side of the cube in the corner.
    press(&mut harness, egui::Key::Num1);
    click(&mut harness, egui::Pos2::new(1000.0 - 62.0, 27.0 + 62.0 - 21.0));
    let cube = harness.state().view().direction;
    assert!((cube.elevation_deg - 45.0).abs() < 1.0, "{cube:?}");
}

/// What is kept between starts, in memory.
#[derive(Default)]
struct Kept(std::collections::HashMap<String, String>);

impl eframe::Storage for Kept {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

#[test]
fn settings_and_recent_files_are_kept() {
    let Some(mut harness) = window(vec![fixture("cadquery/box.step")]) else { return };
    let mut kept = Kept::default();
    press(&mut harness, egui::Key::P);
    eframe::App::save(harness.state_mut(), &mut kept);
    let text = kept.0.values().next().expect("settings").clone();
    assert!(text.contains("box.step") && text.contains("is_parallel:true"), "{text}");
    let build = |context: &mut eframe::CreationContext<'_>| {
        let state = context.wgpu_render_state.as_ref();
        App::new(&context.egui_ctx, state, Some(&kept), ViewOptions::default()).expect("a device")
    };
    let next = Harness::builder().with_size([800.0, 600.0]).wgpu().build_eframe(build);
    assert!(next.state().view().is_parallel);
    // What cannot be read is as good as nothing.
    kept.0.values_mut().for_each(|text| *text = "(nonsense".to_owned());
    let build = |context: &mut eframe::CreationContext<'_>| {
        let state = context.wgpu_render_state.as_ref();
        App::new(&context.egui_ctx, state, Some(&kept), ViewOptions::default()).expect("a device")
    };
    let next = Harness::builder().with_size([800.0, 600.0]).wgpu().build_eframe(build);
    assert!(!next.state().view().is_parallel);
}

#[test]
fn every_file_has_its_own_view_and_stays_in_front_when_others_go() {
    let files = ["cadquery/box.step", "cadquery/sphere.step", "cadquery/torus.step"].map(fixture);
    let Some(mut harness) = window(files.to_vec()) else { return };
    // In the order in which they were asked for, whichever was read first.
    let names = harness.state().open_files();
    assert_eq!(names, ["box.step", "sphere.step", "torus.step"]);
    harness.get_by_label(&names[1]).click();
    harness.run_steps(3);
    press(&mut harness, egui::Key::Num1);
    let front = harness.state().view();
    harness.get_by_label(&names[2]).click();
    harness.run_steps(3);
    assert!(harness.state().view() != front);
    harness.get_by_label(&names[1]).click();
    harness.run_steps(3);
    assert_eq!(harness.state().view(), front);
    // The first one is closed with the middle button: the second stays in front.
    harness.get_by_label(&names[0]).click_button(egui::PointerButton::Middle);
    harness.run_steps(4);
    assert_eq!(harness.state().open_files(), names[1..]);
    assert_eq!(harness.state().view(), front);
    // What is open already is not opened twice.
    harness.state_mut().open(fixture("cadquery/sphere.step"));
    settle(&mut harness);
    assert_eq!(harness.state().open_files().len(), 2);
}

#[test]
fn parts_are_weighed() {
    let Some(mut harness) = window(vec![fixture("cadquery/box.step")]) else { return };
    let row = (egui::accesskit::Role::Button, "SOLID  (6 faces)");
    harness.get_by_role_and_label(row.0, row.1).click();
    harness.run_steps(3);
    settle(&mut harness);
    let size = box_of(&harness);
    let extent = size[1] - size[0];
    assert!((value(harness.state(), "volume") - extent.element_product()).abs() < 1e-5);
    assert_eq!(fact(harness.state(), "centre of gravity").as_deref(), Some("0, 0, 0 mm"));
    // It is kept once, and what is not selected any more cannot be kept.
    press(&mut harness, egui::Key::M);
    press(&mut harness, egui::Key::M);
    press(&mut harness, egui::Key::Escape);
    press(&mut harness, egui::Key::M);
    assert_eq!(harness.query_all_by_label_contains(" mm³").count(), 1);
}

#[test]
fn the_wheel_goes_to_the_place_under_the_mouse_and_never_past_it() {
    let Some(mut harness) = window(vec![fixture("cadquery/box.step")]) else { return };
    let size = box_of(&harness);
    let corner = DVec3::new(size[1].x, size[0].y, size[1].z);
    // A place of the upper face, near the corner that is nearest to the eye.
    let place = corner + DVec3::new(-0.5, 0.5, 0.0);
    let at = harness.state().place_of(place).expect("in the picture");
    harness.hover_at(at);
    rest(&mut harness);
    for _ in 0..40 {
        harness.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta: egui::Vec2::new(0.0, 2.0),
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: egui::Modifiers::NONE,
        });
        harness.run_steps(2);
    }
    harness.run_steps(10);
    settle(&mut harness);
    let view = harness.state().view();
    assert!(view.distance_mm < 1.0, "{}", view.distance_mm);
    let now = harness.state().place_of(place).expect("in front of the eye");
    assert!(now.distance(at) < 3.0, "{at} {now}");
    click(&mut harness, at);
    assert_eq!(fact(harness.state(), "surface").as_deref(), Some("plane"));
    // And back, in one step.
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run_steps(3);
    assert!(harness.state().view().distance_mm > 10.0);
}

#[test]
fn what_is_hidden_stays_hidden_when_the_file_is_written_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("part.step");
    std::fs::copy(fixture(ASSEMBLY), &path).expect("copied");
    let Some(mut harness) = window(vec![path.clone()]) else { return };
    let outside = egui::Pos2::new(10.0, 690.0);
    click(&mut harness, MIDDLE);
    press(&mut harness, egui::Key::H);
    press(&mut harness, egui::Key::Escape);
    harness.hover_at(outside);
    harness.run_steps(2);
    let before = pixels(&mut harness);
    // The bolt gets another name, which tells that it was read again.
    let text = std::fs::read_to_string(&path).expect("a file");
    assert!(text.contains("PRODUCT('bolt','bolt'") && harness.query_by_label_contains("renamed").is_none());
    std::fs::write(&path, text.replace("PRODUCT('bolt','bolt'", "PRODUCT('bolt','renamed'"))
        .expect("written");
    for _ in 0..200 {
        std::thread::sleep(Duration::from_millis(50));
        harness.step();
        if harness.query_all_by_label_contains("renamed").next().is_some() {
            break;
        }
    }
    settle(&mut harness);
    harness.run_steps(3);
    assert!(harness.query_all_by_label_contains("renamed").next().is_some());
    assert!(before == pixels(&mut harness));
}
