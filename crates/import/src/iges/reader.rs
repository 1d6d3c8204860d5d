//! Entities and their parameters, with what is wrong with them.

use std::borrow::Cow;

use glam::{DAffine3, DMat3, DVec3};
use rustc_hash::FxHashMap;
use trimloop_brep::{Diagnostic, EntityRef, Severity};
use trimloop_iges::{DirectoryEntry, Entity, IgesFile, Value};

use crate::parallel;

/// Why an entity could not be understood.
#[derive(Clone, Debug)]
pub(crate) struct Fault {
    /// Its directory entry.
    pub entry: u32,
    /// A sentence that names it.
    pub message: String,
}

/// A value, or why there is none.
pub(crate) type Outcome<T> = Result<T, Fault>;

impl Fault {
    /// The entity of this directory entry has this fault.
    pub fn new(entry: u32, message: impl AsRef<str>) -> Self {
        Self { entry, message: format!("D{entry} {}", message.as_ref()) }
    }

    /// The fault as a diagnostic.
    pub fn diagnostic(&self, severity: Severity, code: &'static str) -> Diagnostic {
        Diagnostic::new(severity, code, EntityRef::Iges(self.entry), self.message.clone())
    }
}

/// Reads entities of a file.
#[derive(Clone, Copy)]
pub(crate) struct Reader<'f> {
    pub file: &'f IgesFile,
    /// The parameters of entities that have many, read beforehand.
    pub long: &'f LongEntities<'f>,
    /// Millimetres per unit of model space.
    pub unit_mm: f64,
}

/// The parameters of entities that have many, by directory entry.
pub(crate) type LongEntities<'f> = FxHashMap<u32, Vec<Value<'f>>>;

/// Entities of more text than this, bytes, are read beforehand, in parallel.
const LONG: usize = 400;

/// Reads the parameters of the curves and surfaces that have many.
pub(crate) fn read_long_entities(file: &IgesFile) -> LongEntities<'_> {
    let is_long = |entity: &Entity<'_>| {
        matches!(entity.directory.entity_type, 106 | 112 | 114 | 126 | 128) && entity.bytes() > LONG
    };
    let long: Vec<Entity<'_>> = file.entities().filter(is_long).collect();
    let read = parallel::map_each(&long, |entity| (entity.directory.number, values_of(entity)));
    read.into_iter().collect()
}

fn values_of<'f>(entity: &Entity<'f>) -> Vec<Value<'f>> {
    let mut values = Vec::with_capacity(entity.bytes() / 16 + 8);
    values.extend(entity.values());
    values
}

/// How deeply entities may refer to one another.
pub(crate) const MAX_DEPTH: usize = 32;

impl<'f> Reader<'f> {
    /// The parameters of an entity; the first that is read comes after its type.
    pub fn parameters(&self, entry: u32) -> Outcome<Parameters<'f>> {
        let entity = self.file.get(entry).ok_or_else(|| Fault::new(entry, "is no entity of the file"))?;
        let values = match self.long.get(&entry) {
            Some(values) => Cow::Borrowed(values.as_slice()),
            None => Cow::Owned(values_of(&entity)),
        };
        Ok(Parameters { directory: entity.directory, values, at: 1 })
    }

    /// Where an entity's own coordinates lie in the model, millimetres (IGES 5.3 section 4.21).
    pub fn placement(&self, directory: &DirectoryEntry) -> Outcome<DAffine3> {
        let scale = DAffine3::from_scale(DVec3::splat(self.unit_mm));
        Ok(scale * self.transformation(directory.transformation)?)
    }

    /// Where an entity's own coordinates lie, both in millimetres.
    pub fn placement_mm(&self, directory: &DirectoryEntry) -> Outcome<DAffine3> {
        self.matrix_mm(directory.transformation)
    }

    /// A transformation (0 for none) between millimetres.
    pub fn matrix_mm(&self, entry: u32) -> Outcome<DAffine3> {
        let mut map = self.transformation(entry)?;
        map.translation *= self.unit_mm;
        Ok(map)
    }

    /// A transformation and those that it refers to in turn.
    fn transformation(&self, mut entry: u32) -> Outcome<DAffine3> {
        let mut map = DAffine3::IDENTITY;
        for _ in 0..MAX_DEPTH {
            if entry == 0 {
                return Ok(map);
            }
            let mut parameters = self.parameters(entry)?;
            parameters.expect(&[124], "transformation")?;
            let mut row = || -> Outcome<[f64; 4]> {
                Ok([parameters.real()?, parameters.real()?, parameters.real()?, parameters.real()?])
            };
            let [a, b, c] = [row()?, row()?, row()?];
            let matrix = DMat3::from_cols(
                DVec3::new(a[0], b[0], c[0]),
                DVec3::new(a[1], b[1], c[1]),
                DVec3::new(a[2], b[2], c[2]),
            );
            let own = DAffine3::from_mat3_translation(matrix, DVec3::new(a[3], b[3], c[3]));
            if !(own.is_finite() && matrix.determinant().abs() > 1e-12) {
                return Err(Fault::new(entry, "is a transformation that flattens what it moves"));
            }
            map = own * map;
            entry = parameters.directory.transformation;
        }
        Err(Fault::new(entry, "is a transformation that refers to itself"))
    }

    /// The coordinates of a point (type 116) or a direction (type 123), placed but not scaled.
    pub fn triple(&self, entry: u32, types: &[i32], what: &str) -> Outcome<DVec3> {
        let mut parameters = self.parameters(entry)?;
        parameters.expect(types, what)?;
        let map = self.transformation(parameters.directory.transformation)?;
        let own = parameters.point()?;
        Ok(if types.contains(&123) { map.transform_vector3(own) } else { map.transform_point3(own) })
    }
}

