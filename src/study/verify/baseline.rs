//! What a kernel showed once, to compare with what it shows now.

mod error;
mod moved;

pub use error::BaselineError;
pub use moved::Moved;

use super::{
    Accepted, Axis, Identified, Identify, Line, Settings, SettingsError, Standing, Steps,
    Verification,
};
use crate::convergence::Ladder;
use crate::identify::{Stated, parts};
use crate::kernel::Spacing;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::str::FromStr;

/// The version of the file.
const VERSION: u32 = 2;
/// One without rule and deviations is read too.
const FIRST: u32 = 1;

/// A verification, as far as later ones are compared with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// The version of the file: 2, or 1 for one that has neither rule nor deviations.
    pub volver_baseline: u32,
    /// The kernel's name.
    pub kernel: String,
    /// Which cases, as they were asked for; none for all of the catalogue, as it was then.
    pub cases: Vec<String>,
    /// The levels.
    pub ladder: Vec<u64>,
    /// Whether the grid was refined, and not the step.
    pub grid: bool,
    /// Whether steps divided no ray, and the last segment was another part of the others at every level.
    pub uneven: bool,
    /// Whether steps divided the ray: so they did before they could do otherwise.
    #[serde(default = "always")]
    pub divides: bool,
    /// How segments of many lengths lay; none where they were even.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<String>,
    /// The order expected in place of the declared one.
    pub expect: Option<String>,
    /// Seeds a level, for kernels that draw random numbers.
    pub replicas: usize,
    /// What the values were found to be, in version 1; nothing is compared with it.
    #[serde(default, skip_serializing)]
    pub fingerprint: Option<String>,
    /// Whether, and by how many rays, it was read off what the kernel computes: `auto`, `full` or `off`.
    #[serde(default = "off")]
    pub identify: String,
    /// What it was found to compute, part by part; none where no rule was named.
    #[serde(default)]
    pub rule: Option<Vec<BaselinePart>>,
    /// In what that deviated: so much is accepted.
    #[serde(default)]
    pub deviations: Vec<BaselineDeviation>,
    /// One a channel.
    pub lines: Vec<BaselineLine>,
}

/// A part of a rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaselinePart {
    /// Its name.
    pub part: String,
    /// Its parameter.
    pub value: Option<f64>,
    /// In words.
    pub words: String,
}

/// A deviation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaselineDeviation {
    /// Its name.
    pub name: String,
    /// Its parameter.
    pub value: Option<f64>,
}

/// One channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaselineLine {
    /// The case, with its channel.
    pub name: String,
    /// The verdict on the order.
    pub verdict: String,
    /// What it said of the kernel.
    pub standing: String,
    /// The order, if there was one.
    pub order: Option<f64>,
    /// The half-width of its interval.
    pub half_width: Option<f64>,
}

fn always() -> bool {
    true
}

fn off() -> String {
    "off".into()
}

/// Enough of a file to know its version: another one may have other keys.
#[derive(Deserialize)]
#[serde(expecting = "a baseline")]
struct Versioned {
    volver_baseline: u64,
}

impl Baseline {
    /// What there is to keep of a verification of these cases, as they were asked for.
    #[must_use]
    pub fn new(verification: &Verification, cases: &[String]) -> Self {
        let settings = &verification.settings;
        let identified = verification.identification.as_ref();
        let named = identified.and_then(Identified::named);
        let deviations = identified.map(|identified| &identified.examined.deviations);
        Baseline {
            volver_baseline: VERSION,
            kernel: verification.declaration.name.clone(),
            cases: cases.to_vec(),
            ladder: settings.ladder.clone(),
            grid: settings.axis == Axis::Grid,
            uneven: settings.steps == Steps::Uneven,
            divides: settings.steps == Steps::Divide,
            spacing: match settings.steps {
                Steps::Spaced(spacing) => Some(spacing.to_string()),
                Steps::PartLast | Steps::Divide | Steps::Uneven => None,
            },
            expect: settings.expect.as_ref().map(ToString::to_string),
            replicas: settings.replicas,
            fingerprint: None,
            identify: settings.identify.name().into(),
            rule: named.map(|rule| parts(rule).into_iter().map(BaselinePart::new).collect()),
            deviations: deviations
                .into_iter()
                .flatten()
                .map(|deviation| BaselineDeviation {
                    name: deviation.name.into(),
                    value: deviation.value,
                })
                .collect(),
            lines: verification.lines.iter().map(BaselineLine::new).collect(),
        }
    }

    /// Reads one.
    ///
    /// # Errors
    /// [`BaselineError`] where the text is none.
    pub fn read(text: &str) -> Result<Self, BaselineError> {
        let format = |error: serde_json::Error| BaselineError::Format {
            reason: one_line(&error.to_string()),
        };
        let version: Versioned = serde_json::from_str(text).map_err(format)?;
        if !(u64::from(FIRST)..=u64::from(VERSION)).contains(&version.volver_baseline) {
            return Err(BaselineError::Version {
                found: version.volver_baseline,
            });
        }
        let baseline: Baseline = serde_json::from_str(text).map_err(format)?;
        baseline.settings()?;
        if let Some(key) = baseline.of_control() {
            return Err(BaselineError::Format {
                reason: format!("a control character in '{key}'"),
            });
        }
        let mut names = BTreeSet::new();
        for line in &baseline.lines {
            let problem = line.problem().or_else(|| {
                let again = !names.insert(&line.name);
                again.then_some("a second time (allowed: each channel once)")
            });
            if let Some(problem) = problem {
                return Err(BaselineError::Line {
                    name: line.name.clone(),
                    problem,
                });
            }
        }
        Ok(baseline)
    }

