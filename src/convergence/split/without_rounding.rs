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
        let mut level = Level::taking(AnyNodes::new(nodes), n, &first);
        for (index, method) in methods {
            kept.entry(index)
                .or_insert_with(|| exact(&mut level, method));
        }
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
