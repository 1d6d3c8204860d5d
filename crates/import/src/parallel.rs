//! Mapping in parallel where threads are to be had, with results in order.

/// `f` of every item, in order.
#[cfg(feature = "parallel")]
pub(crate) fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    items.par_iter().with_min_len(64).map(f).collect()
}

/// `f` of every item, in order.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map<T, R>(items: &[T], f: impl Fn(&T) -> R) -> Vec<R> {
    items.iter().map(f).collect()
}

/// The same for few items of much work each.
#[cfg(feature = "parallel")]
pub(crate) fn map_each<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    items.par_iter().map(f).collect()
}

/// The same for few items of much work each.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map_each<T, R>(items: &[T], f: impl Fn(&T) -> R) -> Vec<R> {
    map(items, f)
}
