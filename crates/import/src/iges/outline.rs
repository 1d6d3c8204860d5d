//! What stands in a file or in a subfigure: geometry in groups, and placements of other subfigures
//! (IGES 5.3 sections 4.76, 4.99, 4.112 to 4.118).

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use trimloop_brep::{Diagnostic, Diagnostics, EntityRef, Rgba, Severity};
use trimloop_iges::DirectoryEntry;

use super::curve::CURVES;
use super::layout::Layout;
use super::look::{color_of, name_of, property_name};
use super::primitive::PRIMITIVES;
use super::reader::{Fault, Outcome, Parameters, Reader};
use super::surface::SURFACES;

/// What stands in one coordinate system.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    /// The first one is the whole; each stands in an earlier one.
    pub groups: Vec<Group>,
}

/// Geometry and placements under one name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Group {
    /// The group that it stands in.
    pub parent: Option<usize>,
    /// The entity that it comes from; 0 for none.
    pub entry: u32,
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Where it is placed in its parent, millimetres.
    pub transform: DAffine3,
    /// The colour of what has none of its own.
    pub color: Option<Rgba>,
    /// Whether the file hides it.
    pub hidden: bool,
    /// Faces, bodies, curves and points.
    pub geometry: Vec<u32>,
    /// Uses of what is defined elsewhere.
    pub placements: Vec<Placement>,
}

/// One use of a subfigure, a solid, ...
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    /// The entity that places it.
    pub entry: u32,
    /// What is placed: a subfigure's definition or any geometry.
    pub target: u32,
    /// Its own name.
    pub name: Option<String>,
    /// Millimetres.
    pub transform: DAffine3,
    /// The colour that it gives what it places.
    pub color: Option<Rgba>,
    /// Whether the file hides it.
    pub hidden: bool,
}

/// Which entities are made of which others.
pub(crate) struct Uses {
    /// Parts of geometry and of definitions.
    parts: FxHashSet<u32>,
    /// Members of groups.
    members: FxHashSet<u32>,
}

impl Uses {
    /// Looks at every entity of the file.
    pub fn new(reader: &Reader<'_>) -> Self {
        let mut out = Self { parts: FxHashSet::default(), members: FxHashSet::default() };
        for entity in reader.file.entities() {
            let kind = entity.directory.entity_type;
            if kind == 402 && !is_group(entity.directory) || matches!(kind, 114 | 128 | 150..=160 | 168 | 502)
            {
                continue;
            }
            let parts = Layout::of(&entity).parts;
            if kind == 402 { out.members.extend(parts) } else { out.parts.extend(parts) }
        }
        out
    }
}

/// Forms of type 402 that are groups: unordered or ordered, with or without pointers back.
fn is_group(directory: &DirectoryEntry) -> bool {
    directory.entity_type == 402 && matches!(directory.form, 1 | 7 | 14 | 15)
}

/// Types that place others.
const PLACEMENTS: [i32; 5] = [184, 408, 412, 414, 430];

/// The most copies that an array may have.
const MAX_COPIES: usize = 100_000;

/// Puts together an outline.
struct Builder<'r, 'f> {
    reader: &'r Reader<'f>,
    outline: Outline,
    seen: FxHashSet<u32>,
    named: FxHashMap<(usize, String), usize>,
    diagnostics: &'r mut Diagnostics,
}

impl Outline {
    /// Everything that stands on its own and is to be shown.
    pub fn of_file(reader: &Reader<'_>, uses: &Uses, diagnostics: &mut Diagnostics) -> Self {
        let mut builder = Builder::new(reader, diagnostics);
        let mut unknown: BTreeMap<i32, usize> = BTreeMap::new();
        let mut in_groups = Vec::new();
        for entity in reader.file.entities() {
            let directory = entity.directory;
            let entry = directory.number;
            if uses.parts.contains(&entry) || !is_shown(directory) {
                continue;
            }
            if !is_known(directory) {
                if !is_silent(directory) {
                    *unknown.entry(directory.entity_type).or_default() += 1;
                }
            } else if uses.members.contains(&entry) {
                in_groups.push(entry);
            } else {
                builder.add(entry, 0);
            }
        }
        // Groups that contain each other stand in none.
        in_groups.into_iter().for_each(|entry| builder.add(entry, 0));
        for (kind, count) in unknown {
            let message = format!("{count} entities of type {kind} are not read.");
            builder.diagnostics.push(Diagnostic::new(
                Severity::Info,
                "unsupported",
                EntityRef::None,
                message,
            ));
        }
        builder.finish()
    }

