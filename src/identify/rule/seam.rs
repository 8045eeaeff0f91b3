//! Samples at the seams of blocks of segments: left out, or taken twice.

use serde::{Deserialize, Serialize};

/// Where a ray is cut into blocks, and what becomes of the samples at their ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Seam {
    /// The blocks.
    pub blocks: Blocks,
    /// Which sample of a block.
    pub at: At,
    /// What becomes of it.
    pub effect: Effect,
    /// Of which blocks.
    pub of: Which,
    /// Rays of fewer segments have no seams.
    pub fewest: u64,
}

/// How n segments are cut into blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Blocks {
    /// So many segments each.
    Segments(u64),
    /// ⌊n/m⌋ segments each, and one block or more of what is left over.
    Floor(u64),
    /// m blocks of ⌊n/m⌋ segments, the last of which has what is left over, too.
    Rest(u64),
    /// ⌈n/m⌉ segments each.
    Ceiling(u64),
    /// m blocks from ⌊j n/m⌋ on.
    Even(u64),
}

/// A sample of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum At {
    /// The first one.
    First,
    /// The last one.
    Last,
    /// That with so many in front of it, of blocks of so many segments.
    Index(u64),
}

/// What becomes of a sample at a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effect {
    /// It is left out.
    Missing,
    /// It counts twice.
    Twice,
    /// It alone is taken.
    Only,
}

/// Blocks whose samples are concerned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Which {
    /// All of them.
    All,
    /// Those that have all their segments.
    Whole,
    /// All but where the ray begins or ends.
    Inner,
}

impl Blocks {
    /// How many segments, or how many blocks.
    #[must_use]
    pub fn count(self) -> u64 {
        match self {
            Blocks::Segments(count)
            | Blocks::Floor(count)
            | Blocks::Rest(count)
            | Blocks::Ceiling(count)
            | Blocks::Even(count) => count,
        }
    }

    /// Whether a block begins at segment i ≤ n of n.
    fn begins(self, i: u64, n: u64) -> bool {
        let count = self.count().max(1);
        let floor = || (n / count).max(1);
        match self {
            Blocks::Segments(_) => i.is_multiple_of(count),
            Blocks::Floor(_) => i.is_multiple_of(floor()),
            Blocks::Rest(_) => i.is_multiple_of(floor()) && i / floor() < count,
            Blocks::Ceiling(_) => i.is_multiple_of(n.div_ceil(count).max(1)),
            // A multiple of n lies within i m and the next m − 1.
            Blocks::Even(_) => (i * count + count - 1) % n.max(1) < count,
        }
    }
}

impl Seam {
    /// How often the sample of segment i of n is taken.
    #[must_use]
    pub fn times(&self, i: usize, n: usize) -> usize {
        let is_at = self.is_at(i as u64, n as u64);
        match (self.effect, is_at) {
            (Effect::Missing, true) | (Effect::Only, false) if n as u64 >= self.fewest => 0,
            (Effect::Twice, true) if n as u64 >= self.fewest => 2,
            _ => 1,
        }
    }

    /// What it does, in words.
    #[must_use]
    pub fn words(&self) -> String {
        let count = self.blocks.count();
        let cut = match self.blocks {
            Blocks::Segments(_) => format!("of every {count} segments"),
            Blocks::Floor(_) => format!("of every ⌊n/{count}⌋ of n segments"),
            Blocks::Ceiling(_) => format!("of every ⌈n/{count}⌉ of n segments"),
            Blocks::Rest(_) => {
                format!(
                    "of {count} blocks of ⌊n/{count}⌋ segments, the last with what is left over,"
                )
            }
            Blocks::Even(_) => format!("of {count} blocks, as even as n allows,"),
        };
        let at = match self.at {
            At::First => "the first".into(),
            At::Last => "the last".into(),
            At::Index(before) => format!("the sample behind {before} others"),
        };
        let does = match self.effect {
            Effect::Missing => "is missing",
            Effect::Twice => "counts twice",
            Effect::Only => "alone is taken",
        };
        let but = match (self.of, self.at) {
            (Which::Inner, At::First) => ", but for that of the ray",
            (Which::Inner, _) => ", but for that of the ray's end",
            (Which::All, At::Last) => match self.blocks {
                Blocks::Rest(_) | Blocks::Even(_) => "",
                _ => ", and of what is left over",
            },
            _ => "",
        };
        let fewest = if self.fewest > 1 {
            format!(", where n is {} or more", self.fewest)
        } else {
            String::new()
        };
        format!("{cut} {at} {does}{but}{fewest}")
    }

    fn is_at(&self, i: u64, n: u64) -> bool {
        match self.at {
            At::First => self.blocks.begins(i, n) && (i > 0 || self.of != Which::Inner),
            At::Last if i + 1 < n => self.blocks.begins(i + 1, n),
            At::Last => match self.of {
                Which::All => true,
                // The last of so many blocks has all that there are.
                Which::Whole => matches!(self.blocks, Blocks::Rest(_)) || self.blocks.begins(n, n),
                Which::Inner => false,
            },
            At::Index(before) => {
                let count = self.blocks.count().max(1);
                i % count == before
            }
        }
    }
}