/// An entity's parameters, one after the other.
pub(crate) struct Parameters<'f> {
    pub directory: &'f DirectoryEntry,
    values: Cow<'f, [Value<'f>]>,
    at: usize,
}

impl<'f> Parameters<'f> {
    /// What is wrong with the entity.
    pub fn fault(&self, message: impl AsRef<str>) -> Fault {
        let DirectoryEntry { entity_type, line, .. } = self.directory;
        let what = format!("(type {entity_type}, line {line}) {}", message.as_ref());
        Fault::new(self.directory.number, what)
    }

    /// Fails where the entity is of none of these types.
    pub fn expect(&self, types: &[i32], what: &str) -> Outcome<()> {
        if types.contains(&self.directory.entity_type) {
            return Ok(());
        }
        Err(self.fault(format!("is no {what}")))
    }

    fn next(&mut self) -> Value<'f> {
        let value = self.values.get(self.at).cloned().unwrap_or(Value::Default);
        self.at += 1;
        value
    }

    /// A real.
    pub fn real(&mut self) -> Outcome<f64> {
        let place = self.at;
        match self.next() {
            Value::Default if place < self.values.len() => Ok(0.0),
            value => value
                .real()
                .filter(|value| value.abs() < 1e100)
                .ok_or_else(|| self.fault(format!("has no usable number as its parameter {place}"))),
        }
    }

    /// A real that may be left out.
    pub fn optional_real(&mut self) -> Option<f64> {
        self.next().real().filter(|value| value.abs() < 1e100)
    }

    /// An integer; 0 where it is left out.
    pub fn integer(&mut self) -> Outcome<i64> {
        let place = self.at;
        match self.next() {
            Value::Default => Ok(0),
            value => {
                value.integer().ok_or_else(|| self.fault(format!("has no integer as its parameter {place}")))
            }
        }
    }

    /// A pointer; 0 for none.
    pub fn pointer(&mut self) -> Outcome<u32> {
        let value = self.integer()?;
        u32::try_from(value.unsigned_abs()).map_err(|_| self.fault("has a pointer out of range"))
    }

    /// A count of items of at least `size` parameters each; no more than there are parameters for.
    pub fn count(&mut self, size: usize) -> Outcome<usize> {
        let count = self.integer()?;
        let left = self.values.len().saturating_sub(self.at);
        usize::try_from(count)
            .ok()
            .filter(|count| count.saturating_mul(size) <= left)
            .ok_or_else(|| self.fault(format!("counts {count} items, but has {left} parameters left")))
    }

    /// Three reals.
    pub fn point(&mut self) -> Outcome<DVec3> {
        Ok(DVec3::new(self.real()?, self.real()?, self.real()?))
    }

    /// `count` reals.
    pub fn reals(&mut self, count: usize) -> Outcome<Vec<f64>> {
        if count > self.values.len().saturating_sub(self.at) {
            return Err(self.fault("has too few parameters"));
        }
        (0..count).map(|_| self.real()).collect()
    }

    /// `count` points.
    pub fn points(&mut self, count: usize) -> Outcome<Vec<DVec3>> {
        let flat = self.reals(count.saturating_mul(3))?;
        Ok(flat.chunks_exact(3).map(DVec3::from_slice).collect())
    }
}