    /// What a definition contains, or a single entity.
    pub fn of_definition(reader: &Reader<'_>, entry: u32, diagnostics: &mut Diagnostics) -> Self {
        let mut builder = Builder::new(reader, diagnostics);
        builder.outline.groups[0].entry = entry;
        match reader.file.get(entry) {
            Some(entity) if entity.directory.entity_type == 308 => {
                let transform = builder.placement(entity.directory);
                let root = &mut builder.outline.groups[0];
                root.transform = transform;
                let name = entity.values().nth(2).and_then(|name| Some(name.text()?.trim().to_owned()));
                root.name = name.filter(|name| !name.is_empty()).or_else(|| name_of(reader, entry));
                Layout::of(&entity).parts.into_iter().for_each(|member| builder.add(member, 0));
            }
            Some(_) => {
                builder.outline.groups[0].name = name_of(reader, entry);
                builder.seen.insert(entry);
                builder.add_content(entry, 0);
            }
            None => builder.fault(entry, "is no entity of the file"),
        }
        builder.finish()
    }
}

impl<'r, 'f> Builder<'r, 'f> {
    fn new(reader: &'r Reader<'f>, diagnostics: &'r mut Diagnostics) -> Self {
        let outline = Outline { groups: vec![Group::default()] };
        Self { reader, outline, seen: FxHashSet::default(), named: FxHashMap::default(), diagnostics }
    }

    fn fault(&mut self, entry: u32, message: &str) {
        let fault = Fault::new(entry, message);
        self.diagnostics.push(fault.diagnostic(Severity::Error, "structure-unreadable"));
    }

    /// Adds an entity to a group, once.
    fn add(&mut self, entry: u32, group: usize) {
        if !self.seen.insert(entry) {
            return;
        }
        let Some(entity) = self.reader.file.get(entry) else {
            return self.fault(entry, "is no entity of the file");
        };
        let directory = entity.directory;
        let kind = directory.entity_type;
        if is_group(directory) {
            let inner = self.group(entry, group);
            // Deeply nested groups are taken one after the other.
            let mut waiting: Vec<(u32, usize)> =
                Layout::of(&entity).parts.into_iter().rev().map(|member| (member, inner)).collect();
            while let Some((member, inner)) = waiting.pop() {
                match self.reader.file.get(member) {
                    Some(entity) if is_group(entity.directory) => {
                        if self.seen.insert(member) {
                            let deeper = self.group(member, inner);
                            let members = Layout::of(&entity).parts;
                            waiting.extend(members.into_iter().rev().map(|member| (member, deeper)));
                        }
                    }
                    _ => self.add(member, inner),
                }
            }
        } else if !is_known(directory) || !matches!(directory.status.usage, 0 | 2 | 3 | 4) {
            // Dimensions, views and the like may be members of a group.
        } else if matches!(kind, 412 | 414 | 184) {
            let inner = self.group(entry, group);
            self.add_content(entry, inner);
        } else if let Some(name) = self.own_name(entry, kind) {
            let is_face = !is_solid(kind);
            let known = is_face.then(|| self.named.get(&(group, name.clone())).copied()).flatten();
            let inner = known.unwrap_or_else(|| {
                let inner = self.group(entry, group);
                let made = &mut self.outline.groups[inner];
                // What hides or colours the entity itself says nothing of others of its name.
                (made.hidden, made.color, made.transform) = (false, None, DAffine3::IDENTITY);
                made.name = Some(name.clone());
                inner
            });
            self.named.insert((group, name), inner);
            self.add_content(entry, inner);
        } else {
            self.add_content(entry, group);
        }
    }

    /// The name under which geometry stands in the tree: of a solid whatever it has, of a face what a property says.
    fn own_name(&self, entry: u32, kind: i32) -> Option<String> {
        if is_solid(kind) {
            name_of(self.reader, entry)
        } else if matches!(kind, 143 | 144 | 510) || SURFACES.contains(&kind) {
            property_name(self.reader, entry)
        } else {
            None
        }
    }

