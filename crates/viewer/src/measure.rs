//! What is selected, measured: in the background, exactly, and kept where somebody wants to see it later.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use trimloop_brep::Model;
use trimloop_measure::{Between, Facts, Feature, Item, between, facts};

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
    pub subjects: Vec<Subject>,
    /// Of a single subject.
    pub facts: Option<Facts>,
    /// Of two.
    pub between: Option<Between>,
}

/// The selection's measures, and those that are kept.
#[derive(Debug, Default)]
pub(crate) struct Measure {
    wanted: Vec<Subject>,
    job: Option<Job<Measured>>,
    pub found: Option<Measured>,
    pub kept: Vec<Measured>,
}

impl Measure {
    /// Begins to measure one subject or two, unless that is done or on its way.
    pub fn want(&mut self, context: &egui::Context, model: &Arc<Model>, subjects: Vec<Subject>) {
        let is_same = |a: &[Subject], b: &[Subject]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.picked.is_same(&b.picked))
        };
        if is_same(&self.wanted, &subjects) {
            return;
        }
        self.found = None;
        self.job = None;
        self.wanted = subjects.clone();
        if subjects.is_empty() {
            return;
        }
        let model = model.clone();
        self.job = Some(Job::start(context, move || {
            let item =
                |s: &Subject| Item { part: &model.parts[s.part], transform: s.transform, feature: s.feature };
            let (facts, between) = match &subjects[..] {
                [one] => (Some(facts(item(one))), None),
                [a, b] => (None, between(item(a), item(b))),
                _ => (None, None),
            };
            Measured { subjects, facts, between }
        }));
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
        let is_there = self.kept.iter().any(|own| {
            own.subjects.len() == found.subjects.len()
                && own.subjects.iter().zip(&found.subjects).all(|(a, b)| a.picked.is_same(&b.picked))
        });
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

impl Measured {
    /// Lines of a name and a value.
    pub fn lines(&self) -> Vec<(String, String)> {
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
