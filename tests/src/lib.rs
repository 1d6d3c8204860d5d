//! Whole-pipeline tests: see `tests/`.
