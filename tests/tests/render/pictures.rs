//! What is drawn looks as it did.

use glam::{DAffine3, DVec3};
use trimloop_brep::{Model, Node};
use trimloop_render::{Background, Direction, EdgeStyle, Look, Paint, Picture};

use crate::{camera, model, renderer, scene};

const SIZE: [u32; 2] = [320, 240];

const MODELS: [&str; 10] = [
    "assembly_nested",
    "assembly_transparent",
    "bottle",
    "bspline_creased",
    "colour_per_face",
    "pipe_tee",
    "plate_perforated",
    "spring_conical",
    "thread",
    "wires",
];

fn path(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("ref").join(format!("{name}.png"))
}

/// Holds a picture against the one in `tests/ref`; with `TRIMLOOP_BLESS` set it is written there instead.
fn looks_as_before(name: &str, picture: &Picture) -> Result<(), String> {
    let path = path(name);
    if std::env::var_os("TRIMLOOP_BLESS").is_some() {
        std::fs::write(path, picture.to_png().expect("encoded")).expect("written");
        return Ok(());
    }
    let bytes = std::fs::read(&path).map_err(|error| format!("{name}: {error}"))?;
    let before = Picture::from_png(&bytes).map_err(|error| format!("{name}: {error}"))?;
    let difference = picture.difference(&before).ok_or_else(|| format!("{name}: another size"))?;
    // A drawing that is off by a few pixels at edges is the same one; a face that is gone is not.
    match difference.worst_region < 0.03 && difference.mean < 0.002 {
        true => Ok(()),
        false => Err(format!("{name}: {difference:?}")),
    }
}

#[test]
fn pictures_look_as_they_did() {
    let mut wrong = Vec::new();
    for name in MODELS {
        let Some(mut renderer) = renderer(&format!("cadquery/{name}.step")) else { return };
        let camera = camera(renderer.scene(), Direction::ISO, SIZE);
        let picture = renderer.picture(&camera, SIZE, &Look::default()).expect("a picture");
        wrong.extend(looks_as_before(name, &picture).err());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn sections_hidden_edges_and_clear_backgrounds() {
    let name = "cadquery/hollow_ball.step";
    let Some(gpu) = crate::GPU.as_ref() else { return };
    let model = model(name);
    let mut scene = scene(&model);
    let plane = trimloop_render::Section { normal: glam::DVec3::X, offset_mm: scene.bounds().center().x };
    let sections = scene.cap(&model, &[plane], &trimloop_mesh::Silent).expect("capped");
    let camera = camera(&scene, Direction { azimuth_deg: 60.0, elevation_deg: 20.0 }, SIZE);
    let mut renderer = trimloop_render::Renderer::new(gpu, scene).expect("a renderer");
    let look = Look {
        sections,
        edges: EdgeStyle::Hidden,
        background: Background::Plain(trimloop_brep::Rgba { r: 1.0, g: 1.0, b: 1.0, a: 0.0 }),
        ..Look::default()
    };
    let picture = renderer.picture(&camera, SIZE, &look).expect("a picture");
    looks_as_before("section", &picture).expect("as before");
    assert_eq!(picture.pixel(0, 0)[3], 0);
    assert_eq!(picture.pixel(160, 120)[3], 255);
}

#[test]
fn colours_tell_the_radius_of_curvature() {
    let name = "cadquery/sphere.step";
    let Some(gpu) = crate::GPU.as_ref() else { return };
    let scene = scene(&model(name));
    let camera = camera(&scene, Direction::ISO, SIZE);
    let mut renderer = trimloop_render::Renderer::new(gpu, scene).expect("a renderer");
    // The ball's radius is 10 mm: at the end of the scale it is red, in its middle green, far below blue.
    for (tightest_mm, strongest) in [(10.0, 0), (5.0, 1), (0.01, 2)] {
        let look =
            Look { paint: Paint::Curvature { tightest_mm }, edges: EdgeStyle::None, ..Look::default() };
        let picture = renderer.picture(&camera, SIZE, &look).expect("a picture");
        let pixel = picture.pixel(SIZE[0] / 2, SIZE[1] / 2);
        let others = (0..3).filter(|k| *k != strongest).map(|k| pixel[k]).max().expect("two");
        assert!(pixel[strongest] > others + 60, "{tightest_mm}: {pixel:?}");
    }
}

#[test]
fn a_picture_in_parcels_ends_as_the_whole() {
    let Some(gpu) = crate::GPU.as_ref() else { return };
    // Ten parts of 58 faces, beside each other.
    let one = model("cadquery/gear_blank.step");
    let node = |k: usize| Node {
        part: Some(k),
        transform: DAffine3::from_translation(DVec3::new(100.0 * k as f64, 0.0, 0.0)),
        ..Node::default()
    };
    let ten = Model {
        parts: vec![one.parts[0].clone(); 10],
        nodes: (0..10).map(node).collect(),
        roots: (0..10).collect(),
        ..Model::default()
    };
    let scene = scene(&ten);
    let camera = camera(&scene, Direction::ISO, SIZE);
    let mut renderer = trimloop_render::Renderer::new(gpu, scene).expect("a renderer");
    let look = Look::default();
    let mut complete = Vec::new();
    while complete.last() != Some(&true) && complete.len() < 100 {
        renderer.paint(&camera, SIZE, &look, std::time::Duration::ZERO).expect("painted");
        assert!(renderer.statistics().evaluated > 0, "{complete:?}");
        complete.push(renderer.statistics().is_complete);
    }
    assert!(complete.len() > 1 && complete.last() == Some(&true), "{complete:?}");
    // Nothing is left to evaluate.
    renderer.picture(&camera, SIZE, &look).expect("a picture");
    assert_eq!(renderer.statistics().evaluated, 0);
}
