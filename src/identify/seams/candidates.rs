//! Ways to cut a ray into blocks that explain how often samples are taken.

use super::count::Counted;
use crate::identify::rule::{At, Blocks, Effect, Seam, Which};

/// The most segments of a block, of which two have to be seen on one ray.
const MOST_SEGMENTS: u64 = 131;
/// The most blocks of a ray.
const MOST_BLOCKS: u64 = 16;

/// A reading, and from how many segments on it may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    pub(super) seam: Seam,
    /// The most segments of a ray that should have seams and has none.
    without: usize,
}

impl Fit {
    /// The reading of that kind that explains what was counted.
    pub(super) fn of(seam: Seam, all: &[Counted]) -> Option<Self> {
        let everywhere = Seam { fewest: 1, ..seam };
        let (mut without, mut with) = (0, usize::MAX);
        let mut most = 0;
        let mut seen = 0;
        for counted in all {
            let n = counted.segments();
            let own = || (0..n).map(|i| everywhere.times(i, n));
            let is_plain = own().all(|times| times == 1);
            if own().eq(counted.times.iter().copied()) {
                if !is_plain {
                    with = with.min(n);
                    most = most.max(n);
                    seen += 1;
                }
            } else if counted.is_plain() {
                without = without.max(n);
            } else {
                return None;
            }
        }
        let shows_period = match seam.blocks {
            // Two blocks on one ray.
            Blocks::Segments(count) => 2 * count <= most as u64,
            _ => true,
        };
        if without >= with || seen < 2 || !shows_period {
            return None;
        }
        let fewest = if without == 0 { 1 } else { with as u64 };
        Some(Fit {
            seam: Seam { fewest, ..seam },
            without,
        })
    }

    /// Whether a ray of n segments tells from how many on there are seams.
    pub(super) fn is_open(&self, n: usize) -> bool {
        let everywhere = Seam {
            fewest: 1,
            ..self.seam
        };
        let is_between = n > self.without && (n as u64) < self.seam.fewest;
        is_between && (0..n).any(|i| everywhere.times(i, n) != 1)
    }
}

/// All readings that explain what was counted, simple ones first.
pub(super) fn candidates(all: &[Counted]) -> Vec<Fit> {
    let mut found = Vec::new();
    for effect in [Effect::Missing, Effect::Twice, Effect::Only] {
        let fewest = if effect == Effect::Only { 3 } else { 2 };
        let mut blocks: Vec<Blocks> = (fewest..=MOST_SEGMENTS).map(Blocks::Segments).collect();
        for kind in [Blocks::Floor, Blocks::Rest, Blocks::Ceiling, Blocks::Even] {
            blocks.extend((2..=MOST_BLOCKS).map(kind));
        }
        for blocks in blocks {
            for (at, of) in samples(blocks) {
                let seam = Seam {
                    blocks,
                    at,
                    effect,
                    of,
                    fewest: 1,
                };
                found.extend(Fit::of(seam, all));
            }
        }
    }
    found
}

/// Which samples of which blocks.
fn samples(blocks: Blocks) -> Vec<(At, Which)> {
    let mut all = vec![
        (At::First, Which::All),
        (At::First, Which::Inner),
        (At::Last, Which::Inner),
        (At::Last, Which::All),
    ];
    match blocks {
        Blocks::Segments(count) => {
            all.push((At::Last, Which::Whole));
            let inside = 1..count.saturating_sub(1);
            all.extend(inside.map(|before| (At::Index(before), Which::All)));
        }
        Blocks::Floor(_) | Blocks::Ceiling(_) => all.push((At::Last, Which::Whole)),
        Blocks::Rest(_) | Blocks::Even(_) => {}
    }
    all
}
