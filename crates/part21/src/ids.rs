//! From an instance's number to its place in the table.

use crate::record::Record;

/// Numbers to indices into the table.
#[derive(Debug)]
pub(crate) enum IdTable {
    /// By number, from the smallest one on; [`NONE`] where there is no instance.
    Dense { first: u64, indices: Vec<u32> },
    /// The indices in order of the numbers, for files that spread their numbers wide: a look-up bisects.
    Sorted(Vec<u32>),
}

const NONE: u32 = u32::MAX;

/// How many times as many places as instances a dense table may have: 4 bytes each.
const SPREAD: u64 = 4;

impl IdTable {
    /// The table, or the indices (ascending) of the records whose number an earlier one has.
    pub fn new(records: &[Record]) -> Result<Self, Vec<u32>> {
        let numbers = || records.iter().map(|record| record.id);
        let first = numbers().min().unwrap_or(0);
        let range = numbers().max().unwrap_or(0) - first;
        if range < SPREAD * records.len() as u64 + 1024 {
            dense(records, first, range)
        } else {
            sorted(records)
        }
    }

    pub fn index_of(&self, records: &[Record], id: u64) -> Option<usize> {
        match self {
            IdTable::Dense { first, indices } => {
                let place = usize::try_from(id.checked_sub(*first)?).ok()?;
                indices.get(place).filter(|&&index| index != NONE).map(|&index| index as usize)
            }
            IdTable::Sorted(order) => {
                let found = order.binary_search_by_key(&id, |&index| records[index as usize].id).ok()?;
                Some(order[found] as usize)
            }
        }
    }
}

fn dense(records: &[Record], first: u64, range: u64) -> Result<IdTable, Vec<u32>> {
    let mut indices = vec![NONE; if records.is_empty() { 0 } else { range as usize + 1 }];
    let mut repeated = Vec::new();
    for (index, record) in records.iter().enumerate() {
        let place = &mut indices[(record.id - first) as usize];
        if *place == NONE {
            *place = index as u32;
        } else {
            repeated.push(index as u32);
        }
    }
    if repeated.is_empty() { Ok(IdTable::Dense { first, indices }) } else { Err(repeated) }
}

fn sorted(records: &[Record]) -> Result<IdTable, Vec<u32>> {
    let id = |index: u32| records[index as usize].id;
    let mut order: Vec<u32> = (0..records.len() as u32).collect();
    // By index too, so that the first of equals is the first in the file.
    order.sort_unstable_by_key(|&index| (id(index), index));
    let mut repeated: Vec<u32> =
        order.windows(2).filter(|pair| id(pair[0]) == id(pair[1])).map(|pair| pair[1]).collect();
    repeated.sort_unstable();
    if repeated.is_empty() { Ok(IdTable::Sorted(order)) } else { Err(repeated) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records(ids: &[u64]) -> Vec<Record> {
        ids.iter().map(|&id| Record { id, ..Record::unchecked(0, 0) }).collect()
    }

    #[test]
    fn numbers_close_together_and_far_apart_are_found_alike() {
        for ids in [vec![], vec![7], vec![3, 1, 2], vec![1 << 40, (1 << 40) + 2], vec![u64::MAX, 0, 1 << 40]]
        {
            let records = records(&ids);
            let table = IdTable::new(&records).unwrap();
            for (index, &id) in ids.iter().enumerate() {
                assert_eq!(table.index_of(&records, id), Some(index));
                assert_eq!(table.index_of(&records, id ^ 77), None);
            }
        }
    }

    #[test]
    fn the_later_of_two_equal_numbers_is_named() {
        assert_eq!(IdTable::new(&records(&[5, 6, 5, 5])).unwrap_err(), [2, 3]);
        assert_eq!(IdTable::new(&records(&[u64::MAX, 6, u64::MAX, 6])).unwrap_err(), [2, 3]);
    }
}
