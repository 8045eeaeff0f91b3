//! Units are cut so that the dearest shard costs as little as it can.

use quickcheck::{QuickCheck, TestResult};
use volver::study::shards::cut;

fn dearest(costs: &[f64], ends: &[usize]) -> f64 {
    let begins = std::iter::once(0).chain(ends.iter().copied());
    let sums = begins
        .zip(ends)
        .map(|(begin, &end)| costs[begin..end].iter().sum::<f64>());
    sums.fold(0.0, f64::max)
}

/// The least that the dearest of so many shards costs, of all ways to cut.
fn least(costs: &[f64], shards: usize) -> f64 {
    if shards == 1 {
        return costs.iter().sum();
    }
    let ways = (1..=costs.len() - (shards - 1)).map(|first| {
        let sum: f64 = costs[..first].iter().sum();
        sum.max(least(&costs[first..], shards - 1))
    });
    ways.fold(f64::INFINITY, f64::min)
}

#[test]
fn no_other_cut_is_better() {
    fn property(costs: Vec<u8>, shards: u8) -> TestResult {
        // Whole numbers add up exactly, in any order.
        let costs: Vec<f64> = costs.into_iter().take(9).map(f64::from).collect();
        if costs.is_empty() {
            return TestResult::discard();
        }
        let shards = usize::from(shards) % costs.len() + 1;
        let ends = cut(&costs, shards);
        let begins = std::iter::once(0).chain(ends.iter().copied());
        let is_full = begins.zip(&ends).all(|(begin, end)| begin < *end);
        let is_whole = ends.len() == shards && ends.last() == Some(&costs.len());
        TestResult::from_bool(
            is_full && is_whole && dearest(&costs, &ends) <= least(&costs, shards),
        )
    }
    QuickCheck::new()
        .tests(2000)
        .quickcheck(property as fn(Vec<u8>, u8) -> TestResult);
}

#[test]
fn sixty_four_shards_of_equal_units_are_within_a_unit_of_each_other() {
    let ends = cut(&vec![1.0; 348], 64);
    assert_eq!(dearest(&vec![1.0; 348], &ends), 6.0);
}
