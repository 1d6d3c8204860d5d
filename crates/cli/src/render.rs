//! `trimloop render`: file to exact model to picture.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use serde::Serialize;
use trimloop_brep::{Model, Severity};
use trimloop_gpu::Gpu;
use trimloop_import::ImportOptions;
use trimloop_render::{
    Background, Camera, Direction, EdgeStyle, Look, MOST_SECTIONS, Names, Painter, Picture, Place,
    Projection, Renderer, Scene, contact_sheet,
};

use crate::arguments::{Edges, RenderArguments, Up};
use crate::contained::contained;
use crate::draft::{self, Draft};
use crate::outcome::Outcome;
use crate::progress::Progress;
use crate::threads;
use crate::{interrupt, manual, message, plan};

/// The picture's height as an angle.
const FOV_Y_RAD: f64 = 0.5;
const SIZE: [u32; 2] = [1280, 960];
const SHEET_SIZE: [u32; 2] = [320, 240];

/// Draws every input; the worst outcome is that of the run.
pub fn run(arguments: &RenderArguments) -> anyhow::Result<Outcome> {
    interrupt::listen()?;
    threads::start(arguments.jobs)?;
    if arguments.pick.is_some() && arguments.inputs.len() > 1 {
        bail!("--pick asks about one input");
    }
    let is_sheet =
        arguments.inputs.len() > 1 && arguments.output.as_deref().is_some_and(|path| !plan::is_folder(path));
    if is_sheet && arguments.turntable.is_some() {
        bail!("--turntable with several inputs needs a folder as output");
    }
    let targets = targets(arguments, is_sheet)?;
    let mut studio = Studio { arguments, is_sheet, gpu: None };
    let mut worst = Outcome::Good;
    let mut sheet = Vec::new();
    for (input, target) in arguments.inputs.iter().zip(targets) {
        let drawn = contained(|| {
            interrupt::check()?;
            studio.draw(input, target.as_deref())
        });
        match drawn {
            Ok((outcome, picture)) => {
                worst = worst.max(outcome);
                sheet.extend(picture.map(|picture| (label(input), picture)));
            }
            Err(_) if interrupt::requested() => return Ok(Outcome::Cancelled),
            Err(error) => {
                eprintln!("error: {}: {}", input.display(), message::of(&error));
                worst = Outcome::Failed;
            }
        }
    }
    if let (true, Some(output), false) = (is_sheet, &arguments.output, sheet.is_empty()) {
        draft::publish(vec![written(output, &contact_sheet(&sheet))?])?;
    }
    Ok(worst)
}

/// Where each input's picture goes; none where all go to one sheet or none is drawn.
fn targets(arguments: &RenderArguments, is_sheet: bool) -> anyhow::Result<Vec<Option<PathBuf>>> {
    let inputs = &arguments.inputs;
    if is_sheet || arguments.pick.is_some() {
        return Ok(vec![None; inputs.len()]);
    }
    let target = |input: &PathBuf| {
        let name = plan::name_for(input, "png");
        match arguments.output.as_deref() {
            Some(folder) if plan::is_folder(folder) => {
                std::fs::create_dir_all(folder)
                    .with_context(|| format!("cannot create the folder `{}`", folder.display()))?;
                Ok(folder.join(name))
            }
            Some(file) => match file.extension() {
                Some(e) if e.eq_ignore_ascii_case("png") => Ok(file.to_path_buf()),
                _ if file.exists() => Ok(file.to_path_buf()),
                _ => bail!("cannot write `{}`: the output is a .png or a folder", file.display()),
            },
            None => Ok(input.with_file_name(name)),
        }
    };
    let all: Vec<PathBuf> = inputs.iter().map(target).collect::<anyhow::Result<_>>()?;
    for (k, path) in all.iter().enumerate() {
        if all[..k].contains(path) {
            bail!("two inputs would both be drawn to `{}`", path.display());
        }
        if inputs.contains(path) {
            bail!("`{}` is an input", path.display());
        }
    }
    Ok(all.into_iter().map(Some).collect())
}

/// What all inputs are drawn with.
struct Studio<'a> {
    arguments: &'a RenderArguments,
    is_sheet: bool,
    /// `None` until it is looked for, `Some(None)` where there is none.
    gpu: Option<Option<Gpu>>,
}

