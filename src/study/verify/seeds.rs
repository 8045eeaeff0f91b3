//! Whether seeds differ: by everything that a kernel answers to them.

use super::asked::Answers;
use rug::Float;
use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hash, Hasher};

/// What was answered to every seed, in all.
pub(super) struct Seeds(Vec<DefaultHasher>);

impl Seeds {
    pub(super) fn new(count: usize) -> Self {
        Seeds(vec![DefaultHasher::new(); count])
    }

    /// Takes note of the answers to one case.
    pub(super) fn hear(&mut self, answers: &Answers) {
        for level in answers.by_seed() {
            for (seed, answer) in self.0.iter_mut().zip(level) {
                let radiance = answer.as_ref().map(|rendering| &rendering.radiance[..]);
                let bits = |value: &Float| value.to_f64().to_bits();
                let bits: Vec<u64> = radiance.unwrap_or_default().iter().map(bits).collect();
                bits.hash(seed);
            }
        }
    }

    /// How many seeds have answers of their own.
    pub(super) fn different(&self) -> usize {
        let all: BTreeSet<u64> = self.0.iter().map(DefaultHasher::finish).collect();
        all.len()
    }
}
