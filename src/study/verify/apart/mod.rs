//! A verification on many machines: each keeps what the kernel answered, and where all answers are there they are judged by the
//! same code that judges those of a kernel that is asked.

mod answered;
mod digest;
mod recorded;
mod replayed;

pub use answered::Entry;
pub use recorded::Recorded;
pub use replayed::Replayed;

use super::identified::examined;
use super::prepared::Prepared;
use super::{Identify, Settings, VerifyError};
use crate::identify::together;
use crate::kernel::{Kernel, Subject};
use crate::study::Progress;
use crate::study::shards::{Divisible, Division, Gathered, Key};
use serde::{Deserialize, Serialize};

/// What one machine asks in one go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Piece {
    /// All levels of a case, by its place.
    Case(usize),
    /// The rays that say what the kernel computes.
    Rule,
    /// Many rays in one request.
    Together,
}

/// A verification, as machines know it by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Divided {
    /// The version of the program.
    pub volver: String,
    /// The kernel's words on the command line.
    pub kernel: String,
    /// What a program said of itself; empty of what can be asked again without running one.
    pub greeting: Option<String>,
    /// All that it declares.
    pub declaration: String,
    /// How it is tested.
    pub settings: String,
    /// The cases: their names and formulas.
    pub cases: Vec<String>,
    /// What is asked in one go each, in this order.
    pub pieces: Vec<Piece>,
}

impl Divisible for Divided {
    const KIND: &'static str = "verification";
    const COMMAND: &'static str = "verify";

    fn keys(&self) -> Vec<Key> {
        let of_all = [
            &self.volver,
            &self.kernel,
            &self.declaration,
            &self.settings,
        ];
        let key = |piece: &Piece| {
            let own = match piece {
                Piece::Case(case) => self.cases.get(*case).map_or("", String::as_str),
                Piece::Rule => "rule",
                Piece::Together => "together",
            };
            Key::of(of_all.into_iter().map(String::as_str).chain([own]))
        };
        self.pieces.iter().map(key).collect()
    }

    fn name(&self, unit: usize) -> String {
        match self.pieces.get(unit) {
            Some(Piece::Case(case)) => {
                let case = self.cases.get(*case).map_or("", String::as_str);
                case.lines().next().unwrap_or_default().into()
            }
            Some(Piece::Rule) => "what it computes".into(),
            Some(Piece::Together) => "rays in one request".into(),
            None => String::new(),
        }
    }

    fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let cases = |of: &Self| {
            let names = of.cases.iter().filter_map(|case| case.lines().next());
            names.collect::<Vec<_>>().join(", ")
        };
        let compared = [
            ("version", self.volver.clone(), other.volver.clone()),
            ("kernel", self.kernel.clone(), other.kernel.clone()),
            (
                "declaration",
                self.declaration.clone(),
                other.declaration.clone(),
            ),
            ("settings", self.settings.clone(), other.settings.clone()),
            ("cases", cases(self), cases(other)),
        ];
        let differs = compared
            .into_iter()
            .find(|(_, ours, theirs)| ours != theirs);
        let formulas = || {
            let same = self.cases == other.cases;
            (!same).then(|| ("formulas", "others".into(), "these".into()))
        };
        differs.or_else(formulas)
    }
}

impl Divided {
    /// Of a kernel that has these words on the command line.
    ///
    /// # Errors
    /// [`VerifyError`] where it cannot be verified so.
    pub fn new(
        kernel: &dyn Kernel,
        words: &[String],
        subjects: &[Subject],
        settings: &Settings,
    ) -> Result<Divided, VerifyError> {
        let prepared = Prepared::new(kernel.declaration(), subjects, settings)?;
        let described = |subject: &Subject| {
            let mut lines = vec![subject.name().to_string(), subject.length().to_string()];
            for case in subject.cases() {
                let formulas = case.formulas();
                let parts = [&formulas.field, &formulas.extinction, &formulas.emission];
                lines.extend(parts.map(ToString::to_string));
            }
            lines.push(format!("{:?}", subject.background()));
            lines.join("\n")
        };
        let cases = 0..prepared.subjects.len();
        let rule = prepared.identifies().then_some(Piece::Rule);
        let together = settings.batch.map(|_| Piece::Together);
        Ok(Divided {
            volver: env!("CARGO_PKG_VERSION").into(),
            kernel: words.join(" "),
            greeting: kernel.greeting().map(Into::into),
            declaration: format!("{:?}", prepared.declaration),
            settings: format!("{settings:?}"),
            cases: prepared.subjects.iter().map(described).collect(),
            pieces: cases.map(Piece::Case).chain(rule).chain(together).collect(),
        })
    }

