//! The viewer in real windows, driven as by a person and photographed.

use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use trimloop_render::Picture;
use trimloop_tests::fixture;
use trimloop_tests::screenshots::{SCENES, SIZE};
use trimloop_tests::window::{Window, With, is_possible, key};

const PROGRAM: &str = env!("CARGO_BIN_EXE_trimloop");
/// Letters and lines may be drawn a little differently by other versions of what draws them.
const MEAN: f64 = 0.01;
const WORST_REGION: f64 = 0.35;

/// One window at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// Whether windows can be opened here; where they must be and cannot, the test fails.
fn has_display() -> bool {
    let is_required = std::env::var_os("TRIMLOOP_REQUIRE_GPU").is_some();
    let has = is_possible();
    assert!(has || !is_required, "Xvfb is needed to open windows");
    if !has {
        eprintln!("SKIPPED, nothing was tested: there is no Xvfb");
    }
    has
}

#[test]
fn windows_look_as_they_did() {
    if !has_display() {
        return;
    }
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = fixture::folder().with_file_name("docs").join("screenshots");
    let mut wrong = Vec::new();
    for scene in &SCENES {
        let path = folder.join(scene.name).with_extension("png");
        let kept = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let kept = Picture::from_png(&kept).expect("a picture");
        let own =
            scene.photograph(Path::new(PROGRAM)).unwrap_or_else(|error| panic!("{}: {error}", scene.name));
        let difference = own.difference(&kept).expect("the same size");
        if difference.mean > MEAN || difference.worst_region > WORST_REGION {
            let now = Path::new(env!("CARGO_TARGET_TMPDIR")).join(scene.name).with_extension("png");
            std::fs::write(&now, own.to_png().expect("a picture")).expect("written");
            wrong.push(format!("{}: {difference:?}, see {}", scene.name, now.display()));
        }
    }
    assert!(wrong.is_empty(), "{}\n(cargo xtask screenshots makes them anew)", wrong.join("\n"));
}

#[test]
fn a_window_turns_comes_back_and_outlives_its_device() {
    if !has_display() {
        return;
    }
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let good = fixture::folder().join("cadquery/box.step");
    let plain = ["view".as_ref(), good.as_os_str()];
    let mut window = Window::open(Path::new(PROGRAM), plain, SIZE).expect("a window");
    let picture = window.started().expect("a picture");
    // A turn, and back.
    window.drag(1, [700, 500], [800, 540]).expect("a drag");
    assert!(window.settled().expect("a picture") != picture);
    window.press(b'z', With::Control).expect("a key");
    window.move_to([350, 840]).expect("moved");
    assert!(window.settled().expect("a picture").difference(&picture).expect("one size").mean < MEAN);
    window.press(key::F5, With::Nothing).expect("a key");
    window.settled().expect("a picture");
    assert!(window.is_alive());
    drop(window);
    // The device is destroyed as soon as the file is there: another window comes, with the file and a message.
    let losing = ["view".as_ref(), "--lose-device".as_ref(), good.as_os_str()];
    let mut window = Window::open(Path::new(PROGRAM), losing, SIZE).expect("a window");
    std::thread::sleep(std::time::Duration::from_secs(4));
    assert!(window.is_alive());
    window.await_window().expect("another window");
    let again = window.started().expect("a picture");
    assert!(window.is_alive());
    // The model is there, as it was before, above the message.
    assert_eq!(again.pixel(800, 400), picture.pixel(800, 400));
}

#[test]
fn a_picture_is_saved_where_there_is_no_file_dialog() {
    if !has_display() {
        return;
    }
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("part.step");
    std::fs::copy(fixture::folder().join("cadquery/bracket.step"), &file).expect("copied");
    let window =
        Window::open(Path::new(PROGRAM), ["view".as_ref(), file.as_os_str()], SIZE).expect("a window");
    window.started().expect("a picture");
    window.press(b's', With::Control).expect("a key");
    // A line with the path beside the file, which only needs to be confirmed.
    let pause = || std::thread::sleep(std::time::Duration::from_secs(2));
    pause();
    window.press(key::RETURN, With::Nothing).expect("a key");
    let png = folder.path().join("part.png");
    (0..30).take_while(|_| !png.exists()).for_each(|_| pause());
    let png = std::fs::read(png).expect("a file");
    let picture = Picture::from_png(&png).expect("a picture");
    assert_eq!(picture.height, 1440);
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 2);
}

#[test]
fn without_a_display_or_a_device_that_is_said() {
    let file = fixture::folder().join("cadquery/box.step");
    let run = |variables: &[(&str, &str)]| {
        let mut command = Command::new(PROGRAM);
        command.arg("view").arg(&file).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        command.envs(variables.iter().copied());
        let output = command.output().expect("it runs");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, text) = run(&[]);
    assert_eq!(code, Some(2), "{text}");
    assert!(text.contains("no window can be opened"), "{text}");
    assert!(!text.contains("panicked"), "{text}");
}