impl Studio<'_> {
    /// Draws one input; its picture where it goes on a sheet.
    fn draw(&mut self, input: &Path, target: Option<&Path>) -> anyhow::Result<(Outcome, Option<Picture>)> {
        let arguments = self.arguments;
        if let Some(target) = target {
            // Now rather than after minutes of work: can the output be written?
            drop(Draft::beside(target)?);
        }
        let model = trimloop_import::read(input, &ImportOptions::default())?;
        let progress = Progress::new(model.parts.iter().map(|part| part.faces.len()).sum(), arguments.quiet);
        let mut scene = Scene::new(&model, &progress)?;
        drop(progress);
        self.choose(&model, &mut scene)?;
        let mut look = self.look();
        if arguments.section.len() > MOST_SECTIONS {
            bail!("--section may be given {MOST_SECTIONS} times at most");
        }
        if !arguments.section.is_empty() {
            let progress = Progress::new(scene.face_count(), arguments.quiet);
            look.sections = scene.cap(&model, &arguments.section, &progress)?;
        }
        let outcome = tell(input, &model, &scene, arguments);
        let subject = self.subject(&model, &scene)?;
        let mut renderer = self.painter(&model, scene)?;
        let size = self.size();
        let camera = |direction: Direction| self.camera(&subject, direction, size);
        if let Some([x, y]) = arguments.pick {
            if x >= size[0] || y >= size[1] {
                bail!("the picture has {} x {} pixels, and {x},{y} is none of them", size[0], size[1]);
            }
            let found = renderer.pick(&camera(arguments.view)?, size, &look, [x, y])?;
            manual::print((picked(&model, &renderer, found)? + "\n").as_bytes())?;
            return Ok((outcome, None));
        }
        let Some(target) = target else {
            let picture =
                renderer.picture(&camera(arguments.view)?, size, &look, &self.steps(size, &look))?;
            return Ok((outcome, Some(picture)));
        };
        let mut drafts = Vec::new();
        let count = arguments.turntable.unwrap_or(1);
        let frames = Progress::counting(
            if count > 1 { count as usize } else { 0 },
            "pictures",
            count == 1 || arguments.quiet,
        );
        for frame in 0..count {
            interrupt::check()?;
            let turn = 360.0 * f64::from(frame) / f64::from(count);
            let direction = Direction { azimuth_deg: arguments.view.azimuth_deg + turn, ..arguments.view };
            let steps = self.steps(size, &look);
            let picture = renderer.picture(&camera(direction)?, size, &look, &steps)?;
            drop(steps);
            let path = if arguments.turntable.is_some() {
                numbered(target, frame + 1, count)
            } else {
                target.into()
            };
            drafts.push(written(&path, &picture)?);
            frames.add(1);
            if let Some(statistics) = renderer.statistics() {
                if arguments.verbose {
                    eprintln!("{}: {statistics}", path.display());
                }
                if statistics.screen_error_px > look.screen_error_px && !arguments.quiet {
                    let px = statistics.screen_error_px;
                    eprintln!(
                        "warning: {}: not enough graphics memory, drawn within {px} px",
                        path.display()
                    );
                }
            }
        }
        drop(frames);
        draft::publish(drafts)?;
        Ok((outcome, None))
    }

    /// Progress of a picture that takes many steps; of others only the wish to stop is passed on.
    fn steps(&self, size: [u32; 2], look: &Look) -> Progress {
        let steps = Renderer::steps(size, look);
        let is_quiet = self.arguments.quiet || steps < 8 || self.arguments.turntable.is_some();
        Progress::counting(steps, "tiles", is_quiet)
    }

    /// Hides what is not wanted.
    fn choose(&self, model: &Model, scene: &mut Scene) -> anyhow::Result<()> {
        let RenderArguments { only, hide, .. } = self.arguments;
        if !only.is_empty() {
            let wanted = Names::new(only).instances(model, scene);
            if !wanted.contains(&true) {
                bail!("nothing in it has the name `{}`", only.join("`, `"));
            }
            scene.instances.iter_mut().zip(wanted).for_each(|(i, wanted)| i.is_shown &= wanted);
        }
        let unwanted = Names::new(hide).instances(model, scene);
        if !hide.is_empty() && !unwanted.contains(&true) {
            eprintln!("warning: nothing in it has the name `{}`", hide.join("`, `"));
        }
        scene.instances.iter_mut().zip(unwanted).for_each(|(i, unwanted)| i.is_shown &= !unwanted);
        Ok(())
    }

    /// Points of what fills the picture.
    fn subject(&self, model: &Model, scene: &Scene) -> anyhow::Result<Vec<glam::DVec3>> {
        let fit = &self.arguments.fit;
        let all = scene.outline();
        if all.is_empty() {
            let reason = scene.diagnostics.first().map_or(String::new(), |d| format!(", e.g. {}", d.message));
            bail!("nothing in it can be drawn: every face is empty, hidden or lost{reason}");
        }
        if fit.is_empty() {
            return Ok(all);
        }
        let wanted = Names::new(fit).instances(model, scene);
        let points = scene.outline_of(|index| wanted[index]);
        if points.is_empty() {
            bail!("nothing that is shown has the name `{}`", fit.join("`, `"));
        }
        Ok(points)
    }

    fn painter(&mut self, model: &Model, scene: Scene) -> anyhow::Result<Painter> {
        let quiet = self.arguments.quiet;
        let gpu = self.gpu.get_or_insert_with(|| {
            let opened = Gpu::headless();
            if let (Err(error), false) = (&opened, quiet) {
                eprintln!("warning: {error}; drawing triangles on the CPU instead");
            }
            opened.ok()
        });
        let progress =
            Progress::new(if gpu.is_none() { scene.face_count() } else { 0 }, gpu.is_some() || quiet);
        Ok(Painter::new(gpu.as_ref(), model, scene, &progress)?)
    }

    fn size(&self) -> [u32; 2] {
        self.arguments.size.unwrap_or(if self.is_sheet { SHEET_SIZE } else { SIZE })
    }

    fn camera(&self, points: &[glam::DVec3], direction: Direction, size: [u32; 2]) -> anyhow::Result<Camera> {
        let projection = if self.arguments.ortho {
            Projection::Parallel { height_mm: 1.0 }
        } else {
            Projection::Perspective { fov_y_rad: FOV_Y_RAD }
        };
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        Camera::fit(points, direction, self.up(), projection, aspect).context("nothing in it has a place")
    }

    fn up(&self) -> trimloop_render::Up {
        match self.arguments.up {
            Up::Y => trimloop_render::Up::Y,
            Up::Z => trimloop_render::Up::Z,
        }
    }

    fn look(&self) -> Look {
        let arguments = self.arguments;
        let standard = Look::default();
        let clear = Background::Plain(trimloop_brep::Rgba { r: 1.0, g: 1.0, b: 1.0, a: 0.0 });
        let background = arguments.background.unwrap_or(standard.background);
        Look {
            background: if arguments.transparent { clear } else { background },
            edges: match arguments.edges {
                Edges::None => EdgeStyle::None,
                Edges::Visible => EdgeStyle::Visible,
                Edges::Hidden => EdgeStyle::Hidden,
            },
            samples: arguments.samples,
            screen_error_px: arguments.screen_error,
            up: self.up(),
            lod: arguments.lod,
            ..standard
        }
    }
}