    fn group(&mut self, entry: u32, parent: usize) -> usize {
        let directory = self.reader.file.get(entry).map(|entity| entity.directory);
        let inherited = self.outline.groups[parent].color;
        let transform = directory.map(|directory| self.placement(directory));
        self.outline.groups.push(Group {
            parent: Some(parent),
            entry,
            name: name_of(self.reader, entry),
            transform: transform.unwrap_or_default(),
            color: color_of(self.reader, entry).or(inherited),
            hidden: directory.is_some_and(|directory| directory.status.blanked),
            ..Group::default()
        });
        self.outline.groups.len() - 1
    }

    /// Where an entity's own coordinates lie, both in millimetres; where that cannot be read, they stay.
    fn placement(&mut self, directory: &DirectoryEntry) -> DAffine3 {
        // Associativities have no place of their own.
        if directory.entity_type == 402 {
            return DAffine3::IDENTITY;
        }
        match self.reader.placement_mm(directory) {
            Ok(map) => map,
            Err(fault) => {
                self.diagnostics.push(fault.diagnostic(Severity::Error, "placement-unreadable"));
                DAffine3::IDENTITY
            }
        }
    }

    /// Adds geometry or placements to a group.
    fn add_content(&mut self, entry: u32, group: usize) {
        let Some(entity) = self.reader.file.get(entry) else { return };
        if !PLACEMENTS.contains(&entity.directory.entity_type) {
            return self.outline.groups[group].geometry.push(entry);
        }
        match placements(self.reader, entry) {
            Ok(placements) => self.outline.groups[group].placements.extend(placements),
            Err(fault) => {
                self.diagnostics.push(fault.diagnostic(Severity::Error, "structure-unreadable"));
            }
        }
    }

    /// Nameless groups that are all there is in theirs go up into it.
    fn finish(self) -> Outline {
        let mut groups = self.outline.groups;
        let mut children = vec![0usize; groups.len()];
        groups.iter().filter_map(|group| group.parent).for_each(|parent| children[parent] += 1);
        // Where each group is to be found; those that stand in it come after it.
        let mut place: Vec<usize> = (0..groups.len()).collect();
        for k in 1..groups.len() {
            let parent = place[groups[k].parent.unwrap_or(0)];
            groups[k].parent = Some(parent);
            let alone = children[parent] == 1
                && groups[parent].geometry.is_empty()
                && groups[parent].placements.is_empty();
            let plain = groups[k].name.is_none() && !groups[k].hidden;
            if alone && plain && groups[k].transform == DAffine3::IDENTITY {
                let inner = std::mem::take(&mut groups[k]);
                let outer = &mut groups[parent];
                (outer.geometry, outer.placements) = (inner.geometry, inner.placements);
                outer.color = inner.color.or(outer.color);
                groups[k].parent = Some(parent);
                children[parent] = std::mem::take(&mut children[k]);
                place[k] = parent;
            }
        }
        Outline { groups }
    }
}

/// Types that are solid bodies, or name one.
fn is_solid(kind: i32) -> bool {
    PRIMITIVES.contains(&kind) || matches!(kind, 180 | 186 | 514)
}

/// Whether an entity is geometry or structure that is read.
fn is_known(directory: &DirectoryEntry) -> bool {
    let kind = directory.entity_type;
    match kind {
        // A plane without bounds is there to be referred to.
        108 => directory.form == 1,
        106 => matches!(directory.form, 1..=3 | 11..=13 | 63),
        190 | 192 | 194 => false,
        116 | 143 | 144 | 180 | 186 | 510 | 514 => true,
        402 => is_group(directory),
        kind => {
            SURFACES.contains(&kind)
                || CURVES.contains(&kind)
                || PLACEMENTS.contains(&kind)
                || PRIMITIVES.contains(&kind)
        }
    }
}

/// Entities that show nothing themselves: directions, transformations, structure, properties, annotation's carriers.
fn is_silent(directory: &DirectoryEntry) -> bool {
    matches!(
        directory.entity_type,
        0 | 106 | 108 | 123 | 124 | 141 | 142 | 190..=194 | 302..=320 | 400..=499 | 502..=508
    )
}

