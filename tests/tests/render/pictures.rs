//! What is drawn looks as it did.

use trimloop_render::{Background, Direction, EdgeStyle, Look, Picture};

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
