//! Checks records against the grammar, on all cores.

use crate::fault::{Damage, DamageList, Fault};
use crate::grammar::space;
use crate::record::{FAR, Prefix, Record, body, prefix};
use crate::scan::{begins_record, next_record_line};
use crate::scope::{ScopeMark, resolve};

/// Records that are checked before what was found is put together, which bounds what a file with nothing but damage
/// takes.
const BATCH: usize = 1 << 17;

/// Records that one thread checks at a time.
const CHUNK: usize = 1 << 10;

/// What is found besides records that are as they should be.
struct Findings {
    /// Records in the text of others, because a `;` is missing or a scope begins.
    extra: Vec<Record>,
    scopes: Vec<ScopeMark>,
    damage: DamageList,
}

/// Fills in the records, in file order, and drops what is damaged. The result does not depend on the number of cores.
pub(crate) fn check_all(text: &[u8], records: &mut Vec<Record>, damage: &mut DamageList) {
    let limit = damage.limit();
    let check_chunk = |chunk: &mut [Record]| {
        let mut findings = Findings { extra: Vec::new(), scopes: Vec::new(), damage: DamageList::new(limit) };
        chunk.iter_mut().for_each(|record| check(text, record, &mut findings));
        findings
    };
    let (mut extra, mut scopes) = (Vec::new(), Vec::new());
    for batch in records.chunks_mut(BATCH) {
        for findings in in_chunks(batch, check_chunk) {
            extra.extend(findings.extra);
            scopes.extend(findings.scopes);
            damage.append(findings.damage);
        }
    }
    if !extra.is_empty() {
        records.append(&mut extra);
        records.sort_by_key(|record| record.start);
    }
    records.retain(Record::is_usable);
    if !scopes.is_empty() {
        resolve(records, &scopes, damage);
        records.retain(Record::is_usable);
    }
}

#[cfg(feature = "parallel")]
fn in_chunks(
    records: &mut [Record],
    check: impl Fn(&mut [Record]) -> Findings + Sync + Send,
) -> Vec<Findings> {
    use rayon::prelude::*;
    records.par_chunks_mut(CHUNK).map(check).collect()
}

#[cfg(not(feature = "parallel"))]
fn in_chunks(records: &mut [Record], check: impl Fn(&mut [Record]) -> Findings) -> Vec<Findings> {
    records.chunks_mut(CHUNK).map(check).collect()
}

/// Checks the record in place, and the further ones in its text.
fn check(file: &[u8], record: &mut Record, findings: &mut Findings) {
    let end = record.end();
    let mut resume = check_one(file, record, findings);
    while let Some(start) = resume {
        let mut another = Record::unchecked(start, end);
        resume = check_one(file, &mut another, findings);
        if another.is_usable() {
            findings.extra.push(another);
        }
    }
}

/// What is left over after a record.
enum Left<'a> {
    /// Nothing, or damage, or the next record.
    Text(&'a [u8]),
    /// The record only opened a scope, and this is inside.
    Scope(&'a [u8]),
}

/// Checks one record; damage is reported once, and a record that cannot be read is made unusable. Gives the offset of
/// the next instance within the record's text, if there is one: always further on.
fn check_one(file: &[u8], record: &mut Record, findings: &mut Findings) -> Option<usize> {
    let text = record.text(file);
    let (instance, fault) = match read(text, record, &mut findings.scopes) {
        Ok(Left::Text([]) | Left::Scope([])) => return None,
        Ok(Left::Scope(inside)) => return Some(record.start + text.len() - inside.len()),
        Ok(Left::Text(rest)) => (Some(record.id), Fault { rest, message: "a semicolon is expected here" }),
        Err((instance, fault)) => (instance, fault),
    };
    let fault_at = text.len() - fault.rest.len();
    findings.damage.push(Damage { offset: record.start + fault_at, instance, message: fault.message });
    // Never 0, or there would be no end to it.
    let next =
        if fault_at > 0 && begins_record(fault.rest) { Some(fault_at) } else { next_record_line(text) };
    next.map(|at| record.start + at)
}

/// Fills in the record; gives what is left over of the text, or the damage and the instance it concerns.
fn read<'a>(
    text: &'a [u8],
    record: &mut Record,
    scopes: &mut Vec<ScopeMark>,
) -> Result<Left<'a>, (Option<u64>, Fault<'a>)> {
    record.length = 0;
    let (body_text, prefix) = prefix(text).map_err(|error| (None, Fault::of(error)))?;
    let instance = match prefix {
        Prefix::Number(id) => Some(id),
        Prefix::ScopeEnd => None,
    };
    if let (Some(_), Some(inside)) = (instance, body_text.strip_prefix(b"&SCOPE")) {
        scopes.push(ScopeMark { offset: record.start, opens: instance });
        return Ok(Left::Scope(space(inside)));
    }
    let (after, keyword_length) = body(body_text).map_err(|error| (instance, Fault::of(error)))?;
    let Ok(keyword_length) = u16::try_from(keyword_length) else {
        return Err((
            instance,
            Fault { rest: body_text, message: "a keyword is longer than 65535 characters" },
        ));
    };
    if instance.is_none() {
        scopes.push(ScopeMark { offset: record.start, opens: None });
    }
    record.id = instance.unwrap_or_default();
    record.keyword_length = keyword_length;
    record.body_at = u16::try_from(text.len() - body_text.len()).unwrap_or(FAR);
    record.length = (text.len() - after.len()) as u32;
    Ok(Left::Text(space(after)))
}
