//! Random media for quickcheck.

use quickcheck::{Arbitrary, Gen};
use volver::case::random::RandomCase;

#[derive(Clone, Debug)]
pub(super) struct Medium(pub(super) RandomCase);

impl Arbitrary for Medium {
    fn arbitrary(g: &mut Gen) -> Medium {
        Medium(RandomCase::from_seed(u64::arbitrary(g)))
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Medium>> {
        Box::new(self.0.simpler().map(Medium))
    }
}
