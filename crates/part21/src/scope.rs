//! Scope structures, which edition 1 (1994) had: `#1=&SCOPE #2=...; #3=...; ENDSCOPE /#2,#3/ KEYWORD(...);`.
//!
//! The instances inside are instances like any other here, whether exported (`/#2,#3/`) or not: the standard wants their
//! numbers to be unique in the file anyway. What remains is to give the number before `&SCOPE` to the record after the
//! matching `ENDSCOPE`.

use crate::fault::{Damage, DamageList};
use crate::record::Record;

/// Where a scope begins or ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScopeMark {
    pub offset: usize,
    /// The number before `&SCOPE`; none at `ENDSCOPE`, where a record starts that has no number yet.
    pub opens: Option<u64>,
}

/// Gives the records after `ENDSCOPE` their numbers. Records and marks are in file order.
pub(crate) fn resolve(records: &mut [Record], marks: &[ScopeMark], damage: &mut DamageList) {
    let mut open: Vec<(u64, usize)> = Vec::new();
    for mark in marks {
        if let Some(id) = mark.opens {
            open.push((id, mark.offset));
            continue;
        }
        let Ok(index) = records.binary_search_by_key(&mark.offset, |record| record.start) else { continue };
        match open.pop() {
            Some((id, _)) => records[index].id = id,
            None => {
                records[index].length = 0;
                damage.push(Damage {
                    offset: mark.offset,
                    instance: None,
                    message: "a scope ends that did not begin",
                });
            }
        }
    }
    for (id, offset) in open {
        damage.push(Damage { offset, instance: Some(id), message: "a scope does not end" });
    }
}
