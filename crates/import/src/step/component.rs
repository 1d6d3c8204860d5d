//! Where a use of a product stands in its assembly.

use glam::DAffine3;

use super::keyword::Kind;
use super::product::{Product, Use};
use super::reader::{Budget, Reader};
use super::representation::Representations;
use super::table::Table;
use super::units::UnitTable;

/// Reads placements between representations.
pub(crate) struct Placements<'t> {
    /// The entities.
    pub table: &'t Table<'t>,
    /// The representations that hold the placements.
    pub representations: &'t Representations,
    /// Their units.
    pub units: &'t UnitTable,
    /// For nested entities.
    pub budget: &'t Budget,
}

impl Placements<'_> {
    /// The map from the used product's coordinates to its assembly's, with notes on what was wrong.
    pub fn of_use(&self, usage: &Use, assembly: &Product, component: &Product) -> (DAffine3, Reader<'_>) {
        let mut reader = Reader::new(self.table, self.budget, Default::default());
        let Some(relationship) = usage.relationship else {
            reader.note_missing_placement(usage.index);
            return (DAffine3::IDENTITY, reader);
        };
        let map = self.between(&mut reader, relationship, |first, second| {
            let child_first = component.representations.contains(&first);
            let child_second = component.representations.contains(&second);
            match (child_first, child_second) {
                (true, false) => false,
                (false, true) => true,
                _ => assembly.representations.contains(&first) && !assembly.representations.contains(&second),
            }
        });
        (map, reader)
    }

    /// The map of a placing relationship that no use claims: its first representation stands in its second, or
    /// the other way where `inverse`.
    pub fn of_attachment(&self, relationship: usize, inverse: bool) -> (DAffine3, Reader<'_>) {
        let mut reader = Reader::new(self.table, self.budget, Default::default());
        let map = self.between(&mut reader, relationship, |_, _| inverse);
        (map, reader)
    }

    /// The map from the first to the second representation of a relationship; from the second to the first where
    /// `is_inverse` says so of the two.
    fn between(
        &self,
        reader: &mut Reader<'_>,
        relationship: usize,
        is_inverse: impl Fn(usize, usize) -> bool,
    ) -> DAffine3 {
        let mut attributes = self.table.attributes(relationship).after(2);
        let (Some(first), Some(second)) = (attributes.optional_reference(), attributes.optional_reference())
        else {
            return DAffine3::IDENTITY;
        };
        let Some(operator) = attributes.optional_reference() else { return DAffine3::IDENTITY };
        let map = if self.table.kind(operator) == Kind::ItemDefinedTransformation {
            self.item_defined(reader, operator, first, second)
        } else {
            reader.units = self.representations.units(second, self.units);
            reader.placement_or_identity(operator)
        };
        let map = if is_inverse(first, second) { map.inverse() } else { map };
        if map.is_finite() { map } else { DAffine3::IDENTITY }
    }

    /// `item_defined_transformation`: the first item's placement goes to the second's. Each is read in the units
    /// of the representation that lists it; exporters that swap the two items are told by that, too.
    fn item_defined(
        &self,
        reader: &mut Reader<'_>,
        operator: usize,
        first: usize,
        second: usize,
    ) -> DAffine3 {
        let mut attributes = self.table.attributes(operator).after(2);
        let (Some(item1), Some(item2)) = (attributes.optional_reference(), attributes.optional_reference())
        else {
            reader.note_missing_placement(operator);
            return DAffine3::IDENTITY;
        };
        let lists = |representation, item| self.representations.lists(representation, item);
        let swapped =
            !lists(first, item1) && !lists(second, item2) && lists(first, item2) && lists(second, item1);
        let (from, to) = if swapped { (item2, item1) } else { (item1, item2) };
        reader.units = self.representations.units(first, self.units);
        let from = reader.placement_or_identity(from);
        reader.units = self.representations.units(second, self.units);
        let to = reader.placement_or_identity(to);
        to * from.inverse()
    }

    /// The map of a `mapped_item`: the mapped representation's origin goes to the item's target.
    pub fn of_mapped_item(&self, item: usize, owner: usize) -> Option<(usize, DAffine3, Reader<'_>)> {
        let mut reader = Reader::new(self.table, self.budget, Default::default());
        let mut attributes = self.table.attributes(item).after(1);
        let source = attributes.optional_reference()?;
        let target = attributes.optional_reference();
        let mut attributes = self.table.attributes(source);
        let origin = attributes.optional_reference();
        let mapped = attributes.optional_reference()?;
        reader.units = self.representations.units(mapped, self.units);
        let from = origin.map_or(DAffine3::IDENTITY, |origin| reader.placement_or_identity(origin));
        reader.units = self.representations.units(owner, self.units);
        let to = target.map_or(DAffine3::IDENTITY, |target| reader.placement_or_identity(target));
        let map = to * from.inverse();
        Some((mapped, if map.is_finite() { map } else { DAffine3::IDENTITY }, reader))
    }
}
