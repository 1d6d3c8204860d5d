//! Files that are open.

mod facts;
mod succession;

use std::collections::HashMap;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use trimloop_brep::{Diagnostic, EdgeId, EntityRef, Face, Model, Part, Severity};
use trimloop_geom::Aabb;
use trimloop_gpu::Gpu;
use trimloop_measure::Feature;
use trimloop_render::{Highlight, Place, RenderError, Renderer, Scene};
use trimloop_trim::Tolerance;

use crate::app::Sight;
use crate::deviation::Deviation;
use crate::loader::ReadyPart;
use crate::measure::{Measure, Subject, Wanted};
use crate::section::Caps;

/// An open file.
pub(crate) struct Document {
    /// Tells it from others, also of the same name.
    pub id: u64,
    /// The number of its opening; tabs stand in that order.
    pub order: u64,
    pub path: PathBuf,
    pub model: Arc<Model>,
    pub renderer: Renderer,
    /// What was lost or approximated.
    pub diagnostics: Vec<Diagnostic>,
    /// Seconds that reading took; none as long as parts are missing.
    pub seconds: Option<f64>,
    /// What is selected, in the order in which it was.
    pub selection: Vec<Picked>,
    pub measure: Measure,
    pub caps: Caps,
    /// From where it is seen and how it is cut, while another one is in front.
    pub sight: Option<Sight>,
    /// The node that was selected in the tree, with all below it.
    pub node: Option<usize>,
    /// How far it is from a reference.
    pub deviation: Option<Deviation>,
    /// Where instances stand in the model.
    homes: Vec<DAffine3>,
    /// By instance: where it goes when the model is taken apart, as a share of how far.
    apart: Vec<DVec3>,
    explosion: f64,
    /// By node: the instances at it and below.
    below: Vec<Range<usize>>,
    /// By node: the one above.
    parents: Vec<Option<usize>>,
    lines: HashMap<(usize, EdgeId), Arc<Vec<DVec3>>>,
    /// The boxes of parts' vertices, and the box of what was shown at some arrangement.
    boxes: Vec<Aabb>,
    bounds: std::cell::Cell<Option<(u64, Aabb)>>,
    /// Parts, and faces, edges and vertices of them, by entity.
    entities: HashMap<EntityRef, (usize, Feature)>,
    /// Counts what changes the picture.
    pub revision: u64,
    /// Counts what changes what is where.
    pub arrangement: u64,
    /// The node that the tree has to come to.
    pub wanted_row: Option<usize>,
}

/// Something of an instance that can be selected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Picked {
    pub instance: usize,
    /// A face, an edge or a vertex; the whole of it otherwise.
    pub feature: Option<Feature>,
    /// The place on a face that was clicked.
    pub place: Option<Place>,
}

impl Picked {
    pub fn is_same(&self, other: &Self) -> bool {
        self.instance == other.instance && self.feature == other.feature
    }
}

/// Room around what is looked at, as a share of the model's size.
const ROOM: f64 = 0.01;
/// Edges are drawn over the picture within this share of their part's size.
const FINENESS: f64 = 2e-5;
const ANGLE_RAD: f64 = 0.1;