    /// Seconds that each piece takes of a kernel that takes a microsecond a segment: they are right in parts of each other.
    ///
    /// # Errors
    /// [`VerifyError`] where it cannot be verified so.
    pub fn model(
        &self,
        kernel: &dyn Kernel,
        subjects: &[Subject],
        settings: &Settings,
    ) -> Result<Vec<f64>, VerifyError> {
        let prepared = Prepared::new(kernel.declaration(), subjects, settings)?;
        let alone = Settings {
            identify: Identify::Off,
            batch: None,
            ..settings.clone()
        };
        let work = |subjects: &[Subject], settings: &Settings| {
            settings.work(subjects, &prepared.declaration) as f64 * SECONDS
        };
        let of = |piece: &Piece| match piece {
            Piece::Case(case) => {
                let subject = prepared.subjects.get(*case).map(std::slice::from_ref);
                work(subject.unwrap_or_default(), &alone)
            }
            Piece::Rule => {
                let identify = settings.identify;
                work(
                    &[],
                    &Settings {
                        identify,
                        ..alone.clone()
                    },
                )
            }
            Piece::Together => {
                let batch = settings.batch;
                work(
                    &[],
                    &Settings {
                        batch,
                        ..alone.clone()
                    },
                )
            }
        };
        Ok(self.pieces.iter().map(of).collect())
    }

    /// The same with what an earlier run has taken: a piece that was asked there takes what it took, others what the model says
    /// times what all took there of what the model said.
    #[must_use]
    pub fn learned(
        &self,
        model: &[f64],
        earlier: &Division<Divided>,
        gathered: &Gathered,
    ) -> Vec<f64> {
        let before = earlier.work.keys().into_iter().zip(&earlier.model);
        let (mut took, mut foreseen) = (0.0, 0.0);
        for (key, model) in before {
            if let Some((_, seconds)) = gathered.seconds(key) {
                took += seconds;
                foreseen += model;
            }
        }
        let ratio = Some(took / foreseen).filter(|ratio| ratio.is_finite() && *ratio > 0.0);
        let keys = self.keys().into_iter().zip(model);
        let learned = keys.map(|(key, model)| match gathered.seconds(key) {
            Some((_, took)) => took,
            None => model * ratio.unwrap_or(1.0),
        });
        learned.collect()
    }
}

/// Of a segment.
const SECONDS: f64 = 1e-6;

/// Asks a kernel what a piece asks; what it answered.
///
/// # Errors
/// [`VerifyError`] where it cannot be asked so.
pub fn ask(
    kernel: &mut dyn Kernel,
    subjects: &[Subject],
    settings: &Settings,
    piece: Piece,
    progress: &dyn Progress,
) -> Result<Vec<Entry>, VerifyError> {
    let prepared = Prepared::new(kernel.declaration(), subjects, settings)?;
    let mut recorded = Recorded::new(kernel);
    match piece {
        Piece::Case(case) => {
            if let Some(subject) = prepared.subjects.get(case) {
                recorded.renew();
                let asked = prepared.asked(subject)?;
                let _ = asked.of(&mut recorded, progress);
            }
        }
        Piece::Rule => {
            let mut rays = 0;
            for subject in &prepared.subjects {
                rays += prepared.asked(subject)?.rays();
            }
            // What it says is read off again where all answers are.
            let _ = examined(&mut recorded, &prepared.settings, rays, None, progress);
        }
        Piece::Together => {
            if let Some(count) = prepared.settings.batch {
                let mut before = 0;
                together(&mut recorded, count, &mut |spent| {
                    progress.advance(spent.segments.saturating_sub(before));
                    before = spent.segments;
                })?;
            }
        }
    }
    match recorded.gone() {
        Some(why) => Err(why.into()),
        None => Ok(recorded.into_entries()),
    }
}