/// What a picture is called on a sheet.
fn label(input: &Path) -> String {
    input.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Says what is wrong with the file; the outcome that it means.
fn tell(input: &Path, model: &Model, scene: &Scene, arguments: &RenderArguments) -> Outcome {
    let all = || model.diagnostics.iter().chain(&scene.diagnostics);
    let is_told = |severity: Severity| arguments.verbose || severity == Severity::Error;
    if !arguments.quiet {
        for d in all().filter(|d| is_told(d.severity)) {
            eprintln!("{}: {}: {}: {}", input.display(), d.severity.as_str(), d.entity, d.message);
        }
    }
    if all().any(|d| d.severity == Severity::Error) { Outcome::Incomplete } else { Outcome::Good }
}

/// A PNG file that is not in its place yet.
fn written(path: &Path, picture: &Picture) -> anyhow::Result<Draft> {
    let mut draft = Draft::beside(path)?;
    let failed = || format!("cannot write `{}`", path.display());
    draft.write_all(&picture.to_png()?).with_context(failed)?;
    draft.flush().with_context(failed)?;
    Ok(draft)
}

/// `gear.png` becomes `gear_007.png`.
fn numbered(path: &Path, number: u32, count: u32) -> PathBuf {
    let digits = count.to_string().len().max(3);
    let mut name = path.file_stem().unwrap_or_default().to_os_string();
    name.push(format!("_{number:0digits$}.png"));
    path.with_file_name(name)
}

/// What a pixel shows.
#[derive(Debug, Serialize)]
struct Picked<'a> {
    instance: usize,
    node: &'a str,
    part: &'a str,
    face: String,
    #[serde(skip_serializing_if = "str::is_empty")]
    face_name: &'a str,
    surface: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_mm: Option<f64>,
    uv: [f64; 2],
    point_mm: [f64; 3],
    normal: [f64; 3],
}

fn picked(model: &Model, renderer: &Painter, found: Option<Place>) -> anyhow::Result<String> {
    let Some(place) = found else { return Ok("null".to_owned()) };
    let scene = renderer.scene();
    let instance = &scene.instances[place.instance];
    let own = &scene.parts[instance.part];
    let face = model.parts.get(instance.part).map(|part| &part.faces[place.face]);
    let picked = Picked {
        instance: place.instance,
        node: instance.node.map_or("", |node| &model.nodes[node].name),
        part: &own.name,
        face: own.faces[place.face].entity.to_string(),
        face_name: face.map_or("", |face| &face.name),
        surface: face.map_or("section", crate::report::surface_kind),
        radius_mm: place.radius_mm,
        uv: place.uv.to_array(),
        point_mm: place.point.to_array(),
        normal: place.normal.to_array(),
    };
    Ok(serde_json::to_string_pretty(&picked)?)
}