impl Document {
    /// A document whose parts are still to come.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn new(gpu: &Gpu, id: u64, path: PathBuf, model: Arc<Model>) -> Result<Self, RenderError> {
        let is_told = |d: &&Diagnostic| d.severity != Severity::Info;
        let diagnostics = model.diagnostics.iter().filter(is_told).cloned().collect();
        let renderer = Renderer::new(gpu, Scene::of_nothing_yet(&model))?;
        let instances = &renderer.scene().instances;
        let homes = instances.iter().map(|i| i.transform).collect();
        let mut parents = vec![None; model.nodes.len()];
        for (index, node) in model.nodes.iter().enumerate() {
            node.children.iter().for_each(|&child| parents[child] = Some(index));
        }
        // Instances come in the order of the tree: those below a node follow each other.
        let mut below: Vec<Range<usize>> = vec![0..0; model.nodes.len()];
        for (k, instance) in instances.iter().enumerate() {
            let mut node = instance.node;
            while let Some(index) = node {
                let own = &mut below[index];
                *own = if own.start == own.end { k..k + 1 } else { own.start.min(k)..own.end.max(k + 1) };
                node = parents[index];
            }
        }
        let apart = vec![DVec3::ZERO; instances.len()];
        let own_box = |part: &Part| {
            let all = part.vertices.iter().map(|v| v.point).chain(part.facet_points.iter().copied());
            Aabb::from_points(all.filter(|p| p.is_finite()))
        };
        let boxes = model.parts.iter().map(own_box).collect();
        let mut entities = HashMap::new();
        for (k, part) in model.parts.iter().enumerate() {
            let faces = (0u32..).zip(&part.faces).map(|(n, own)| (own.entity, Feature::Face(n)));
            let edges = (0u32..).zip(&part.edges).map(|(n, own)| (own.entity, Feature::Edge(n)));
            let vertices = (0u32..).zip(&part.vertices).map(|(n, own)| (own.entity, Feature::Vertex(n)));
            for (entity, feature) in faces.chain(edges).chain(vertices) {
                entities.entry(entity).or_insert((k, feature));
            }
        }
        Ok(Self {
            id,
            order: 0,
            path,
            model,
            renderer,
            diagnostics,
            seconds: None,
            selection: Vec::new(),
            measure: Measure::default(),
            caps: Caps::default(),
            sight: None,
            node: None,
            deviation: None,
            homes,
            apart,
            explosion: 0.0,
            below,
            parents,
            lines: HashMap::new(),
            entities,
            boxes,
            bounds: Default::default(),
            revision: 0,
            arrangement: 0,
            wanted_row: None,
        })
    }

    /// Takes a part that is ready.
    ///
    /// # Errors
    /// What the device refuses.
    pub fn take(&mut self, ready: ReadyPart) -> Result<(), RenderError> {
        let ReadyPart { index, part, diagnostics } = ready;
        self.diagnostics.extend(diagnostics.into_iter().filter(|d| d.severity != Severity::Info));
        self.rearranged();
        self.renderer.set_part(index, part)
    }

    /// All parts are there.
    pub fn finish(&mut self, seconds: f64) {
        self.seconds = Some(seconds);
        self.apart = self.find_apart();
        self.rearranged();
    }

    fn rearranged(&mut self) {
        self.revision += 1;
        self.arrangement += 1;
    }

    /// The file's name.
    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or(self.path.as_os_str()).to_string_lossy().into_owned()
    }

    /// What must be in the picture: what is ready of it, or, before anything is, what the file's vertices tell.
    pub fn outline(&self, instances: Option<Range<usize>>) -> Vec<DVec3> {
        let scene = self.renderer.scene();
        let is_wanted =
            |k: usize| k < self.homes.len() && instances.as_ref().is_none_or(|own| own.contains(&k));
        if self.seconds.is_some() {
            return scene.outline_of(is_wanted);
        }
        let shown = scene.instances.iter().take(self.homes.len()).enumerate();
        shown
            .filter(|(k, i)| i.is_shown && is_wanted(*k))
            .filter_map(|(_, i)| Some((i, self.boxes.get(i.part)?)))
            .flat_map(|(i, bounds)| {
                let corners = (!bounds.is_empty()).then(|| bounds.corners());
                corners.into_iter().flatten().map(|p| i.transform.transform_point3(p))
            })
            .collect()
    }

    /// The box of what is shown, without what closes sections.
    pub fn bounds(&self) -> Aabb {
        match self.bounds.get() {
            Some((arrangement, bounds)) if arrangement == self.arrangement => bounds,
            _ => {
                let bounds = Aabb::from_points(self.outline(None));
                self.bounds.set(Some((self.arrangement, bounds)));
                bounds
            }
        }
    }

    /// Selects something alone, adds it to the selection, or takes it out again where it is selected.
    pub fn select(&mut self, picked: Option<Picked>, is_added: bool) {
        match (picked, is_added) {
            (None, true) => return,
            (None, false) => self.selection.clear(),
            (Some(picked), false) => self.selection = vec![picked],
            (Some(picked), true) => match self.selection.iter().position(|own| own.is_same(&picked)) {
                Some(place) => _ = self.selection.remove(place),
                None => self.selection.push(picked),
            },
        }
        self.node = None;
        if let Some(node) = picked.and_then(|p| self.node_of(p.instance)) {
            self.wanted_row = Some(node);
        }
        self.update_highlights();
    }

    fn update_highlights(&mut self) {
        let highlight = |picked: &Picked| match picked.feature {
            None => Some(Highlight { instance: picked.instance, face: None }),
            Some(Feature::Face(face)) => {
                Some(Highlight { instance: picked.instance, face: Some(face as usize) })
            }
            Some(Feature::Edge(_) | Feature::Vertex(_)) => None,
        };
        self.renderer.highlight(self.selection.iter().filter_map(highlight).collect());
        self.revision += 1;
    }

    /// Selects all that is at or below a node.
    pub fn select_node(&mut self, node: usize, is_added: bool) {
        if !is_added {
            self.select(None, false);
        }
        for instance in self.instances_below(node) {
            let picked = Picked { instance, feature: None, place: None };
            if !self.selection.iter().any(|own| own.is_same(&picked)) {
                self.selection.push(picked);
            }
        }
        self.update_highlights();
        self.node = (!is_added).then_some(node);
        self.wanted_row = None;
    }

    /// The node of an instance.
    pub fn node_of(&self, instance: usize) -> Option<usize> {
        self.renderer.scene().instances.get(instance)?.node
    }

    pub fn parent_of(&self, node: usize) -> Option<usize> {
        self.parents.get(node).copied().flatten()
    }

    /// The first use of the face, edge or vertex that an entity is.
    pub fn find(&self, entity: EntityRef) -> Option<Picked> {
        let (part, feature) = *self.entities.get(&entity)?;
        let instance = self.renderer.scene().instances.iter().position(|instance| instance.part == part)?;
        Some(Picked { instance, feature: Some(feature), place: None })
    }

    /// Shows what something is of.
    pub fn reveal(&mut self, picked: &Picked) {
        self.renderer.show(picked.instance, true);
        self.rearranged();
    }

    /// What must be in the picture for the selection to be seen: with some room around single features.
    pub fn outline_of_selection(&mut self) -> Vec<DVec3> {
        let mut out = Vec::new();
        for picked in self.selection.clone() {
            let points: Vec<DVec3> = match picked.feature {
                None => self.outline(Some(picked.instance..picked.instance + 1)),
                Some(Feature::Face(face)) => {
                    let edges = self.edges_of(picked.instance, face);
                    let lines: Vec<DVec3> =
                        edges.into_iter().flat_map(|edge| self.line(picked.instance, edge)).collect();
                    match lines.is_empty() {
                        true => self.outline(Some(picked.instance..picked.instance + 1)),
                        false => lines,
                    }
                }
                Some(Feature::Edge(edge)) => self.line(picked.instance, edge),
                Some(Feature::Vertex(vertex)) => self.vertex(picked.instance, vertex).into_iter().collect(),
            };
            let bounds = Aabb::from_points(points.iter().copied());
            if bounds.is_empty() || picked.feature.is_none() {
                out.extend(points);
                continue;
            }
            let around = DVec3::splat((0.4 * bounds.diagonal()).max(ROOM * self.bounds().diagonal()));
            out.extend(Aabb { min: bounds.min - around, max: bounds.max + around }.corners());
        }
        out
    }

    /// Shows in the heat map what is shown, where it is shown.
    pub fn arrange_deviation(&mut self) {
        let Some(deviation) = &mut self.deviation else { return };
        if deviation.arrangement == Some(self.arrangement) {
            return;
        }
        deviation.arrangement = Some(self.arrangement);
        for (k, instance) in self.renderer.scene().instances.iter().enumerate().take(self.homes.len()) {
            deviation.renderer.show(k, instance.is_shown);
            let moved = self.apart.get(k).map_or(DVec3::ZERO, |way| *way * self.explosion);
            deviation.renderer.place(k, DAffine3::from_translation(moved));
        }
    }

    /// The instances at or below a node.
    pub fn instances_below(&self, node: usize) -> Range<usize> {
        self.below.get(node).cloned().unwrap_or(0..0)
    }

    /// Whether anything at or below a node is shown.
    pub fn is_shown(&self, node: usize) -> bool {
        let range = self.instances_below(node);
        range.is_empty() || self.renderer.scene().instances[range].iter().any(|i| i.is_shown)
    }

    /// Shows or hides a node with all below it.
    pub fn show(&mut self, node: usize, is_shown: bool) {
        for instance in self.instances_below(node) {
            self.renderer.show(instance, is_shown);
        }
        self.rearranged();
    }

    /// Shows only what is at or below some nodes; all of it without any.
    pub fn isolate(&mut self, nodes: &[usize]) {
        let wanted: Vec<Range<usize>> = nodes.iter().map(|node| self.instances_below(*node)).collect();
        for instance in 0..self.homes.len() {
            let is_shown = nodes.is_empty() || wanted.iter().any(|range| range.contains(&instance));
            self.renderer.show(instance, is_shown);
        }
        self.rearranged();
    }

    /// The nodes of what is selected.
    pub fn selected_nodes(&self) -> Vec<usize> {
        let mut nodes: Vec<usize> = self.selection.iter().filter_map(|p| self.node_of(p.instance)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// The exact face that is selected last.
    pub fn selected_face(&self) -> Option<(Picked, &Face)> {
        let picked = *self.selection.last()?;
        let Some(Feature::Face(face)) = picked.feature else { return None };
        Some((picked, self.part_of(picked.instance)?.faces.get(face as usize)?))
    }

    /// The part that an instance places.
    pub fn part_of(&self, instance: usize) -> Option<&Part> {
        self.model.parts.get(self.renderer.scene().instances.get(instance)?.part)
    }

    /// What of the selection can be measured, where it stands in the model.
    pub fn wanted_measure(&self) -> Wanted {
        let part = |picked: &Picked| Some(self.renderer.scene().instances.get(picked.instance)?.part);
        let home = |picked: &Picked| self.homes.get(picked.instance).copied();
        let subject = |own: &Picked| {
            let (feature, part, transform) = (own.feature?, part(own)?, home(own)?);
            Some(Subject { picked: *own, part, transform, feature })
        };
        let whole = |own: &Picked| {
            own.feature.is_none().then_some(())?;
            Some((own.instance, part(own)?, home(own)?))
        };
        if self.selection.is_empty() {
            return Wanted::Nothing;
        }
        if let Some(wholes) = self.selection.iter().map(whole).collect() {
            return Wanted::Wholes(wholes);
        }
        match self.selection.iter().map(subject).collect::<Option<Vec<Subject>>>() {
            Some(subjects) if subjects.len() <= 2 => Wanted::Features(subjects),
            _ => Wanted::Nothing,
        }
    }

    /// How far an instance is from its place in the model.
    pub fn moved(&self, instance: usize) -> DVec3 {
        self.apart.get(instance).map_or(DVec3::ZERO, |way| *way * self.explosion)
    }

    /// An edge of an instance, as points where it is drawn.
    pub fn line(&mut self, instance: usize, edge: EdgeId) -> Vec<DVec3> {
        let Some(placed) = self.renderer.scene().instances.get(instance) else { return Vec::new() };
        let (index, transform) = (placed.part, placed.transform);
        let line = self.lines.entry((index, edge)).or_insert_with(|| {
            let part = &self.model.parts[index];
            let size = Aabb::from_points(part.vertices.iter().map(|v| v.point)).diagonal();
            let tolerance = Tolerance { linear_mm: (FINENESS * size).max(1e-9), angular_rad: ANGLE_RAD };
            let points = part
                .edges
                .get(edge as usize)
                .map(|own| trimloop_trim::sample_curve(&own.curve, own.range, tolerance));
            Arc::new(points.unwrap_or_default().into_iter().filter(|p| p.is_finite()).collect())
        });
        line.iter().map(|p| transform.transform_point3(*p)).collect()
    }

    /// The edges of a face.
    pub fn edges_of(&self, instance: usize, face: u32) -> Vec<EdgeId> {
        let face = self.part_of(instance).and_then(|part| part.faces.get(face as usize));
        let mut edges: Vec<EdgeId> = face
            .into_iter()
            .flat_map(|face| &face.loops)
            .flat_map(|l| l.coedges.iter().map(|c| c.edge))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// A vertex of an instance, where it is drawn.
    pub fn vertex(&self, instance: usize, vertex: u32) -> Option<DVec3> {
        let placed = self.renderer.scene().instances.get(instance)?;
        let own = self.model.parts.get(placed.part)?.vertices.get(vertex as usize)?;
        Some(placed.transform.transform_point3(own.point))
    }

    /// How far the model is taken apart: 0 for not at all.
    pub fn explosion(&self) -> f64 {
        self.explosion
    }

    /// Takes the model apart.
    pub fn explode(&mut self, explosion: f64) {
        if self.explosion == explosion {
            return;
        }
        self.explosion = explosion;
        for (instance, home) in self.homes.iter().enumerate() {
            let moved = DAffine3::from_translation(self.moved(instance)) * *home;
            self.renderer.place(instance, moved);
        }
        self.rearranged();
    }

    /// Whether there is more than one thing to take apart.
    pub fn can_explode(&self) -> bool {
        self.homes.len() > 1
    }

    /// Where instances go when the model is taken apart: level by level, away from the middle of what they are part of.
    fn find_apart(&self) -> Vec<DVec3> {
        let scene = self.renderer.scene();
        let boxes: Vec<Aabb> = (0..self.homes.len())
            .map(|k| scene.parts[scene.instances[k].part].bounds.transformed(&self.homes[k]))
            .collect();
        let center = |range: Range<usize>| {
            let all = boxes[range].iter().filter(|b| !b.is_empty()).fold(Aabb::EMPTY, |a, b| a.union(*b));
            (!all.is_empty()).then(|| all.center())
        };
        let centers: Vec<Option<DVec3>> = self.below.iter().map(|range| center(range.clone())).collect();
        let all = center(0..boxes.len());
        (0..boxes.len())
            .map(|k| {
                let mut way = DVec3::ZERO;
                let mut own = center(k..k + 1);
                let mut node = self.node_of(k);
                while let Some(index) = node {
                    if let (Some(a), Some(b)) = (own, centers[index]) {
                        way += a - b;
                    }
                    own = centers[index].or(own);
                    node = self.parents[index];
                }
                if let (Some(a), Some(b)) = (own, all) {
                    way += a - b;
                }
                way
            })
            .collect()
    }
}
