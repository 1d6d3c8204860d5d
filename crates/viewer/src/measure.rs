//! What is selected, measured: in the background, exactly, and kept where somebody wants to see it later.

use std::collections::HashMap;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use trimloop_brep::Model;
use trimloop_measure::{Between, Facts, Feature, Item, Whole, between, facts, whole};
use trimloop_mesh::Silent;

use crate::document::Picked;
use crate::job::{Job, Polled};

/// Something that is measured: which part, where, which face, edge or vertex of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Subject {
    pub picked: Picked,
    pub part: usize,
    pub transform: DAffine3,
    pub feature: Feature,
}

/// What measuring told.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    of: Wanted,
    /// Of a single face, edge or vertex.
    pub facts: Option<Facts>,
    /// Of two.
    pub between: Option<Between>,
    /// Of whole parts.
    pub wholes: Option<Wholes>,
}

/// Whole parts together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wholes {
    pub area_mm2: f64,
    /// None where one of them has no volume.
    pub volume_mm3: Option<f64>,
    /// Of the volume, or of the area.
    pub center: DVec3,
}

/// What is to be measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Wanted {
    #[default]
    Nothing,
    /// One face, edge or vertex, or two of them.
    Features(Vec<Subject>),
    /// Whole parts: instance, part and place.
    Wholes(Vec<(usize, usize, DAffine3)>),
}

impl Wanted {
    /// Whether it is about the same, wherever that was clicked.
    fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Features(a), Self::Features(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.picked.is_same(&b.picked))
            }
            _ => self == other,
        }
    }
}

/// The selection's measures, and those that are kept.
#[derive(Debug, Default)]
pub(crate) struct Measure {
    wanted: Wanted,
    job: Option<Job<Measured>>,
    pub found: Option<Measured>,
    pub kept: Vec<Measured>,
}

impl Measure {
    /// Begins to measure something, unless that is done or on its way.
    pub fn want(&mut self, context: &egui::Context, model: &Arc<Model>, wanted: Wanted) {
        if self.wanted.is_same(&wanted) {
            return;
        }
        self.found = None;
        self.job = None;
        self.wanted = wanted.clone();
        if wanted != Wanted::Nothing {
            let model = model.clone();
            self.job = Some(Job::start(context, move || Measured::of(&model, wanted)));
        }
    }

    /// Takes over what has been found; whether that is something new.
    pub fn poll(&mut self) -> bool {
        match self.job.as_ref().map(Job::poll) {
            None | Some(Polled::Waiting) => false,
            Some(Polled::Done(found)) => {
                self.found = Some(found);
                self.job = None;
                true
            }
            Some(Polled::Failed) => {
                self.job = None;
                true
            }
        }
    }

    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// Keeps what is measured now.
    pub fn keep(&mut self) {
        let Some(found) = &self.found else { return };
        let is_there = self.kept.iter().any(|own| own.of.is_same(&found.of));
        if !is_there {
            self.kept.push(found.clone());
        }
    }

    /// Lines of a name and a value.
    pub fn facts(&self) -> Vec<(String, String)> {
        match &self.found {
            _ if self.is_busy() => vec![("measures".to_owned(), "…".to_owned())],
            Some(found) => found.lines(),
            None => Vec::new(),
        }
    }
}

impl Wholes {
    /// Each part is measured once, and again only where an instance changes its size.
    fn of(model: &Model, wholes: &[(usize, usize, DAffine3)]) -> Option<Self> {
        let mut parts: Vec<usize> = wholes.iter().map(|(_, part, _)| *part).collect();
        parts.sort_unstable();
        parts.dedup();
        let alone: HashMap<usize, Option<Whole>> = parts
            .into_par_iter()
            .map(|part| (part, whole(&model.parts[part], DAffine3::IDENTITY, &Silent)))
            .collect();
        let (mut area, mut moment_of_area) = (0.0, DVec3::ZERO);
        let (mut volume, mut moment_of_volume) = (Some(0.0), DVec3::ZERO);
        for (_, part, transform) in wholes {
            let m = transform.matrix3;
            let is_rigid = (m.transpose() * m).abs_diff_eq(glam::DMat3::IDENTITY, 1e-9);
            let own = match is_rigid {
                true => alone
                    .get(part)
                    .copied()
                    .flatten()
                    .map(|own| Whole { center: transform.transform_point3(own.center), ..own }),
                false => whole(&model.parts[*part], *transform, &Silent),
            };
            let Some(own) = own else { continue };
            area += own.area_mm2;
            moment_of_area += own.center * own.area_mm2;
            volume = volume.zip(own.volume_mm3).map(|(a, b)| a + b);
            moment_of_volume += own.center * own.volume_mm3.unwrap_or(0.0);
        }
        let center = match volume {
            Some(volume) if volume > 0.0 => moment_of_volume / volume,
            _ => moment_of_area / area,
        };
        (area > 0.0).then_some(Self { area_mm2: area, volume_mm3: volume, center })
    }
}

impl Measured {
    fn of(model: &Model, wanted: Wanted) -> Self {
        let item =
            |s: &Subject| Item { part: &model.parts[s.part], transform: s.transform, feature: s.feature };
        let (facts, between, wholes) = match &wanted {
            Wanted::Nothing => (None, None, None),
            Wanted::Features(subjects) => match &subjects[..] {
                [one] => (Some(facts(item(one))), None, None),
                [a, b] => (None, between(item(a), item(b)), None),
                _ => (None, None, None),
            },
            Wanted::Wholes(all) => (None, None, Wholes::of(model, all)),
        };
        Self { of: wanted, facts, between, wholes }
    }

