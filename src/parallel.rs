//! Work shared out among threads. Whatever the work, the machinery of threads is compiled once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// f of every item, in the order of the items, which are taken one by one.
pub(crate) fn map<I: Sync, T: Send>(items: &[I], f: impl Fn(&I) -> T + Sync) -> Vec<T> {
    let places: Vec<Mutex<Option<T>>> = items.iter().map(|_| Mutex::new(None)).collect();
    each(items.len(), &|index| {
        if let (Some(item), Some(place)) = (items.get(index), places.get(index)) {
            let value = f(item);
            *place.lock().unwrap_or_else(PoisonError::into_inner) = Some(value);
        }
    });
    places
        .into_iter()
        .filter_map(|place| place.into_inner().unwrap_or_else(PoisonError::into_inner))
        .collect()
}

/// The same of what may fail: after a failure no further item is begun.
pub(crate) fn try_map<I: Sync, T: Send, E: Send>(
    items: &[I],
    f: impl Fn(&I) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let failed = AtomicBool::new(false);
    let done = map(items, |item| {
        if failed.load(Ordering::Relaxed) {
            return None;
        }
        let value = f(item);
        failed.fetch_or(value.is_err(), Ordering::Relaxed);
        Some(value)
    });
    done.into_iter().flatten().collect()
}

/// Each thread takes the next index as soon as it is done with one.
fn each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    let next = AtomicUsize::new(0);
    let worker = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            work(index);
        }
    };
    rayon_core::scope(|scope| {
        for _ in 0..rayon_core::current_num_threads().min(count) {
            scope.spawn(|_| worker());
        }
    });
}
