//! Which samples are taken, and in what order.

use super::Seam;
use serde::{Deserialize, Serialize};

/// What becomes of the sample at an end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// It counts once.
    #[default]
    Once,
    /// It is missing.
    Missing,
    /// It counts twice.
    Twice,
}

/// How long the segment is that one sample too many stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extra {
    /// The step.
    Step,
    /// As long as the last segment.
    Last,
}

/// What is done with a last segment that is shorter than the others.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LastStep {
    /// It has its own length.
    #[default]
    Own,
    /// It counts as a whole one.
    Whole,
    /// It is left out.
    Dropped,
    /// All segments are D/n long.
    Even,
}

/// The samples of n segments, by index, in the order in which they are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Sequence {
    /// Of the first one.
    pub first: End,
    /// Of the last one.
    pub last: End,
    /// One sample more than there are segments: at D for samples in front, at 0 for samples at the back.
    pub extra: Option<Extra>,
    /// The back of the ray is taken for its front.
    pub swapped: bool,
    /// The transmittance of a sample is that of the one before.
    pub late: bool,
    /// Samples come in groups of so many, and what is left over is missing.
    pub unrolled: u64,
    /// No more than so many.
    pub most: Option<u64>,
    /// What a shorter last segment counts as.
    pub last_step: LastStep,
    /// What becomes of samples between blocks of segments.
    pub seam: Option<Seam>,
}

impl Default for Sequence {
    fn default() -> Self {
        Sequence {
            first: End::Once,
            last: End::Once,
            extra: None,
            swapped: false,
            late: false,
            unrolled: 1,
            most: None,
            last_step: LastStep::Own,
            seam: None,
        }
    }
}

impl Sequence {
    /// Indices of samples; −1 and n stand for the one too many.
    ///
    /// `partial` where the last segment is shorter, `back` where samples lie at the back of segments.
    #[must_use]
    pub fn order(&self, n: usize, partial: bool, back: bool) -> Vec<isize> {
        let order = self.without_seams(n, partial, back);
        let repeated = |i: isize| std::iter::repeat_n(i, self.times(i, n));
        order.into_iter().flat_map(repeated).collect()
    }

    /// How often the sample of that index is taken wherever it stands in the order.
    pub(super) fn times(&self, index: isize, n: usize) -> usize {
        let own = usize::try_from(index).ok().filter(|i| *i < n);
        match (self.seam, own) {
            (Some(seam), Some(i)) => seam.times(i, n),
            _ => 1,
        }
    }

    /// The same without regard to seams.
    pub(super) fn without_seams(&self, n: usize, partial: bool, back: bool) -> Vec<isize> {
        let group = usize::try_from(self.unrolled.max(1)).unwrap_or(1);
        let most = self.most.and_then(|most| usize::try_from(most).ok());
        let mut count = (n - n % group).min(most.unwrap_or(usize::MAX));
        if partial && self.last_step == LastStep::Dropped {
            count = count.min(n.saturating_sub(1));
        }
        let index = |i: usize| isize::try_from(i).unwrap_or(isize::MAX);
        let mut order: Vec<isize> = (0..count).map(index).collect();
        match self.first {
            End::Once => {}
            End::Missing => drop(order.drain(..order.len().min(1))),
            End::Twice => {
                if let Some(&first) = order.first() {
                    order.insert(0, first);
                }
            }
        }
        match self.last {
            End::Once => {}
            End::Missing => drop(order.pop()),
            End::Twice => order.extend(order.last().copied()),
        }
        if self.extra.is_some() {
            if back {
                order.insert(0, -1);
            } else {
                order.push(index(n));
            }
        }
        if self.swapped {
            order.reverse();
        }
        order
    }
}
