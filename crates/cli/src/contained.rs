//! Panics: none should be, and none shall cost more than one file.

use std::panic::{self, AssertUnwindSafe};
use std::sync::{Mutex, Once, PoisonError};

use anyhow::anyhow;

static LAST: Mutex<Option<String>> = Mutex::new(None);
static HOOK: Once = Once::new();

/// Runs `work`; a panic in it, on whatever thread, becomes an error that says where it was.
pub fn contained<T>(work: impl FnOnce() -> anyhow::Result<T>) -> anyhow::Result<T> {
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|panic| {
            *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic.to_string());
        }));
    });
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let what = LAST.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or_default();
        Err(anyhow!("internal error, please report it with the file: {}", what.replace('\n', " ")))
    })
}

#[cfg(test)]
mod tests {
    use super::contained;

    #[test]
    fn a_panic_becomes_an_error_that_says_where() {
        let error = contained::<()>(|| panic!("impossible")).expect_err("an error").to_string();
        assert!(error.contains("internal error") && error.contains("impossible"), "{error}");
        assert!(error.contains("contained.rs"), "{error}");
    }

    #[test]
    fn what_does_not_panic_passes() {
        assert_eq!(contained(|| Ok(7)).expect("a value"), 7);
    }
}