/// Whether the status field lets an entity be shown on its own (IGES 5.3 section 2.2.4.4.9); what is blanked is kept
/// as hidden, curves and points apart.
fn is_shown(directory: &DirectoryEntry) -> bool {
    let status = directory.status;
    let is_thin = directory.entity_type == 116 || CURVES.contains(&directory.entity_type);
    let stands_alone = !is_thin || (!status.blanked && matches!(status.subordinate, 0 | 2));
    stands_alone && matches!(status.usage, 0 | 3 | 4)
}

/// What an entity places.
fn placements(reader: &Reader<'_>, entry: u32) -> Outcome<Vec<Placement>> {
    let mut parameters = reader.parameters(entry)?;
    let directory = parameters.directory;
    let unit = reader.unit_mm;
    let place = |target: u32, transform: DAffine3| Placement {
        entry,
        target,
        name: name_of(reader, entry),
        transform,
        color: color_of(reader, entry),
        hidden: directory.status.blanked,
    };
    match directory.entity_type {
        408 => {
            let target = parameters.pointer()?;
            let offset = parameters.point()? * unit;
            let scale = parameters.optional_real().filter(|&scale| scale != 0.0).unwrap_or(1.0);
            let scaled = DAffine3::from_scale(DVec3::splat(scale));
            // The offset is in the space that the subfigure is placed in, and so comes after the matrix.
            let placed = DAffine3::from_translation(offset) * reader.placement_mm(directory)? * scaled;
            Ok(vec![place(target, placed)])
        }
        430 => {
            let target = parameters.pointer()?;
            Ok(vec![place(target, reader.placement_mm(directory)?)])
        }
        184 => {
            let count = parameters.count(2)?;
            let items = (0..count).map(|_| parameters.pointer()).collect::<Outcome<Vec<u32>>>()?;
            let mut out = Vec::with_capacity(count);
            for item in items {
                let matrix = parameters.pointer()?;
                let mut placed = place(item, reader.matrix_mm(matrix)?);
                (placed.name, placed.hidden) = (None, false);
                out.push(placed);
            }
            Ok(out)
        }
        _ => {
            let (target, offsets, scale) = copies(&mut parameters)?;
            let scale = DAffine3::from_scale(DVec3::splat(scale));
            let placed = offsets.into_iter().map(|offset| {
                let mut placed = place(target, DAffine3::from_translation(offset * unit) * scale);
                (placed.name, placed.hidden) = (None, false);
                placed
            });
            Ok(placed.collect())
        }
    }
}

/// What a rectangular (412) or circular (414) array repeats, where each copy goes, and by what it is scaled.
fn copies(parameters: &mut Parameters<'_>) -> Outcome<(u32, Vec<DVec3>, f64)> {
    let is_circular = parameters.directory.entity_type == 414;
    let target = parameters.pointer()?;
    let mut offsets = Vec::new();
    let mut scale = 1.0;
    if is_circular {
        let count = parameters.integer()?;
        let center = parameters.point()?;
        let [radius, start, step] = [parameters.real()?, parameters.real()?, parameters.real()?];
        let count = usize::try_from(count).unwrap_or(0).min(MAX_COPIES);
        let at = |k: usize| glam::DVec2::from_angle(start + step * k as f64).extend(0.0) * radius;
        offsets.extend((0..count).map(|k| center + at(k)));
    } else {
        scale = parameters.optional_real().filter(|&scale| scale != 0.0).unwrap_or(1.0);
        let corner = parameters.point()?;
        let [columns, rows] = [parameters.integer()?, parameters.integer()?];
        let [across, up, angle] = [parameters.real()?, parameters.real()?, parameters.real()?];
        let [columns, rows] = [columns, rows].map(|n| usize::try_from(n).unwrap_or(0).min(MAX_COPIES));
        let turn = |x: f64, y: f64| glam::DVec2::from_angle(angle).rotate(glam::DVec2::new(x, y)).extend(0.0);
        // Positions are counted up each column, the columns from left to right.
        let places = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))).take(MAX_COPIES);
        offsets.extend(places.map(|(i, j)| corner + turn(across * i as f64, up * j as f64)));
    }
    let listed = parameters.count(1)?;
    let leaves_out = parameters.integer()? != 0;
    if listed > 0 {
        let list = (0..listed).map(|_| parameters.integer()).collect::<Outcome<FxHashSet<i64>>>()?;
        let mut position = 0;
        offsets.retain(|_| {
            position += 1;
            list.contains(&position) != leaves_out
        });
    }
    Ok((target, offsets, scale))
}
