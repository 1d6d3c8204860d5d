//! Files that are open.

use std::collections::HashSet;
use std::path::PathBuf;

use trimloop_brep::{Diagnostic, EntityRef, Model, Severity};
use trimloop_gpu::Gpu;
use trimloop_render::{Highlight, Place, RenderError, Renderer};

use crate::loader::Loaded;

/// An open file.
#[derive(Debug)]
pub(crate) struct Document {
    pub path: PathBuf,
    pub model: Model,
    pub renderer: Renderer,
    /// What was lost or approximated.
    pub diagnostics: Vec<Diagnostic>,
    /// Seconds that reading took.
    pub seconds: f64,
    /// What is selected.
    pub selection: Option<Highlight>,
    /// The place on it that was clicked.
    pub place: Option<Place>,
}

impl Document {
    /// # Errors
    /// What the device refuses.
    pub fn new(gpu: &Gpu, path: PathBuf, loaded: Loaded) -> Result<Self, RenderError> {
        let Loaded { model, scene, seconds } = loaded;
        let all = model.diagnostics.iter().chain(&scene.diagnostics);
        let diagnostics = all.filter(|d| d.severity != Severity::Info).cloned().collect();
        let renderer = Renderer::new(gpu, scene)?;
        Ok(Self { path, model, renderer, diagnostics, seconds, selection: None, place: None })
    }

    /// The file's name.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or(self.path.as_os_str()).to_string_lossy().into_owned()
    }

    /// Selects something, or nothing.
    pub fn select(&mut self, selection: Option<Highlight>) {
        self.selection = selection;
        self.renderer.highlight(selection);
        if selection.is_none_or(|own| self.place.is_some_and(|p| Some(p.face) != own.face)) {
            self.place = None;
        }
    }

    /// The first use of the face that an entity is.
    pub fn find_face(&self, entity: EntityRef) -> Option<Highlight> {
        let scene = self.renderer.scene();
        let (part, face) = scene.parts.iter().enumerate().find_map(|(k, part)| {
            let face = part.faces.iter().position(|face| face.entity == entity)?;
            Some((k, face))
        })?;
        let instance = scene.instances.iter().position(|instance| instance.part == part)?;
        Some(Highlight { instance, face: Some(face) })
    }

    /// The instances at or below a node.
    pub fn instances_below(&self, node: usize) -> Vec<usize> {
        let mut nodes = vec![node];
        let mut next = 0;
        while next < nodes.len() {
            nodes.extend(&self.model.nodes[nodes[next]].children);
            next += 1;
        }
        let scene = self.renderer.scene();
        let nodes: HashSet<usize> = nodes.into_iter().collect();
        let is_below =
            |(_, i): &(usize, &trimloop_render::Instance)| i.node.is_some_and(|n| nodes.contains(&n));
        scene.instances.iter().enumerate().filter(is_below).map(|(k, _)| k).collect()
    }

    /// Shows or hides a node with all below it.
    pub fn show(&mut self, node: usize, is_shown: bool) {
        for instance in self.instances_below(node) {
            self.renderer.show(instance, is_shown);
        }
    }

    /// Shows only what is at or below a node; `None` shows everything.
    pub fn isolate(&mut self, node: Option<usize>) {
        let wanted = node.map(|node| self.instances_below(node));
        for instance in 0..self.renderer.scene().instances.len() {
            self.renderer.show(instance, wanted.as_ref().is_none_or(|wanted| wanted.contains(&instance)));
        }
    }

    /// What is known of the selection, as lines of a name and a value.
    pub fn facts(&self) -> Vec<(String, String)> {
        let Some(selection) = self.selection else { return Vec::new() };
        let scene = self.renderer.scene();
        let Some(instance) = scene.instances.get(selection.instance) else { return Vec::new() };
        let mut out = Vec::new();
        let mut say = |name: &str, value: String| out.push((name.to_owned(), value));
        if let Some(node) = instance.node {
            say("node", self.model.nodes[node].name.clone());
        }
        say("part", scene.parts[instance.part].name.clone());
        let Some(face) = selection.face else {
            say("faces", scene.parts[instance.part].faces.len().to_string());
            return out;
        };
        say("face", scene.parts[instance.part].faces[face].entity.to_string());
        if let Some(own) = self.model.parts.get(instance.part).and_then(|part| part.faces.get(face)) {
            if !own.name.is_empty() {
                say("name", own.name.to_string());
            }
            say("surface", surface_kind(own));
        }
        if let Some(place) = self.place.filter(|place| place.face == face) {
            let vector = |v: glam::DVec3, digits: usize| {
                format!("{:.digits$}, {:.digits$}, {:.digits$}", v.x, v.y, v.z)
            };
            if let Some(radius) = place.radius_mm {
                say("radius", format!("{radius:.6} mm"));
            }
            say("point", format!("{} mm", vector(place.point, 5)));
            say("normal", vector(place.normal, 6));
            say("u, v", format!("{:.6}, {:.6}", place.uv.x, place.uv.y));
        }
        out
    }
}

/// What kind of surface a face has.
fn surface_kind(face: &trimloop_brep::Face) -> String {
    match &face.geometry {
        trimloop_brep::FaceGeometry::Surface(surface) => surface.kind().to_owned(),
        _ => "triangles".to_owned(),
    }
}