    /// The faces, edges and vertices that were measured.
    pub fn subjects(&self) -> &[Subject] {
        match &self.of {
            Wanted::Features(subjects) => subjects,
            Wanted::Nothing | Wanted::Wholes(_) => &[],
        }
    }

    /// Lines of a name and a value.
    pub fn lines(&self) -> Vec<(String, String)> {
        if let Some(wholes) = &self.wholes {
            let mut out = Vec::new();
            if let Some(volume) = wholes.volume_mm3 {
                out.push(("volume".to_owned(), format!("{} mm³", number(volume))));
            }
            out.push(("area".to_owned(), format!("{} mm²", number(wholes.area_mm2))));
            let name = if wholes.volume_mm3.is_some() { "centre of gravity" } else { "centre of area" };
            out.push((name.to_owned(), format!("{} mm", vector(wholes.center))));
            return out;
        }
        match (&self.facts, &self.between) {
            (Some(facts), _) => lines_of_facts(facts),
            (None, Some(between)) => lines_between(between),
            (None, None) => vec![("measures".to_owned(), "none: there is no geometry".to_owned())],
        }
    }

    /// The most telling one, for a label in the picture.
    pub fn label(&self) -> String {
        if let Some(between) = &self.between {
            return format!("{} mm", number(between.distance_mm));
        }
        if let Some(wholes) = &self.wholes {
            return wholes.volume_mm3.map_or_else(
                || format!("{} mm²", number(wholes.area_mm2)),
                |v| format!("{} mm³", number(v)),
            );
        }
        let Some(facts) = &self.facts else { return String::new() };
        if let Some(radius) = facts.radius_mm {
            return format!("R {} mm", number(radius));
        }
        if let Some(area) = facts.area_mm2 {
            return format!("{} mm²", number(area));
        }
        facts.length_mm.map_or_else(|| facts.kind.clone(), |length| format!("{} mm", number(length)))
    }

    /// The places that a measure of two is taken between, in the model.
    pub fn ends(&self) -> Option<[DVec3; 2]> {
        self.between.as_ref().map(|between| between.points)
    }
}

fn lines_of_facts(facts: &Facts) -> Vec<(String, String)> {
    let mut out = Vec::new();
    let mut say = |name: &str, value: String| out.push((name.to_owned(), value));
    say("kind", facts.kind.clone());
    let numbers = [
        ("radius", facts.radius_mm, " mm"),
        ("diameter", facts.radius_mm.map(|r| 2.0 * r), " mm"),
        ("smaller radius", facts.minor_radius_mm, " mm"),
        ("half angle", facts.half_angle_deg, "°"),
        ("arc", facts.arc_angle_deg, "°"),
        ("area", facts.area_mm2, " mm²"),
    ];
    for (name, value, unit) in numbers {
        if let Some(value) = value {
            say(name, format!("{}{unit}", number(value)));
        }
    }
    if let Some(length) = facts.length_mm {
        let name = if facts.area_mm2.is_some() { "perimeter" } else { "length" };
        say(name, format!("{} mm", number(length)));
    }
    if let Some(position) = facts.position {
        say("centre", format!("{} mm", vector(position)));
    }
    if let Some([a, b]) = facts.ends {
        say("from", format!("{} mm", vector(a)));
        say("to", format!("{} mm", vector(b)));
    }
    if let Some(axis) = &facts.axis {
        say("axis at", format!("{} mm", vector(axis.origin)));
        say("axis along", vector(axis.direction));
    }
    if let Some(normal) = facts.normal {
        say("plane normal", vector(normal));
    }
    out
}

fn lines_between(between: &Between) -> Vec<(String, String)> {
    let mut out = Vec::new();
    let mut say = |name: &str, value: String| out.push((name.to_owned(), value));
    let about = if between.is_exact { "" } else { "about " };
    say("distance", format!("{about}{} mm", number(between.distance_mm)));
    let distances = [
        ("parallel distance", between.parallel_distance_mm),
        ("axis distance", between.axis_distance_mm),
        ("centre distance", between.center_distance_mm),
    ];
    for (name, value) in distances {
        if let Some(value) = value {
            say(name, format!("{} mm", number(value)));
        }
    }
    if let Some(angle) = between.angle_deg {
        let parallel = if between.is_parallel { " (parallel)" } else { "" };
        say("angle", format!("{}°{parallel}", number(angle)));
    }
    say("Δ x, y, z", format!("{} mm", vector(between.delta)));
    say("from", format!("{} mm", vector(between.points[0])));
    say("to", format!("{} mm", vector(between.points[1])));
    out
}

/// Six digits behind the point, without trailing zeros.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

pub(crate) fn vector(v: DVec3) -> String {
    format!("{}, {}, {}", number(v.x), number(v.y), number(v.z))
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_no_more_digits_than_they_need() {
        assert_eq!(number(12.5), "12.5");
        assert_eq!(number(-0.000_000_01), "0");
        assert_eq!(number(1e6), "1000000");
        assert_eq!(number(0.1 + 0.2), "0.3");
    }
}