    /// Where there is text of more than one line.
    fn of_control(&self) -> Option<&'static str> {
        let of_rule = self.rule.iter().flatten();
        let of_rule = of_rule.flat_map(|part| [&part.part[..], &part.words]);
        let of_deviations = self.deviations.iter().map(|one| &one.name[..]);
        let fingerprint = self
            .fingerprint
            .iter()
            .map(|text| ("fingerprint", &text[..]));
        let texts = fingerprint.chain(of_rule.map(|text| ("rule", text)));
        let mut texts = texts.chain(of_deviations.map(|text| ("deviations", text)));
        let found = texts.find(|(_, text)| text.chars().any(char::is_control));
        found.map(|(key, _)| key)
    }

    /// As it is written to a file.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }

    /// The same settings once more.
    ///
    /// # Errors
    /// [`BaselineError::Settings`] where somebody has edited them.
    pub fn settings(&self) -> Result<Settings, BaselineError> {
        let wrong = |key| move |error| BaselineError::Settings { key, error };
        let ladder = Ladder::segments(self.ladder.clone()).map_err(SettingsError::from);
        let ladder = ladder.and_then(|ladder| Settings::new(&ladder));
        let spacing = self.spacing.as_deref().map(Spacing::from_str).transpose();
        let spacing = spacing.map_err(|error| BaselineError::Spacing { error })?;
        let expect = self.expect.as_deref().map(Settings::order).transpose();
        let identify = Identify::of_name(&self.identify);
        let accepted = self.deviations.iter().map(BaselineDeviation::accepted);
        Ok(Settings {
            // The first version says nothing of a rule: what is found now is told.
            identify: match self.volver_baseline {
                FIRST => Identify::Auto,
                _ => identify.ok_or_else(|| BaselineError::Identify {
                    found: self.identify.clone(),
                })?,
            },
            accept: accepted.collect(),
            axis: if self.grid { Axis::Grid } else { Axis::Step },
            steps: match (spacing, self.uneven, self.divides) {
                (Some(spacing), ..) => Steps::Spaced(spacing),
                (None, true, _) => Steps::Uneven,
                (None, false, true) => Steps::Divide,
                (None, false, false) => Steps::PartLast,
            },
            expect: expect.map_err(wrong("expect"))?,
            replicas: Settings::replicas(self.replicas).map_err(wrong("replicas"))?,
            ..ladder.map_err(wrong("ladder"))?
        })
    }

    /// The cases to ask again: those asked for; where that was all of the catalogue, those that it had.
    #[must_use]
    pub fn asked(&self) -> Vec<String> {
        if !self.cases.is_empty() {
            return self.cases.clone();
        }
        let mut asked: Vec<String> = Vec::new();
        for line in &self.lines {
            // Behind the case its channel, or another quantity.
            let case = line.name.split(['/', ':']).next().unwrap_or_default();
            if !asked.iter().any(|known| known == case) {
                asked.push(case.into());
            }
        }
        asked
    }
}

impl BaselinePart {
    fn new(stated: Stated) -> Self {
        BaselinePart {
            part: stated.part.name().into(),
            value: stated.value,
            words: stated.words,
        }
    }
}

impl BaselineDeviation {
    fn accepted(&self) -> Accepted {
        Accepted {
            name: self.name.clone(),
            value: self.value,
        }
    }
}

/// Keys of a file are repeated in messages as they are: line feeds must not be.
fn one_line(text: &str) -> String {
    let shown = |c: char| {
        if c.is_control() {
            c.escape_debug().to_string()
        } else {
            c.to_string()
        }
    };
    text.chars().map(shown).collect()
}

impl BaselineLine {
    fn new(line: &Line) -> Self {
        let order = line.measured.order();
        BaselineLine {
            name: line.name.clone(),
            verdict: line.measured.verdict().name().into(),
            standing: line.standing.name().into(),
            order: order.map(|(order, _)| order),
            half_width: order.map(|(_, half_width)| half_width),
        }
    }

    /// Why no kernel shows this.
    fn problem(&self) -> Option<&'static str> {
        let standings = [
            Standing::Confirmed,
            Standing::Contradicted,
            Standing::Inconclusive,
            Standing::Unresolved,
            Standing::Blind,
            Standing::Failed,
        ];
        if [&self.name, &self.verdict]
            .iter()
            .any(|text| text.chars().any(char::is_control))
        {
            return Some("a control character (allowed: text in one line)");
        }
        if !standings.iter().any(|one| one.name() == self.standing) {
            return Some(
                "unknown standing (allowed: confirmed, contradicted, inconclusive, unresolved, blind, failed)",
            );
        }
        let negative = self.half_width.is_some_and(|half_width| half_width < 0.0);
        negative.then_some("half_width below 0 (allowed: 0 or above)")
    }
}
