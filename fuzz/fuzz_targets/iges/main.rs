//! Any bytes as an IGES file, through to a mesh: nothing may panic, hang or take memory out of proportion, and what
//! comes out must be consistent.

#![no_main]

#[path = "../consistent.rs"]
mod consistent;
#[path = "../tokens.rs"]
mod tokens;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use trimloop_iges::IgesFile;
use trimloop_import::import_iges;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = IgesFile::parse(bytes) else { return };
    let Ok(model) = import_iges(&file) else { return };
    consistent::check(&model);
});

// Every fourth time as the fuzzer likes, otherwise so that the file stays readable.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let changed = if seed % 4 == 0 { None } else { tokens::mutate(data, size, max_size, seed, &tokens::IGES) };
    changed.unwrap_or_else(|| fuzzer_mutate(data, size, max_size))
});
