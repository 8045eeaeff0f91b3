//! A study in shards.

use super::Study;
use crate::cli::budget::{Budget, HOUR};
use crate::cli::output::said;
use crate::cli::shards::{self, Needs};
use crate::cli::{Bar, Failure, Outcome};
use std::path::Path;
use volver::render;
use volver::study::Progress;
use volver::study::shards::{Division, Shard};
use volver::study::sweep::{Divided, Estimate, StudyShard, Sweep, run};

impl Study {
    /// Runs the shard, or lets an engine run all.
    pub(super) fn in_shards(
        &self,
        sweep: &Sweep,
        work: Divided,
        threads: usize,
        estimate: &Estimate,
    ) -> Result<Outcome, Failure> {
        self.sharding.refuse(&[
            ("--resume", self.resume),
            ("--json", self.forms.json.is_some()),
            ("--csv", self.forms.csv.is_some()),
        ])?;
        let Some(directory) = &self.out else {
            return Ok(Outcome::Good);
        };
        render::check_directory(directory)?;
        let model = Divided::model(sweep, estimate);
        let costs = match &self.sharding.costs {
            Some(earlier) => {
                let (division, gathered) = shards::earlier(earlier)?;
                work.learned(&model, &division, &gathered)
            }
            None => model.clone(),
        };
        let work = work.cut(&costs, self.sharding.count());
        let costs = (work.shares(&model), work.shares(&costs));
        let division = self.sharding.divided(directory, work, costs, 0)?;
        if let Some(shard) = self.sharding.here() {
            return self.one(sweep, &division, shard, threads, estimate, directory);
        }
        let threads = self.threads.map_or(1, usize::from);
        let needs = Needs {
            threads,
            bytes: estimate.bytes,
            words: format!("--threads {threads} --yes --quiet"),
        };
        self.sharding.hand_over(&division, directory, 0, needs)
    }

    fn one(
        &self,
        sweep: &Sweep,
        division: &Division<Divided>,
        number: usize,
        threads: usize,
        estimate: &Estimate,
        directory: &Path,
    ) -> Result<Outcome, Failure> {
        let units = division.units(number).map_err(said)?;
        let costs = division.costs.get(units.clone()).unwrap_or_default();
        let budget = Budget {
            what: "the shard",
            bytes: estimate.bytes,
            seconds: costs.iter().sum::<f64>() / threads as f64,
            usual: HOUR,
        };
        budget.check(self.yes)?;
        budget.announce();
        let shard = Shard::begin(directory, division, number).map_err(said)?;
        let before = shard.units() - shard.left();
        let mut shard = StudyShard::new(shard, &division.work);
        let blocks = division.work.blocks.get(units).unwrap_or_default();
        let works = blocks.iter().map(|block| block.work(sweep));
        let works = works.fold(0, u64::saturating_add);
        let bar = Bar::new(works);
        let ran = run(sweep, &mut shard, threads, &bar as &dyn Progress);
        bar.finish();
        ran.map_err(said)?;
        shards::finish(
            shard.into_shard(),
            number,
            division.shards(),
            before,
            self.forms.quiet,
        )
    }
}
