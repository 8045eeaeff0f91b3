//! What units took is learned from.

use super::scenarios::{division, work};
use crate::sweep::fixture::unit;
use volver::study::shards::{Gathered, Shard};
use volver::study::sweep::{Divided, Keep, StudyShard};

#[test]
fn what_was_run_takes_what_it_took_and_the_rest_as_its_format_did() {
    let folder = tempfile::tempdir().unwrap();
    let division = division(folder.path(), 1);
    let mut shard = StudyShard::new(
        Shard::begin(folder.path(), &division, 1).unwrap(),
        &division.work,
    );
    // By the model each takes 1 s, but the fourth.
    let blocks = &division.work.blocks;
    shard.keep(&blocks[0], unit("mpfr:4", 4), 3.0).unwrap();
    shard.keep(&blocks[1], unit("mpfr:5", 5), 5.0).unwrap();
    let gathered = Gathered::new(folder.path(), &division).unwrap();
    let same = work();
    let model = vec![1.0; same.header.formats.len()];
    let costs = same.learned(&model, &division, &gathered);
    assert_eq!(costs[..3], [3.0, 5.0, 4.0]);
    let mut other: Divided = work();
    other.header.levels.pop();
    let costs = other.learned(&vec![0.5; model.len()], &division, &gathered);
    assert_eq!(costs[..3], [1.5, 2.5, 2.0]);
}
