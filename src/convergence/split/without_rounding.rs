//! All methods without rounding on one level, at one precision.

use super::known::{First, Known};
use super::ran::{Exact, exact};
use crate::case::{AnyNodes, Case, Shared};
use crate::method::{Level, Method, MethodError};
use crate::real::Mpfr;
use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What methods gave, by their places among all, and the exponentials that they took.
#[derive(Debug)]
pub(super) struct WithoutRounding {
    pub(super) known: Known,
    methods: Mutex<BTreeMap<usize, Result<Exact, MethodError>>>,
}

impl WithoutRounding {
    /// Nothing computed yet.
    pub(super) fn new(format: Mpfr) -> Self {
        WithoutRounding {
            known: Known::new(format),
            methods: Mutex::default(),
        }
    }

    /// Runs those of `methods` on n segments that were not run yet.
    pub(super) fn run<'m, C: Case>(
        &self,
        nodes: &Shared<'_, C, Mpfr>,
        n: u64,
        methods: impl Iterator<Item = (usize, &'m Method)>,
    ) {
        // Held while methods run: who comes second wants the same.
        let mut kept = self.methods();
        let first = First(&self.known);
        let mut level = Level::nearly(AnyNodes::new(nodes), n, &first);
        // The best depths first: others lie near them.
        let mut methods: Vec<(usize, &Method)> = methods.collect();
        methods.sort_by(|(_, a), (_, b)| inner_order(b).total_cmp(&inner_order(a)));
        for (index, method) in methods {
            kept.entry(index)
                .or_insert_with(|| exact(&mut level, method));
        }
        // Of all that the level had, exponentials alone are asked for again.
        drop(level);
        nodes.forget_columns(n);
    }

    /// What that method gave, where it was run.
    pub(super) fn of(&self, index: usize) -> Option<Result<Exact, MethodError>> {
        self.methods().get(&index).cloned()
    }

    fn methods(&self) -> MutexGuard<'_, BTreeMap<usize, Result<Exact, MethodError>>> {
        // Entries go in whole, so a poisoned map is still sound.
        self.methods.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The order of the depths that a method takes exponentials of.
fn inner_order(method: &Method) -> f64 {
    match method {
        Method::Nested(nested) => nested.inner.order(None).unwrap_or(f64::INFINITY),
        _ => 0.0,
    }
}
