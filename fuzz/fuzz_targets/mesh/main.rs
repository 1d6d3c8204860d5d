//! Any bytes as a STEP file, through to a mesh: nothing may panic, hang or take memory out of proportion, and what
//! comes out must be consistent.

#![no_main]

#[path = "../consistent.rs"]
mod consistent;
#[path = "../tokens.rs"]
mod tokens;

use libfuzzer_sys::{fuzz_mutator, fuzz_target, fuzzer_mutate};
use trimloop_import::import_step;
use trimloop_part21::{Exchange, ReadOptions};

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions { max_bytes: 1 << 24, ..ReadOptions::default() };
    let Ok(exchange) = Exchange::parse_with(bytes.to_vec(), &options) else { return };
    let Ok(model) = import_step(&exchange) else { return };
    consistent::check(&model);
});

// Every fourth time as the fuzzer likes, otherwise so that the file stays readable.
fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let changed = if seed % 4 == 0 { None } else { tokens::mutate(data, size, max_size, seed, &tokens::STEP) };
    changed.unwrap_or_else(|| fuzzer_mutate(data, size, max_size))
});
