//! A line a shard.

use super::{Array, this_program};

impl Array<'_> {
    /// The commands of all shards.
    pub(in crate::cli) fn shell(&self) -> String {
        let program = this_program();
        let lines = self.only.iter();
        lines
            .map(|shard| self.command(&program, &shard.to_string()) + "\n")
            .collect()
    }
}
