//! A verification in shards.

use super::Verify;
use crate::cli::output::said;
use crate::cli::shards::{self, Needs};
use crate::cli::study::results::Forms;
use crate::cli::{Bar, Failure, Outcome};
use std::path::{Path, PathBuf};
use std::time::Instant;
use volver::document::About;
use volver::kernel::{Kernel, Subject, process};
use volver::render;
use volver::study::shards::{Divisible, Division, Shard};
use volver::study::verify::Settings;
use volver::study::verify::apart::{Divided, Entry, Replayed, ask};

/// What a kernel may take beside volver, as far as anybody knows.
const BYTES: f64 = (1_u64 << 30) as f64;

impl Verify {
    /// Asks what the shard asks, or lets an engine run all.
    pub(super) fn in_shards(
        &self,
        kernel: &mut dyn Kernel,
        subjects: &[Subject],
        settings: &Settings,
    ) -> Result<Outcome, Failure> {
        let Some(directory) = &self.out else {
            return Ok(Outcome::Good);
        };
        render::check_directory(directory)?;
        let words = self.kernel.words();
        let work = Divided::new(kernel, words, subjects, settings);
        let work = work.map_err(|error| self.kernel.failed(error))?;
        let model = work.model(kernel, subjects, settings);
        let model = model.map_err(|error| self.kernel.failed(error))?;
        let costs = match &self.sharding.costs {
            Some(earlier) => {
                let (division, gathered) = shards::earlier(earlier)?;
                work.learned(&model, &division, &gathered)
            }
            None => model.clone(),
        };
        let sharding = &self.sharding;
        let division = sharding.divided(directory, work, (model, costs), words.len())?;
        let Some(number) = sharding.here() else {
            let needs = Needs {
                threads: 1,
                bytes: BYTES,
                words: "--quiet".into(),
            };
            return sharding.hand_over(&division, directory, words.len(), needs);
        };
        let mut shard = Shard::begin(directory, &division, number).map_err(said)?;
        let before = shard.units() - shard.left();
        let units = division.units(number).map_err(said)?;
        let keys = division.work.keys();
        let bar = Bar::new(settings.work(subjects, kernel.declaration()));
        let all = keys.iter().zip(&division.work.pieces);
        for (key, piece) in all.skip(units.start).take(units.len()) {
            if !shard.wants(*key) {
                continue;
            }
            let begun = Instant::now();
            let answers = ask(kernel, subjects, settings, *piece, &bar);
            let answers = answers.map_err(|error| self.kernel.failed(error))?;
            let took = begun.elapsed().as_secs_f64();
            shard.append(*key, took, &answers).map_err(said)?;
        }
        bar.finish();
        shards::finish(shard, number, division.shards(), before, self.quiet)
    }

    /// Judges the answers that shards have kept, as if the kernel were asked now.
    pub(in crate::cli) fn join(
        mut self,
        division: &Division<Divided>,
        entries: Vec<Entry>,
        directory: &Path,
        forms: &Forms,
    ) -> Result<Outcome, Failure> {
        self.out = Some(directory.into());
        self.quiet |= forms.quiet;
        self.color = forms.color;
        let json: Option<&PathBuf> = forms.json.as_ref();
        self.json = json.cloned().or(self.json);
        let settings = self.settings()?;
        let subjects = super::subjects(&self.cases, "--cases")?;
        let declaration = match &division.work.greeting {
            Some(line) => process::declared(line).map_err(|error| self.kernel.failed(error))?,
            None => self.kernel.started()?.declaration().clone(),
        };
        let kernel = Box::new(Replayed::new(declaration, entries));
        let words = self.kernel.words();
        let same = Divided::new(kernel.as_ref(), words, &subjects, &settings);
        let same = same.map_err(|error| self.kernel.failed(error))?;
        if let Some((what, found, wanted)) = division.work.difference(&same) {
            return Err(Failure::Usage(format!(
                "{}: its {what} are {found}, not {wanted} (allowed: as they were when it was divided)",
                directory.display()
            )));
        }
        let output = self.output();
        output.check()?;
        let about = About::new(&division.command);
        self.tested(kernel, &subjects, &settings, &output, &about)
    }
}
