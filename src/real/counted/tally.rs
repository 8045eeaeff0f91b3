//! The tally, and what was added to it meanwhile.

use super::Kind;
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::array;
use std::cell::Cell;
use std::ops::{Add, AddAssign, Index};

const KINDS: usize = Kind::ALL.len();

thread_local! {
    // A format has no room for a reference to its counter. The tally only grows, and everybody takes
    // differences: scopes nest, and one that a panic ends leaves nothing to put right.
    static TALLY: [Cell<u64>; KINDS] = const { [const { Cell::new(0) }; KINDS] };
}

/// One more of that kind.
#[inline]
pub(crate) fn tick(kind: Kind) {
    TALLY.with(|tally| {
        let cell = &tally[kind as usize];
        cell.set(cell.get().wrapping_add(1));
    });
}

fn tally() -> [u64; KINDS] {
    TALLY.with(|tally| array::from_fn(|kind| tally[kind].get()))
}

/// What `work` gives, and what numbers of [`Counted`](super::Counted) formats and
/// [counted cases](crate::case::CountedCase) did meanwhile on this thread. Work that it hands to other threads
/// is not among it. Scopes nest: the outer one counts what the inner one does too.
///
/// ```
/// use volver::real::counted::{Counted, Kind, count};
/// use volver::real::{Format, Native, Real};
///
/// let format = Counted(Native::<f32>::new());
/// let (value, counts) = count(|| (format.int(1) + &format.int(2)).exp());
/// assert_eq!(value.into_inner(), 3_f32.exp());
/// assert_eq!(counts[Kind::Integer], 2);
/// assert_eq!(counts[Kind::Addition], 1);
/// assert_eq!(counts[Kind::Exponential], 1);
/// ```
pub fn count<T>(work: impl FnOnce() -> T) -> (T, Counts) {
    let before = tally();
    let result = work();
    let after = tally();
    let counts = array::from_fn(|kind| after[kind].wrapping_sub(before[kind]));
    (result, Counts { counts })
}

/// Does `work` outside of every [`count`] around it: what is done once and kept for all who come later belongs
/// to none of them, and would make the first one's counts differ from the second's.
pub fn uncounted<T>(work: impl FnOnce() -> T) -> T {
    struct Restore([u64; KINDS]);
    impl Drop for Restore {
        fn drop(&mut self) {
            TALLY.with(|tally| {
                for (cell, before) in tally.iter().zip(self.0) {
                    cell.set(before);
                }
            });
        }
    }
    let _restore = Restore(tally());
    work()
}

/// How often each [`Kind`] of work was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    counts: [u64; KINDS],
}

impl Counts {
    /// The kinds that were counted, and how often.
    pub fn iter(&self) -> impl Iterator<Item = (Kind, u64)> {
        let all = Kind::ALL.into_iter().zip(self.counts);
        all.filter(|(_, count)| *count > 0)
    }

    /// How often the transfer functions were asked, both or τ alone: evaluations of the medium.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self[Kind::Transfer].saturating_add(self[Kind::Extinction])
    }

    /// All operations of arithmetic and functions, of whatever kind; neither evaluations, which are made of
    /// them, nor copies.
    #[must_use]
    pub fn operations(&self) -> u64 {
        let is_operation = |kind: Kind| !kind.is_evaluation() && kind != Kind::Copy;
        let operations = self.iter().filter(|(kind, _)| is_operation(*kind));
        operations.fold(0, |sum, (_, count)| sum.saturating_add(count))
    }

    /// Calls of transcendental functions.
    #[must_use]
    pub fn transcendentals(&self) -> u64 {
        let calls = self.iter().filter(|(kind, _)| kind.is_transcendental());
        calls.fold(0, |sum, (_, count)| sum.saturating_add(count))
    }

    /// These after as many more steps as led from `before` to here; `None` where they fell, or beyond 2⁶⁴.
    #[cfg(feature = "studies")]
    pub(crate) fn carried_on(&self, before: &Counts, steps: u64) -> Option<Counts> {
        let mut carried = Counts::default();
        for (carried, (now, before)) in carried
            .counts
            .iter_mut()
            .zip(self.counts.iter().zip(before.counts))
        {
            let step = now.checked_sub(before)?;
            *carried = step.checked_mul(steps)?.checked_add(*now)?;
        }
        Some(carried)
    }

    /// The counts of nothing but `count` of one kind.
    #[must_use]
    pub fn of(kind: Kind, count: u64) -> Counts {
        let mut counts = Counts::default();
        counts.counts[kind as usize] = count;
        counts
    }
}

impl Index<Kind> for Counts {
    type Output = u64;
    fn index(&self, kind: Kind) -> &u64 {
        &self.counts[kind as usize]
    }
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count = count.saturating_add(more);
        }
    }
}

impl Add for Counts {
    type Output = Counts;
    fn add(mut self, other: Counts) -> Counts {
        self += other;
        self
    }
}

/// A map from kinds to counts, kinds that were not counted left out.
impl Serialize for Counts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (kind, count) in self.iter() {
            map.serialize_entry(&kind, &count)?;
        }
        map.end()
    }
}
