//! What runs do, counted; of many segments from runs of few.

use crate::case::{Case, CountedCase, Fresh, SymbolicCase};
use crate::method::{CompositingOrder, Inner, Method, Summation};
use crate::real::counted::{Counted, count};
use crate::real::{Counts, Mpfr};
use std::hint::black_box;

/// Up to so many segments a run is counted as it is.
const FEW: u64 = 256;
/// Numbers of segments that are the same modulo this suit the same rules, and end in the same way.
const CYCLE: u64 = 60;

/// What a run does. What a method does depends on how many bits there are and on nothing else of the format, so
/// that it is counted in MPFR for all of them: the methods are compiled once more for that, not once a format.
///
/// Where every segment is like every other, its counts are a + b n over the n of one remainder: those of many segments come of
/// two runs of few, and a third one has to be what they say.
#[must_use]
pub fn counts(case: &SymbolicCase, bits: u32, method: &Method, n: u64) -> Counts {
    let whole = |n| {
        let case = CountedCase(case);
        let nodes = Fresh::new(&case, Counted(Mpfr { bits }));
        let (_, counts) = count(|| black_box(method.radiance(&nodes, n)));
        counts
    };
    let Some(first) = first_of_few(case, method, n) else {
        return whole(n);
    };
    let [a, b, c] = [0, 1, 2].map(|i| whole(first + i * CYCLE));
    let carried = b.carried_on(&a, 1) == Some(c);
    let carried = carried.then(|| b.carried_on(&a, (n - first) / CYCLE - 1));
    carried.flatten().unwrap_or_else(|| whole(n))
}

/// The segments that are run for the counts of n.
pub(super) fn counted_segments(case: &SymbolicCase, method: &Method, n: u64) -> u64 {
    first_of_few(case, method, n).map_or(n, |first| 3 * (first + CYCLE))
}

/// The first of three runs of few segments that tell what one of n does, each a cycle longer than the one before; `None` where
/// it is counted as it is.
fn first_of_few(case: &SymbolicCase, method: &Method, n: u64) -> Option<u64> {
    (n > FEW && repeats(case, method)).then_some(CYCLE + n % CYCLE)
}

/// Whether a method does the same on every segment of a case: no break, behind which the medium is another; no early end; no
/// series as long as a segment's depth asks for; no samples at random; no tree, which grows by a level at times.
fn repeats(case: &SymbolicCase, method: &Method) -> bool {
    let of_method = match method {
        Method::Nested(nested) => !matches!(nested.inner, Inner::MonteCarlo { .. }),
        Method::Composited(compositing) => match compositing.order {
            CompositingOrder::FrontToBack {
                summation, stop, ..
            } => stop.is_none() && summation != Summation::Pairwise,
            CompositingOrder::BackToFront => true,
            CompositingOrder::Tree => false,
        },
        Method::Preintegrated(_) | Method::Layered(_) => false,
    };
    of_method && case.structure().breaks.is_empty()
}
