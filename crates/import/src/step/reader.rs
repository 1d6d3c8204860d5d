//! Reading geometry under one representation's units.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use trimloop_brep::{Diagnostic, Diagnostics, Severity};
use trimloop_geom::Frame;
use trimloop_part21::Param;

use super::attributes::Attributes;
use super::fault::{Fault, Outcome};
use super::keyword::Kind;
use super::table::Table;
use super::units::Units;

/// How deep curves and surfaces may be built on others.
const MAX_DEPTH: usize = 24;

/// How many nested curves and surfaces may be built for one file. Shared by all readers: entities that refer to
/// each other in fans could otherwise ask for exponentially many.
pub(crate) struct Budget(AtomicUsize);

impl Budget {
    /// Enough for a file of `entities` entities, each used several times.
    pub fn for_entities(entities: usize) -> Self {
        Self(AtomicUsize::new(100_000 + 8 * entities))
    }

    fn spend(&self) -> bool {
        self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_ok()
    }
}

/// Reads points, placements, curves and surfaces whose numbers are in given units.
pub(crate) struct Reader<'t> {
    /// The entities.
    pub table: &'t Table<'t>,
    /// What the numbers mean.
    pub units: Units,
    /// What was repaired on the way.
    pub notes: Diagnostics,
    /// Whether surfaces are read to be used as a whole, with no loops to bound them.
    pub whole_surface: bool,
    budget: &'t Budget,
    depth: usize,
}

impl<'t> Reader<'t> {
    /// A reader with nothing read yet.
    pub fn new(table: &'t Table<'t>, budget: &'t Budget, units: Units) -> Self {
        Self { table, units, notes: Vec::new(), whole_surface: false, budget, depth: 0 }
    }

    /// Runs `read` one level deeper; refuses when that is too deep, which ends reference cycles too.
    pub fn nested<T>(&mut self, index: usize, read: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        if self.depth >= MAX_DEPTH {
            return Err(self.fault(index, "is built on too many others, or on itself"));
        }
        if self.depth > 0 && !self.budget.spend() {
            return Err(self.fault(index, "is used too often by others"));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// A fault of an entity.
    pub fn fault(&self, index: usize, message: &str) -> Fault {
        Fault::new(self.table.id(index), format!("{}: {message}", self.table.type_name(index)))
    }

    /// A fault for an entity of an unexpected type.
    pub fn unexpected(&self, index: usize, wanted: &str) -> Fault {
        self.fault(index, &format!("is no {wanted} that can be read"))
    }

    /// Notes a repair.
    pub fn note(&mut self, severity: Severity, code: &'static str, index: usize, message: String) {
        self.notes.push(Diagnostic::new(severity, code, self.table.entity(index), message));
    }

    /// `cartesian_point`, millimetres; missing coordinates are zero.
    pub fn point(&self, index: usize) -> Outcome<DVec3> {
        let mut attributes = self.table.attributes(index);
        if self.table.kind(index) != Kind::CartesianPoint {
            return Err(self.unexpected(index, "point"));
        }
        attributes.skip(1);
        Ok(triple(&mut attributes, "coordinates")? * self.units.length_mm)
    }

    /// `direction`: as written, no unit vector in general.
    pub fn direction(&self, index: usize) -> Outcome<DVec3> {
        let mut attributes = self.table.attributes(index);
        if self.table.kind(index) != Kind::Direction {
            return Err(self.unexpected(index, "direction"));
        }
        attributes.skip(1);
        triple(&mut attributes, "direction ratios")
    }

    /// `vector`: direction times magnitude, millimetres.
    pub fn vector(&self, index: usize) -> Outcome<DVec3> {
        if self.table.kind(index) != Kind::Vector {
            return Err(self.unexpected(index, "vector"));
        }
        let mut attributes = self.table.attributes(index).after(1);
        let direction = self.direction(attributes.reference("orientation")?)?;
        let magnitude = attributes.real("magnitude")?;
        let unit = direction.try_normalize();
        match unit {
            Some(unit) if magnitude != 0.0 => Ok(unit * magnitude * self.units.length_mm),
            _ => Err(attributes.fault("has no direction")),
        }
    }

    /// `axis2_placement_3d` or `axis2_placement_2d`.
    pub fn frame(&self, index: usize) -> Outcome<Frame> {
        let mut attributes = self.table.attributes(index).after(1);
        match self.table.kind(index) {
            Kind::Axis2Placement3d => {
                let origin = self.point(attributes.reference("location")?)?;
                let z = self.optional_direction(&mut attributes)?;
                let x = self.optional_direction(&mut attributes)?;
                Ok(frame(origin, z, x))
            }
            Kind::Axis2Placement2d => {
                let origin = self.point(attributes.reference("location")?)?;
                let x = self.optional_direction(&mut attributes)?;
                Ok(frame(origin, None, x))
            }
            Kind::Axis1Placement => {
                let (origin, z) = self.axis(index)?;
                Ok(frame(origin, Some(z), None))
            }
            _ => Err(self.unexpected(index, "placement")),
        }
    }

    /// `axis1_placement`: a point and a unit direction.
    pub fn axis(&self, index: usize) -> Outcome<(DVec3, DVec3)> {
        let mut attributes = self.table.attributes(index).after(1);
        if !matches!(self.table.kind(index), Kind::Axis1Placement | Kind::Axis2Placement3d) {
            return Err(self.unexpected(index, "axis"));
        }
        let origin = self.point(attributes.reference("location")?)?;
        let axis = self.optional_direction(&mut attributes)?.unwrap_or(DVec3::Z);
        Ok((origin, axis.try_normalize().unwrap_or(DVec3::Z)))
    }

    /// A direction that may be left out; a zero one counts as left out.
    pub fn optional_direction(&self, attributes: &mut Attributes<'_>) -> Outcome<Option<DVec3>> {
        match attributes.clone().param() {
            Some(Param::Reference(_)) => {
                let direction = self.direction(attributes.reference("direction")?)?;
                Ok(Some(direction).filter(|direction| *direction != DVec3::ZERO))
            }
            _ => {
                attributes.skip(1);
                Ok(None)
            }
        }
    }
}

/// Up to three numbers of a list.
fn triple(attributes: &mut Attributes<'_>, what: &str) -> Outcome<DVec3> {
    let mut list = attributes.list(what)?;
    let mut values = [0.0; 3];
    for (i, value) in values.iter_mut().enumerate() {
        match list.next() {
            Some(param) => *value = attributes.number(Some(param), what)?,
            None if i == 0 => return Err(attributes.fault(format!("has no {what}"))),
            None => break,
        }
    }
    Ok(DVec3::from_array(values))
}

/// ISO 10303-42 `build_axes`: the default for a missing x is the world's X, or its Y when z lies along X.
fn frame(origin: DVec3, z: Option<DVec3>, x: Option<DVec3>) -> Frame {
    let z = z.unwrap_or(DVec3::Z);
    let along_x = z.cross(DVec3::X).length() <= 1e-9 * z.length();
    Frame::new(origin, z, x.unwrap_or(if along_x { DVec3::Y } else { DVec3::X }))
}
