//! Random numbers and what is made of them, the same for the same seed.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

pub(super) struct Draw(Pcg64);

impl Draw {
    pub(super) fn new(seed: u64) -> Draw {
        Draw(Pcg64::seed_from_u64(seed))
    }

    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.0.next_u64() % n
    }

    pub(super) fn of<'t, T>(&mut self, all: &'t [T]) -> &'t T {
        &all[usize::try_from(self.below(all.len() as u64)).unwrap()]
    }

    /// A fraction strictly between 0 and 1, as text.
    pub(super) fn part(&mut self) -> String {
        let whole = *self.of(&[2, 3, 4, 5, 7, 8, 10, 16, 1000]);
        format!("{}/{whole}", 1 + self.below(whole - 1))
    }

    /// A number other than 0, small or tiny.
    pub(super) fn offset(&mut self) -> String {
        let sign = *self.of(&["", "-"]);
        let size = *self.of(&["1", "7", "1/3", "1/10^9", "1e-40", "1e-300"]);
        format!("{sign}{size}")
    }
}
